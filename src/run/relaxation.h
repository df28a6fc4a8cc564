/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gas that is followed in time from its start (run.duration): when it is sampled, what changes on the way (protocol),
 * and the curves in time that result, means over replicas. */
#ifndef GG_RUN_RELAXATION_H
#define GG_RUN_RELAXATION_H

#include "run/replicas.h"

/* Samples in all: at evenly spaced times, and at each of a change. The time of sample k, from 1 on; 0: the start. In
 * units of results. */
uint64_t gg_run_relaxation_samples(const gg_scene *scene);
double gg_run_relaxation_time(const gg_scene *scene, uint64_t k);

/* How many changes there are up to sample k; and the model after so many, with GG_BAD_INPUT where a value needs another
 * gas than `model`. */
int gg_run_relaxation_changes(const gg_scene *scene, uint64_t k);
gg_status gg_run_relaxation_model(const gg_scene *scene, const gg_model *model, int changes, gg_model *changed,
                                  gg_error *err);
/* That of all changes, before the run begins. */
gg_status gg_run_relaxation_check(const gg_scene *scene, const gg_model *model, gg_error *err);
/* Collisions a grain up to the end, about. */
double gg_run_relaxation_collisions(const gg_scene *scene, const gg_model *model);
/* The scene after the last change, and its model: what theories describe, and observables measure. */
gg_status gg_run_relaxation_end_scene(const gg_scene *scene, gg_scene *end, gg_error *err);
gg_status gg_run_relaxation_end_model(const gg_scene *scene, gg_engine_kind engine, gg_model *model, gg_error *err);

/* Values at the end, over replicas; and the curves of what is followed. */
gg_mean gg_run_relaxation_end(const gg_replicas *all, gg_quantity q);
gg_status gg_run_relaxation_curves(const gg_replicas *all, gg_result *result, gg_error *err);

#endif
