/* Text for people, in lines as wide as their terminal. */
#ifndef GG_CLI_WRAP_H
#define GG_CLI_WRAP_H

#include <stdio.h>

/* Columns of the terminal that standard output is; else what COLUMNS says, else 80. At least 40. */
int gg_cli_terminal_width(void);

/* A paragraph: `lead` before the first line, as much space before the others. Line ends in `text` stay. */
void gg_cli_print_wrapped(FILE *out, const char *lead, const char *text);
/* The same from a format; lines after the first begin with `indent` blanks, the
 * first with those of the text. */
void gg_cli_print_paragraph(FILE *out, int indent, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
