/* Proves: under 10^6 random insertions, removals, re-schedulings and pops the calendar gives the same order as a
 * sorted list, with events in the present bucket, ties, events beyond the epoch and never. */
#include <stdlib.h>

#include "md_test.h"

enum { N = 200, OPERATIONS = 1000000 };

typedef struct both {
  gg_queue queue;
  gg_node node[N];
  bool there[N];
  gg_rng rng;
  double now;
} both;

static uint32_t earliest(const both *b)
{
  uint32_t first = GG_NONE;
  for (uint32_t i = 0; i < N; i++)
    if (b->there[i] && (first == GG_NONE || b->node[i].time < b->node[first].time)) first = i;
  return first;
}

/* Ties on purpose, some soon, some beyond the epoch, some never. */
static double random_time(both *b)
{
  uint32_t kind = gg_rng_below(&b->rng, 20);
  if (kind == 0) return INFINITY;
  if (kind == 1) return b->now;
  if (kind < 5) return b->now + 0x1p-10 * gg_rng_below(&b->rng, 8);
  return b->now + gg_rng_uniform(&b->rng) * (kind < 15 ? 0.3 : 300);
}

static void insert(both *b, uint32_t i)
{
  b->node[i].time = random_time(b);
  gg_queue_insert(&b->queue, b->node, i);
  b->there[i] = true;
}

static void next_epoch(both *b)
{
  double span = gg_queue_span(&b->queue);
  b->now = 0;
  for (uint32_t i = 0; i < N; i++) b->node[i].time -= span;
  gg_queue_reset(&b->queue, b->queue.width);
  for (uint32_t i = 0; i < N; i++)
    if (b->there[i]) gg_queue_insert(&b->queue, b->node, i);
}

/* The next event of both, or an epoch's end. */
static void pop(both *b)
{
  uint32_t first = earliest(b);
  if (!gg_queue_turn(&b->queue, b->node)) {
    assert_true(first == GG_NONE || b->node[first].time >= gg_queue_span(&b->queue));
    next_epoch(b);
    return;
  }
  gg_due due = b->queue.due[b->queue.n_due - 1];
  assert_int_equal(due.grain, first);
  assert_true(due.time == b->node[first].time && due.time >= b->now);
  b->now = due.time;
  gg_queue_remove(&b->queue, b->node, first);
  b->there[first] = false;
}

static void same_order_as_sorted_list(void **state)
{
  (void)state;
  both *b = calloc(1, sizeof *b);
  gg_error err;
  b->rng = gg_rng_seed(1, 0);
  assert_int_equal(gg_queue_make(&b->queue, N, &err), GG_OK);
  gg_queue_reset(&b->queue, 0x1p-4);
  for (int k = 0; k < OPERATIONS; k++) {
    uint32_t i = gg_rng_below(&b->rng, N), what = gg_rng_below(&b->rng, 3);
    if (what == 0) {
      pop(b);
    } else if (!b->there[i]) {
      insert(b, i);
    } else {
      gg_queue_remove(&b->queue, b->node, i);
      b->there[i] = false;
      if (what == 1) insert(b, i);
    }
  }
  gg_queue_free(&b->queue);
  free(b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(same_order_as_sorted_list)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
