#include "bench/error_chart.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "plot/chart.h"

/* What is drawn, so that curves can be told apart; each as points, and its floor as a line. */
static const struct {
  int way;
  const char *group;
} drawn[] = {{0, "N 250"},   {2, "N 4000"}, {3, "N 100"},  {5, "N 2000"},
             {7, "N 80000"}, {8, "single"}, {9, "step 1"}, {11, "5 replicas"}};
enum { DRAWN = sizeof drawn / sizeof *drawn, SERIES = 2 * DRAWN + 1, MOST_COLUMNS = 3 };
enum { MOST_PANELS = MOST_COLUMNS * GG_COURSE_QUANTITIES };

typedef struct curve {
  double x[GG_COURSE_MARKS], y[GG_COURSE_MARKS], error[GG_COURSE_MARKS];
} curve;

typedef struct page {
  char title[MOST_PANELS][64];
  gg_chart_panel panel[MOST_PANELS];
  gg_chart_series series[MOST_PANELS][SERIES];
  curve curve[MOST_PANELS][SERIES];
} page;

/* Marks at least twice as far as the last one drawn. */
static void add_points(const gg_error_state *s, int q, int k, curve *c, gg_chart_series *series)
{
  const gg_course *course = &s->course[drawn[k].way];
  size_t n = 0;
  for (int i = 0; i < course->marks; i++) {
    if (n && course->seconds[i] < 2 * c->x[n - 1]) continue;
    c->x[n] = course->seconds[i];
    c->y[n] = gg_bench_error_at(s, drawn[k].way, q, i, &c->error[n]);
    n++;
  }
  const char *method = gg_bench_error_methods[drawn[k].way].engine == GG_MD ? "md" : "dsmc";
  *series = (gg_chart_series){method, drawn[k].group, GG_CHART_POINTS, n, c->x, c->y, c->error, NULL};
}

static void add_line(const char *method, const char *group, double from, double to, double y_from, double y_to,
                     curve *c, gg_chart_series *series)
{
  c->x[0] = from, c->x[1] = to, c->y[0] = y_from, c->y[1] = y_to;
  *series = (gg_chart_series){method, group, GG_CHART_LINE, 2, c->x, c->y, NULL, NULL};
}

static void fill(const gg_error_state *s, int q, int i, page *p)
{
  size_t n = 0;
  double from = INFINITY, to = 0;
  for (int k = 0; k < DRAWN; k++) {
    const gg_course *c = &s->course[drawn[k].way];
    if (!s->done[drawn[k].way]) continue;
    from = fmin(from, c->seconds[0]), to = fmax(to, c->seconds[c->marks - 1]);
    add_points(s, q, k, &p->curve[i][n], &p->series[i][n]);
    n++;
  }
  const double noise = s->noise[7][q];
  add_line("1/√time", NULL, from, to, noise / sqrt(from), noise / sqrt(to), &p->curve[i][n], &p->series[i][n]);
  n++;
  for (int k = 0; k < DRAWN; k++) {
    const double floor = s->floor[drawn[k].way][q];
    if (!s->done[drawn[k].way] || !(floor > noise / sqrt(to))) continue;
    add_line("floor", drawn[k].group, from, to, floor, floor, &p->curve[i][n], &p->series[i][n]);
    n++;
  }
  char symbol[32];
  gg_common_quantity_symbol(gg_bench_error_course_quantity[q], symbol, sizeof symbol);
  snprintf(p->title[i], sizeof p->title[i], "%s, φ = %g", symbol, s->phi);
  p->panel[i] = (gg_chart_panel){.title = p->title[i],
                                 .x = {"processor time", "s", true, 0, 0},
                                 .y = {"relative error", NULL, true, 0, 0},
                                 .n = n,
                                 .series = p->series[i]};
}

gg_status gg_bench_error_chart_draw(const gg_error_state *states, int n, const char *picture, const char *width,
                                    gg_error *err)
{
  page *p = gg_base_array_new(1, sizeof *p, err);
  if (!p) return GG_FAILED;
  int panels = 0, columns = 0;
  for (int i = 0; i < n; i++) columns += states[i].rough && states[i].e == 0.9;
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++)
    for (int i = 0; i < n; i++)
      if (states[i].rough && states[i].e == 0.9 && panels < MOST_PANELS) fill(&states[i], q, panels++, p);
  gg_chart chart = {.title = "Uniform shear of rough grains, e = 0.9, β = 0",
                    .n = (size_t)panels,
                    .panel = p->panel,
                    .columns = columns};
  gg_status status = gg_plot_chart_draw(&chart, picture, width, err);
  free(p);
  return status;
}
