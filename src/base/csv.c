#include "base/csv.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void begin_cell(gg_csv *csv)
{
  if (csv->column++) gg_base_file_writer_put(csv->out, ",");
}

void gg_base_csv_text(gg_csv *csv, const char *text)
{
  begin_cell(csv);
  if (!text) return;
  if (!strpbrk(text, ",\"\r\n")) {
    gg_base_file_writer_put(csv->out, text);
    return;
  }
  gg_base_file_writer_put(csv->out, "\"");
  for (; *text; text++) gg_base_file_writer_put(csv->out, *text == '"' ? "\"\"" : (char[]){*text, '\0'});
  gg_base_file_writer_put(csv->out, "\"");
}

void gg_base_csv_head(gg_csv *csv, const char *name, const char *unit)
{
  char text[160];
  bool plain = !unit || !*unit || strcmp(unit, "1") == 0;
  snprintf(text, sizeof text, plain ? "%s" : "%s [%s]", name, unit);
  gg_base_csv_text(csv, text);
}

static void put_real(gg_csv *csv, double value)
{
  begin_cell(csv);
  if (isfinite(value)) gg_base_file_writer_put_number(csv->out, value);
}

static void put_integer(gg_csv *csv, json_int_t value)
{
  char text[32];
  snprintf(text, sizeof text, "%" JSON_INTEGER_FORMAT, value);
  gg_base_csv_text(csv, text);
}

void gg_base_csv_json(gg_csv *csv, const json_t *value)
{
  if (json_is_integer(value))
    put_integer(csv, json_integer_value(value));
  else if (json_is_real(value))
    put_real(csv, json_real_value(value));
  else if (json_is_boolean(value))
    gg_base_csv_text(csv, json_is_true(value) ? "true" : "false");
  else
    gg_base_csv_text(csv, json_string_value(value));
}

void gg_base_csv_end_row(gg_csv *csv)
{
  gg_base_file_writer_put(csv->out, "\r\n");
  csv->column = 0;
}
