/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peculiar velocities in walled flows, where no profile is imposed. The flow velocity u(y) is a straight line in
 * each slab across y, fitted to the velocities of all samples of the averaging window so far. A mean alone would
 * leave the shear within a slab in the temperature; a fit to one instant would take away more than the noise of the
 * slab's few grains, since neighbours move together. Observables get c - u(y). A line takes 2/n of the variance of
 * its n velocities away; residuals are scaled by sqrt(n/(n - 2)) to restore it. Spins likewise: grains roll with the
 * flow, at another rate at each height (one for all species), and that is no heat. */
#ifndef GG_LOCAL_FRAME_H
#define GG_LOCAL_FRAME_H

#include "measure/grain_snapshot.h"

enum { GG_MAX_SLABS = 128 };

/* Sums over the grains in a slab; heights are from its middle, in its thickness; spins are angular velocities. */
typedef struct gg_slab {
  double grains, first; /* of all species, of the first */
  double height, height_square;
  double velocity[3], moment[3], square; /* c, height times c, c squared */
  double spin[3], spin_moment[3];
} gg_slab;

typedef struct gg_slabs {
  int n;
  double inverse_thickness, radius[GG_MAX_SPECIES]; /* a spin is a surface velocity: radius times angular velocity */
  gg_slab slab[GG_MAX_SLABS];
} gg_slabs;

typedef struct gg_line {
  double mean[3], slope[3]; /* at the mean height; per thickness */
} gg_line;

typedef struct gg_local_frame {
  int n;
  double inverse_thickness, radius[GG_MAX_SPECIES];
  double centre[GG_MAX_SLABS],
      stretch[GG_MAX_SLABS]; /* mean height; factor that restores the variance taken by the fit */
  gg_line flow[GG_MAX_SLABS], rolling[GG_MAX_SLABS];
} gg_local_frame;

/* Slabs without grains. */
void gg_measure_slabs_init(gg_slabs *slabs, const gg_model *model);
bool gg_measure_slabs_are_empty(const gg_slabs *slabs);
/* Set the sums from the present state of the engine. */
void gg_measure_slabs_take(gg_slabs *slabs, const gg_model *model, gg_engine *engine);
void gg_measure_slabs_of_snapshot(gg_slabs *slabs, const gg_snapshot *snapshot);
/* Add the sums of another instant. */
void gg_measure_slabs_add(gg_slabs *slabs, const gg_slabs *more);
/* <C.C>/3 about the slab's own line. */
double gg_measure_slab_temperature(const gg_slab *slab);

void gg_measure_local_frame_make(gg_local_frame *frame, const gg_slabs *slabs);
/* The frame of a flow whose sums these are: where walls are alike, of the mean of it and its image. A window's own flow
 * has the drift of all the gas along the walls in it, which dies out more slowly than anything: velocities about that
 * flow would have a mean square of their own in each run. */
void gg_measure_local_frame_of_flow(gg_local_frame *frame, const gg_model *model, const gg_slabs *slabs);
gg_vec gg_measure_local_frame_velocity(const gg_local_frame *frame, double y, gg_vec c);
gg_vec gg_measure_local_frame_spin(const gg_local_frame *frame, double y, gg_vec s, int species);
/* The flow velocity u(y). */
gg_vec gg_measure_local_frame_flow(const gg_local_frame *frame, double y);

/* Visit every grain with its velocity and spin in the local frame. */
void gg_measure_local_frame_snapshot(const gg_local_frame *frame, gg_engine *engine, gg_visit *visit, void *context);

#endif
