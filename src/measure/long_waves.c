/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/long_waves.h"

#include <math.h>

/* Add the parts of a grain to slab k and to the next, by its place between their middles: whole grains in slabs
 * would mix short waves into the long ones, and a dense gas has many times as much of short waves. */
GG_INLINE void add_to_slabs(gg_wave_slab *slab, double place, double volume, const double p[3])
{
  const unsigned k = (unsigned)place;
  const double second = place - k, first = 1 - second;
  gg_wave_slab *a = &slab[k % GG_WAVE_SLABS], *b = &slab[(k + 1) % GG_WAVE_SLABS];
  a->matter += first * volume, b->matter += second * volume;
  for (int i = 0; i < 3; i++) a->momentum[i] += first * p[i], b->momentum[i] += second * p[i];
}

void gg_measure_long_waves_add(gg_long_waves *w, const gg_model *m, const gg_chunk *chunk)
{
  const double scale[3] = {GG_WAVE_SLABS / m->box[0], GG_WAVE_SLABS / m->box[1], GG_WAVE_SLABS / m->box[2]};
  double volume[GG_MAX_SPECIES];
  for (int s = 0; s < m->n_species; s++) volume[s] = m->diameter[s] * m->diameter[s] * m->diameter[s];
  for (size_t i = 0; i < chunk->n; i++) {
    const int s = chunk->species ? chunk->species[i] : 0;
    double p[3];
    for (int a = 0; a < 3; a++) p[a] = m->mass[s] * chunk->c[a][i], w->squares[a] += p[a] * p[a];
    w->matter_squares += volume[s] * volume[s];
    for (int a = 0; a < 3; a++) add_to_slabs(w->slab[a], chunk->r[a][i] * scale[a], volume[s], p);
  }
}

/* S(0) = n T kappa_T of Carnahan & Starling (J. Chem. Phys. 51 (1969) 635). Waves of the solid fraction of unlike
 * spheres have nearly the same value, those of their number have not. */
static double elastic_structure(double phi)
{
  const double a = 1 - phi, b = 1 + 2 * phi;
  return a * a * a * a / (b * b + phi * phi * phi * (phi - 4));
}

/* |sum x exp(ikr)|^2 of matter and of each component of momentum. */
static void power_along(const gg_wave_slab slab[GG_WAVE_SLABS], double phase[2][GG_WAVE_SLABS], double power[4])
{
  double sum[2][4] = {{0}};
  for (int part = 0; part < 2; part++)
    for (int k = 0; k < GG_WAVE_SLABS; k++) {
      for (int b = 0; b < 3; b++) sum[part][b] += phase[part][k] * slab[k].momentum[b];
      sum[part][3] += phase[part][k] * slab[k].matter;
    }
  for (int i = 0; i < 4; i++) power[i] = sum[0][i] * sum[0][i] + sum[1][i] * sum[1][i];
}

void gg_measure_long_waves_finish(const gg_long_waves *w, const gg_model *m, double *density, double *momentum)
{
  const double each = 1.0 / (3 * GG_LONG_WAVES), matter = w->matter_squares * elastic_structure(m->phi);
  *density = *momentum = 0;
  for (int wave = 1; wave <= GG_LONG_WAVES; wave++) {
    const double angle = 2 * M_PI * wave / GG_WAVE_SLABS, shared = sin(angle / 2) / (angle / 2), kept = pow(shared, 4);
    double phase[2][GG_WAVE_SLABS], power[4];
    for (int k = 0; k < GG_WAVE_SLABS; k++) phase[0][k] = cos(angle * k), phase[1][k] = sin(angle * k);
    for (int a = 0; a < 3; a++) {
      power_along(w->slab[a], phase, power);
      *density += each * power[3] / (kept * matter);
      for (int b = 0; b < 3; b++)
        if (b != a) *momentum += each / 2 * power[b] / (kept * w->squares[b]);
    }
  }
}
