/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two-point boundary value problems of ordinary differential equations v' = f(v), with some conditions at each end.
 * Collocation by cubics, with no residual at the ends and in the middle of each interval (fourth order), damped Newton
 * steps, and points added where the residual is large: J. Kierzenka & L.F. Shampine, ACM Trans. Math. Softw. 27 (2001)
 * 299. */
#ifndef GG_BOUNDARY_PROBLEM_H
#define GG_BOUNDARY_PROBLEM_H

#include "base/cancellation.h"
#include "base/error.h"

#include <stdbool.h>

enum { GG_BOUNDARY_FUNCTIONS = 10, GG_BOUNDARY_POINTS = 1601 };

typedef double gg_functions[GG_BOUNDARY_FUNCTIONS];

typedef struct gg_boundary_problem {
  int n, n_lower; /* unknown functions; conditions at the lower end, the others are at the upper one */
  double scale[GG_BOUNDARY_FUNCTIONS]; /* sizes of the functions */
  double tolerance;                    /* of the residual v' - f relative to f + scale/(length of the interval) */
  void *self;                          /* for the functions below */
  const gg_stop *stop;
  bool *outside; /* set by `slope` where it has no value; NULL: it always has */
  void (*slope)(void *self, const double v[], double f[]);
  void (*lower)(void *self, const double v[], double g[]); /* left sides of conditions g = 0, of order 1 */
  void (*upper)(void *self, const double v[], double g[]);
} gg_boundary_problem;

/* Functions at increasing points y, with their slopes: a cubic in each interval. */
typedef struct gg_boundary_solution {
  int points;
  double y[GG_BOUNDARY_POINTS];
  gg_functions v[GG_BOUNDARY_POINTS], f[GG_BOUNDARY_POINTS];
  double residual; /* largest of any interval, relative as the tolerance */
} gg_boundary_solution;

/* Solve, from the points y and values v in *solution. GG_FAILED, with the reason, without convergence. */
gg_status gg_theory_boundary_solve(const gg_boundary_problem *problem, gg_boundary_solution *solution, gg_error *err);

/* Values, and unless NULL slopes, at y, from the cubics. */
void gg_theory_boundary_at(const gg_boundary_solution *solution, int n, double y, double v[], double slope[]);

#endif
