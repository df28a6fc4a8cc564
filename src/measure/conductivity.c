/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heat flux of linear response in the cooling state, or at rest, of grains of one species:
 *   f = f0 + A . grad ln T + B . grad ln n,   q = -kappa grad T - mu grad n,
 * in the frame in which T = m = 1 and time is u = int sqrt(T) dt. With L, the linearised collisions and the
 * rescaling, and S, the source terms of both gradients (V. Garzo and J.W. Dufty, Phys. Rev. E 59 (1999) 5895),
 *   A = int e^(zeta u/2) e^(L u) S_A du,   B = int e^(L u) [S_B + zeta (1 + slope) A] du,   slope = d ln chi/d ln
 *   n:
 *   kappa_k = -n int e^(zeta u/2) <q(u) S_A/f0> du,
 *   mu_k = -T int <q(u) [S_B/f0 + 2 (1 + slope)(e^(zeta u/2) - 1) S_A/f0]> du,   q = C^2 C_x/2,
 * the Green-Kubo form (J.W. Dufty and J.J. Brey, J. Stat. Phys. 109 (2002) 433). Rough grains, whose theta is
 * proportional to T, also have q = K s^2 C_x/2, where s is the velocity of the surface. Their collisional transfer
 * of f1 is measured from pairs; that of smooth grains is known. e^(zeta u/2) is the ratio of the thermal speed at
 * the beginning of a lag to that at its end.
 * Averages: heat_copies.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/heat_copies.h"
#include "measure/observable.h"

typedef struct conductivity {
  gg_heat_copies copies;
  double row[GG_HEAT_MOST];
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
  gg_measure_heat_copies_clear(&((conductivity *)self)->copies);
  free(self);
}

static void *create(const gg_model *model, gg_error *err)
{
  conductivity *d = gg_base_array_new(1, sizeof *d, err);
  if (!d || gg_measure_heat_copies_make(&d->copies, model, err) == GG_OK) return d;
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
  return (size_t)gg_measure_heat_layout(m).channels;
}

static size_t bins(const void *self)
{
  const gg_heat_layout *l = &((const conductivity *)self)->copies.at;
  return (size_t)(l->at_lag + l->steps * l->lag);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  conductivity *d = self;
  const gg_heat_layout *l = &d->copies.at;
  double all[GG_HEAT_MOST] = {0};
  if (!d->memory.seeded) { /* replicas differ by their grains */
    uint64_t seed;
    memcpy(&seed, s->c[0], sizeof seed);
    d->memory.rng = gg_common_rng_seed(seed, 0), d->memory.seeded = 1;
  }
  gg_measure_heat_copies_follow(&d->copies, s, &d->memory.rng, all);
  for (int k = 0; k < l->at_lag + l->steps * l->lag; k++) bin[k] += all[k];
  memcpy(d->row, all, (size_t)l->at_lag * sizeof *all);
  memcpy(d->row + l->at_lag, all + l->at_lag + (l->steps - 1) * l->lag, (size_t)l->lag * sizeof *all);
}

/* The row is that of the snapshot at the end of its interval; 0 before averaging. */
static void finish(void *self, const gg_interval *in, double *row)
{
  conductivity *d = self;
  (void)in;
  memcpy(row, d->row, (size_t)d->copies.at.channels * sizeof *row);
  memset(d->row, 0, sizeof d->row);
}

/* Solve matrix x = a, n unknowns; x replaces a. */
static void solve(double matrix[GG_HEAT_ORDERS][GG_HEAT_ORDERS], double *a, int n)
{
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      if (j == i) continue;
      const double f = matrix[j][i] / matrix[i][i];
      for (int k = i; k < n; k++) matrix[j][k] -= f * matrix[i][k];
      a[j] -= f * a[i];
    }
  for (int i = 0; i < n; i++) a[i] /= matrix[i][i];
}

/* Density dependence: 2 (1 + e) phi chi; n sigma^2 chi; d ln chi/d ln n. All 0 in the Boltzmann limit. */
typedef struct density {
  double y, frequency, slope;
} density;

static density density_of(const gg_model *m)
{
  if (m->boltzmann) return (density){0};
  return (density){2 * (1 + m->e[0]) * m->phi * m->chi[0], m->density * m->chi[0], m->chi_slope};
}

/* <S b_m> of both sources. */
static void sources(const double *mean, const gg_heat_layout *l, density d, double s[2][GG_HEAT_ORDERS])
{
  const double distant = 4 * M_PI / 3 * d.frequency;
  for (int m = 0; m < l->n; m++) {
    const double pressed = mean[l->diverged + m], projected = mean[l->projected + m];
    s[0][m] =
        (1 + d.y) * pressed - (gg_heat_functions[m].degree + 1) / 2. * projected + distant * mean[l->distant_T + m];
    s[1][m] = (1 + d.y * (2 + d.slope)) * pressed - projected + (1 + d.slope / 2) * distant * mean[l->distant_n + m];
  }
}

/* All lags from one of length u on: flux (1 + P + P^2 + ...) <b b>^-1 <S b>, P = <b b>^-1 <b(u) b>. */
static double all_lags(const double *mean, const gg_heat_layout *l, double fading, const double *flux,
                       const double *source)
{
  double matrix[GG_HEAT_ORDERS][GG_HEAT_ORDERS], x[GG_HEAT_ORDERS], sum = 0;
  for (int m = 0; m < l->n; m++) {
    x[m] = source[m];
    for (int n = 0; n < l->n; n++)
      matrix[m][n] = mean[l->overlap + m * l->n + n] - fading * mean[l->at_lag + l->kept + m * l->n + n];
  }
  solve(matrix, x, l->n);
  for (int n = 0; n < l->n; n++) sum += flux[n] * x[n];
  return sum;
}

typedef struct heat { /* of one flux, over -kappa_0 */
  double conductivity, diffusive;
} heat;

static heat flux_of(const double *mean, const gg_model *m, int q)
{
  const gg_heat_layout l = gg_measure_heat_layout(m);
  const density d = density_of(m);
  const double *lag = mean + l.at_lag, *kept[2] = {lag + l.flux[0] + q * l.n, lag + l.flux[1] + q * l.n};
  double s[2][GG_HEAT_ORDERS];
  sources(mean, &l, d, s);
  const double kappa = all_lags(mean, &l, lag[l.fading], kept[0], s[0]);
  const double mu =
      all_lags(mean, &l, 1, kept[1], s[1]) + 2 * (1 + d.slope) * (kappa - all_lags(mean, &l, 1, kept[1], s[0]));
  return (heat){kappa, mu};
}

/* Heat flux with collisional transfer: for smooth grains a fraction of the kinetic flux, for rough ones a separate
 * flux. */
static heat heat_of(const double *mean, const gg_model *m, bool spin)
{
  const gg_heat_layout l = gg_measure_heat_layout(m);
  const density d = density_of(m);
  if (spin && l.n == GG_HEAT_SMOOTH) return (heat){NAN, NAN};
  const double unit = -4. / 15 * gg_common_model_nu0(m, 1), share = l.n == GG_HEAT_SMOOTH ? 0.6 * d.y : 0;
  heat h = flux_of(mean, m, spin ? GG_HEAT_ROTATION : GG_HEAT_TRANSLATION), more = {0};
  if (l.fluxes == GG_HEAT_FLUXES)
    more = flux_of(mean, m, spin ? GG_HEAT_CARRIED_ROTATION : GG_HEAT_CARRIED_TRANSLATION);
  const double distant = 4 * M_PI / 3 * d.frequency * mean[l.carried + spin];
  return (heat){unit * (h.conductivity * (1 + share) + more.conductivity - distant),
                unit * (h.diffusive * (1 + share) + more.diffusive)};
}

static double kinetic(const double *mean, const gg_model *m)
{
  return -4. / 15 * gg_common_model_nu0(m, 1) * flux_of(mean, m, GG_HEAT_TRANSLATION).conductivity;
}
static double total(const double *mean, const gg_model *m)
{
  return heat_of(mean, m, false).conductivity;
}
static double diffusive(const double *mean, const gg_model *m)
{
  return heat_of(mean, m, false).diffusive;
}
static double rotational(const double *mean, const gg_model *m)
{
  return heat_of(mean, m, true).conductivity;
}
static double rotational_diffusive(const double *mean, const gg_model *m)
{
  return heat_of(mean, m, true).diffusive;
}

static const gg_derived derived[] = {
    {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, .of = total},
    {GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC, .of = kinetic},
    {GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED, .of = diffusive},
    {GG_Q_ROTATIONAL_CONDUCTIVITY_REDUCED, .of = rotational},
    {GG_Q_ROTATIONAL_DIFFUSIVE_CONDUCTIVITY_REDUCED, .of = rotational_diffusive},
    GG_DERIVED_END,
};

static gg_curve *start(gg_curves *list, size_t n, const char *name, const char *panel, const char *label)
{
  gg_curve *c = gg_measure_curve_add(list, n, name, panel, label);
  gg_measure_curve_axes(c, "ν_0 t", "1", label, "1");
  return c;
}

/* Curves for other lengths of the steps: they are constant if the functions b are enough for f1. */
static void curves(const void *self, const double *bin, gg_curves *list)
{
  const conductivity *d = self;
  gg_curve *c[2] = {
      start(list, (size_t)d->copies.at.steps, "thermal_conductivity_of_lag", "thermal conductivity", "κ*"),
      start(list, (size_t)d->copies.at.steps, "diffusive_heat_conductivity_of_lag", "diffusive heat conductivity",
            "μ*")};
  const gg_heat_layout *l = &d->copies.at;
  double mean[GG_HEAT_MOST];
  memcpy(mean, bin, (size_t)l->at_lag * sizeof *mean);
  for (size_t i = 0; i < (size_t)d->copies.at.steps; i++) {
    memcpy(mean + l->at_lag, bin + l->at_lag + (int)i * l->lag, (size_t)l->lag * sizeof *mean);
    const heat h = heat_of(mean, d->copies.model, false);
    const double value[2] = {h.conductivity, h.diffusive};
    for (int q = 0; q < 2 && c[q]->n; q++)
      c[q]->x[i] = mean[l->at_lag + l->time] * gg_common_model_nu0(d->copies.model, 1), c[q]->value[i] = value[q];
  }
}

const gg_observable gg_measure_conductivity = {
    GG_OBSERVABLE(CONDUCTIVITY, conductivity),
    .create = create,
    .destroy = destroy,
    .memory = memory_of,
    .refuses = refuses,
    .rows = &(const gg_observable_rows){.width = width, .finish = finish, .derived = derived},
    .curves = &(const gg_observable_curves){.bins = bins, .every = 1, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.bytes = 96, .ns = {0, 180}},
};
