/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An observable: a plug-in that turns the samples of an engine (its grains, its collision sums) into a row of
 * numbers a sample, and channel means into named quantities; or adds to bins, from which curves follow; or both. It
 * does not depend on engines' internals, files or pictures. A new observable is a file and a line in
 * common/observables.h.
 *
 * An observable borrows the model of its gas. In a transient run the scene's `protocol` changes that model in place,
 * between two samples: coefficients of collisions, bath, thermostat, shear rate, and the values that follow from
 * them (gg_common_is_same_gas: grains, box and units stay). Bins are then reset, and `restart` is called. So an
 * observable keeps no copy of members that may change, except for values that it derives in `restart`. */
#ifndef GG_OBSERVABLE_H
#define GG_OBSERVABLE_H

#include "common/engine.h"
#include "common/model.h"
#include "common/quantity.h"
#include "measure/curve.h"
#include "measure/grain_snapshot.h"
#include "statistics/estimator.h"

/* One sampling interval: sums over its collisions, and its duration (0: the first sample, which makes no row).
 * velocity_factor: factor on all velocities at its beginning (1, but for cooling runs that were rescaled). */
typedef struct gg_interval {
  const gg_model *model;
  const gg_collision_sums *transfer;
  double elapsed, velocity_factor;
} gg_interval;

/* A quantity as a function of this observable's channel means; or a family of quantities, by its first member, with
 * `each`. */
typedef struct gg_derived {
  gg_quantity quantity;
  gg_of_means *of;
  gg_member_of_means *each; /* where `of` is NULL */
  const char *unknown;      /* why it is NaN where it is; NULL: nobody knows */
} gg_derived;
/* End of a table of derived quantities. */
#define GG_DERIVED_END                                                                                                 \
  {                                                                                                                    \
    GG_MOST_QUANTITIES, NULL, NULL, NULL                                                                               \
  }

/* Rows: the observable writes a row of numbers at every sample. All grains are visited in chunks (or blocks) between
 * `begin` and `finish`. A NULL function has nothing to do. */
typedef struct gg_observable_rows {
  size_t (*width)(const gg_model *model);
  void (*begin)(void *self);
  bool (*wants_positions)(const void *self); /* for the row that has begun; NULL: as the member `positions` */
  void (*add_chunk)(void *self, const gg_chunk *chunk);
  void (*add_blocks)(void *self, const gg_block_run *run); /* with the result of add_chunk; NULL: chunks only */
  void (*finish)(void *self, const gg_interval *interval, double *row);
  const gg_derived *derived; /* quantities as functions of channel means */
  const gg_derived *history; /* quantities of a single row, where they differ from `derived`; NULL: no history */
  double (*log_temperature)(const double *row); /* in units of the start, also if T underflows; NULL: unknown */
} gg_observable_rows;

/* Curves: while averaging, the snapshot at the end of every `every`-th sampling interval is added to bins. */
typedef struct gg_observable_curves {
  size_t (*bins)(const void *self); /* number of bins */
  int every;
  int (*every_of)(const void *self); /* replaces `every` if that depends on the size; NULL: `every` */
  int parts; /* above 1: each interval is divided into so many parts with a snapshot each, for correlations in time */
  /* True if bins are sums of a transient, from a snapshot at its beginning on. NULL: never. */
  bool (*of_transient)(const void *self);
  bool framed; /* velocities of the scene's frame (cell_frame.h); else about the imposed flow */
  void (*add_snapshot)(void *self, const gg_snapshot *snapshot, double *bins);
  /* Called with every sampling interval, after the snapshot at its end. The data go into the bins with the next
   * snapshot, and must be part of `memory`. NULL: not needed. */
  void (*add_interval)(void *self, const gg_interval *interval);
  gg_curves_of *of_bins;
} gg_observable_curves;

/* Collisions: the observable receives every collision while averaging. */
typedef struct gg_observable_collisions {
  gg_collision_callback *add;
  bool of_walls_too;                     /* also every contact with a surface (record's `wall`) */
  bool (*wanted)(const gg_model *model); /* NULL: for all models */
  /* Collisions of bursts are enough, if the callback slows the engine down many times. Called when a burst begins, and
   * after a change of the model: earlier contacts are then unknown. Snapshots are added in bursts only. NULL: every
   * collision is needed. */
  void (*begin_burst)(void *self);
} gg_observable_collisions;

/* Cost of an observable in a run, for the estimate before it begins (run/cost_estimate.c). Nanoseconds are processor
 * time a collision, in excess of a run without it, by engine (`graingas bench observables`; rough grains). */
typedef struct gg_observable_cost {
  double bytes; /* a grain; bins apart */
  double ns[2]; /* of md, of dsmc */
} gg_observable_cost;

typedef struct gg_observable {
  const char *name;                                      /* the word under `measure` in a scene */
  unsigned flag;                                         /* GG_MEASURE_... */
  void *(*create)(const gg_model *model, gg_error *err); /* borrows the model */
  void (*destroy)(void *self);
  /* Plain bytes that one sample leaves for the next: a checkpoint stores them. NULL: none. */
  void *(*memory)(void *self, size_t *bytes);
  /* Validates a memory that was read from a file, if it holds indices; NULL: every content is valid. */
  bool (*is_memory)(const void *self);
  /* The reason why this model cannot have the observable; NULL (also the function) if it can. A gas whose model
   * changes is measured from the first model on that can have it. */
  const char *(*refuses)(const gg_model *model);
  bool positions; /* of the grains are needed, if the engine has any */
  /* All velocities have just been multiplied by the factor; called before the next collision. NULL: not needed. */
  void (*rescaled)(void *self, double factor);
  /* Averaging begins again, or the model has changed: forget earlier snapshots. NULL: nothing to forget. */
  void (*restart)(void *self);
  const gg_observable_rows *rows;             /* NULL: none */
  const gg_observable_curves *curves;         /* NULL: none */
  const gg_observable_collisions *collisions; /* NULL: none */
  gg_observable_cost cost;
  gg_observable_cost (*cost_of)(const gg_model *model); /* replaces `cost` if that depends on the model; else NULL */
} gg_observable;

/* True if this model can have the observable. */
static inline bool gg_measure_observable_applies(const gg_observable *o, const gg_model *model)
{
  return !o->refuses || !o->refuses(model);
}
/* True if the observable needs the collisions of this model. */
bool gg_measure_observable_wants_collisions(const gg_observable *o, const gg_model *model);

/* The function of a quantity in a table of derived quantities; false if it has none. */
bool gg_measure_derived_find(const gg_derived *table, gg_quantity q, gg_function *f);

/* Name and flag of an observable of the list in common/observables.h. */
#define GG_OBSERVABLE(FLAG, word) .name = #word, .flag = GG_MEASURE_##FLAG

/* All observables of that list, NULL-terminated; and each by its name, gg_measure_rheology and so on. */
extern const gg_observable *const gg_measure_observables[];
#define GG_OBSERVABLE_PLUG_IN(FLAG, word, description) extern const gg_observable gg_measure_##word;
GG_OBSERVABLES(GG_OBSERVABLE_PLUG_IN)
#undef GG_OBSERVABLE_PLUG_IN

/* Requirements of observables: each function returns the reason why a model does not meet it, or NULL. */
static inline const char *gg_measure_needs_positions(const gg_model *m)
{
  return !m->ensemble     ? NULL
         : m->homogeneous ? "the Monte Carlo ensemble has no positions"
                          : "the Monte Carlo ensemble has no positions along the walls";
}
/* The gas is homogeneous: no walls. */
static inline const char *gg_measure_needs_homogeneity(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? "between walls the gas depends on the place; measure profiles"
         : m->wave > 0              ? "the wave of start.wave depends on the place"
                                    : NULL;
}
/* Positions and homogeneity. */
static inline const char *gg_measure_needs_bulk(const gg_model *m)
{
  const char *reason = gg_measure_needs_positions(m);
  return reason ? reason : gg_measure_needs_homogeneity(m);
}

/* Observables of the user's program (graingas.h, "Extension"): one plug-in for all of the model; NULL without any. */
const gg_observable *gg_measure_user_observables(const gg_model *model);

#endif
