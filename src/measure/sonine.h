/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the deviation of one species' speeds from a Maxwellian, measured or of a theory (sonine.c has the
 * formulas). */
#ifndef GG_SONINE_CURVES_H
#define GG_SONINE_CURVES_H

#include "measure/curve.h"

enum { GG_SONINE_BINS = 60 };
#define GG_SONINE_WIDTH 0.05

/* For x^2 = m_i v^2/(2 T_i): fractions of the grains in bins of x, <x^4>, <x^6>, T_i/T. */
typedef struct gg_sonine_sums {
  double share[GG_SONINE_BINS], fourth, sixth, temperature_ratio;
} gg_sonine_sums;

/* Excess over a Maxwellian, and Delta(v*), of species k. */
void gg_measure_sonine_curves_put(gg_curves *list, const gg_model *model, int k, const gg_sonine_sums *sums);
/* Delta of the first Sonine approximation, at the same v*. */
void gg_measure_sonine_polynomial_put(gg_curves *list, const gg_model *model, int k, double temperature_ratio);

#endif
