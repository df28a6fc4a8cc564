/* docs/appendix/reproduction.md: its beginning, and a section a figure from what the entries say. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "reproduce/figures.h"

static const char *const verdicts[] = {"agrees", "differs", "cannot be told", "open"};
enum { VERDICTS = 4 };

/* Lines of at most 120 columns, broken at blanks. */
static void print_wrapped(FILE *out, const char *text)
{
  size_t column = 0;
  while (*text) {
    while (isspace((unsigned char)*text)) text++;
    size_t length = strcspn(text, " \n\t");
    if (!length) break;
    if (column && column + 1 + length > 120) {
      fputc('\n', out);
      column = 0;
    }
    column += (size_t)fprintf(out, "%s%.*s", column ? " " : "", (int)length, text);
    text += length;
  }
  if (column) fputc('\n', out);
}

static const char *verdict_of(const gg_figure_entry *e)
{
  return e->cannot ? "cannot be reproduced" : e->verdict;
}

static void print_section(FILE *out, const gg_figure_entry *e)
{
  char base[64], head[600];
  bool cannot = e->cannot;
  gg_reproduce_figure_base(e, base, sizeof base);
  fprintf(out, "\n## %s\n\n", e->figure);
  if (!cannot && strcmp(e->verdict, "open") != 0) {
    /* The picture that there is: a vector one, or pixels where those are smaller (many grains). */
    const char *ending = e->panel[0].source.kind == GG_OF_SNAPSHOT ? "png" : "svg";
    fprintf(out, "![%s](../images/reproduction/%s.%s)\n\n", e->figure, base, ending);
  }
  snprintf(head, sizeof head, "%s. **%c%s.**", e->shows, toupper((unsigned char)verdict_of(e)[0]), verdict_of(e) + 1);
  size_t size = strlen(head) + strlen(cannot ? e->cannot : e->because) + 2;
  char *all = malloc(size);
  if (!all) return;
  snprintf(all, size, "%s %s", head, cannot ? e->cannot : e->because);
  print_wrapped(out, all);
  free(all);
}

static gg_status print_counts(FILE *out, gg_error *err)
{
  int count[VERDICTS] = {0}, cannot = 0, n = 0;
  gg_figure_entry e;
  for (; gg_entry_files[n].file; n++) {
    GG_TRY(gg_reproduce_figure_read((size_t)n, &e, err));
    for (int k = 0; k < VERDICTS && !e.cannot; k++) count[k] += strcmp(e.verdict, verdicts[k]) == 0;
    cannot += e.cannot != NULL;
    gg_reproduce_entry_clear(&e);
  }
  fprintf(out,
          "\n# %d figures\n\nagrees %d, differs %d, cannot be told %d, not judged yet %d, cannot be reproduced %d.\n",
          n, count[0], count[1], count[2], count[3], cannot);
  return GG_OK;
}

gg_status gg_reproduce_figure_page(char **text, gg_error *err)
{
  gg_figure_entry e;
  FILE *out = gg_base_memory_stream_open(text);
  if (!out) return gg_base_out_of_memory(err);
  fputs(gg_reproduction_head, out);
  gg_status status = print_counts(out, err);
  for (size_t k = 0; gg_entry_files[k].file && status == GG_OK; k++) {
    status = gg_reproduce_figure_read(k, &e, err);
    if (status != GG_OK) break;
    print_section(out, &e);
    gg_reproduce_entry_clear(&e);
  }
  if (!gg_base_memory_stream_close(out, text)) status = gg_base_out_of_memory(err);
  if (status != GG_OK) free(*text);
  return status;
}
