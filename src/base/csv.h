/* Comma-separated values as RFC 4180 has them: cells quoted where they must be, lines that end with CR LF. What cannot
 * be had is an empty cell. */
#ifndef GG_CSV_H
#define GG_CSV_H

#include <jansson.h>

#include "base/file_writer.h"

typedef struct gg_csv {
  gg_text_out *out;
  int column;
} gg_csv;

void gg_base_csv_text(gg_csv *csv, const char *text); /* NULL: an empty cell */
/* "NAME [UNIT]", of a number without one "NAME". */
void gg_base_csv_head(gg_csv *csv, const char *name, const char *unit);
/* A number, text or truth of a document; empty if it is null or not there. */
void gg_base_csv_json(gg_csv *csv, const json_t *value);
void gg_base_csv_end_row(gg_csv *csv);

#endif
