/* Peculiar velocities in walled flows, where no profile is imposed: the flow velocity is the mean over slabs across y
 * of this very instant, and what observables are given is c - u(y). Subtracting a slab's own mean takes 1/n_c of the
 * variance of its n_c grains away; velocities are scaled by sqrt(n_c/(n_c - 1)) to give it back. Spins likewise: grains
 * roll with the flow, at another rate in each slab (one for all species), and that is no heat. */
#ifndef GG_LOCAL_FRAME_H
#define GG_LOCAL_FRAME_H

#include "measure/grain_snapshot.h"

enum { GG_MAX_SLABS = 128 };

typedef struct gg_local_frame {
  int n_slabs;
  double bottom, inverse_width;
  double count[GG_MAX_SLABS], mean[GG_MAX_SLABS][3], stretch[GG_MAX_SLABS];
  double spin[GG_MAX_SLABS][3];     /* mean angular velocity */
  double radius[GG_MAX_SPECIES];    /* a spin is that of the surface: radius times angular velocity */
  double first[GG_MAX_SLABS];       /* grains of species 1 */
  double temperature[GG_MAX_SLABS]; /* <C.C>/3 about that mean, what it takes away given back */
} gg_local_frame;

/* Measure the mean velocity and spin of every slab now. */
void gg_measure_local_frame_take(gg_local_frame *frame, const gg_model *model, gg_engine *engine);

void gg_measure_local_frame_of_snapshot(gg_local_frame *frame, const gg_snapshot *snapshot);
gg_vec gg_measure_local_frame_velocity(const gg_local_frame *frame, double y, gg_vec c);
gg_vec gg_measure_local_frame_spin(const gg_local_frame *frame, double y, gg_vec s, int species);

/* Show every grain with its velocity and spin in the local frame. */
void gg_measure_local_frame_snapshot(const gg_local_frame *frame, gg_engine *engine, gg_visit *visit, void *context);

#endif
