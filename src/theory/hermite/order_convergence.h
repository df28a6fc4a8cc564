/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers of one degree after another, and how far the last is from their limit. */
#ifndef GG_HERMITE_RUNGS_H
#define GG_HERMITE_RUNGS_H

#include "theory/theory.h"

/* Only the last four count. */
typedef struct gg_rungs {
  gg_theory_answer answer[4]; /* the last first */
  int n;
  bool paired;           /* degrees 4, 6, 8, ... of a sheared gas */
  double poor;           /* relative error from which on there is no answer; 0: 0.01 */
  bool widened;          /* the last degree has another answer, about wider Gaussians: */
  gg_theory_answer wide; /* it counts, and what it changed is an error */
} gg_rungs;

/* Room for the next answer, all of it NaN. */
gg_theory_answer *gg_hermite_convergence_next(gg_rungs *rungs);

double gg_hermite_convergence_error_of(const gg_rungs *rungs, gg_quantity q);
/* What the last degree changed, relative: says when to stop, not how far the limit is. INFINITY of the first. */
double gg_hermite_convergence_change(const gg_rungs *rungs, gg_quantity q);

/* One quantity of the last answer, with its error. */
void gg_hermite_convergence_take(const gg_rungs *rungs, gg_quantity q, gg_theory_answer *answer);

/* The last answer with its errors; refused where that of `judge` is above 1 % of it, and of `least`: some vanish. */
gg_status gg_hermite_convergence_finish(const gg_rungs *rungs, const char *theory, gg_quantity judge, double least,
                                        gg_theory_answer *answer, gg_error *err);

#endif
