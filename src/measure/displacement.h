/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Displacements of grains from snapshot to snapshot, along whole paths. Under shear they are peculiar: the integral of
 * C, without the displacement by the flow along x, for which the mean of the grain's heights at two snapshots counts.
 *
 * The displacement of a grain between two snapshots leads to one of the images of its new place. The image is
 * selected by the velocities at both snapshots. If the grain may have crossed half of the box and collided in between,
 * it is selected by the velocities of all flights: where free paths are long beside the box, and in runs that are
 * followed in time, whose intervals may have any length. The Monte Carlo ensemble has no positions:
 * there the flights are the displacement, and grains keep theirs in the ensemble, as every collision is observed. */
#ifndef GG_DISPLACEMENT_H
#define GG_DISPLACEMENT_H

#include "common/engine.h"
#include "common/model.h"
#include "measure/grain_snapshot.h"

typedef struct gg_displacement {
  const gg_model *model;
  size_t n;
  double *r[3], *c[3], *moved[3]; /* at the last snapshot, by place; moved: displacement since the start */
  double *flown[3], *until;       /* since the last snapshot, up to the last collision; NULL in long boxes */
  uint32_t *place;                /* for each grain by its number: species 1 first */
} gg_displacement;

/* True if all flights must be followed. The answer does not depend on the temperature, and so stays after every change
 * of the model. */
bool gg_measure_displacement_follows_flights(const gg_model *model);

/* Bytes of all arrays, and the arrays at an address that is aligned for doubles; returns the end of them. */
size_t gg_measure_displacement_bytes(const gg_model *model);
void *gg_measure_displacement_bind(gg_displacement *d, const gg_model *model, void *memory);
/* True if all places are valid indices, in a memory that was read from a file. */
bool gg_measure_displacement_is_valid(const gg_displacement *d);

/* A collision after the first snapshot. */
void gg_measure_displacement_collide(gg_displacement *d, const gg_collision_record *collision);
/* All velocities have been multiplied by the factor, after a snapshot and before the next collision; times divided. */
void gg_measure_displacement_rescaled(gg_displacement *d, double factor);
/* The next snapshot; `first`: displacements are 0 there. */
void gg_measure_displacement_take(gg_displacement *d, const gg_snapshot *s, bool first);

/* sum m C^2/(3 N) at the last snapshot, in the units of its velocities. */
double gg_measure_displacement_temperature(const gg_displacement *d);

/* The integral of v dt over a time in which v falls from `before` to `now`, by Haff's law v = before/(1 + t/tau). */
double gg_measure_displacement_path(double before, double now, double time);

/* True if first Sonine approximations of diffusion describe the grains: smooth, with constant e, without kicks. */
static inline bool gg_displacement_has_theory(const gg_model *m)
{
  return m->rule == GG_SMOOTH && !gg_model_has_speed(m) && !gg_model_is_injected(m);
}

#endif
