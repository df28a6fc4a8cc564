/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Queries of simulations: state, grains, collision sums, hash. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/simulation.h"
#include "base/memory.h"
#include "common/engine_grains.h"

double gg_api_simulation_unit(const gg_simulation *s)
{
  return ldexp(1, -(int)s->clock.power);
}

static gg_moments sum_up(const gg_simulation *s)
{
  gg_moments m = {.model = &s->model};
  s->engine->ops->snapshot(s->engine, false, gg_measure_moments_add, &m);
  return m;
}

double gg_api_simulation_temperature(const gg_simulation *s)
{
  const gg_moments m = sum_up(s);
  return gg_measure_moments_temperature(&m);
}

double gg_api_simulation_strain(const gg_simulation *s)
{
  return s->strained.strain + s->model.shear_rate * (s->clock.time - s->strained.until);
}

void gg_api_moments_state(const gg_moments *m, double unit, gg_simulation_state *state)
{
  const gg_model *model = m->model;
  const double n = (double)model->n, stress = model->density * model->stress_unit * unit * unit / n;
  state->grains = (size_t)model->n;
  state->collisions_per_grain = 2 * (double)state->collisions / n;
  state->temperature = gg_measure_moments_temperature(m) * unit * unit;
  state->rotational_temperature = gg_measure_moments_rotational_temperature(m) * unit * unit;
  for (int a = 0; a < 3; a++) state->periodic[a] = !gg_common_surface_is_closed(model, a);
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) state->kinetic_stress[a][b] = stress * m->cc[a][b];
}

gg_status gg_api_moments_species(const gg_moments *m, int species, double unit, gg_species_state *state, gg_error *err)
{
  const gg_model *model = m->model;
  if (species < 0 || species >= model->n_species)
    return GG_REFUSE(err, "there is no species %d: this scene has %d, counted from 0", species, model->n_species);
  const double per = unit * unit / (3 * (double)model->n_of[species]);
  *state = (gg_species_state){.grains = (size_t)model->n_of[species],
                              .diameter = model->diameter[species],
                              .mass = model->mass[species],
                              .inertia = model->inertia[species],
                              .temperature = m->energy[species] * per,
                              .rotational_temperature = gg_measure_moments_rotation(m, species) * per};
  return GG_OK;
}

int gg_simulation_species(const gg_simulation *simulation)
{
  return simulation ? simulation->model.n_species : 0;
}

gg_status gg_simulation_get_species(const gg_simulation *simulation, int species, gg_species_state *state,
                                    gg_error *err)
{
  GG_NEED_READING(simulation, state);
  const gg_moments m = sum_up(simulation);
  return gg_api_moments_species(&m, species, gg_api_simulation_unit(simulation), state, err);
}

gg_status gg_simulation_get_state(const gg_simulation *simulation, gg_simulation_state *state, gg_error *err)
{
  GG_NEED_READING(simulation, state);
  const gg_model *model = &simulation->model;
  const gg_moments m = sum_up(simulation);
  const gg_engine_state engine = gg_engine_state_of(simulation->engine);
  *state = (gg_simulation_state){.time = simulation->clock.time,
                                 .collisions = engine.collisions,
                                 .strain = gg_api_simulation_strain(simulation),
                                 .image_offset = engine.offset};
  gg_api_moments_state(&m, gg_api_simulation_unit(simulation), state);
  for (int a = 0; a < 3; a++) {
    state->box[a] = model->homogeneous ? 0 : model->box[a];
    state->periodic[a] &= !model->homogeneous;
  }
  return GG_OK;
}

gg_status gg_simulation_get_grains(const gg_simulation *simulation, const gg_grains *into, gg_error *err)
{
  GG_NEED_READING(simulation, into);
  const gg_model *model = &simulation->model;
  if (into->position && model->homogeneous)
    return GG_REFUSE(err, "%s is spatially homogeneous: it has no positions", simulation->engine->ops->name);
  gg_common_engine_grains_copy(simulation->engine, model, gg_api_simulation_unit(simulation), into->position,
                               into->velocity, into->spin, into->species);
  return GG_OK;
}

_Static_assert((int)GG_WALLS == (int)GG_MOST_SURFACES, "walls of the interface are the surfaces of the model");

const char *gg_simulation_wall(const gg_simulation *s, int wall)
{
  return s && wall >= 0 && wall < s->model.n_surfaces ? s->model.surface[wall].word : NULL;
}

void gg_api_simulation_collect(gg_simulation *s)
{
  gg_simulation_sums *sums = &s->clock.sums;
  double unit = gg_api_simulation_unit(s);
  gg_collision_sums t;
  s->engine->ops->take_sums(s->engine, &t);
  for (int p = 0; p < gg_pairs_of(s->model.n_species); p++) {
    sums->collisions += t.collisions[p];
    sums->dissipation += t.loss[p] * unit * unit;
    sums->injection += t.given[p] * unit * unit;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) sums->collisional_stress[a][b] += t.stress[p][a][b] * unit;
  }
  const gg_surface_sums walls = gg_sums_of_surfaces(&t);
  sums->wall_collisions += walls.collisions;
  sums->wall_loss += walls.loss;
  for (int w = 0; w < GG_WALLS; w++) {
    for (int a = 0; a < 3; a++) sums->wall_impulse[w][a] += t.surface[w].impulse[a];
    sums->wall_heat[w] += t.surface[w].loss;
  }
}

gg_status gg_simulation_take_sums(gg_simulation *simulation, gg_simulation_sums *sums, gg_error *err)
{
  GG_NEED_ALONE(simulation, sums);
  gg_api_simulation_collect(simulation);
  struct gg_simulation_clock *clock = &simulation->clock;
  *sums = clock->sums;
  sums->time = clock->time - clock->sums.time;
  double per = sums->time > 0 ? simulation->model.stress_unit / (simulation->model.volume * sums->time) : 0;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) sums->collisional_stress[a][b] *= per;
  sums->dissipation *= per, sums->injection *= per;
  clock->sums = (gg_simulation_sums){.time = clock->time}; /* time of this call */
  return GG_OK;
}

gg_status gg_simulation_hash(const gg_simulation *simulation, uint64_t *hash, gg_error *err)
{
  GG_NEED_READING(simulation, hash);
  gg_simulation_state state;
  GG_TRY(gg_simulation_get_state(simulation, &state, err));
  GG_FREED double *numbers = gg_base_array_new(9 * state.grains, sizeof *numbers, err);
  GG_FREED int *species = gg_base_array_new(state.grains, sizeof *species, err);
  if (!numbers || !species) return GG_FAILED;
  const gg_grains grains = {.position = simulation->model.homogeneous ? NULL : numbers,
                            .velocity = numbers + 3 * state.grains,
                            .spin = numbers + 6 * state.grains,
                            .species = species};
  GG_TRY(gg_simulation_get_grains(simulation, &grains, err));
  const gg_grain_arrays all = {grains.position, grains.velocity, grains.spin, grains.species};
  return *hash = gg_common_grains_hash(state.collisions, &all, state.grains), GG_OK;
}
