/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranges of validity, for gg_theory.beyond: why a theory that answers is outside the range for which it was derived.
 * Theories of one kind share them. */
#ifndef GG_RANGE_H
#define GG_RANGE_H

#include "common/model.h"

/* Theories of weak dissipation: Lun's, and expansions about elastic grains. */
const char *gg_theory_beyond_quasi_elastic(const gg_model *model);
/* Linear in the anisotropy of the stress. */
const char *gg_theory_beyond_linear_anisotropy(const gg_model *model);
/* Nearly Maxwellian: first Sonine polynomials, Gaussian velocities. */
const char *gg_theory_beyond_first_sonine(const gg_model *model);
const char *gg_theory_beyond_gaussian(const gg_model *model);

#endif
