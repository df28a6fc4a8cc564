/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local state over cells of about eight grains: density, translational and rotational temperature about the cell's
 * own mean, spin, shear rate, with their distributions; and the temperatures about the means of cells, of slabs
 * across y, and of the whole box. A mean taken over n_c grains reduces a temperature by the fraction 1/n_c: sums
 * over (n_c - 1) instead of n_c correct this. Local shear rate: imposed one plus the central difference of the mean
 * peculiar velocities of the cells above and below. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/cell_frame.h"
#include "measure/local_frame.h"
#include "measure/observable.h"

enum { DENSITY_BINS = 64, RATIO_BINS = 50, SIGNED_BINS = 80 };
#define RATIO_WIDTH 0.1
#define SIGNED_WIDTH 0.1 /* of spins in their rms; of shear rates half of it, in sqrt(T)/height */
enum {
  DENSITY = 0,
  TEMPERATURE = DENSITY + DENSITY_BINS,
  ROTATIONAL = TEMPERATURE + RATIO_BINS,
  SPIN = ROTATIONAL + RATIO_BINS,
  SHEAR = SPIN + SIGNED_BINS,
  SNAPSHOTS = SHEAR + SIGNED_BINS,
  N_DENSITY, /* number of cells in each distribution */
  N_TEMPERATURE,
  N_ROTATIONAL,
  N_SPIN,
  N_SHEAR,
  COUNT_SQUARED, /* mean of n_c^2 over cells, minus the square of the mean */
  SHEAR_SUM,
  ROOT_T, /* sqrt(T) */
  T_BOX,  /* temperatures: box, slab, slab corrected, cell, cell corrected; then rotational */
  W_BOX = T_BOX + 5,
  WIDTH = W_BOX + 5
};

typedef struct cell {                  /* sums over its grains; between walls C and omega are relative to the flow */
  double n, mass, momentum[3], energy; /* m, m C, m C^2 */
  double flow;                         /* m u_x of the flow to which C is relative */
  double inertia, spin[3], rotation;   /* I, I omega, I omega^2 */
  double omega, omega_squared, volume; /* omega_z, omega.omega, pi/6 d^3 */
  double heat, heat_mass;              /* T_i/T of the grain's species in the box, times 1 and m */
  double turning, turning_inertia;     /* theta_i/theta, times 1 and I */
} cell;

typedef struct cells {
  const gg_model *model;
  gg_cell_grid grid;
  cell *cell;
} cells;

static void destroy(void *self)
{
  free(((cells *)self)->cell);
  free(self);
}

static int count_of(const cells *d)
{
  return (int)gg_measure_cell_grid_cells(&d->grid);
}

static void *create(const gg_model *m, gg_error *err)
{
  cells *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  d->grid = gg_measure_cell_grid_of(m);
  d->cell = gg_base_array_new((size_t)count_of(d), sizeof *d->cell, err);
  if (d->cell) return d;
  free(d);
  return NULL;
}

static size_t bins(const void *self)
{
  (void)self;
  return WIDTH;
}

static cell *cell_at(const cells *d, int x, int y, int z)
{
  return &d->cell[(z * d->grid.n[1] + y) * d->grid.n[0] + x];
}

/* Temperatures of the species over that of all, translational and rotational. */
typedef struct temperature_ratios {
  double heat[GG_MAX_SPECIES], turning[GG_MAX_SPECIES];
} temperature_ratios;

static void divide(const gg_model *m, const double sum[GG_MAX_SPECIES], double *share)
{
  double all = 0;
  for (int k = 0; k < m->n_species; k++) all += sum[k] / (double)m->n;
  for (int k = 0; k < m->n_species; k++) share[k] = all > 0 ? sum[k] / (double)m->n_of[k] / all : 1;
  if (m->n_species == 1) share[0] = 1;
}

/* Velocity of grain i, and its spin; between walls relative to the flow at its height. */
static gg_vec velocity_of(const gg_snapshot *s, size_t i, gg_vec *omega)
{
  gg_vec c = {s->c[0][i], s->c[1][i], s->c[2][i]}, spin = {0, 0, 0};
  int species = gg_snapshot_species(s, i);
  if (s->s[0]) spin = (gg_vec){s->s[0][i], s->s[1][i], s->s[2][i]};
  if (s->frame && s->s[0]) spin = gg_measure_local_frame_spin(s->frame, s->r[1][i], spin, species);
  *omega = gg_scale(2 / s->model->diameter[species], spin);
  return s->frame ? gg_measure_local_frame_velocity(s->frame, s->r[1][i], c) : c;
}

static temperature_ratios temperature_ratios_of(const gg_model *m, const gg_snapshot *s)
{
  temperature_ratios of;
  double energy[GG_MAX_SPECIES] = {0}, rotation[GG_MAX_SPECIES] = {0}, spin[GG_MAX_SPECIES][3] = {{0}};
  for (size_t i = 0; i < s->n && m->n_species > 1; i++) {
    int k = gg_snapshot_species(s, i);
    gg_vec omega, c = velocity_of(s, i, &omega);
    energy[k] += m->mass[k] * gg_dot(c, c);
    rotation[k] += gg_moment_of_inertia(m, k) * gg_dot(omega, omega);
    spin[k][0] += omega.x, spin[k][1] += omega.y, spin[k][2] += omega.z;
  }
  for (int k = 0; k < m->n_species; k++) /* about the species' mean spin */
    for (int a = 0; a < 3; a++)
      rotation[k] -= gg_moment_of_inertia(m, k) * spin[k][a] * spin[k][a] / (double)m->n_of[k];
  divide(m, energy, of.heat);
  divide(m, rotation, of.turning);
  return of;
}

static void add_grain(const gg_model *m, const gg_snapshot *s, const temperature_ratios *of, size_t i, cell *c)
{
  int k = gg_snapshot_species(s, i);
  double mass = m->mass[k], I = gg_moment_of_inertia(m, k), diameter = m->diameter[k];
  c->n++;
  c->mass += mass;
  c->heat += of->heat[k], c->heat_mass += of->heat[k] * mass;
  c->volume += M_PI / 6 * diameter * diameter * diameter;
  gg_vec omega, C = velocity_of(s, i, &omega);
  c->momentum[0] += mass * C.x, c->momentum[1] += mass * C.y, c->momentum[2] += mass * C.z;
  c->energy += mass * gg_dot(C, C);
  if (s->frame) c->flow += mass * gg_measure_local_frame_flow(s->frame, s->r[1][i]).x;
  if (!s->s[0]) return;
  c->inertia += I;
  c->turning += of->turning[k], c->turning_inertia += of->turning[k] * I;
  c->spin[0] += I * omega.x, c->spin[1] += I * omega.y, c->spin[2] += I * omega.z;
  c->rotation += I * gg_dot(omega, omega);
  for (int a = 0; a < 3; a++) c->omega_squared += pow(gg_snapshot_omega(s, a, i), 2);
  c->omega += gg_snapshot_omega(s, 2, i);
}

static void sort_grains(cells *d, const gg_snapshot *s)
{
  memset(d->cell, 0, (size_t)count_of(d) * sizeof *d->cell);
  temperature_ratios of = temperature_ratios_of(d->model, s);
  for (size_t i = 0; i < s->n; i++) add_grain(d->model, s, &of, i, &d->cell[gg_measure_cell_grid_cell(&d->grid, s, i)]);
}

static void merge(cell *to, const cell *from)
{
  double *t = (double *)to;
  const double *f = (const double *)from;
  for (size_t k = 0; k < sizeof *to / sizeof *t; k++) t[k] += f[k];
}

/* Energies about the cell's own mean, times two. */
static double thermal(const cell *c)
{
  const double *p = c->momentum;
  return c->mass > 0 ? c->energy - (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / c->mass : 0;
}
static double rotational(const cell *c)
{
  const double *p = c->spin;
  return c->inertia > 0 ? c->rotation - (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / c->inertia : 0;
}

/* The divisor of energies about a mean. A mean over n grains takes away the fraction m_i/M of grain i's energy: the
 * divisor is n - 1 if all species have one temperature, else each grain counts by its temperature over that of the
 * box. */
static double free_grains(const cell *c)
{
  return c->mass > 0 ? fmax(c->heat - c->heat_mass / c->mass, 0) : 0;
}
static double free_spins(const cell *c)
{
  return c->inertia > 0 ? fmax(c->turning - c->turning_inertia / c->inertia, 0) : 0;
}

/* Temperatures about the means of these parts: uncorrected, and with the fraction 1/n_c restored. */
static void put_temperatures(const cell *part, int n, double *T, double *W)
{
  double energy = 0, spins = 0, grains = 0, moving = 0, turning = 0;
  for (int k = 0; k < n; k++) {
    energy += thermal(&part[k]), spins += rotational(&part[k]);
    grains += part[k].n, moving += free_grains(&part[k]), turning += free_spins(&part[k]);
  }
  T[0] += energy / (3 * grains), W[0] += spins / (3 * grains);
  if (n > 1) T[1] += energy / (3 * moving), W[1] += turning > 0 ? spins / (3 * turning) : 0;
}

static cell add_averages(const cells *d, double *bin)
{
  enum { MOST_SLABS = 512 };
  cell box = {0}, slab[MOST_SLABS];
  int n = d->grid.n[1] < MOST_SLABS ? d->grid.n[1] : MOST_SLABS;
  memset(slab, 0, (size_t)n * sizeof *slab);
  for (int z = 0; z < d->grid.n[2]; z++)
    for (int y = 0; y < d->grid.n[1]; y++)
      for (int x = 0; x < d->grid.n[0]; x++) merge(&slab[y * n / d->grid.n[1]], cell_at(d, x, y, z));
  for (int y = 0; y < n; y++) merge(&box, &slab[y]);
  put_temperatures(&box, 1, bin + T_BOX, bin + W_BOX);
  put_temperatures(slab, n, bin + T_BOX + 1, bin + W_BOX + 1);
  put_temperatures(d->cell, count_of(d), bin + T_BOX + 3, bin + W_BOX + 3);
  return box;
}

static void drop(double x, double width, int n, double *bin, double *count)
{
  double at = x / width;
  (*count)++;
  if (at >= 0 && at < n) bin[(int)at]++;
}

static double mean_x(const cell *c)
{
  return c->mass > 0 ? (c->momentum[0] + c->flow) / c->mass : NAN;
}

/* Only for inner rows, if the rows beyond the boundary are walls or sheared images. */
static void add_shear_rate(const cells *d, int x, int y, int z, double root_T, double *bin)
{
  const gg_model *m = d->model;
  bool open = !gg_model_is_sheared(m) && !gg_flow_is_walled(m->flow);
  if (!open && (y == 0 || y == d->grid.n[1] - 1)) return;
  double height = m->box[1] / d->grid.n[1];
  double above = mean_x(cell_at(d, x, (y + 1) % d->grid.n[1], z));
  double below = mean_x(cell_at(d, x, (y + d->grid.n[1] - 1) % d->grid.n[1], z));
  double excess = (above - below) / (2 * height);
  if (!isfinite(excess)) return; /* a cell is empty */
  bin[SHEAR_SUM] += m->shear_rate + excess;
  drop(excess * height / root_T + SIGNED_BINS * SIGNED_WIDTH / 4, SIGNED_WIDTH / 2, SIGNED_BINS, bin + SHEAR,
       &bin[N_SHEAR]);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  cells *d = self;
  sort_grains(d, s);
  cell box = add_averages(d, bin);
  double T = thermal(&box) / (3 * box.n), theta = rotational(&box) / (3 * box.n), squares = 0;
  double rms = sqrt(box.omega_squared / (3 * box.n)); /* of a component of omega */
  double unit = box.volume / box.n;
  for (int z = 0; z < d->grid.n[2]; z++)
    for (int y = 0; y < d->grid.n[1]; y++)
      for (int x = 0; x < d->grid.n[0]; x++) {
        const cell *c = cell_at(d, x, y, z);
        squares += c->n * c->n;
        drop(c->volume / unit + 0.5, 1, DENSITY_BINS, bin + DENSITY, &bin[N_DENSITY]);
        add_shear_rate(d, x, y, z, sqrt(T), bin);
        if (c->n < 2) continue;
        drop(thermal(c) / (3 * free_grains(c) * T), RATIO_WIDTH, RATIO_BINS, bin + TEMPERATURE, &bin[N_TEMPERATURE]);
        if (!s->s[0]) continue;
        drop(rotational(c) / (3 * free_spins(c) * theta), RATIO_WIDTH, RATIO_BINS, bin + ROTATIONAL,
             &bin[N_ROTATIONAL]);
        drop(c->omega / (c->n * rms) + SIGNED_BINS * SIGNED_WIDTH / 2, SIGNED_WIDTH, SIGNED_BINS, bin + SPIN,
             &bin[N_SPIN]);
      }
  double n = count_of(d), mean = box.n / n;
  bin[COUNT_SQUARED] += (squares / n - mean * mean) / mean;
  bin[ROOT_T] += sqrt(T);
  bin[SNAPSHOTS]++;
}

static gg_curve *put(gg_curves *list, const char *name, const char *title, const char *axis, int n, double first,
                     double width, const double *bin, double count)
{
  gg_curve *c = gg_measure_curve_add(list, (size_t)n, name, title, "cells");
  gg_measure_curve_axes(c, axis, "1", "P", "1");
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = first + (double)i * width;
    c->value[i] = bin[i] / (count * width);
  }
  return c;
}

static void put_averages(gg_curve *c, const gg_model *m, const double *T, double snapshots, bool spins)
{
  static const char *const names[2][5] = {{"temperature_box", "temperature_slabs", "temperature_slabs_corrected",
                                           "temperature_cells", "temperature_cells_corrected"},
                                          {"rotational_temperature_box", "rotational_temperature_slabs",
                                           "rotational_temperature_slabs_corrected", "rotational_temperature_cells",
                                           "rotational_temperature_cells_corrected"}};
  static const char *const ratios[2][2] = {
      {"temperature_slabs_over_box", "temperature_cells_over_box"},
      {"rotational_temperature_slabs_over_box", "rotational_temperature_cells_over_box"}};
  if (!gg_model_keeps_temperature(m)) return; /* no mean for a gas that cools or heats up */
  for (int k = 0; k < 5; k++)
    gg_measure_curve_put_number(c, names[spins][k], T[k] / snapshots, gg_measure_curve_unit(m, "temperature"));
  for (int k = 0; k < 2; k++) gg_measure_curve_put_number(c, ratios[spins][k], T[2 * k + 2] / T[0], "1");
}

/* The binomial distribution of randomly placed grains in a cell; parameters: N, fraction of the volume in a cell,
 * solid fraction of one grain in it. */
static double thrown(double x, const double *p)
{
  double n = round(x / p[2]);
  return exp(lgamma(p[0] + 1) - lgamma(n + 1) - lgamma(p[0] - n + 1) + n * log(p[1]) + (p[0] - n) * log1p(-p[1])) /
         p[2];
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const cells *d = self;
  const gg_model *m = d->model;
  double unit = m->phi * count_of(d) / (double)m->n, snapshots = bin[SNAPSHOTS];
  gg_curve *c =
      put(list, "cell_density", "local solid fraction", "φ", DENSITY_BINS, 0, unit, bin + DENSITY, bin[N_DENSITY]);
  if (gg_common_model_widest(m) == gg_common_model_narrowest(m)) /* else a solid fraction is no number of grains */
    gg_measure_curve_beside(c, "ideal gas", thrown, (const double[]){(double)m->n, 1.0 / count_of(d), unit});
  gg_measure_curve_put_number(c, "cells", count_of(d), "1");
  gg_measure_curve_put_number(c, "count_variance_over_mean", bin[COUNT_SQUARED] / snapshots, "1");
  c = put(list, "cell_temperature", "local temperature", "T_{cell}/T", RATIO_BINS, RATIO_WIDTH / 2, RATIO_WIDTH,
          bin + TEMPERATURE, bin[N_TEMPERATURE]);
  put_averages(c, m, bin + T_BOX, snapshots, false);
  c = put(list, "cell_shear_rate", "local shear rate, less the imposed", "h Δγ/√T", SIGNED_BINS,
          -SIGNED_BINS * SIGNED_WIDTH / 4 + SIGNED_WIDTH / 4, SIGNED_WIDTH / 2, bin + SHEAR, bin[N_SHEAR]);
  const char *rate = gg_measure_curve_unit(m, "spin");
  if (gg_model_is_sheared(m) || m->walled)
    gg_measure_curve_put_number(c, "mean_shear_rate", bin[SHEAR_SUM] / bin[N_SHEAR], rate);
  if (gg_model_keeps_temperature(m))
    gg_measure_curve_put_number(c, "rate_unit", bin[ROOT_T] / snapshots * d->grid.n[1] / m->box[1], rate);
  if (m->rule == GG_SMOOTH) return;
  c = put(list, "cell_rotational_temperature", "local rotational temperature", "θ_{cell}/θ", RATIO_BINS,
          RATIO_WIDTH / 2, RATIO_WIDTH, bin + ROTATIONAL, bin[N_ROTATIONAL]);
  put_averages(c, m, bin + W_BOX, snapshots, true);
  put(list, "cell_spin", "local spin", "ω_z/ω_{rms}", SIGNED_BINS, -SIGNED_BINS * SIGNED_WIDTH / 2 + SIGNED_WIDTH / 2,
      SIGNED_WIDTH, bin + SPIN, bin[N_SPIN]);
}

const gg_observable gg_measure_cells = {
    GG_OBSERVABLE(CELLS, cells),
    .create = create,
    .destroy = destroy,
    .refuses = gg_measure_needs_positions,
    .positions = true,
    .curves = &(const gg_observable_curves){.bins = bins, .every = 8, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.bytes = 10, .ns = {4, 0}},
};
