/* Proves: starts at every solid fraction from 0.001 to 0.6 are free of overlaps, at rest as a whole and exactly at the
 * asked temperatures; boxes too small for the nearest image, phi = 0 and unknown flows are refused by name; the
 * contact- time rule ends an inelastic collapse. */
#include <string.h>

#include "md_test.h"

static void check_start(md_case c)
{
  gg_model m = md_model(c);
  gg_md *e = md_create(&m, 11);
  assert_true(md_closest(e) >= 1);
  gg_vec p = md_momentum(e);
  double T = 0, theta = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec v = e->grain[i].v;
    v.x -= m.shear_rate * (e->grain[i].r.y - 0.5 * m.box[1]);
    T += gg_dot(v, v) / 3 / e->n;
    if (e->spin) {
      gg_vec s = e->spin[i];
      s.z += 0.25 * m.shear_rate;
      theta += m.inertia[0] * gg_dot(s, s) / 3 / e->n;
    }
  }
  assert_true(sqrt(gg_dot(p, p)) < 1e-11 * sqrt(T) * e->n);
  assert_true(fabs(T / m.temperature0 - 1) < 1e-12);
  if (e->spin) assert_true(fabs(theta / (m.ratio0 * T) - 1) < 5 / sqrt(1.5 * e->n));
  md_destroy(e);
}

static void any_solid_fraction(void **state)
{
  (void)state;
  static const double phis[] = {0.001, 0.01, 0.1, 0.3, 0.45, 0.5, 0.55, 0.6};
  for (int k = 0; k < 8; k++) {
    check_start((md_case){GG_EQUILIBRIUM, 500, phis[k], 1, -1, INFINITY, {0}});
    check_start((md_case){GG_USF, 1000, phis[k], 0.9, 0, INFINITY, {2, 1, 1}});
  }
  check_start((md_case){GG_HCS, 32, 0.6, 0.9, 0, INFINITY, {0}});
  check_start((md_case){GG_HCS, 2, 0.001, 0.9, 0, INFINITY, {0}});
}

/* Mixtures and walled boxes: the asked composition, nobody in a wall. */
static void dense_mixtures_and_walls(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++) {
    gg_scene s = md_scene((md_case){k % 2 ? GG_COUETTE : GG_USF, 600, k % 2 ? 0.5 : 0.6, 0.9, 0, INFINITY, {0}});
    s.n_species = 2;
    s.species[0].fraction = 0.25, s.species[1].fraction = 0.75;
    s.species[1].diameter = k < 2 ? 0.5 : 1.6;
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 5);
    int64_t first = 0;
    double solid = 0;
    for (uint32_t i = 0; i < e->n; i++) {
      double d = m.diameter[gg_species_of(&e->grain[i])], y = e->grain[i].r.y;
      first += gg_species_of(&e->grain[i]) == 0;
      solid += M_PI / 6 * d * d * d / m.volume;
      if (m.walled) assert_true(y >= 0.5 * d && y <= m.box[1] - 0.5 * d);
    }
    assert_int_equal(first, 150);
    assert_true(fabs(solid - s.phi) < 1e-12 && md_closest(e) >= 1);
    md_destroy(e);
  }
}

static void refuse(md_case c, const char *key)
{
  gg_model m = md_model(c);
  gg_error err = {0};
  gg_engine *engine = NULL;
  assert_int_equal(gg_md_ops.accepts(&m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, key));
  assert_int_equal(gg_md_ops.create(&m, 1, 0, &engine, &err), GG_BAD_INPUT);
  assert_null(engine);
}

static void refused(void **state)
{
  (void)state;
  refuse((md_case){GG_USF, 2, 0.3, 0.9, -1, INFINITY, {0}}, "particles");
  refuse((md_case){GG_USF, 100, 0.3, 0.9, -1, INFINITY, {60, 1, 1}}, "particles");
  refuse((md_case){GG_USF, 100, 0, 0.9, -1, INFINITY, {0}}, "phi");
  refuse((md_case){GG_USF, 100, 0.7, 0.9, -1, INFINITY, {0}}, "phi");
  refuse((md_case){GG_USF, 1, 0.1, 0.9, -1, INFINITY, {0}}, "particles");
}

/* Three grains in a line, the outer two closing in: without the rule, infinitely many collisions for e < 7 - 4 sqrt(3)
 * (McNamara & Young, Phys. Fluids A 4 (1992) 496). */
static void collapse_ends(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_HCS, 3, 0.001, 0.05, -1, INFINITY, {0}});
  gg_md *e;
  gg_error err;
  assert_int_equal(gg_md_allocate(&m, &e, &err), GG_OK);
  for (int i = 0; i < 3; i++) {
    e->grain[i].r = (gg_vec){5 + 1.5 * (i - 1), 5, 5};
    e->grain[i].v = (gg_vec){1 - i, 0, 0};
    e->id[i] = (uint32_t)i;
  }
  assert_int_equal(gg_md_begin(e, &err), GG_OK);
  double elapsed;
  assert_int_equal(gg_md_ops.advance(&e->base, 10, 100000, &elapsed, &err), GG_OK);
  assert_true(elapsed == 10);
  assert_true(e->k.treated > 0 && e->k.treated < e->k.collisions && e->k.collisions < 1000);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(any_solid_fraction), cmocka_unit_test(dense_mixtures_and_walls),
                                     cmocka_unit_test(refused), cmocka_unit_test(collapse_ends)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
