/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench error: error of means against processor time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench/error_state.h"
#include "plot/chart.h"
#include "plot/plot.h"

enum { MOST_STATES = 16 };

/* Expected error of a method after `seconds`: noise and floor combined; INFINITY during the warm-up. */
static double expected(const gg_error_state *s, int way, int q, double seconds)
{
  const gg_course *c = &s->course[way];
  return seconds < c->seconds[0] ? INFINITY : hypot(s->floor[way][q], s->noise[way][q] / sqrt(seconds - c->warmup));
}

static int best_at(const gg_error_state *s, gg_engine_kind engine, int q, double seconds)
{
  int best = -1;
  for (int i = 0; i < GG_ERROR_METHODS; i++) {
    if (!s->done[i] || gg_bench_error_methods[i].engine != engine ||
        seconds > s->course[i].seconds[s->course[i].marks - 1] * 1.01)
      continue;
    if (best < 0 || expected(s, i, q, seconds) < expected(s, best, q, seconds)) best = i;
  }
  return best >= 0 && isfinite(expected(s, best, q, seconds)) ? best : -1;
}

/* Points of an engine's curve: at times that differ by factors of about 2, the error of the method that is best then.
 */
static void add_engine(gg_chart *c, const gg_error_state *s, gg_engine_kind engine, int q, double to)
{
  gg_chart_series *series = gg_plot_chart_series(c, gg_common_engine_of((int)engine)->name, NULL, GG_CHART_POINTS);
  double last = INFINITY, error;
  size_t n = 0;
  for (double t = to; n < GG_COURSE_MARKS && t > 1e-6; t /= 2) {
    const int way = best_at(s, engine, q, t);
    int mark = 0;
    if (way < 0) continue;
    const gg_course *course = &s->course[way];
    while (mark + 1 < course->marks && course->seconds[mark + 1] <= 1.01 * t) mark++;
    if (course->seconds[mark] > 0.7 * last) continue;
    last = course->seconds[mark], n++;
    const double y = gg_bench_error_at(s, way, q, mark, &error);
    gg_plot_chart_point(c, series, (gg_chart_point){last, y, error, NAN, false});
  }
}

/* A panel a quantity: error against time of the best md and the best dsmc, and theories, which take no time, as bars at
 * their error. */
static void add_panel(gg_chart *c, const gg_error_state *s, int q)
{
  char name[32];
  gg_chart_panel *p = gg_plot_chart_panel(c);
  double ends[2] = {INFINITY, 0};
  if (!p) return;
  for (int k = 0; k < GG_ERROR_METHODS; k++) {
    const gg_course *course = &s->course[k];
    if (s->done[k])
      ends[0] = fmin(ends[0], course->seconds[0]), ends[1] = fmax(ends[1], course->seconds[course->marks - 1]);
  }
  for (int engine = 0; engine < 2; engine++) add_engine(c, s, (gg_engine_kind)engine, q, ends[1]);
  for (int k = 0; k < s->n_theories; k++) {
    if (!(s->theory[k].error[q] > 0)) continue;
    gg_chart_series *series = gg_plot_chart_series(c, s->theory[k].name, NULL, GG_CHART_LINE);
    for (int side = 0; side < 2; side++)
      gg_plot_chart_point(c, series, (gg_chart_point){ends[side], s->theory[k].error[q], NAN, NAN, false});
  }
  gg_common_quantity_enhanced(gg_bench_error_quantities(s->flow)[q], name, sizeof name);
  p->title = gg_plot_chart_text(c, "%s", name);
  p->x = (gg_chart_axis){"processor time", "s", true, 0, 0};
  p->y = (gg_chart_axis){"relative error", NULL, true, 0, 0};
}

/* Whether the quantity exists; smooth grains have no spins. */
static bool has(const gg_error_state *s, int q)
{
  return isfinite(s->unit[q]) && s->unit[q] > 0;
}

/* Draw the picture of a state: for x.svg and the state "phi 0.3, e 0.9, rough, shear" x_phi-0.3-e-0.9-rough-shear.svg.
 */
static gg_status draw(const gg_bench *b, const gg_error_state *s, gg_error *err)
{
  char word[GG_BENCH_CELL], title[GG_BENCH_CELL];
  size_t n = 0;
  gg_plot_paper paper;
  GG_TRY(gg_plot_paper_choose(&paper, b->options->picture, NULL, b->options->width, err));
  gg_bench_error_state_name(s, title, sizeof title);
  for (const char *c = title; *c; c++)
    if (*c != ',') word[n++] = *c == ' ' ? '-' : *c;
  word[n] = '\0';
  GG_FREED char *picture = gg_plot_page_name(b->options->picture, "", word, &paper);
  gg_chart *c = gg_plot_chart_new();
  for (int q = 0; c && q < GG_COURSE_QUANTITIES; q++)
    if (has(s, q)) add_panel(c, s, q);
  if (c) c->title = title, c->lacks |= !picture;
  return c ? gg_plot_chart_finish(c, &paper, picture, err) : gg_base_out_of_memory(err);
}

static const char seconds_caption[] =
    "Seconds of processor time, one core, warm-up included, until the true error (root of the mean square over seeds, "
    "against the truth of the last table) is 1, 0.1 and 0.01 %, with the way that is quickest; never: its floors are "
    "above; ?: they are not known so well. Beyond the times that were run by noise falling as 1/sqrt(time after the "
    "warm-up). kurtosis_Cx: the fourth moment. first: the engine that has it first at 1 %, and how many times sooner";
static const char floors_caption[] =
    "The truth, its relative error and where it is from; what the number of grains shifts a mean by, relative, times "
    "N (dsmc and md); a split step of h mean free times, times h^2, with the order that steps 1 and 0.5 give; and "
    "single precision against double, relative";

static const double targets[] = {0.01, 0.001, 0.0001};
enum { N_TARGETS = 3, SINGLE = 8, DOUBLE = 6 }; /* methods of 10 000 grains that differ in precision alone */

static const char *name_of(const gg_error_state *s, int q)
{
  return gg_common_quantity_name(gg_bench_error_quantities(s->flow)[q]);
}

/* The quickest method to an error, with its *seconds; -1 if none reaches it. Then *seconds is INFINITY if all floors
 * are certainly above, otherwise NaN. */
static int quickest(const gg_error_state *s, gg_engine_kind engine, int q, double error, double *seconds)
{
  int best = -1;
  bool unsure = false;
  *seconds = INFINITY;
  for (int i = 0; i < GG_ERROR_METHODS; i++) {
    if (!s->done[i] || gg_bench_error_methods[i].engine != engine) continue;
    const double t = gg_bench_seconds_to(s, i, q, error);
    unsure |= isnan(t);
    if (t < *seconds) *seconds = t, best = i;
  }
  if (best < 0 && unsure) *seconds = NAN;
  return best;
}

static void put_first(gg_bench_table *table, int row, int column, const double first[2])
{
  const int one = first[GG_MD] < first[GG_DSMC] ? GG_MD : GG_DSMC;
  const char *name = gg_common_engine_of(one)->name;
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
      const int column = 1 + engine * N_TARGETS + k;
      if (k == 0) first[engine] = t;
      if (way < 0)
        gg_bench_table_put(table, row, column, "%s", isnan(t) ? "?" : engine == GG_DSMC || s->done[0] ? "never" : "-");
      else
        gg_bench_table_put(table, row, column, "%.2g s, N %lld%s%s", t, (long long)gg_bench_error_methods[way].n,
                           gg_bench_error_methods[way].single     ? ", single"
                           : gg_bench_error_methods[way].step > 0 ? ", split"
                                                                  : "",
                           gg_bench_error_methods[way].replicas > 1 ? ", replicas" : "");
    }
  put_first(table, row, 1 + 2 * N_TARGETS, first);
}

static json_t *two(double x, double y)
{
  return json_pack("[o, o]", gg_io_json_finite(x), gg_io_json_finite(y));
}

static void add_row(const gg_bench *b, gg_bench_table *table, const gg_error_state *s, int q, const char *by,
                    const char *unit, double value, int seeds, json_t *more)
{
  gg_bench_table_add(b, table, (gg_bench_value){unit, value, NAN, NAN, seeds, 1}, more,
                     "{s:s, s:f, s:f, s:b, s:s, s:s}", "flow", gg_flow_of(s->flow)->word, "phi", s->phi, "e", s->e,
                     "rough", s->rough, "quantity", name_of(s, q), "way", by);
}

static void add_course(const gg_bench *b, gg_bench_table *table, const gg_error_state *s, int q, int i)
{
  const gg_course *c = &s->course[i];
  json_t *t = json_array(), *error = json_array(), *uncertain = json_array();
  for (int k = 0; k < c->marks; k++) {
    double of_error, e = gg_bench_error_at(s, i, q, k, &of_error);
    json_array_append_new(t, gg_io_json_finite(c->seconds[k]));
    json_array_append_new(error, gg_io_json_finite(e));
    json_array_append_new(uncertain, gg_io_json_finite(of_error));
  }
  json_t *until = json_array();
  for (int k = 0; k < N_TARGETS; k++)
    json_array_append_new(until, gg_io_json_finite(gg_bench_seconds_to(s, i, q, targets[k])));
  const gg_error_method *way = &gg_bench_error_methods[i];
  json_t *course =
      json_pack("{s:s, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "engine",
                gg_common_engine_of((int)way->engine)->name, "particles", (json_int_t)way->n, "warmup_seconds",
                gg_io_json_finite(c->warmup), "error_of_a_second", gg_io_json_finite(s->noise[i][q]), "floor",
                gg_io_json_finite(s->floor[i][q]), "floor_stderr", gg_io_json_finite(s->shift_error[i][q]), "seconds",
                t, "relative_error", error, "stderr", uncertain, "seconds_to_0.01_0.001_0.0001", until);
  add_row(b, table, s, q, way->name, "CPU seconds to an error of 1 %", gg_bench_seconds_to(s, i, q, targets[0]),
          c->seeds, course);
}

static void put_floors(const gg_bench *b, gg_bench_table *table, int row, const gg_error_state *s, int q)
{
  const gg_by_size *md = &s->size[GG_MD][q], *dsmc = &s->size[GG_DSMC][q];
  const gg_course_end one = gg_statistics_course_last(&s->course[DOUBLE], q),
                      other = gg_statistics_course_last(&s->course[SINGLE], q);
  const double unit = s->unit[q], single = (other.mean - one.mean) / unit, e = hypot(one.error, other.error) / unit;
  gg_bench_table_put(table, row, 2, "%.6g", s->truth[GG_DSMC][q]);
  gg_bench_table_put(table, row, 3, "%.1e", s->truth_error[GG_DSMC][q] / unit);
  gg_bench_table_put(table, row, 4, "%s", s->source[GG_DSMC][q]);
  gg_bench_table_put(table, row, 5, "%+.2f +- %.2f", dsmc->per_grain / unit, dsmc->per_grain_error / unit);
  if (s->done[0]) gg_bench_table_put(table, row, 6, "%+.1f +- %.1f", md->per_grain / unit, md->per_grain_error / unit);
  gg_bench_table_put(table, row, 7, "%+.4f +- %.4f", s->step_coefficient[q], s->step_coefficient_error[q]);
  if (isfinite(s->step_order[q])) gg_bench_table_put(table, row, 8, "%.1f", s->step_order[q]);
  gg_bench_table_put(table, row, 9, "%+.1e +- %.0e", single, e);
  const double coefficient = s->step_coefficient[q], uncertain = s->step_coefficient_error[q];
  json_t *floors =
      json_pack("{s:o, s:o, s:s, s:o, s:o, s:o, s:o, s:o}", "truth", gg_io_json_finite(s->truth[GG_DSMC][q]),
                "truth_error", gg_io_json_finite(s->truth_error[GG_DSMC][q]), "source", s->source[GG_DSMC][q],
                "dsmc_times_N", two(dsmc->per_grain / unit, dsmc->per_grain_error / unit), "md_times_N",
                two(md->per_grain / unit, md->per_grain_error / unit), "step", two(coefficient, uncertain),
                "step_order", gg_io_json_finite(s->step_order[q]), "single", two(single, e));
  add_row(b, table, s, q, s->source[GG_DSMC][q], "relative error of the truth", s->truth_error[GG_DSMC][q] / unit, 1,
          floors);
}

static gg_bench_table *new_seconds(gg_bench *b, const gg_error_state *s, bool first, gg_error *err)
{
  gg_bench_table *t = gg_bench_table_new(b, "seconds", first ? seconds_caption : NULL, 1, err);
  if (!t) return NULL;
  gg_bench_error_state_name(s, t->title, sizeof t->title);
  gg_bench_table_column(t, false, "quantity");
  for (int engine = 0; engine < 2; engine++)
    for (int k = 0; k < N_TARGETS; k++)
      gg_bench_table_column(t, true, "%s %g %%", gg_common_engine_of(engine)->name, 100 * targets[k]);
  gg_bench_table_column(t, false, "first");
  return t;
}

/* Add the table of seconds of a state. */
static gg_status put_state(gg_bench *b, const gg_error_state *s, bool first, gg_error *err)
{
  gg_bench_table *seconds = new_seconds(b, s, first, err);
  if (!seconds) return GG_FAILED;
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    if (!has(s, q)) continue;
    put_seconds(seconds, gg_bench_table_row(seconds, "%s", name_of(s, q)), s, q);
    for (int i = 0; i < GG_ERROR_METHODS; i++)
      if (s->done[i]) add_course(b, seconds, s, q, i);
  }
  return GG_OK;
}

static void put_state_floors(const gg_bench *b, gg_bench_table *floors, const gg_error_state *s)
{
  char name[GG_BENCH_CELL];
  gg_bench_error_state_name(s, name, sizeof name);
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    if (!has(s, q)) continue;
    const int row = gg_bench_table_row(floors, "%s", name);
    gg_bench_table_put(floors, row, 1, "%s", name_of(s, q));
    put_floors(b, floors, row, s, q);
  }
}

/* Set the states. Quick: rough shear at e = 0.9 and both densities above 0, smooth shear and rough cooling at 0.01. */
static int list_states(gg_error_state *s, bool quick)
{
  static const double phi[] = {0, 0.01, 0.3}, e[] = {0.9, 0.7};
  int n = 0;
  for (int rough = 1; rough >= 0; rough--)
    for (int k = 0; k < 2; k++)
      for (int p = 0; p < 3; p++) {
        if (quick && (k == 1 || p == 0 || (!rough && p == 2))) continue;
        s[n].phi = phi[p], s[n].e = e[k], s[n].flow = GG_USF, s[n++].rough = rough;
      }
  for (int rough = 1; rough >= quick; rough--) s[n].phi = 0.01, s[n].e = 0.9, s[n].flow = GG_HCS, s[n++].rough = rough;
  return n;
}

static gg_status measure(gg_bench *b, gg_error_state *s, gg_error *err)
{
  const bool quick = b->options->quick;
  const int n = list_states(s, quick);
  if (b->options->picture)
    GG_TRY(gg_plot_paper_check(b->options->picture, b->options->width, err)); /* before an hour of measurement */
  gg_status drawn = GG_OK;
  for (int i = 0; i < n; i++) {
    GG_TRY(gg_bench_error_state_measure(b, &s[i], quick ? 4 : 6, gg_bench_seconds(b, quick ? 0.3 : 1.5), err));
    GG_TRY(put_state(b, &s[i], i == 0, err));
    if (b->options->picture && drawn == GG_OK) drawn = draw(b, &s[i], err);
  }
  static const char *const head[] = {"state",    "quantity", "truth",    "its error", "from",
                                     "1/N dsmc", "1/N md",   "step h^2", "order",     "single"};
  gg_bench_table *floors = gg_bench_table_new(b, "floors", floors_caption, 2, err);
  if (!floors) return GG_FAILED;
  for (size_t k = 0; k < sizeof head / sizeof *head; k++) gg_bench_table_column(floors, k > 1 && k != 4, "%s", head[k]);
  for (int i = 0; i < n; i++) put_state_floors(b, floors, &s[i]);
  b->measured = true;
  return drawn;
}

gg_status gg_bench_error(gg_bench *b, gg_error *err)
{
  GG_FREED gg_error_state *s = gg_base_array_new(MOST_STATES, sizeof *s, err);
  return s ? measure(b, s, err) : GG_FAILED;
}
