/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: over 10^7 random insertions, half of them deferred, removals, re-schedulings and pops the event queue has the
 * order of a sorted list, with events in the current bucket, ties, events after the epoch, and events at infinity. The
 * sorted list is an array of all events with bisection, which shares nothing with the event queue. */
#include <stdlib.h>
#include <string.h>

#include "md_test.h"

enum { N = 200, OPERATIONS = 10000000 };

typedef struct both {
  gg_md_queue queue;
  gg_md_node node[N];
  bool there[N];
  gg_md_due sorted[N]; /* earliest first; equal times by index */
  uint32_t n_sorted;
  gg_rng rng;
  double now;
  int deferred; /* insertions that may not be stored yet */
} both;

static bool is_before(gg_md_due a, gg_md_due b)
{
  return a.time < b.time || (a.time == b.time && a.grain < b.grain);
}

/* The index in the sorted list at which an event is, or would be inserted. */
static uint32_t rank_of(const both *b, gg_md_due due)
{
  uint32_t low = 0, high = b->n_sorted;
  while (low < high) {
    uint32_t middle = (low + high) / 2;
    if (is_before(b->sorted[middle], due))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static void sorted_insert(both *b, gg_md_due due)
{
  uint32_t k = rank_of(b, due);
  memmove(&b->sorted[k + 1], &b->sorted[k], (b->n_sorted++ - k) * sizeof due);
  b->sorted[k] = due;
}

static void sorted_remove(both *b, gg_md_due due)
{
  uint32_t k = rank_of(b, due);
  assert_true(k < b->n_sorted && b->sorted[k].grain == due.grain);
  memmove(&b->sorted[k], &b->sorted[k + 1], (--b->n_sorted - k) * sizeof due);
}

/* Some times are ties, some are soon, some after the epoch, some infinite. */
static double random_time(both *b)
{
  uint32_t kind = gg_rng_below(&b->rng, 20);
  if (kind == 0) return INFINITY;
  if (kind == 1) return b->now;
  if (kind < 5) return b->now + 0x1p-10 * gg_rng_below(&b->rng, 8);
  return b->now + gg_rng_uniform(&b->rng) * (kind < 15 ? 0.3 : 300);
}

static void store(both *b)
{
  gg_md_queue_store_pending(&b->queue, b->node);
  b->deferred = 0;
}

static void insert(both *b, uint32_t i)
{
  b->node[i].time = random_time(b);
  if (b->deferred == GG_MD_PENDING) store(b);
  if (gg_rng_below(&b->rng, 2))
    gg_md_queue_insert(&b->queue, b->node, i);
  else
    gg_md_queue_defer(&b->queue, b->node, i, b->deferred++);
  sorted_insert(b, (gg_md_due){b->node[i].time, i});
  b->there[i] = true;
}

static void take_out(both *b, uint32_t i)
{
  store(b);
  gg_md_queue_remove(&b->queue, b->node, i);
  sorted_remove(b, (gg_md_due){b->node[i].time, i});
  b->there[i] = false;
}

/* Starts an epoch: times are counted from it, and all events are inserted again in another order. */
static void next_epoch(both *b)
{
  double span = gg_md_queue_span(&b->queue);
  b->now = 0;
  b->deferred = 0;
  b->n_sorted = 0;
  for (uint32_t i = 0; i < N; i++) b->node[i].time -= span;
  gg_md_queue_reset(&b->queue, b->queue.width);
  for (uint32_t i = N; i-- > 0;) {
    if (!b->there[i]) continue;
    gg_md_queue_insert(&b->queue, b->node, i);
    sorted_insert(b, (gg_md_due){b->node[i].time, i});
  }
}

/* Takes the next event from both, or begins the next epoch. */
static void pop(both *b)
{
  if (!gg_md_queue_next_bucket(&b->queue, b->node)) {
    assert_true(b->n_sorted == 0 || b->sorted[0].time >= gg_md_queue_span(&b->queue));
    next_epoch(b);
    return;
  }
  gg_md_due due = b->queue.due[b->queue.n_due - 1];
  assert_true(b->n_sorted > 0 && due.grain == b->sorted[0].grain && due.time == b->sorted[0].time);
  assert_true(due.time >= b->now);
  b->now = due.time;
  take_out(b, due.grain);
}

static void the_queue_has_the_order_of_a_sorted_list(void **state)
{
  (void)state;
  both *b = calloc(1, sizeof *b);
  gg_error err;
  b->rng = gg_common_rng_seed(1, 0);
  assert_int_equal(gg_md_queue_make(&b->queue, N, &err), GG_OK);
  gg_md_queue_reset(&b->queue, 0x1p-4);
  for (int k = 0; k < OPERATIONS; k++) {
    uint32_t i = gg_rng_below(&b->rng, N), what = gg_rng_below(&b->rng, 3);
    if (what == 0) {
      pop(b);
    } else if (!b->there[i]) {
      insert(b, i);
    } else {
      take_out(b, i);
      if (what == 1) insert(b, i);
    }
  }
  gg_md_queue_free(&b->queue);
  free(b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_queue_has_the_order_of_a_sorted_list)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
