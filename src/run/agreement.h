/* Where molecular dynamics and the Enskog equation may differ, and why: what a comparison is to remark on. */
#ifndef GG_AGREEMENT_H
#define GG_AGREEMENT_H

#include "run/run.h"

/* Relative agreement expected of md and dsmc: 1 % where dilute (phi <= 0.05), 3 % up to phi = 0.3 with e >= 0.7, 10 %
 * beyond. For N1 and N2, differences: 0.02, 0.05 beyond. */
double gg_expected_agreement(const gg_model *model, gg_quantity q);

/* Do the engines differ by more than four combined standard errors and more than expected? */
bool gg_disagree(const gg_comparison *comparison, gg_quantity q);

/* Causes that apply to this scene, one sentence each, at most `most`; returns how many. */
int gg_causes_of_disagreement(const gg_comparison *comparison, const char **causes, int most);

#endif
