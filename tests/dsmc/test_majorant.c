/* A bound that is too low is noticed, counted and made up for: forced down before every step, it changes neither the
 * collision rate nor the energy that collisions destroy. */
#include "dsmc/dsmc.h"
#include "lab.h"

static void run(double forced, lab_mean *rate, lab_mean *loss, uint64_t *overflows)
{
  gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.2, 1, -1, 2000);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 17);
  gg_dsmc_ops.tap(g, true);
  gg_transfer t;
  for (int b = 0; b < 20; b++) {
    double time = 0;
    for (int i = 0; i < 150; i++) {
      if (forced > 0) {
        gg_dsmc *d = (gg_dsmc *)g;
        for (int p = 0; p < GG_PAIRS; p++) d->now.majorant[p] = (gg_majorant){.before = forced};
      }
      time += lab_advance(g, INFINITY, 250);
    }
    gg_dsmc_ops.read_tap(g, &t);
    double trace = t.stress[0][0][0] + t.stress[0][1][1] + t.stress[0][2][2];
    lab_add(rate, 2 * (double)t.collisions[0] / (time * (double)m.n));
    lab_add(loss, trace / (time * m.volume)); /* sigma k.J ~ g_n: mean square of g_n where rates are weighted by g_n */
  }
  gg_engine_state st;
  gg_dsmc_ops.state(g, &st);
  *overflows = st.overflows;
  assert_true(st.overflows < st.events);
  gg_dsmc_ops.destroy(g);
}

static void forced_overflows(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.2, 1, -1, 2000);
  gg_model m = lab_model(&s);
  double rate = gg_model_collision_rate(&m, 0.5), pressure = 4 * m.phi * m.chi[0] * m.density * 0.5 * 3;
  const double forced[] = {0, 3, 1, 0.3};
  for (int i = 0; i < 4; i++) {
    lab_mean r = {0}, p = {0};
    uint64_t overflows;
    run(forced[i], &r, &p, &overflows);
    printf("# bound %g thermal speeds: %llu overflows\n", forced[i], (unsigned long long)overflows);
    lab_expect("rate", &r, rate * (1 - 1 / (2.0 * 2000)), 0, 0.01);
    lab_expect("collisional stress", &p, pressure, 0, 0.01);
    if (i) assert_true(overflows > 1000);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(forced_overflows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
