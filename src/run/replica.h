/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A replica: one engine, the observables that sample it, and the series they fill. */
#ifndef GG_REPLICA_H
#define GG_REPLICA_H

#include "measure/sampler.h"
#include "run/run.h"
#include "scene/scene.h"

typedef struct gg_replica {
  gg_model model; /* after the protocol's changes so far */
  gg_scene scene;
  gg_engine *engine;
  gg_sampler sampler;
  gg_series series;
  double trajectory_every;  /* collisions per grain between frames; 0: none */
  bool images;              /* the engine counts images of the box, for the frames */
  bool logged;              /* the caller gets every sample */
  bool frames_of_window;    /* none of the warm-up */
  struct gg_replica_clock { /* plain data: saved as bytes */
    uint64_t samples;       /* taken so far */
    double interval;        /* between samples, engine's time */
    double temperature;     /* of the last sample, at the engine's present velocities */
    double time;            /* since the start, in units of the start */
    int64_t power;          /* the engine's velocities are 2^power times those of the start */
    double velocity_factor; /* of a rescaling not yet reported to the observables */
    double cpu, window_cpu; /* seconds used; at the opening of the window */
    uint64_t window_collisions;
    uint64_t averaging, window_samples; /* curves are being taken; samples since */
    double next_frame, frame_every;     /* collisions per grain; trajectory_every when next_frame was set */
    /* The interval under way, if the run was stopped within it. */
    int64_t part;       /* part in which it was stopped, from 1 on; 0: between intervals */
    double gone;        /* time elapsed in the parts before */
    double part_gone;   /* time elapsed in this part */
    uint64_t happened;  /* collisions of the engine when the interval began */
    uint64_t cut_short; /* number of last intervals in a row that reached the largest number of collisions */
    int64_t changes;    /* number of changes of the protocol that the engine has */
  } clock;
} gg_replica;

/* The sampling interval, collisions per grain: closer samples cost time and say little new. */
#define GG_SAMPLING_INTERVAL 2.0

gg_status gg_run_replica_create(gg_replica *r, const gg_scene *scene, const gg_model *model, int index, gg_error *err);
void gg_run_replica_clear(gg_replica *r);

/* Continue until the total number of samples is `samples`. GG_INTERRUPTED if model.stop is set, also within an
 * interval: a replica saved there continues bit for bit. With `adapt` the interval follows the collision rate (warm-up,
 * cooling).
 */
gg_status gg_run_replica_advance(gg_replica *r, uint64_t samples, bool adapt, const gg_run_callbacks *callbacks,
                                 gg_error *err);

/* True if the sampling interval fits a collision rate of at most `most` times Enskog's. After a burst it is too short
 * at first. Grains in lasting contact collide up to 300 times as often as Enskog's, in a collapse 1000 times. */
bool gg_run_replica_interval_fits(const gg_replica *r, double most);
/* Report that collisions accumulate without end: GG_FAILED with GG_CAUSE_COLLAPSE. */
gg_status gg_run_replica_collapsed(const gg_replica *r, gg_error *err);

/* Averaging begins at the next sample. */
gg_status gg_run_replica_open_window(gg_replica *r, gg_error *err);

/* observable_setup.c: the observables that the scene asks for, and the series of their rows. */
gg_status gg_run_replica_setup_observables(gg_replica *r, const gg_scene *scene, gg_error *err);
/* Flags of the requested observables that the gas of the scene can have, `model` at its start; and a line for each
 * other one. */
gg_status gg_run_measured(const gg_scene *scene, const gg_model *model, unsigned *flags, gg_error *err);
gg_status gg_run_unmeasured(const gg_scene *scene, const gg_model *model, void (*line)(void *context, const char *text),
                            void *context, gg_error *err);

double gg_run_replica_collisions_per_grain(const gg_replica *r);
/* A frame of the engine as results have it: at the time since the start, velocities in units of the start. */
void gg_run_replica_date_frame(const gg_replica *r, gg_frame *frame);

gg_status gg_run_replica_save(const gg_replica *r, gg_archive *archive, gg_error *err);
gg_status gg_run_replica_restore(gg_replica *r, const gg_archive *archive, const gg_scene *scene, const gg_model *model,
                                 int index, gg_error *err);

#endif
