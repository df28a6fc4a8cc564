/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collision sums: both partners enter by their distributions of normal velocity. */
#include <math.h>
#include <string.h>

#include "theory/hermite/direction_workspace.h"

/* <|x|> under exp(-x^2/2)/sqrt(2 pi) sum_l marginal_l Ho_2l: <|x| He_2l> = sqrt(2/pi) (-1)^(l+1) (2l-3)!!. */
static double mean_modulus(const double *marginal, int degree)
{
  double sum = marginal[0], term = 1;
  for (int l = 1; l <= degree / 2; l++) {
    if (l > 1) term *= -(2 * l - 3);
    term /= sqrt(2. * l * (2 * l - 1));
    sum += marginal[l] * term;
  }
  return sqrt(2 / M_PI) * sum;
}

static void add_pair(const gg_hermite_operator *op, const gg_hermite_gas *gas, int i, int j, const double k[3],
                     double weight, gg_hermite_sums *sums)
{
  const gg_hermite_impact *x = &gas->impact[i][j];
  const gg_hermite_view *one = &op->workspace->view[i], *two = &op->workspace->view[j];
  gg_hermite_contact contact = gg_hermite_contact_of(x, &one->frame, &two->frame, k);
  double power[4], w = weight * gas->fraction[i], momentum = w * gas->mass[i] * x->eta;
  gg_hermite_flux_powers(&op->low, &contact, one->marginal, two->marginal, power);
  sums->rate += w * power[1];
  sums->loss += momentum * (1 - x->e) / 4 * power[3];
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++)
      if ((a == 2) == (b == 2)) /* the other terms cancel between the quarters of the sphere */
        sums->transfer[a][b] += momentum * x->sigma / 2 * power[2] * k[a] * k[b];
}

void gg_hermite_sums_at(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                        gg_hermite_sums *sums)
{
  memset(sums, 0, sizeof *sums);
  for (int n = 0; n < op->n_directions; n++) {
    gg_hermite_set_views(op, gas->n_species, state, op->direction[n]);
    for (int i = 0; i < gas->n_species; i++) {
      const gg_hermite_view *view = &op->workspace->view[i];
      double modulus = view->frame.s * mean_modulus(view->marginal, op->basis.degree);
      sums->speed += gas->fraction[i] * op->weight[n] * modulus / (2 * M_PI);
      for (int j = 0; j < gas->n_species; j++) add_pair(op, gas, i, j, op->direction[n], op->weight[n], sums);
    }
  }
}
