/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free flight on parabolas from wall to wall. */
#include <math.h>
#include <string.h>

#include "common/surface/collide.h"
#include "common/surface/shapes.h"
#include "dsmc/walls/channel.h"

/* Shortest time between contacts with a wall under gravity, as a fraction of a step. A grain at rest on a wall would
 * touch it infinitely often, so a forced rebound lets it leave fast enough to come back after this time. */
#define SHORTEST_HOP (1. / 64)

static void move(const gg_dsmc_channel *d, gg_dsmc_channel_grain *p, double dt)
{
  const gg_vec g = d->gravity;
  p->r.y += dt * (p->c.y + 0.5 * dt * g.y);
  p->c = gg_axpy(dt, g, p->c);
  p->s.z += d->model.torque[p->species] * dt;
}

static void show(const gg_dsmc_channel *d, int w, gg_vec k, gg_vec J, const gg_dsmc_channel_grain *before,
                 const gg_dsmc_channel_grain *p, uint32_t id)
{
  const gg_surface *surface = &d->model.surface[w];
  const double middle = 0.5 * d->model.box[1];
  const gg_collision_record m = {.id = {id, -1},
                                 .species = {p->species},
                                 .k = k,
                                 .c12 = gg_sub(before->c, surface->velocity),
                                 .c = {before->c, surface->velocity},
                                 .s = {before->s},
                                 .turn = {gg_sub(p->s, before->s)},
                                 .height = {p->r.y - middle, surface->place - middle},
                                 .wall = w + 1,
                                 .J = J,
                                 .time = d->now.time,
                                 .since = {INFINITY, INFINITY}};
  d->callback(d->callback_context, &m);
}

static void touch(const gg_dsmc_channel *d, int w, gg_rng *rng, gg_dsmc_channel_grain *p, gg_dsmc_channel_contacts *all)
{
  const gg_surface *surface = &d->model.surface[w];
  const gg_contact *contact = &surface->contact[p->species];
  const gg_vec k = gg_surface_normal(surface, &p->r);
  const gg_dsmc_channel_grain before = *p;
  gg_surface_hit hit = gg_surface_collide(d->wall_rule, surface, contact, rng, k, &p->c, &p->s);
  const double pull = gg_dot(k, d->gravity), least = pull > 0 ? 0.5 * pull * d->now.step * SHORTEST_HOP : 0;
  const double towards = gg_dot(k, p->c);
  if (!hit.thermal && -towards < least) {
    hit.J = gg_axpy((least + towards) / contact->im1, k, hit.J);
    p->c = gg_axpy(-least - towards, k, p->c);
    all->forced_rebounds++;
  }
  p->r.y = surface->side > 0 ? d->high[p->species] : d->low[p->species];
  p->touched = true;
  if (all->shown) show(d, w, k, hit.J, &before, p, all->id);
  gg_surface_sums *t = &all->surface[w];
  t->collisions++;
  for (int a = 0; a < 3; a++) t->impulse[a] += gg_along(&hit.J, a);
  t->loss += gg_surface_heat(contact, k, &hit);
}

/* Index of the wall that a grain touches first, after *delay; -1: none. */
static int next_wall(const gg_dsmc_channel *d, const gg_dsmc_channel_grain *p, double *delay)
{
  const gg_flight flight = {&p->r, &p->c, &d->gravity, d->radius[p->species]};
  const gg_region anywhere = {{0}, {0}}; /* planes do not use it */
  int first = -1;
  *delay = INFINITY;
  for (int w = 0; w < d->model.n_surfaces; w++) {
    double t = gg_surface_delay(&d->model.surface[w], &flight, &anywhere);
    if (t < *delay) *delay = t, first = w;
  }
  return first;
}

/* Range of heights: a flight that begins and ends in it touches no wall. A parabola deviates from its chord by at most
 * g dt^2/8. */
typedef struct inside {
  double low, high;
  bool falls;
} inside;

GG_INLINE inside inside_of(const gg_dsmc_channel *d, int species, double dt)
{
  const double bend = 0.125 * fabs(d->gravity.y) * dt * dt;
  return (inside){d->low[species] + bend, d->high[species] - bend, bend > 0};
}

GG_INLINE bool stays(inside at, double y, double end)
{
  return end > at.low && end < at.high && (!at.falls || (y > at.low && y < at.high));
}

void gg_dsmc_channel_fly_grain(const gg_dsmc_channel *d, double dt, gg_rng *rng, gg_dsmc_channel_grain *p,
                               gg_dsmc_channel_contacts *all)
{
  double delay;
  while (!stays(inside_of(d, p->species, dt), p->r.y, p->r.y + dt * (p->c.y + 0.5 * dt * d->gravity.y))) {
    const int w = next_wall(d, p, &delay);
    if (w < 0 || delay >= dt) break;
    move(d, p, delay);
    touch(d, w, rng, p, all);
    dt -= delay;
  }
  move(d, p, dt);
  if (d->periodic) p->r.y = gg_dsmc_channel_wrap(d, p->r.y);
}

static void fly_to_walls(gg_dsmc_channel *d, size_t i, double dt, gg_rng *rng, gg_dsmc_channel_contacts *all)
{
  gg_dsmc_channel_grains *g = &d->grains;
  gg_dsmc_channel_motion *at = &g->at[i];
  gg_dsmc_channel_grain p = {.r = {0, at->y, 0}, .c = at->c, .species = g->species[i]};
  if (g->s) p.s = g->s[i];
  all->id = g->id[i];
  gg_dsmc_channel_fly_grain(d, dt, rng, &p, all);
  at->y = fmin(fmax(p.r.y, d->low[p.species]), d->high[p.species]);
  at->c = p.c;
  if (g->s) g->s[i] = p.s;
  if (p.touched && g->last) g->last[i] = d->now.time;
}

/* Copies of pointers and constants that the compiler keeps in registers: stores cannot change them. */
typedef struct counting {
  uint32_t *next;  /* number of grains by cell */
  uint32_t *place; /* cell of each grain */
  double from, inverse, last;
} counting;

GG_INLINE void fly(gg_dsmc_channel *d, int part, double dt, bool mixture, bool falls, bool turns, gg_rng *rng,
                   gg_dsmc_channel_contacts *all)
{
  const gg_dsmc_channel_cells *c = &d->cells;
  const counting to = {c->next + (size_t)part * c->stride, d->place, c->from, c->inverse, c->n - 0.5};
  const gg_vec g = d->gravity, dc = gg_scale(dt, g);
  const double lift = 0.5 * dt * dt * g.y;
  const size_t end_of_part = gg_dsmc_channel_part(d, part + 1);
  gg_dsmc_channel_motion *grains = d->grains.at;
  inside in = inside_of(d, 0, dt);
  if (!falls) in.falls = false;
  memset(to.next, 0, c->stride * sizeof *to.next);
  for (size_t i = gg_dsmc_channel_part(d, part); i < end_of_part; i++) {
    gg_dsmc_channel_motion *at = &grains[i];
    if (mixture) in = inside_of(d, d->grains.species[i], dt);
    const double end = at->y + (at->c.y * dt + lift);
    if (__builtin_expect(stays(in, at->y, end), 1)) {
      at->y = end;
      if (falls) at->c = gg_add(at->c, dc);
      if (turns) d->grains.s[i].z += d->model.torque[d->grains.species[i]] * dt;
    } else
      fly_to_walls(d, i, dt, rng, all);
    const double cell = (at->y - to.from) * to.inverse;
    uint32_t bin = (uint32_t)(int)(cell < to.last ? cell : to.last);
    if (mixture) bin = bin * (uint32_t)d->model.n_species + d->grains.species[i];
    to.place[i] = bin;
    to.next[bin]++;
  }
}

typedef struct flight {
  gg_dsmc_channel *d;
  double dt;
  gg_dsmc_channel_contacts all[GG_DSMC_CHANNEL_MOST_PARTS];
} flight;

static void fly_part(void *context, int part)
{
  flight *f = context;
  gg_dsmc_channel *d = f->d;
  const bool mixture = d->model.n_species > 1, falls = gg_dot(d->gravity, d->gravity) > 0;
  gg_rng *stream = &d->now.streams.walls[part], rng = *stream;
  if (mixture || falls || d->model.turns)
    fly(d, part, f->dt, mixture, falls, d->model.turns, &rng, &f->all[part]);
  else
    fly(d, part, f->dt, false, false, false, &rng, &f->all[part]);
  *stream = rng;
}

static void add_contacts(gg_dsmc_channel *d, const gg_dsmc_channel_contacts *all)
{
  d->now.forced_rebounds += all->forced_rebounds;
  for (int w = 0; w < d->model.n_surfaces; w++) {
    gg_surface_sums *t = &d->now.transfer.surface[w];
    t->collisions += all->surface[w].collisions;
    t->loss += all->surface[w].loss;
    for (int a = 0; a < 3; a++) t->impulse[a] += all->surface[w].impulse[a];
  }
}

void gg_dsmc_channel_fly(gg_dsmc_channel *d, double dt)
{
  flight f = {.d = d, .dt = dt};
  for (int part = 0; part < d->parts; part++) f.all[part].shown = d->callback != NULL;
  gg_base_thread_pool_for(d->callback ? NULL : d->pool, d->parts, fly_part, &f);
  for (int part = 0; part < d->parts; part++) add_contacts(d, &f.all[part]);
}
