/* What collisions carry: both partners by their distributions of normal velocity. */
#include <math.h>
#include <string.h>

#include "theory/hermite/contact.h"
#include "theory/hermite/operator.h"

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

void gg_hermite_sums_at(gg_hermite_operator *op, const gg_hermite_gas *gas, double sigma, double L[3][3],
                        const double *a, gg_hermite_sums *sums)
{
  double e = 2 * gas->eta - 1;
  memset(sums, 0, sizeof *sums);
  for (int n = 0; n < op->n_directions; n++) {
    double marginal[GG_HERMITE_MOST_DEGREE + 1], power[4], axis[3][3], *k = op->direction[n];
    gg_hermite_contact contact = gg_hermite_contact_at(gas->eta, gas->shear, L, k, axis);
    gg_hermite_marginal(op, L, a, k, marginal);
    gg_hermite_flux_powers(&op->low, &contact, marginal, power);
    double w = gas->frequency * op->weight[n];
    sums->rate += w * power[1];
    sums->loss += w * power[3] * (1 - e * e) / 8;
    sums->speed += op->weight[n] * contact.s * mean_modulus(marginal, op->basis.degree) / (2 * M_PI);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        if ((i == 2) == (j == 2)) /* the others cancel between the quarters of the sphere */
          sums->transfer[i][j] += w * sigma / 2 * gas->eta * power[2] * k[i] * k[j];
  }
}
