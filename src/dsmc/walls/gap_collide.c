/* The collisions of a step, as the textbooks have them: one candidate after another.
 *
 * Of a grain i at y the candidates have k uniform on the sphere, and a partner j that is any grain of the cell at
 * y + sigma k_y; N are there, of its species. Enskog's collision rate is that of candidates, times sigma^2 chi g_n N
 * per volume of a cell and 4 pi; every collision has two sides, so that candidates of each grain have half of it. A
 * grain beyond the walls is nobody's partner: no cell is there. */
#include <math.h>

#include "dsmc/walls/gap.h"

/* What candidates of two species in a cell have in common. */
typedef struct pass {
  int cell, one, two, pair;
  double reach, floor, majorant, largest;
  uint64_t candidates;
  const double *chi; /* to the cells */
} pass;

static gg_contact contact_of(const gg_dsmc_gap *d, const pass *p, double gn)
{
  gg_contact c = d->model.contact[p->one][p->two];
  const gg_restitution_law *law = &d->model.law;
  if (!law->name) return c;
  const double e =
      law->e ? gg_common_law_at(law, gn, p->one, p->two) : 1 - gg_loss_at(d->losses->loss, law->scale[p->pair] * gn);
  c.jn = (1 + e) / gg_inverse_mr(&c);
  return c;
}

static void call_back(gg_dsmc_gap *d, const uint32_t i[2], gg_vec k, const gg_vec c[2], gg_vec J)
{
  gg_dsmc_gap_grains *g = &d->grains;
  gg_collision_record m = {.k = k, .c12 = gg_sub(c[0], c[1]), .J = J, .time = d->now.time};
  for (int w = 0; w < 2; w++) {
    m.id[w] = g->id[i[w]];
    m.species[w] = g->species[i[w]];
    m.c[w] = c[w];
    m.height[w] = g->x[GG_GAP_Y][i[w]] - 0.5 * d->model.box[1];
    m.since[w] = d->now.time - g->x[GG_GAP_LAST][i[w]];
    g->x[GG_GAP_LAST][i[w]] = d->now.time;
  }
  d->callback(d->callback_context, &m);
}

static void collide(gg_dsmc_gap *d, const pass *p, uint32_t i, uint32_t j, gg_vec k)
{
  gg_dsmc_gap_grains *g = &d->grains;
  const gg_rule rule = d->model.rule;
  const gg_vec before[2] = {gg_dsmc_gap_get(g, GG_GAP_C, i), gg_dsmc_gap_get(g, GG_GAP_C, j)};
  gg_vec c1 = before[0], c2 = before[1], s1 = {0, 0, 0}, s2 = s1;
  if (rule != GG_SMOOTH) s1 = gg_dsmc_gap_get(g, GG_GAP_S, i), s2 = gg_dsmc_gap_get(g, GG_GAP_S, j);
  const gg_vec v = gg_contact_velocity(rule, k, gg_sub(c1, c2), s1, s2);
  const double gn = gg_dot(k, v);
  const gg_contact contact = contact_of(d, p, gn);
  const gg_vec J = gg_impulse(rule, &contact, k, v, gn);
  gg_kick(rule, &contact, k, J, &c1, &s1, &c2, &s2);
  if (d->callback) call_back(d, (const uint32_t[]){i, j}, k, before, J);
  gg_dsmc_gap_set(g, GG_GAP_C, i, c1);
  gg_dsmc_gap_set(g, GG_GAP_C, j, c2);
  if (rule != GG_SMOOTH) gg_dsmc_gap_set(g, GG_GAP_S, i, s1), gg_dsmc_gap_set(g, GG_GAP_S, j, s2);
  gg_collision_sums *t = &d->now.transfer;
  d->now.collisions++;
  t->collisions[p->pair]++;
  if (!d->now.keeps_sums) return;
  if (!d->model.boltzmann) gg_add_stress(t->stress[p->pair], d->model.sigma[p->pair], k, J);
  t->loss[p->pair] += gg_energy_loss(&contact, k, v, J);
}

/* One candidate: its partner, and whether they collide. */
static void try(gg_dsmc_gap *d, pass *p, uint32_t i)
{
  gg_dsmc_gap_cells *c = &d->cells;
  const gg_vec k = gg_rng_direction(&d->now.rng);
  const double at = (d->grains.x[GG_GAP_Y][i] + p->reach * k.y - c->from) * c->inverse, u = gg_rng_uniform(&d->now.rng);
  if (!(at >= 0 && at < c->n)) return;
  const int b = (int)at, there = b * d->model.n_species + p->two;
  const uint32_t n = c->start[there + 1] - c->start[there];
  if (n == 0) return;
  const uint32_t j = c->start[there] + gg_rng_below(&d->now.rng, n);
  if (j == i) return;
  const gg_vec c12 = gg_sub(gg_dsmc_gap_get(&d->grains, GG_GAP_C, i), gg_dsmc_gap_get(&d->grains, GG_GAP_C, j));
  const double value = p->chi[b] * n * gg_dot(k, c12);
  if (value > p->largest) p->largest = value;
  d->now.overflows += value > p->floor + p->majorant;
  if (!(p->floor + u * p->majorant < value)) return;
  collide(d, p, i, j, k);
  c->hits[p->cell]++, c->hits[b]++;
}

enum { WINDOW = 2000 }; /* candidates after which a majorant forgets */

static void collide_species(gg_dsmc_gap *d, int cell, int one, int two, double dt)
{
  gg_dsmc_gap_cells *c = &d->cells;
  const int species = d->model.n_species, here = cell * species + one, pair = gg_pair(one, two);
  const uint32_t first = c->start[here], n = c->start[here + 1] - first;
  gg_dsmc_majorant *learned = &c->majorant[here * species + two];
  if (n == 0) return;
  const double thermal = sqrt(d->now.temperature), sigma = d->model.sigma[pair];
  const double rate = 2 * M_PI * sigma * sigma / c->volume * n * dt;
  pass p = {.cell = cell,
            .one = one,
            .two = two,
            .pair = pair,
            .reach = d->reach[pair],
            .majorant = gg_dsmc_majorant_at(learned, thermal),
            .chi = c->chi + pair * 2 * c->n + cell};
  /* After a majorant overflow: correction passes, each over the layer above. */
  for (uint64_t tried = 0; p.majorant > 0; p.floor += p.majorant, p.majorant = 1.1 * p.largest - p.floor) {
    p.candidates = (uint64_t)(rate * p.majorant + gg_rng_uniform(&d->now.rng));
    for (uint64_t k = 0; k < p.candidates; k++) try(d, &p, first + gg_rng_below(&d->now.rng, n));
    d->now.candidates += p.candidates;
    tried += p.candidates;
    if (p.largest > p.floor + p.majorant) continue;
    gg_dsmc_majorant_learn(learned, p.largest, thermal, tried, WINDOW);
    return;
  }
}

void gg_dsmc_gap_collide(gg_dsmc_gap *d, double dt)
{
  const int species = d->model.n_species, all = d->cells.n * species * species;
  const bool backward = d->now.steps % 2; /* symmetric splitting: every second step mirrors the one before */
  for (int t = 0; t < all; t++) {
    const int k = backward ? all - 1 - t : t;
    collide_species(d, k / (species * species), k / species % species, k % species, dt);
  }
}
