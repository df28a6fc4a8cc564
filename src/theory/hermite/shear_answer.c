/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/enskog_hermite.h"

#include <math.h>
#include <stdlib.h>

#include "theory/answer.h"
#include "theory/hermite/order_convergence.h"
#include "theory/hermite/shear.h"
#include "theory/hermite/spectrum.h"

static const char name[] = "enskog_hermite";

/* Degrees: beyond GOOD_DEGREE only if errors are above `good` there. */
enum { FIRST_DEGREE = 4, GOOD_DEGREE = 10, SPECTRUM_DEGREE = 8, MOST_SPECIES = 8 };
static const double good = 1e-4;

/* Highest degrees, for some two seconds: the time grows with the number of pairs of species. */
static const int last_degree[MOST_SPECIES + 1] = {0, 12, 12, 10, 8, 8, 6, 6, 6};

int gg_hermite_shear_last_degree(int n_species)
{
  return n_species <= MOST_SPECIES ? last_degree[n_species] : 0;
}

static gg_stress stress_of(double factor, double P[3][3])
{
  return (gg_stress){factor * P[0][0], factor * P[1][1], factor * P[2][2], factor * P[0][1], factor * P[1][0]};
}

/* Kurtoses of the velocities of all grains. */
static void answer_kurtoses(gg_hermite_shear *h, double M[3][3], gg_theory_answer *a)
{
  const gg_quantity kurtosis[] = {GG_Q_KURTOSIS_CX, GG_Q_KURTOSIS_CY, GG_Q_KURTOSIS_CZ};
  for (int k = 0; k < 3; k++) {
    double sum = 0;
    for (int i = 0; i < h->gas.n_species; i++)
      sum += h->gas.fraction[i] * gg_hermite_fourth_moment(&h->op.basis, &h->state[i], k);
    a->value[kurtosis[k]] = sum / (M[k][k] * M[k][k]);
  }
}

static void answer_temperatures(gg_hermite_shear *h, const double T[], gg_theory_answer *a)
{
  double all = 0;
  for (int i = 0; i < h->gas.n_species; i++) all += h->gas.fraction[i] * T[i];
  gg_theory_answer_temperature(h->model, all, NAN, a);
  if (h->gas.n_species == 1) return;
  for (int i = 0; i < h->gas.n_species; i++) a->value[GG_Q_PARTIAL_TEMPERATURE + i] = T[i];
  a->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = T[0] / T[1];
}

static void answer(gg_hermite_shear *h, gg_theory_answer *a)
{
  const gg_model *m = h->model;
  double M[3][3], velocities[3][3] = {{0}}, P[3][3] = {{0}}, T[GG_MAX_SPECIES];
  gg_hermite_sums sums;
  for (int i = 0; i < m->n_species; i++) {
    gg_hermite_second_moments(&h->op.basis, &h->state[i], M);
    T[i] = m->mass[i] * (M[0][0] + M[1][1] + M[2][2]) / 3;
    for (int k = 0; k < 9; k++) {
      velocities[k / 3][k % 3] += h->gas.fraction[i] * M[k / 3][k % 3];
      P[k / 3][k % 3] += h->gas.fraction[i] * m->mass[i] * M[k / 3][k % 3];
    }
  }
  gg_hermite_sums_at(&h->op, &h->gas, h->state, &sums);
  answer_temperatures(h, T, a);
  gg_theory_answer_stress(m, a->value[GG_Q_TEMPERATURE], stress_of(m->density, P), stress_of(m->density, sums.transfer),
                          a);
  a->value[GG_Q_COLLISION_RATE] = sums.rate;
  a->value[GG_Q_MEAN_FREE_PATH] = sums.speed / sums.rate;
  if (!m->boltzmann) a->value[GG_Q_KNUDSEN] = sums.speed / sums.rate / m->length;
  a->value[GG_Q_DISSIPATION] = m->stress_unit * m->density * sums.loss;
  answer_kurtoses(h, velocities, a);
}

/* The slowest mode: mostly that of the temperature. */
static void answer_relaxation(gg_hermite_shear *h, gg_theory_answer *a)
{
  gg_error ignored;
  gg_hermite_mode *mode = malloc((size_t)(h->gas.n_species * h->op.basis.n) * sizeof *mode);
  if (mode && gg_hermite_spectrum(&h->op, &h->gas, h->state, mode, &ignored) == GG_OK)
    a->value[GG_Q_RELAXATION_RATE] = mode[0].decay;
  free(mode);
}

/* Error message: in Newton's method the balance of energy is one equation among those of all quantities that
 * collisions exchange. */
static gg_status refuse(const gg_model *m, const char *why, gg_error *err)
{
  if (gg_theory_is_nearly_elastic(m))
    return gg_theory_reject(err, name, "fails here: the loss of energy is below numerical resolution");
  return gg_theory_reject(err, name, "fails here: %s", why);
}

/* `slow`: separate answers for the relaxation, which low degrees give well. */
static gg_status solve_degrees(gg_hermite_shear *h, gg_hermite_convergence *convergence, gg_hermite_convergence *slow,
                               gg_error *err)
{
  for (int degree = FIRST_DEGREE; degree <= last_degree[h->gas.n_species]; degree += 2) {
    if (degree > GOOD_DEGREE && gg_hermite_convergence_change(convergence, GG_Q_TEMPERATURE) < good &&
        !gg_hermite_shear_has_tails(h))
      break;
    gg_error why;
    if (gg_hermite_shear_solve(h, degree, &why) != GG_OK) return refuse(h->model, why.message, err);
    answer(h, gg_hermite_convergence_next(convergence));
    if (degree <= SPECTRUM_DEGREE) answer_relaxation(h, gg_hermite_convergence_next(slow));
  }
  gg_error why;
  if (gg_hermite_shear_widen(h, &convergence->widened, &why) != GG_OK) return refuse(h->model, why.message, err);
  if (convergence->widened) answer(h, &convergence->wide);
  return GG_OK;
}

gg_status gg_hermite_shear_answer(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_shear h;
  /* Near a turning point of a gas in a bath small errors of the drag are large errors of T. */
  gg_hermite_convergence convergence = {.paired = true, .poor = m->bath.on ? 0.1 : 0}, slow = {.n = 0};
  GG_TRY(gg_theory_require_steady_shear(m, name, err));
  gg_error why;
  if (m->n_species > MOST_SPECIES)
    return gg_theory_reject(err, name, "describes sheared grains of up to %d species; this scene has %d", MOST_SPECIES,
                            m->n_species);
  if (gg_hermite_shear_begin(&h, m, &why) != GG_OK) return refuse(m, why.message, err);
  gg_status status = solve_degrees(&h, &convergence, &slow, err);
  gg_hermite_shear_end(&h);
  if (status == GG_OK) status = gg_hermite_convergence_finish(&convergence, name, GG_Q_TEMPERATURE, 0, a, err);
  if (status == GG_OK) gg_hermite_convergence_take(&slow, GG_Q_RELAXATION_RATE, a);
  return status;
}
