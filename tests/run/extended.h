/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by tests of extended scenes: scenes, two observables, two laws of restitution. */
#ifndef GG_TEST_EXTENDED_H
#define GG_TEST_EXTENDED_H

#include "run/run.h"

gg_scene *scene_of(const char *yaml); /* finished, as runs do with their copies */
gg_result *run(const gg_scene *scene, int threads);
extern const char sheared[], sheared_dsmc[];

/* my_temperature, my_stress, my_samples; my_rate, counted from the collisions that it is shown. */
extern const gg_observable_definition thermometer, counter;
void add(gg_scene *scene, const gg_observable_definition *observable);

gg_restitution constant, falling; /* *(double *)context; with the speed */
void set_law(gg_scene *scene, const char *name, gg_restitution *law, void *context);

/* GG_BAD_INPUT, with the word in its message. */
void refused(gg_status status, const gg_error *err, const char *word);

#endif
