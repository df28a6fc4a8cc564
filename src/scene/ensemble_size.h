/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Number of grains of a Monte Carlo ensemble where the scene does not give it: chosen by the requested error. */
#ifndef GG_ENSEMBLE_H
#define GG_ENSEMBLE_H

#include <stddef.h>

#include "common/model.h"
#include "scene/scene.h"

/* The relative error that ends a run; 0 where only collisions do. */
double gg_scene_ensemble_requested_error(const gg_scene *scene);

double gg_scene_ensemble_size_error(const gg_scene *scene);
int64_t gg_scene_ensemble_size(const gg_scene *scene);
/* The share of the requested error that the bias by their number may be: a quarter, between walls half. */
double gg_scene_ensemble_most_bias(gg_flow flow);
/* Why so many, as a sentence's second half: "chosen: ..."; "" where the scene gives the number. */
void gg_scene_ensemble_size_reason(const gg_scene *scene, char *text, size_t size);

#endif
