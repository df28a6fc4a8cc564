/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Centres in the order of a space-filling curve: those that are near in space are near in memory. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
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
  gg_vec r;
  uint32_t id;
} keyed;

static int by_key(const void *a, const void *b)
{
  uint64_t x = ((const keyed *)a)->key, y = ((const keyed *)b)->key;
  return (x > y) - (x < y);
}

/* Merge two sorted neighbours, `middle` and `end - middle` of them; equal ones stay in their order. */
static void merge(const keyed *from, uint32_t middle, uint32_t end, keyed *to)
{
  for (uint32_t i = 0, j = middle, k = 0; k < end; k++)
    to[k] = j == end || (i < middle && from[i].key <= from[j].key) ? from[i++] : from[j++];
}

static uint32_t lesser(uint32_t a, uint32_t b)
{
  return a < b ? a : b;
}

enum { PORTION = 1 << 15 }; /* sorted between two looks at whether to stop: some milliseconds */

/* In portions, which are merged; where it ends in *sorted, of the two. */
static bool sort(keyed *a, keyed *b, uint32_t n, const gg_stop *stop, const keyed **sorted)
{
  for (uint32_t at = 0; at < n; at += PORTION) {
    if (at > 0 && gg_stop_asked(stop)) return false;
    qsort(a + at, lesser(n - at, PORTION), sizeof *a, by_key);
  }
  for (uint32_t length = PORTION; length < n; length *= 2) {
    for (uint32_t at = 0; at < n; at += 2 * length) {
      if (gg_stop_asked(stop)) return false;
      merge(a + at, lesser(n - at, length), lesser(n - at, 2 * length), b + at);
    }
    keyed *other = a;
    a = b, b = other;
  }
  *sorted = a;
  return true;
}

gg_status gg_md_place_sort(const gg_md_box *box, gg_vec *r, uint32_t *id, uint32_t n, const gg_stop *stop,
                           gg_error *err)
{
  keyed *room = gg_base_array_new(2 * (size_t)n, sizeof *room, err);
  const keyed *sorted;
  if (!room) return GG_FAILED;
  double longest = fmax(box->edge[0], fmax(box->edge[1], box->edge[2])), scale = 0x1p21 / longest;
  for (uint32_t i = 0; i < n; i++) {
    uint64_t key = 0;
    for (int a = 0; a < 3; a++) key |= spread((uint64_t)(gg_along(&r[i], a) * scale)) << a;
    room[i] = (keyed){key, r[i], i};
  }
  bool whole = sort(room, room + n, n, stop, &sorted);
  for (uint32_t i = 0; whole && i < n; i++) {
    r[i] = sorted[i].r;
    if (id) id[i] = sorted[i].id;
  }
  free(room);
  return whole ? GG_OK : gg_base_fail(err, GG_INTERRUPTED, "md: interrupted while grains were placed");
}
