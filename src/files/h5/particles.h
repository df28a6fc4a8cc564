/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grains in H5MD 1.1: /particles/grains with box, positions, velocities, spins, and what they are. */
#ifndef GG_H5_PARTICLES_H
#define GG_H5_PARTICLES_H

#include "files/h5/hdf5_writer.h"
#include "run/result.h"

typedef struct gg_h5_particles {
  bool started, boxed;
  bool single;       /* positions, velocities and spins as float; set before the first frame */
  unsigned left_out; /* GG_FIELDS_... that are not stored; likewise */
  size_t n;
  uint64_t last_step;
  gg_h5_rows step, time, edges, position, velocity, spin, image;
} gg_h5_particles;

/* Store one frame more; the first one lays out the groups. */
void gg_h5_particles_append(gg_h5 *h, gg_h5_particles *p, const gg_model *model, const gg_frame *frame);
/* Remove the frames up to this step. */
void gg_h5_particles_drop(gg_h5 *h, gg_h5_particles *p, uint64_t step);
void gg_h5_particles_close(gg_h5 *h, gg_h5_particles *p);

#endif
