/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames of a trajectory: copies of the grains of an engine. */
#ifndef GG_MEASURE_FRAME_H
#define GG_MEASURE_FRAME_H

#include "common/engine.h"

/* Grains at one instant; arrays of 3 n (x y z x y z ...), NULL where there are none. */
typedef struct gg_frame {
  double time;
  uint64_t step; /* collisions since creation */
  size_t n;
  double *position, *velocity, *spin; /* velocity: peculiar; spin: omega (Boltzmann limit: (d/2) omega) */
  uint8_t *species;                   /* NULL for one species */
  int64_t *id;
} gg_frame;
gg_status gg_measure_frame_take(gg_engine *engine, const gg_model *model, gg_frame *frame, gg_error *err);
void gg_measure_frame_free(gg_frame *frame);
/* Places of the grains in the order of their numbers, so that a row is the same grain in every frame; to be freed. */
size_t *gg_measure_frame_order(const gg_frame *frame, gg_error *err);
/* Copy the grains in the order of their numbers; NULL: not wanted. */
void gg_measure_frame_copy(const gg_frame *f, double *position, double *velocity, double *spin, int *species);
/* Velocities and spins of a frame, in chunks as an engine shows them; spins there are surface velocities. */
void gg_measure_frame_visit(const gg_frame *frame, const gg_model *model, gg_visit *visit, void *context);

#endif
