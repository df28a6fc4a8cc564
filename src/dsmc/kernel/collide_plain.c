/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions one candidate after another, the textbook method: the reference of the fast kernels, and the path of
 * ensembles too small for blocks. */
#include <math.h>

#include "dsmc/kernel/pass.h"

typedef struct grain_pair {
  uint32_t a, b;
  gg_vec ca, cb, sa, sb;
} grain_pair;

/* Load the velocities of a pair at the time of this candidate. */
static void fetch(gg_dsmc_features features, const gg_dsmc_pass *pass, grain_pair *pair)
{
  pair->ca = gg_dsmc_block_get(pass->one, pass->one->c, pair->a);
  pair->cb = gg_dsmc_block_get(pass->two, pass->two->c, pair->b);
  if (features.shear == GG_DSMC_UNSHEARED) return;
  pair->ca.x -= pass->strain * pair->ca.y;
  pair->cb.x -= pass->strain * pair->cb.y;
}

static void call_back(gg_dsmc_pass *pass, const grain_pair *pair, gg_vec k, gg_vec c12, gg_vec J)
{
  double *one = &pass->callback->last[pass->species[0]][pair->a],
         *two = &pass->callback->last[pass->species[1]][pair->b];
  const int64_t *first = pass->callback->first;
  gg_collision_record m = {.id = {first[pass->species[0]] + pair->a, first[pass->species[1]] + pair->b},
                           .species = {pass->species[0], pass->species[1]},
                           .k = k,
                           .c12 = c12,
                           .c = {pair->ca, pair->cb},
                           .height = {NAN, NAN},
                           .J = J,
                           .time = pass->time,
                           .since = {pass->time - *one, pass->time - *two}};
  pass->callback->call(pass->callback->context, &m);
  *one = *two = pass->time;
}

static void sums(gg_dsmc_features features, gg_dsmc_pass *pass, const gg_contact *contact, gg_vec k, gg_vec g, gg_vec J)
{
  pass->loss += gg_energy_loss(contact, k, g, J);
  if (features.own) pass->given += gg_kicked_energy_loss(contact, k, g, J).given;
  if (features.sums == GG_DSMC_LOSS) return;
  gg_add_stress(pass->stress, pass->sigma, k, J);
}

/* Contact at this normal speed, by the law of restitution or the tables. */
static gg_contact contact_at(gg_dsmc_pass *pass, double gn)
{
  gg_contact c = pass->contact;
  if (pass->law)
    c.jn = (1 + gg_common_law_at(pass->law, gn * pass->law_unit, pass->species[0], pass->species[1], &pass->clamped)) /
           gg_inverse_mr(&c);
  if (!pass->tables) return c;
  const double u = gn * pass->loss_scale;
  const int pair = gg_pair(pass->species[0], pass->species[1]);
  const gg_loss_table *losses = pass->tables->of[GG_OF_E][pair];
  if (losses) c.jn = (1 + (1 - gg_law_table_at(losses, u))) / gg_inverse_mr(&c);
  gg_coefficients_set_friction(pass->tables, pair, u, &c);
  pass->clamped += gg_coefficients_clamp(pass->tables, pair, u);
  return c;
}

static void raise_speed_bound(const gg_dsmc_pass *pass, float *speed_bound, gg_vec c)
{
  float peak = (float)(gg_dot(c, c) * gg_dsmc_per_bound(pass->bound_scale) * pass->bound_margin);
  if (peak > *speed_bound) *speed_bound = peak;
}

static void collide(gg_dsmc_features features, gg_dsmc_pass *pass, grain_pair *pair, gg_vec k, gg_vec c12, double gn)
{
  if (features.rule != GG_SMOOTH) {
    pair->sa = gg_dsmc_block_get(pass->one, pass->one->s, pair->a);
    pair->sb = gg_dsmc_block_get(pass->two, pass->two->s, pair->b);
  }
  gg_contact by_law;
  const gg_contact *contact = &pass->contact;
  if (pass->law || pass->tables) by_law = contact_at(pass, gn), contact = &by_law;
  gg_vec g = gg_contact_velocity(features.rule, k, c12, pair->sa, pair->sb),
         J = features.own ? gg_kicked_impulse(features.rule, contact, k, g, gn)
                          : gg_impulse(features.rule, contact, k, g, gn);
  if (pass->callback) call_back(pass, pair, k, c12, J);
  sums(features, pass, contact, k, g, J);
  gg_kick(features.rule, contact, k, J, &pair->ca, &pair->sa, &pair->cb, &pair->sb);
  raise_speed_bound(pass, &pass->one->speed_bound[pair->a / GG_DSMC_LANES], pair->ca);
  raise_speed_bound(pass, &pass->two->speed_bound[pair->b / GG_DSMC_LANES], pair->cb);
  if (features.shear != GG_DSMC_UNSHEARED) {
    pair->ca.x += pass->strain * pair->ca.y;
    pair->cb.x += pass->strain * pair->cb.y;
  }
  gg_dsmc_block_set(pass->one, pass->one->c, pair->a, pair->ca);
  gg_dsmc_block_set(pass->two, pass->two->c, pair->b, pair->cb);
  if (features.rule == GG_SMOOTH) return;
  gg_dsmc_block_set(pass->one, pass->one->s, pair->a, pair->sa);
  gg_dsmc_block_set(pass->two, pass->two->s, pair->b, pair->sb);
}

/* Test one candidate: a uniform direction, accepted with probability g_n/majorant. */
static void attempt(gg_dsmc_features features, gg_dsmc_pass *pass, uint32_t a, uint32_t b, gg_rng *rng)
{
  grain_pair pair = {.a = a, .b = b};
  fetch(features, pass, &pair);
  gg_vec k = gg_rng_direction(rng), c12 = gg_sub(pair.ca, pair.cb);
  if (features.shear == GG_DSMC_SHEARED_DENSE) c12.x -= pass->shift * k.y;
  double gn = gg_dot(k, c12), over = gn - pass->floor;
  pass->tried++;
  if (gn > pass->largest) pass->largest = gn;
  if (over > pass->majorant) pass->overflows++;
  if (gg_rng_uniform(rng) * pass->majorant >= over) return;
  pass->collisions++;
  collide(features, pass, &pair, k, c12, gn);
}

void gg_dsmc_collide_plain(gg_dsmc_features features, gg_dsmc_pass *pass, gg_rng *rng)
{
  for (uint64_t i = 0; i < pass->candidates; i++, pass->strain += pass->strain_step, pass->time += pass->time_step) {
    /* Draw two different grains, all pairs with the same probability. */
    uint32_t a = gg_rng_below(rng, (uint32_t)pass->one->n),
             b = gg_rng_below(rng, (uint32_t)pass->two->n - features.same);
    if (features.same && b >= a) b++;
    attempt(features, pass, a, b, rng);
  }
  if (!(pass->bound_margin > 1))
    pass->bound_scale *= gg_dsmc_bound_growth((double)pass->candidates * pass->strain_step);
}

/* Test a pair of grains in four uniform directions: under a majorant of g_n these are equivalent to one candidate under
 * a majorant of the integral of g_n over pi. */
static void attempt_four(gg_dsmc_features features, gg_dsmc_pass *pass, uint32_t a, uint32_t b, gg_rng *rng)
{
  if (a >= pass->one->n || b >= pass->two->n) return;
  for (int i = 0; i < 4; i++) attempt(features, pass, a, b, rng);
}

/* Exchange two grains of one species. */
static void exchange(const gg_dsmc_population *population, void *blocks, uint32_t a, uint32_t b)
{
  gg_vec v = gg_dsmc_block_get(population, blocks, a);
  gg_dsmc_block_set(population, blocks, a, gg_dsmc_block_get(population, blocks, b));
  gg_dsmc_block_set(population, blocks, b, v);
}

void gg_dsmc_collide_odd_blocks(gg_dsmc_features features, gg_dsmc_pass *pass, uint32_t a, uint32_t b, unsigned order,
                                gg_rng *rng)
{
  a *= GG_DSMC_LANES;
  b *= GG_DSMC_LANES;
  if (features.same && a == b) {
    /* A draw has probability 2 (either order) x 1/8 for each pair of different blocks; seven draws give the same to
     * each of the 28 pairs within one block. */
    for (int i = 0; i < 7; i++) {
      uint32_t l = gg_rng_below(rng, GG_DSMC_LANES), m = gg_rng_below(rng, GG_DSMC_LANES - 1);
      attempt_four(features, pass, a + l, a + (m >= l ? m + 1 : m), rng);
    }
    return;
  }
  for (uint32_t l = 0; l < GG_DSMC_LANES; l++) {
    uint32_t i = a + l, j = b + (l ^ order);
    attempt_four(features, pass, i, j, rng);
    bool both = i < pass->one->n && j < pass->two->n;
    if (!features.same || !both || gg_rng_below(rng, 2)) continue;
    exchange(pass->one, pass->one->c, i, j);
    if (pass->one->s) exchange(pass->one, pass->one->s, i, j);
    float *x = &pass->one->speed_bound[i / GG_DSMC_LANES], *y = &pass->two->speed_bound[j / GG_DSMC_LANES];
    *x = *y = *x > *y ? *x : *y;
  }
}
