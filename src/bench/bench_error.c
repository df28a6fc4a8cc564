/* graingas bench error: how wrong a run of so many seconds is, and after how many seconds it is wrong by less. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench/error_state.h"
#include "plot/chart.h"
#include "plot/plot.h"

/* What is drawn, so that curves can be distinguished; each as points, and its floor as a line. */
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
  *series = (gg_chart_series){method, drawn[k].group, GG_CHART_POINTS, n, c->x, c->y, c->error, NULL, NULL};
}

static void add_line(const char *method, const char *group, double from, double to, double y_from, double y_to,
                     curve *c, gg_chart_series *series)
{
  c->x[0] = from, c->x[1] = to, c->y[0] = y_from, c->y[1] = y_to;
  *series = (gg_chart_series){method, group, GG_CHART_LINE, 2, c->x, c->y, NULL, NULL, NULL};
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

/* Of the rough states at e = 0.9: a row a quantity, a column a density. */
static gg_status draw(const gg_error_state *states, int n, const char *picture, const char *width, gg_error *err)
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

static const char seconds_caption[] =
    "Uniform shear: seconds of processor time, one core, warm-up included, until the true error (root of the mean "
    "square over seeds, against the truth of the next table) is 1, 0.1 and 0.01 %, with the way that is quickest; "
    "never: its floors are above; ?: they are not known so well. Beyond the times that were run by noise falling as "
    "1/sqrt(time after the warm-up). kurtosis_Cx: the fourth moment. first: the engine that has it first at 1 %, and "
    "how many times sooner";
static const char floors_caption[] =
    "The truth, its relative error and where it is from; what the number of grains shifts a mean by, relative, times "
    "N (dsmc and md); a split step of h mean free times, times h^2, with the order that steps 1 and 0.5 give; and "
    "single precision against double, relative";

static const double targets[] = {0.01, 0.001, 0.0001};
enum { N_TARGETS = 3, MOST_STATES = 12, SINGLE = 8, DOUBLE = 6 };

static const char *name_of(int q)
{
  return gg_common_quantity_name(gg_bench_error_course_quantity[q]);
}

/* Smooth grains have no spins. */
static bool has(const gg_error_state *s, int q)
{
  return isfinite(s->unit[q]) && s->unit[q] > 0;
}

/* -1 where no way has it: *seconds is INFINITY where that is sure of all of them, else NaN. */
static int quickest(const gg_error_state *s, gg_engine_kind engine, int q, double error, double *seconds)
{
  int best = -1;
  bool unsure = false;
  *seconds = INFINITY;
  for (int i = 0; i < GG_WAYS; i++) {
    if (!s->done[i] || gg_bench_error_methods[i].engine != engine) continue;
    const double t = gg_bench_seconds_to(s, i, q, error);
    unsure |= isnan(t);
    if (t < *seconds) *seconds = t, best = i;
  }
  if (best < 0 && unsure) *seconds = NAN;
  return best;
}

static bool is_run(const gg_error_state *s, int engine)
{
  return engine == GG_DSMC || s->done[0];
}

static void put_first(gg_bench_table *table, int row, int column, const double first[2])
{
  const int one = first[GG_MD] < first[GG_DSMC] ? GG_MD : GG_DSMC;
  const char *name = one == GG_MD ? "md" : "dsmc";
  if (isfinite(first[0]) && isfinite(first[1]))
    gg_bench_table_put(table, row, column, "%s, %.2g x", name, first[1 - one] / first[one]);
  else
    gg_bench_table_put(table, row, column, "%s",
                       isnan(first[0]) || isnan(first[1]) ? "?"
                       : isfinite(first[one])             ? name
                                                          : "-");
}

static void put_seconds(gg_bench_table *table, int row, const gg_error_state *s, int q)
{
  double first[2] = {INFINITY, INFINITY};
  for (int engine = 0; engine < 2; engine++)
    for (int k = 0; k < N_TARGETS; k++) {
      double t;
      const int way = quickest(s, (gg_engine_kind)engine, q, targets[k], &t);
      const int column = 2 + engine * N_TARGETS + k;
      if (k == 0) first[engine] = t;
      if (way < 0)
        gg_bench_table_put(table, row, column, "%s", isnan(t) ? "?" : is_run(s, engine) ? "never" : "-");
      else
        gg_bench_table_put(table, row, column, "%.2g s, N %lld%s%s", t, (long long)gg_bench_error_methods[way].n,
                           gg_bench_error_methods[way].single     ? ", single"
                           : gg_bench_error_methods[way].step > 0 ? ", split"
                                                                  : "",
                           gg_bench_error_methods[way].replicas > 1 ? ", replicas" : "");
    }
  put_first(table, row, 2 + 2 * N_TARGETS, first);
}

static json_t *number(double x)
{
  return isfinite(x) ? json_real(x) : json_null();
}

static json_t *two(double x, double y)
{
  return json_pack("[o, o]", number(x), number(y));
}

static json_t *state_json(const gg_error_state *s, int q)
{
  return json_pack("{s:f, s:f, s:b, s:s}", "phi", s->phi, "e", s->e, "rough", s->rough, "quantity", name_of(q));
}

static void add_course(json_t *rows, const gg_error_state *s, int q, int i)
{
  const gg_course *c = &s->course[i];
  json_t *row = state_json(s, q), *t = json_array(), *error = json_array(), *uncertain = json_array();
  for (int k = 0; k < c->marks; k++) {
    double of_error, e = gg_bench_error_at(s, i, q, k, &of_error);
    json_array_append_new(t, number(c->seconds[k]));
    json_array_append_new(error, number(e));
    json_array_append_new(uncertain, number(of_error));
  }
  json_t *until = json_array();
  for (int k = 0; k < N_TARGETS; k++) json_array_append_new(until, number(gg_bench_seconds_to(s, i, q, targets[k])));
  const gg_way *way = &gg_bench_error_methods[i];
  json_object_update_new(row, json_pack("{s:s, s:s, s:I, s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "way",
                                        way->name, "engine", way->engine == GG_MD ? "md" : "dsmc", "particles",
                                        (json_int_t)way->n, "seeds", c->seeds, "warmup_seconds", number(c->warmup),
                                        "error_of_a_second", number(s->noise[i][q]), "floor", number(s->floor[i][q]),
                                        "floor_stderr", number(s->shift_error[i][q]), "seconds", t, "relative_error",
                                        error, "stderr", uncertain, "seconds_to_0.01_0.001_0.0001", until));
  json_array_append_new(rows, row);
}

static void put_floors(gg_bench_table *table, int row, const gg_error_state *s, int q)
{
  const gg_by_size *md = &s->size[GG_MD][q], *dsmc = &s->size[GG_DSMC][q];
  const gg_course_end one = gg_bench_error_course_last(&s->course[DOUBLE], q),
                      other = gg_bench_error_course_last(&s->course[SINGLE], q);
  const double unit = s->unit[q], single = (other.mean - one.mean) / unit, e = hypot(one.error, other.error) / unit;
  gg_bench_table_put(table, row, 2, "%.6g", s->truth[GG_DSMC][q]);
  gg_bench_table_put(table, row, 3, "%.1e", s->truth_error[GG_DSMC][q] / unit);
  gg_bench_table_put(table, row, 4, "%s", s->source[GG_DSMC][q]);
  gg_bench_table_put(table, row, 5, "%+.2f +- %.2f", dsmc->per_grain / unit, dsmc->per_grain_error / unit);
  if (s->done[0]) gg_bench_table_put(table, row, 6, "%+.1f +- %.1f", md->per_grain / unit, md->per_grain_error / unit);
  gg_bench_table_put(table, row, 7, "%+.4f +- %.4f", s->step_coefficient[q], s->step_coefficient_error[q]);
  if (isfinite(s->step_order[q])) gg_bench_table_put(table, row, 8, "%.1f", s->step_order[q]);
  gg_bench_table_put(table, row, 9, "%+.1e +- %.0e", single, e);
  json_t *json = state_json(s, q);
  const double coefficient = s->step_coefficient[q], uncertain = s->step_coefficient_error[q];
  json_object_update_new(
      json, json_pack("{s:o, s:o, s:s, s:o, s:o, s:o, s:o, s:o}", "truth", number(s->truth[GG_DSMC][q]), "truth_error",
                      number(s->truth_error[GG_DSMC][q]), "source", s->source[GG_DSMC][q], "dsmc_times_N",
                      two(dsmc->per_grain / unit, dsmc->per_grain_error / unit), "md_times_N",
                      two(md->per_grain / unit, md->per_grain_error / unit), "step", two(coefficient, uncertain),
                      "step_order", number(s->step_order[q]), "single", two(single, e)));
  json_array_append_new(table->rows, json);
}

static int row_of(gg_bench_table *table, const gg_error_state *s, int q)
{
  const int row = gg_bench_table_row(table, "phi %g e %g %s", s->phi, s->e, s->rough ? "rough" : "smooth");
  gg_bench_table_put(table, row, 1, "%s", name_of(q));
  return row;
}

static void note(gg_bench_table *seconds, gg_bench_table *floors, const gg_error_state *s)
{
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    if (!has(s, q)) continue;
    put_seconds(seconds, row_of(seconds, s, q), s, q);
    put_floors(floors, row_of(floors, s, q), s, q);
    for (int i = 0; i < GG_WAYS; i++)
      if (s->done[i]) add_course(seconds->rows, s, q, i);
  }
}

static gg_status new_tables(gg_bench *b, gg_bench_table *table[2], gg_error *err)
{
  static const char *const head[] = {"truth", "its error", "from", "1/N dsmc", "1/N md", "step h^2", "order", "single"};
  table[0] = gg_bench_table_new(b, "seconds", seconds_caption, 2, err);
  table[1] = gg_bench_table_new(b, "floors", floors_caption, 2, err);
  if (!table[0] || !table[1]) return GG_FAILED;
  for (int k = 0; k < 2; k++) {
    gg_bench_table_column(table[k], false, "shear");
    gg_bench_table_column(table[k], false, "quantity");
  }
  for (int engine = 0; engine < 2; engine++)
    for (int k = 0; k < N_TARGETS; k++)
      gg_bench_table_column(table[0], true, "%s %g %%", engine == GG_MD ? "md" : "dsmc", 100 * targets[k]);
  gg_bench_table_column(table[0], false, "first");
  for (int k = 0; k < 8; k++) gg_bench_table_column(table[1], k != 2, "%s", head[k]);
  return GG_OK;
}

/* Quick: the rough state of both densities above 0 at e = 0.9, and the smooth one at 0.01. */
static int list_states(gg_error_state *s, bool quick)
{
  static const double phi[] = {0, 0.01, 0.3}, e[] = {0.9, 0.7};
  int n = 0;
  for (int rough = 1; rough >= 0; rough--)
    for (int k = 0; k < 2; k++)
      for (int p = 0; p < 3; p++) {
        if (quick && (k == 1 || p == 0 || (!rough && p == 2))) continue;
        s[n].phi = phi[p], s[n].e = e[k], s[n++].rough = rough;
      }
  return n;
}

static gg_status measure(gg_bench *b, gg_error_state *s, gg_error *err)
{
  const bool quick = b->options->quick;
  const int n = list_states(s, quick);
  if (b->options->picture)
    GG_TRY(gg_plot_paper_check(b->options->picture, b->options->width, err)); /* before it has taken an hour */
  gg_bench_table *table[2];
  GG_TRY(new_tables(b, table, err));
  for (int i = 0; i < n; i++) {
    GG_TRY(gg_bench_error_state_measure(b, &s[i], quick ? 4 : 6, gg_bench_seconds(b, quick ? 0.3 : 1.5), err));
    note(table[0], table[1], &s[i]);
    gg_bench_tell(b, "phi %g e %g %s done", s[i].phi, s[i].e, s[i].rough ? "rough" : "smooth");
  }
  b->measured = true;
  return b->options->picture ? draw(s, n, b->options->picture, b->options->width, err) : GG_OK;
}

gg_status gg_bench_error(gg_bench *b, gg_error *err)
{
  gg_error_state *s = gg_base_array_new(MOST_STATES, sizeof *s, err);
  if (!s) return GG_FAILED;
  gg_status status = measure(b, s, err);
  free(s);
  return status;
}
