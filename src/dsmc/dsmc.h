/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Enskog Monte Carlo engine as its own files see it. */
#ifndef GG_DSMC_DSMC_H
#define GG_DSMC_DSMC_H

#include "common/engine.h"
#include "common/laws/loss_table.h"
#include "dsmc/advance.h"
#include "dsmc/ensemble.h"
#include "dsmc/kernel/kernels.h"
#include "dsmc/kernel/pass.h"
#include "dsmc/majorant.h"
#include "dsmc/parallel/schedule.h"
#include "dsmc/splitting.h"
#include "dsmc/time_step.h"

/* Everything that changes while running, but for the ensemble: plain data, saved as it is. */
typedef struct gg_dsmc_state {
  gg_rng rng;
  gg_dsmc_rng_lanes lanes;
  double time, temperature, fastest; /* temperature and largest speed: when the ensemble was last synchronised */
  uint64_t collisions, candidates, overflows, clamped;
  double remainder[GG_PAIRS]; /* fractional remainder of candidates, carried over */
  double strain;              /* accumulated shear strain, rate x time, that stored velocities have still to stream */
  double unsynchronised;      /* time since the ensemble was last synchronised */
  gg_vec centre;              /* velocity of the centre of mass then; in a bath now, as stored */
  gg_dsmc_time_step step;
  double kept; /* energy of centres that a Gaussian thermostat keeps, where it is not that of collisions */
  double lost; /* energy destroyed that the Gaussian thermostat has not given back */
  gg_dsmc_majorant majorant[GG_PAIRS];
  gg_collision_sums transfer;
  bool sums;
  int power; /* velocities are 2^power times those of the start (rescale) */
  gg_dsmc_advance advance;
} gg_dsmc_state;

typedef struct gg_dsmc_rounds_room gg_dsmc_rounds_room;

typedef struct gg_dsmc {
  gg_engine base;
  gg_model model;
  gg_dsmc_ensemble ensemble;
  gg_loss_table *losses;       /* of a built-in law of restitution; NULL: none */
  gg_dsmc_schedule *schedule;  /* NULL if the ensemble is one segment */
  gg_dsmc_rounds_room *rounds; /* likewise */
  gg_dsmc_path path[GG_PAIRS];
  gg_thermostat thermostat;
  double noise; /* xi^2 of the white noise */
  gg_dsmc_state now;
  gg_dsmc_callback callback; /* call NULL: none */
  double interval_begin;     /* time at which the present collisions begin; only for a callback */
} gg_dsmc;

/* Bring the stored velocities up to date, measure their temperature and choose the step. */
void gg_dsmc_synchronise(gg_dsmc *d);
/* A step of no more than `left` time and about `wanted` collisions; returns its length. */
double gg_dsmc_step(gg_dsmc *d, double left, double wanted);

/* species_pair.c: which kernel two species need. */
gg_dsmc_features gg_dsmc_features_of(const gg_dsmc *d, int i, int j);
/* What all collisions of two species have in common. */
gg_dsmc_pass gg_dsmc_pass_of(gg_dsmc *d, int i, int j);
/* sigma^2 chi/V. */
double gg_dsmc_cross_section(const gg_dsmc *d, int i, int j);
/* Candidates after which their majorant forgets. */
uint64_t gg_dsmc_window(const gg_dsmc *d, int i, int j);
/* Add to the sums what the collisions of a pair of species came to. */
void gg_dsmc_add_pass(gg_dsmc *d, int pair, const gg_dsmc_pass *pass);

/* species_pair.c: majorants that hold for sure, to start from. */
void gg_dsmc_start_majorants(gg_dsmc *d);
/* How many candidates, `mean` on average, whatever the step: a Poisson number where they come one by one, or as a
 * correction. Eight at a time that would vary too much; there the fractional remainder is carried over instead. */
uint64_t gg_dsmc_candidates(bool one_by_one, double mean, double *remainder, gg_rng *rng);
/* collisions.c: all collisions of an interval `dt`, candidates at strains `strain` + (0..1) x `span` (a constant one if
 * span is 0).
 */
void gg_dsmc_collide(gg_dsmc *d, double dt, double strain, double span, gg_dsmc_splitting splitting);

/* parallel/round_robin.c: the same for an ensemble in segments, with the room that it takes. */
gg_dsmc_rounds_room *gg_dsmc_rounds_room_new(int n_species, int segments, gg_error *err);
void gg_dsmc_rounds_room_free(gg_dsmc_rounds_room *room);
void gg_dsmc_collide_segments(gg_dsmc *d, double dt, double strain, double span, gg_dsmc_splitting splitting);

gg_status gg_dsmc_accepts(const gg_model *model, gg_error *err);
double gg_dsmc_bytes(const gg_model *model);
void gg_dsmc_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);
/* Description of a collision rule. */
const char *gg_dsmc_rule_line(gg_rule rule);
gg_status gg_dsmc_allocate(const gg_model *model, gg_dsmc **d, gg_error *err);
void gg_dsmc_destroy(gg_engine *engine);
/* dsmc_allocate.c: the way that collisions of two species take; and set all of them. */
gg_dsmc_path gg_dsmc_path_of(const gg_dsmc *d, int i, int j);
void gg_dsmc_take_paths(gg_dsmc *d);
/* collision_observer.c: the collision callback; where it keeps when each grain last collided. */
gg_status gg_dsmc_set_callback(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err);
bool gg_dsmc_callback_slows(const gg_engine *engine);
gg_status gg_dsmc_save_callback(const gg_dsmc *d, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_restore_callback(gg_dsmc *d, const gg_archive *archive, gg_error *err);
/* Velocities are multiplied by the factor, and times before or after the origin divided: flights keep their paths. */
void gg_dsmc_rescale_callback(gg_dsmc *d, double factor, double origin);

gg_status gg_dsmc_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
