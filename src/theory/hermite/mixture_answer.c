#include "theory/hermite/mixture_answer.h"

#include <math.h>

#include "common/thermostat.h"
#include "theory/answer.h"
#include "theory/hermite/mixture.h"
#include "theory/hermite/rungs.h"

static const char name[] = "enskog_hermite";

/* Degrees 4 to 14. */
enum { FIRST = 2, LAST = 7 };
static const double good = 1e-8;

/* Collisions of a grain, and p_c over n T = (2 pi/3) sum_ij x_i n_j chi_ij sigma_ij^3 J_ij <g^2>/2, at T = 1. */
static double collision_rate(const gg_model *m, const gg_hermite_mixture *x)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      double frequency = m->density * gg_fraction(m, j) * m->chi[pair] * m->sigma[pair] * m->sigma[pair];
      sum += gg_fraction(m, i) * 4 * M_PI * frequency * gg_hermite_mixture_flux(x, i, j, 1);
    }
  return sum;
}

static double transfer(const gg_model *m, const gg_hermite_mixture *x)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      double volume = m->density * gg_fraction(m, j) * m->chi[pair] * pow(m->sigma[pair], 3);
      double impulse = m->contact[i][j].jn * gg_hermite_mixture_flux(x, i, j, 2);
      sum += gg_fraction(m, i) * 2 * M_PI / 3 * volume * impulse;
    }
  return sum;
}

static void answer_mixture(const gg_model *m, const gg_hermite_mixture *x, gg_theory_answer *a)
{
  double partial[GG_MAX_SPECIES], T = m->temperature0, p = m->density * T;
  for (int i = 0; i < m->n_species; i++) {
    double square = gg_hermite_mixture_square(x, i);
    partial[i] = T * m->mass[i] * x->scale[i] * x->scale[i] * square;
    a->value[GG_Q_CUMULANT + i] = 2 * (gg_hermite_mixture_fourth(x, i) / (15 * square * square) - 1);
  }
  a->value[GG_Q_COOLING_RATE] = x->cooling_rate / gg_model_nu0(m, 1);
  a->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = partial[0] / partial[1];
  if (m->linear_response) return; /* no temperature of its own: it grows */
  gg_answer_temperature(m, T, NAN, a);
  for (int i = 0; i < m->n_species; i++) a->value[GG_Q_PARTIAL_TEMPERATURE + i] = partial[i];
  gg_answer_pressure(m, T, p, p * transfer(m, x), a);
  a->value[GG_Q_COLLISION_RATE] = collision_rate(m, x) * sqrt(T);
}

static gg_status require(const gg_model *m, gg_error *err)
{
  GG_TRY(gg_require_smooth(m, name, err));
  if (m->flow == GG_USF)
    return gg_refuse(err, name, "describes sheared grains of one species; this scene has %d", m->n_species);
  if (gg_thermostat_of(m) == GG_WHITE_NOISE)
    return gg_refuse(err, name, "describes mixtures that cool or have a Gaussian thermostat; this one has white noise");
  return GG_OK;
}

gg_status gg_hermite_mixture_answer(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_rungs rungs = {.n = 0};
  gg_hermite_mixture x = {.cooling_rate = 0};
  gg_error why;
  GG_TRY(require(m, err));
  for (int l = FIRST; l <= LAST; l++) {
    if (gg_rungs_error(&rungs, GG_Q_COOLING_RATE) < good) break;
    if (gg_hermite_mixture_solve(&x, m, l, &why) != GG_OK) return gg_refuse(err, name, "fails here: %s", why.message);
    answer_mixture(m, &x, gg_rungs_next(&rungs));
  }
  return gg_rungs_finish(&rungs, name, GG_Q_PARTIAL_TEMPERATURE_RATIO, a, err);
}
