/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An observable: a plug-in that turns what an engine shows (its grains, its sums over collisions) into a row of numbers
 * a sample, and channel means into named quantities; or adds to bins, from which curves follow; or both. It knows
 * nothing of engines' insides, files or pictures. A new one is a file and a line in common/observables.h.
 *
 * It borrows the model of its gas. Where a gas is followed in time the scene's `protocol` changes that model in place,
 * between two samples: coefficients of collisions, bath, thermostat, shear rate, and what follows from them
 * (gg_run_is_same_gas: grains, box and units stay). Bins begin anew then, and `restart` is called. So an observable
 * keeps no copy of what may change, but for what it derives in `restart`. */
#ifndef GG_OBSERVABLE_H
#define GG_OBSERVABLE_H

#include "common/engine.h"
#include "common/model.h"
#include "common/quantity.h"
#include "measure/curve.h"
#include "measure/grain_snapshot.h"
#include "statistics/estimator.h"

/* One sampling interval: sums over its collisions, and how long it lasted (0: the very first sample, which makes no
 * row).
 * velocity_factor: by what all velocities were multiplied when it began (1, but for cooling runs that were rescaled).
 */
typedef struct gg_interval {
  const gg_model *model;
  const gg_collision_sums *transfer;
  double elapsed, velocity_factor;
} gg_interval;

/* A quantity as a function of this observable's channel means; or a family of them, by its first member, with `each`.
 */
typedef struct gg_derived {
  gg_quantity quantity;
  gg_of_means *of;
  gg_member_of_means *each; /* where `of` is NULL */
} gg_derived;
/* Ends a table of them. */
#define GG_DERIVED_END                                                                                                 \
  {                                                                                                                    \
    GG_MOST_QUANTITIES, NULL, NULL                                                                                     \
  }

typedef struct gg_observable {
  const char *name;                                      /* the word under `measure` in a scene */
  unsigned flag;                                         /* GG_MEASURE_... */
  void *(*create)(const gg_model *model, gg_error *err); /* borrows the model */
  void (*destroy)(void *self);
  /* Plain bytes that one sample leaves for the next: what a checkpoint keeps. NULL if there are none. */
  void *(*memory)(void *self, size_t *bytes);
  /* Can these bytes, read from a file, be its memory? Where it holds indices; NULL: all can. */
  bool (*is_memory)(const void *self);
  /* Why this model cannot have it at all; NULL (also the function itself) if it can. A gas that comes to one which has
   * it is not shown to it before. */
  const char *(*refuses)(const gg_model *model);

  /* Rows: quantities. Every sample is begin, then all grains in chunks (or blocks), then finish, which writes the row.
   * An observable without rows has width NULL, and none of what follows. */
  size_t (*width)(const gg_model *model);
  void (*begin)(void *self);
  /* Are positions wanted for the row that has begun, where the engine has any? Beside `positions`; NULL: no. */
  bool (*wants_positions)(const void *self);
  void (*add_chunk)(void *self, const gg_chunk *chunk);
  void (*add_blocks)(void *self, const gg_block_run *run); /* instead, with the same result; NULL: chunks only */
  void (*finish)(void *self, const gg_interval *interval, double *row);
  const gg_derived *derived;
  /* What followed quantities (GG_FOLLOWED) are in a single row, where it is something else than `derived` has; NULL: no
   * history is asked of this observable. */
  const gg_derived *history;
  /* ln T of a row in units of the start, where T itself may be below all numbers; NULL: unknown. */
  double (*log_temperature)(const double *row);

  /* Curves: while averaging, a snapshot at the end of every `every`-th sampling interval is added to bins. An
   * observable without curves has bins NULL. */
  size_t (*bins)(const void *self);
  int every;
  int (*every_of)(const void *self); /* instead, where it depends on the size; NULL: `every` */
  int parts;      /* above 1: each interval is cut into so many parts, with a snapshot after each; for correlations in
                     time */
  bool framed;    /* its snapshots are in the scene's frame; else they are about the imposed flow */
  bool positions; /* of the grains are wanted, where the engine has any */
  void (*add_snapshot)(void *self, const gg_snapshot *snapshot, double *bins);
  /* Called with every sampling interval, after the snapshot at its end. What it takes from it goes into the bins with
   * the next snapshot, and has to be among the memory. NULL: not needed. */
  void (*add_interval)(void *self, const gg_interval *interval);
  /* Called with every collision while averaging; goes into the bins with the next snapshot. NULL: not needed. */
  gg_collision_callback *add_collision;
  bool of_walls_too;                               /* also with every contact with a surface (record's `wall`) */
  bool (*wants_collisions)(const gg_model *model); /* does it want them of this model? NULL: of all */
  /* It does with the collisions of some bursts, where showing them slows the engine down many times over; called when
   * one begins, and after a change of the model: the engine knows of no contacts before. Snapshots are then added in
   * bursts only. NULL: it is to have every collision. */
  void (*begin_burst)(void *self);
  /* All velocities have just been multiplied by this: told before the next collision, where it has add_collision. */
  void (*rescaled)(void *self, double factor);
  /* Averaging begins (anew), or the model has changed: forget earlier snapshots. NULL if there is nothing to forget. */
  void (*restart)(void *self);
  gg_curves_of *curves;
} gg_observable;

/* Does this model have it? */
static inline bool gg_measure_observable_applies(const gg_observable *o, const gg_model *model)
{
  return !o->refuses || !o->refuses(model);
}
/* Is it to be shown the collisions of this model? */
bool gg_measure_observable_wants_collisions(const gg_observable *o, const gg_model *model);

/* The function that gives a quantity, from such a table; false if it has none. */
bool gg_measure_derived_find(const gg_derived *table, gg_quantity q, gg_function *f);

/* Name and flag of an observable of the list in common/observables.h. */
#define GG_OBSERVABLE(FLAG, word) .name = #word, .flag = GG_MEASURE_##FLAG

/* Every observable of that list, NULL-terminated; and each by its name, gg_measure_rheology and so on. */
extern const gg_observable *const gg_measure_observables[];
#define GG_OBSERVABLE_PLUG_IN(FLAG, word, description) extern const gg_observable gg_measure_##word;
GG_OBSERVABLES(GG_OBSERVABLE_PLUG_IN)
#undef GG_OBSERVABLE_PLUG_IN

/* What observables ask of a model; each is the reason to refuse it, or NULL where the model has it. */
static inline const char *gg_measure_needs_positions(const gg_model *m)
{
  return !m->ensemble     ? NULL
         : m->homogeneous ? "the Monte Carlo ensemble has no positions"
                          : "the Monte Carlo ensemble has no positions along the walls";
}
/* The same gas everywhere: no walls. */
static inline const char *gg_measure_needs_homogeneity(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? "between walls the gas depends on the place; measure profiles" : NULL;
}
/* Both. */
static inline const char *gg_measure_needs_bulk(const gg_model *m)
{
  const char *reason = gg_measure_needs_positions(m);
  return reason ? reason : gg_measure_needs_homogeneity(m);
}

/* Observables that the user's program brings (graingas.h, "Extension"): one plug-in for all that the model has; NULL
 * without any. */
const gg_observable *gg_measure_user_observables(const gg_model *model);

#endif
