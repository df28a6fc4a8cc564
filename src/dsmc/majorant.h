/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Majorant of the relative normal speed g_n of one pair of species. It adapts to the candidates and is relative to the
 * thermal speed, so that it follows a cooling or heated gas. Candidates rarely exceed it; each such overflow is counted
 * and corrected by a correction pass (kernel/pass.h). */
#ifndef GG_DSMC_MAJORANT_H
#define GG_DSMC_MAJORANT_H

#include <stdint.h>

typedef struct gg_dsmc_majorant {
  double now, before; /* largest g_n over thermal speed in this window of candidates, and in the one before */
  uint64_t seen;      /* candidates in this window */
} gg_dsmc_majorant;

/* Start from a safe upper bound `sure`. */
void gg_dsmc_majorant_start(gg_dsmc_majorant *m, double sure, double thermal);
/* The majorant to use at this thermal speed. */
double gg_dsmc_majorant_at(const gg_dsmc_majorant *m, double thermal);
/* Take in the largest g_n among `candidates`; a window ends after `window` of them. */
void gg_dsmc_majorant_learn(gg_dsmc_majorant *m, double largest, double thermal, uint64_t candidates, uint64_t window);

#endif
