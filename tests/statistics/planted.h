/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series with known statistics. */
#ifndef PLANTED_H
#define PLANTED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "common/rng.h"

/* x_t = rho x_{t-1} + noise, stationary, unit variance: tau_int = (1+rho)/(2(1-rho)). */
static inline void planted_autoregressive(gg_rng *r, double rho, double *x, size_t n)
{
  double at = gg_common_rng_normal(r), kick = sqrt(1 - rho * rho);
  for (size_t i = 0; i < n; i++) x[i] = at = rho * at + kick * gg_common_rng_normal(r);
}

#endif
