/* Figures by name. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"
#include "reproduce/figures.h"

gg_status gg_reproduce_figure_read(size_t k, gg_figure_entry *entry, gg_error *err)
{
  size_t n = 0;
  while (gg_entry_files[n].file) n++;
  if (k >= n) return gg_base_fail(err, GG_BAD_INPUT, "there are %zu figures", n);
  return gg_reproduce_entry_read(entry, gg_entry_files[k].file, gg_entry_files[k].yaml, err);
}

void gg_reproduce_figure_base(const gg_figure_entry *entry, char *text, size_t size)
{
  snprintf(text, size, "%.*s", (int)(strlen(entry->file) - strlen(".yaml")), entry->file);
}

/* "Thesis_3.05", "fig. thesis-3.5" -> "thesis 3.5": small letters, one blank, no zeros before a number. */
static void simplify(const char *name, char *text, size_t size)
{
  size_t used = 0;
  for (const char *c = name; *c && used + 1 < size; c++) {
    char small = (char)tolower((unsigned char)*c);
    if (strchr(" -_:", small)) small = ' ';
    bool zero =
        small == '0' && used && (text[used - 1] == '.' || text[used - 1] == ' ') && isdigit((unsigned char)c[1]);
    if (zero || (small == ' ' && (!used || text[used - 1] == ' '))) continue;
    text[used++] = small;
  }
  while (used && text[used - 1] == ' ') used--;
  text[used] = '\0';
  char *dot = strstr(text, ".yaml");
  if (dot) *dot = '\0';
}

/* "thesis 3.5" or "3.5"? */
static bool answers(const char *simple, const char *asked)
{
  const char *number = strchr(simple, ' ');
  return strcmp(simple, asked) == 0 || (number && strcmp(number + 1, asked) == 0);
}

gg_status gg_reproduce_figure_find(const char *name, size_t *k, gg_error *err)
{
  char asked[80], simple[80], all[96];
  size_t found = 0;
  char kept[64][80];
  gg_nearest nearest = {.word = asked};
  simplify(name, asked, sizeof asked);
  for (size_t i = 0; gg_entry_files[i].file; i++) {
    simplify(gg_entry_files[i].file, simple, sizeof simple);
    if (!answers(simple, asked)) continue;
    *k = i;
    if (found < 64) snprintf(kept[found], sizeof kept[0], "%s", simple);
    found++;
  }
  if (found == 1) return GG_OK;
  if (found > 1)
    return gg_base_fail(err, GG_BAD_INPUT, "figure '%.60s' is in both papers: %s or %s?", name, kept[0], kept[1]);
  char best[80] = "";
  for (size_t i = 0; gg_entry_files[i].file; i++) {
    simplify(gg_entry_files[i].file, simple, sizeof simple);
    size_t before = nearest.distance;
    const char *had = nearest.best;
    gg_base_spelling_try(&nearest, strchr(asked, ' ') ? simple : strchr(simple, ' ') + 1);
    if (nearest.best && (!had || nearest.distance != before)) snprintf(best, sizeof best, "%s", simple);
    nearest.best = nearest.best ? best : NULL;
  }
  snprintf(all, sizeof all, *best ? "; did you mean '%s'?" : "%s", best);
  return gg_base_fail(err, GG_BAD_INPUT,
                      "there is no figure '%.60s' to be reproduced%s (graingas reproduce list names all)", name, all);
}
