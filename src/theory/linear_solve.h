/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear equations of a linear response. */
#ifndef GG_THEORY_LINEAR_SOLVE_H
#define GG_THEORY_LINEAR_SOLVE_H

#include <stdbool.h>
#include <stddef.h>

/* Memory for an n x n matrix by rows, followed by n numbers; NULL: out of memory. To be freed. */
double *gg_theory_linear_new(size_t n);
/* Solve M x = b: x replaces b, which follows M in memory; M is destroyed. False: M is singular, or out of memory. */
bool gg_theory_linear_solve(size_t n, double *M);

#endif
