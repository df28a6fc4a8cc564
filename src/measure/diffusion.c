/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocity autocorrelation and mean-square displacement of a grain, by component and species, from origins
 * distributed over the run. The coefficient of self-diffusion follows from both: D = int <C(0)C(t)> dt (Green 1952,
 * Kubo 1957), and half the slope of the displacement (Einstein 1905), with the part beyond the last lags
 * (long_time_tail.h).
 *
 * Lags up to 480 collisions a grain, in levels: each is four times as long as the one before, in steps four times as
 * wide. The integral is obtained from <C(0) r(t)>, r the displacement, which needs no steps. Under shear
 * displacements are peculiar: the displacement by the flow along x is subtracted, with the mean of the grain's
 * heights at two snapshots.
 *
 * The displacement of a grain between two snapshots leads to one of the images of its new place. The image is
 * selected by the velocities at both snapshots, or, if free paths are so long beside the box that the grain may have
 * crossed half of it and collided, by the velocities of all its flights. The Monte Carlo ensemble has no positions:
 * there the flights are the displacement, and grains keep theirs in the ensemble, as every collision is observed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/diffusion_lags.h"
#include "measure/observable.h"
#include "measure/pairs.h"

/* Velocities and displacements at an origin. Floats: the error of a displacement is at most 1e-7 of the whole path
 * since averaging began, and that of a velocity 1e-7. */
typedef struct origin {
  float *c[3], *moved[3];
} origin;

typedef struct diffusion {
  const gg_model *model;
  size_t n, bytes;
  struct diffusion_state { /* one block of plain bytes, followed by all arrays */
    uint64_t snapshots;
    double time;
    double began[GG_LAG_ORIGINS];
  } * state;
  uint32_t *place;                /* for each grain by its number: species 1 first */
  double *r[3], *c[3], *moved[3]; /* at the last snapshot, by place; moved: displacement since the start */
  double *flown[3], *until;       /* since the last snapshot, up to the last collision; NULL in long boxes */
  origin origin[GG_LAG_ORIGINS];  /* origins of all levels, one after the other */
} diffusion;

static const char *refuses(const gg_model *m)
{
  if (gg_flow_cools(m->flow)) return "a cooling gas has no stationary velocity correlation";
  if (!m->steady) return "a gas that heats up has no stationary velocity correlation";
  return gg_measure_needs_homogeneity(m);
}

static void destroy(void *self)
{
  free(((diffusion *)self)->state);
  free(self);
}

/* True if all flights must be followed: without positions, or if a fast grain may travel half the shortest edge between
 * two snapshots. The answer does not depend on the temperature, and so stays after every change of the model. */
static bool follows_flights(const gg_model *m)
{
  if (m->homogeneous) return true;
  double lightest = m->mass[0], fast, way;
  for (int k = 1; k < m->n_species; k++) lightest = fmin(lightest, m->mass[k]);
  fast = 5 / sqrt(lightest);
  way = fast / (GG_LAG_SNAPSHOTS / 2.0 * gg_common_model_collision_rate(m, 1));
  return way > 0.5 * fmin(m->box[0], fmin(m->box[1], m->box[2]));
}

static void *create(const gg_model *m, gg_error *err)
{
  diffusion *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  d->n = (size_t)m->n;
  size_t doubles = follows_flights(m) ? 13 : 9;
  d->bytes = sizeof *d->state + doubles * d->n * sizeof(double) + 6 * GG_LAG_ORIGINS * d->n * sizeof(float) +
             d->n * sizeof *d->place;
  d->state = gg_base_array_new(1, d->bytes, err);
  if (!d->state) {
    free(d);
    return NULL;
  }
  double *at = (double *)(d->state + 1);
  for (int a = 0; a < 3; a++) {
    double **arrays[] = {&d->r[a], &d->c[a], &d->moved[a]};
    for (int k = 0; k < 3; k++, at += d->n) *arrays[k] = at;
  }
  if (follows_flights(m)) {
    for (int a = 0; a < 3; a++, at += d->n) d->flown[a] = at;
    d->until = at;
    at += d->n;
  }
  float *next = (float *)at;
  for (int o = 0; o < GG_LAG_ORIGINS; o++)
    for (int a = 0; a < 3; a++, next += 2 * d->n) d->origin[o].c[a] = next, d->origin[o].moved[a] = next + d->n;
  d->place = (uint32_t *)next;
  return d;
}

static void *memory(void *self, size_t *bytes)
{
  diffusion *d = self;
  *bytes = d->bytes;
  return d->state;
}

/* True if all places are valid indices. */
static bool is_memory(const void *self)
{
  const diffusion *d = self;
  for (size_t i = 0; i < d->n; i++)
    if (d->place[i] >= d->n) return false;
  return true;
}

static void restart(void *self)
{
  diffusion *d = self;
  d->state->snapshots = 0;
  d->state->time = 0;
}

static size_t bins(const void *self)
{
  return (size_t)((const diffusion *)self)->model->n_species * GG_LAGS * GG_LAG_WIDTH;
}

/* Displacement since the snapshot `dt` ago: of all images of the new place the one nearest to `way`. */
static gg_vec displacement(const diffusion *d, const gg_images *b, gg_vec from, gg_vec to, gg_vec way, double dt)
{
  double rate = d->model->shear_rate;
  gg_vec move = gg_sub(to, from);
  double layers = gg_round_half((move.y - way.y) * b->inverse[1]);
  move.y -= layers * b->edge[1];
  move.x -= layers * b->offset + rate * (from.y + 0.5 * move.y - 0.5 * b->edge[1]) * dt;
  move.x -= b->edge[0] * gg_round_half((move.x - way.x) * b->inverse[0]);
  move.z -= b->edge[2] * gg_round_half((move.z - way.z) * b->inverse[2]);
  return move;
}

/* The peculiar displacement of a flight that ends with `c`: back from there C_x grows by the shear rate times C_y.
 * Kicks of white noise within a flight are neglected: an error below half an edge leads to the right image. */
static void fly(diffusion *d, size_t g, gg_vec c, double now)
{
  double t = now - d->until[g];
  d->flown[0][g] += (c.x + 0.5 * d->model->shear_rate * c.y * t) * t;
  d->flown[1][g] += c.y * t;
  d->flown[2][g] += c.z * t;
  d->until[g] = now;
}

static void add_collision(void *self, const gg_collision_record *collision)
{
  diffusion *d = self;
  if (!d->until || d->state->snapshots == 0) return;
  for (int i = 0; i < 2; i++) fly(d, d->place[collision->id[i]], collision->c[i], collision->time);
}

/* Estimate of the displacement since the last snapshot from the velocities. */
static gg_vec estimated_path(diffusion *d, size_t g, gg_vec c, const gg_snapshot *s)
{
  if (d->until) {
    fly(d, g, c, s->time);
    return (gg_vec){d->flown[0][g], d->flown[1][g], d->flown[2][g]};
  }
  return gg_scale(0.5 * s->elapsed, gg_add((gg_vec){d->c[0][g], d->c[1][g], d->c[2][g]}, c));
}

static size_t number_of(const gg_snapshot *s, size_t i)
{
  return s->id ? (size_t)s->id[i] : i;
}

static void give_places(diffusion *d, const gg_snapshot *s)
{
  uint32_t next[GG_MAX_SPECIES] = {0};
  for (int k = 1; k < d->model->n_species; k++) next[k] = next[k - 1] + (uint32_t)d->model->n_of[k - 1];
  for (size_t i = 0; i < s->n; i++) d->place[number_of(s, i)] = next[gg_snapshot_species(s, i)]++;
}

static void follow(diffusion *d, const gg_snapshot *s)
{
  const bool placed = !d->model->homogeneous;
  gg_images b = {0};
  if (placed) b = gg_measure_pairs_images(s);
  bool first = d->state->snapshots == 0;
  if (first) give_places(d, s);
  for (size_t i = 0; i < s->n; i++) {
    size_t g = d->place[number_of(s, i)];
    const gg_vec c = {s->c[0][i], s->c[1][i], s->c[2][i]},
                 to = placed ? (gg_vec){s->r[0][i], s->r[1][i], s->r[2][i]} : (gg_vec){0, 0, 0};
    gg_vec move = {0, 0, 0};
    if (!first && !placed)
      move = estimated_path(d, g, c, s);
    else if (!first)
      move =
          displacement(d, &b, (gg_vec){d->r[0][g], d->r[1][g], d->r[2][g]}, to, estimated_path(d, g, c, s), s->elapsed);
    const double step[3] = {move.x, move.y, move.z};
    for (int a = 0; a < 3; a++) {
      if (placed) d->r[a][g] = s->r[a][i];
      d->c[a][g] = s->c[a][i];
      d->moved[a][g] = first ? 0 : d->moved[a][g] + step[a];
      if (d->until) d->flown[a][g] = 0;
    }
    if (d->until) d->until[g] = s->time;
  }
  d->state->time = first ? 0 : d->state->time + s->elapsed;
}

static void set_origin(diffusion *d, int o)
{
  for (int a = 0; a < 3; a++)
    for (size_t g = 0; g < d->n; g++) {
      d->origin[o].c[a][g] = (float)d->c[a][g];
      d->origin[o].moved[a][g] = (float)d->moved[a][g];
    }
  d->state->began[o] = d->state->time;
}

/* Sums over the grains of one species, at places from..to: products with the origin, squares of displacements. By
 * symmetry in time the velocity at the end of a displacement gives as much information as that at its beginning. */
static void correlate(const diffusion *d, int o, size_t from, size_t to, double *bin)
{
  bin[GG_LAG_COUNT] += (double)(to - from);
  bin[GG_LAG_TIME] += (double)(to - from) * (d->state->time - d->state->began[o]);
  for (int a = 0; a < 3; a++) {
    const double *c = d->c[a], *r = d->moved[a];
    const float *c0 = d->origin[o].c[a], *r0 = d->origin[o].moved[a];
    double cc = 0, cr = 0, rr = 0;
#pragma omp simd reduction(+ : cc, cr, rr)
    for (size_t g = from; g < to; g++) {
      double moved = r[g] - (double)r0[g], before = (double)c0[g];
      cc += c[g] * before;
      cr += (c[g] + before) * moved;
      rr += moved * moved;
    }
    bin[GG_LAG_CC + a] += cc;
    bin[GG_LAG_CR + a] += 0.5 * cr;
    bin[GG_LAG_RR + a] += rr;
  }
}

/* Every level: a new origin if one is due, then the lags to all of them. */
static void add_level(diffusion *d, int level, int first, double *bin)
{
  const uint64_t now = d->state->snapshots, step = 1ull << (2 * level), n = (uint64_t)gg_lag_origins[level];
  const uint64_t spacing = GG_LAG_REACH / n * step, interval = now / spacing;
  if (now % step) return;
  if (now % spacing == 0) set_origin(d, first + (int)(interval % n));
  for (uint64_t o = 0; o < n && o <= interval; o++) {
    uint64_t set = (interval - (interval - o) % n) * spacing; /* the last interval that began with this origin */
    int lag = gg_lag_index(level, (int)((now - set) / step));
    size_t from = 0;
    for (int k = 0; k < d->model->n_species && lag >= 0; k++) {
      size_t to = from + (size_t)d->model->n_of[k];
      correlate(d, first + (int)o, from, to, bin + (k * GG_LAGS + lag) * GG_LAG_WIDTH);
      from = to;
    }
  }
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  diffusion *d = self;
  follow(d, s);
  for (int level = 0, first = 0; level < GG_LAG_LEVELS; first += gg_lag_origins[level++])
    add_level(d, level, first, bin);
  d->state->snapshots++;
}

/* First Sonine approximation for smooth grains: T_i/m_i over the rate at which a grain loses momentum to the gas and
 * to a bath, with Maxwellians of the measured temperatures (tracers: J.W. Dufty & V. Garzo, J. Stat. Phys. 105
 * (2001) 723; elastic: Chapman & Cowling). NaN for other models. */
static double first_sonine(const gg_model *m, int i, const double *bins)
{
  double rate = m->bath.on ? m->bath.drag[i] : 0, T[GG_MAX_SPECIES] = {0}; /* <C_a^2> */
  if (m->shear_rate != 0 || m->rule != GG_SMOOTH || m->law.name || gg_model_is_injected(m)) return NAN;
  for (int k = 0; k < m->n_species; k++) {
    const double *bin = bins + k * GG_LAGS * GG_LAG_WIDTH;
    T[k] =
        (gg_lag_mean(bin, 0, GG_LAG_CC) + gg_lag_mean(bin, 0, GG_LAG_CC + 1) + gg_lag_mean(bin, 0, GG_LAG_CC + 2)) / 3;
  }
  for (int j = 0; j < m->n_species; j++) {
    const int q = gg_pair(i, j);
    const double n = m->density * (double)m->n_of[j] / (double)m->n, reduced = m->mass[j] / (m->mass[i] + m->mass[j]);
    rate +=
        4 / 3. * n * m->sigma[q] * m->sigma[q] * m->chi[q] * (1 + m->e[q]) * reduced * sqrt(2 * M_PI * (T[i] + T[j]));
  }
  return T[i] / rate;
}

/* Finite-size correction, known in equilibrium alone: walls, shear and heating change the vortices of a gas, and
 * Enskog's equation has none. */
static double lacking_of_box(const gg_model *m, int species, const double *bin)
{
  double T = 0;
  for (int a = 0; a < 3; a++) T += m->mass[species] * gg_lag_mean(bin, 0, GG_LAG_CC + a) / 3;
  const bool known = gg_flow_of(m->flow)->conserves && !m->homogeneous && !m->boltzmann;
  return known ? gg_measure_long_time_tail_lacking(m, T) : NAN;
}

static void put_component(const diffusion *d, int species, int a, const double *bin, gg_curves *list)
{
  const gg_model *m = d->model;
  char name[48], label[24], unit[40], tail[16] = "", subscript[16] = "";
  const char *time = gg_measure_curve_unit(m, "time");
  if (m->n_species > 1)
    snprintf(tail, sizeof tail, "_%d", species + 1), snprintf(subscript, sizeof subscript, ",%d", species + 1);
  snprintf(name, sizeof name, "velocity_autocorrelation_C%c%s", "xyz"[a], tail);
  snprintf(label, sizeof label, "C_{%c%s}", "xyz"[a], subscript);
  gg_curve *c = gg_measure_curve_add(list, GG_LAGS, name, "velocity autocorrelation", label);
  gg_measure_curve_axes(c, "t", time, "<C(0)C(t)>", gg_measure_curve_unit(m, "temperature"));
  snprintf(name, sizeof name, "displacement_squared_%c%s", "xyz"[a], tail);
  snprintf(label, sizeof label, "%c%s", "xyz"[a], *tail ? tail : "");
  gg_curve *r = gg_measure_curve_add(list, GG_LAGS, name, "mean-square displacement", label);
  c->log_x = r->log_x = r->log_y = true;
  snprintf(unit, sizeof unit, "%.30s^2", gg_measure_curve_unit(m, "length"));
  gg_measure_curve_axes(r, "t", time, "<(Δr)^2>", unit);
  double step = gg_lag_mean(bin, 1, GG_LAG_TIME);
  for (int i = 0; i < GG_LAGS && c->n && r->n; i++) {
    c->x[i] = r->x[i] = gg_lag_steps(i) * step; /* also at lags without samples */
    c->value[i] = gg_lag_mean(bin, i, GG_LAG_CC + a);
    r->value[i] = gg_lag_mean(bin, i, GG_LAG_RR + a);
  }
  gg_diffusion_coefficients D = gg_measure_diffusion_read(m, species, a, bin, (double)list->samples);
  const char *coefficient = m->shear_rate != 0 ? "d^2 gamma" : "d v_0";
  gg_measure_curve_put_truncated(c, "diffusion_green_kubo", D.green_kubo.D, D.green_kubo.unsure, coefficient);
  gg_measure_curve_put_truncated(c, "long_time_tail", D.green_kubo.tail, D.green_kubo.unsure, coefficient);
  const double lacking = lacking_of_box(m, species, bin);
  if (!isnan(lacking))
    gg_measure_curve_put_truncated(c, "diffusion_infinite_system", D.green_kubo.D + lacking, D.green_kubo.unsure,
                                   coefficient);
  const double theory = first_sonine(m, species, bin - species * GG_LAGS * GG_LAG_WIDTH);
  if (!isnan(theory)) gg_measure_curve_put_setting(c, "diffusion_first_sonine", theory, coefficient);
  gg_measure_curve_put_truncated(r, "diffusion_einstein", D.einstein.D, D.einstein.unsure, coefficient);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const diffusion *d = self;
  for (int k = 0; k < d->model->n_species; k++)
    for (int a = 0; a < 3; a++) put_component(d, k, a, bin + k * GG_LAGS * GG_LAG_WIDTH, list);
}

const gg_observable gg_measure_diffusion = {
    GG_OBSERVABLE(DIFFUSION, diffusion),
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .is_memory = is_memory,
    .refuses = refuses,
    .positions = true,
    .restart = restart,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 1, .parts = GG_LAG_SNAPSHOTS, .add_snapshot = add_snapshot, .of_bins = curves},
    .collisions = &(const gg_observable_collisions){.add = add_collision, .wanted = follows_flights},
    .cost = {.bytes = 700, .ns = {120, 400}},
};
