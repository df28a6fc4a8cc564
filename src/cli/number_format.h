/* Counts and durations as people read them. */
#ifndef GG_CLI_FORMAT_H
#define GG_CLI_FORMAT_H

#include <stddef.h>

/* A count with a unit prefix: "12.3 M". */
void gg_cli_format_count(double count, char *text, size_t size);
/* "0.8 s", "1:05", "2:03:04". */
void gg_cli_format_duration(double seconds, char *text, size_t size);

#endif
