#include "base/file_writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gg_base_file_writer_begin(gg_text_out *out, gg_atomic_file *file, gg_error *err)
{
  out->file = file, out->err = err, out->status = GG_OK, out->used = 0;
}

static void flush(gg_text_out *out)
{
  if (out->status == GG_OK) out->status = gg_base_atomic_write(out->file, out->buffer, out->used, out->err);
  out->used = 0;
}

void gg_base_file_writer_put(gg_text_out *out, const char *text)
{
  for (size_t left = strlen(text); left > 0;) {
    size_t room = sizeof out->buffer - out->used, now = left < room ? left : room;
    memcpy(out->buffer + out->used, text, now);
    out->used += now, text += now, left -= now;
    if (out->used == sizeof out->buffer) flush(out);
  }
}

void gg_base_number_format(double value, char text[GG_NUMBER_TEXT])
{
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(text, GG_NUMBER_TEXT, "%.*g", digits, value);
    if (strtod(text, NULL) == value) return;
  }
}

void gg_base_file_writer_put_number(gg_text_out *out, double value)
{
  char text[GG_NUMBER_TEXT];
  gg_base_number_format(value, text);
  gg_base_file_writer_put(out, text);
}

gg_status gg_base_file_writer_end(gg_text_out *out)
{
  flush(out);
  return out->status;
}
