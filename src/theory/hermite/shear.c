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

/* Shear heats as T^(1/2), noise as it does, and collisions cool as T^(3/2): by how much it is warmer than by shear
 * alone, where that has T = 1 and noise alone `noise`. */
static double warmer(double noise)
{
  double T = fmax(1, noise);
  for (int i = 0; i < 50; i++) T = pow(sqrt(T) + pow(noise, 1.5), 2. / 3);
  return T;
}

static double factor_of(const gg_model *m, const gg_gaussian start[])
{
  double T = 0;
  if (gg_common_thermostat_of(m) != GG_WHITE_NOISE) return 1;
  for (int i = 0; i < m->n_species; i++) T += gg_theory_fraction(m, i) * m->mass[i] * gg_theory_trace(start[i].M) / 3;
  return warmer(m->temperature0 / T);
}

gg_status gg_hermite_shear_begin(gg_hermite_shear *h, const gg_model *m, gg_error *err)
{
  gg_gaussian start[GG_MAX_SPECIES];
  *h = (gg_hermite_shear){.model = m, .gas = gg_hermite_gas_of(m)};
  bool fine = gg_theory_gaussian_steady(m, start) < 1e-6;
  double factor = fine ? factor_of(m, start) : 1;
  for (int i = 0; i < m->n_species && gg_common_thermostat_of(m) == GG_WHITE_NOISE; i++)
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

/* About the Gaussian that the moments ask for. */
static gg_status follow(const gg_hermite_basis *b, gg_hermite_state *s, gg_error *err)
{
  double M[3][3], L[3][3];
  gg_hermite_second_moments(b, s, M);
  s->width = GG_HERMITE_WIDTH;
  if (!gg_hermite_gaussian(s->width, M, L)) return gg_base_fail(err, GG_FAILED, "no steady state was found");
  return gg_hermite_expand_anew(b, s, L, err);
}

/* Functions are ordered by degree: those of the last degree keep their places, and the new ones are 0. */
gg_status gg_hermite_shear_solve(gg_hermite_shear *h, int degree, gg_error *err)
{
  gg_hermite_operator_clear(&h->op);
  GG_TRY(gg_hermite_operator_make(&h->op, degree, GG_HERMITE_DECAY, false, err));
  GG_TRY(gg_hermite_operator_hold(&h->op, h->gas.n_species, err));
  for (int i = 0; i < h->gas.n_species; i++) GG_TRY(follow(&h->op.basis, &h->state[i], err));
  return gg_hermite_newton(&h->op, &h->gas, h->state, err);
}
