/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/simulation.h"

void gg_api_moments_add(void *moments, const gg_chunk *chunk)
{
  gg_moments *m = moments;
  for (size_t i = 0; i < chunk->n; i++) {
    int species = chunk->species ? chunk->species[i] : 0;
    const double c[3] = {chunk->c[0][i], chunk->c[1][i], chunk->c[2][i]};
    for (int a = 0; a < 3; a++) {
      for (int b = 0; b < 3; b++) m->cc[a][b] += m->model->mass[species] * c[a] * c[b];
      m->energy[species] += m->model->mass[species] * c[a] * c[a];
      if (!chunk->s[0]) continue;
      m->spin[species][a] += chunk->s[a][i];
      m->spin2[species] += chunk->s[a][i] * chunk->s[a][i];
    }
  }
}

double gg_api_moments_temperature(const gg_moments *m)
{
  return (m->cc[0][0] + m->cc[1][1] + m->cc[2][2]) / (3 * (double)m->model->n);
}

/* sum over grains of I Omega^2 = K m s^2, with surface velocities s about the mean of the species. */
static double rotation_of(const gg_moments *m, int i)
{
  const double *s = m->spin[i], n = (double)m->model->n_of[i];
  double about_mean = m->spin2[i] - (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / n;
  return m->model->inertia[i] * m->model->mass[i] * about_mean;
}

static double rotational_temperature_of(const gg_moments *m)
{
  double sum = 0;
  for (int i = 0; i < m->model->n_species; i++) sum += rotation_of(m, i);
  return sum / (3 * (double)m->model->n);
}

void gg_api_moments_state(const gg_moments *m, double unit, gg_simulation_state *state)
{
  const gg_model *model = m->model;
  const double n = (double)model->n, stress = model->density * model->stress_unit * unit * unit / n;
  state->grains = (size_t)model->n;
  state->collisions_per_grain = 2 * (double)state->collisions / n;
  state->temperature = gg_api_moments_temperature(m) * unit * unit;
  state->rotational_temperature = rotational_temperature_of(m) * unit * unit;
  for (int a = 0; a < 3; a++) state->periodic[a] = !gg_common_surface_is_closed(model, a);
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) state->kinetic_stress[a][b] = stress * m->cc[a][b];
}

gg_status gg_api_moments_species(const gg_moments *m, int species, double unit, gg_species_state *state, gg_error *err)
{
  const gg_model *model = m->model;
  if (species < 0 || species >= model->n_species)
    return gg_base_fail(err, GG_BAD_INPUT, "there is no species %d: this scene has %d, counted from 0", species,
                        model->n_species);
  const double per = unit * unit / (3 * (double)model->n_of[species]);
  *state = (gg_species_state){.grains = (size_t)model->n_of[species],
                              .diameter = model->diameter[species],
                              .mass = model->mass[species],
                              .inertia = model->inertia[species],
                              .temperature = m->energy[species] * per,
                              .rotational_temperature = rotation_of(m, species) * per};
  return GG_OK;
}
