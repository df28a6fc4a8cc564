/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A simulation step by step: an engine, and what its clock and units need outside of it. */
#ifndef GG_API_SIMULATION_H
#define GG_API_SIMULATION_H

#include <stdatomic.h>

#include "api/api.h"
#include "base/busy.h"
#include "common/engine.h"

/* Free cooling extends over decades: as runs do, the engine's velocities are brought back by exact powers of two, and
 * what is handed out is in the units of the start. */
struct gg_simulation {
  gg_scene scene; /* finished */
  gg_model model;
  gg_engine *engine;
  struct gg_simulation_clock { /* plain data: saved as bytes */
    double time;               /* since the start, in units of the start */
    int64_t power;             /* the engine's velocities are 2^power times those of the start */
    gg_simulation_sums sums;   /* what was taken from the engine before its last rescaling; stress and energy as sums */
  } clock;
  struct {
    double strain, until; /* time of the last change of the shear rate, and strain up to it */
  } strained;
  gg_busy busy;
  gg_on_collision *callback; /* NULL: none */
  void *context;
  bool observed; /* the engine shows its collisions; settled after a stretch */
  struct {
    char *events; /* gg_collision_event, `size` bytes each as the caller knows them; NULL: none */
    size_t size, capacity, *n;
  } record;
  int (*asks)(void *context); /* whether to stop; NULL: never */
  atomic_bool stopped;        /* it did, of the present work */
  void *asks_context;
  gg_stop stop;        /* what the model's points to */
  double stretch_from; /* the engine's time at the start of the stretch that clock.time is the start of */
};

/* Queries (simulation_state.c). Velocities of the start over those of the engine. */
double gg_api_simulation_unit(const gg_simulation *s);
/* T of the engine's grains, in the engine's units. */
double gg_api_simulation_temperature(const gg_simulation *s);
/* Strain up to now. */
double gg_api_simulation_strain(const gg_simulation *s);
/* Take the engine's sums over collisions into the clock's. */
void gg_api_simulation_collect(gg_simulation *s);

/* An empty one for a scene, without an engine yet; `stop` (NULL: never) is asked from here on. */
gg_status gg_api_simulation_prepare(const gg_scene *scene, int (*stop)(void *context), void *context,
                                    gg_simulation **simulation, gg_error *err);
/* Once its engine is made, which ended with this status: *simulation is the new one, or it is freed. */
gg_status gg_api_simulation_started(gg_simulation *s, gg_status status, gg_simulation **simulation, gg_error *err);

/* simulation.c: one with the scene, model and clock of another, without engine and callbacks; NULL: out of memory. */
gg_simulation *gg_api_simulation_like(const gg_simulation *other, gg_error *err);
/* Show the collisions of an engine that is to take the place of the simulation's, as the present one does. */
gg_status gg_api_simulation_watch(gg_simulation *s, gg_engine *engine, gg_error *err);
/* After a start: what asked to stop it was of that alone. */
void gg_api_simulation_forget_stop(gg_simulation *s);
/* Before work that may be stopped: GG_INTERRUPTED where it is to stop already. */
gg_status gg_api_simulation_check_stop(gg_simulation *s, gg_error *err);
/* simulation_grains.c: continue with another engine, of this model; with these grains; members that are NULL stay.
 * On failure nothing changes. */
gg_status gg_api_simulation_continue(gg_simulation *s, const gg_model *model, const gg_grains *grains, gg_error *err);

/* moments.c: moments of a state of the grains, from an engine or a file. */

/* Sums over grains, mass by mass; zero but for the model to begin with. */
typedef struct gg_moments {
  const gg_model *model;
  double cc[3][3], energy[GG_MAX_SPECIES];               /* m C C; m C.C */
  double spin[GG_MAX_SPECIES][3], spin2[GG_MAX_SPECIES]; /* of surface velocities */
} gg_moments;

/* A gg_visit. */
void gg_api_moments_add(void *moments, const gg_chunk *chunk);
double gg_api_moments_temperature(const gg_moments *m);
/* Where time and collisions are filled in: temperatures, stress, and the collisions a grain. `unit`: velocities
 * handed out over those that were added. */
void gg_api_moments_state(const gg_moments *m, double unit, gg_simulation_state *state);
/* GG_BAD_INPUT: there are not so many. */
gg_status gg_api_moments_species(const gg_moments *m, int species, double unit, gg_species_state *state, gg_error *err);

#endif
