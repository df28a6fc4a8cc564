/* Proves: given the engine's own state after each event, a plain search over all images of all pairs names the same
 * next collision (pair, and time to 10^-10 of a mean free time), over hundreds of random small systems: periodic and
 * sheared, smooth, rough and frictional, dilute and dense, cubic and not. And no two grains ever overlap. */
#include "md_test.h"

static void follow(md_case c, uint64_t seed, int warm, int events)
{
  gg_model m = md_model(c);
  gg_md *e = md_create(&m, seed);
  uint32_t before[64];
  assert_true(c.n <= 64);
  md_collide(e, (uint64_t)warm);
  for (int k = 0; k < events; k++) {
    gg_md was = *e;
    gg_grain grains[64];
    for (uint32_t i = 0; i < e->n; i++) grains[i] = e->grain[i], before[i] = e->grain[i].stamp;
    double elapsed = md_collide(e, 1), horizon = elapsed * 1.000001;
    was.grain = grains;
    uint32_t pair[3], n = 0;
    for (uint32_t i = 0; i < e->n && n < 3; i++)
      if (e->grain[i].stamp != before[i]) pair[n++] = i;
    assert_int_equal(n, 2);
    md_forecast f = md_oracle(&was, horizon);
    double tolerance = 1e-10 * e->k.free_time;
    if (!(fabsl(f.time - elapsed) < tolerance) ||
        !(fabsl(md_oracle_pair(&was, pair[0], pair[1], horizon) - elapsed) < tolerance))
      fail_msg("n %d phi %g flow %d seed %d event %d: engine (%u, %u) after %.17g, plain search (%u, %u) after %.17Lg",
               (int)c.n, c.phi, (int)c.flow, (int)seed, k, pair[0], pair[1], elapsed, f.pair[0], f.pair[1], f.time);
  }
  assert_true(md_closest(e) > 1 - 1e-12L);
  md_destroy(e);
}

static md_case random_case(gg_rng *rng, gg_flow flow)
{
  static const double betas[] = {-1, 0, 0.5, 1}, mus[] = {INFINITY, INFINITY, 0.1, 0.5};
  md_case c = {.flow = flow};
  c.phi = pow(10, -2 + 1.74 * gg_rng_uniform(rng));
  c.e = 0.6 + 0.1 * gg_rng_below(rng, 5);
  c.beta = betas[gg_rng_below(rng, 4)];
  c.mu = mus[gg_rng_below(rng, 4)];
  for (int a = 0; a < 3; a++) c.aspect[a] = 1 + 0.6 * gg_rng_uniform(rng);
  double least = c.aspect[0] < c.aspect[1] ? c.aspect[0] : c.aspect[1];
  if (c.aspect[2] < least) least = c.aspect[2];
  double fewest = 8.1 * c.phi / (M_PI / 6) * c.aspect[0] * c.aspect[1] * c.aspect[2] / (least * least * least);
  c.n = 2 + (int64_t)fewest + gg_rng_below(rng, 12);
  return c;
}

static void many(gg_flow flow, int systems, uint64_t seed)
{
  gg_rng rng = gg_rng_seed(seed, 7);
  for (int k = 0; k < systems;) {
    md_case c = random_case(&rng, flow);
    if (c.n > 64) continue;
    follow(c, seed + (uint64_t)k++, 60, 40);
  }
}

static void periodic(void **state)
{
  (void)state, many(GG_HCS, 120, 100);
}
static void sheared(void **state)
{
  (void)state, many(GG_USF, 150, 200);
}

static void dense(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 4; seed++) {
    follow((md_case){GG_EQUILIBRIUM, 40, 0.55, 1, -1, INFINITY, {0}}, seed, 400, 50);
    follow((md_case){GG_USF, 40, 0.52, 0.8, 0, INFINITY, {0}}, seed, 400, 50);
  }
}

/* Two to four grains: every image counts. */
static void few_grains(void **state)
{
  (void)state;
  for (int64_t n = 2; n <= 4; n++)
    for (uint64_t seed = 1; seed <= 3; seed++) {
      follow((md_case){GG_HCS, n, 0.02 * (double)n, 0.9, 0, INFINITY, {0}}, seed, 3, 30);
      follow((md_case){GG_USF, n, 0.06, 0.9, 0, INFINITY, {0}}, seed, 3, 30);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(periodic), cmocka_unit_test(sheared), cmocka_unit_test(dense),
                                     cmocka_unit_test(few_grains)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
