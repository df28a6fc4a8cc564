/* Collision rates and free paths of Maxwellian gases, by pairs of species. */
#ifndef GG_COLLISION_RATE_H
#define GG_COLLISION_RATE_H

#include "theory/theory.h"

/* Collisions with grains of species j that one grain of species i has per unit time, at partial temperatures T. */
double gg_theory_pair_collision_rate(const gg_model *model, int i, int j, const double T[]);

/* Mean peculiar speed of species i, and its mean free path. */
double gg_theory_mean_speed(const gg_model *model, int i, const double T[]);
double gg_theory_mean_free_path(const gg_model *model, int i, const double T[]);

#endif
