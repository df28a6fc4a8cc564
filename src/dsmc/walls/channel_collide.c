/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions of a step in a channel.
 *
 * A candidate of grain i at height y has a direction k and a partner j, any of the N grains of the partner's species in
 * the cell at y + sigma k_y. Enskog's collision rate is that of k uniform on the sphere, times sigma^2 chi g_n N per
 * volume of a cell and 4 pi. Every collision has two grains, so the candidates of each grain have half of this rate.
 * There are no cells, and so no partners, beyond the walls.
 *
 * The cell and the partner depend on k_y alone: an azimuth of k and its opposite are equivalent. So a candidate
 * represents both azimuths, with the mean V of their positive g_n. For |g| = 1, V is at most h(k_y) = max(|k_y|, 1/2).
 * Therefore k_y is drawn with the density of h, and the candidate is accepted if chi N V/h is above a random limit; one
 * azimuth of the two is chosen in proportion to g_n. Then the rate of each k is exactly the rate above, with 5/8 of the
 * candidates.
 *
 * In dense gases cells are so narrow, and N fluctuates so much, that few candidates would be accepted. There candidates
 * are those of a block of cells A, of width w: a grain i of it; a block B of partners, in proportion to N_B H chi, with
 * H the largest h and chi the largest contact value of grains in A and B; any grain j of B; and a height that is
 * uniform in the cell of j, as grains are in a cell. That height gives k_y. It has the rate above, since each grain of
 * a cell stands for an equal part of its N. The candidate is accepted if chi V, over H and the largest chi, is above
 * the random limit.
 *
 * Random numbers of some candidates are drawn, and the candidates tested, at once. Candidates whose grains collide
 * meanwhile are tested again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsmc/kernel/normal.h"
#include "dsmc/walls/channel.h"
#include "simd/batch.h"

enum {
  SUMS = 4,
  MOST_BLOCKS = 2 * GG_DSMC_CHANNEL_MOST_FAR + 1
}; /* SUMS: partial sums, which do not wait for each other */

/* Blocks of partners. */
typedef struct partners {
  int n;
  double below[MOST_BLOCKS + SUMS + 1], h[MOST_BLOCKS]; /* sums of N_B H chi over blocks below; H chi */
  uint32_t first[MOST_BLOCKS], grains[MOST_BLOCKS];     /* first grain, and their number */
} partners;

/* Constants and sums of the candidates of two species in a cell, or of a block. */
typedef struct pass {
  gg_dsmc_channel_slab *slab;
  int cell, one, two, pair; /* the (first) cell */
  uint32_t first, n;        /* its grains */
  const uint32_t *start;    /* first partners by cell, from the empty cell below the first one */
  const double *chi;        /* contact values with these cells */
  double bottom;            /* lower edge of that empty cell */
  double last;              /* index of the empty cell above the last one; by blocks, within the last cell */
  double reach;             /* distance of partners, in cells */
  double inverse_reach;
  const partners *partners; /* by blocks; else undefined */
  double floor, majorant, largest;
  double recent; /* largest value from which the majorant was last learned */
  uint64_t candidates;
  double begin, tick; /* time of the first candidate, and between two candidates */
  gg_contact contact;
} pass;

static gg_contact contact_of(const gg_dsmc_channel *d, const pass *p, double gn)
{
  gg_contact c = p->contact;
  const gg_restitution_law *law = &d->model.law;
  const double u = law->e ? 0 : d->tables->scale[p->pair] * gn;
  const gg_loss_table *table = law->e ? NULL : d->tables->of[GG_OF_E][p->pair];
  if (law->e || table)
    c.jn =
        (1 + (law->e ? gg_common_law_at(law, gn, p->one, p->two, &p->slab->clamped) : 1 - gg_law_table_at(table, u))) /
        gg_inverse_mr(&c);
  if (law->e) return c;
  gg_coefficients_set_friction(d->tables, p->pair, u, &c);
  p->slab->clamped += gg_coefficients_clamp(d->tables, p->pair, u);
  return c;
}

static __attribute__((noinline)) void call_back(gg_dsmc_channel *d, double time, const uint32_t i[2], gg_vec k,
                                                const gg_vec c[2], gg_vec J, const gg_vec s[2])
{
  gg_dsmc_channel_grains *g = &d->grains;
  gg_collision_record m = {.k = k, .c12 = gg_sub(c[0], c[1]), .J = J, .time = time};
  for (int w = 0; w < 2; w++) {
    m.id[w] = g->id[i[w]];
    m.species[w] = g->species[i[w]];
    m.c[w] = c[w];
    if (g->s) m.s[w] = g->s[i[w]], m.turn[w] = gg_sub(s[w], m.s[w]);
    m.height[w] = g->at[i[w]].y - 0.5 * d->model.box[1];
    m.since[w] = fmax(time - g->last[i[w]], 0); /* a correction pass has earlier times */
    g->last[i[w]] = time;
  }
  d->callback(d->callback_context, &m);
}

GG_INLINE void collide(gg_dsmc_channel *d, const pass *p, double time, uint32_t i, uint32_t j, gg_vec k)
{
  gg_dsmc_channel_grains *g = &d->grains;
  const gg_rule rule = d->model.rule;
  const gg_vec before[2] = {g->at[i].c, g->at[j].c};
  gg_vec c1 = before[0], c2 = before[1], s1 = {0, 0, 0}, s2 = s1;
  if (rule != GG_SMOOTH) s1 = g->s[i], s2 = g->s[j];
  const gg_vec v = gg_contact_velocity(rule, k, gg_sub(c1, c2), s1, s2);
  const double gn = gg_dot(k, v);
  gg_contact by_law;
  const gg_contact *contact = &p->contact;
  if (d->model.law.name) by_law = contact_of(d, p, gn), contact = &by_law;
  const bool kicks = d->model.kicks;
  const gg_vec J = kicks ? gg_kicked_impulse(rule, contact, k, v, gn) : gg_impulse(rule, contact, k, v, gn);
  gg_kick(rule, contact, k, J, &c1, &s1, &c2, &s2);
  if (d->callback) call_back(d, time, (const uint32_t[]){i, j}, k, before, J, (const gg_vec[]){s1, s2});
  g->at[i].c = c1, g->at[j].c = c2;
  if (rule != GG_SMOOTH) g->s[i] = s1, g->s[j] = s2;
  gg_collision_sums *t = &p->slab->transfer;
  p->slab->collisions++;
  t->collisions[p->pair]++;
  if (!d->model.boltzmann) gg_add_stress(t->stress[p->pair], d->model.sigma[p->pair], k, J);
  const gg_kicked_loss energy =
      kicks ? gg_kicked_energy_loss(contact, k, v, J) : (gg_kicked_loss){.loss = gg_energy_loss(contact, k, v, J)};
  t->loss[p->pair] += energy.loss;
  t->given[p->pair] += energy.given;
}

/* Height and velocity of a grain. */
typedef double motion4 __attribute__((vector_size(32), may_alias));
/* Numbers of cells, one a lane. */
typedef int32_t whole_numbers __attribute__((vector_size(4 * GG_WIDTH)));

/* Candidates that are drawn at once. */
enum { BLOCK = 32 };
typedef struct block {
  motion4 relative[BLOCK];                                  /* first grain minus second, in height and velocity */
  double kx[BLOCK], ky[BLOCK], kz[BLOCK];                   /* k; k_x and k_z may get the other sign */
  double h[BLOCK], scale[BLOCK], limit[BLOCK];              /* h(k_y), chi N, random limit */
  double sign[BLOCK];                                       /* random number that decides the sign */
  uint32_t i[BLOCK], j[BLOCK], home[BLOCK], cell[BLOCK], n; /* grains, and their cells, the second one's plus 1 */
} __attribute__((aligned(64))) block;

#define LANES_OF(array, k) (*(gg_vd *)&(array)[k])

/* Random words of the batch of candidates from k on. A candidate always has the numbers of the same lane. */
GG_INLINE gg_vu next_words(gg_dsmc_lane_rng *rng, uint32_t k)
{
  return (gg_vu)gg_dsmc_lane_next(rng, (int)(k % GG_DSMC_LANES / GG_WIDTH));
}

/* The lowest 32 bits as a number in [1, 2). */
GG_INLINE gg_vd one_to_two(gg_vu word)
{
  return (gg_vd)((word & UINT32_MAX) << 20 | 0x3ff0000000000000u);
}

/* Half of all azimuths are drawn: up to pi/4 either way, or the same rotated by pi/2 (`other`: odd numbers). */
GG_INLINE void draw_azimuth(gg_vu azimuth, gg_vu other, gg_vd across, block *b, uint32_t k)
{
  gg_vd s, c;
  gg_dsmc_lane_sincos((one_to_two(azimuth) - 1.5) * M_PI_2, &s, &c);
  const gg_mask rotated = gg_low_bit(other);
  LANES_OF(b->kx, k) = across * gg_select(rotated, s, c);
  LANES_OF(b->kz, k) = across * gg_select(rotated, c, s);
}

/* Draw the directions of a batch. |k_y| has the distribution 4/5 k_y up to 1/2 and 1/5 + 4/5 k_y^2 above; its inverse
 * is the smaller of two functions. */
GG_INLINE void draw_direction(gg_vu height, gg_vu azimuth, block *b, uint32_t k)
{
  const gg_vd low = 1.25 * (one_to_two(height) - (1 - 0x1p-33)), h = gg_sqrt(gg_larger(low - 0.25, gg_all(0.25)));
  const gg_vd ky = gg_smaller(low, h);
  LANES_OF(b->ky, k) = (gg_vd)((gg_vu)ky | (height & 0x8000000000000000u));
  LANES_OF(b->h, k) = h;
  draw_azimuth(azimuth, height >> 32, gg_sqrt(1 - ky * ky), b, k);
}

/* Find the cell of the partner. Grains above the last cell of an open top get the empty cell above it. */
GG_INLINE void find_cells(const gg_dsmc_channel *d, const pass *p, block *b, uint32_t k)
{
  gg_vd y = {0};
  for (uint32_t l = 0; l < GG_WIDTH; l++) y[l] = d->grains.at[b->i[k + l]].y;
  const gg_vd at = (y - p->bottom) * d->cells.inverse + p->reach * LANES_OF(b->ky, k);
  const gg_vd inside = gg_smaller(gg_larger(at, gg_all(0)), gg_all(p->last));
  *(gg_list *)&b->cell[k] = (gg_list) __builtin_convertvector(inside, whole_numbers);
}

/* Draw the random numbers of a batch of candidates. j: 32 bits for find_partner. */
GG_INLINE void draw_numbers(const pass *p, gg_dsmc_lane_rng *rng, block *b, uint32_t k)
{
  const gg_vu partner_bits = next_words(rng, k), direction_bits = next_words(rng, k), limit_bits = next_words(rng, k),
              i = (partner_bits >> 32) * p->n >> 32;
  *(gg_list *)&b->i[k] = p->first + __builtin_convertvector(i, gg_list);
  *(gg_list *)&b->j[k] = __builtin_convertvector(partner_bits & UINT32_MAX, gg_list);
  draw_direction(direction_bits, limit_bits >> 32, b, k);
  LANES_OF(b->limit, k) = p->floor + p->majorant * (one_to_two(limit_bits) - 1);
  LANES_OF(b->sign, k) = one_to_two(direction_bits >> 31) - 1;
}

GG_INLINE void find_partner(const gg_dsmc_channel *d, const pass *p, block *b, uint32_t k)
{
  const motion4 *grains = (const motion4 *)d->grains.at;
  const uint32_t cell = b->cell[k], *start = p->start + cell * (uint32_t)d->model.n_species;
  const uint32_t n = start[1] - start[0], j = start[0] + (uint32_t)((uint64_t)b->j[k] * n >> 32);
  b->relative[k] = grains[b->i[k]] - grains[j];
  b->j[k] = j;
  b->home[k] = (uint32_t)p->cell;
  b->scale[k] = p->chi[cell] * (int)n;
}

/* Draw a batch of candidates in a periodic channel, with their partners. The contact value is that of the middle
 * between both grains, in half cells round the channel. */
static __attribute__((noinline)) void draw_round(const gg_dsmc_channel *d, const pass *p, gg_dsmc_lane_rng *rng,
                                                 block *b, uint32_t first)
{
  const motion4 *grains = (const motion4 *)d->grains.at;
  const int cells = d->cells.n;
  draw_numbers(p, rng, b, first);
  for (uint32_t k = first; k < first + GG_WIDTH; k++) {
    const double at = (grains[b->i[k]][0] - d->cells.from) * d->cells.inverse + p->reach * b->ky[k];
    const int beside = (int)floor(at), cell = beside < 0 ? beside + cells : beside < cells ? beside : beside - cells;
    const int middle = (p->cell + beside + 2 * cells) % (2 * cells);
    const uint32_t *start = p->start + (uint32_t)(cell + 1) * (uint32_t)d->model.n_species;
    const uint32_t n = start[1] - start[0], j = start[0] + (uint32_t)((uint64_t)b->j[k] * n >> 32);
    b->relative[k] = grains[b->i[k]] - grains[j];
    b->j[k] = j;
    b->home[k] = (uint32_t)p->cell;
    b->cell[k] = (uint32_t)cell + 1;
    b->scale[k] = p->chi[middle - p->cell + 1] * (int)n;
  }
}

/* Cells of these heights, which are in units of cells. */
GG_INLINE gg_list cells_of(gg_vd height, double last)
{
  return (gg_list) __builtin_convertvector(gg_smaller(height, gg_all(last)), whole_numbers);
}

/* Draw a batch of candidates by blocks. The product of 32 random bits and the number of partners is j in its upper
 * half, and the place in the cell of j in its lower one. */
GG_INLINE void draw_by_blocks(const gg_dsmc_channel *d, const pass *p, gg_dsmc_lane_rng *rng, block *b, uint32_t k)
{
  const gg_dsmc_channel_cells *c = &d->cells;
  const gg_dsmc_channel_motion *grains = d->grains.at;
  const partners *of = p->partners;
  const gg_vu partner_bits = next_words(rng, k), direction_bits = next_words(rng, k), limit_bits = next_words(rng, k),
              i = (partner_bits >> 32) * p->n >> 32;
  const gg_vd at = of->below[of->n] * (one_to_two(direction_bits) - 1);
  gg_vd far = {0}, from = far, to = far, h = far;
  gg_vu first = {0}, n = first;
  gg_vd above[SUMS] = {far, far, far, far};
  for (int q = 1; q < of->n; q += SUMS)
    for (int s = 0; s < SUMS; s++)
      above[s] += gg_select(gg_not_above(gg_all(of->below[q + s]), at), gg_all(1), gg_all(0));
  far = (above[0] + above[1]) + (above[2] + above[3]);
  const gg_list which = (gg_list) __builtin_convertvector(far, whole_numbers);
  *(gg_list *)&b->i[k] = p->first + __builtin_convertvector(i, gg_list);
  for (int l = 0; l < GG_WIDTH; l++)
    first[l] = of->first[which[l]], n[l] = of->grains[which[l]], h[l] = of->h[which[l]];
  const gg_vu product = (partner_bits & UINT32_MAX) * n, j = first + (product >> 32);
  *(gg_list *)&b->j[k] = __builtin_convertvector(j, gg_list);
  for (uint32_t l = 0; l < GG_WIDTH; l++) from[l] = grains[b->i[k + l]].y, to[l] = grains[b->j[k + l]].y;
  from = (from - c->from) * c->inverse, to = (to - c->from) * c->inverse;
  const gg_list home = cells_of(from, p->last), cell = cells_of(to, p->last);
  const gg_vd ky = (__builtin_convertvector(cell, gg_vd) + (one_to_two(product) - 1) - from) * p->inverse_reach;
  gg_vd chi = {0};
  for (int l = 0; l < GG_WIDTH; l++) chi[l] = c->chi[home[l] + cell[l] + 1];
  const gg_vd squared = 1 - ky * ky;
  *(gg_list *)&b->home[k] = home;
  *(gg_list *)&b->cell[k] = cell + 1;
  LANES_OF(b->ky, k) = ky;
  LANES_OF(b->h, k) = h;
  LANES_OF(b->scale, k) = gg_select(gg_less(gg_all(0), squared), chi, gg_all(0));
  LANES_OF(b->limit, k) = p->floor + p->majorant * (one_to_two(limit_bits) - 1);
  LANES_OF(b->sign, k) = one_to_two(direction_bits >> 31) - 1;
  draw_azimuth(limit_bits >> 32, direction_bits >> 32, gg_sqrt(gg_larger(squared, gg_all(0))), b, k);
}

/* Draw the candidates of a block. All lanes of the random numbers advance, so their number is rounded up. */
static void draw(gg_dsmc_channel *d, const pass *p, gg_dsmc_lane_rng *rng, block *b)
{
  const uint32_t n = (b->n + GG_DSMC_LANES - 1) / GG_DSMC_LANES * GG_DSMC_LANES;
  if (d->periodic) {
    for (uint32_t k = 0; k < n; k += GG_WIDTH) draw_round(d, p, rng, b, k);
    return;
  }
  if (d->cells.block > 0) {
    const motion4 *grains = (const motion4 *)d->grains.at;
    for (uint32_t k = 0; k < n; k += GG_WIDTH) draw_by_blocks(d, p, rng, b, k);
    for (uint32_t k = 0; k < n; k++) b->relative[k] = grains[b->i[k]] - grains[b->j[k]];
    return;
  }
  for (uint32_t k = 0; k < n; k += GG_WIDTH) {
    draw_numbers(p, rng, b, k);
    find_cells(d, p, b, k);
  }
  for (uint32_t k = 0; k < n; k++) find_partner(d, p, b, k);
}

/* Accept or reject a candidate; an accepted one collides. Returns whether it was accepted. */
static bool try_candidate(gg_dsmc_channel *d, pass *p, const block *b, uint32_t m)
{
  const uint32_t i = b->i[m], j = b->j[m];
  const gg_vec c = gg_sub(d->grains.at[i].c, d->grains.at[j].c);
  const double A = b->ky[m] * c.y, B = b->kx[m] * c.x + b->kz[m] * c.z, h = b->h[m];
  const double one = A + B > 0 ? A + B : 0, other = A - B > 0 ? A - B : 0, value = b->scale[m] * (0.5 * (one + other));
  if (value > p->largest * h) p->largest = value / h;
  p->slab->overflows += value > (p->floor + p->majorant) * h;
  if (!(b->limit[m] * h < value)) return false;
  const double sign = b->sign[m] * (one + other) < other ? -1 : 1;
  collide(d, p, p->begin + m * p->tick, i, j, (gg_vec){sign * b->kx[m], b->ky[m], sign * b->kz[m]});
  d->cells.hits[b->home[m]]++;
  d->cells.hits[b->cell[m] - 1]++;
  return true;
}

/* Test one candidate after another: the reference of collide_block. */
static void collide_plain(gg_dsmc_channel *d, pass *p, block *b)
{
  for (uint32_t m = 0; m < b->n; m++) try_candidate(d, p, b, m);
}

/* Bits of the candidates of a batch that have to be tested: they may be accepted, or exceed the recent majorant. */
GG_INLINE uint32_t to_test(block *b, uint32_t k, double recent)
{
  const gg_row *row[GG_WIDTH];
  gg_vd c[4];
  for (int l = 0; l < GG_WIDTH; l++) row[l] = (const gg_row *)&b->relative[k + (uint32_t)l];
  gg_batch_columns(row, c);
  const gg_vd A = LANES_OF(b->ky, k) * c[2], B = LANES_OF(b->kx, k) * c[1] + LANES_OF(b->kz, k) * c[3];
  const gg_vd one = gg_larger(A + B, gg_all(0)), other = gg_larger(A - B, gg_all(0));
  const gg_vd value = LANES_OF(b->scale, k) * (0.5 * (one + other));
  return gg_bits(gg_less(gg_smaller(LANES_OF(b->limit, k), gg_all(recent)) * LANES_OF(b->h, k), value));
}

/* Bits of those of 32 numbers that equal x. */
GG_INLINE uint32_t where_is(const uint32_t *numbers, uint32_t x)
{
  uint32_t which = 0;
#ifdef GG_HAS_AVX512
  for (int k = 0; k < BLOCK; k += 16)
    which |= (uint32_t)_mm512_cmpeq_epi32_mask(_mm512_load_si512(numbers + k), _mm512_set1_epi32((int)x)) << k;
#else
  for (int k = 0; k < BLOCK; k++) which |= (uint32_t)(numbers[k] == x) << k;
#endif
  return which;
}

/* Bits of the candidates that have one of these grains. */
GG_INLINE uint32_t with(const block *b, uint32_t i, uint32_t j)
{
  return where_is(b->i, i) | where_is(b->i, j) | where_is(b->j, i) | where_is(b->j, j);
}

/* The same with the same bits: a preliminary test of all candidates at once selects those to test one by one. */
static void collide_block(gg_dsmc_channel *d, pass *p, block *b)
{
  const uint32_t drawn = UINT32_MAX >> (BLOCK - b->n);
  const double most = p->floor + p->majorant, all = p->recent > p->largest ? p->recent : p->largest;
  uint32_t tested = 0;
  for (uint32_t m = 0; m < b->n; m += GG_WIDTH) tested |= to_test(b, m, all < most ? all : most) << m;
  tested &= drawn;
  while (tested) {
    const uint32_t m = (uint32_t)__builtin_ctz(tested);
    tested &= tested - 1;
    if (try_candidate(d, p, b, m)) tested |= with(b, b->i[m], b->j[m]) & drawn & ~1u << m;
  }
}

enum { WINDOW = 20000 }; /* candidates of a window of the majorant (majorant.h) */

/* Collisions of a slab: from number `index` on of the `total` combinations of cells and pairs of species in the step.
 */
typedef struct sweep {
  gg_dsmc_channel *d;
  gg_dsmc_channel_slab *slab;
  gg_rng rng;
  gg_dsmc_lane_rng lanes;
  double dt, index, total;
} sweep;

/* Set the blocks of partners of a block that begins with this cell. */
static void weigh_blocks(const gg_dsmc_channel_cells *c, int cell, partners *of)
{
  const int here = cell / c->block, lowest = here < c->far ? 0 : here - c->far,
            highest = here + c->far < c->blocks ? here + c->far : c->blocks - 1;
  of->below[0] = 0;
  of->n = highest - lowest + 1;
  for (int k = 0; k < of->n; k++) {
    const int other = lowest + k, end = (other + 1) * c->block;
    of->first[k] = c->start[other * c->block];
    of->grains[k] = c->start[end < c->n ? end : c->n] - of->first[k];
    of->h[k] = c->height[abs(other - here)] * c->most_chi[here + other];
    of->below[k + 1] = of->below[k] + of->grains[k] * of->h[k];
  }
  for (int k = 1; k <= SUMS; k++) of->below[of->n + k] = INFINITY;
}

static void collide_species(sweep *w, int cell, int end, int one, int two)
{
  gg_dsmc_channel *d = w->d;
  gg_dsmc_channel_cells *c = &d->cells;
  const int species = d->model.n_species, here = cell * species + one, pair = gg_pair(one, two);
  const uint32_t first = c->start[here], n = c->start[(end - 1) * species + one + 1] - first;
  gg_dsmc_majorant *learned = &c->majorant[here * species + two];
  if (n == 0) return;
  const double thermal = sqrt(d->now.temperature), sigma = d->model.sigma[pair], reach = d->reach[pair] * c->inverse;
  double rate = M_PI * sigma / c->volume * n * w->dt; /* of candidates, per unit of the majorant */
  partners of;
  if (c->block > 0) {
    weigh_blocks(c, cell, &of);
    rate *= c->width * of.below[of.n];
  } else
    rate *= 1.25 * sigma;
  pass p = {.slab = w->slab,
            .cell = cell,
            .one = one,
            .two = two,
            .pair = pair,
            .first = first,
            .n = n,
            .start = c->start - species + two,
            .chi = c->chi + pair * 2 * c->n + cell,
            .bottom = c->from - c->width,
            .last = c->block > 0 ? c->n - 0.5 : c->n + 1,
            .reach = reach,
            .inverse_reach = 1 / reach,
            .partners = &of,
            .majorant = gg_dsmc_majorant_at(learned, thermal),
            .recent = learned->now * thermal,
            .contact = d->model.contact[one][two]};
  block b;
  /* After a majorant overflow: correction passes, each over the layer above. */
  for (uint64_t tried = 0; p.majorant > 0; p.floor += p.majorant, p.majorant = 1.1 * p.largest - p.floor) {
    p.candidates = (uint64_t)(rate * p.majorant + gg_rng_uniform(&w->rng));
    p.tick = w->dt * (end - cell) / w->total / (double)(p.candidates + 1);
    p.begin = d->now.time + w->dt * w->index / w->total + p.tick;
    for (uint64_t left = p.candidates; left > 0; left -= b.n) {
      b.n = left < BLOCK ? (uint32_t)left : BLOCK;
      draw(d, &p, &w->lanes, &b);
      (d->plain ? collide_plain : collide_block)(d, &p, &b);
      p.begin += b.n * p.tick;
    }
    w->slab->candidates += p.candidates;
    tried += p.candidates;
    if (p.largest > p.floor + p.majorant) continue;
    gg_dsmc_majorant_learn(learned, p.largest, thermal, tried, WINDOW);
    return;
  }
}

/* Prefetch the grains of cells [first, end), as far as they exist: random accesses would load them one by one. */
static void prefetch(const gg_dsmc_channel *d, int first, int end)
{
  const gg_dsmc_channel_cells *c = &d->cells;
  const int species = d->model.n_species;
  if (first < 0) first = 0;
  if (end > c->n) end = c->n;
  if (first >= end) return;
  for (uint32_t i = c->start[first * species]; i < c->start[end * species]; i += 2)
    __builtin_prefetch(&d->grains.at[i], 1);
}

typedef struct stage {
  gg_dsmc_channel *d;
  double dt;
  bool backward, odd;
} stage;

static void collide_slab(void *context, int part)
{
  const stage *s = context;
  gg_dsmc_channel *d = s->d;
  const int nth = 2 * part + s->odd, each = d->model.n_species * d->model.n_species, ahead = d->cells.reach / 2 + 2;
  const int unit = d->cells.block > 0 ? d->cells.block : 1;
  gg_dsmc_channel_slab *slab = &d->slab[nth];
  const int all = (slab->end - slab->first + unit - 1) / unit * each;
  sweep w = {.d = d, .slab = slab, .rng = d->now.streams.cells[nth], .dt = s->dt, .total = d->cells.n * each};
  gg_dsmc_lane_rng_load(&w.lanes, &d->now.streams.lanes[nth]);
  const int begin = s->backward ? slab->end : slab->first;
  prefetch(d, begin - ahead, begin + ahead);
  for (int t = 0; t < all; t++) {
    const int k = s->backward ? all - 1 - t : t, cell = slab->first + k / each * unit, pair = k % each;
    const int end = cell + unit < slab->end ? cell + unit : slab->end;
    if (t % each == 0) prefetch(d, s->backward ? cell - ahead : cell + ahead, s->backward ? end - ahead : end + ahead);
    w.index =
        (slab->cells_before + (s->backward ? slab->end - end : cell - slab->first)) * each + t % each * (end - cell);
    collide_species(&w, cell, end, pair / d->model.n_species, pair % d->model.n_species);
  }
  gg_dsmc_lane_rng_save(&w.lanes, &d->now.streams.lanes[nth]);
  d->now.streams.cells[nth] = w.rng;
}

/* Collide every second slab at once. In time the cells of a step follow one another. */
static void collide_half(gg_dsmc_channel *d, double dt, bool backward, bool odd, int *cells_before)
{
  stage s = {d, dt, backward, odd};
  for (int k = odd; k < d->slabs; k += 2) {
    d->slab[k].cells_before = *cells_before;
    *cells_before += d->slab[k].end - d->slab[k].first;
  }
  gg_base_thread_pool_for(d->callback ? NULL : d->pool, (d->slabs + !odd) / 2, collide_slab, &s);
}

static void add_sums(gg_dsmc_channel *d, gg_dsmc_channel_slab *slab)
{
  gg_dsmc_channel_state *s = &d->now;
  gg_collision_sums *to = &s->transfer, *from = &slab->transfer;
  s->collisions += slab->collisions, s->candidates += slab->candidates, s->overflows += slab->overflows;
  s->clamped += slab->clamped;
  slab->collisions = slab->candidates = slab->overflows = slab->clamped = 0;
  for (int p = 0; p < gg_pairs_of(d->model.n_species); p++) {
    to->collisions[p] += from->collisions[p];
    to->loss[p] += from->loss[p];
    to->given[p] += from->given[p];
    for (int k = 0; k < 9; k++) to->stress[p][k / 3][k % 3] += from->stress[p][k / 3][k % 3];
    from->collisions[p] = 0, from->loss[p] = from->given[p] = 0;
    memset(from->stress[p], 0, sizeof from->stress[p]);
  }
}

/* Symmetric splitting: every second step mirrors the one before. */
void GG_CHANNEL_COLLIDE(gg_dsmc_channel *d, double dt)
{
  const bool backward = d->now.steps % 2;
  int cells_before = 0;
  collide_half(d, dt, backward, backward, &cells_before);
  collide_half(d, dt, backward, !backward, &cells_before);
  for (int k = 0; k < d->slabs; k++) add_sums(d, &d->slab[k]);
}
