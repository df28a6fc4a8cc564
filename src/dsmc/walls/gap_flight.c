/* Free flight: parabolas, cut where they touch a wall. */
#include <math.h>

#include "common/surface/collide.h"
#include "common/surface/shapes.h"
#include "dsmc/walls/gap.h"

/* A grain that rests on a wall by gravity would touch it infinitely often. It leaves so fast that it comes back no
 * sooner than after this share of a step. */
#define SHORTEST_HOP (1. / 64)

static void move(gg_dsmc_gap_grain *p, gg_vec g, double dt)
{
  p->r.y += dt * (p->c.y + 0.5 * dt * g.y);
  p->c = gg_axpy(dt, g, p->c);
}

static void touch(const gg_dsmc_gap *d, int w, gg_rng *rng, gg_dsmc_gap_grain *p, gg_dsmc_gap_contacts *all)
{
  const gg_surface *surface = &d->model.surface[w];
  const gg_contact *contact = &surface->contact[p->species];
  const gg_vec k = gg_surface_normal(surface, &p->r);
  gg_surface_hit hit = gg_surface_collide(d->wall_rule, surface, contact, rng, k, &p->c, &p->s);
  const double pull = gg_dot(k, d->gravity), least = pull > 0 ? 0.5 * pull * d->now.step * SHORTEST_HOP : 0;
  const double towards = gg_dot(k, p->c);
  if (!hit.thermal && -towards < least) {
    hit.J = gg_axpy((least + towards) / contact->im1, k, hit.J);
    p->c = gg_axpy(-least - towards, k, p->c);
    all->rests++;
  }
  p->r.y = surface->side > 0 ? d->high[p->species] : d->low[p->species];
  p->touched = true;
  gg_surface_sums *t = &all->surface[w];
  t->collisions++;
  for (int a = 0; a < 3; a++) t->impulse[a] += gg_along(&hit.J, a);
  t->loss += gg_surface_heat(contact, k, &hit);
}

/* The wall that it touches first, and when; -1: none. */
static int next_wall(const gg_dsmc_gap *d, const gg_dsmc_gap_grain *p, double *delay)
{
  const gg_flight flight = {&p->r, &p->c, &d->gravity, d->radius[p->species]};
  const gg_region anywhere = {{0}, {0}}; /* planes have no need of it */
  int first = -1;
  *delay = INFINITY;
  for (int w = 0; w < d->model.n_surfaces; w++) {
    double t = gg_surface_delay(&d->model.surface[w], &flight, &anywhere);
    if (t < *delay) *delay = t, first = w;
  }
  return first;
}

void gg_dsmc_gap_fly_grain(const gg_dsmc_gap *d, double dt, gg_rng *rng, gg_dsmc_gap_grain *p,
                           gg_dsmc_gap_contacts *all)
{
  double delay;
  for (int w; (w = next_wall(d, p, &delay)) >= 0 && delay < dt; dt -= delay) {
    move(p, d->gravity, delay);
    touch(d, w, rng, p, all);
  }
  move(p, d->gravity, dt);
}

static void fly_to_walls(gg_dsmc_gap *d, size_t i, double dt, gg_dsmc_gap_contacts *all)
{
  gg_dsmc_gap_grains *g = &d->grains;
  gg_dsmc_gap_grain p = {
      .r = {0, g->x[GG_GAP_Y][i], 0}, .c = gg_dsmc_gap_get(g, GG_GAP_C, i), .species = g->species[i]};
  const bool spins = gg_dsmc_gap_has_spins(d);
  if (spins) p.s = gg_dsmc_gap_get(g, GG_GAP_S, i);
  gg_dsmc_gap_fly_grain(d, dt, &d->now.rng, &p, all);
  g->x[GG_GAP_Y][i] = fmin(fmax(p.r.y, d->low[p.species]), d->high[p.species]);
  gg_dsmc_gap_set(g, GG_GAP_C, i, p.c);
  if (spins) gg_dsmc_gap_set(g, GG_GAP_S, i, p.s);
  if (p.touched && g->x[GG_GAP_LAST]) g->x[GG_GAP_LAST][i] = d->now.time;
}

void gg_dsmc_gap_fly(gg_dsmc_gap *d, double dt)
{
  gg_dsmc_gap_contacts all = {0};
  const gg_vec g = d->gravity;
  const double fall = 0.5 * fabs(g.y) * dt * dt;
  double *y = d->grains.x[GG_GAP_Y],
         *c[3] = {d->grains.x[GG_GAP_C], d->grains.x[GG_GAP_C + 1], d->grains.x[GG_GAP_C + 2]};
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    const int k = d->grains.species[i];
    const double far = fabs(c[1][i]) * dt + fall;
    if (!(y[i] - far > d->low[k] && y[i] + far < d->high[k])) {
      fly_to_walls(d, i, dt, &all);
      continue;
    }
    y[i] += dt * (c[1][i] + 0.5 * dt * g.y);
    c[0][i] += dt * g.x, c[1][i] += dt * g.y, c[2][i] += dt * g.z;
  }
  d->now.rests += all.rests;
  for (int w = 0; w < d->model.n_surfaces; w++) {
    gg_surface_sums *t = &d->now.transfer.surface[w];
    t->collisions += all.surface[w].collisions;
    if (!d->now.keeps_sums) continue;
    t->loss += all.surface[w].loss;
    for (int a = 0; a < 3; a++) t->impulse[a] += all.surface[w].impulse[a];
  }
}
