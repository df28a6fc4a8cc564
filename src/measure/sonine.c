/* Deviation of the distribution of speeds from a Maxwellian: Phi_i/Phi_iM = 1 + (c_i/2) Delta_i(v*), with v* = v/v_0,
 * v_0^2 = 2T (m_1 + m_2)/(m_1 m_2) for mixtures and 2T/m for one species; in the first Sonine approximation Delta_i =
 * x^4/2 - 5 x^2/2 + 15/8, x^2 = m_i v^2/(2 T_i) (Montanero & Garzo, Granular Matter 4 (2002) 17). c_i = 2 a_2 is
 * measured along with it: c_i = (8/15)(<x^4> - 15/4), and the third Sonine
 * coefficient a_3 = 1 + 3 a_2 - (8/105) <x^6> (Brilliantov & Poschel, Europhys. Lett. 74 (2006) 424). Velocities are
 * scaled by T_i at each instant. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/needs.h"
#include "measure/observable.h"
#include "measure/sonine_curves.h"

enum { BINS = GG_SONINE_BINS, FOURTH = BINS, SIXTH, SHARE, SET };

typedef struct sonine {
  gg_model model;
} sonine;

static const char *refuses(const gg_model *m)
{
  if (m->shear_rate != 0) return "under shear the distribution is not isotropic; see velocity_distributions";
  return gg_measure_needs_homogeneity(m);
}

static void *create(const gg_model *m, gg_error *err)
{
  sonine *d = gg_base_array_new(1, sizeof *d, err);
  if (d) d->model = *m;
  return d;
}

static size_t bins(const void *self)
{
  return (size_t)((const sonine *)self)->model.n_species * SET;
}

static double square(const gg_snapshot *s, size_t i)
{
  return s->c[0][i] * s->c[0][i] + s->c[1][i] * s->c[1][i] + s->c[2][i] * s->c[2][i];
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  const gg_model *m = &((const sonine *)self)->model;
  double T[GG_MAX_SPECIES] = {0}, total = 0; /* T_i/m_i; sum of m C^2/3 */
  for (size_t i = 0; i < s->n; i++) T[gg_snapshot_species(s, i)] += square(s, i) / 3;
  for (int k = 0; k < m->n_species; k++) total += m->mass[k] * T[k], T[k] /= (double)m->n_of[k];
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    double xx = square(s, i) / (2 * T[k]), at = sqrt(xx) / GG_SONINE_WIDTH;
    if (at < BINS) bin[k * SET + (int)at]++;
    bin[k * SET + FOURTH] += xx * xx;
    bin[k * SET + SIXTH] += xx * xx * xx;
  }
  for (int k = 0; k < m->n_species; k++) bin[k * SET + SHARE] += m->mass[k] * T[k] * (double)m->n / total;
}

/* Velocities over the T_i of the same instant share a fixed energy, that of the species: <x^4> of Gaussian grains is
 * lower by D/(D + 2), D the species' degrees of freedom. Momentum leaves those of the species' own mean the share of
 * the others in the mass: so D = 3(N_i - 1) of all grains, 3 N_i of few light ones, 3 of one grain however heavy. */
static double freedom_of(const gg_model *m, int k)
{
  double mass = 0, n = (double)m->n_of[k];
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i];
  double left = 1 - n * m->mass[k] / mass, sum = n - 1 + left;
  return 3 * sum * sum / (n - 1 + left * left);
}

static void put_species(const gg_model *m, int k, const double *bin, gg_curves *list)
{
  double D = freedom_of(m, k), n = (double)m->n_of[k];
  gg_sonine_sums s = {.fourth = bin[FOURTH] / n * (D + 2) / D,
                      .sixth = bin[SIXTH] / n * (D + 2) * (D + 4) / (D * D),
                      .temperature_ratio = bin[SHARE]};
  for (int i = 0; i < BINS; i++) s.share[i] = bin[i] / n;
  gg_measure_sonine_curves_put(list, m, k, &s);
  gg_measure_sonine_polynomial_put(list, m, k, s.temperature_ratio);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const gg_model *m = &((const sonine *)self)->model;
  for (int k = 0; k < m->n_species; k++) put_species(m, k, bin + k * SET, list);
}

const gg_observable gg_measure_sonine = {
    GG_OBSERVABLE(SONINE, sonine), .create = create, .destroy = free, .refuses = refuses, .bins = bins, .every = 2,
    .add_snapshot = add_snapshot,  .curves = curves,
};
