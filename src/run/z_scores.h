/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deviations of molecular dynamics from the Enskog equation and of theories from both, with remarks on their causes.
 * A gas that is followed in time is compared with dsmc, not with theories of the steady state, but for coefficients. */
#ifndef GG_Z_SCORES_H
#define GG_Z_SCORES_H

#include "run/departure.h" /* made of the public header (src/run/meson.build) */
#include "run/run.h"

/* (a - b) over their combined standard error; NaN where either is missing. */
double gg_run_z_score(const gg_estimate *a, const gg_estimate *b);

/* True if theories answer for a measured value: not where it is that of a gas at one time, which may be far from the
 * state that theories describe. The viscosity of a wave is a coefficient. */
bool gg_run_has_theories(const gg_comparison *comparison, gg_quantity q);

/* An engine against Enskog's equation solved without random numbers (enskog_hermite); false where there is no
 * solution, or no mean and error of the engine. */
bool gg_run_enskog_deviation(const gg_comparison *comparison, gg_engine_kind engine, gg_quantity q,
                             gg_departure *departure);

/* Reference of a quantity: Enskog's noise-free solution where it answers, else the mean of dsmc. False: there is
 * neither. */
typedef struct gg_reference {
  const char *method; /* "enskog_hermite", "dsmc" */
  gg_estimate value;
} gg_reference;
bool gg_run_reference_find(const gg_comparison *comparison, const gg_quantity_row *row, gg_reference *reference);

/* How far a mean is off a reference. Its error may be NaN, as of a theory in closed form: then z is NaN, too, and the
 * errors are those of the reference. */
gg_departure gg_run_reference_deviation(gg_quantity q, const gg_estimate *mean, const gg_estimate *reference);

/* True if a mean deviates from the reference by more than four standard errors and more than expected between engines.
 */
bool gg_run_is_beyond(const gg_model *model, gg_quantity q, const gg_estimate *mean, const gg_estimate *reference);

/* True if md differs from Enskog's equation by more than four standard errors and more than expected. It is compared
 * with the noise-free solution, else with dsmc. */
bool gg_run_results_disagree(const gg_comparison *comparison, gg_quantity q);

/* Why a theory is off where it is beyond what is expected; the text lasts as long as the answer. */
const char *gg_run_theory_cause(const gg_theory_answer *answer);

/* Relative deviation of a theory from a simulation, theory/simulation - 1. NaN if the simulation is zero
 * within three standard errors. */
double gg_run_deviation(const gg_estimate *simulation, double theory);

/* Remark on a theory that deviates by more than expected between md and dsmc and by more than four standard errors: the
 * headline quantity with the largest relative deviation, and the cause. Not for enskog_hermite, which is the solution.
 */
typedef struct gg_run_theory_remark {
  const gg_theory *theory;
  gg_quantity quantity;
  double deviation;
  const char *cause;
} gg_run_theory_remark;
/* Remarks on all theories that apply, against md, or against dsmc where md was not run; returns their number. */
int gg_run_theory_remarks(const gg_comparison *comparison, gg_run_theory_remark remarks[GG_MOST_THEORIES]);

/* One quantity of a comparison: both engines, and how far they are off each other and Enskog's equation. */
void gg_run_comparison_row(const gg_comparison *comparison, const gg_quantity_row *named, gg_comparison_row *row);

#endif
