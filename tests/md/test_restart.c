/* Proves: a run saved and restored goes on bit for bit, and saving does not disturb it; a run cut into advances of any
 * length has the same trajectory; rescaling by powers of two is exact. */
#include "md_test.h"

static const md_case cases[] = {
    {GG_USF, 200, 0.3, 0.9, 0, INFINITY, {0}},        {GG_USF, 200, 0.02, 0.8, 0.5, 0.3, {0}},
    {GG_HCS, 200, 0.5, 0.9, -1, INFINITY, {0}},       {GG_EQUILIBRIUM, 200, 0.1, 1, -1, INFINITY, {0}},
    {GG_HCS, 200, 0.2, 0.95, 0.8, INFINITY, {0}},     {GG_HCS, 400, 0.01, 0.9, -1, INFINITY, {0}},
    {GG_USF, 700, 0.01, 0.9, 0, INFINITY, {2, 1, 1}},
};
enum { CASES = sizeof cases / sizeof *cases };

static void saved_and_restored(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k++) {
    gg_model m = md_model(cases[k]);
    gg_md *e = md_create(&m, 1);
    gg_engine *back = NULL;
    gg_archive a = {0};
    gg_error err;
    gg_md_ops.keep_sums(&e->base, true);
    md_collide(e, 7777);
    uint64_t before = md_hash(e);
    assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
    assert_int_equal(before, md_hash(e));
    assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_OK);
    gg_archive_clear(&a);
    md_collide(e, 20000);
    md_collide((gg_md *)back, 20000);
    gg_collision_sums one, two;
    gg_md_ops.take_sums(&e->base, &one);
    gg_md_ops.take_sums(back, &two);
    assert_int_equal(md_hash(e), md_hash((gg_md *)back));
    assert_memory_equal(&one, &two, sizeof one);
    md_destroy(e);
    md_destroy((gg_md *)back);
  }
}

static void cut_anywhere(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k++) {
    gg_model m = md_model(cases[k]);
    gg_md *whole = md_create(&m, 2), *cut = md_create(&m, 2);
    gg_rng rng = gg_rng_seed(4, 0);
    gg_error err;
    double elapsed, total = 0, straight = md_collide(whole, 30000);
    while (cut->k.collisions < 30000) {
      uint64_t left = 30000 - cut->k.collisions, few = 1 + gg_rng_below(&rng, 200);
      double dt = gg_rng_uniform(&rng) * 20 * whole->k.mean_free_time / (double)m.n;
      assert_int_equal(gg_md_ops.advance(&cut->base, dt, few < left ? few : left, &elapsed, &err), GG_OK);
      assert_true(elapsed <= dt);
      total += elapsed;
    }
    assert_int_equal(md_hash(whole), md_hash(cut));
    assert_true(fabs(total - straight) < 1e-9 * straight);
    md_destroy(whole);
    md_destroy(cut);
  }
}

/* Up by 2^p at random moments and down again is the same run. */
static void rescaled(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k++) {
    gg_model m = md_model(cases[k]);
    if (m.shear_rate != 0) continue;
    gg_md *plain = md_create(&m, 2), *scaled = md_create(&m, 2);
    gg_error err;
    md_collide(plain, 20000);
    for (int part = 0; part < 20; part++) {
      assert_int_equal(gg_md_ops.rescale(&scaled->base, part % 2 ? -3 : 3, &err), GG_OK);
      md_collide(scaled, 1000);
    }
    assert_int_equal(md_hash(plain), md_hash(scaled));
    md_destroy(plain);
    md_destroy(scaled);
  }
  gg_model m = md_model(cases[0]);
  gg_md *e = md_create(&m, 2);
  gg_error err;
  assert_int_equal(gg_md_ops.rescale(&e->base, 1, &err), GG_BAD_INPUT);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(saved_and_restored), cmocka_unit_test(cut_anywhere),
                                     cmocka_unit_test(rescaled)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
