/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocity autocorrelation and mean-square displacement of a grain, by component and species, from origins
 * distributed over the run. The coefficient of self-diffusion follows from both: D = int <C(0)C(t)> dt (Green 1952,
 * Kubo 1957), and half the slope of the displacement (Einstein 1905), with the part beyond the last lags
 * (long_time_tail.h).
 *
 * Lags up to 480 collisions a grain, in levels: each is four times as long as the one before, in steps four times as
 * wide. The integral is obtained from <C(0) r(t)>, r the displacement, which needs no steps.
 *
 * Under shear displacements are peculiar (displacement.h), and diffusion is a tensor: D_ij = int <C_i(t)C_j(0)> dt is
 * the flux along i down a gradient along j (C.S. Campbell, J. Fluid Mech. 348 (1997) 85; V. Garzo, Phys. Rev. E 66
 * (2002) 021308). D_xy and D_yx differ, since the shear turns C_y into C_x and not back.
 *
 * A cooling gas that keeps its scaled state is stationary in s = int v_0(t) dt: velocities are in units of the present
 * v_0, and time is s. Displacements have no such unit. So D is that over v_0(t) (J.J. Brey, M.J. Ruiz-Montero, D.
 * Cubero & R. Garcia-Rojo, Phys. Fluids 12 (2000) 876). A gas that is followed while its temperature changes has
 * functions of two times instead (two_times.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/diffusion_lags.h"
#include "measure/displacement.h"
#include "measure/observable.h"
#include "measure/two_times.h"

/* Velocities and displacements at an origin. Floats: the error of a displacement is at most 1e-7 of the whole path
 * since averaging began, and that of a velocity 1e-7. */
typedef struct origin {
  float *c[3], *moved[3];
} origin;

typedef struct diffusion {
  const gg_model *model;
  gg_two_times *two_times; /* instead of all below; NULL: stationary */
  size_t bytes;
  struct diffusion_state { /* one block of plain bytes, followed by all arrays */
    uint64_t snapshots;
    double time; /* s in a cooling gas */
    double T;    /* at the last snapshot, in the engine's units */
    double began[GG_LAG_ORIGINS];
  } * state;
  double scale; /* factor of velocities at the last snapshot: v_0 at the start over the present one; else 1 */
  gg_displacement path;
  origin origin[GG_LAG_ORIGINS]; /* origins of all levels, one after the other */
} diffusion;

static bool cools(const diffusion *d)
{
  return gg_flow_cools(d->model->flow);
}

static const char *refuses(const gg_model *m)
{
  if (gg_measure_two_times_applies(m)) return gg_measure_needs_homogeneity(m);
  if (gg_flow_cools(m->flow) && (!m->steady || gg_model_has_speed(m)))
    return "a gas that cools without a scaled steady state has no stationary velocity correlation; give run.duration";
  if (!m->steady) return "a gas that heats up has no stationary velocity correlation";
  return gg_measure_needs_homogeneity(m);
}

static void destroy(void *self)
{
  diffusion *d = self;
  gg_measure_two_times_free(d->two_times);
  free(d->state);
  free(d);
}

static gg_status create_arrays(diffusion *d, gg_error *err)
{
  const gg_model *m = d->model;
  const size_t n = (size_t)m->n;
  d->bytes = sizeof *d->state + gg_measure_displacement_bytes(m) + 6 * GG_LAG_ORIGINS * n * sizeof(float);
  d->state = gg_base_array_new(1, d->bytes, err);
  if (!d->state) return GG_FAILED;
  float *next = gg_measure_displacement_bind(&d->path, m, d->state + 1);
  for (int o = 0; o < GG_LAG_ORIGINS; o++)
    for (int a = 0; a < 3; a++, next += 2 * n) d->origin[o].c[a] = next, d->origin[o].moved[a] = next + n;
  return GG_OK;
}

static void *create(const gg_model *m, gg_error *err)
{
  diffusion *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  if (gg_measure_two_times_applies(m)) d->two_times = gg_measure_two_times_new(m, err);
  if (d->two_times || (!gg_measure_two_times_applies(m) && create_arrays(d, err) == GG_OK)) return d;
  destroy(d);
  return NULL;
}

static void *memory(void *self, size_t *bytes)
{
  diffusion *d = self;
  if (d->two_times) return gg_measure_two_times_memory(d->two_times, bytes);
  *bytes = d->bytes;
  return d->state;
}

static bool is_memory(const void *self)
{
  const diffusion *d = self;
  return d->two_times ? gg_measure_two_times_is_memory(d->two_times) : gg_measure_displacement_is_valid(&d->path);
}

static void restart(void *self)
{
  diffusion *d = self;
  if (d->two_times) {
    gg_measure_two_times_restart(d->two_times);
    return;
  }
  d->state->snapshots = 0;
  d->state->time = 0;
}

static bool is_of_two_times(const void *self)
{
  return ((const diffusion *)self)->two_times != NULL;
}

/* Sums of the loss of ln T and of s, after all lags of a cooling gas. */
enum { LOSS, PATH, COOLING_WIDTH };

static size_t lag_bins(const gg_model *m)
{
  return (size_t)m->n_species * GG_LAGS * GG_LAG_WIDTH;
}

static size_t bins_of(const void *self)
{
  const diffusion *d = self;
  if (d->two_times) return gg_measure_two_times_bins(d->model);
  return lag_bins(d->model) + (cools(d) ? COOLING_WIDTH : 0);
}

static void add_collision(void *self, const gg_collision_record *collision)
{
  diffusion *d = self;
  if (d->two_times)
    gg_measure_two_times_collide(d->two_times, collision);
  else if (d->state->snapshots > 0)
    gg_measure_displacement_collide(&d->path, collision);
}

static void rescaled(void *self, double factor)
{
  diffusion *d = self;
  if (d->two_times) {
    gg_measure_two_times_rescaled(d->two_times, factor);
    return;
  }
  gg_measure_displacement_rescaled(&d->path, factor);
  d->state->T *= factor * factor;
}

/* The time since the last snapshot: in a cooling gas int v_0 dt, in units of v_0 at the start. */
static void advance(diffusion *d, const gg_snapshot *s, double *bin)
{
  struct diffusion_state *state = d->state;
  const bool first = state->snapshots == 0;
  double step = s->elapsed;
  if (cools(d)) {
    const double T0 = d->model->temperature0, T = gg_measure_displacement_temperature(&d->path);
    step = first ? 0 : gg_measure_displacement_path(sqrt(state->T / T0), sqrt(T / T0), s->elapsed);
    bin[lag_bins(d->model) + LOSS] += first ? 0 : log(state->T / T);
    bin[lag_bins(d->model) + PATH] += step;
    d->scale = sqrt(T0 / T);
    state->T = T;
  } else {
    d->scale = 1;
  }
  state->time = first ? 0 : state->time + step;
}

static void set_origin(diffusion *d, int o)
{
  for (int a = 0; a < 3; a++)
    for (size_t g = 0; g < d->path.n; g++) {
      d->origin[o].c[a][g] = (float)(d->path.c[a][g] * d->scale);
      d->origin[o].moved[a][g] = (float)d->path.moved[a][g];
    }
  d->state->began[o] = d->state->time;
}

/* Sums over the grains of one species, at places from..to: products with the origin, squares of displacements. By
 * symmetry in time the velocity at the end of a displacement gives as much information as that at its beginning. */
static void correlate(const diffusion *d, int o, size_t from, size_t to, double *bin)
{
  const double scale = d->scale;
  bin[GG_LAG_COUNT] += (double)(to - from);
  bin[GG_LAG_TIME] += (double)(to - from) * (d->state->time - d->state->began[o]);
  for (int a = 0; a < 3; a++) {
    const double *c = d->path.c[a], *r = d->path.moved[a];
    const float *c0 = d->origin[o].c[a], *r0 = d->origin[o].moved[a];
    double cc = 0, cr = 0, rr = 0;
#pragma omp simd reduction(+ : cc, cr, rr)
    for (size_t g = from; g < to; g++) {
      double moved = r[g] - (double)r0[g], before = (double)c0[g], now = c[g] * scale;
      cc += now * before;
      cr += (now + before) * moved;
      rr += moved * moved;
    }
    bin[GG_LAG_CC + a] += cc;
    bin[GG_LAG_CR + a] += 0.5 * cr;
    bin[GG_LAG_RR + a] += rr;
  }
}

/* The same of components x and y with each other, under shear: C_x later and C_y earlier, and the other way round. */
static void correlate_across(const diffusion *d, int o, size_t from, size_t to, double *bin)
{
  double cc[2] = {0, 0}, cr[2] = {0, 0}, rr = 0;
  for (size_t g = from; g < to; g++) {
    double c[2], before[2], moved[2];
    for (int a = 0; a < 2; a++) {
      c[a] = d->path.c[a][g], before[a] = (double)d->origin[o].c[a][g];
      moved[a] = d->path.moved[a][g] - (double)d->origin[o].moved[a][g];
    }
    rr += moved[0] * moved[1];
    for (int later = 0; later < 2; later++) {
      cc[later] += c[later] * before[!later];
      cr[later] += c[later] * moved[!later] + before[!later] * moved[later];
    }
  }
  for (int later = 0; later < 2; later++) {
    bin[GG_LAG_CC_XY + later] += cc[later];
    bin[GG_LAG_CR + GG_LAG_XY + later] += 0.5 * cr[later];
  }
  bin[GG_LAG_RR + GG_LAG_XY] += rr;
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
      double *at = bin + (k * GG_LAGS + lag) * GG_LAG_WIDTH;
      correlate(d, first + (int)o, from, to, at);
      if (gg_model_is_sheared(d->model)) correlate_across(d, first + (int)o, from, to, at);
      from = to;
    }
  }
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  diffusion *d = self;
  if (d->two_times) {
    gg_measure_two_times_add(d->two_times, s, bin);
    return;
  }
  gg_measure_displacement_take(&d->path, s, d->state->snapshots == 0);
  advance(d, s, bin);
  for (int level = 0, first = 0; level < GG_LAG_LEVELS; first += gg_lag_origins[level++])
    add_level(d, level, first, bin);
  d->state->snapshots++;
}

/* <C_a C_b> of species k at lag 0, as a component. */
static double covariance(const double *bins, int k, int component)
{
  return gg_lag_mean(bins + k * GG_LAGS * GG_LAG_WIDTH, 0, GG_LAG_CC + component);
}

static double mean_square(const double *bins, int k)
{
  return (covariance(bins, k, 0) + covariance(bins, k, 1) + covariance(bins, k, 2)) / 3;
}

/* Factor of the momentum that a grain of species i loses to those of j. */
static double impulse(const gg_model *m, int i, int j)
{
  const int q = gg_pair(i, j);
  return m->density * (double)m->n_of[j] / (double)m->n * m->sigma[q] * m->sigma[q] * m->chi[q] * (1 + m->e[q]) *
         m->mass[j] / (m->mass[i] + m->mass[j]);
}

/* First Sonine approximation for smooth grains without shear: D = <C_a^2>/rate, of the rate at which a grain loses
 * momentum to Maxwellians of the measured temperatures and to a bath (tracers: J.W. Dufty & V. Garzo, J. Stat. Phys.
 * 105 (2001) 723; elastic: Chapman & Cowling). In a cooling gas half the measured cooling rate less: that of
 * velocities in units of v_0. */
static double first_sonine(const gg_model *m, int i, const double *bins)
{
  const double T = mean_square(bins, i);
  double rate = m->bath.on ? m->bath.drag[i] : 0;
  for (int j = 0; j < m->n_species; j++)
    rate += 4 / 3. * impulse(m, i, j) * sqrt(2 * M_PI * (T + mean_square(bins, j)));
  if (gg_flow_cools(m->flow)) rate -= bins[lag_bins(m) + LOSS] / bins[lag_bins(m) + PATH] / 2;
  return T / rate;
}

/* Mean of x over its positive values, of a normal distribution. */
static double positive_part(double mean, double deviation)
{
  const double x = mean / deviation;
  return deviation * exp(-x * x / 2) / sqrt(2 * M_PI) + mean * erfc(-x * M_SQRT1_2) / 2;
}

/* Friction tensor R of a grain in the sheared gas. If all grains of its species drift at u, its momentum changes at the
 * rate -R_il u_l. Velocities are Gaussian with the measured covariances:
 *     R_il = sum_j impulse_ij int dk k_i k_l 2 <x Theta(x)>,   x = (C_1 - C_2).k - gamma sigma_ij k_x k_y
 * over all directions k: midpoints of squares in cos theta and the azimuth about z. Components xx, yy, zz, xy. */
static void friction(const gg_model *m, int i, const double *bins, double R[4])
{
  enum { POLAR = 16, AROUND = 32 };
  for (int a = 0; a < 4; a++) R[a] = a < 3 && m->bath.on ? m->bath.drag[i] : 0;
  for (int j = 0; j < m->n_species; j++) {
    double S[4];
    for (int a = 0; a < 4; a++) S[a] = covariance(bins, i, a) + covariance(bins, j, a);
    const double flow = m->boltzmann ? 0 : m->shear_rate * m->sigma[gg_pair(i, j)];
    for (int p = 0; p < POLAR * AROUND; p++) {
      const double z = (p / AROUND + 0.5) * 2. / POLAR - 1, turn = (p % AROUND + 0.5) * 2 * M_PI / AROUND;
      const double x = sqrt(1 - z * z) * cos(turn), y = sqrt(1 - z * z) * sin(turn);
      const double deviation = sqrt(S[0] * x * x + S[1] * y * y + S[2] * z * z + 2 * S[3] * x * y);
      const double weight =
          4 * M_PI / (POLAR * AROUND) * impulse(m, i, j) * 2 * positive_part(-flow * x * y, deviation);
      const double part[4] = {x * x, y * y, z * z, x * y};
      for (int a = 0; a < 4; a++) R[a] += weight * part[a];
    }
  }
}

/* The tensor of smooth grains under steady shear, to the same order: dC_i/dt = -R_il C_l - gamma delta_ix C_y gives
 *     R_il D_lj + gamma delta_ix D_yj = <C_i C_j>. */
static double sheared_sonine(const gg_model *m, int i, int component, const double *bins)
{
  double R[4], P[GG_LAG_COMPONENTS];
  friction(m, i, bins, R);
  for (int a = 0; a < GG_LAG_COMPONENTS; a++) P[a] = covariance(bins, i, a);
  if (component == 2) return P[2] / R[2];
  const bool by_x = component == 0 || component == GG_LAG_YX; /* down a gradient along x */
  const double upper = R[3] + m->shear_rate, determinant = R[0] * R[1] - upper * R[3];
  const double x = by_x ? P[0] : P[GG_LAG_XY], y = by_x ? P[GG_LAG_YX] : P[1];
  const bool of_x = component == 0 || component == GG_LAG_XY; /* flux along x */
  return of_x ? (R[1] * x - upper * y) / determinant : (R[0] * y - R[3] * x) / determinant;
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

/* Names of a component: those of its correlation and its displacement. */
static const struct component {
  const char *velocities, *displacement, *label;
} components[GG_LAG_COMPONENTS] = {{"Cx", "squared_x", "x"},
                                   {"Cy", "squared_y", "y"},
                                   {"Cz", "squared_z", "z"},
                                   {"Cx_Cy", "product_xy", "xy"},
                                   {"Cy_Cx", NULL, "yx"}};

static gg_curve *put_curve(const gg_model *m, const double *bin, int channel, const char *name, const char *panel,
                           const char *label, gg_curves *list)
{
  gg_curve *c = gg_measure_curve_add(list, GG_LAGS, name, panel, label);
  const double step = gg_lag_mean(bin, 1, GG_LAG_TIME);
  const bool cooling = gg_flow_cools(m->flow);
  gg_measure_curve_axes(c, cooling ? "∫v_0 dt" : "t", cooling ? "d" : gg_measure_curve_unit(m, "time"), "", "");
  c->log_x = true;
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = gg_lag_steps((int)i) * step; /* also at lags without samples */
    c->value[i] = gg_lag_mean(bin, (int)i, channel);
  }
  return c;
}

static void put_axis(gg_curve *c, const char *name, const char *unit)
{
  snprintf(c->y_name, sizeof c->y_name, "%s", name);
  snprintf(c->unit, sizeof c->unit, "%s", unit);
}

static void put_component(const diffusion *d, int species, int a, const double *bin, gg_curves *list)
{
  const gg_model *m = d->model;
  const struct component *of = &components[a];
  const bool mixed = a >= GG_LAG_XY;
  char name[48], label[24], unit[40], tail[16] = "", subscript[16] = "";
  if (m->n_species > 1)
    snprintf(tail, sizeof tail, "_%d", species + 1), snprintf(subscript, sizeof subscript, ",%d", species + 1);
  snprintf(name, sizeof name, "velocity_autocorrelation_%s%s", of->velocities, tail);
  if (mixed)
    snprintf(label, sizeof label, "C_%c(t)C_%c(0)%s", of->label[0], of->label[1], tail);
  else
    snprintf(label, sizeof label, "C_{%s%s}", of->label, subscript);
  gg_curve *c = put_curve(m, bin, (mixed ? GG_LAG_CC_XY - GG_LAG_XY : GG_LAG_CC) + a, name, "velocity autocorrelation",
                          label, list);
  put_axis(c, "<C(0)C(t)>", gg_measure_curve_unit(m, "temperature"));
  gg_diffusion_coefficients D = gg_measure_diffusion_read(m, species, a, bin, (double)list->samples);
  const char *coefficient = m->shear_rate != 0 ? "d^2 gamma" : "d v_0";
  gg_measure_curve_put_truncated(c, "diffusion_green_kubo", D.green_kubo.D, D.green_kubo.unsure, coefficient);
  gg_measure_curve_put_truncated(c, "long_time_tail", D.green_kubo.tail, D.green_kubo.unsure, coefficient);
  const double lacking = lacking_of_box(m, species, bin);
  if (!isnan(lacking)) {
    gg_measure_curve_put_setting(c, "finite_size_correction", lacking, coefficient);
    gg_measure_curve_put_truncated(c, "diffusion_infinite_system", D.green_kubo.D + lacking, D.green_kubo.unsure,
                                   coefficient);
  }
  const double *bins = bin - species * GG_LAGS * GG_LAG_WIDTH;
  if (gg_displacement_has_theory(m) && !gg_model_is_sheared(m))
    gg_measure_curve_put_setting(c, "diffusion_first_sonine", first_sonine(m, species, bins), coefficient);
  if (gg_displacement_has_theory(m) && gg_model_is_sheared(m) && !m->cuts_steps) /* steady */
    gg_measure_curve_put_setting(c, "diffusion_first_sonine", sheared_sonine(m, species, a, bins), coefficient);
  if (!of->displacement) return;
  snprintf(name, sizeof name, "displacement_%s%s", of->displacement, tail);
  snprintf(label, sizeof label, "%s%s", of->label, tail);
  gg_curve *r = put_curve(m, bin, GG_LAG_RR + a, name, mixed ? "<Δx Δy>" : "mean-square displacement", label, list);
  snprintf(unit, sizeof unit, "%.30s^2", gg_measure_curve_unit(m, "length"));
  put_axis(r, mixed ? "<Δx Δy>" : "<(Δr)^2>", unit);
  r->log_y = !mixed;
  gg_measure_curve_put_truncated(r, "diffusion_einstein", D.einstein.D, D.einstein.unsure, coefficient);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const diffusion *d = self;
  if (d->two_times) {
    gg_measure_two_times_curves(d->model, bin, list);
    return;
  }
  for (int k = 0; k < d->model->n_species; k++)
    for (int a = 0; a < (gg_model_is_sheared(d->model) ? GG_LAG_COMPONENTS : 3); a++)
      put_component(d, k, a, bin + k * GG_LAGS * GG_LAG_WIDTH, list);
}

const gg_observable gg_measure_diffusion = {
    GG_OBSERVABLE(DIFFUSION, diffusion),
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .is_memory = is_memory,
    .refuses = refuses,
    .positions = true,
    .rescaled = rescaled,
    .restart = restart,
    .curves = &(const gg_observable_curves){.bins = bins_of,
                                            .every = 1,
                                            .parts = GG_LAG_SNAPSHOTS,
                                            .of_transient = is_of_two_times,
                                            .add_snapshot = add_snapshot,
                                            .of_bins = curves},
    .collisions =
        &(const gg_observable_collisions){.add = add_collision, .wanted = gg_measure_displacement_follows_flights},
    .cost = {.bytes = 700, .ns = {120, 400}},
};
