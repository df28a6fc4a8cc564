/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The observables that sample an engine. Rows are made of chunks or blocks of grains at the end of every interval.
 * Curves are made of whole snapshots when an observable is due. */
#ifndef GG_MEASURE_SAMPLER_H
#define GG_MEASURE_SAMPLER_H

#include "measure/cell_frame.h"
#include "measure/local_frame.h"
#include "measure/observable.h"

enum { GG_MAX_OBSERVABLES = GG_N_OBSERVABLES + 1 }; /* built-in ones, and one for all user-defined ones */

typedef struct gg_sampler {
  const gg_model *model; /* borrowed; after the changes so far */
  int n_observables;
  const gg_observable *observable[GG_MAX_OBSERVABLES];
  void *self[GG_MAX_OBSERVABLES];
  size_t offset[GG_MAX_OBSERVABLES]; /* first channel of the observable in a row */
  size_t wall_modes_at;              /* first channel of the wall modes (wall_modes.h) */
  size_t width;                      /* channels of a row */
  double *row;
  gg_bins bins[GG_MAX_OBSERVABLES];                                           /* of observables with curves */
  int every[GG_MAX_OBSERVABLES];                                              /* samples between their snapshots */
  enum gg_observed { GG_OBSERVED_UNSET, GG_NOT_OBSERVED, GG_OBSERVED } shown; /* state of the collision callback */
  gg_snapshot snapshot;    /* taken only if an observable with curves is due */
  int parts;               /* of an interval while averaging: a snapshot ends each part */
  bool transient;          /* some bins are of a transient */
  struct gg_sampler_flow { /* between walls; else NULL */
    gg_slabs window;       /* of all rows since averaging began */
    gg_local_frame frame;  /* of them; before, of the last row */
  } * flow;
  gg_framed *framed; /* about cells; else NULL */
} gg_sampler;

/* A sampler that is all zero gets the observables of these flags, those of the calling program, and their memory. It is
 * to be cleared, also on failure. */
gg_status gg_measure_sampler_init(gg_sampler *s, const gg_model *model, unsigned flags, gg_error *err);
void gg_measure_sampler_clear(gg_sampler *s);
gg_status gg_measure_sampler_save(const gg_sampler *s, gg_archive *archive, gg_error *err);
gg_status gg_measure_sampler_restore(gg_sampler *s, const gg_archive *archive, gg_error *err);

/* The observable that has a quantity, and by what function; -1: none. */
int gg_measure_sampler_find(const gg_sampler *s, gg_quantity q, gg_function *f);
/* How a row of the first observable (rheology, if it was requested) gives a followed quantity, also one that decays and
 * has no mean. */
bool gg_measure_sampler_find_history(const gg_sampler *s, gg_quantity q, gg_function *f);

/* Fill the row after an interval of length `elapsed`. `velocity_factor`: of a rescaling that the observables have not
 * seen. */
void gg_measure_sampler_row(gg_sampler *s, gg_engine *engine, double elapsed, double velocity_factor, bool averaging);
/* Number of parts of an interval while averaging. Intervals of a transient are long or short: as many parts as
 * s->parts to a collision at the temperature T. */
int gg_measure_sampler_parts(const gg_sampler *s, double interval, double T);
/* While averaging: what curves need after each part of an interval, from 1 to `parts`; `samples`: whole intervals since
 * averaging began. */
void gg_measure_sampler_curves(gg_sampler *s, gg_engine *engine, int part, int parts, double elapsed,
                               double velocity_factor, uint64_t samples);
/* Averaging begins anew. */
void gg_measure_sampler_restart(gg_sampler *s, gg_engine *engine);
/* The model has changed, and the engine is another: curves are of the new gas alone. */
void gg_measure_sampler_change(gg_sampler *s, gg_engine *engine, bool averaging);

/* Before each interval of the window: the engine reports collisions to the observables that need them, always or in
 * bursts. `within`: the interval was interrupted, and continues. */
gg_status gg_measure_sampler_observe(gg_sampler *s, gg_engine *engine, uint64_t samples, bool within, gg_error *err);
/* Numbers of samples: length of a burst; first: period of the first bursts; apart: period from sample `regular_from` of
 * the window on. */
typedef struct gg_bursts {
  uint64_t length, first, apart, regular_from;
} gg_bursts;
gg_bursts gg_measure_bursts_of(const gg_model *model);

#endif
