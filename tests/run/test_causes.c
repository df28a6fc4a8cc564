/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why md differs from Enskog's equation: over a grid of scenes, with planted differences of either sign and many sizes,
 * every marked quantity has a sentence, and no sentence is contradicted by the sign or the size of what it explains. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "run/run.h"
#include "run/z_scores.h"
#include "scene/model_of_scene.h"

typedef struct scene_of {
  gg_flow flow;
  double phi, e, beta, mu;
  int species;
} scene_of;

static gg_result md = {.engine = "md"}, dsmc = {.engine = "dsmc"};

static void set_scene(const scene_of *of, gg_comparison *c)
{
  static gg_scene s;
  gg_error err;
  s = gg_scene_defaults();
  s.flow = of->flow, s.phi = of->phi, s.n_species = of->species;
  for (int p = 0; p < GG_PAIRS; p++)
    s.collision.e[p] = of->e, s.collision.beta[p] = of->beta, s.collision.mu[p] = of->mu;
  if (of->species == 2)
    s.species[0] = (gg_species){0.5, 1, 4, 0.4, 1, 0}, s.species[1] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  *c = (gg_comparison){.scene = &s, .by_engine = {&md, &dsmc}};
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &c->model, &err), GG_OK);
  gg_run_rows_make(&c->model, &c->rows);
  md.rows = dsmc.rows = c->rows;
  for (int q = 0; q < GG_MOST_QUANTITIES; q++) md.value[q] = dsmc.value[q] = (gg_estimate){.mean = NAN, .error = NAN};
  md.steadiness = GG_STEADY, md.engine_state = (gg_engine_state){.collisions = 1000000};
  md.model = c->model;
  md.scene = dsmc.scene = &s;
}

/* Measured numbers of the gas. */
static void set_waves(double density, double momentum, uint64_t treated)
{
  md.value[GG_Q_DENSITY_WAVES] = (gg_estimate){.mean = density, .error = 0.05 * density};
  md.value[GG_Q_MOMENTUM_WAVES] = (gg_estimate){.mean = momentum, .error = 0.05 * momentum};
  md.engine_state.treated = treated;
}

static void plant(gg_quantity q, double by)
{
  md.value[q] = (gg_estimate){.mean = 1 + by, .error = 0.0005};
  dsmc.value[q] = (gg_estimate){.mean = 1, .error = 0.0005};
}

static bool says(const gg_causes *causes, const char *words)
{
  for (int i = 0; i < causes->n; i++)
    if (strstr(causes->text[i], words)) return true;
  return false;
}

/* Claim of each sentence about a difference. */
static void check_claims(const gg_causes *causes, gg_quantity q, double by, bool clustered, bool swirls)
{
  assert_int_equal(says(causes, "have clustered"), clustered);
  assert_int_equal(says(causes, "gas swirls"), swirls && !clustered);
  if (clustered || swirls) assert_false(says(causes, "correlated") || says(causes, "T rises"));
  if (says(causes, "lies above Enskog's")) assert_true(q == GG_Q_TEMPERATURE_RATIO && by > 0 && by < 0.2);
  if (says(causes, "T rises from 200")) assert_true(q != GG_Q_TEMPERATURE_RATIO && by > 0 && by < 0.4);
  if (says(causes, "lost no energy")) assert_true(by * (q == GG_Q_COOLING_RATE ? -1 : 1) > 0);
  if (says(causes, "no known cause")) assert_int_equal(causes->n, 1);
}

static const gg_quantity quantities[] = {
    GG_Q_TEMPERATURE,  GG_Q_TEMPERATURE_RATIO, GG_Q_PRESSURE,       GG_Q_N1,
    GG_Q_COOLING_RATE, GG_Q_SHEAR_VISCOSITY,   GG_Q_COLLISION_RATE, GG_Q_PARTIAL_TEMPERATURE_RATIO};
enum { QUANTITIES = sizeof quantities / sizeof *quantities };

static int check_scene(const scene_of *of)
{
  static const double sizes[] = {-0.9, -0.66, -0.3, -0.12, -0.04, -0.005, 0.005, 0.04, 0.09, 0.15, 0.35, 0.7, 3, 100};
  static const struct {
    double density, momentum;
    uint64_t treated;
  } measured[] = {{1, 1, 0}, {1.2, 30, 0}, {14, 40, 5000}, {14, 1, 0}, {1, 1, 20000}, {3.5, 3.5, 0}};
  int marked = 0;
  for (size_t w = 0; w < sizeof measured / sizeof *measured; w++)
    for (size_t k = 0; k < QUANTITIES * sizeof sizes / sizeof *sizes; k++) {
      const gg_quantity q = quantities[k % QUANTITIES];
      const double by = sizes[k / QUANTITIES];
      gg_comparison c;
      gg_causes one, all;
      set_scene(of, &c);
      set_waves(measured[w].density, measured[w].momentum, measured[w].treated);
      plant(q, by);
      gg_run_causes_of(&c, q, &one);
      gg_run_causes_find(&c, &all);
      assert_int_equal(one.n > 0, gg_run_results_disagree(&c, q));
      assert_int_equal(all.n, one.n);
      if (!one.n) continue;
      marked++;
      check_claims(&one, q, by, measured[w].density > 5, measured[w].momentum > 5);
    }
  return marked;
}

static void found_causes_apply_to_the_difference(void **state)
{
  (void)state;
  static const double phi[] = {0.01, 0.05, 0.1, 0.2, 0.3, 0.5}, e[] = {0.5, 0.7, 0.9, 0.99};
  static const struct {
    gg_flow flow;
    double beta, mu;
    int species;
  } kinds[] = {{GG_USF, -1, INFINITY, 1}, {GG_USF, 0, INFINITY, 1},  {GG_USF, 0.9, INFINITY, 1}, {GG_USF, 0, 0.1, 1},
               {GG_HCS, -1, INFINITY, 1}, {GG_HSS, -1, INFINITY, 1}, {GG_HSS, -1, INFINITY, 2}};
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
    for (size_t i = 0; i < 6; i++)
      for (size_t j = 0; j < 4; j++) {
        const scene_of of = {kinds[k].flow, phi[i], e[j], kinds[k].beta, kinds[k].mu, kinds[k].species};
        assert_true(check_scene(&of) > 100);
      }
}

/* Differences once explained by what they contradicted, or by nothing. */
static void clustered_and_swirling(void **state)
{
  (void)state;
  gg_comparison c;
  gg_causes causes;
  set_scene(&(scene_of){GG_USF, 0.3, 0.5, 0, 0.1, 1}, &c);
  set_waves(140, 11, 0);
  plant(GG_Q_TEMPERATURE_RATIO, -0.66);
  gg_run_causes_find(&c, &causes);
  assert_int_equal(causes.n, 1);
  assert_non_null(strstr(causes.text[0], "density waves of the box's length are 1.4e+02 times"));

  set_scene(&(scene_of){GG_HSS, 0.3, 0.8, -1, INFINITY, 2}, &c);
  set_waves(2, 75, 0);
  plant(GG_Q_PARTIAL_TEMPERATURE_RATIO, 0.7);
  gg_run_causes_find(&c, &causes);
  assert_int_equal(causes.n, 1);
  assert_non_null(strstr(causes.text[0], "the gas swirls"));
}

/* Without measured waves the cause follows from the theory of clustering. A difference without a known cause is named.
 */
static void without_waves_theory_names_the_cause(void **state)
{
  (void)state;
  gg_comparison c;
  gg_causes causes;
  set_scene(&(scene_of){GG_HCS, 0.3, 0.5, -1, INFINITY, 1}, &c);
  plant(GG_Q_COOLING_RATE, -0.66);
  gg_run_causes_find(&c, &causes);
  assert_true(says(&causes, "longer than the length above which"));
  set_waves(1, 1, 0);
  gg_run_causes_find(&c, &causes);
  assert_int_equal(causes.n, 1);
  assert_string_equal(causes.text[0], "no known cause of the difference in cooling_rate");
  plant(GG_Q_COOLING_RATE, 0);
  gg_run_causes_find(&c, &causes);
  assert_int_equal(causes.n, 0);
}

/* In a bath that turns grains within some diameters md collides more often; T and other signs have nothing of it. */
static void strong_drag_explains_the_collision_rate(void **state)
{
  (void)state;
  for (int strong = 0; strong < 2; strong++)
    for (int more = 0; more < 2; more++) {
      gg_comparison c;
      gg_causes causes;
      set_scene(&(scene_of){GG_HSS, 0.1, 0.8, -1, INFINITY, 1}, &c);
      c.model.thermostat = GG_BATH, c.model.bath.on = true, c.model.bath.drag[0] = strong ? 2 : 0.02;
      gg_run_rows_make(&c.model, &c.rows);
      set_waves(1, 1, 0);
      plant(GG_Q_COLLISION_RATE, more ? 0.15 : -0.15);
      gg_run_causes_find(&c, &causes);
      assert_int_equal(says(&causes, "sqrt(T)/drag = 0.35 d"), strong && more);
      plant(GG_Q_COLLISION_RATE, 0);
      plant(GG_Q_TEMPERATURE, 0.15);
      gg_run_causes_find(&c, &causes);
      assert_false(says(&causes, "sqrt(T)/drag"));
    }
}

/* Rough grains at phi = 0.5 collide 80 times as often as Enskog's equation has, smooth ones 2.5 times. */
static void lasting_contacts_are_recognised_by_the_collision_rate(void **state)
{
  (void)state;
  for (int lasting = 0; lasting < 2; lasting++)
    for (int more = 0; more < 2; more++) {
      gg_comparison c;
      gg_causes causes;
      set_scene(&(scene_of){GG_USF, 0.5, 0.5, 0, INFINITY, 1}, &c);
      set_waves(1, 1, 0);
      plant(GG_Q_PRESSURE, more ? 5.8 : -0.5);
      md.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = 0.188, .error = 0.004};
      /* 4 n d^2 chi sqrt(pi T) with n = 6 phi/pi, chi = 6 */
      md.value[GG_Q_COLLISION_RATE] = (gg_estimate){.mean = (lasting ? 81 : 2.5) * 17.613, .error = 0.1};
      gg_run_causes_find(&c, &causes);
      assert_int_equal(says(&causes, "grains stay in contact: md collides 81 times"), lasting && more);
      assert_int_equal(says(&causes, "stay in contact"), lasting && more);
    }
}

/* The error of the waves counts: a few samples of a homogeneous gas tell nothing. */
static void structure_is_told_from_noise(void **state)
{
  (void)state;
  gg_comparison c;
  char text[240];
  set_scene(&(scene_of){GG_USF, 0.3, 0.9, -1, INFINITY, 1}, &c);
  assert_false(gg_run_structure(&md, text, sizeof text));
  set_waves(6, 1, 0);
  assert_true(gg_run_structure(&md, text, sizeof text));
  md.value[GG_Q_DENSITY_WAVES].error = 2;
  assert_false(gg_run_structure(&md, text, sizeof text));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(found_causes_apply_to_the_difference),
                                     cmocka_unit_test(clustered_and_swirling),
                                     cmocka_unit_test(without_waves_theory_names_the_cause),
                                     cmocka_unit_test(strong_drag_explains_the_collision_rate),
                                     cmocka_unit_test(lasting_contacts_are_recognised_by_the_collision_rate),
                                     cmocka_unit_test(structure_is_told_from_noise)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
