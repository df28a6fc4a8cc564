/* The legend of a chart. gnuplot's own keeps to the width of one panel. */
#include <string.h>

#include "plot/chart_styles.h"
#include "plot/plot.h"

/* Pixels. */
enum { ROW = 19, SAMPLE = 34, GAP = 8, BETWEEN = 26, MARGIN = 20 };
static const double letter = 7.4;

static int width_of(const char *text)
{
  int n = 0;
  for (const char *c = text; *c; c++) n += (*c & 0xc0) != 0x80 && !strchr("{}^_", *c);
  return n;
}

/* Groups and methods have rows of their own. */
static int row_of(const gg_chart_legend *g, int i)
{
  int before = (g->groups + g->columns - 1) / g->columns;
  return i < g->groups ? i / g->columns : before + (i - g->groups) / g->columns;
}

gg_chart_legend gg_plot_chart_legend_in(const gg_chart_looks *l, int width)
{
  int longest = 0;
  for (int i = 0; i < l->group.n; i++) {
    int n = width_of(l->group.first[i]->group);
    if (n > longest) longest = n;
  }
  for (int i = 0; i < l->method.n; i++) {
    int n = (int)strlen(l->method.first[i]->method);
    if (n > longest) longest = n;
  }
  gg_chart_legend g = {.groups = l->group.n,
                       .entries = l->group.n + l->method.n,
                       .column_width = SAMPLE + GAP + BETWEEN + (int)(letter * longest)};
  g.columns = (width - 2 * MARGIN) / g.column_width;
  int most = l->group.n > l->method.n ? l->group.n : l->method.n;
  if (g.columns > most) g.columns = most;
  if (g.columns < 1) g.columns = 1;
  g.height = g.entries ? (row_of(&g, g.entries - 1) + 1) * ROW + GAP : 0;
  return g;
}

static int column_of(const gg_chart_legend *g, int i)
{
  return (i < g->groups ? i : i - g->groups) % g->columns;
}

typedef struct place {
  double x, y; /* pixels from below */
} place;

static place place_of(const gg_chart_legend *g, int i, int top, const int page[2])
{
  double left = (page[0] - g->columns * g->column_width + BETWEEN) / 2.0;
  return (place){left + column_of(g, i) * g->column_width, page[1] - top - ROW * (row_of(g, i) + 0.5)};
}

/* What stands for an entry: a group by its points if it has some, else by a line through, whatever its methods are. */
static gg_chart_series sample_of(const gg_chart_looks *l, int i)
{
  bool group = i < l->group.n;
  gg_chart_series s = group ? *l->group.first[i] : *l->method.first[i - l->group.n];
  s.n = 0;
  if (!group) s.group = NULL;
  if (group) s.method = "md";
  if (group) s.style = l->group.points[i] ? GG_CHART_POINTS : GG_CHART_BAND;
  return s;
}

static void print_sample(FILE *s, int i, gg_chart_style style, place p)
{
  fprintf(s, "$legend%d << EOD\n", i);
  if (style == GG_CHART_POINTS)
    fprintf(s, "%g %g\n", p.x + SAMPLE / 2.0, p.y);
  else
    fprintf(s, "%g %g\n%g %g\n", p.x, p.y, p.x + SAMPLE, p.y);
  fprintf(s, "EOD\n");
}

static void print_name(FILE *s, const gg_chart_looks *l, int i, place p)
{
  fprintf(s, "set label '");
  if (i < l->group.n)
    gg_plot_text(s, l->group.first[i]->group);
  else
    gg_plot_plain_text(s, l->method.first[i - l->group.n]->method);
  fprintf(s, "' at %g,%g left\n", p.x + SAMPLE + GAP, p.y);
}

/* A plot over the whole page, in pixels. */
void gg_plot_chart_print_legend(FILE *s, const gg_chart_looks *l, const gg_chart_legend *g, int top, const int page[2])
{
  gg_plot_place(s, (gg_panel){0, 1, 0, 1});
  fprintf(s,
          "unset border\nunset tics\nunset grid\nunset key\nunset xlabel\nunset ylabel\nset xrange [0:%d]\n"
          "set yrange [0:%d]\n",
          page[0], page[1]);
  for (int i = 0; i < g->entries; i++) {
    place p = place_of(g, i, top, page);
    print_sample(s, i, sample_of(l, i).style, p);
    print_name(s, l, i, p);
  }
  fprintf(s, "plot NaN notitle");
  for (int i = 0; i < g->entries; i++) {
    gg_chart_series sample = sample_of(l, i);
    fprintf(s, ", $legend%d using 1:2 with %s ", i, sample.style == GG_CHART_POINTS ? "points" : "lines");
    gg_plot_chart_print_look(s, l, &sample);
    fprintf(s, " notitle");
  }
  fprintf(s, "\n");
}
