#include "cli/wrap.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { USUAL = 80, LEAST = 40, MOST = 1000 };

int gg_cli_terminal_width(void)
{
  struct winsize window = {0};
  const char *said = getenv("COLUMNS");
  char *end = NULL;
  long columns = USUAL;
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col)
    columns = window.ws_col;
  else if (said && *said) {
    columns = strtol(said, &end, 10);
    if (*end || columns < 1) columns = USUAL;
  }
  return (int)(columns < LEAST ? LEAST : columns > MOST ? MOST : columns);
}

/* Characters of UTF-8 text: bytes that do not continue one. */
static int columns_of(const char *text, size_t bytes)
{
  int n = 0;
  for (size_t i = 0; i < bytes; i++) n += ((unsigned char)text[i] & 0xC0) != 0x80;
  return n;
}

/* Words from column `used` on, in lines that begin with `indent` blanks; the blanks between words stay. */
static void put_words(FILE *out, const char *text, int used, int indent)
{
  int width = gg_cli_terminal_width();
  bool begun = false;
  while (*text) {
    int gap = (int)strspn(text, " ");
    text += gap;
    size_t bytes = strcspn(text, " \n");
    int word = columns_of(text, bytes);
    if (begun && used + gap + word > width) {
      fprintf(out, "\n%*s", indent, "");
      used = indent, gap = 0;
    }
    if (bytes) fprintf(out, "%*s%.*s", gap, "", (int)bytes, text);
    used += gap + word;
    begun = true;
    text += bytes;
    if (*text != '\n') continue;
    text++;
    fprintf(out, "\n%*s", *text && *text != '\n' ? indent : 0, "");
    used = indent, begun = false;
  }
  fputc('\n', out);
}

void gg_cli_print_wrapped(FILE *out, const char *lead, const char *text)
{
  fputs(lead, out);
  int indent = columns_of(lead, strlen(lead));
  put_words(out, text, indent, indent);
}

void gg_cli_print_paragraph(FILE *out, int indent, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  int length = vasprintf(&text, format, args);
  va_end(args);
  if (length >= 0) put_words(out, text, 0, indent);
  free(text);
}
