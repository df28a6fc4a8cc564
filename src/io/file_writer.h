/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text into a file that appears whole or not at all (atomic_file.h), through a buffer. The first failure sticks: later
 * calls do nothing, and gg_io_file_writer_end reports it, so that a writer reads as what it writes. */
#ifndef GG_FILE_WRITER_H
#define GG_FILE_WRITER_H

#include <jansson.h>

#include "io/atomic_file.h"

typedef struct gg_file_writer {
  gg_atomic_file *file;
  gg_error *err; /* receives the first failure; may be NULL */
  gg_status status;
  const gg_stop *stop; /* polled before each write; set after the beginning; NULL: never */
  size_t used;
  char buffer[1 << 15];
} gg_file_writer;

void gg_io_file_writer_begin(gg_file_writer *out, gg_atomic_file *file, gg_error *err);
void gg_io_file_writer_put(gg_file_writer *out, const char *text);
/* The shortest text that reads back as this number, with a decimal point in the C locale (text.h). */
void gg_io_file_writer_put_number(gg_file_writer *out, double value);
/* Write what is still in the buffer to the file. */
gg_status gg_io_file_writer_end(gg_file_writer *out);

/* The same number in `text`. */
enum { GG_NUMBER_TEXT = 32 };
void gg_io_number_format(double value, char text[GG_NUMBER_TEXT]);

/* Comma-separated values as RFC 4180 has them: cells quoted where they must be, lines that end with CR LF. A missing
 * value is an empty cell. */

typedef struct gg_csv {
  gg_file_writer *out;
  int column;
} gg_csv;

/* NULL: an empty cell. A text that begins like a formula gets an apostrophe before it: spreadsheets show it as text. */
void gg_io_csv_text(gg_csv *csv, const char *text);
/* "NAME [UNIT]", of a number without one "NAME". */
void gg_io_csv_head(gg_csv *csv, const char *name, const char *unit);
/* A number, text or truth of a document; empty if it is null or not there. */
void gg_io_csv_json(gg_csv *csv, const json_t *value);
void gg_io_csv_end_row(gg_csv *csv);

#endif
