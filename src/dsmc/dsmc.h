/* The Enskog Monte Carlo engine as its own files see it. */
#ifndef GG_DSMC_DSMC_H
#define GG_DSMC_DSMC_H

#include "common/engine.h"
#include "dsmc/ensemble.h"
#include "dsmc/kernel/kernels.h"
#include "dsmc/kernel/pairing.h"
#include "dsmc/majorant.h"
#include "dsmc/parallel/segments.h"
#include "dsmc/timestep.h"
#include "dsmc/turns.h"

/* Everything that changes while running, but for the ensemble: plain data, saved as it is. */
typedef struct gg_dsmc_state {
  gg_rng rng;
  gg_rng_lanes lanes;
  double time, temperature, fastest; /* temperature and largest speed: when the ensemble was last settled */
  uint64_t collisions, candidates, overflows;
  double owed[GG_PAIRS]; /* fractions of candidates carried over */
  double drift;          /* rate x time that stored velocities have still to stream */
  double unsettled;      /* time since the ensemble was last settled */
  gg_vec centre;         /* velocity of the centre of mass then */
  gg_time_step step;
  double lost; /* energy destroyed that the Gaussian thermostat has not given back */
  gg_majorant majorant[GG_PAIRS];
  gg_transfer transfer;
  bool tap;
} gg_dsmc_state;

typedef struct gg_dsmc {
  gg_engine base;
  gg_model model;
  gg_ensemble ensemble;
  gg_tournament *tournament; /* NULL if the ensemble is one segment */
  gg_path path[GG_PAIRS];
  gg_thermostat thermostat;
  double noise; /* xi^2 of the white noise */
  gg_dsmc_state now;
  gg_watching watching; /* watch NULL: nobody looks */
  double stretch;       /* time at which the present collisions begin; only for a watcher */
} gg_dsmc;

/* Bring the stored velocities up to date, look at their temperature and choose the step. */
void gg_dsmc_settle(gg_dsmc *d);
/* A step of no more than `left` time and about `wanted` collisions; returns its length. */
double gg_dsmc_step(gg_dsmc *d, double left, double wanted);

/* pairs.c: which kernel two species need. */
gg_features gg_dsmc_features(const gg_dsmc *d, int i, int j);
/* What all collisions of two species have in common. */
gg_pairing gg_dsmc_pairing(gg_dsmc *d, int i, int j);
/* sigma^2 chi/V. */
double gg_dsmc_cross_section(const gg_dsmc *d, int i, int j);
/* Candidates after which their bound forgets. */
uint64_t gg_dsmc_window(const gg_dsmc *d, int i, int j);
/* Add to the sums what the collisions of a pair of species came to. */
void gg_dsmc_hand_over(gg_dsmc *d, int pair, const gg_pairing *p);
/* Species of each pair. */
extern const int gg_species_of_pair[GG_PAIRS][2];

/* collisions.c: bounds that hold for sure, to start from. */
void gg_dsmc_bounds(gg_dsmc *d);
/* All collisions of a stretch `dt`, candidates at drifts `drift` + (0..1) x `span` (a constant one if span is 0). */
void gg_dsmc_collide(gg_dsmc *d, double dt, double drift, double span, gg_order_of_turns order);

/* rounds.c: the same for an ensemble in segments. */
void gg_dsmc_collide_in_rounds(gg_dsmc *d, double dt, double drift, double span, gg_order_of_turns order);

gg_status gg_dsmc_accepts(const gg_model *model, gg_error *err);
void gg_dsmc_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);
gg_status gg_dsmc_alloc(const gg_model *model, gg_dsmc **d, gg_error *err);
void gg_dsmc_destroy(gg_engine *engine);
/* watch.c: the watch operation; where it keeps when each grain last collided. */
gg_status gg_dsmc_watch(gg_engine *engine, gg_watch *watch, void *context, gg_error *err);
/* These candidates, over `dt` from d->stretch, are to be shown. */
void gg_dsmc_show_to_watcher(gg_dsmc *d, int i, int j, double dt, gg_pairing *pairing);
gg_status gg_dsmc_save_watching(const gg_dsmc *d, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_restore_watching(gg_dsmc *d, const gg_archive *archive, gg_error *err);
void gg_dsmc_rescale_watching(gg_dsmc *d, double factor);

gg_status gg_dsmc_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
