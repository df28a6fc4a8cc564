/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, for the rule of contact time: it ends an inelastic collapse, and the share of collisions to which it applies
 * is counted; a short contact time does not change a cooling gas; grains at rest on a floor cost a bounded number of
 * collisions, and without the rule they end the run; gravity too weak to matter makes no difference. */
#include <string.h>

#include "md_test.h"
#include "scene/scene.h"

/* Three grains in a line; the outer two approach the middle one. */
static gg_md *line_of_three(double restitution, double contact_time)
{
  gg_scene s = md_scene((md_case){GG_HCS, 3, 0.001, restitution, -1, INFINITY, {0}});
  s.md.contact_time = contact_time;
  gg_model m = md_model_of(&s);
  gg_md *e;
  gg_error err;
  assert_int_equal(gg_md_allocate(&m, &e, &err), GG_OK);
  for (int i = 0; i < 3; i++) {
    e->grain[i].r = (gg_vec){5 + 1.5 * (i - 1), 5, 5};
    e->grain[i].v = (gg_vec){1 - i, 0, 0};
    e->id[i] = (uint32_t)i;
  }
  assert_int_equal(gg_md_begin(e, &err), GG_OK);
  return e;
}

/* Without the rule three grains in a line collide infinitely often for e < 7 - 4 sqrt(3) = 0.0718 (McNamara & Young,
 * Phys. Fluids A 4 (1992) 496), and a few times above. */
static void three_in_a_line_do_not_collapse(void **state)
{
  (void)state;
  static const double below[] = {0, 0.03, 0.05, 0.0717}, above[] = {0.073, 0.1, 0.5};
  for (int k = 0; k < 4; k++) {
    gg_md *e = line_of_three(below[k], 1e-5);
    gg_engine_state now;
    double elapsed;
    assert_int_equal(gg_md_ops.advance(&e->base, 10, 1000000, &elapsed, NULL), GG_OK);
    gg_md_ops.state(&e->base, &now);
    assert_true(elapsed == 10);
    if (!(now.treated > 0 && now.treated < now.collisions && now.collisions < 1000))
      fail_msg("e %g: %g treated of %g", below[k], (double)now.treated, (double)now.collisions);
    md_destroy(e);
  }
  for (int k = 0; k < 3; k++) {
    gg_md *e = line_of_three(above[k], 0);
    double elapsed;
    assert_int_equal(gg_md_ops.advance(&e->base, 10, 1000, &elapsed, NULL), GG_OK);
    assert_true(elapsed == 10 && e->k.collisions < 200);
    md_destroy(e);
  }
}

/* A dense and very inelastic gas collapses into clusters within a few collisions a grain. */
static void a_cooling_cluster_does_not_end_the_run(void **state)
{
  (void)state;
  gg_scene s = md_scene((md_case){GG_HCS, 500, 0.5, 0.1, -1, INFINITY, {0}});
  s.md.contact_time = GG_AUTO;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 6);
  gg_engine_state now;
  double energy = md_energy(e);
  md_collide(e, 500 * 500);
  gg_md_ops.state(&e->base, &now);
  print_message("# e = 0.1, phi = 0.5: %.3g of the collisions treated\n", (double)now.treated / (double)now.collisions);
  assert_int_equal(now.collisions, 250000);
  assert_true(now.treated > 0 && 2 * now.treated < now.collisions);
  assert_true(md_energy(e) < 0.01 * energy && now.worst_overlap < 1e-11 && md_misplaced(e) == 0);
  md_destroy(e);
}

/* At e = 0 pairs separate at a normal speed of 0 but for rounding. With every rule, kind of search and drive the run
 * continues, grains do not overlap, and they are in their cells. */
static void grains_without_restitution_run(void **state)
{
  (void)state;
  const struct {
    gg_flow flow;
    double phi, beta, mu;
  } cases[] = {{GG_HCS, 0.1, -1, INFINITY},  {GG_HCS, 0.01, 0, INFINITY},      {GG_HCS, 0.5, -1, INFINITY},
               {GG_USF, 0.01, -1, INFINITY}, {GG_USF, 0.2, 0.3, 0.3},          {GG_USF, 0.5, 1, INFINITY},
               {GG_HSS, 0.05, -1, INFINITY}, {GG_COUETTE, 0.1, -1, INFINITY},  {GG_COUETTE, 0.2, 0, 0.5},
               {GG_CHUTE, 0.2, 0, INFINITY}, {GG_POISEUILLE, 0.1, 0, INFINITY}};
  const double restitution[] = {0, 1e-300, 1e-6, 0.01};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
    for (int r = 0; r < 4; r++) {
      gg_scene s =
          md_scene((md_case){cases[k].flow, 500, cases[k].phi, restitution[r], cases[k].beta, cases[k].mu, {0}});
      s.md.contact_time = GG_AUTO;
      s.walls.e = restitution[r], s.walls.beta = 0, s.walls.speed = 1;
      if (s.flow == GG_HSS) s.thermostat = GG_GAUSSIAN;
      if (s.flow == GG_CHUTE || s.flow == GG_POISEUILLE) s.gravity[0] = 0.3;
      if (s.flow == GG_CHUTE) s.gravity[1] = -1, s.walls.top = GG_OPEN_TOP;
      gg_model m = md_model_of(&s);
      gg_md *e = md_create(&m, k);
      double time = 20 / gg_common_model_collision_rate(&m, m.temperature0), elapsed;
      assert_int_equal(gg_md_ops.advance(&e->base, time, 100 * 500 * 500, &elapsed, NULL), GG_OK);
      if (!(elapsed == time && e->k.treated < e->k.collisions && e->k.worst_overlap < 1e-11 && md_misplaced(e) == 0))
        fail_msg("case %zu, e %g: %g of %g, %g treated of %g, overlap %g", k, restitution[r], elapsed, time,
                 (double)e->k.treated, (double)e->k.collisions, e->k.worst_overlap);
      md_destroy(e);
    }
}

/* At e = 0 the plain path has the same bits. */
static void grains_without_restitution_run_on_the_plain_path(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_model m = md_model((md_case){k ? GG_USF : GG_HCS, 400, 0.15, 0, 0.2, INFINITY, {0}});
    gg_md *fast = md_create(&m, 3), *plain = md_create(&m, 3);
    plain->plain = true;
    gg_md_select(plain);
    assert_true(fast->kernel != plain->kernel);
    md_collide(fast, 20000);
    md_collide(plain, 20000);
    assert_int_equal(md_hash(fast), md_hash(plain));
    md_destroy(fast);
    md_destroy(plain);
  }
}

typedef struct cooling {
  double mean[2], error[2]; /* decay of ln T a collision and grain; collision rate over sqrt(T) */
} cooling;
enum { SEEDS = 16, STRETCHES = 20 };

/* Cools for 40 collisions a grain; T falls a hundredfold. */
static void cool(double contact_time, uint64_t seed, double x[2])
{
  gg_scene s = md_scene((md_case){GG_HCS, 1000, 0.2, 0.8, -1, INFINITY, {0}});
  s.md.contact_time = contact_time;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, seed);
  double first = md_energy(e);
  x[1] = 0;
  for (int k = 0; k < STRETCHES; k++) {
    double before = md_energy(e), time = md_collide(e, e->n), after = md_energy(e);
    x[1] += 2 / (time * sqrt(sqrt(before * after) / e->n)) / STRETCHES;
  }
  x[0] = log(first / md_energy(e)) / (2 * STRETCHES);
  md_destroy(e);
}

static cooling cool_many(double contact_time, uint64_t seed)
{
  cooling c = {{0}, {0}};
  double x[2], sum2[2] = {0};
  for (int k = 0; k < SEEDS; k++) {
    cool(contact_time, seed + (uint64_t)k, x);
    for (int q = 0; q < 2; q++) c.mean[q] += x[q] / SEEDS, sum2[q] += x[q] * x[q] / SEEDS;
  }
  for (int q = 0; q < 2; q++) c.error[q] = sqrt((sum2[q] - c.mean[q] * c.mean[q]) / (SEEDS - 1));
  return c;
}

static void a_short_contact_time_changes_no_gas(void **state)
{
  (void)state;
  cooling longer = cool_many(1e-4, 100), middle = cool_many(1e-5, 200), shorter = cool_many(1e-6, 300);
  const cooling *others[] = {&longer, &shorter};
  for (int k = 0; k < 2; k++)
    for (int q = 0; q < 2; q++) {
      double sigma = hypot(others[k]->error[q], middle.error[q]), difference = others[k]->mean[q] - middle.mean[q];
      if (!(fabs(difference) < 4 * sigma && sigma < 0.005 * middle.mean[q]))
        fail_msg("t_c %s, mean %d: %g and %g, standard error %g", k ? "1e-6" : "1e-4", q, others[k]->mean[q],
                 middle.mean[q], sigma);
    }
}

/* A heap comes to rest on a level floor. Its contacts follow each other by t_c = 10^-3 sqrt(d/g), and it lies still. */
static void a_heap_comes_to_rest(void **state)
{
  (void)state;
  gg_scene s = md_scene((md_case){GG_CHUTE, 40, 0.2, 0.7, 0, INFINITY, {0}});
  s.md.contact_time = GG_AUTO;
  s.walls.top = GG_OPEN_TOP, s.walls.e = 0.7, s.walls.beta = 0;
  s.gravity[1] = -1;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 4);
  gg_engine_state now, then;
  double elapsed, speed2 = 0;
  assert_int_equal(gg_md_ops.advance(&e->base, 15, 5000000, &elapsed, NULL), GG_OK);
  assert_true(elapsed == 15);
  gg_md_ops.state(&e->base, &then);
  assert_int_equal(gg_md_ops.advance(&e->base, 2, 800000, &elapsed, NULL), GG_OK);
  gg_md_ops.state(&e->base, &now);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec v = gg_md_velocity(e, true, &e->grain[i], e->k.now);
    speed2 += gg_dot(v, v) / e->n;
  }
  double collisions = (double)(now.collisions - then.collisions), events = (double)(now.events - then.events);
  print_message("# heap of 40 at rest: %.3g collisions, %.3g events per sqrt(d/g); mean square speed %.2g\n",
                collisions / 2, events / 2, speed2);
  assert_true(elapsed == 2 && events / 2 < 40 * 1e4 && speed2 < 1e-3);
  assert_true(now.wall_treated > 0 && now.worst_overlap < 1e-11);
  md_destroy(e);
}

/* The rule never applies to contacts with a thermal wall, however soon one follows another. */
static void the_rule_spares_thermal_walls(void **state)
{
  (void)state;
  gg_scene s = md_scene((md_case){GG_CHUTE, 100, 0.1, 0.8, -1, INFINITY, {0}});
  s.md.contact_time = GG_AUTO;
  s.walls.temperature[0] = s.walls.temperature[1] = 1e-8;
  s.gravity[1] = -1;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 4);
  md_collide(e, 20000);
  assert_true(m.contact_time > 0 && e->k.wall_treated == 0);
  md_destroy(e);
}

/* Gravity too weak to matter leaves a gas between walls as it is: its collisions still lose energy. */
static void negligible_gravity_changes_nothing(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    gg_scene s = md_scene((md_case){GG_COUETTE, 200, 0.1, 0.8, -1, INFINITY, {0}});
    s.md.contact_time = GG_AUTO;
    s.walls.beta = 0;
    s.gravity[1] = -(const double[]){1e-4, 1e-8, 1e-12}[k];
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 4);
    md_collide(e, 2000);
    const uint64_t treated = e->k.treated, before = e->k.collisions;
    md_collide(e, 20000);
    assert_true((double)(e->k.treated - treated) < 0.01 * (double)(e->k.collisions - before));
    md_destroy(e);
  }
}

/* Without the rule grains that come to rest on a floor would have contacts without end: the run ends with an error. */
static void without_the_rule_a_floor_ends_the_run(void **state)
{
  (void)state;
  gg_scene s = md_scene((md_case){GG_CHUTE, 10, 0.02, 0.8, -1, INFINITY, {0}});
  s.md.contact_time = 0;
  s.walls.top = GG_OPEN_TOP, s.walls.e = 0.7, s.walls.beta = 0;
  s.gravity[0] = 0, s.gravity[1] = -1;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 4);
  gg_error err;
  double elapsed;
  assert_int_equal(gg_md_ops.advance(&e->base, 1000, UINT64_MAX, &elapsed, &err), GG_FAILED);
  assert_non_null(strstr(err.message, "md.contact_time"));
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(three_in_a_line_do_not_collapse),
                                     cmocka_unit_test(a_cooling_cluster_does_not_end_the_run),
                                     cmocka_unit_test(grains_without_restitution_run),
                                     cmocka_unit_test(grains_without_restitution_run_on_the_plain_path),
                                     cmocka_unit_test(a_short_contact_time_changes_no_gas),
                                     cmocka_unit_test(a_heap_comes_to_rest),
                                     cmocka_unit_test(the_rule_spares_thermal_walls),
                                     cmocka_unit_test(negligible_gravity_changes_nothing),
                                     cmocka_unit_test(without_the_rule_a_floor_ends_the_run)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
