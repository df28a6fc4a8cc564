/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collisions of a step.
 *
 * Of a grain i at y the candidates have k uniform on the sphere, and a partner j that is any grain of the cell at
 * y + sigma k_y; N are there, of its species. Enskog's collision rate is that of candidates, times sigma^2 chi g_n N
 * per volume of a cell and 4 pi; every collision has two sides, so that candidates of each grain have half of it. A
 * grain beyond the walls is nobody's partner: no cell is there.
 *
 * A candidate is accepted if chi N g_n is above a random limit. That is decided in two stages: k_y alone says which
 * cell and who, and how large g_n can be at most; only for those who may be accepted the rest of k is drawn. The first
 * stage takes some candidates at once, and those of grains that collide meanwhile again. */
#include <math.h>

#include "dsmc/walls/gap.h"

/* What candidates of two species in a cell have in common. */
typedef struct pass {
  int cell, one, two, pair;
  double reach, floor, majorant, largest;
  uint64_t candidates;
  const double *chi;  /* to the cells */
  double begin, tick; /* time of the first candidate, and between two: those of all cells take turns in a step */
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

static void call_back(gg_dsmc_gap *d, double time, const uint32_t i[2], gg_vec k, const gg_vec c[2], gg_vec J,
                      const gg_vec s[2])
{
  gg_dsmc_gap_grains *g = &d->grains;
  gg_collision_record m = {.k = k, .c12 = gg_sub(c[0], c[1]), .J = J, .time = time};
  for (int w = 0; w < 2; w++) {
    m.id[w] = g->id[i[w]];
    m.species[w] = g->species[i[w]];
    m.c[w] = c[w];
    if (g->s) m.s[w] = g->s[i[w]], m.turn[w] = gg_sub(s[w], m.s[w]);
    m.height[w] = g->at[i[w]].y - 0.5 * d->model.box[1];
    m.since[w] = fmax(time - g->last[i[w]], 0); /* candidates of a correction go back in time */
    g->last[i[w]] = time;
  }
  d->callback(d->callback_context, &m);
}

static void collide(gg_dsmc_gap *d, const pass *p, double time, uint32_t i, uint32_t j, gg_vec k)
{
  gg_dsmc_gap_grains *g = &d->grains;
  const gg_rule rule = d->model.rule;
  const gg_vec before[2] = {g->at[i].c, g->at[j].c};
  gg_vec c1 = before[0], c2 = before[1], s1 = {0, 0, 0}, s2 = s1;
  if (rule != GG_SMOOTH) s1 = g->s[i], s2 = g->s[j];
  const gg_vec v = gg_contact_velocity(rule, k, gg_sub(c1, c2), s1, s2);
  const double gn = gg_dot(k, v);
  const gg_contact contact = contact_of(d, p, gn);
  const gg_vec J = gg_impulse(rule, &contact, k, v, gn);
  gg_kick(rule, &contact, k, J, &c1, &s1, &c2, &s2);
  if (d->callback) call_back(d, time, (const uint32_t[]){i, j}, k, before, J, (const gg_vec[]){s1, s2});
  g->at[i].c = c1, g->at[j].c = c2;
  if (rule != GG_SMOOTH) g->s[i] = s1, g->s[j] = s2;
  gg_collision_sums *t = &d->now.transfer;
  d->now.collisions++;
  t->collisions[p->pair]++;
  if (!d->now.keeps_sums) return;
  if (!d->model.boltzmann) gg_add_stress(t->stress[p->pair], d->model.sigma[p->pair], k, J);
  t->loss[p->pair] += gg_energy_loss(&contact, k, v, J);
}

/* Candidates drawn at once; who the grains are, the cell of the second, k_y, chi N, the limit. */
enum { BLOCK = 16 };
typedef struct block {
  uint32_t n, i[BLOCK], j[BLOCK], cell[BLOCK];
  double ky[BLOCK], scale[BLOCK], limit[BLOCK];
} block;

static void draw(gg_dsmc_gap *d, const pass *p, uint32_t first, uint32_t n, block *b)
{
  const gg_dsmc_gap_cells *c = &d->cells;
  for (uint32_t k = 0; k < b->n; k++) {
    const uint64_t who = gg_rng_next(&d->now.rng), how = gg_rng_next(&d->now.rng);
    b->i[k] = first + (uint32_t)((who >> 32) * n >> 32);
    b->ky[k] = (double)(how >> 32) * 0x1p-31 - (1 - 0x1p-32);
    b->limit[k] = p->floor + (double)(how & UINT32_MAX) * 0x1p-32 * p->majorant;
    const double at = (d->grains.at[b->i[k]].y + p->reach * b->ky[k] - c->from) * c->inverse;
    const bool inside = at >= 0 && at < c->n;
    const int cell = inside ? (int)at : p->cell, there = cell * d->model.n_species + p->two;
    const uint32_t begin = c->start[there], partners = inside ? c->start[there + 1] - begin : 0;
    b->j[k] = partners ? begin + (uint32_t)((who & UINT32_MAX) * partners >> 32) : b->i[k];
    b->cell[k] = (uint32_t)cell;
    b->scale[k] = p->chi[cell] * partners;
  }
}

/* Can it be accepted? For some azimuth of k: k.c12 is at most k_y c_y + sqrt(1 - k_y^2) sqrt(c_x^2 + c_z^2). */
GG_INLINE bool may_collide(const gg_dsmc_gap_motion *at, const block *b, uint32_t k)
{
  const gg_vec c = gg_sub(at[b->i[k]].c, at[b->j[k]].c);
  const double ky = b->ky[k], scale = b->scale[k], lacks = b->limit[k] - scale * (ky * c.y);
  const double across = (1 - ky * ky) * (c.x * c.x + c.z * c.z);
  return (lacks < 0) | (lacks * lacks < scale * scale * across);
}

/* The direction of this k_y: cosine and sine of twice the angle of a point in the disc. */
static gg_vec direction(double ky, gg_rng *rng)
{
  double a, b, q;
  do {
    a = 2 * gg_rng_uniform(rng) - 1;
    b = 2 * gg_rng_uniform(rng) - 1;
    q = a * a + b * b;
  } while (q >= 1 || q == 0);
  const double f = sqrt(1 - ky * ky) / q;
  return (gg_vec){f * (a * a - b * b), ky, f * (2 * a * b)};
}

/* The second stage; whether they have collided. */
static bool judge(gg_dsmc_gap *d, pass *p, const block *b, uint32_t m)
{
  const uint32_t i = b->i[m], j = b->j[m];
  const gg_vec k = direction(b->ky[m], &d->now.rng);
  const double value = b->scale[m] * gg_dot(k, gg_sub(d->grains.at[i].c, d->grains.at[j].c));
  if (value > p->largest) p->largest = value;
  d->now.overflows += value > p->floor + p->majorant;
  if (!(b->limit[m] < value)) return false;
  collide(d, p, p->begin + m * p->tick, i, j, k);
  d->cells.hits[p->cell]++;
  d->cells.hits[b->cell[m]]++;
  return true;
}

/* One candidate after another, as the textbooks have it. */
static void collide_plain(gg_dsmc_gap *d, pass *p, const block *b)
{
  for (uint32_t m = 0; m < b->n; m++)
    if (may_collide(d->grains.at, b, m)) judge(d, p, b, m);
}

/* The same with the same bits: the first stage of all goes first. */
static void collide_block(gg_dsmc_gap *d, pass *p, const block *b)
{
  const gg_dsmc_gap_motion *at = d->grains.at;
  uint32_t may = 0;
  for (uint32_t m = 0; m < b->n; m++) may |= (uint32_t)may_collide(at, b, m) << m;
  while (may) {
    const uint32_t m = (uint32_t)__builtin_ctz(may), i = b->i[m], j = b->j[m];
    may &= may - 1;
    if (!judge(d, p, b, m)) continue;
    for (uint32_t k = m + 1; k < b->n; k++) {
      if ((b->i[k] != i) & (b->i[k] != j) & (b->j[k] != i) & (b->j[k] != j)) continue;
      may = (may & ~(1u << k)) | (uint32_t)may_collide(at, b, k) << k;
    }
  }
}

enum { WINDOW = 20000 }; /* candidates after which a majorant forgets */

/* At `turn` of `turns`. */
static void collide_species(gg_dsmc_gap *d, int cell, int one, int two, double dt, double turn, double turns)
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
  block b;
  /* After a majorant overflow: correction passes, each over the layer above. */
  for (uint64_t tried = 0; p.majorant > 0; p.floor += p.majorant, p.majorant = 1.1 * p.largest - p.floor) {
    p.candidates = (uint64_t)(rate * p.majorant + gg_rng_uniform(&d->now.rng));
    p.tick = dt / turns / (double)(p.candidates + 1);
    p.begin = d->now.time + dt * turn / turns + p.tick;
    for (uint64_t left = p.candidates; left > 0; left -= b.n) {
      b.n = left < BLOCK ? (uint32_t)left : BLOCK;
      draw(d, &p, first, n, &b);
      (d->plain ? collide_plain : collide_block)(d, &p, &b);
      p.begin += b.n * p.tick;
    }
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
    collide_species(d, k / (species * species), k / species % species, k % species, dt, t, all);
  }
}
