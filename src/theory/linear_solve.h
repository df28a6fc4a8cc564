/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations of a linear response. */
#ifndef GG_THEORY_LINEAR_SOLVE_H
#define GG_THEORY_LINEAR_SOLVE_H

#include <stdbool.h>
#include <stddef.h>

/* n x n by rows, and n behind them; NULL: out of memory. To be freed. */
double *gg_theory_linear_new(size_t n);
/* M x = b: x takes the place of b, which stands behind M; M is spoilt. False: M is singular, or out of memory. */
bool gg_theory_linear_solve(size_t n, double *M);

#endif
