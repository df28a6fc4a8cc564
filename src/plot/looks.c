/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks of the series of a chart. Each series gets its look once; the legend is made of the looks that are drawn. */
#include <math.h>
#include <string.h>

#include "plot/chart.h"

/* Symbols in pairs, filled and open. The first two stand for md and dsmc where there are no groups. */
static const int symbols[][2] = {{7, 6}, {5, 4}, {9, 8}, {13, 12}, {11, 10}, {15, 14}};
static const int crosses[] = {2, 1, 3, 8, 10, 12, 4, 14}; /* of methods that are no engines */
static const char *const dashes[] = {"1",         "(10,4)",         "(2.5,3)",      "(10,3,2.5,3)",
                                     "(18,4)",    "(10,3,2,3,2,3)", "(5,3)",        "(18,3,5,3)",
                                     "(1.5,1.5)", "(18,3,2,3)",     "(5,2,2,2,2,2)"};
enum { GREY = 0x444444, CROWD = 50 /* more points are drawn smaller */, MOST_NAMES = 64 };
#define COUNT(array) (int)(sizeof(array) / sizeof *(array))

/* The series under one legend and their names, in the order of their first appearance. */
typedef struct legend {
  int n, n_methods, n_groups;
  gg_chart_series *series[GG_CHART_PANELS * GG_CHART_SERIES];
  const gg_chart_panel *panel[GG_CHART_PANELS * GG_CHART_SERIES];
  const char *method[MOST_NAMES], *group[MOST_NAMES];
  int host[MOST_NAMES]; /* the method whose lines are drawn for those of this one; -1: its own */
  bool bands, has_md;
} legend;

static bool is_same(const char *a, const char *b)
{
  return a == b || (a && b && strcmp(a, b) == 0);
}

/* Place of a name in a list, to which it is added; -1: no name. */
static int place_of(const char **list, int *n, const char *name)
{
  int i = 0;
  if (!name) return -1;
  while (i < *n && strcmp(list[i], name) != 0) i++;
  if (i == MOST_NAMES) return i - 1;
  if (i == *n) list[(*n)++] = name;
  return i;
}

static void collect(legend *l, const gg_chart *c, const gg_chart_panel *own)
{
  for (size_t p = 0; p < c->n; p++)
    for (size_t k = 0; k < c->panel[p]->n && (own ? c->panel[p] == own : !c->panel[p]->own_legend); k++) {
      gg_chart_series *s = c->panel[p]->series[k];
      l->panel[l->n] = c->panel[p], l->series[l->n++] = s;
      place_of(l->method, &l->n_methods, s->method);
      place_of(l->group, &l->n_groups, s->group);
      l->bands |= s->look.style == GG_CHART_BAND, l->has_md |= is_same(s->method, "md");
    }
}

/* Lines less than a pixel apart. */
static bool coincide(const gg_chart_series *a, const gg_chart_series *b, const gg_chart_axis *y)
{
  bool same = a->n == b->n && is_same(a->group, b->group) && a->look.style == b->look.style;
  for (size_t i = 0; same && i < a->n; i++) {
    const double ya = a->point[i].y, yb = b->point[i].y;
    same = a->point[i].x == b->point[i].x &&
           (fabs(gg_plot_axis_place(y, ya) - gg_plot_axis_place(y, yb)) < 0.003 || (isnan(ya) && isnan(yb)));
  }
  return same;
}

/* True if each series of method a coincides with one of method b in its panel. */
static bool covers(const legend *l, const char *a, const char *b)
{
  for (int i = 0; i < l->n; i++) {
    bool found = !is_same(l->series[i]->method, a);
    for (int k = 0; k < l->n && !found; k++)
      found = l->panel[k] == l->panel[i] && is_same(l->series[k]->method, b) &&
              coincide(l->series[i], l->series[k], &l->panel[i]->y);
    if (!found) return false;
  }
  return true;
}

static bool is_engine(const char *method)
{
  return is_same(method, "md") || is_same(method, "dsmc");
}

static void find_hosts(legend *l)
{
  for (int i = 0; i < l->n_methods; i++) {
    l->host[i] = -1;
    for (int k = 0; k < i && l->host[i] < 0 && !is_engine(l->method[i]); k++)
      if (l->host[k] < 0 && !is_engine(l->method[k]) && covers(l, l->method[i], l->method[k]) &&
          covers(l, l->method[k], l->method[i]))
        l->host[i] = k;
  }
  for (int i = 0; i < l->n; i++) {
    const int method = place_of(l->method, &l->n_methods, l->series[i]->method);
    l->series[i]->hidden = method >= 0 && l->host[method] >= 0;
  }
}

/* Number of a method among those of its kind, lines or points; md and dsmc always are 0 and 1. */
static int rank_of(const legend *l, const gg_chart_series *s)
{
  const bool line = s->look.style == GG_CHART_LINE;
  if (!line && (!s->method || is_same(s->method, "md"))) return 0;
  if (!line && is_same(s->method, "dsmc")) return 1;
  int rank = line ? 0 : 2;
  for (int m = 0; m < l->n_methods && !is_same(l->method[m], s->method); m++) {
    bool counts = false;
    for (int i = 0; i < l->n; i++)
      counts |= !l->series[i]->hidden && is_same(l->series[i]->method, l->method[m]) &&
                (l->series[i]->look.style == GG_CHART_LINE) == line;
    rank += counts && (line || !is_engine(l->method[m]));
  }
  return rank;
}

/* Symbols of md are smaller than those of dsmc, so that both are visible where they agree. In a group with both, dsmc
 * has the group's colour, halfway to white. */
static void set_look(const legend *l, gg_chart_series *s, int group)
{
  gg_look *look = &s->look;
  const int rank = rank_of(l, s), from = look->style == GG_CHART_LINE ? 2 : 0;
  const int own = rank < 2 && !from ? rank : 2 + (rank + from - 2) % (GG_PLOT_COLOURS - 2);
  look->colour = group >= 0 ? gg_plot_colours[group % GG_PLOT_COLOURS] : l->n_groups ? GREY : gg_plot_colours[own];
  look->dash = look->style == GG_CHART_LINE ? dashes[(rank + l->bands) % COUNT(dashes)] : "1";
  for (size_t i = 0; i < s->n && look->style == GG_CHART_BAND; i++) look->shaded |= s->point[i].error > 0;
  look->hollow = s->n > 0;
  for (size_t i = 0; i < s->n; i++) look->hollow &= s->point[i].open;
  const int *pair = symbols[(group >= 0 ? group : rank) % COUNT(symbols)];
  look->symbol = rank < 2 ? pair[0] : crosses[(rank - 2) % COUNT(crosses)];
  look->open = rank < 2 ? pair[1] : look->symbol;
  look->size = (rank == 0 ? 0.65 : rank == 1 ? 1.1 : 0.9) * (s->n > CROWD ? 0.6 : 1);
  if (look->style == GG_CHART_POINTS && l->n_groups && l->has_md && rank == 1)
    look->colour = (look->colour >> 1 & 0x7f7f7f) + 0x7f7f7f;
}

/* "Lun 1991; Grad": a method and those that coincide with it. */
static void name_method(const legend *l, const char *method, char *text, size_t size)
{
  char name[96], plain[96];
  *text = '\0';
  for (int i = 0; method && i < l->n_methods; i++) {
    if (!is_same(l->method[i], method) && !(l->host[i] >= 0 && is_same(l->method[l->host[i]], method))) continue;
    gg_plot_method_name(l->method[i], plain, sizeof plain);
    gg_plot_text_escape(plain, name, sizeof name);
    gg_base_text_append(text, size, "%s%s", *text ? "; " : "", name);
  }
}

static const char any[] = "any";

static bool is_meant(const gg_chart_series *s, const char *method, const char *group)
{
  return !s->hidden && s->n && (method == any || is_same(s->method, method)) &&
         (group == any || is_same(s->group, group));
}

/* Add an entry for the series of a method and a group unless there is one: the look of the first of them with symbols,
 * and grey if a method has several colours. */
static void add_entry(const legend *l, const char *method, const char *group, gg_legend_entry *entry, int *n, int most)
{
  char name[200] = "";
  const gg_chart_series *shown = NULL;
  bool colours = false;
  for (int i = 0; i < l->n; i++) {
    const gg_chart_series *s = l->series[i];
    if (!is_meant(s, method, group)) continue;
    colours |= shown && group == any && shown->look.colour != s->look.colour;
    if (!shown || (shown->look.style != GG_CHART_POINTS && s->look.style == GG_CHART_POINTS)) shown = s;
  }
  if (!shown || *n == most) return;
  gg_legend_entry *e = &entry[*n];
  e->look = shown->look;
  if (colours) e->look.colour = GREY;
  const bool grouped = group && group != any;
  bool alone = grouped; /* the only method of its group needs no name */
  for (int i = 0; i < l->n; i++) alone &= !is_meant(l->series[i], any, group) || is_same(l->series[i]->method, method);
  if (method != any && !alone) name_method(l, method, name, sizeof name);
  snprintf(e->name, sizeof e->name, "%s%s%s", name, *name && grouped ? ", " : "", grouped ? group : "");
  bool is_new = *e->name;
  for (int i = 0; i < *n; i++) is_new &= strcmp(entry[i].name, e->name) != 0;
  *n += is_new;
}

/* An entry for each method of each group if these are few. Else one for each group, by colour and symbol, and one for
 * each method, by filling or dash. */
static int list_entries(const legend *l, gg_legend_entry *entry, int most)
{
  int n = 0;
  for (int i = 0; i < l->n; i++) add_entry(l, l->series[i]->method, l->series[i]->group, entry, &n, most);
  if (n <= l->n_methods + l->n_groups) return n;
  n = 0;
  for (int g = 0; g < l->n_groups; g++) add_entry(l, any, l->group[g], entry, &n, most);
  for (int m = 0; m < l->n_methods; m++) add_entry(l, l->method[m], any, entry, &n, most);
  return n;
}

int gg_plot_looks_choose(const gg_chart *c, const gg_chart_panel *own, gg_legend_entry *entry, int most)
{
  static const legend none = {0};
  legend l = none;
  collect(&l, c, own);
  find_hosts(&l);
  for (int i = 0; i < l.n; i++) set_look(&l, l.series[i], place_of(l.group, &l.n_groups, l.series[i]->group));
  const int n = list_entries(&l, entry, most);
  return own && n < 2 ? 0 : n; /* a single name is not worth a row */
}
