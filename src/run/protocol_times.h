/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Times of a gas that is followed from its start (run.duration): when it is sampled, and what changes on the way
 * (protocol). */
#ifndef GG_RUN_PROTOCOL_TIMES_H
#define GG_RUN_PROTOCOL_TIMES_H

#include "common/model.h"
#include "scene/scene.h"

/* Number of samples: at evenly spaced times, and at the time of each change. */
uint64_t gg_run_protocol_samples(const gg_scene *scene);
/* Time of sample k, from 1 on, in units of results; 0: the start. */
double gg_run_protocol_time(const gg_scene *scene, uint64_t k);

int gg_run_protocol_changes(const gg_scene *scene, uint64_t k);
/* The model after so many changes; GG_BAD_INPUT where a value needs another gas than `model`. */
gg_status gg_run_protocol_model(const gg_scene *scene, const gg_model *model, int changes, gg_model *changed,
                                gg_error *err);
gg_status gg_run_protocol_check(const gg_scene *scene, const gg_model *model, gg_error *err);
/* Shear rate from sample k on, where it is a formula of time; units of results. */
double gg_run_protocol_shear_rate(const gg_scene *scene, uint64_t k);
/* True if the gas is never at rest nor sheared backwards, so that it has a viscosity at all times. */
bool gg_run_protocol_is_forward(const gg_scene *scene);
/* Estimated collisions per grain up to the end. */
double gg_run_protocol_collisions(const gg_scene *scene, const gg_model *model);
/* The scene after the last change, and its model: what theories describe, and observables measure. */
gg_status gg_run_protocol_end_scene(const gg_scene *scene, gg_scene *end, gg_error *err);
gg_status gg_run_protocol_end_model(const gg_scene *scene, gg_engine_kind engine, gg_model *model, gg_error *err);

#endif
