/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included before every file of the mutants' tree. GG_MUTANT(i): is the i-th mutant the one that GG_MUTANT of the
 * environment names? Notes that somebody asked: a test that never asks cannot kill it. */
#ifndef GG_MUTANTS_H
#define GG_MUTANTS_H

extern int gg_mutant_now;
extern unsigned char gg_mutant_reached[1024];

#define GG_MUTANT(i) (gg_mutant_reached[i] = 1, gg_mutant_now == (i))

struct gg_model;
void gg_canary_model(struct gg_model *model, int first); /* canaries.c */

#endif
