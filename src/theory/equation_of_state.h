/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef GG_EQUATION_OF_STATE_H
#define GG_EQUATION_OF_STATE_H

/* Solid fraction at which the fluid of hard spheres freezes. */
#define GG_FREEZING_PHI 0.494

/* Z = p/(nT) of Kolafa, Labik & Malijevsky 2004 as first published; its refit: gg_common_compressibility(GG_KOLAFA,
 * phi). */
double gg_theory_compressibility_kolafa2004(double phi);

#endif
