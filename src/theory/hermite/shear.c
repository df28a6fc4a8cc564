/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/shear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "theory/answer.h"
#include "theory/gaussian_moments.h"
#include "theory/hermite/newton.h"

/* Ratio of the temperature with noise to that of shear alone, in units in which shear alone gives T = 1 and noise
 * alone `noise`. Heating by shear is proportional to T^(1/2), by noise constant, cooling by collisions proportional
 * to T^(3/2). */
static double warmer(double noise)
{
  double T = fmax(1, noise);
  for (int i = 0; i < 50; i++) T = pow(sqrt(T) + pow(noise, 1.5), 2. / 3);
  return T;
}

static double factor_of(const gg_model *m, const gg_gaussian start[])
{
  double T = 0;
  if (gg_common_heat_of(m) != GG_HEAT_KICKS) return 1;
  for (int i = 0; i < m->n_species; i++) T += gg_theory_fraction(m, i) * m->mass[i] * gg_tensor_trace(start[i].M) / 3;
  return warmer(m->temperature0 / T);
}

gg_status gg_hermite_shear_begin(gg_hermite_shear *h, const gg_model *m, gg_error *err)
{
  gg_gaussian start[GG_MAX_SPECIES];
  *h = (gg_hermite_shear){.model = m, .gas = gg_hermite_gas_of(m)};
  bool fine = gg_theory_gaussian_steady(m, start) < 1e-6;
  double factor = fine ? factor_of(m, start) : 1;
  for (int i = 0; i < m->n_species && gg_common_heat_of(m) == GG_HEAT_KICKS; i++)
    h->gas.diffusion[i] = gg_common_thermostat_noise(m) / 2;
  for (int i = 0; i < m->n_species && fine; i++) {
    gg_hermite_state *s = &h->state[i];
    s->width = 1;
    s->a = calloc((size_t)GG_HERMITE_MOST_FUNCTIONS, sizeof *s->a);
    if (!s->a) {
      gg_hermite_shear_end(h);
      return gg_base_out_of_memory(err);
    }
    s->a[0] = 1;
    fine = gg_hermite_gaussian(factor, start[i].M.at, s->L);
  }
  if (fine) return GG_OK;
  gg_hermite_shear_end(h);
  return gg_base_fail(err, GG_FAILED, "no steady state was found");
}

void gg_hermite_shear_end(gg_hermite_shear *h)
{
  gg_hermite_operator_clear(&h->op);
  for (int i = 0; i < GG_MAX_SPECIES; i++) free(h->state[i].a);
  *h = (gg_hermite_shear){0};
}

/* Choose the Gaussian from the moments. */
static gg_status centre(const gg_hermite_basis *b, gg_hermite_state *s, double width, gg_error *err)
{
  double M[3][3], L[3][3];
  gg_hermite_second_moments(b, s, M);
  s->width = width;
  if (!gg_hermite_gaussian(s->width, M, L)) return gg_base_fail(err, GG_FAILED, "no steady state was found");
  return gg_hermite_expand_anew(b, s, L, err);
}

bool gg_hermite_has_drag(const gg_hermite_gas *gas)
{
  for (int i = 0; i < gas->n_species; i++)
    if (!(gas->drag[i] > 0)) return false;
  return true;
}

/* The drag, over that of the bath, that keeps the gas at the temperature exp(log_T); about Gaussians of the same
 * widths. */
static gg_status pin_at(gg_hermite_shear *h, double log_T, gg_hermite_pin *pin, gg_error *err)
{
  const double wider = sqrt(exp(log_T) / gg_hermite_temperature(&h->op.basis, &h->gas, h->state));
  for (int i = 0; i < h->gas.n_species; i++)
    for (int k = 0; k < 9; k++) h->state[i].L[k / 3][k % 3] *= wider;
  pin->T = exp(log_T);
  return gg_hermite_newton(&h->op, &h->gas, h->state, pin, err);
}

/* Find the zero of the factor minus 1 between low and high: by false position; an end that stays twice is halved. */
static gg_status between(gg_hermite_shear *h, double low, double high, double above, double below, gg_hermite_pin *pin,
                         gg_error *err)
{
  enum { MOST_STEPS = 60 };
  const double close = 1e-9;
  for (int k = 0; k < MOST_STEPS && high - low > close && fabs(pin->factor - 1) > close; k++) {
    const double at = low + (high - low) * above / (above - below);
    GG_TRY(pin_at(h, at, pin, err));
    const double now = pin->factor - 1;
    if (now > 0)
      low = at, above = now, below /= 2;
    else
      high = at, below = now, above /= 2;
  }
  return GG_OK;
}

/* A sheared gas in a bath may have a hot and a cold state. It cools where the drag that would keep its temperature
 * is less than that of the bath, and warms up where it is more: this function follows it in small steps to the state
 * whose drag is that of the bath. Near a turning point, where one of the states ends, Newton's method alone
 * diverges. */
static gg_status follow(gg_hermite_shear *h, gg_hermite_pin *pin, gg_error *err)
{
  enum { MOST_STEPS = 400 };
  const double least = 0.005, most = 0.1;
  double at = log(gg_hermite_temperature(&h->op.basis, &h->gas, h->state)), stride = least;
  GG_TRY(pin_at(h, at, pin, err));
  double before = pin->factor - 1;
  for (int k = 0; k < MOST_STEPS; k++, stride = fmin(2 * stride, most)) {
    const double to = before > 0 ? at + stride : at - stride;
    GG_TRY(pin_at(h, to, pin, err));
    const double now = pin->factor - 1;
    if (now * before <= 0)
      return before > 0 ? between(h, at, to, before, now, pin, err) : between(h, to, at, now, before, pin, err);
    at = to, before = now;
  }
  return gg_base_fail(err, GG_FAILED, "no steady state was found");
}

static gg_status follow_drag(gg_hermite_shear *h, gg_error *err)
{
  gg_hermite_pin pin = gg_hermite_pin_of(&h->gas);
  const gg_status status = follow(h, &pin, err);
  gg_hermite_pin_end(&pin);
  return status;
}

/* Newton's method takes a fifth of the time; the result must not be another state. */
static gg_status try_newton(gg_hermite_shear *h, gg_error *err)
{
  const gg_hermite_basis *b = &h->op.basis;
  const int n_species = h->gas.n_species;
  const size_t size = (size_t)b->n * sizeof(double);
  const double T = gg_hermite_temperature(b, &h->gas, h->state);
  double L[GG_MAX_SPECIES][3][3], *kept = malloc((size_t)n_species * size);
  if (!kept) return gg_base_out_of_memory(err);
  for (int i = 0; i < n_species; i++) {
    memcpy(kept + i * b->n, h->state[i].a, size);
    memcpy(L[i], h->state[i].L, sizeof L[i]);
  }
  gg_status status = gg_hermite_newton(&h->op, &h->gas, h->state, NULL, err);
  const double moved = status == GG_OK ? log(gg_hermite_temperature(b, &h->gas, h->state) / T) : INFINITY;
  for (int i = 0; i < n_species && !(fabs(moved) < 0.1); i++) {
    memcpy(h->state[i].a, kept + i * b->n, size);
    memcpy(h->state[i].L, L[i], sizeof L[i]);
  }
  free(kept);
  return fabs(moved) < 0.1 ? status : follow_drag(h, err);
}

static gg_status centre_all(gg_hermite_shear *h, const double width[], gg_error *err)
{
  for (int i = 0; i < h->gas.n_species; i++) GG_TRY(centre(&h->op.basis, &h->state[i], width[i], err));
  return GG_OK;
}

gg_status gg_hermite_shear_about(gg_hermite_shear *h, const double width[], gg_error *err)
{
  const double T = gg_hermite_temperature(&h->op.basis, &h->gas, h->state), most = 0.2;
  GG_TRY(centre_all(h, width, err));
  GG_TRY(gg_hermite_newton(&h->op, &h->gas, h->state, NULL, err));
  const double moved = log(gg_hermite_temperature(&h->op.basis, &h->gas, h->state) / T);
  return fabs(moved) < most ? GG_OK : gg_base_fail(err, GG_FAILED, "no steady state was found");
}

/* Functions are ordered by degree: those of the last degree keep their indices, and the new ones are 0. */
gg_status gg_hermite_shear_solve(gg_hermite_shear *h, int degree, gg_error *err)
{
  double width[GG_MAX_SPECIES];
  for (int i = 0; i < GG_MAX_SPECIES; i++) width[i] = GG_HERMITE_WIDTH;
  gg_hermite_operator_clear(&h->op);
  GG_TRY(gg_hermite_operator_make(&h->op, degree, GG_HERMITE_DECAY, false, err));
  GG_TRY(gg_hermite_operator_hold(&h->op, h->gas.n_species, err));
  GG_TRY(centre_all(h, width, err));
  if (!gg_hermite_has_drag(&h->gas)) return gg_hermite_newton(&h->op, &h->gas, h->state, NULL, err);
  return try_newton(h, err);
}
