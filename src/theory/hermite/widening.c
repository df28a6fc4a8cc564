/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wider Gaussians for cold suspensions. Few grains have collided recently, and those are much hotter than the rest:
 * kurtoses reach 20. A Hermite series about a Gaussian of the temperature width x T converges in the mean square for
 * Gaussians less than twice as hot. If some grains are hotter, it hardly changes from degree to degree, at any
 * distance from the limit. The few grains that carry the fourth moment have about the temperature T times this
 * moment over that of a Gaussian. So the width is that ratio, which itself depends on the width. */
#include <math.h>

#include "theory/hermite/shear.h"

/* Numbers of widths that are tried; how many times a width the tails may need, for the first and for others. */
enum { MOST_WIDTHS = 4 };
static const double first_enough = 1.2, enough = 1.1;

/* Width for the tails of a species, with the same margin as elsewhere. */
static double width_for(const gg_hermite_basis *b, const gg_hermite_state *s)
{
  double M[3][3], ratio = 0;
  gg_hermite_second_moments(b, s, M);
  for (int a = 0; a < 3; a++) ratio += gg_hermite_fourth_moment(b, s, a) / (9 * M[a][a] * M[a][a]);
  return GG_HERMITE_WIDTH * fmax(ratio, 1);
}

/* Secant method for the width that equals the width it requires (`asked`); `before`: those of the last one. */
static double next_width(double width, double asked, double width_before, double asked_before)
{
  const double most = 0.8;
  const double slope = width == width_before ? 0 : (asked - asked_before) / (width - width_before);
  return width + (asked - width) / (1 - fmin(fmax(slope, 0), most));
}

bool gg_hermite_shear_has_tails(gg_hermite_shear *h)
{
  bool tails = false;
  for (int i = 0; i < h->gas.n_species && gg_hermite_has_drag(&h->gas); i++)
    tails = tails || width_for(&h->op.basis, &h->state[i]) > first_enough * h->state[i].width;
  return tails;
}

gg_status gg_hermite_shear_widen(gg_hermite_shear *h, bool *widened, gg_error *err)
{
  const int n = h->gas.n_species;
  double width[GG_MAX_SPECIES], last[GG_MAX_SPECIES], asked_last[GG_MAX_SPECIES];
  *widened = gg_hermite_shear_has_tails(h);
  for (int k = 0; *widened && k <= MOST_WIDTHS; k++) {
    double off = 0;
    for (int i = 0; i < n; i++) {
      const double now = h->state[i].width, asked = width_for(&h->op.basis, &h->state[i]);
      off = fmax(off, asked / now);
      width[i] = next_width(now, asked, k ? last[i] : now, k ? asked_last[i] : asked);
      last[i] = now, asked_last[i] = asked;
    }
    if (k && off < enough) return GG_OK;
    if (k < MOST_WIDTHS) GG_TRY(gg_hermite_shear_about(h, width, err));
  }
  return !*widened ? GG_OK : gg_base_fail(err, GG_FAILED, "few grains are so hot that no Gaussian is wide enough");
}
