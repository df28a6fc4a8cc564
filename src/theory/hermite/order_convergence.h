/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Convergence with the degree: answers of successive degrees, and the distance of the last from their limit. */
#ifndef GG_ORDER_CONVERGENCE_H
#define GG_ORDER_CONVERGENCE_H

#include "theory/theory.h"

/* Only the last four answers count. */
typedef struct gg_hermite_convergence {
  gg_theory_answer answer[4]; /* the last first */
  int n;
  bool paired;           /* degrees 4, 6, 8, ... of a sheared gas */
  double poor;           /* largest relative error of an answer; above it there is none; 0: 0.01 */
  bool widened;          /* the last degree has another answer, about wider Gaussians: */
  gg_theory_answer wide; /* it is used, and its difference is an error */
} gg_hermite_convergence;

/* Space for the next answer, preset to NaN. */
gg_theory_answer *gg_hermite_convergence_next(gg_hermite_convergence *convergence);

double gg_hermite_convergence_error_of(const gg_hermite_convergence *convergence, gg_quantity q);
/* Relative change by the last degree: a criterion for stopping, not the distance from the limit. INFINITY for the
 * first. */
double gg_hermite_convergence_change(const gg_hermite_convergence *convergence, gg_quantity q);

/* One quantity of the last answer, with its error. */
void gg_hermite_convergence_take(const gg_hermite_convergence *convergence, gg_quantity q, gg_theory_answer *answer);

/* The last answer with its errors; rejected if the error of `judge` is above 1 % of it, and of `least`: some
 * quantities vanish. */
gg_status gg_hermite_convergence_finish(const gg_hermite_convergence *convergence, const char *theory,
                                        gg_quantity judge, double least, gg_theory_answer *answer, gg_error *err);

#endif
