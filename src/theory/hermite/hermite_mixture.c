/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/hermite_mixture.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/answer.h"
#include "theory/hermite/basis.h"
#include "theory/hermite/hermite_state.h"
#include "theory/hermite/overlap.h"

enum { L1 = GG_RADIAL_MOST + 1, APPROACH = 40, CENTRE = 56, MOST_ITERATIONS = 40, MOST_MOVES = 30 };

/* Limits: beyond `farthest` the weight is below 1e-31. */
static const double farthest = 12, converged = 1e-11, still = 1e-6;

/* < g [psi_J(x1') - psi_J(x1)] Ho_2j(x1) Ho_2l(x2) > of one pair of species, psi of even J with and without decay. */
typedef struct gg_normal {
  double of[2][L1][L1][L1];
} gg_normal;

typedef struct gg_solver {
  const gg_model *model;
  gg_hermite_mixture *mixture;
  int species, l; /* unknowns of one species: l = 1 .. */
  gg_normal *normal;
  gsl_matrix *J;
  gsl_vector *x;
  gsl_permutation *order;
} gg_solver;

static double share_of(const gg_model *m, int i, int j)
{
  int pair = gg_pair(i, j);
  return m->density * gg_theory_fraction(m, j) * m->chi[pair] * m->sigma[pair] * m->sigma[pair];
}

/* x1' = x1 - kick u, in the units of species i: both normal velocities follow from u along g, and v. */
static void add_point(gg_normal *n, const gg_radial *r, double x1, double x2, double after, double w)
{
  double one[2 * L1], two[2 * L1], test[2 * L1];
  int N = 2 * r->most;
  gg_hermite_values(N, x1, one);
  gg_hermite_values(N, x2, two);
  gg_hermite_values(N, after, test);
  double decay[2] = {exp(-r->decay * after * after / 2), exp(-r->decay * x1 * x1 / 2)};
  for (int J = 0; J <= r->most; J++) {
    double gain[2] = {test[2 * J] - one[2 * J], test[2 * J] * decay[0] - one[2 * J] * decay[1]};
    for (int j = 0; j <= r->most; j++)
      for (int k = 0; k < 2; k++) {
        double value = w * gain[k] * one[2 * j];
        for (int l = 0; l <= r->most; l++) n->of[k][J][j][l] += value * two[2 * l];
      }
  }
}

static gg_status make_normal(gg_solver *s, int i, int j, gg_error *err)
{
  const gg_model *m = s->model;
  double u[APPROACH], wu[APPROACH], v[CENTRE], wv[CENTRE];
  double a = s->mixture->scale[i], b = s->mixture->scale[j], S = sqrt(a * a + b * b);
  double kick = m->contact[i][j].jn / m->mass[i] * S / a;
  gg_normal *n = s->normal + i * s->species + j;
  memset(n, 0, sizeof *n);
  GG_TRY(gg_hermite_legendre_rule(APPROACH, u, wu, err));
  GG_TRY(gg_hermite_rule(CENTRE, v, wv, err));
  for (int p = 0; p < APPROACH * CENTRE; p++) {
    double x = farthest * u[p / CENTRE], y = v[p % CENTRE];
    double w = farthest * wu[p / CENTRE] * wv[p % CENTRE] * S * x * exp(-x * x / 2) / sqrt(2 * M_PI);
    double x1 = (a * x + b * y) / S;
    add_point(n, &s->mixture->radial, x1, (a * y - b * x) / S, x1 - kick * x, 4 * M_PI * share_of(m, i, j) * w);
  }
  return GG_OK;
}

/* Column of an unknown; the first is the heating that balances the cooling. */
static size_t column(const gg_solver *s, int species, int l)
{
  return (size_t)(1 + species * s->l + l - 1);
}

static void add_to(gsl_matrix *J, size_t row, size_t at, double value)
{
  gsl_matrix_set(J, row, at, gsl_matrix_get(J, row, at) + value);
}

/* d< psi_l >_i/dt by collisions with species j, and its derivatives. */
static void add_collisions(gg_solver *s, int i, int j, int l)
{
  const gg_radial *r = &s->mixture->radial;
  const gg_normal *n = s->normal + i * s->species + j;
  const double *one = s->mixture->alpha[i], *two = s->mixture->alpha[j];
  size_t row = column(s, i, l);
  int k = l > 1;
  for (int J = 0; J <= l; J++)
    for (int q = 0; q <= r->most; q++)
      for (int x = 0; x <= q; x++) {
        double factor = r->split[l][J] * r->split[q][x] * r->across[k][l - J][q - x];
        for (int p = 0; p <= r->most; p++) {
          double value = factor * n->of[k][J][x][p] * r->split[p][p];
          gsl_vector_set(s->x, row, gsl_vector_get(s->x, row) + value * one[q] * two[p]);
          if (q > 0) add_to(s->J, row, column(s, i, q), value * two[p]);
          if (p > 0) add_to(s->J, row, column(s, j, p), value * one[q]);
        }
      }
}

static void add_heating(gg_solver *s, int i, int l, double x)
{
  const gg_radial *r = &s->mixture->radial;
  const gg_heating_rates at = gg_theory_heating_at(&s->mixture->drive, i, x);
  const gg_heating_rates slope = gg_theory_heating_slopes(&s->mixture->drive, i, x);
  size_t row = column(s, i, l);
  double square = s->mixture->scale[i] * s->mixture->scale[i];
  for (int m = 0; m <= r->most; m++) {
    const double growth = r->growth[l][m], spread = r->spread[l][m] / square, alpha = s->mixture->alpha[i][m];
    const double value = at.diffusion * spread - at.drag * growth;
    gsl_vector_set(s->x, row, gsl_vector_get(s->x, row) + value * alpha);
    add_to(s->J, row, 0, (slope.diffusion * spread - slope.drag * growth) * alpha);
    if (m > 0) add_to(s->J, row, column(s, i, m), value);
  }
}

/* sum_i x_i T_i = 1 */
static void add_gauge(gg_solver *s)
{
  const gg_model *m = s->model;
  double sum = 0;
  for (int i = 0; i < s->species; i++) {
    double T = gg_theory_fraction(m, i) * m->mass[i] * s->mixture->scale[i] * s->mixture->scale[i];
    sum += T * gg_hermite_mixture_square(s->mixture, i);
    gsl_matrix_set(s->J, 0, column(s, i, 1), T * sqrt(6) / 3);
  }
  gsl_vector_set(s->x, 0, sum - 1);
}

/* The largest relative step; INFINITY if there is none. */
static double step(gg_solver *s, double *rate)
{
  int sign;
  double most = 0, unit = 0;
  gsl_matrix_set_zero(s->J);
  gsl_vector_set_zero(s->x);
  add_gauge(s);
  for (int i = 0; i < s->species; i++)
    for (int l = 1; l <= s->l; l++) {
      for (int j = 0; j < s->species; j++) add_collisions(s, i, j, l);
      add_heating(s, i, l, *rate);
    }
  for (int i = 0; i < s->species; i++) unit = fmax(unit, share_of(s->model, i, i) * s->mixture->scale[i]);
  if (gsl_linalg_LU_decomp(s->J, s->order, &sign) != GSL_SUCCESS) return INFINITY;
  if (gsl_linalg_LU_svx(s->J, s->order, s->x) != GSL_SUCCESS) return INFINITY;
  *rate -= gsl_vector_get(s->x, 0);
  most = gg_theory_heating_step(&s->mixture->drive, *rate, gsl_vector_get(s->x, 0), unit);
  for (int i = 0; i < s->species; i++)
    for (int l = 1; l <= s->l; l++) {
      double change = gsl_vector_get(s->x, column(s, i, l));
      s->mixture->alpha[i][l] -= change;
      most = fmax(most, fabs(change));
    }
  return isfinite(most) && most < 1e3 ? most : INFINITY;
}

/* Set the scales to the temperatures found; returns their relative change. */
static double follow(gg_hermite_mixture *x, int species)
{
  double most = 0;
  for (int i = 0; i < species; i++) {
    double factor = sqrt(fmax(gg_hermite_mixture_square(x, i), 0.05) * GG_HERMITE_WIDTH);
    x->scale[i] *= factor;
    x->alpha[i][1] = (1 / GG_HERMITE_WIDTH - 1) * 3 / sqrt(6);
    most = fmax(most, fabs(factor - 1));
  }
  return most;
}

static gg_status iterate(gg_solver *s, gg_error *err)
{
  gg_hermite_mixture *x = s->mixture;
  double rate = x->heating != 0 ? x->heating : x->drive.guess;
  for (int move = 0; move < MOST_MOVES; move++) {
    double left = INFINITY;
    for (int i = 0; i < s->species; i++)
      for (int j = 0; j < s->species; j++) {
        GG_TRY(gg_stop_check(s->model->stop, err));
        GG_TRY(make_normal(s, i, j, err));
      }
    for (int k = 0; k < MOST_ITERATIONS; k++) {
      GG_TRY(gg_stop_check(s->model->stop, err));
      left = step(s, &rate);
      if (left < converged || left == INFINITY) break;
    }
    if (!(left < converged)) break;
    x->heating = rate;
    gg_hermite_mixture before = *x;
    if (follow(x, s->species) < still) {
      *x = before;
      return GG_OK;
    }
  }
  return gg_base_fail(err, GG_FAILED, "no steady state was found");
}

gg_status gg_hermite_mixture_solve(gg_hermite_mixture *x, const gg_model *m, int most, gg_error *err)
{
  size_t n = (size_t)(1 + m->n_species * most);
  gg_solver s = {.model = m, .mixture = x, .species = m->n_species, .l = most};
  for (int i = 0; i < m->n_species; i++) {
    if (!(x->scale[i] > 0)) x->scale[i] = sqrt(GG_HERMITE_WIDTH / m->mass[i]);
    x->alpha[i][0] = 1;
    if (x->alpha[i][1] == 0) x->alpha[i][1] = (1 / GG_HERMITE_WIDTH - 1) * 3 / sqrt(6);
  }
  GG_TRY(gg_hermite_radial_make(&x->radial, most, GG_HERMITE_DECAY, err));
  gg_base_gsl_enter();
  s.normal = malloc((size_t)(m->n_species * m->n_species) * sizeof *s.normal);
  s.J = gsl_matrix_alloc(n, n), s.x = gsl_vector_alloc(n), s.order = gsl_permutation_alloc(n);
  gg_status status = s.normal && s.J && s.x && s.order ? iterate(&s, err) : gg_base_out_of_memory(err);
  free(s.normal);
  if (s.J) gsl_matrix_free(s.J);
  if (s.x) gsl_vector_free(s.x);
  gsl_permutation_free(s.order);
  gg_base_gsl_leave();
  return status;
}

double gg_hermite_mixture_cooling(const gg_hermite_mixture *x, const gg_model *m)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) {
    const gg_heating_rates at = gg_theory_heating_at(&x->drive, i, x->heating);
    const double square = x->scale[i] * x->scale[i] * gg_hermite_mixture_square(x, i);
    sum += 2 * gg_theory_fraction(m, i) * m->mass[i] * (at.diffusion - at.drag * square);
  }
  return sum;
}

/* Phi_1 = (c^2 - 3)/sqrt 6, Phi_2 = (c^4 - 10 c^2 + 15)/sqrt 120. */
double gg_hermite_mixture_square(const gg_hermite_mixture *x, int i)
{
  return 1 + sqrt(6) / 3 * x->alpha[i][1];
}

double gg_hermite_mixture_fourth(const gg_hermite_mixture *x, int i)
{
  return sqrt(120) * x->alpha[i][2] + 30 * gg_hermite_mixture_square(x, i) - 15;
}

static double density_at(const gg_hermite_mixture *x, int i, double c)
{
  double marginal[L1], value[2 * L1], sum = 0;
  gg_hermite_radial_marginal(&x->radial, x->alpha[i], marginal);
  gg_hermite_values(2 * x->radial.most, c, value);
  for (int l = 0; l <= x->radial.most; l++) sum += marginal[l] * value[2 * l];
  return sum;
}

double gg_hermite_mixture_flux(const gg_hermite_mixture *x, int i, int j, int power)
{
  double u[APPROACH], wu[APPROACH], v[CENTRE], wv[CENTRE], sum = 0;
  double a = x->scale[i], b = x->scale[j], S = sqrt(a * a + b * b);
  gg_error ignored;
  if (gg_hermite_legendre_rule(APPROACH, u, wu, &ignored) != GG_OK || gg_hermite_rule(CENTRE, v, wv, &ignored) != GG_OK)
    return NAN;
  for (int p = 0; p < APPROACH * CENTRE; p++) {
    double y = farthest * u[p / CENTRE], z = v[p % CENTRE];
    double w = farthest * wu[p / CENTRE] * wv[p % CENTRE] * pow(S * y, power) * exp(-y * y / 2) / sqrt(2 * M_PI);
    sum += w * density_at(x, i, (a * y + b * z) / S) * density_at(x, j, (a * z - b * y) / S);
  }
  return sum;
}
