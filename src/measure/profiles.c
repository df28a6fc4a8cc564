/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles across the gap between walls: solid fraction (each grain where its centre is), flow velocity,
 * temperatures about the local flow, mean spin. Means are over the window: a slab's temperature is about its flow of
 * the whole window, a straight line in each slab, and needs no correction for few grains at one instant. If the
 * walls are alike, the profiles are those of the flow and its image together: they do not contain slow oscillations
 * about the middle. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/surface/shapes.h"
#include "measure/gap_slabs.h"
#include "measure/observable.h"

/* Sums over a slab: pi/6 d^3, grains, omega_z; then with the weight w = m of v = C and with w = I of v = omega: w, w v,
 * w v^2, and with the height h above the slab's middle, in its thickness: w h, w h^2, w h v. */
enum { WEIGHT, FIRST, SQUARE = FIRST + 3, HEIGHT, HEIGHT_SQUARE, MOMENT, MOTION = MOMENT + 3 };
enum { VOLUME, GRAINS, OMEGA, FLOW, ROLLING = FLOW + MOTION, SLAB = ROLLING + MOTION };

/* Stored after the slabs: time, and the impulses on the surfaces of the model. */
enum { TIME, IMPULSE, WALLS = IMPULSE + 3 * GG_MOST_SURFACES, MOST_BINS = GG_MOST_GAP_SLABS * SLAB + WALLS };

typedef struct profiles {
  const gg_model *model;
  int slabs;
  double walls[WALLS]; /* since the last snapshot */
} profiles;

static const char *refuses(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? NULL : "profiles are of flows between walls";
}

static void *create(const gg_model *m, gg_error *err)
{
  profiles *d = gg_base_array_new(1, sizeof *d, err);
  if (d) *d = (profiles){.model = m, .slabs = gg_measure_gap_slabs(m)};
  return d;
}

static size_t bins(const void *self)
{
  return (size_t)((const profiles *)self)->slabs * SLAB + WALLS;
}

static void *memory(void *self, size_t *bytes)
{
  profiles *d = self;
  *bytes = sizeof d->walls;
  return d->walls;
}

static void restart(void *self)
{
  memset(((profiles *)self)->walls, 0, sizeof((profiles *)self)->walls);
}

static void add_interval(void *self, const gg_interval *in)
{
  profiles *d = self;
  d->walls[TIME] += in->elapsed;
  for (int w = 0; w < d->model->n_surfaces; w++)
    for (int a = 0; a < 3; a++) d->walls[IMPULSE + 3 * w + a] += in->transfer->surface[w].impulse[a];
}

static void add_motion(double *sum, double weight, double height, const double v[3])
{
  sum[WEIGHT] += weight, sum[HEIGHT] += weight * height, sum[HEIGHT_SQUARE] += weight * height * height;
  for (int a = 0; a < 3; a++) {
    sum[FIRST + a] += weight * v[a], sum[MOMENT + a] += weight * height * v[a];
    sum[SQUARE] += weight * v[a] * v[a];
  }
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  profiles *d = self;
  const gg_model *m = d->model;
  for (int k = 0; k < WALLS; k++) bin[d->slabs * SLAB + k] += d->walls[k];
  restart(d);
  for (size_t i = 0; i < s->n; i++) {
    double y = s->r[1][i] / m->box[1] * d->slabs;
    int slab = (int)floor(y), k = gg_snapshot_species(s, i);
    if (slab < 0 || slab >= d->slabs) continue; /* above an open top */
    double *at = bin + slab * SLAB, height = y - slab - 0.5, diameter = m->diameter[k];
    at[VOLUME] += m->boltzmann ? 1 : M_PI / 6 * diameter * diameter * diameter; /* points: n over its mean */
    at[GRAINS]++;
    add_motion(at + FLOW, m->mass[k], height, (const double[]){s->c[0][i], s->c[1][i], s->c[2][i]});
    if (!s->s[0]) continue;
    double omega[3];
    for (int a = 0; a < 3; a++) omega[a] = gg_snapshot_omega(s, a, i);
    at[OMEGA] += omega[2];
    add_motion(at + ROLLING, gg_moment_of_inertia(m, k), height, omega);
  }
}

/* The image of a slab's sums. */
static void slab_image(gg_wall_symmetry symmetry, const double *at, double *to)
{
  for (int k = 0; k < SLAB; k++) to[k] = at[k];
  for (int spin = 0; spin < 2; spin++) {
    double *motion = to + (spin ? ROLLING : FLOW);
    motion[HEIGHT] *= -1;
    for (int a = 0; a < 3; a++) {
      double sign = gg_wall_image(symmetry, spin, a);
      motion[FIRST + a] *= sign, motion[MOMENT + a] *= -sign;
    }
  }
  to[OMEGA] *= gg_wall_image(symmetry, true, 2);
}

/* The mean of all sums and of their image; without a symmetry a copy. */
static void fold(const profiles *d, const double *bin, double *to)
{
  gg_wall_symmetry symmetry = gg_wall_symmetry_of(d->model);
  const double *walls = bin + d->slabs * SLAB;
  double *folded = to + d->slabs * SLAB;
  memcpy(to, bin, bins(d) * sizeof *to);
  if (symmetry == GG_NO_SYMMETRY) return;
  for (int i = 0; i < d->slabs; i++) {
    double image[SLAB];
    slab_image(symmetry, bin + (d->slabs - 1 - i) * SLAB, image);
    for (int k = 0; k < SLAB; k++) to[i * SLAB + k] = 0.5 * (bin[i * SLAB + k] + image[k]);
  }
  for (int w = 0; w < d->model->n_surfaces; w++) {
    const double *own = walls + IMPULSE + 3 * w, *other = walls + IMPULSE + 3 * gg_surface_image(d->model, w);
    for (int a = 0; a < 3; a++)
      folded[IMPULSE + 3 * w + a] = 0.5 * (own[a] + gg_wall_image(symmetry, false, a) * other[a]);
  }
}

typedef double of_slab(const double *at, double volume);

static double solid_fraction(const double *at, double volume)
{
  return at[VOLUME] / volume;
}
static double velocity(const double *at, double volume)
{
  (void)volume;
  return at[FLOW + FIRST] / at[FLOW + WEIGHT];
}
/* <w v^2>/3 about the straight line through the velocities of the slab. */
static double about_line(const double *sum, double grains)
{
  double left = sum[SQUARE], centre = sum[HEIGHT] / sum[WEIGHT];
  double spread = sum[HEIGHT_SQUARE] - centre * sum[HEIGHT];
  for (int a = 0; a < 3; a++) {
    double moment = sum[MOMENT + a] - centre * sum[FIRST + a];
    left -= sum[FIRST + a] * sum[FIRST + a] / sum[WEIGHT];
    if (spread > 1e-9 * sum[WEIGHT]) left -= moment * moment / spread;
  }
  return left / (3 * grains);
}
static double temperature(const double *at, double volume)
{
  (void)volume;
  return about_line(at + FLOW, at[GRAINS]);
}
static double rotational_temperature(const double *at, double volume)
{
  (void)volume;
  return about_line(at + ROLLING, at[GRAINS]);
}
static double temperature_ratio(const double *at, double volume)
{
  return rotational_temperature(at, volume) / temperature(at, volume);
}
static double spin(const double *at, double volume)
{
  (void)volume;
  return at[OMEGA] / at[GRAINS];
}

static const struct {
  const char *name, *panel, *label, *unit;
  of_slab *of;
  bool spins;
} table[] = {
    {"profile_solid_fraction", "solid fraction", "φ", "1", solid_fraction, false},
    {"profile_velocity", "flow velocity", "u_x", "velocity", velocity, false},
    {"profile_temperature", "temperature", "T", "temperature", temperature, false},
    {"profile_rotational_temperature", "temperature", "θ", "temperature", rotational_temperature, true},
    {"profile_temperature_ratio", "ratio of temperatures", "θ/T", "1", temperature_ratio, true},
    {"profile_spin_z", "spin", "ω_z", "spin", spin, true},
};

/* Velocity or temperature of the gas next to a flat wall, compared with that of the wall: the straight line through
 * the outermost three slabs with grains, at the height of a grain that touches. Centres are only beyond that height:
 * the outermost slab represents the part of it where they can be, and every slab has the weight of its grains. */
static void put_step(const gg_model *m, const gg_surface *wall, const double *bin, gg_curve *c, const char *what,
                     double of_wall, const char *unit)
{
  const double height = m->box[1] / (double)c->n, contact = m->boltzmann ? 0 : 0.5;
  double from_wall[3], u[3], grains[3], all = 0, mx = 0, mu = 0, xx = 0, xu = 0;
  int n = 0;
  for (size_t i = 0; i < c->n && n < 3; i++) {
    size_t k = wall->side > 0 ? c->n - 1 - i : i;
    if (!isfinite(c->value[k])) continue;
    from_wall[n] = 0.5 * (fmax((double)i * height, contact) + (double)(i + 1) * height);
    grains[n] = bin[k * SLAB + GRAINS], u[n++] = c->value[k];
  }
  if (n < 3) return;
  for (int k = 0; k < 3; k++) all += grains[k], mx += grains[k] * from_wall[k], mu += grains[k] * u[k];
  mx /= all, mu /= all;
  for (int k = 0; k < 3; k++) {
    xx += grains[k] * (from_wall[k] - mx) * (from_wall[k] - mx);
    xu += grains[k] * (from_wall[k] - mx) * (u[k] - mu);
  }
  char name[40];
  snprintf(name, sizeof name, "%s_%s", what, wall->word);
  gg_measure_curve_put_number(c, name, of_wall - (mu + xu / xx * (contact - mx)), gg_measure_curve_unit(m, unit));
}

/* Stress on a wall: the flux of momentum through it, of the components across and along x. Across y it equals the
 * stress of the gas, which is the same at every height (apart from gravity). */
static void put_wall_stress(const gg_model *m, const gg_surface *wall, const double *impulse, double time, gg_curve *c)
{
  if (!(time > 0)) return;
  int across = wall->axis;
  double area = m->box[(across + 1) % 3] * m->box[(across + 2) % 3], unit = wall->side * m->stress_unit / (area * time);
  const int along[2] = {across, 0};
  for (int k = 0; k < 2; k++) {
    char name[40];
    snprintf(name, sizeof name, "wall_P_%c%c_%s", "xyz"[across], "xyz"[along[k]], wall -> word);
    gg_measure_curve_put_number(c, name, unit * impulse[along[k]], gg_common_quantity_unit(GG_Q_PRESSURE, m));
  }
}

static bool is_flat(const gg_surface *s)
{
  return s->axis == 1 && gg_surface_height(s) == 0;
}

static void put_jumps(const gg_model *m, const double *bin, gg_curve *c)
{
  for (int w = 0; w < m->n_surfaces; w++) {
    const gg_surface *s = &m->surface[w];
    if (is_flat(s) && s->accommodation > 0) put_step(m, s, bin, c, "temperature_jump", s->temperature, "temperature");
  }
}

static void put_walls(const gg_model *m, const double *bin, const double *walls, gg_curve *c)
{
  for (int w = 0; w < m->n_surfaces; w++) {
    const gg_surface *s = &m->surface[w];
    if (is_flat(s)) put_step(m, s, bin, c, "slip", s->velocity.x, "velocity");
  }
  for (int w = 0; w < m->n_surfaces; w++) put_wall_stress(m, &m->surface[w], walls + IMPULSE + 3 * w, walls[TIME], c);
}

static void curves(const void *self, const double *mean, gg_curves *list)
{
  const profiles *d = self;
  const gg_model *m = d->model;
  double bin[MOST_BINS];
  fold(d, mean, bin);
  double height = m->box[1] / d->slabs, volume = m->box[0] * m->box[2] * height;
  for (size_t t = 0; t < sizeof table / sizeof *table; t++) {
    if (table[t].spins && m->rule == GG_SMOOTH) continue;
    gg_curve *c = gg_measure_curve_add(list, (size_t)d->slabs, table[t].name, table[t].panel, table[t].label);
    c->folded = gg_wall_symmetry_of(m) != GG_NO_SYMMETRY;
    gg_measure_curve_axes(c, "y", gg_measure_curve_unit(m, "length"), table[t].label,
                          gg_measure_curve_unit(m, table[t].unit));
    for (size_t i = 0; i < c->n; i++) {
      const double *at = bin + i * SLAB;
      c->x[i] = ((double)i + 0.5) * height;
      c->value[i] = at[GRAINS] > 0 || table[t].of == solid_fraction ? table[t].of(at, volume) : NAN;
    }
    gg_measure_gap_middle(m, c, table[t].of == velocity);
    if (table[t].of == temperature) put_jumps(m, bin, c);
    if (table[t].of == velocity) put_walls(m, bin, bin + d->slabs * SLAB, c);
  }
}

const gg_observable gg_measure_profiles = {
    GG_OBSERVABLE(PROFILES, profiles),
    .create = create,
    .destroy = free,
    .refuses = refuses,
    .memory = memory,
    .positions = true,
    .restart = restart,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 2, .add_snapshot = add_snapshot, .add_interval = add_interval, .of_bins = curves},
    .cost = {.ns = {10, 0}},
};
