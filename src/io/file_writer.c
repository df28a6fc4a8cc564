/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "io/file_writer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gg_io_file_writer_begin(gg_file_writer *out, gg_atomic_file *file, gg_error *err)
{
  out->file = file, out->err = err, out->status = GG_OK, out->stop = NULL, out->used = 0;
}

static void flush(gg_file_writer *out)
{
  if (out->status == GG_OK && out->stop) out->status = gg_stop_check(out->stop, out->err);
  if (out->status == GG_OK) out->status = gg_io_atomic_write(out->file, out->buffer, out->used, out->err);
  out->used = 0;
}

void gg_io_file_writer_put(gg_file_writer *out, const char *text)
{
  for (size_t left = strlen(text); left > 0;) {
    size_t room = sizeof out->buffer - out->used, now = left < room ? left : room;
    memcpy(out->buffer + out->used, text, now);
    out->used += now, text += now, left -= now;
    if (out->used == sizeof out->buffer) flush(out);
  }
}

void gg_io_number_format(double value, char text[GG_NUMBER_TEXT])
{
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(text, GG_NUMBER_TEXT, "%.*g", digits, value);
    if (strtod(text, NULL) == value) return;
  }
}

void gg_io_file_writer_put_number(gg_file_writer *out, double value)
{
  char text[GG_NUMBER_TEXT];
  gg_io_number_format(value, text);
  gg_io_file_writer_put(out, text);
}

gg_status gg_io_file_writer_end(gg_file_writer *out)
{
  flush(out);
  return out->status;
}

static void begin_cell(gg_csv *csv)
{
  if (csv->column++) gg_io_file_writer_put(csv->out, ",");
}

/* A spreadsheet would compute what begins so. Numbers that stand as text ("-1" of a varied key) are numbers. */
static bool is_formula(const char *text)
{
  char *end;
  return *text && strchr("=+-@\t\r", *text) && (strtod(text, &end), end == text || *end);
}

void gg_io_csv_text(gg_csv *csv, const char *text)
{
  begin_cell(csv);
  if (!text) return;
  const char *before = is_formula(text) ? "'" : "";
  if (!strpbrk(text, ",\"\r\n")) {
    gg_io_file_writer_put(csv->out, before);
    gg_io_file_writer_put(csv->out, text);
    return;
  }
  gg_io_file_writer_put(csv->out, "\"");
  gg_io_file_writer_put(csv->out, before);
  for (; *text; text++) gg_io_file_writer_put(csv->out, *text == '"' ? "\"\"" : (char[]){*text, '\0'});
  gg_io_file_writer_put(csv->out, "\"");
}

void gg_io_csv_head(gg_csv *csv, const char *name, const char *unit)
{
  char text[160];
  bool plain = !unit || !*unit || strcmp(unit, "1") == 0;
  snprintf(text, sizeof text, plain ? "%s" : "%s [%s]", name, unit);
  gg_io_csv_text(csv, text);
}

void gg_io_csv_json(gg_csv *csv, const json_t *value)
{
  char whole[32];
  snprintf(whole, sizeof whole, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
  if (json_is_integer(value))
    gg_io_csv_text(csv, whole);
  else if (json_is_real(value) && isfinite(json_real_value(value)))
    begin_cell(csv), gg_io_file_writer_put_number(csv->out, json_real_value(value));
  else if (json_is_boolean(value))
    gg_io_csv_text(csv, json_is_true(value) ? "true" : "false");
  else
    gg_io_csv_text(csv, json_string_value(value));
}

void gg_io_csv_end_row(gg_csv *csv)
{
  gg_io_file_writer_put(csv->out, "\r\n");
  csv->column = 0;
}
