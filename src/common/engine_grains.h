/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grains of an engine as arrays: copied, given by a caller, hashed; an engine with another model that continues
 * with them. */
#ifndef GG_COMMON_ENGINE_GRAINS_H
#define GG_COMMON_ENGINE_GRAINS_H

#include "common/engine.h"

/* In the engine's units and the order of numbers: 9 numbers a grain (places, velocities, spins), of which `grains` has
 * the parts. */
typedef struct gg_engine_grains {
  double *number;
  int *species;
  gg_grain_arrays grains;
} gg_engine_grains;

gg_status gg_common_engine_grains_make(gg_engine_grains *g, size_t n, gg_error *err);
void gg_common_engine_grains_clear(gg_engine_grains *g);
/* All of an engine of this model, into arrays that were made for it. */
void gg_common_engine_grains_read(gg_engine *engine, const gg_model *model, gg_engine_grains *g);
/* The same into arrays of a caller (NULL: not wanted), velocities times `unit`, spins as omega. */
void gg_common_engine_grains_copy(gg_engine *engine, const gg_model *m, double unit, double *r, double *c, double *s,
                                  int *species);

/* Grains of a caller (NULL: not given), spins as omega: GG_BAD_INPUT unless they are grains of this model. */
gg_status gg_common_grains_check(const gg_model *m, const gg_grain_arrays *g, size_t n, gg_error *err);
/* Convert those that are given to the engine's units: velocities are over `unit`. Under periodic boundaries box[a] is
 * the same place as 0. */
void gg_common_engine_grains_take(const gg_model *m, const gg_grain_arrays *g, double unit, gg_engine_grains *a);
/* Hash of a state, to compare trajectories. The time is left out: it is a sum over stretches, and its last bits depend
 * on the division into advances. */
uint64_t gg_common_grains_hash(uint64_t collisions, const gg_grain_arrays *grains, size_t n);

bool gg_common_is_same_gas(const gg_model *a, const gg_model *b);
/* An engine of another model of the same gas, with its grains, clock, counts and random streams, that keeps sums. The
 * old one stays. */
gg_status gg_common_engine_continue(gg_engine *engine, const gg_model *model, gg_engine **next, gg_error *err);

#endif
