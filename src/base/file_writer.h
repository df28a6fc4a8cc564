/* Text into a file that appears whole or not at all (atomic_file.h), through a buffer. The first failure sticks: later
 * calls do nothing, and gg_base_file_writer_end reports it, so that a writer reads as what it writes. */
#ifndef GG_TEXT_OUT_H
#define GG_TEXT_OUT_H

#include "base/atomic_file.h"

typedef struct gg_text_out {
  gg_atomic_file *file;
  gg_error *err; /* where the first failure is told; may be NULL */
  gg_status status;
  size_t used;
  char buffer[1 << 15];
} gg_text_out;

void gg_base_file_writer_begin(gg_text_out *out, gg_atomic_file *file, gg_error *err);
void gg_base_file_writer_put(gg_text_out *out, const char *text);
/* The shortest text that reads back as this number, with a decimal point in the C locale (c_locale.h). */
void gg_base_file_writer_put_number(gg_text_out *out, double value);
/* What is still in the buffer goes to the file. */
gg_status gg_base_file_writer_end(gg_text_out *out);

/* The same number in `text`. */
enum { GG_NUMBER_TEXT = 32 };
void gg_base_number_format(double value, char text[GG_NUMBER_TEXT]);

#endif
