/* An observable: a plug-in that turns what an engine shows (its grains, its sums over collisions) into a row of numbers
 * a sample, and channel means into named quantities; or adds to bins, from which curves follow; or both. It knows
 * nothing of engines' insides, files or pictures. A new one is a file, a word in the scene's table and a line in
 * observables.c. */
#ifndef GG_OBSERVABLE_H
#define GG_OBSERVABLE_H

#include "common/engine.h"
#include "common/quantity.h"
#include "measure/curve.h"
#include "measure/snapshot.h"
#include "statistics/estimator.h"

/* One sampling interval: sums over its collisions, and how long it lasted (0: the very first look, which makes no row).
 * velocity_factor: by what all velocities were multiplied when it began (1, but for cooling runs that were rescaled).
 */
typedef struct gg_interval {
  const gg_model *model;
  const gg_transfer *transfer;
  double elapsed, velocity_factor;
} gg_interval;

/* A quantity as a function of this observable's channel means. */
typedef struct gg_derived {
  gg_quantity quantity;
  gg_of_means *of;
} gg_derived;

typedef struct gg_observable {
  const char *name; /* the word under `measure` in a scene */
  const char *doc;
  void *(*create)(const gg_model *model, gg_error *err);
  void (*destroy)(void *self);
  /* Plain bytes that one sample leaves for the next: what a checkpoint keeps. NULL if there are none. */
  void *(*memory)(void *self, size_t *bytes);
  unsigned flag; /* GG_MEASURE_... */
  /* Why this model cannot have it at all; NULL (also the function itself) if it can. */
  const char *(*refuses)(const gg_model *model);

  /* Rows: quantities. An observable without has width NULL, and none of what follows. */
  size_t (*width)(const gg_model *model);
  void (*begin)(void *self);
  void (*visit)(void *self, const gg_chunk *chunk);
  void (*visit_blocks)(void *self, const gg_block_run *run); /* instead, with the same result; NULL: chunks only */
  void (*finish)(void *self, const gg_interval *interval, double *row);
  const gg_derived *derived;   /* ends with of = NULL */
  gg_of_means *const *history; /* the gg_history_quantities of one row, GG_N_HISTORY of them; or NULL */
  /* Why this model has no such quantity; NULL if it has. */
  const char *(*missing)(const gg_model *model, gg_quantity quantity);

  /* Curves: once averaging has begun, add to bins at every `every`-th sample. An observable without has bins NULL. */
  size_t (*bins)(const void *self);
  int every;
  int looks;       /* looks between two samples, evenly spaced, instead of one at each: for correlations in time */
  bool positions;  /* wants them, where the engine has any */
  gg_watch *watch; /* is shown every collision while averaging, and leaves at the next look what it made of them; at
                      most one observable of all has this */
  void (*look)(void *self, const gg_snapshot *snapshot, double *bins);
  /* Hear of the collisions of every sampling interval, after the look at its end; what follows goes into the bins at
   * the next look, and has to be among the memory. NULL: none of its business. */
  void (*hear)(void *self, const gg_interval *interval);
  void (*restart)(void *self); /* averaging begins (anew): forget earlier looks; NULL if there is nothing to forget */
  gg_curves_of *curves;
} gg_observable;

/* The quantities followed from start to end of a run. */
enum { GG_N_HISTORY = 9 };
extern const gg_quantity gg_history_quantities[GG_N_HISTORY];

/* Every observable there is; NULL-terminated. */
extern const gg_observable *const gg_observables[];

extern const gg_observable gg_rheology, gg_velocity_distributions, gg_orientation, gg_sonine, gg_pair_correlation,
    gg_velocity_correlations, gg_structure, gg_cells, gg_profiles, gg_diffusion, gg_collisions, gg_local_distributions,
    gg_viscosity;

#endif
