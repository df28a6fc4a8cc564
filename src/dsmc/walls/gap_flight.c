/* Free flight: parabolas, cut where they touch a wall. */
#include <math.h>

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

static void touch(const gg_dsmc_gap *d, int w, gg_dsmc_gap_grain *p, gg_collision_sums *sums, uint64_t *rests)
{
  const gg_surface *surface = &d->model.surface[w];
  const gg_contact *contact = &surface->contact[p->species];
  const gg_rule rule = d->wall_rule;
  gg_vec k = gg_surface_normal(surface, &p->r), none = {0, 0, 0}, still = none, wall = surface->velocity,
         *s = gg_dsmc_gap_has_spins(d) ? &p->s : &none;
  gg_vec g = gg_contact_velocity(rule, k, gg_sub(p->c, wall), *s, still);
  gg_vec J = gg_impulse(rule, contact, k, g, gg_dot(k, g));
  gg_kick(rule, contact, k, J, &p->c, s, &wall, &still);
  const double pull = gg_dot(k, d->gravity), least = pull > 0 ? 0.5 * pull * d->now.step * SHORTEST_HOP : 0;
  const double towards = gg_dot(k, p->c);
  if (-towards < least) {
    J = gg_axpy((least + towards) / contact->im1, k, J);
    p->c = gg_axpy(-least - towards, k, p->c);
    ++*rests;
  }
  p->r.y = surface->side > 0 ? d->high[p->species] : d->low[p->species];
  p->touched = true;
  gg_surface_sums *t = &sums->surface[w];
  t->collisions++;
  for (int a = 0; a < 3; a++) t->impulse[a] += gg_along(&J, a);
  t->loss += gg_energy_loss(contact, k, g, J);
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

void gg_dsmc_gap_fly_grain(const gg_dsmc_gap *d, double dt, gg_dsmc_gap_grain *p, gg_collision_sums *sums,
                           uint64_t *rests)
{
  double delay;
  for (int w; (w = next_wall(d, p, &delay)) >= 0 && delay < dt; dt -= delay) {
    move(p, d->gravity, delay);
    touch(d, w, p, sums, rests);
  }
  move(p, d->gravity, dt);
}

static void fly_to_walls(gg_dsmc_gap *d, size_t i, double dt)
{
  gg_dsmc_gap_grains *g = &d->grains;
  gg_dsmc_gap_grain p = {
      .r = {0, g->x[GG_GAP_Y][i], 0}, .c = gg_dsmc_gap_get(g, GG_GAP_C, i), .species = g->species[i]};
  const bool spins = gg_dsmc_gap_has_spins(d);
  if (spins) p.s = gg_dsmc_gap_get(g, GG_GAP_S, i);
  gg_dsmc_gap_fly_grain(d, dt, &p, &d->now.transfer, &d->now.rests);
  g->x[GG_GAP_Y][i] = fmin(fmax(p.r.y, d->low[p.species]), d->high[p.species]);
  gg_dsmc_gap_set(g, GG_GAP_C, i, p.c);
  if (spins) gg_dsmc_gap_set(g, GG_GAP_S, i, p.s);
  if (p.touched && g->x[GG_GAP_LAST]) g->x[GG_GAP_LAST][i] = d->now.time;
}

void gg_dsmc_gap_fly(gg_dsmc_gap *d, double dt)
{
  const gg_collision_sums before = d->now.transfer;
  const gg_vec g = d->gravity;
  const double fall = 0.5 * fabs(g.y) * dt * dt;
  double *y = d->grains.x[GG_GAP_Y],
         *c[3] = {d->grains.x[GG_GAP_C], d->grains.x[GG_GAP_C + 1], d->grains.x[GG_GAP_C + 2]};
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    const int k = d->grains.species[i];
    const double far = fabs(c[1][i]) * dt + fall;
    if (!(y[i] - far > d->low[k] && y[i] + far < d->high[k])) {
      fly_to_walls(d, i, dt);
      continue;
    }
    y[i] += dt * (c[1][i] + 0.5 * dt * g.y);
    c[0][i] += dt * g.x, c[1][i] += dt * g.y, c[2][i] += dt * g.z;
  }
  if (d->now.keeps_sums) return;
  for (int w = 0; w < d->model.n_surfaces; w++) { /* numbers alone */
    const uint64_t contacts = d->now.transfer.surface[w].collisions;
    d->now.transfer.surface[w] = before.surface[w];
    d->now.transfer.surface[w].collisions = contacts;
  }
}
