/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/contact_value.h"

#include <math.h>
#include <stddef.h>

#include "common/portable_math.h"

/* Z - 1 in powers of x = phi/(1-phi): Kolafa, Labik & Malijevsky, PCCP 6 (2004) 2335, refitted by Pieprzyk, Bannerman,
 * Branka, Chudak & Heyes, PCCP 21 (2019) 6886. */
static const struct {
  int power;
  double coefficient;
} kolafa[] = {{1, 4},          {2, 6},           {3, 2.3647684},    {4, -0.8698551},  {5, 1.1062803},   {6, -1.1014221},
              {7, 0.66605866}, {8, -0.03633431}, {10, -0.20965164}, {14, 0.10555569}, {22, -0.00872380}};

static double kolafa_excess(double phi)
{
  double x = phi / (1 - phi), sum = 0;
  for (size_t i = 0; i < sizeof kolafa / sizeof *kolafa; i++)
    sum += kolafa[i].coefficient * gg_power(x, kolafa[i].power);
  return sum;
}

static double carnahan_starling(double phi)
{
  return (1 - phi / 2) / gg_power(1 - phi, 3);
}

/* Densest random packing of smooth spheres, at which the contact values of sheared dissipative grains diverge. */
#define DENSEST 0.636

/* Above FIRST, Carnahan & Starling's value passes smoothly into 2/(DENSEST - phi). */
static double vescovi(double phi)
{
  const double FIRST = 0.4, past = (phi - FIRST) / (DENSEST - FIRST);
  const double weight = past > 0 ? past * past : 0;
  return (1 - weight) * carnahan_starling(phi) + weight * 2 / (DENSEST - phi);
}

static double chialvo_sundaresan(double phi)
{
  const double left = DENSEST - phi;
  return carnahan_starling(phi) + 0.58 * phi * phi / (left * sqrt(left));
}

double gg_common_contact_value_of(gg_contact_value kind, double phi)
{
  if (phi == 0) return 1;
  switch (kind) {
  case GG_LUN_SAVAGE: return gg_power(1 / gg_root(1 - phi / 0.64, 5), 8); /* to the power -2.5 x 0.64 */
  case GG_KOLAFA: return kolafa_excess(phi) / (4 * phi);
  case GG_VESCOVI: return vescovi(phi);
  case GG_CHIALVO_SUNDARESAN: return chialvo_sundaresan(phi);
  default: return carnahan_starling(phi);
  }
}

double gg_common_contact_value_limit(gg_contact_value kind)
{
  return kind == GG_KOLAFA ? 0.55 : 0.63;
}

double gg_common_contact_value_mixture(double phi, double phi_hat, double d_red)
{
  double y = phi_hat * d_red, f = 1 - phi;
  return 1 / f + 1.5 * y / (f * f) + 0.5 * y * y / (f * f * f);
}

double gg_common_compressibility(gg_contact_value kind, double phi)
{
  return 1 + 4 * phi * gg_common_contact_value_of(kind, phi);
}
