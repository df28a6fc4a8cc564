/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Relaxation of large periodic boxes: grains are pushed apart (place.c) along lists of pairs (pair_lists.h), which hold
 * for several sweeps, and only pairs that overlap or whose grains have just moved. Several threads run a sweep: each
 * part pushes its own pairs, then one thread pushes the pairs of different parts. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/thread_pool.h"
#include "md/start/pair_lists.h"

enum {
  LARGE = 50000,    /* fewest grains: positions of smaller systems are part of stored results */
  FEWEST_CELLS = 3, /* along an edge */
  LISTED_SWEEPS = 4 /* least number of sweeps with the same lists, while grains move too much for complete lists */
};
#define BEYOND 1.5 /* over-relaxation: pairs are pushed by so many times the distance needed, for fewer sweeps */
#define SKIN 0.25  /* in diameters of the widest grain */

/* Results of a part of a sweep, on a cache line of their own. */
typedef struct found {
  uint64_t overlaps;
  double farthest2; /* largest squared displacement since lists were made */
} __attribute__((aligned(64))) found;

typedef struct relaxation {
  gg_md_pair_lists lists;
  uint16_t *tried_to;  /* last sweep in which a grain is tested */
  uint16_t *pushed_to; /* last sweep in which grains in its margin are pushed away */
  uint16_t sweep;
  bool pushing; /* false: overlaps of all pairs are counted */
  bool all;     /* test all pairs, after incomplete lists were made anew */
  uint64_t overlaps;
  double farthest2;
  found part[GG_MD_PLACE_PARTS + 1]; /* the last one: pairs across parts */
} relaxation;

bool gg_md_place_has_lists(const gg_md_packing *p)
{
  const double widest = gg_common_model_widest(p->model), least = FEWEST_CELLS * widest * (1.02 + SKIN);
  for (int a = 0; a < 3; a++)
    if (p->box.inverse[a] == 0 || p->box.edge[a] < least) return false;
  return p->n >= LARGE && p->box.offset0 == 0 && p->model->n_surfaces == 0;
}

GG_INLINE void move(relaxation *x, found *f, uint32_t i, double by, gg_vec dr, bool overlaps)
{
  gg_vec *r = &x->lists.p->r[i];
  *r = gg_axpy(by, dr, *r);
  x->tried_to[i] = (uint16_t)(x->sweep + 1);
  if (overlaps) x->pushed_to[i] = (uint16_t)(x->sweep + 2);
  const gg_vec moved = gg_sub(*r, x->lists.before[i]);
  const double far2 = gg_dot(moved, moved);
  if (far2 > f->farthest2) f->farthest2 = far2;
}

GG_INLINE void push_pair(relaxation *x, found *f, uint32_t i, uint32_t j)
{
  gg_md_packing *p = x->lists.p;
  gg_vec dr = gg_sub(p->r[j], p->r[i]), unused = {0, 0, 0};
  gg_md_minimum_image(&p->box, false, 0, &dr, &unused);
  const double sigma = 0.5 * (p->diameter[i] + p->diameter[j]), wanted = sigma * (1 + x->lists.margin);
  const double r2 = gg_dot(dr, dr);
  if (r2 >= wanted * wanted) return;
  double distance = sqrt(r2);
  const bool overlaps = distance < sigma * (1 + GG_MD_TOUCHING);
  f->overlaps += overlaps;
  if (!x->pushing || !(overlaps || x->pushed_to[i] >= x->sweep || x->pushed_to[j] >= x->sweep)) return;
  if (distance == 0) dr = (gg_vec){1e-3, 0, 0}, distance = 1e-3;
  const double push = 0.5 * BEYOND * (wanted - distance) / distance;
  move(x, f, i, -push, dr, overlaps);
  move(x, f, j, push, dr, overlaps);
}

static bool is_tried(const relaxation *x, uint32_t i)
{
  return x->all || !x->pushing || x->tried_to[i] >= x->sweep;
}

static void sweep_part(void *context, int k)
{
  relaxation *x = context;
  const gg_md_pair_part *part = &x->lists.part[k];
  found *f = &x->part[k];
  *f = (found){0};
  for (uint32_t i = part->first; i < part->end; i++) {
    const bool polls = i == part->first || i % GG_MD_PLACE_PER_POLL == 0;
    if (polls && gg_md_place_is_stopped(x->lists.p)) return;
    const bool tried = is_tried(x, i);
    const size_t *from = &part->from[i - part->first];
    for (size_t m = from[0]; m < from[1]; m++) {
      const uint32_t j = part->neighbour[m];
      if (tried || is_tried(x, j)) push_pair(x, f, i, j);
    }
  }
}

static void sweep_across(relaxation *x)
{
  found *f = &x->part[GG_MD_PLACE_PARTS];
  *f = (found){0};
  for (int k = 0; k < GG_MD_PLACE_PARTS; k++) {
    const gg_md_pair_part *part = &x->lists.part[k];
    for (size_t m = 0; m < part->n_across; m++) {
      const uint32_t i = part->across[m][0], j = part->across[m][1];
      if (is_tried(x, i) || is_tried(x, j)) push_pair(x, f, i, j);
    }
  }
}

static gg_status sweep(relaxation *x, int number, bool pushing, gg_error *err)
{
  x->sweep = (uint16_t)number;
  x->pushing = pushing;
  x->overlaps = 0;
  gg_base_thread_pool_for(x->lists.p->pool, GG_MD_PLACE_PARTS, sweep_part, x);
  if (x->lists.p->stopped) return gg_md_place_interrupted(err);
  sweep_across(x);
  for (int k = 0; k <= GG_MD_PLACE_PARTS; k++) {
    x->overlaps += x->part[k].overlaps;
    x->farthest2 = fmax(x->farthest2, x->part[k].farthest2);
  }
  return GG_OK;
}

/* True if the lists are complete: no grain has moved so far that a pair may be missing. */
static bool are_complete(const relaxation *x)
{
  return x->farthest2 <= 0.25 * x->lists.skin * x->lists.skin;
}

static gg_status make_lists(relaxation *x, gg_error *err)
{
  x->farthest2 = 0;
  return gg_md_pair_lists_fill(&x->lists, err);
}

static gg_status relax(relaxation *x, int most_sweeps, bool *free, gg_error *err)
{
  x->farthest2 = INFINITY;
  for (int k = 0, age = 0; k < most_sweeps && !*free; k++, age++) {
    x->all = !are_complete(x) && (k == 0 || age >= LISTED_SWEEPS || x->overlaps == 0);
    if (x->all) GG_TRY(make_lists(x, err));
    if (x->all) age = 0;
    GG_TRY(sweep(x, k, true, err));
    if (x->overlaps || !are_complete(x)) continue;
    GG_TRY(sweep(x, k, false, err));
    *free = x->overlaps == 0;
  }
  return GG_OK;
}

gg_status gg_md_place_relax_lists(gg_md_packing *p, double margin, int most_sweeps, bool *is_free, gg_error *err)
{
  relaxation x = {.tried_to = gg_base_array_new(p->n, sizeof *x.tried_to, err),
                  .pushed_to = gg_base_array_new(p->n, sizeof *x.pushed_to, err)};
  gg_status status = gg_md_pair_lists_make(&x.lists, p, margin, SKIN * gg_common_model_widest(p->model), err);
  if (!x.tried_to || !x.pushed_to) status = GG_FAILED;
  *is_free = false;
  if (status == GG_OK) status = relax(&x, most_sweeps, is_free, err);
  for (uint32_t i = 0; i < p->n; i++) gg_md_place_into_box(p, i);
  gg_md_pair_lists_free(&x.lists);
  free(x.tried_to);
  free(x.pushed_to);
  return status;
}
