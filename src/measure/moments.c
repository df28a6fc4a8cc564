/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/moments.h"

void gg_measure_moments_add(void *moments, const gg_chunk *chunk)
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

double gg_measure_moments_temperature(const gg_moments *m)
{
  return (m->cc[0][0] + m->cc[1][1] + m->cc[2][2]) / (3 * (double)m->model->n);
}

double gg_measure_moments_rotation(const gg_moments *m, int i)
{
  const double *s = m->spin[i], n = (double)m->model->n_of[i];
  double about_mean = m->spin2[i] - (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / n;
  return m->model->inertia[i] * m->model->mass[i] * about_mean;
}

double gg_measure_moments_rotational_temperature(const gg_moments *m)
{
  double sum = 0;
  for (int i = 0; i < m->model->n_species; i++) sum += gg_measure_moments_rotation(m, i);
  return sum / (3 * (double)m->model->n);
}
