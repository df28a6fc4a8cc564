/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of a batch of candidates at a time (predict.h): the earliest contact of a list. */
#ifndef GG_MD_SEARCH_SIMD_PAIRS_H
#define GG_MD_SEARCH_SIMD_PAIRS_H

#include "md/predict.h"
#include "md/search/search.h"

/* Cases of the minimum-image convention for candidates: a constant in each copy of the search. */
typedef enum gg_md_images {
  GG_MD_SAME,    /* candidates in the same image of the box; in moving rows, but for images along x */
  GG_MD_AT_REST, /* any image, none of which has moved */
  GG_MD_MOVING   /* across the sheared boundary: images move by the offset and have another velocity */
} gg_md_images;

/* Force the compiler to load through a pointer where the value is used: a constant in all lanes of a register would
 * displace other values. */
#define GG_RELOAD(pointer) __asm__("" : "+r"(pointer))

_Static_assert((int)GG_MAX_SPECIES <= (int)GG_LOOK_UP, "a batch looks species up in a table of this size");

/* Contact quadratic of a batch of grains of a list with grain g, for the nearest images. */
GG_INLINE gg_md_quadratic gg_md_try_batch(const gg_md *e, const gg_md_grain *g, const uint32_t *list,
                                          gg_md_images images, double offset)
{
  const double *L = e->box.edge, *inverse = e->box.inverse, *sigma2 = e->contacts.sigma2;
  GG_RELOAD(L);
  GG_RELOAD(inverse);
  GG_RELOAD(sigma2);
  gg_md_batch b = gg_md_gather(e->grain, list);
  gg_vd dt = e->k.now - b.t;
  gg_vd x = b.x + dt * b.vx - g->r.x, y = b.y + dt * b.vy - g->r.y, z = b.z + dt * b.vz - g->r.z;
  gg_vd vx = b.vx - g->v.x, vy = b.vy - g->v.y, vz = b.vz - g->v.z;
  if (HAS_GRAVITY) {
    gg_vd half = 0.5 * dt * dt;
    x = (b.x + dt * b.vx + half * e->gravity.x) - g->r.x, vx = (b.vx + dt * e->gravity.x) - g->v.x;
    y = (b.y + dt * b.vy + half * e->gravity.y) - g->r.y, vy = (b.vy + dt * e->gravity.y) - g->v.y;
    z = (b.z + dt * b.vz + half * e->gravity.z) - g->r.z, vz = (b.vz + dt * e->gravity.z) - g->v.z;
  }
  if (ROWS_MOVE && images != GG_MD_MOVING) { /* separations may be several edges: gg_batch_fold would not be exact */
    x -= L[0] * gg_batch_nearest(x * inverse[0]);
  } else if (images == GG_MD_MOVING) {
    gg_vd layers = gg_batch_nearest(y * inverse[1]);
    y -= L[1] * layers;
    x -= layers * offset;
    x -= L[0] * gg_batch_nearest(x * inverse[0]);
    vx -= layers * e->box.image_velocity;
  } else if (images == GG_MD_AT_REST) {
    x = gg_batch_fold(x, L[0], inverse[0]);
  }
  if (images == GG_MD_AT_REST) y = gg_batch_fold(y, L[1], inverse[1]);
  if (images != GG_MD_SAME) z = gg_batch_fold(z, L[2], inverse[2]);
  gg_vd touch2 = gg_all(sigma2[0]);
  if (IS_MIXTURE) {
    int species = gg_md_species_of(g);
    const double *row = sigma2 + gg_md_pair(&e->contacts, species, 0);
    touch2 = e->contacts.n_species == 2 ? gg_select(gg_low_bit((gg_vu)b.tag), gg_all(row[1]), gg_all(row[0]))
                                        : gg_batch_look_up(row, b.tag);
  }
  return gg_md_batch_quadratic(x, y, z, vx, vy, vz, touch2);
}

/* Take the exact contact of one lane, with grain `who`. */
GG_INLINE void gg_md_take_lane(const gg_md *e, gg_md_search *s, const gg_md_quadratic *q, uint32_t lane, uint32_t who)
{
  double delay = q->c[lane] / (sqrt(q->discriminant[lane]) - q->b[lane]);
  gg_md_take_contact(s, e->k.now + (delay > 0 ? delay : 0), who);
}

GG_INLINE gg_vi gg_md_batch_who(const uint32_t *list)
{
  return __builtin_convertvector(*(const gg_list *)list, gg_vi);
}

/* Earliest contacts of several batches, by lane: estimates of the first, labelled by its place in the list, and of the
 * second; and the quadratic of the first. */
typedef struct gg_md_foremost {
  gg_vd soonest, second;
  gg_md_quadratic q;
} gg_md_foremost;

GG_INLINE void gg_md_compare_batch(gg_md_foremost *best, gg_md_quadratic q, gg_vi place)
{
  gg_vd soon = gg_batch_label(gg_md_batch_how_soon(q), place);
  gg_mask sooner = gg_less(best->soonest, soon);
  best->second = gg_larger(best->second, gg_smaller(soon, best->soonest));
  best->soonest = gg_larger(soon, best->soonest);
  best->q.b = gg_select(sooner, q.b, best->q.b);
  best->q.c = gg_select(sooner, q.c, best->q.c);
  best->q.discriminant = gg_select(sooner, q.discriminant, best->q.discriminant);
}

GG_INLINE double gg_md_offset_of_images(const gg_md *e, gg_md_images images)
{
  return images == GG_MD_MOVING ? gg_md_offset(&e->box, e->k.now) : 0;
}

typedef struct gg_md_contact {
  double time;
  int64_t partner;
} gg_md_contact;

/* Earliest contact of grain g with the grains of a list, all computed exactly. A call, because it is rare, and without
 * the search as argument, which then stays in registers. */
static __attribute__((noinline, unused)) gg_md_contact
gg_md_exact_contact(const gg_md *e, const gg_md_grain *g, const uint32_t *list, uint32_t count, gg_md_images images)
{
  const double offset = gg_md_offset_of_images(e, images);
  gg_md_contact first = {INFINITY, GG_MD_NONE};
  for (uint32_t k = 0; k < count; k += GG_WIDTH) {
    const gg_md_quadratic q = gg_md_try_batch(e, g, list + k, images, offset);
    gg_md_contact c;
    c.time = gg_batch_earliest(e->k.now + gg_md_batch_delay(q), gg_md_batch_who(list + k), &c.partner);
    if (c.time < first.time || (c.time == first.time && c.partner < first.partner)) first = c;
  }
  return first;
}

/* True if the estimates that may be the earliest, by lane of best->soonest, belong to this grain alone. */
GG_INLINE bool gg_md_are_copies(const gg_md_foremost *best, uint32_t lanes, const uint32_t *list, uint32_t grain)
{
  for (; lanes; lanes &= lanes - 1)
    if (list[gg_label_of(best->soonest[__builtin_ctz(lanes)])] != grain) return false;
  return true;
}

/* Take the earliest contact with the grains of a list, which is filled up to a whole batch with the grain at
 * position NaN. Estimates select the earliest contact; if they leave doubt, all contacts are computed exactly. */
GG_INLINE void gg_md_try_list(const gg_md *e, gg_md_search *s, const uint32_t *list, uint32_t count,
                              gg_md_images images)
{
  const double offset = gg_md_offset_of_images(e, images);
  gg_vd never = gg_all(0);
  gg_md_foremost best = {never, never, {never, never, never}};
  gg_vi place = gg_batch_places();
  for (uint32_t k = 0; k < count; k += GG_WIDTH, place += GG_WIDTH) {
    gg_md_quadratic q = gg_md_try_batch(e, s->self, list + k, images, offset);
    if (FEW_MEET && !gg_any(gg_md_batch_meets(q))) continue;
    gg_md_compare_batch(&best, q, place);
  }
  gg_vd first = gg_batch_greatest(best.soonest);
  if (!(first[0] >= GG_MD_SOON_AT_ALL)) return;
  uint32_t at = gg_label_of(first[0]), lane = at % GG_WIDTH;
  gg_vd limit = (1 - 4 * GG_MD_ABOUT) * first;
  uint32_t lanes = gg_bits(gg_not_above(limit, best.soonest));
  bool alone = !(lanes & (lanes - 1)) || (HAS_COPIES && gg_md_are_copies(&best, lanes, list, list[at]));
  if (__builtin_expect(alone && first[0] < GG_MD_AT_ONCE && !gg_any(gg_not_above(limit, best.second)), 1)) {
    gg_md_take_lane(e, s, &best.q, lane, list[at]);
    return;
  }
  const gg_md_contact exact = gg_md_exact_contact(e, s->self, list, count, images);
  gg_md_take_contact(s, exact.time, exact.partner);
}

/* Test the gathered candidates. One store fills them up. */
GG_INLINE void gg_md_try_candidates(const gg_md *e, gg_md_search *s)
{
  *(gg_list *)(s->candidates + s->n_candidates) = e->n + (gg_list){0};
  if (KNOWS_IMAGES && s->inside)
    gg_md_try_list(e, s, s->candidates, s->n_candidates, GG_MD_SAME);
  else if (!IS_SHEARED || (ROWS_MOVE && s->regular))
    gg_md_try_list(e, s, s->candidates, s->n_candidates, GG_MD_AT_REST);
  else
    gg_md_try_list(e, s, s->candidates, s->n_candidates, GG_MD_MOVING);
}

#endif
