/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law of normal restitution: e of the relative normal speed at contact, where a scene has one instead of constants:
 * one that is built in (common/laws/laws.h), or the callback of the user's program. */
#ifndef GG_RESTITUTION_H
#define GG_RESTITUTION_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "common/laws/laws.h"
#include "common/species.h"
#include "common/vec.h"

/* The callback of the public header, which states its contract. */
typedef double gg_restitution(void *context, double normal_speed, int species_1, int species_2);

typedef struct gg_restitution_law {
  const char *name;  /* NULL: e is constant; borrowed, as `context` is */
  gg_restitution *e; /* the user's; NULL: built in */
  void *context;
  gg_law_kind kind;
  double scale[GG_PAIRS]; /* the law's unit of speed over that of results, inverse: u = scale g; by gg_pair */
} gg_restitution_law;

/* e of two species at a speed in the units of results. A user's law that gives no number from 0 to 1 there is clamped
 * (NaN: 0), and *clamped counts it (NULL: nobody). */
double gg_common_law_at(const gg_restitution_law *law, double normal_speed, int species_1, int species_2,
                        uint64_t *clamped);

/* Built-in laws: the word; 1 - e at a speed in the law's units; the speed at which 1 - e has a given value. */
const char *gg_common_law_name(gg_law_kind kind);
double gg_common_law_loss(gg_law_kind kind, double u);
double gg_common_law_speed_of(gg_law_kind kind, double loss);

/* A built-in law takes collision.e from here to there, or 1: nearer to 1 the speeds of a gas would lie below the table
 * of losses (laws/loss_table.h), which has no smaller loss. */
#define GG_LAW_LEAST_E 0.01
#define GG_LAW_MOST_E 0.99999

/* A law interpolated in a table of ascending speeds: the `gg_restitution` of a `context` that is one of these. */
typedef struct gg_law_table {
  size_t n;
  const double *speed, *e;
} gg_law_table;
double gg_common_law_from_table(void *table, double normal_speed, int species_1, int species_2);

/* True if it is a number from 0 to 1 at speeds of all sizes. */
gg_status gg_common_law_check(const gg_restitution_law *law, int n_species, gg_error *err);

#endif
