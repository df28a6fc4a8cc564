#include "plot/chart_styles.h"

#include <string.h>

#include "plot/plot.h"

/* Symbols in pairs, filled and open; the first two stand for md and dsmc where there are no groups. */
static const int symbols[][2] = {{7, 6}, {5, 4}, {9, 8}, {13, 12}, {11, 10}, {15, 14}};
static const int crosses[] = {2, 1, 3}; /* of what is measured by neither engine */
static const char *const dashes[] = {"1",         "(10,4)",         "(2.5,3)",      "(10,3,2.5,3)",
                                     "(18,4)",    "(10,3,2,3,2,3)", "(5,3)",        "(18,3,5,3)",
                                     "(1.5,1.5)", "(18,3,2,3)",     "(5,2,2,2,2,2)"};
static const char grey[] = "#444444";
enum { CROWD = 50 }; /* more points are drawn smaller */
enum { N_SYMBOLS = sizeof symbols / sizeof *symbols, N_DASHES = sizeof dashes / sizeof *dashes };

static bool is_same(const char *a, const char *b)
{
  return a == b || (a && b && strcmp(a, b) == 0);
}

static int find(const gg_chart_names *names, const char *name, bool method)
{
  for (int i = 0; i < names->n; i++)
    if (is_same(method ? names->first[i]->method : names->first[i]->group, name)) return i;
  return -1;
}

static void note(gg_chart_names *names, const gg_chart_series *s, bool method)
{
  const char *name = method ? s->method : s->group;
  if (!name) return;
  int i = find(names, name, method);
  if (i < 0 && names->n == GG_LOOKS_MOST) return;
  if (i < 0) names->first[i = names->n++] = s;
  names->points[i] |= s->style == GG_CHART_POINTS;
  names->bands |= s->style == GG_CHART_BAND;
}

void gg_plot_chart_looks_of(const gg_chart *chart, gg_chart_looks *looks)
{
  *looks = (gg_chart_looks){.method = {.n = 0}};
  for (size_t p = 0; p < chart->n; p++)
    for (size_t k = 0; k < chart->panel[p].n; k++) {
      note(&looks->method, &chart->panel[p].series[k], true);
      note(&looks->group, &chart->panel[p].series[k], false);
    }
}

/* Among the methods of its kind; of those that measure, md and dsmc have their places whether they are there or not. */
static int place_of(const gg_chart_looks *l, const gg_chart_series *s)
{
  bool line = s->style == GG_CHART_LINE;
  int place = line ? 0 : 2;
  if (!line && is_same(s->method, "md")) return 0;
  if (!line && is_same(s->method, "dsmc")) return 1;
  for (int i = 0; i < l->method.n; i++) {
    const gg_chart_series *other = l->method.first[i];
    if (is_same(other->method, s->method)) return place;
    bool engine = is_same(other->method, "md") || is_same(other->method, "dsmc");
    place += (other->style == GG_CHART_LINE) == line && (line || !engine);
  }
  return place;
}

const char *gg_plot_chart_colour(const gg_chart_looks *l, const gg_chart_series *s)
{
  int group = s->group ? find(&l->group, s->group, false) : -1;
  if (group >= 0) return gg_plot_colours[group % GG_PLOT_COLOURS];
  if (l->group.n) return grey;
  int place = place_of(l, s), from = s->style == GG_CHART_LINE ? 2 : 0;
  return gg_plot_colours[place < 2 && !from ? place : 2 + (place + from - 2) % (GG_PLOT_COLOURS - 2)];
}

/* md is small and filled, so that dsmc shows around it where both agree. */
static void print_symbol(FILE *s, int symbol, int place, double size)
{
  if (place >= 2)
    fprintf(s, "pt %d ps %g", crosses[(place - 2) % 3], 0.9 * size);
  else
    fprintf(s, "pt %d ps %g", symbols[symbol % N_SYMBOLS][place], (place ? 1.0 : 0.7) * size);
}

void gg_plot_chart_print_look(FILE *s, const gg_chart_looks *l, const gg_chart_series *series)
{
  int place = place_of(l, series), group = series->group ? find(&l->group, series->group, false) : -1;
  if (series->style == GG_CHART_BAND) fprintf(s, "lw 1.5 dt 1");
  if (series->style == GG_CHART_LINE) fprintf(s, "lw 1.5 dt %s", dashes[(place + l->method.bands) % N_DASHES]);
  if (series->style == GG_CHART_POINTS) {
    print_symbol(s, group >= 0 ? group : place < 2 ? place : 0, place, series->n > CROWD ? 0.6 : 1);
    fprintf(s, " lw 1.2");
  }
  fprintf(s, " lc rgb '%s'", gg_plot_chart_colour(l, series));
}
