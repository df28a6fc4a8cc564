/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thermostats in a periodic channel. Each acts for half of a step before the collisions of the step, and for the other
 * half after them: a symmetric splitting (Strang, SIAM J. Numer. Anal. 5 (1968) 506).
 *
 * Gaussian: the force m zeta c/2 on all velocities, those of the wave included, keeps the energy of the centres. Before
 * the collisions it gives half of what the step before lost, and after them what brings the energy back. White noise
 * and baths: an exact step of dc = -drag c dt + sqrt(noise) dW. The total momentum, of which noise gives some, is taken
 * off. */
#include <math.h>

#include "dsmc/walls/channel.h"

/* First c = factor c + kick, with sums over the grains; then c = scale (c - drift). */
typedef struct heating {
  gg_dsmc_channel *d;
  double factor[GG_MAX_SPECIES], size[GG_MAX_SPECIES]; /* of a kick along each axis; size 0: none */
  struct part_sums {
    gg_vec momentum;
    double mass, energy;
  } __attribute__((aligned(64))) part[GG_DSMC_CHANNEL_MOST_PARTS];
  gg_vec drift;
  double scale;
} heating;

static void kick_part(void *context, int part)
{
  heating *h = context;
  gg_dsmc_channel *d = h->d;
  const size_t end = gg_dsmc_channel_part(d, part + 1);
  gg_rng *stream = &d->now.streams.walls[part], rng = *stream;
  struct part_sums sums = {{0, 0, 0}, 0, 0};
  for (size_t i = gg_dsmc_channel_part(d, part); i < end; i++) {
    const int species = d->grains.species[i];
    const double m = d->model.mass[species];
    gg_vec c = gg_scale(h->factor[species], d->grains.at[i].c);
    if (h->size[species] > 0) c = gg_axpy(h->size[species], gg_common_rng_normal_vec(&rng), c);
    d->grains.at[i].c = c;
    sums.momentum = gg_axpy(m, c, sums.momentum);
    sums.energy += 0.5 * m * gg_dot(c, c);
    sums.mass += m;
  }
  h->part[part] = sums;
  *stream = rng;
}

static void scale_part(void *context, int part)
{
  const heating *h = context;
  const size_t end = gg_dsmc_channel_part(h->d, part + 1);
  for (size_t i = gg_dsmc_channel_part(h->d, part); i < end; i++) {
    gg_vec *c = &h->d->grains.at[i].c;
    *c = gg_scale(h->scale, gg_sub(*c, h->drift));
  }
}

static void for_parts(heating *h, void (*act)(void *context, int part))
{
  gg_base_thread_pool_for(h->d->callback ? NULL : h->d->pool, h->d->parts, act, h);
}

/* Kick, and set the drift to take off. Returns the energy that is left without it. */
static double kick(heating *h)
{
  for_parts(h, kick_part);
  struct part_sums all = h->part[0];
  for (int part = 1; part < h->d->parts; part++) {
    all.momentum = gg_add(all.momentum, h->part[part].momentum);
    all.energy += h->part[part].energy, all.mass += h->part[part].mass;
  }
  h->drift = gg_scale(1 / all.mass, all.momentum);
  return all.energy - 0.5 * gg_dot(all.momentum, h->drift);
}

bool gg_dsmc_channel_is_heated(const gg_model *m)
{
  return gg_common_heat_of(m) != GG_UNHEATED;
}

/* White noise or a bath for a time. */
static void bathe(gg_dsmc_channel *d, double dt)
{
  const gg_bath *b = &d->model.bath;
  const double noise = gg_common_thermostat_kicks(&d->model);
  heating h = {.d = d, .scale = 1};
  for (int i = 0; i < d->model.n_species; i++) {
    const gg_relaxation r = gg_common_relaxation(b->drag[i], dt); /* 0 without a bath */
    h.factor[i] = r.decay, h.size[i] = sqrt((b->on ? b->noise[i] : noise) * r.spread);
  }
  kick(&h);
  for_parts(&h, scale_part);
}

void gg_dsmc_channel_heat_before(gg_dsmc_channel *d, double dt)
{
  if (!gg_common_keeps_energy(&d->model)) {
    bathe(d, 0.5 * dt);
    return;
  }
  heating h = {.d = d, .scale = sqrt(1 + 0.5 * dt * d->loss_rate / d->kept)};
  for_parts(&h, scale_part);
}

void gg_dsmc_channel_heat_after(gg_dsmc_channel *d, double dt)
{
  if (!gg_common_keeps_energy(&d->model)) {
    bathe(d, 0.5 * dt);
    return;
  }
  heating h = {.d = d};
  for (int i = 0; i < d->model.n_species; i++) h.factor[i] = 1;
  const double energy = kick(&h);
  h.scale = sqrt(d->kept / energy);
  d->loss_rate = fmax((d->kept - energy) / dt + 0.5 * d->loss_rate, 0);
  for_parts(&h, scale_part);
}
