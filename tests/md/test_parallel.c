/* Proves: threads that share the events of one run leave every bit of it as it is: the state after so many collisions,
 * and the sums over them, are those of one thread, with two, three and four threads, in boxes with and without shear,
 * near collapse, however the run is cut. */
#include <stdlib.h>
#include <string.h>

#include "md/parallel/parallel.h"
#include "md_test.h"

enum { MOST_THREADS = 4 };

static const md_case cases[] = {
    {GG_EQUILIBRIUM, 6000, 0.3, 1, -1, INFINITY, {1, 1, 4}}, {GG_EQUILIBRIUM, 5000, 0.1, 1, 1, INFINITY, {1, 1, 4}},
    {GG_HCS, 6000, 0.3, 0.5, -1, INFINITY, {1, 1, 4}},       {GG_HCS, 6000, 0.2, 0.8, 0.5, 0.3, {1, 1, 4}},
    {GG_USF, 6000, 0.3, 0.9, 0, INFINITY, {1, 1, 4}},        {GG_USF, 6000, 0.38, 0.5, -1, INFINITY, {1, 1, 4}},
    {GG_USF, 5000, 0.15, 0.8, 0, INFINITY, {1, 1.2, 4}},
};
enum { CASES = sizeof cases / sizeof *cases };

static uint64_t mix(uint64_t h, const void *data, size_t bytes)
{
  const uint8_t *p = data;
  for (size_t k = 0; k < bytes; k++) h = (h ^ p[k]) * 0x100000001b3u;
  return h;
}

/* The state and the sums. */
static uint64_t hash_of(gg_md *e)
{
  gg_collision_sums sums;
  gg_md_ops.take_sums(&e->base, &sums);
  uint64_t h = mix(md_hash(e), &sums, sizeof sums);
  h = mix(h, &e->k.events, sizeof e->k.events);
  h = mix(h, &e->k.treated, sizeof e->k.treated);
  return mix(h, &e->k.worst_overlap, sizeof e->k.worst_overlap);
}

static uint64_t run(const gg_model *m, int threads, uint64_t collisions, uint64_t *shared)
{
  gg_md *e = md_create(m, 7);
  gg_md_ops.keep_sums(&e->base, true);
  gg_md_share(e, threads);
  assert_int_equal(threads > 1, e->parallel != NULL);
  md_collide(e, collisions);
  *shared = gg_md_shared_events(e);
  uint64_t h = hash_of(e);
  md_destroy(e);
  return h;
}

static void same_bits(void **state)
{
  (void)state;
  const char *asked = getenv("COLLISIONS");
  const uint64_t collisions = asked ? strtoull(asked, NULL, 10) : 100000;
  for (int k = 0; k < CASES; k++) {
    gg_model m = md_model(cases[k]);
    uint64_t shared, serial = run(&m, 1, collisions, &shared);
    for (int threads = 2; threads <= MOST_THREADS; threads++) {
      if (run(&m, threads, collisions, &shared) != serial) fail_msg("case %d, %d threads", k, threads);
      if (shared < collisions) fail_msg("case %d: %llu events shared", k, (unsigned long long)shared);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(same_bits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
