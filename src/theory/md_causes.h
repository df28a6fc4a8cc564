/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why md differs from Enskog's equation by more than expected, from what a run measured. A cause is given to a
 * difference only where it can have this sign and this size. */
#ifndef GG_MD_CAUSES_H
#define GG_MD_CAUSES_H

#include "common/quantity.h"
#include "statistics/estimator.h"

/* Relative agreement expected of md and dsmc: 1 % where dilute (phi <= 0.05), 3 % up to phi = 0.3 with e >= 0.7, 10 %
 * beyond. For N1 and N2, differences: 0.02, 0.05 beyond. */
double gg_theory_expected_deviation(const gg_model *model, gg_quantity q);

/* A difference of md that needs an explanation, and what the run of md measured. Means are NaN where they are unknown.
 */
typedef struct gg_theory_difference {
  const gg_model *model;
  gg_quantity q;
  double by;                             /* relative difference; absolute for quantities about zero */
  const char *unsteady;                  /* why md has no steady mean; NULL: it has one */
  double T, rate;                        /* temperature, collisions per grain and time */
  gg_mean density_waves, momentum_waves; /* of the box's length, over those of a homogeneous gas */
  double treated;                        /* fraction of collisions under the contact-time rule */
  int64_t default_size, usual_size;      /* numbers of grains by default in this scene, and in most */
} gg_theory_difference;

/* Call `add` with a sentence for each cause; returns their number. */
enum { GG_CAUSE_TEXT = 320 };
int gg_theory_md_causes(const gg_theory_difference *d, void (*add)(void *context, const char *text), void *context);
/* "the grains have clustered: ..."; false where the gas is homogeneous, or it is unknown. */
bool gg_theory_structure(const gg_mean *density_waves, const gg_mean *momentum_waves, char *text, size_t size);

#endif
