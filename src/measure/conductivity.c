/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heat flux of linear response in the cooling state, or at rest, of smooth grains of one species:
 *   f = f0 + A . grad ln T + B . grad ln n,   q = -kappa grad T - mu grad n,
 * in the frame in which T = m = 1 and time is u = int sqrt(T) dt. With L, the linearised collisions and the rescaling,
 * and S, what both gradients make of f0 (V. Garzo and J.W. Dufty, Phys. Rev. E 59 (1999) 5895),
 *   A = int e^(zeta u/2) e^(L u) S_A du,   B = int e^(L u) [S_B + zeta (1 + slope) A] du,   slope = d ln chi/d ln n:
 *   kappa_k = -n int e^(zeta u/2) <q(u) S_A/f0> du,
 *   mu_k = -T int <q(u) [S_B/f0 + 2 (1 + slope)(e^(zeta u/2) - 1) S_A/f0]> du,   q = C^2 C_x/2,
 * as Green and Kubo have it (J.W. Dufty and J.J. Brey, J. Stat. Phys. 109 (2002) 433). e^(zeta u/2) is the thermal
 * speed at the beginning of a lag over that at its end.
 *
 * In sums over all grains noise would drown them where gases cool fast. So f1/f0 is followed instead: copies of the
 * grains carry it as weights w, and collide for some time. Two that collide both get w_1 + w_2; a candidate that is
 * rejected, of probability p, takes w_2 p/(1 - p) from w_1, and w_1 p/(1 - p) from w_2. Their average is the linearised
 * collision operator (H.A. Al-Mohssen and N.G. Hadjiconstantinou, J. Comput. Phys. 229 (2010) 4481), but the variance
 * grows with every collision. After STEPS f1 is therefore expanded anew, as f0 sum_n s_n b_n, b_n = C_x
 * L_n^(3/2)(C^2/2), with the moments <b_m f1> that it has; the sources likewise. Longer lags follow by repetition. What
 * an expansion leaves out has decayed within STEPS: the curves show what they do. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/rng.h"
#include "measure/observable.h"

enum { ORDERS = 3, SQUARE = ORDERS * ORDERS, STEPS = 4 };

/* Of a row: <C^j>, j from 1 to ORDERS + 2; averages over pairs, for partners at a distance; <b_m b_n>; and a lag. */
enum { MOMENTS, DISTANT_T = MOMENTS + ORDERS + 2, DISTANT_N = DISTANT_T + ORDERS, CARRIED = DISTANT_N + ORDERS };
enum { OVERLAP = CARRIED + 1, AT_LAG = OVERLAP + SQUARE };
/* Of a lag u: u, e^(zeta u/2), <b_m(u) b_n>, and the integral of <b_2 b_n> up to u, with e^(zeta u/2) and without. */
enum { TIME, FADING, KEPT, FLUX_FADING = KEPT + SQUARE, FLUX = FLUX_FADING + ORDERS, LAG = FLUX + ORDERS };
enum { CHANNELS = AT_LAG + LAG };

typedef struct carrier { /* a grain, with a weight for every b_n and component */
  double c[3], w[ORDERS][3];
} carrier;

typedef struct conductivity {
  gg_model model;
  carrier *grain;
  double row[CHANNELS], momentum[ORDERS]; /* of b_n: <C_x b_n> */
  struct memory {
    gg_rng rng;
    uint64_t seeded;
  } memory;
} conductivity;

static const char *refuses(const gg_model *m)
{
  const char *reason = gg_common_model_missing(m, GG_NEEDS_HEAT_FLUX);
  return reason || m->homogeneous ? reason : "needs engine: dsmc; in md measure helfand";
}

static void destroy(void *self)
{
  free(((conductivity *)self)->grain);
  free(self);
}

static void *create(const gg_model *model, gg_error *err)
{
  conductivity *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = *model;
  d->grain = gg_base_array_new((size_t)model->n, sizeof *d->grain, err);
  if (d->grain) return d;
  free(d);
  return NULL;
}

static void *memory_of(void *self, size_t *bytes)
{
  conductivity *d = self;
  *bytes = sizeof d->memory;
  return &d->memory;
}

static size_t width(const gg_model *m)
{
  (void)m;
  return CHANNELS;
}

static size_t bins(const void *self)
{
  (void)self;
  return AT_LAG + STEPS * LAG;
}

/* Where all grains share a fixed energy, D degrees of freedom of it, <C^j> is lower by j (j - 2)/(4 D) (sonine.c). */
static void add_moments(const gg_snapshot *s, double T, double *bin)
{
  const double D = 3 * (double)(s->n - 1);
  double sum[ORDERS + 3] = {0};
  for (size_t i = 0; i < s->n; i++) {
    double square = 0, p = 1;
    for (int a = 0; a < 3; a++) square += s->c[a][i] * s->c[a][i];
    const double C = sqrt(square / T);
    for (int j = 1; j < ORDERS + 3; j++) sum[j] += p *= C;
  }
  for (int j = 1; j < ORDERS + 3; j++) bin[MOMENTS + j - 1] += sum[j] / (double)s->n * (1 + j * (j - 2) / (4 * D));
}

/* The grain `c` that meets `partner` ahead along an axis; their relative velocity g > 0. Partners a diameter away are
 * of another temperature, or density. */
static void add_meeting(const conductivity *d, const double c[3], int axis, double partner, double w, double *bin)
{
  const double eta = (1 + d->model.e[0]) / 2, z = c[axis], g = z - partner, after = z - eta * g;
  const double square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2], square_after = square + after * after - z * z;
  const double C = sqrt(square), C_after = sqrt(square_after), share = after * after / square_after;
  double p = 1, p_after = 1;
  for (int m = 1; m <= ORDERS; m++) {
    p *= C, p_after *= C_after;
    const double change = after * p_after - z * p, along = p_after * (1 + m * share); /* along: d b_m/dC_z */
    bin[DISTANT_T + m - 1] -= w * partner / 2 * (change - eta * g * along);
    bin[DISTANT_N + m - 1] += w * g * change;
  }
  bin[CARRIED] -= w * (g * (z + partner) * (z + partner) / 2 + g * g * g / 4);
}

/* Pairs at a random distance in the ensemble's order. */
static void add_pairs(conductivity *d, const gg_snapshot *s, double T, double *bin)
{
  const size_t shift = 1 + gg_rng_below(&d->memory.rng, (uint32_t)s->n - 1);
  const double unit = 1 / sqrt(T), w = 1 / (6 * (double)s->n);
  for (size_t i = 0; i < s->n; i++) {
    const size_t j = i + shift < s->n ? i + shift : i + shift - s->n;
    double a[3], b[3];
    for (int k = 0; k < 3; k++) a[k] = s->c[k][i] * unit, b[k] = s->c[k][j] * unit;
    for (int k = 0; k < 3; k++) add_meeting(d, a[k] > b[k] ? a : b, k, fmin(a[k], b[k]), w, bin);
  }
}

/* Copies at T = 1; the weights are b_n without its momentum. */
static void copy(conductivity *d, const gg_snapshot *s, double T)
{
  const double unit = 1 / sqrt(T);
  memset(d->momentum, 0, sizeof d->momentum);
  for (size_t i = 0; i < s->n; i++) {
    carrier *g = &d->grain[i];
    double square = 0, p = 1;
    for (int a = 0; a < 3; a++) g->c[a] = s->c[a][i] * unit, square += g->c[a] * g->c[a];
    for (int n = 0; n < ORDERS; n++) {
      g->w[n][0] = p *= sqrt(square);
      d->momentum[n] += square / 3 * p / (double)s->n;
    }
  }
  for (size_t i = 0; i < s->n; i++) {
    carrier *g = &d->grain[i];
    for (int n = 0; n < ORDERS; n++) {
      const double w = g->w[n][0] - d->momentum[n];
      for (int a = 0; a < 3; a++) g->w[n][a] = g->c[a] * w;
    }
  }
}

/* <b_m w_n> of the copies in units of their own T, which is returned; b_m without momentum, of which w_n has none on
 * average, but noise. */
static double overlap(const conductivity *d, double *to)
{
  const size_t n = (size_t)d->model.n;
  double squares = 0, sum[ORDERS + 1][ORDERS] = {{0}};
  for (size_t i = 0; i < n; i++) {
    const carrier *g = &d->grain[i];
    const double square = g->c[0] * g->c[0] + g->c[1] * g->c[1] + g->c[2] * g->c[2], C = sqrt(square);
    squares += square;
    for (int k = 0; k < ORDERS; k++) {
      double p = g->c[0] * g->w[k][0] + g->c[1] * g->w[k][1] + g->c[2] * g->w[k][2];
      for (int m = 0; m <= ORDERS; m++, p *= C) sum[m][k] += p;
    }
  }
  const double T = squares / (3 * (double)n), first = 1 / (3 * (double)n * sqrt(T));
  double unit = first;
  for (int m = 0; m < ORDERS; m++) {
    unit /= sqrt(T);
    for (int k = 0; k < ORDERS; k++) to[m * ORDERS + k] = unit * sum[m + 1][k] - first * d->momentum[m] * sum[0][k];
  }
  return T;
}

/* Both get the sum of their weights, and the velocities of a collision: with r uniform on the sphere c12 - |c12| r is
 * twice the normal velocity. */
static void collide(carrier *a, carrier *b, double eta, const double c12[3], double speed, gg_rng *rng)
{
  const gg_vec r = gg_rng_direction(rng);
  const double turned[3] = {r.x, r.y, r.z};
  for (int k = 0; k < 3; k++) {
    const double kick = eta / 2 * (c12[k] - speed * turned[k]);
    a->c[k] -= kick, b->c[k] += kick;
  }
  for (int n = 0; n < ORDERS; n++)
    for (int k = 0; k < 3; k++) a->w[n][k] = b->w[n][k] = a->w[n][k] + b->w[n][k];
}

static void reject(carrier *a, carrier *b, double odds)
{
  for (int n = 0; n < ORDERS; n++)
    for (int k = 0; k < 3; k++) {
      const double one = a->w[n][k], two = b->w[n][k];
      a->w[n][k] -= odds * two, b->w[n][k] -= odds * one;
    }
}

/* Far above all relative speeds at T = 1, so that the odds of rejected candidates are small. */
static const double majorant = 12;

/* As many candidates as grains; returns the time that they are worth. */
static double step(conductivity *d)
{
  const uint32_t n = (uint32_t)d->model.n;
  const double eta = (1 + d->model.e[0]) / 2, sigma = d->model.sigma[0];
  for (uint32_t candidate = 0; candidate < n; candidate++) {
    const uint32_t i = gg_rng_below(&d->memory.rng, n), j = gg_rng_below(&d->memory.rng, n - 1);
    carrier *a = &d->grain[i], *b = &d->grain[j < i ? j : j + 1];
    double c12[3], square = 0;
    for (int k = 0; k < 3; k++) c12[k] = a->c[k] - b->c[k], square += c12[k] * c12[k];
    const double speed = sqrt(square), p = fmin(speed / majorant, 0.9);
    if (gg_rng_uniform(&d->memory.rng) < p)
      collide(a, b, eta, c12, speed, &d->memory.rng);
    else
      reject(a, b, p / (1 - p));
  }
  return 2 / ((1 - 1. / n) * M_PI * d->model.density * d->model.chi[0] * sigma * sigma * majorant);
}

/* The lags, one behind the other. Time from step to step: the gas cools as 1/(1 + rate t). Integrals by trapezes, with
 * Gregory's correction at both ends. */
static void follow(conductivity *d, double *start, double *lag)
{
  double speed = sqrt(overlap(d, start)), before[2][ORDERS], flux[2][ORDERS] = {{0}}, time = 0;
  for (int n = 0; n < ORDERS; n++) before[0][n] = before[1][n] = start[ORDERS + n];
  for (int k = 0; k < STEPS; k++, lag += LAG) {
    const double dt = step(d), last = speed;
    speed = sqrt(overlap(d, lag + KEPT));
    const double span = 2 * dt * speed * last / (speed + last);
    lag[TIME] = time += span;
    lag[FADING] = 1 / speed;
    for (int n = 0; n < ORDERS; n++) {
      const double now[2] = {lag[KEPT + ORDERS + n] / speed, lag[KEPT + ORDERS + n]};
      for (int f = 0; f < 2; f++) {
        const double slope = (now[f] - before[f][n]) / 12;
        flux[f][n] += span * ((before[f][n] + now[f]) / 2 + (k == 0 ? slope : 0));
        lag[f ? FLUX + n : FLUX_FADING + n] = flux[f][n] - span * slope;
        before[f][n] = now[f];
      }
    }
  }
}

static double temperature_of(const gg_snapshot *s)
{
  double cc = 0;
  for (int a = 0; a < 3; a++)
    for (size_t i = 0; i < s->n; i++) cc += s->c[a][i] * s->c[a][i];
  return cc / (3 * (double)s->n);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  conductivity *d = self;
  double all[AT_LAG + STEPS * LAG] = {0};
  const double T = temperature_of(s);
  if (!d->memory.seeded) { /* replicas differ by their grains */
    uint64_t seed;
    memcpy(&seed, s->c[0], sizeof seed);
    d->memory.rng = gg_common_rng_seed(seed, 0), d->memory.seeded = 1;
  }
  add_moments(s, T, all);
  if (!d->model.boltzmann) add_pairs(d, s, T, all);
  copy(d, s, T);
  follow(d, all + OVERLAP, all + AT_LAG);
  for (int k = 0; k < AT_LAG + STEPS * LAG; k++) bin[k] += all[k];
  memcpy(d->row, all, AT_LAG * sizeof *all);
  memcpy(d->row + AT_LAG, all + AT_LAG + (STEPS - 1) * LAG, LAG * sizeof *all);
}

/* Rows are made of the snapshot at the end of their interval; there is none before averaging. */
static void begin(void *self)
{
  (void)self;
}
static void add_chunk(void *self, const gg_chunk *chunk)
{
  (void)self, (void)chunk;
}
static void add_blocks(void *self, const gg_block_run *run)
{
  (void)self, (void)run;
}
static void finish(void *self, const gg_interval *in, double *row)
{
  conductivity *d = self;
  (void)in;
  memcpy(row, d->row, sizeof d->row);
  memset(d->row, 0, sizeof d->row);
}

/* matrix x = a; x takes the place of a. */
static void solve(double matrix[ORDERS][ORDERS], double *a)
{
  for (int i = 0; i < ORDERS; i++)
    for (int j = 0; j < ORDERS; j++) {
      if (j == i) continue;
      const double f = matrix[j][i] / matrix[i][i];
      for (int k = i; k < ORDERS; k++) matrix[j][k] -= f * matrix[i][k];
      a[j] -= f * a[i];
    }
  for (int i = 0; i < ORDERS; i++) a[i] /= matrix[i][i];
}

/* What density does: 2 (1 + e) phi chi; n sigma^2 chi; d ln chi/d ln n. All 0 in the Boltzmann limit. */
typedef struct density {
  double y, frequency, slope;
} density;

static density density_of(const gg_model *m)
{
  if (m->boltzmann) return (density){0};
  return (density){2 * (1 + m->e[0]) * m->phi * m->chi[0], m->density * m->chi[0], m->chi_slope};
}

/* <S b_m> of both sources. */
static void sources(const double *mean, density d, double s[2][ORDERS])
{
  const double distant = 4 * M_PI / 3 * d.frequency;
  for (int m = 1; m <= ORDERS; m++) {
    const double power = mean[MOMENTS + m - 1], higher = mean[MOMENTS + m + 1], pressed = (1 + m / 3.) * power;
    s[0][m - 1] = (1 + d.y) * pressed - (m + 2) / 6. * higher + distant * mean[DISTANT_T + m - 1];
    s[1][m - 1] =
        (1 + d.y * (2 + d.slope)) * pressed - higher / 3 + (1 + d.slope / 2) * distant * mean[DISTANT_N + m - 1];
  }
}

typedef struct heat {
  double kinetic, conductivity, diffusive; /* over kappa_0 */
} heat;

/* All lags from one of length u on: flux (1 + P + P^2 + ...) <b b>^-1 <S b>, P = <b b>^-1 <b(u) b>. */
static double all_lags(const double *mean, double fading, int flux, const double *source)
{
  double matrix[ORDERS][ORDERS], x[ORDERS], sum = 0;
  for (int m = 0; m < ORDERS; m++) {
    x[m] = source[m];
    for (int n = 0; n < ORDERS; n++)
      matrix[m][n] = mean[OVERLAP + m * ORDERS + n] - fading * mean[AT_LAG + KEPT + m * ORDERS + n];
  }
  solve(matrix, x);
  for (int n = 0; n < ORDERS; n++) sum += mean[AT_LAG + flux + n] * x[n];
  return sum;
}

static heat heat_of(const double *mean, const gg_model *m)
{
  const density d = density_of(m);
  const double unit = -4. / 15 * gg_common_model_nu0(m, 1), fading = mean[AT_LAG + FADING];
  double s[2][ORDERS];
  sources(mean, d, s);
  const double kappa = all_lags(mean, fading, FLUX_FADING, s[0]) / 2; /* q = b_2/2 */
  const double mu = all_lags(mean, 1, FLUX, s[1]) / 2 + (1 + d.slope) * (2 * kappa - all_lags(mean, 1, FLUX, s[0]));
  const double transfer = 1 + 0.6 * d.y, eta = (1 + m->e[0]) / 2;
  const double carried = 4 * M_PI / 3 * d.frequency * mean[CARRIED];
  return (heat){unit * kappa, unit * (kappa * transfer + eta / 4 * carried), unit * mu * transfer};
}

static double kinetic(const double *mean, const gg_model *m)
{
  return heat_of(mean, m).kinetic;
}
static double total(const double *mean, const gg_model *m)
{
  return heat_of(mean, m).conductivity;
}
static double diffusive(const double *mean, const gg_model *m)
{
  return heat_of(mean, m).diffusive;
}

static const gg_derived derived[] = {
    {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, .of = total},
    {GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC, .of = kinetic},
    {GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED, .of = diffusive},
    GG_DERIVED_END,
};

static gg_curve *start(gg_curves *list, size_t n, const char *name, const char *panel, const char *label)
{
  gg_curve *c = gg_measure_curve_add(list, n, name, panel, label);
  gg_measure_curve_axes(c, "ν_0 t", "1", label, "1");
  return c;
}

/* With steps of other lengths: constant where f1 needs no more functions b than there are. */
static void curves(const void *self, const double *bin, gg_curves *list)
{
  const conductivity *d = self;
  gg_curve *c[2] = {start(list, STEPS, "thermal_conductivity_of_lag", "thermal conductivity", "κ*"),
                    start(list, STEPS, "diffusive_heat_conductivity_of_lag", "diffusive heat conductivity", "μ*")};
  double mean[CHANNELS];
  memcpy(mean, bin, AT_LAG * sizeof *mean);
  for (size_t i = 0; i < STEPS; i++) {
    memcpy(mean + AT_LAG, bin + AT_LAG + i * LAG, LAG * sizeof *mean);
    const heat h = heat_of(mean, &d->model);
    const double value[2] = {h.conductivity, h.diffusive};
    for (int q = 0; q < 2 && c[q]->n; q++)
      c[q]->x[i] = mean[AT_LAG + TIME] * gg_common_model_nu0(&d->model, 1), c[q]->value[i] = value[q];
  }
}

const gg_observable gg_measure_conductivity = {
    GG_OBSERVABLE(CONDUCTIVITY, conductivity),
    .create = create,
    .destroy = destroy,
    .memory = memory_of,
    .refuses = refuses,
    .width = width,
    .begin = begin,
    .add_chunk = add_chunk,
    .add_blocks = add_blocks,
    .finish = finish,
    .derived = derived,
    .bins = bins,
    .every = 1,
    .add_snapshot = add_snapshot,
    .curves = curves,
};
