/* The collision step as the textbooks have it, one candidate after another: the oracle of the fast kernels, and the
 * path of ensembles too small for blocks. */
#include "dsmc/pairing.h"

typedef struct gg_pair {
  uint32_t a, b;
  gg_vec ca, cb, sa, sb;
} gg_pair;

/* Two different grains, every pair as likely as any other. */
static gg_pair choose(gg_features f, const gg_pairing *p, gg_rng *rng)
{
  gg_pair q = {.a = gg_rng_below(rng, (uint32_t)p->one->n)};
  q.b = gg_rng_below(rng, (uint32_t)p->two->n - f.same);
  if (f.same && q.b >= q.a) q.b++;
  q.ca = gg_block_get(p->one->c, q.a);
  q.cb = gg_block_get(p->two->c, q.b);
  if (f.shear != GG_UNSHEARED) {
    q.ca.x -= p->drift * q.ca.y;
    q.cb.x -= p->drift * q.cb.y;
  }
  return q;
}

static void tally(gg_features f, gg_pairing *p, gg_vec k, gg_vec g, gg_vec J)
{
  if (f.tap == GG_TAP_CLOSED) return;
  p->loss += gg_energy_loss(&p->contact, k, g, J);
  if (f.tap == GG_TAP_LOSS) return;
  const double ka[3] = {k.x, k.y, k.z}, Jb[3] = {J.x, J.y, J.z};
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) p->stress[a][b] += p->sigma * ka[a] * Jb[b];
}

static void collide(gg_features f, gg_pairing *p, gg_pair *q, gg_vec k, gg_vec c12, double gn)
{
  if (f.rule != GG_SMOOTH) {
    q->sa = gg_block_get(p->one->s, q->a);
    q->sb = gg_block_get(p->two->s, q->b);
  }
  gg_vec g = gg_contact_velocity(f.rule, k, c12, q->sa, q->sb), J = gg_impulse(f.rule, &p->contact, k, g, gn);
  tally(f, p, k, g, J);
  gg_kick(f.rule, &p->contact, k, J, &q->ca, &q->sa, &q->cb, &q->sb);
  if (f.shear != GG_UNSHEARED) {
    q->ca.x += p->drift * q->ca.y;
    q->cb.x += p->drift * q->cb.y;
  }
  gg_block_set(p->one->c, q->a, q->ca);
  gg_block_set(p->two->c, q->b, q->cb);
  if (f.rule == GG_SMOOTH) return;
  gg_block_set(p->one->s, q->a, q->sa);
  gg_block_set(p->two->s, q->b, q->sb);
}

void gg_collide_plain(gg_features f, gg_pairing *p, gg_rng *rng)
{
  for (uint64_t i = 0; i < p->candidates; i++, p->drift += p->drift_step) {
    gg_pair q = choose(f, p, rng);
    gg_vec k = gg_rng_direction(rng), c12 = gg_sub(q.ca, q.cb);
    if (f.shear == GG_SHEARED_DENSE) c12.x -= p->shift * k.y;
    double gn = gg_dot(k, c12), over = gn - p->floor;
    if (gn > p->worst) p->worst = gn;
    if (over > p->bound) p->overflows++;
    if (gg_rng_uniform(rng) * p->bound >= over) continue;
    p->collisions++;
    collide(f, p, &q, k, c12, gn);
  }
}
