/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internal header of the Enskog Monte Carlo engine: its state, and its functions by the file that defines them. */
#ifndef GG_DSMC_DSMC_H
#define GG_DSMC_DSMC_H

#include "common/engine.h"
#include "common/laws/coefficient_tables.h"
#include "common/thermostat.h"
#include "dsmc/advance.h"
#include "dsmc/ensemble.h"
#include "dsmc/kernel/kernels.h"
#include "dsmc/kernel/pass.h"
#include "dsmc/majorant.h"
#include "dsmc/parallel/schedule.h"
#include "dsmc/splitting.h"
#include "dsmc/time_step.h"

/* All variables of a run but the ensemble: plain data, saved as bytes. */
typedef struct gg_dsmc_state {
  gg_rng rng;
  gg_dsmc_rng_lanes lanes;
  double time, temperature, fastest; /* temperature and largest speed of the last synchronisation */
  uint64_t collisions, candidates, overflows, clamped;
  double remainder[GG_PAIRS]; /* fractional remainder of candidates */
  double strain;              /* accumulated shear strain, rate x time, since stored velocities were last streamed */
  double unsynchronised;      /* time since the last synchronisation */
  gg_vec centre;              /* velocity of the centre of mass at that time; in a bath the present stored one */
  gg_dsmc_time_step step;
  double kept; /* energy of centres that the Gaussian thermostat keeps, if spins exchange energy with centres */
  double lost; /* energy lost in collisions that the Gaussian thermostat has not returned */
  gg_dsmc_majorant majorant[GG_PAIRS];
  gg_collision_sums transfer;
  int power; /* velocities are 2^power times those of the start (rescale) */
  gg_dsmc_advance advance;
} gg_dsmc_state;

typedef struct gg_dsmc_rounds_room gg_dsmc_rounds_room;

typedef struct gg_dsmc {
  gg_engine base;
  gg_model model;
  gg_dsmc_ensemble ensemble;
  gg_coefficient_tables *tables; /* of coefficients that depend on the speed; NULL: none */
  gg_dsmc_schedule *schedule;    /* NULL if the ensemble is one segment */
  gg_dsmc_rounds_room *rounds;   /* likewise */
  gg_dsmc_path path[GG_PAIRS];
  gg_heat heat;
  double noise; /* xi^2 of the white noise */
  gg_dsmc_state now;
  gg_dsmc_callback callback; /* call NULL: none */
  double interval_begin;     /* time at which the present collisions begin, for a callback */
} gg_dsmc;

/* step.c: synchronise the stored velocities, measure their temperature and choose the step. */
void gg_dsmc_synchronise(gg_dsmc *d);
/* Take a step of at most `left` time and about `wanted` collisions. Returns its length. */
double gg_dsmc_step(gg_dsmc *d, double left, double wanted);

/* species_pair.c: features of the kernel that two species need. */
gg_dsmc_features gg_dsmc_features_of(const gg_dsmc *d, int i, int j);
/* Constants of all collisions of two species. */
gg_dsmc_pass gg_dsmc_pass_of(gg_dsmc *d, int i, int j);
/* sigma^2 chi/V. */
double gg_dsmc_cross_section(const gg_dsmc *d, int i, int j);
/* Candidates of a window of their majorant. */
uint64_t gg_dsmc_window(const gg_dsmc *d, int i, int j);
/* Add the results of a pass over a pair of species to the state. */
void gg_dsmc_add_pass(gg_dsmc *d, int pair, const gg_dsmc_pass *pass);

/* Start all majorants from safe values. */
void gg_dsmc_start_majorants(gg_dsmc *d);
/* Number of candidates, `mean` on average for any step: a Poisson number if candidates come one by one, or as a
 * correction. For candidates that come eight at a time this would fluctuate too much; their fractional remainder is
 * carried over. */
uint64_t gg_dsmc_candidates(bool one_by_one, double mean, double *remainder, gg_rng *rng);
/* collision_loop.c: all collisions of an interval `dt`, with candidates at strains `strain` + (0..1) x `span`. */
void gg_dsmc_collide(gg_dsmc *d, double dt, double strain, double span, gg_dsmc_splitting splitting);

/* parallel/round_robin.c: memory for collisions in segments. */
gg_dsmc_rounds_room *gg_dsmc_rounds_room_new(int n_species, int segments, gg_error *err);
void gg_dsmc_rounds_room_free(gg_dsmc_rounds_room *room);
/* The same as gg_dsmc_collide for an ensemble in segments. */
void gg_dsmc_collide_segments(gg_dsmc *d, double dt, double strain, double span, gg_dsmc_splitting splitting);

/* dsmc_accept.c */
gg_status gg_dsmc_accepts(const gg_model *model, gg_error *err);
/* dsmc_describe.c */
void gg_dsmc_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);
/* Description of a collision rule. */
const char *gg_dsmc_rule_line(gg_rule rule);
/* dsmc_allocate.c: allocate an engine for this model. The caller sets base.ops. */
gg_status gg_dsmc_allocate(const gg_model *model, gg_dsmc **d, gg_error *err);
void gg_dsmc_destroy(gg_engine *engine);
/* Estimated memory of an engine for this model, in bytes. */
double gg_dsmc_bytes(const gg_model *model);
/* dsmc_time.c: estimated nanoseconds a collision, also between walls. */
double gg_dsmc_nanoseconds(const gg_model *model);
/* Path of the collisions of two species. */
gg_dsmc_path gg_dsmc_path_of(const gg_dsmc *d, int i, int j);
/* Set the paths of all pairs of species. */
void gg_dsmc_take_paths(gg_dsmc *d);
/* collision_observer.c: the collision callback, and its times of last collisions in a checkpoint. */
gg_status gg_dsmc_set_callback(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err);
bool gg_dsmc_callback_slows(const gg_engine *engine);
gg_status gg_dsmc_save_callback(const gg_dsmc *d, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_restore_callback(gg_dsmc *d, const gg_archive *archive, gg_error *err);
/* Rescale times of last collisions when velocities are multiplied by the factor: distances in time from the origin are
 * divided by it, so free paths are unchanged. */
void gg_dsmc_rescale_callback(gg_dsmc *d, double factor, double origin);

/* dsmc_checkpoint.c. The caller of gg_dsmc_restore sets base.ops. */
gg_status gg_dsmc_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
