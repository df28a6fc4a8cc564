/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Channels of a rheology sample. In free cooling they are scaled by the temperature at the instant (moments) or over
 * the interval (rates), so that the scaled state is steady; else plain model units. */
#ifndef GG_RHEOLOGY_H
#define GG_RHEOLOGY_H

#include "measure/observable.h"

enum {
  /* of the interval */
  CH_RATE,  /* collisions per grain and time; each counts for both partners */
  CH_LOSS,  /* energy lost per volume and time, in stress units per time */
  CH_GIVEN, /* the same, given by kicks */
  CH_ZETA,  /* free cooling: zeta*, from the fall of T over the interval */
  CH_LN_T,  /* ln T of the sample, in units of the start, corrected for rescaled velocities */
  CH_PC_XX,
  CH_PC_YY,
  CH_PC_ZZ,
  CH_PC_XY,
  CH_PC_YX,     /* collisional stress, stress units */
  CH_T2,        /* square of the temperature of the sample */
  CH_GROWTH,    /* of the energy of all grains, dE/dt, per volume; with drag see put_drag in rheology.c */
  CH_WALL_LOSS, /* as CH_LOSS, in contacts with walls */
  CH_WALL_DRAG, /* force along the walls, in the direction in which they move or resist, and across: sums over walls,
                   per volume */
  CH_WALL_PUSH,
  CH_WALL_HEAT, /* upwards through the gap: taken by the upper wall and given by the lower, mean of both, per area */
  CH_WALL_WORK, /* of moving walls and of gravity between walls, per volume and time; about cells: of the shear on the
                   kinetic stress of the grains in the laboratory */
  CH_DENSITY_WAVES, /* of the latest sample that took positions */
  CH_MOMENTUM_WAVES,
  CH_SPECIES /* first moment of species 1; those of species 2 follow */
};
enum {
  CH_C2X,
  CH_C2Y,
  CH_C2Z,
  CH_CXY,
  CH_C4X,
  CH_C4Y,
  CH_C4Z,
  CH_CCCC,
  CH_SPEED,
  CH_SMOOTH_WIDTH, /* number of channels of smooth grains */
  CH_SPIN_Z = CH_SMOOTH_WIDTH,
  CH_W2X,
  CH_W2Y,
  CH_W2Z,
  CH_W4X,
  CH_W4Y,
  CH_W4Z,
  CH_W3Z,
  CH_COS2,
  CH_A11, /* 1 + a11 and 1/3 + b, over the second moments of the same instant */
  CH_B,
  CH_ROUGH_WIDTH
};

static inline size_t gg_rheology_species_width(const gg_model *m)
{
  return m->rule == GG_SMOOTH ? CH_SMOOTH_WIDTH : CH_ROUGH_WIDTH;
}

/* Motion of a species that drag brakes: partial temperature, <s^2> and mean spin; of a row, or of means of rows. */
typedef struct gg_dragged {
  double temperature, spin_squared, mean_spin;
} gg_dragged;
gg_dragged gg_measure_rheology_dragged(const double *row, const gg_model *m, int species);
/* Power of drag on all species, per volume. */
double gg_measure_rheology_drag(const gg_dragged *of_species, const gg_model *m);

extern const gg_derived gg_measure_rheology_derived[];
extern const gg_derived gg_measure_rheology_history[];

#endif
