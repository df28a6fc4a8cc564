/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: over 10^5 collisions momentum is kept to rounding in every flow, and energy at e = 1 with beta = -1 or 1; no
 * grains overlap or leave their box or cell; the loss in the collision sums is the energy that is gone. */
#include <stdlib.h>

#include "md_test.h"

static void run(md_case c, bool conserves)
{
  gg_model m = md_model(c);
  gg_md *e = md_create(&m, 3);
  double energy = md_energy(e);
  gg_collision_sums t;
  md_collide(e, 100000);
  gg_md_ops.take_sums(&e->base, &t);
  gg_vec p = md_momentum(e);
  double scale = sqrt(2 * md_energy(e) * (double)c.n), drift = md_energy(e) - energy;
  assert_true(sqrt(gg_dot(p, p)) < 1e-12 * scale);
  assert_true(md_closest(e) > 1 - 1e-12L && e->k.worst_overlap < 1e-12);
  assert_int_equal(md_misplaced(e), 0);
  assert_int_equal(t.collisions[0], 100000);
  if (conserves) assert_true(fabs(drift) < 1e-12 * energy && fabs(t.loss[0]) < 1e-11 * energy);
  if (c.flow != GG_USF) assert_true(fabs(drift + t.loss[0]) < 1e-11 * energy);
  md_destroy(e);
}

static void elastic_grains_keep_momentum_and_energy(void **state)
{
  (void)state;
  static const double phis[] = {0.01, 0.3, 0.55};
  for (int k = 0; k < 3; k++) {
    run((md_case){GG_EQUILIBRIUM, 100, phis[k], 1, -1, INFINITY, {0}}, true);
    run((md_case){GG_EQUILIBRIUM, 100, phis[k], 1, 1, INFINITY, {0}}, true);
  }
}

/* Rounding at collisions is unbiased: a quarter of a last digit each would be 2 x 10^-12 of the energy after 10^6. */
static void energy_does_not_drift(void **state)
{
  (void)state;
  for (int rough = 0; rough < 2; rough++) {
    gg_model m = md_model((md_case){GG_EQUILIBRIUM, 100, 0.3, 1, rough ? 1 : -1, INFINITY, {0}});
    gg_md *e = md_create(&m, 4);
    double energy = md_energy(e);
    md_collide(e, 1000000);
    double drift = md_energy(e) / energy - 1;
    if (!(fabs(drift) < 1.5e-13)) fail_msg("beta %g: relative drift %g", m.beta[0], drift);
    md_destroy(e);
  }
}

/* The mean of a coefficient over the dithers of its rounding is right to 1/64 of the last binary digit. */
static void coefficients_are_right_in_the_mean(void **state)
{
  (void)state;
  for (int k = 0; k < 200; k++) {
    const double e = 0.005 * k + 0.0003, other = 1 + 0.01 * k;
    const gg_contact c = gg_common_contact_make((gg_partner){1, 0.4}, (gg_partner){other, 0.4}, e, -1, INFINITY);
    const long double exact = (1 + (long double)e) / ((long double)c.im1 + c.im2);
    long double mean = 0;
    for (int dither = 0; dither < GG_MD_DITHERS; dither++)
      mean += (long double)gg_md_contact_normal_coefficient(&c, e, (uint64_t)dither) / GG_MD_DITHERS;
    const double digit = nextafter((double)exact, INFINITY) - (double)exact;
    assert_true(fabsl(mean - exact) < 0.51 / GG_MD_DITHERS * digit);
  }
}

static void inelastic_grains_keep_momentum(void **state)
{
  (void)state;
  static const double phis[] = {0.01, 0.3, 0.52};
  for (int k = 0; k < 3; k++) {
    run((md_case){GG_USF, 100, phis[k], 0.8, -1, INFINITY, {0}}, false);
    run((md_case){GG_USF, 100, phis[k], 0.8, 0, INFINITY, {0}}, false);
    run((md_case){GG_USF, 100, phis[k], 0.8, 0.5, 0.2, {0}}, false);
    run((md_case){GG_HCS, 100, phis[k], 0.995, -1, INFINITY, {0}}, false);
    run((md_case){GG_HCS, 100, phis[k], 0.995, 0.98, 0.2, {0}}, false);
  }
}

/* Under shear a P_y from rounding would drive P_x for ever, to 10^-12 and more here, if the frame did not follow it. */
static void sheared_momentum_does_not_drift(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_USF, 100, 0.01, 0.9, 0, INFINITY, {0}});
  gg_md *e = md_create(&m, 4);
  for (int k = 0; k < (getenv("NIGHTLY") ? 20 : 7); k++) {
    md_collide(e, 50000);
    gg_vec p = md_momentum(e);
    double ratio = sqrt(gg_dot(p, p) / (2 * md_energy(e) * e->n));
    if (!(ratio < 1e-14)) fail_msg("momentum of %g N thermal speeds after %d collisions", ratio, 50000 * (k + 1));
  }
  md_destroy(e);
}

/* Shear work, -P_xy x rate x V x time, is the energy gained plus the energy lost. The collisional stress is summed
 * exactly; the kinetic stress is sampled, so the balance holds within the error of sampling. */
static void shear_work_balances_loss(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_USF, 256, 0.3, 0.8, 0, INFINITY, {0}});
  gg_md *e = md_create(&m, 5);
  md_collide(e, 256 * 100);
  gg_collision_sums t;
  gg_md_ops.take_sums(&e->base, &t);
  double time = 0, kinetic = 0;
  int samples = 4000;
  for (int k = 0; k < samples; k++) {
    double dt, sum = 0;
    gg_error err;
    gg_md_ops.advance(&e->base, 0.01, UINT64_MAX, &dt, &err);
    time += dt;
    for (uint32_t i = 0; i < e->n; i++) {
      gg_vec r = gg_md_position(e, e->falls, &e->grain[i], e->k.now), v = e->grain[i].v;
      sum += (v.x - m.shear_rate * (r.y - 0.5 * m.box[1])) * v.y;
    }
    kinetic += sum / samples;
  }
  gg_md_ops.take_sums(&e->base, &t);
  double work = -(kinetic + t.stress[0][0][1] / time), loss = t.loss[0] / time;
  if (!(fabs(work / loss - 1) < 0.01)) fail_msg("shear work %g, loss %g", work, loss);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(elastic_grains_keep_momentum_and_energy), cmocka_unit_test(energy_does_not_drift),
      cmocka_unit_test(coefficients_are_right_in_the_mean),      cmocka_unit_test(inelastic_grains_keep_momentum),
      cmocka_unit_test(sheared_momentum_does_not_drift),         cmocka_unit_test(shear_work_balances_loss)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
