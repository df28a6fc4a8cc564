/* What a state of the grains tells of itself, whether an engine has them or a file. */
#ifndef GG_API_MOMENTS_H
#define GG_API_MOMENTS_H

#include "api/api.h"
#include "common/engine.h"

/* Sums over grains, mass by mass; zero but for the model to begin with. */
typedef struct gg_moments {
  const gg_model *model;
  double cc[3][3], energy[GG_MAX_SPECIES];               /* m C C; m C.C */
  double spin[GG_MAX_SPECIES][3], spin2[GG_MAX_SPECIES]; /* of surface velocities */
} gg_moments;

/* A gg_visit. */
void gg_api_moments_add(void *moments, const gg_chunk *chunk);
double gg_api_moments_temperature(const gg_moments *m);
/* Where time and collisions are filled in: temperatures, stress, strain, and the collisions a grain. `unit`: velocities
 * handed out over those that were added. */
void gg_api_moments_state(const gg_moments *m, double unit, gg_simulation_state *state);
/* GG_BAD_INPUT: there are not so many. */
gg_status gg_api_moments_species(const gg_moments *m, int species, double unit, gg_species_state *state, gg_error *err);

#endif
