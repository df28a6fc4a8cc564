/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/chart_styles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/axis.h"
#include "plot/plot.h"

/* Symbols in pairs, filled and open: a run that is not steady is open. The first two stand for md and dsmc where there
 * are no groups. */
static const int symbols[][2] = {{7, 6}, {5, 4}, {9, 8}, {13, 12}, {11, 10}, {15, 14}};
static const int crosses[] = {2, 1, 3, 8, 10, 12, 4, 14}; /* of what is measured by neither engine */
static const char *const dashes[] = {"1",         "(10,4)",         "(2.5,3)",      "(10,3,2.5,3)",
                                     "(18,4)",    "(10,3,2,3,2,3)", "(5,3)",        "(18,3,5,3)",
                                     "(1.5,1.5)", "(18,3,2,3)",     "(5,2,2,2,2,2)"};
static const char grey[] = "#444444";
enum { CROWD = 50 }; /* more points are drawn smaller */
enum { N_SYMBOLS = sizeof symbols / sizeof *symbols, N_DASHES = sizeof dashes / sizeof *dashes };
enum { N_CROSSES = sizeof crosses / sizeof *crosses };

static bool is_same(const char *a, const char *b)
{
  return a == b || (a && b && strcmp(a, b) == 0);
}

static bool is_engine(const char *method)
{
  return is_same(method, "md") || is_same(method, "dsmc");
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
  if (i < 0 && names->n == GG_STYLES_MOST) return;
  if (i < 0) names->first[i = names->n++] = s, names->host[i] = -1;
  names->points[i] |= s->style == GG_CHART_POINTS;
  names->bands |= s->style == GG_CHART_BAND;
}

/* Less than a pixel apart. */
static bool coincide(const gg_chart_series *a, const gg_chart_series *b, gg_axis y)
{
  bool same = a->n == b->n && is_same(a->group, b->group) && a->style == b->style;
  for (size_t i = 0; same && i < a->n; i++) {
    double apart = gg_plot_axis_share(y, a->y[i]) - gg_plot_axis_share(y, b->y[i]);
    same = a->x[i] == b->x[i] && (fabs(apart) < 0.003 || (isnan(a->y[i]) && isnan(b->y[i])));
  }
  return same;
}

/* Does each series of one method have its like in those of the other? */
static bool coincide_in(const gg_chart_panel *p, const char *one, const char *other)
{
  gg_axis x, y;
  int left = 0;
  gg_plot_axis_of_panel(p, &x, &y);
  for (size_t i = 0; i < p->n; i++) {
    bool found = !is_same(p->series[i].method, one);
    left += is_same(p->series[i].method, other) - !found;
    for (size_t k = 0; k < p->n && !found; k++)
      found = is_same(p->series[k].method, other) && coincide(&p->series[i], &p->series[k], y);
    if (!found) return false;
  }
  return left == 0;
}

/* The panels of one legend. */
static bool is_of(const gg_chart_panel *panel, const gg_chart_panel *own)
{
  return own ? panel == own : !panel->own_legend;
}

static void find_hosts(const gg_chart *c, const gg_chart_panel *own, gg_chart_names *methods)
{
  for (int i = 1; i < methods->n; i++)
    for (int k = 0; k < i && methods->host[i] < 0; k++) {
      const char *one = methods->first[i]->method, *other = methods->first[k]->method;
      bool same = methods->host[k] < 0 && !is_engine(one) && !is_engine(other);
      for (size_t p = 0; p < c->n && same; p++)
        if (is_of(&c->panel[p], own)) same = coincide_in(&c->panel[p], one, other);
      if (same) methods->host[i] = k;
    }
}

gg_chart_styles gg_plot_styles_of(const gg_chart *c, const gg_chart_panel *own)
{
  gg_chart_styles styles = {.own = own != NULL};
  for (size_t p = 0; p < c->n; p++)
    for (size_t k = 0; k < c->panel[p].n && is_of(&c->panel[p], own); k++) {
      note(&styles.method, &c->panel[p].series[k], true);
      note(&styles.group, &c->panel[p].series[k], false);
    }
  find_hosts(c, own, &styles.method);
  return styles;
}

bool gg_plot_styles_shows(const gg_chart_styles *l, const gg_chart_series *s)
{
  int i = s->method ? find(&l->method, s->method, true) : -1;
  return i < 0 || l->method.host[i] < 0;
}

/* Among the methods of its kind; of those that measure, md and dsmc have their places whether they are there or not. */
static int place_of(const gg_chart_styles *l, const gg_chart_series *s)
{
  bool line = s->style == GG_CHART_LINE;
  int place = line ? 0 : 2;
  if (!line && (!s->method || is_same(s->method, "md"))) return 0;
  if (!line && is_same(s->method, "dsmc")) return 1;
  for (int i = 0; i < l->method.n; i++) {
    const gg_chart_series *other = l->method.first[i];
    if (is_same(other->method, s->method)) return place;
    bool counts = (other->style == GG_CHART_LINE) == line && (line || !is_engine(other->method));
    place += counts && l->method.host[i] < 0;
  }
  return place;
}

const char *gg_plot_styles_colour(const gg_chart_styles *l, const gg_chart_series *s)
{
  int group = s->group ? find(&l->group, s->group, false) : -1;
  if (group >= 0) return gg_plot_colours[group % GG_PLOT_COLOURS];
  if (l->group.n) return grey;
  int place = place_of(l, s), from = s->style == GG_CHART_LINE ? 2 : 0;
  return gg_plot_colours[place < 2 && !from ? place : 2 + (place + from - 2) % (GG_PLOT_COLOURS - 2)];
}

/* md is small, so that dsmc shows around it where both agree. */
static void print_symbol(FILE *s, int symbol, int place, double size, bool open)
{
  if (place >= 2)
    fprintf(s, "pt %d ps %g", crosses[(place - 2) % N_CROSSES], 0.9 * size);
  else
    fprintf(s, "pt %d ps %g", symbols[symbol % N_SYMBOLS][open], (place ? 1.1 : 0.65) * size);
}

/* Halfway to white: dsmc beside md in the colour of one group. */
static unsigned pale(const char *colour)
{
  return (((unsigned)strtoul(colour + 1, NULL, 16) & 0xfefefe) >> 1) + 0x7f7f7f;
}

void gg_plot_styles_print(FILE *s, const gg_chart_styles *l, const gg_chart_series *series, bool open)
{
  int place = place_of(l, series), group = series->group ? find(&l->group, series->group, false) : -1;
  if (series->style == GG_CHART_BAND) fprintf(s, "lw 1.5 dt 1");
  if (series->style == GG_CHART_LINE)
    fprintf(s, "lw 1.5 dt %s", dashes[(place + (l->method.bands || l->group.bands)) % N_DASHES]);
  if (series->style == GG_CHART_POINTS) {
    print_symbol(s, group >= 0 ? group : place < 2 ? place : 0, place, series->n > CROWD ? 0.6 : 1, open);
    fprintf(s, " lw 1.2");
  }
  const char *colour = gg_plot_styles_colour(l, series);
  if (series->style == GG_CHART_POINTS && l->group.n && place == 1 && !open)
    fprintf(s, " lc rgb '#%06x'", pale(colour));
  else
    fprintf(s, " lc rgb '%s'", colour);
}

/* What stands for a group: its points if it has some, else a line through, whatever its methods are. */
static gg_chart_series sample_of(const gg_chart_names *names, int i, bool group)
{
  gg_chart_series s = *names->first[i];
  s.n = 0;
  if (!group) s.group = NULL;
  if (group) s.method = "md";
  if (names->points[i])
    s.style = GG_CHART_POINTS;
  else if (group)
    s.style = GG_CHART_BAND;
  return s;
}

/* A method, and those that coincide with it. */
static void name_of(const gg_chart_names *methods, int i, char *text, size_t size)
{
  char name[96];
  gg_plot_method_name(methods->first[i]->method, text, size);
  for (int k = i + 1; k < methods->n; k++) {
    if (methods->host[k] != i) continue;
    gg_plot_method_name(methods->first[k]->method, name, sizeof name);
    size_t used = strlen(text);
    snprintf(text + used, size - used, "; %s", name);
  }
}

/* Is it in the legend? Not what is drawn as another, and not the one method that measured all groups of a panel. */
static bool is_named(const gg_chart_styles *l, int i)
{
  bool alone = l->own && l->group.n && l->method.first[i]->style != GG_CHART_LINE;
  for (int k = 0; k < l->method.n && alone; k++) alone = k == i || l->method.first[k]->style == GG_CHART_LINE;
  return l->method.host[i] < 0 && !alone;
}

static void print_entry(FILE *s, const gg_chart_styles *l, const gg_chart_series *sample)
{
  fprintf(s, ", keyentry with %s ", sample->style == GG_CHART_POINTS ? "points" : "lines");
  gg_plot_styles_print(s, l, sample, false);
  fprintf(s, " title '");
}

void gg_plot_styles_legend_print(FILE *s, const gg_chart_styles *l)
{
  char name[256];
  for (int i = 0; i < l->group.n; i++) {
    gg_chart_series sample = sample_of(&l->group, i, true);
    print_entry(s, l, &sample);
    gg_plot_text_print(s, sample.group);
    fputc('\'', s);
  }
  for (int i = 0; i < l->method.n; i++) {
    gg_chart_series sample = sample_of(&l->method, i, false);
    if (!is_named(l, i)) continue;
    print_entry(s, l, &sample);
    name_of(&l->method, i, name, sizeof name);
    gg_plot_text_print_plain(s, name);
    fputc('\'', s);
  }
}

double gg_plot_text_width(const char *text)
{
  int n = 0;
  for (const char *c = text; *c; c++) n += (*c & 0xc0) != 0x80 && !strchr("{}^_\\", *c);
  return 7.2 * n;
}

int gg_plot_styles_legend_rows(const gg_chart_styles *l, double width)
{
  const double sample = 44;
  double longest = 0;
  int n = l->group.n;
  char name[256];
  for (int i = 0; i < l->group.n; i++) longest = fmax(longest, gg_plot_text_width(l->group.first[i]->group));
  for (int i = 0; i < l->method.n; i++) {
    if (!is_named(l, i)) continue;
    name_of(&l->method, i, name, sizeof name);
    longest = fmax(longest, gg_plot_text_width(name));
    n++;
  }
  if (l->own && n < 2) return 0; /* one name is not worth a line over the panel */
  int columns = (int)fmax(1, floor(width / (longest + sample)));
  return (n + columns - 1) / columns;
}
