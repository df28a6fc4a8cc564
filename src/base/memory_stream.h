/* A text that is written piece by piece, as to a file, into memory. */
#ifndef GG_TEXT_STREAM_H
#define GG_TEXT_STREAM_H

#include <stdbool.h>
#include <stdio.h>

/* As open_memstream, which leaves out what it finds no room for and does not say so (glibc 2.36). *text is there when
 * it is closed; to be freed. NULL: no memory. ftell says how long it is by now. */
FILE *gg_base_memory_stream_open(char **text);
/* False, and noted (gg_base_memory_lacked): it is not whole, and *text is NULL. `out` may be NULL. */
bool gg_base_memory_stream_close(FILE *out, char *const *text);

#endif
