/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where theories answer but are beyond what they were made for: shared by those of one kind. For gg_theory.beyond. */
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
