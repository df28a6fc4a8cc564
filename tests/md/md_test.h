/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helpers for the tests of md: models from a few numbers, engines, a plain search for the next event, hashes. */
#ifndef GG_MD_TEST_H
#define GG_MD_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "common/engine.h"
#include "md/epoch.h"
#include "md/event_loops.h"
#include "md/grid.h"
#include "md/md_allocate.h"
#include "md/md_thermostat.h"
#include "md/row_motion.h"
#include "md/select_search.h"
#include "md/start/start.h"
#include "scene/scene.h"

typedef struct md_case {
  gg_flow flow;
  int64_t n;
  double phi, e, beta, mu;
  double aspect[3]; /* zeros: a cube */
} md_case;

gg_scene md_scene(md_case c);
gg_model md_model(md_case c);
gg_model md_model_of(const gg_scene *scene);
gg_md *md_create(const gg_model *model, uint64_t seed);
void md_destroy(gg_md *e);

/* Advances by at most so many collisions. Returns the time that passed. */
double md_collide(gg_md *e, uint64_t collisions);
/* Hash of all that decides how a run continues. */
uint64_t md_hash(const gg_md *e);
/* Hash of the state, the counts, and the collision sums, which are taken. */
uint64_t md_hash_all(gg_md *e);
/* Adds data to a hash. */
uint64_t md_mix(uint64_t hash, const void *data, size_t bytes);

/* The next collision of two grains up to `horizon` from now, found in long double among all images of all pairs. Its
 * time is INFINITY if there is none. */
typedef struct md_prediction {
  long double time; /* from now */
  uint32_t pair[2];
} md_prediction;
md_prediction md_oracle(const gg_md *e, double horizon);
/* The same for contacts with surfaces; pair[1] is GG_MD_SURFACE(which). */
md_prediction md_oracle_walls(const gg_md *e, double horizon);
/* The smallest distance of two centres over their contact distance. */
long double md_closest(const gg_md *e);

/* The number of grains that are outside their cell, in a wall or, with lists, outside their skin or missing in a
 * neighbour's list. */
uint32_t md_misplaced(const gg_md *e);

/* Total momentum and energy of peculiar velocities. */
gg_vec md_momentum(const gg_md *e);
double md_energy(const gg_md *e);

#endif
