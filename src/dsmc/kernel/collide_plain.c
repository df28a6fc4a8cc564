/* The collision step as the textbooks have it, one candidate after another: the oracle of the fast kernels, and the
 * path of ensembles too small for blocks. */
#include <math.h>

#include "dsmc/kernel/pass.h"

typedef struct grain_pair {
  uint32_t a, b;
  gg_vec ca, cb, sa, sb;
} grain_pair;

/* Their velocities at this candidate's time. */
static void fetch(gg_dsmc_features f, const gg_dsmc_pass *p, grain_pair *q)
{
  q->ca = gg_dsmc_block_get(p->one, p->one->c, q->a);
  q->cb = gg_dsmc_block_get(p->two, p->two->c, q->b);
  if (f.shear == GG_DSMC_UNSHEARED) return;
  q->ca.x -= p->strain * q->ca.y;
  q->cb.x -= p->strain * q->cb.y;
}

static void call_back(gg_dsmc_pass *p, const grain_pair *q, gg_vec k, gg_vec c12, gg_vec J)
{
  double *one = &p->callback->last[p->species[0]][q->a], *two = &p->callback->last[p->species[1]][q->b];
  const int64_t *first = p->callback->first;
  gg_collision_record m = {.id = {first[p->species[0]] + q->a, first[p->species[1]] + q->b},
                           .species = {p->species[0], p->species[1]},
                           .k = k,
                           .c12 = c12,
                           .c = {q->ca, q->cb},
                           .height = {NAN, NAN},
                           .J = J,
                           .time = p->time,
                           .since = {p->time - *one, p->time - *two}};
  p->callback->call(p->callback->context, &m);
  *one = *two = p->time;
}

static void sums(gg_dsmc_features f, gg_dsmc_pass *p, const gg_contact *contact, gg_vec k, gg_vec g, gg_vec J)
{
  if (f.sums == GG_DSMC_NO_SUMS) return;
  p->loss += gg_energy_loss(contact, k, g, J);
  if (f.sums == GG_DSMC_LOSS) return;
  gg_add_stress(p->stress, p->sigma, k, J);
}

/* The contact at this speed, by the law of restitution. */
static gg_contact contact_at(const gg_dsmc_pass *p, double gn)
{
  gg_contact c = p->contact;
  double e = p->law ? gg_common_law_at(p->law, gn * p->law_unit, p->species[0], p->species[1])
                    : 1 - gg_loss_at(p->losses->loss, gn * p->loss_scale);
  c.jn = (1 + e) / gg_inverse_mr(&c);
  return c;
}

static void raise_speed_bound(const gg_dsmc_pass *p, float *speed_bound, gg_vec c)
{
  float peak = (float)(gg_dot(c, c) * gg_dsmc_per_bound(p->bound_scale) * p->bound_margin);
  if (peak > *speed_bound) *speed_bound = peak;
}

static void collide(gg_dsmc_features f, gg_dsmc_pass *p, grain_pair *q, gg_vec k, gg_vec c12, double gn)
{
  if (f.rule != GG_SMOOTH) {
    q->sa = gg_dsmc_block_get(p->one, p->one->s, q->a);
    q->sb = gg_dsmc_block_get(p->two, p->two->s, q->b);
  }
  gg_contact by_law;
  const gg_contact *contact = &p->contact;
  if (p->law || p->losses) by_law = contact_at(p, gn), contact = &by_law;
  gg_vec g = gg_contact_velocity(f.rule, k, c12, q->sa, q->sb), J = gg_impulse(f.rule, contact, k, g, gn);
  if (p->callback) call_back(p, q, k, c12, J);
  sums(f, p, contact, k, g, J);
  gg_kick(f.rule, contact, k, J, &q->ca, &q->sa, &q->cb, &q->sb);
  raise_speed_bound(p, &p->one->speed_bound[q->a / GG_DSMC_LANES], q->ca);
  raise_speed_bound(p, &p->two->speed_bound[q->b / GG_DSMC_LANES], q->cb);
  if (f.shear != GG_DSMC_UNSHEARED) {
    q->ca.x += p->strain * q->ca.y;
    q->cb.x += p->strain * q->cb.y;
  }
  gg_dsmc_block_set(p->one, p->one->c, q->a, q->ca);
  gg_dsmc_block_set(p->two, p->two->c, q->b, q->cb);
  if (f.rule == GG_SMOOTH) return;
  gg_dsmc_block_set(p->one, p->one->s, q->a, q->sa);
  gg_dsmc_block_set(p->two, p->two->s, q->b, q->sb);
}

/* One candidate: a uniform direction, accepted with probability g_n/majorant. */
static void attempt(gg_dsmc_features f, gg_dsmc_pass *p, uint32_t a, uint32_t b, gg_rng *rng)
{
  grain_pair q = {.a = a, .b = b};
  fetch(f, p, &q);
  gg_vec k = gg_rng_direction(rng), c12 = gg_sub(q.ca, q.cb);
  if (f.shear == GG_DSMC_SHEARED_DENSE) c12.x -= p->shift * k.y;
  double gn = gg_dot(k, c12), over = gn - p->floor;
  p->tried++;
  if (gn > p->largest) p->largest = gn;
  if (over > p->majorant) p->overflows++;
  if (gg_rng_uniform(rng) * p->majorant >= over) return;
  p->collisions++;
  collide(f, p, &q, k, c12, gn);
}

void gg_dsmc_collide_plain(gg_dsmc_features f, gg_dsmc_pass *p, gg_rng *rng)
{
  for (uint64_t i = 0; i < p->candidates; i++, p->strain += p->strain_step, p->time += p->time_step) {
    /* Two different grains, every pair as likely as any other. */
    uint32_t a = gg_rng_below(rng, (uint32_t)p->one->n), b = gg_rng_below(rng, (uint32_t)p->two->n - f.same);
    if (f.same && b >= a) b++;
    attempt(f, p, a, b, rng);
  }
  if (!(p->bound_margin > 1)) p->bound_scale *= gg_dsmc_bound_growth((double)p->candidates * p->strain_step);
}

/* Four uniform directions under a majorant of g_n are as many candidates as one under a majorant of its integral over
 * pi. */
static void attempt_four(gg_dsmc_features f, gg_dsmc_pass *p, uint32_t a, uint32_t b, gg_rng *rng)
{
  if (a >= p->one->n || b >= p->two->n) return;
  for (int i = 0; i < 4; i++) attempt(f, p, a, b, rng);
}

/* Two grains of one species. */
static void exchange(const gg_dsmc_population *p, void *blocks, uint32_t a, uint32_t b)
{
  gg_vec v = gg_dsmc_block_get(p, blocks, a);
  gg_dsmc_block_set(p, blocks, a, gg_dsmc_block_get(p, blocks, b));
  gg_dsmc_block_set(p, blocks, b, v);
}

void gg_dsmc_collide_odd_blocks(gg_dsmc_features f, gg_dsmc_pass *p, uint32_t a, uint32_t b, unsigned order,
                                gg_rng *rng)
{
  a *= GG_DSMC_LANES;
  b *= GG_DSMC_LANES;
  if (f.same && a == b) {
    /* Pairs of different blocks get 2 (either order) x 1/8 a draw; so do the 28 within one if 7 are drawn. */
    for (int i = 0; i < 7; i++) {
      uint32_t l = gg_rng_below(rng, GG_DSMC_LANES), m = gg_rng_below(rng, GG_DSMC_LANES - 1);
      attempt_four(f, p, a + l, a + (m >= l ? m + 1 : m), rng);
    }
    return;
  }
  for (uint32_t l = 0; l < GG_DSMC_LANES; l++) {
    uint32_t i = a + l, j = b + (l ^ order);
    attempt_four(f, p, i, j, rng);
    bool both = i < p->one->n && j < p->two->n;
    if (!f.same || !both || gg_rng_below(rng, 2)) continue;
    exchange(p->one, p->one->c, i, j);
    if (p->one->s) exchange(p->one, p->one->s, i, j);
    float *x = &p->one->speed_bound[i / GG_DSMC_LANES], *y = &p->two->speed_bound[j / GG_DSMC_LANES];
    *x = *y = *x > *y ? *x : *y;
  }
}
