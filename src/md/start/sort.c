/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sorting of centres along a space-filling curve (Morton order): grains near in space are near in memory. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/thread_pool.h"
#include "md/start/place.h"

/* Spread the low 21 bits of x to every third bit. */
static uint64_t spread(uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

typedef struct keyed {
  uint64_t key;
  uint32_t id;
} keyed;

static int by_key(const void *a, const void *b)
{
  uint64_t x = ((const keyed *)a)->key, y = ((const keyed *)b)->key;
  return (x > y) - (x < y);
}

/* Merge two sorted parts, of `middle` and `end - middle` items; equal items stay in their order. */
static void merge(const keyed *from, uint32_t middle, uint32_t end, keyed *to)
{
  for (uint32_t i = 0, j = middle, k = 0; k < end; k++)
    to[k] = j == end || (i < middle && from[i].key <= from[j].key) ? from[i++] : from[j++];
}

static uint32_t lesser(uint64_t a, uint64_t b)
{
  return (uint32_t)(a < b ? a : b);
}

enum {
  PORTION = 1 << 15, /* items sorted between polls of `stop`: some milliseconds */
  PARTS = 16         /* portions and merges are distributed to so many parts, for several threads */
};

typedef struct sorting {
  gg_md_packing *p;
  keyed *from, *to;
  uint64_t length; /* of sorted portions */
} sorting;

/* Poll `stop`, except in systems of one portion. */
static bool is_stopped(const sorting *s)
{
  return s->p->n > PORTION && gg_md_place_is_stopped(s->p);
}

static void sort_portions(void *context, int k)
{
  const sorting *s = context;
  const uint64_t n = s->p->n;
  for (uint64_t at = (uint64_t)k * PORTION; at < n && !is_stopped(s); at += PARTS * PORTION)
    qsort(s->from + at, lesser(n - at, PORTION), sizeof *s->from, by_key);
}

static void merge_portions(void *context, int k)
{
  const sorting *s = context;
  const uint64_t n = s->p->n, both = 2 * s->length;
  for (uint64_t at = (uint64_t)k * both; at < n && !is_stopped(s); at += PARTS * both)
    merge(s->from + at, lesser(n - at, s->length), lesser(n - at, both), s->to + at);
}

/* Sort portions and merge them; the result is in s->from. */
static void sort(sorting *s)
{
  gg_base_thread_pool_for(s->p->pool, PARTS, sort_portions, s);
  for (s->length = PORTION; s->length < s->p->n; s->length *= 2) {
    gg_base_thread_pool_for(s->p->pool, PARTS, merge_portions, s);
    keyed *other = s->from;
    s->from = s->to, s->to = other;
  }
}

gg_status gg_md_place_sort(gg_md_packing *p, uint32_t *id, gg_error *err)
{
  const double *edge = p->box.edge, scale = 0x1p21 / fmax(edge[0], fmax(edge[1], edge[2]));
  keyed *room = gg_base_array_new(2 * (size_t)p->n, sizeof *room, err);
  gg_vec *r = gg_base_array_new(p->n, sizeof *r, err);
  const bool made = room && r;
  for (uint32_t i = 0; made && i < p->n; i++) {
    uint64_t key = 0;
    for (int a = 0; a < 3; a++) key |= spread((uint64_t)(gg_along(&p->r[i], a) * scale)) << a;
    room[i] = (keyed){key, i};
    r[i] = p->r[i];
  }
  sorting s = {p, room, room + p->n, 0};
  if (made) sort(&s);
  const bool whole = made && !is_stopped(&s);
  for (uint32_t i = 0; whole && i < p->n; i++) {
    p->r[i] = r[s.from[i].id];
    if (id) id[i] = s.from[i].id;
  }
  free(room);
  free(r);
  if (!made) return GG_FAILED;
  return whole ? GG_OK : gg_md_place_interrupted(err);
}
