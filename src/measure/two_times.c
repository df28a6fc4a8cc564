/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/two_times.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"

/* Waiting times, in collisions per grain. */
enum { WAITS = 8 };
static const double waits[WAITS] = {0, 5, 10, 20, 40, 80, 160, 320};

/* Lags in collisions per grain: FINE steps of STEP, then LOG an octave, up to almost 4000. */
enum { FINE = 16, LOG = 4, OCTAVES = 10, LAGS = FINE + LOG * OCTAVES };
#define STEP 0.25

/* Sums over grains at one lag: number, time and collisions since the waiting time, C(t_w)C(t), C(t_w)^2, C(t)^2, and
 * the square of the displacement. After the lags of a waiting time: its time, once. */
enum { COUNT, TIME, PASSED, CC, BEFORE, NOW, RR, WIDTH };
enum { OF_WAIT = 2 }; /* number, time */

struct gg_two_times {
  const gg_model *model;
  size_t bytes;
  struct two_times_state { /* one block of plain bytes, followed by all arrays */
    uint64_t snapshots, origins;
    double time, collisions;          /* since the start; collisions per grain */
    double T, unit;                   /* at the last snapshot; the engine's velocities over those of the start */
    double at_time[WAITS], at[WAITS]; /* of each origin */
  } * state;
  gg_displacement path;
  struct wait_origin {
    double *c[3], *moved[3];
  } origin[WAITS];
};

bool gg_measure_two_times_applies(const gg_model *m)
{
  return m->cuts_steps && gg_flow_cools(m->flow);
}

void gg_measure_two_times_free(gg_two_times *t)
{
  if (t) free(t->state);
  free(t);
}

gg_two_times *gg_measure_two_times_new(const gg_model *m, gg_error *err)
{
  gg_two_times *t = gg_base_array_new(1, sizeof *t, err);
  if (!t) return NULL;
  const size_t n = (size_t)m->n, head = sizeof *t->state + 6 * WAITS * n * sizeof(double);
  t->model = m;
  t->bytes = head + gg_measure_displacement_bytes(m);
  t->state = gg_base_array_new(1, t->bytes, err);
  if (!t->state) {
    free(t);
    return NULL;
  }
  double *at = (double *)(t->state + 1);
  for (int w = 0; w < WAITS; w++)
    for (int a = 0; a < 3; a++, at += 2 * n) t->origin[w].c[a] = at, t->origin[w].moved[a] = at + n;
  gg_measure_displacement_bind(&t->path, m, at);
  gg_measure_two_times_restart(t);
  return t;
}

void *gg_measure_two_times_memory(gg_two_times *t, size_t *bytes)
{
  *bytes = t->bytes;
  return t->state;
}

bool gg_measure_two_times_is_memory(const gg_two_times *t)
{
  const struct two_times_state *s = t->state;
  bool good = s->origins <= WAITS && isfinite(s->time) && isfinite(s->collisions) && isfinite(s->T) && s->unit > 0;
  for (size_t w = 0; good && w < (size_t)s->origins; w++) good = s->at[w] >= 0 && s->at[w] <= s->collisions;
  return good && gg_measure_displacement_is_valid(&t->path);
}

void gg_measure_two_times_restart(gg_two_times *t)
{
  *t->state = (struct two_times_state){.unit = 1};
}

static size_t of_wait(const gg_model *m)
{
  return (size_t)m->n_species * LAGS * WIDTH + OF_WAIT;
}

size_t gg_measure_two_times_bins(const gg_model *m)
{
  return WAITS * of_wait(m);
}

void gg_measure_two_times_collide(gg_two_times *t, const gg_collision_record *collision)
{
  if (t->state->snapshots > 0) gg_measure_displacement_collide(&t->path, collision);
}

void gg_measure_two_times_rescaled(gg_two_times *t, double factor)
{
  gg_measure_displacement_rescaled(&t->path, factor);
  t->state->unit *= factor;
  t->state->T *= factor * factor;
}

/* Times of a lag are the nearest of the fine steps, or between the powers of 2^(1/LOG). LAGS: beyond all lags. */
static int lag_of(double collisions)
{
  if (!(collisions >= 0 && collisions < 1e6)) return LAGS;
  const int fine = (int)(collisions / STEP + 0.5);
  if (fine < FINE) return fine;
  return FINE + (int)fmax(LOG * log2(collisions / ((FINE - 0.5) * STEP)), 0);
}

static void advance(gg_two_times *t, const gg_snapshot *s)
{
  struct two_times_state *now = t->state;
  const double T = gg_measure_displacement_temperature(&t->path);
  if (now->snapshots > 0) {
    const double rate = gg_common_model_collision_rate(t->model, 1);
    now->time += s->elapsed * now->unit;
    now->collisions += rate * gg_measure_displacement_path(sqrt(now->T), sqrt(T), s->elapsed);
  }
  now->T = T;
}

static void set_origin(gg_two_times *t, double *bins)
{
  struct two_times_state *now = t->state;
  const uint64_t w = now->origins++;
  for (int a = 0; a < 3; a++)
    for (size_t g = 0; g < t->path.n; g++) {
      t->origin[w].c[a][g] = t->path.c[a][g] / now->unit;
      t->origin[w].moved[a][g] = t->path.moved[a][g];
    }
  now->at_time[w] = now->time, now->at[w] = now->collisions;
  double *bin = bins + (w + 1) * of_wait(t->model) - OF_WAIT;
  bin[0] += 1, bin[1] += now->time;
}

/* Sums over the grains of one species, at places from..to. */
static void correlate(const gg_two_times *t, int w, size_t from, size_t to, double *bin)
{
  const struct two_times_state *now = t->state;
  const double scale = 1 / now->unit, n = (double)(to - from);
  double sum[WIDTH] = {n, n * (now->time - now->at_time[w]), n * (now->collisions - now->at[w])};
  for (int a = 0; a < 3; a++) {
    const double *c = t->path.c[a], *r = t->path.moved[a], *c0 = t->origin[w].c[a], *r0 = t->origin[w].moved[a];
    double cc = 0, before = 0, after = 0, rr = 0;
#pragma omp simd reduction(+ : cc, before, after, rr)
    for (size_t g = from; g < to; g++) {
      const double moved = r[g] - r0[g], v = c[g] * scale;
      cc += v * c0[g], before += c0[g] * c0[g], after += v * v, rr += moved * moved;
    }
    sum[CC] += cc, sum[BEFORE] += before, sum[NOW] += after, sum[RR] += rr;
  }
  for (int k = 0; k < WIDTH; k++) bin[k] += sum[k];
}

void gg_measure_two_times_add(gg_two_times *t, const gg_snapshot *s, double *bins)
{
  struct two_times_state *now = t->state;
  gg_measure_displacement_take(&t->path, s, now->snapshots == 0);
  advance(t, s);
  if (now->origins < WAITS && now->collisions >= waits[now->origins]) set_origin(t, bins);
  for (int w = 0; w < (int)now->origins; w++) {
    const int lag = lag_of(now->collisions - now->at[w]);
    size_t from = 0;
    for (int k = 0; k < t->model->n_species && lag < LAGS; k++) {
      const size_t to = from + (size_t)t->model->n_of[k];
      correlate(t, w, from, to, bins + (size_t)w * of_wait(t->model) + (size_t)(k * LAGS + lag) * WIDTH);
      from = to;
    }
  }
  now->snapshots++;
}

static double mean(const double *bin, int lag, int channel)
{
  const double *at = bin + lag * WIDTH;
  return at[COUNT] > 0 ? at[channel] / at[COUNT] : NAN;
}

/* Displacements after so many collisions per grain have forgotten their beginning. */
#define FORGOTTEN 10

/* Slope of the squared displacement over collisions per grain, by least squares. Both ends of a random walk scatter in
 * proportion to its length: weights are 1/length^2. NaN with fewer than three points. */
static double slope(const double *bin)
{
  double sum[5] = {0};
  int n = 0;
  for (int k = 0; k < LAGS; k++) {
    const double x = mean(bin, k, PASSED), y = mean(bin, k, RR), w = 1 / (x * x);
    if (!(x > FORGOTTEN)) continue;
    sum[0] += w, sum[1] += w * x, sum[2] += w * y, sum[3] += w * x * x, sum[4] += w * x * y;
    n++;
  }
  const double determinant = sum[0] * sum[3] - sum[1] * sum[1];
  return n > 2 ? (sum[0] * sum[4] - sum[1] * sum[2]) / determinant : NAN;
}

typedef struct course {
  const gg_model *m;
  const double *bin;
  int species, wait;
  size_t n; /* lags up to the last one with samples */
} course;

/* Curve of a waiting time over the time or the collisions since then. */
static gg_curve *put(const course *of, const char *what, const char *symbol, bool collisions, gg_curves *list)
{
  char name[48], panel[48], label[24], tail[8] = "";
  if (of->m->n_species > 1) snprintf(tail, sizeof tail, "_%d", of->species + 1);
  snprintf(name, sizeof name, "%s_%s%.0f%s", what, collisions ? "collisions_" : "from_", waits[of->wait], tail);
  snprintf(panel, sizeof panel, collisions ? "%s over collisions" : "%s over time", symbol);
  snprintf(label, sizeof label, "after %.0f%s%s", waits[of->wait], *tail ? ", species " : "", *tail ? tail + 1 : "");
  gg_curve *c = gg_measure_curve_add(list, of->n, name, panel, label);
  gg_measure_curve_axes(c, collisions ? "collisions per grain" : "t - t_w",
                        collisions ? "1" : gg_measure_curve_unit(of->m, "time"), symbol, "1");
  double last = 0;
  for (size_t i = 0; i < c->n; i++) {
    const double x = mean(of->bin, (int)i, collisions ? PASSED : TIME);
    c->x[i] = last = isnan(x) ? last : x; /* a lag without samples has no value */
  }
  return c;
}

/* First Sonine approximation of one species of smooth grains, over collisions: in units of v_0 a velocity decays at
 * (1 + e)^2/6 a collision of Maxwellians, friction less half the cooling rate. */
static bool has_theory(const gg_model *m)
{
  return m->n_species == 1 && gg_displacement_has_theory(m);
}

static double decay(const gg_model *m)
{
  return (1 + m->e[0]) * (1 + m->e[0]) / 6;
}

static double decayed(double collisions, const double *decay)
{
  return exp(-*decay * collisions);
}

/* Parameters: the decay, and 6 D over the collision rate. */
static double displaced(double collisions, const double *p)
{
  return p[1] * (collisions + expm1(-p[0] * collisions) / p[0]);
}

static void put_correlation(const course *of, bool collisions, const double *wait, gg_curves *list)
{
  gg_curve *c = put(of, "autocorrelation", "A(t_w,t)", collisions, list);
  c->log_x = true;
  for (size_t i = 0; i < c->n; i++)
    c->value[i] = mean(of->bin, (int)i, CC) / sqrt(mean(of->bin, (int)i, BEFORE) * mean(of->bin, (int)i, NOW));
  const double theory = decay(of->m);
  if (!collisions)
    gg_measure_curve_put_setting(c, "waiting_time", wait[1] / wait[0], gg_measure_curve_unit(of->m, "time"));
  else if (has_theory(of->m))
    gg_measure_curve_beside(c, "first Sonine", decayed, &theory);
}

/* D = <Dr^2>/6 over int v_0 dt, v_0 of the present temperature: constant in the scaled state. */
static void put_displacement(const course *of, bool collisions, gg_curves *list)
{
  char unit[40];
  gg_curve *c = put(of, "displacement", "<Δr^2>", collisions, list);
  snprintf(unit, sizeof unit, "%.30s^2", gg_measure_curve_unit(of->m, "length"));
  snprintf(c->unit, sizeof c->unit, "%s", unit);
  for (size_t i = 0; i < c->n; i++) c->value[i] = mean(of->bin, (int)i, RR);
  c->log_x = !collisions;
  if (!collisions) return;
  const double T0 = of->m->temperature0, rate = gg_common_model_collision_rate(of->m, T0);
  gg_measure_curve_put_number(c, "diffusion_einstein", slope(of->bin) / 6 * rate, "d v_0");
  if (!has_theory(of->m)) return;
  const double D = T0 / of->m->mass[0] / (decay(of->m) * rate), theory[2] = {decay(of->m), 6 * D / rate};
  gg_measure_curve_put_setting(c, "diffusion_first_sonine", D, "d v_0");
  gg_measure_curve_beside(c, "first Sonine", displaced, theory);
}

void gg_measure_two_times_curves(const gg_model *m, const double *bins, gg_curves *list)
{
  for (int w = 0; w < WAITS; w++)
    for (int k = 0; k < m->n_species; k++) {
      const double *of = bins + (size_t)w * of_wait(m), *wait = of + of_wait(m) - OF_WAIT;
      course at = {m, of + k * LAGS * WIDTH, k, w, LAGS};
      while (at.n > 0 && !(at.bin[(at.n - 1) * WIDTH + COUNT] > 0)) at.n--;
      if (at.n < 2) continue;
      for (int collisions = 0; collisions < 2; collisions++) {
        put_correlation(&at, collisions, wait, list);
        put_displacement(&at, collisions, list);
      }
    }
}
