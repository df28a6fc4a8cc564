/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All theories: names, finite answers or reasons for every kind of scene, ranges; and the theories that are one formula
 * against published numbers. */
#include "theory_test.h"

#include "common/contact_value.h"
#include "scene/model_of_scene.h"

static bool is_one_line(const char *text)
{
  return text && strlen(text) > 10 && !strpbrk(text, "\n\t");
}

/* Every theory has the name that the list gives it, a title, a citation and its assumptions, and is found by name. */
static void list_is_complete(void **state)
{
  (void)state;
#define NAME(name) #name,
  static const char *const names[] = {GG_THEORIES(NAME)};
  for (size_t i = 0; gg_theory_theories[i]; i++) {
    const gg_theory *t = gg_theory_theories[i];
    assert_string_equal(t->name, names[i]);
    assert_ptr_equal(gg_theory_find(t->name), t);
    if (!is_one_line(t->title) || !is_one_line(t->citation) || !is_one_line(t->assumptions))
      fail_msg("%s does not describe itself", t->name);
  }
  assert_null(gg_theory_find("lun"));
}

/* Theories that take tenths of a second: the solver, those between walls, and the closure of sheared grains that slide.
 */
static bool is_slow(const gg_theory *t, const gg_model *m)
{
  return t == &gg_theory_enskog_hermite || t->gap || (t == &gg_theory_gaussian_closure && m->rule == GG_FRICTIONAL);
}

/* On every kind of scene each theory answers with finite numbers or none, or rejects it with its own name in front.
 * Theories that are slow take some of the scenes: the solver one in 907 (nightly 301), others one in 29 (nightly
 * all). */
static void no_number_leaks(void **state)
{
  (void)state;
  const double phis[] = {0, 1e-3, 0.05, 0.3, 0.55}, es[] = {0.3, 0.9, 1}, betas[] = {-1, -0.5, 0, 0.9, 1};
  const double mus[] = {INFINITY, 0.1};
  const bool nightly = getenv("NIGHTLY");
  int described[2] = {0};
  for (int flow = 0; flow < GG_N_FLOWS; flow++)
    for (int thermostat = GG_NO_THERMOSTAT; thermostat <= GG_WHITE_NOISE; thermostat++)
      for (int species = 1; species <= 2; species++)
        for (int i = 0; i < 5 * 3 * 5 * 2; i++) {
          gg_scene s = scene_of((gg_flow)flow, phis[i % 5], es[i / 5 % 3], betas[i / 15 % 5]);
          if (!gg_flow_takes(s.flow, (gg_thermostat)thermostat)) continue;
          s.thermostat = (gg_thermostat)thermostat;
          s.n_species = species;
          s.species[1] = (gg_species){0.5, 1.5, 4, 0.4, 1, 0};
          if (flow == GG_COUETTE) s.walls.speed = 1;
          for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mus[i / 75];
          gg_model m = model_of(&s);
          for (const gg_theory *const *t = gg_theory_theories; *t; t++) {
            gg_theory_answer a;
            gg_error err = {0};
            const bool solver = *t == &gg_theory_enskog_hermite;
            const int one_in = solver ? (nightly ? 301 : 907) : nightly ? 1 : 29;
            if (is_slow(*t, &m) && described[solver]++ % one_in) continue;
            gg_status status = gg_theory_evaluate(*t, &m, &a, &err);
            if (status != GG_OK) {
              assert_int_equal(status, GG_BAD_INPUT);
              assert_int_equal(strncmp(err.message, (*t)->name, strlen((*t)->name)), 0);
              continue;
            }
            int answers = 0;
            for (int q = 0; q < GG_N_QUANTITIES; q++) {
              if (isinf(a.value[q]))
                fail_msg("%s: %s is infinite", (*t)->name, gg_common_quantity_name((gg_quantity)q));
              answers += !isnan(a.value[q]);
            }
            if (answers == 0) fail_msg("%s accepts a scene and says nothing", (*t)->name);
          }
        }
}

/* Three species: theories of one or two reject them with the reason; the others take the same grains as three
 * species correctly. */
static void three_species(void **state)
{
  (void)state;
  static const gg_theory *const of_few[] = {&gg_theory_lun1991, &gg_theory_grad, &gg_theory_garzo_montanero2003,
                                            &gg_theory_garzo_montanero2003_ms, &gg_theory_enskog_hermite};
  for (int flow = GG_EQUILIBRIUM; flow <= GG_HCS; flow++) {
    gg_scene s = scene_of((gg_flow)flow, 0.04, flow == GG_EQUILIBRIUM ? 1 : 0.9, -1), three = s;
    three.n_species = 3;
    for (int i = 0; i < 3; i++) three.species[i].fraction = i ? 0.25 : 0.5;
    gg_model one = model_of(&s), m = model_of(&three);
    for (size_t k = 0; k < sizeof of_few / sizeof *of_few; k++) {
      gg_theory_answer a;
      gg_error err = {0};
      if (flow != GG_EQUILIBRIUM && of_few[k] == &gg_theory_enskog_hermite)
        continue; /* for any number (hermite_mixtures) */
      assert_int_equal(gg_theory_evaluate(of_few[k], &m, &a, &err), GG_BAD_INPUT);
      assert_non_null(strstr(err.message, "describes"));
    }
    const gg_theory *t = flow == GG_EQUILIBRIUM ? &gg_theory_enskog : &gg_theory_gaussian_closure;
    gg_theory_answer a, b;
    if (flow == GG_HCS) continue;
    assert_int_equal(gg_theory_evaluate(t, &one, &a, NULL), GG_OK);
    assert_int_equal(gg_theory_evaluate(t, &m, &b, NULL), GG_OK);
    const gg_quantity same[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_COLLISION_RATE, GG_Q_MEAN_FREE_PATH};
    for (int k = 0; k < 4; k++) assert_true(fabs(a.value[same[k]] / b.value[same[k]] - 1) < 1e-9);
    if (flow == GG_USF) assert_true(fabs(b.value[GG_Q_PARTIAL_TEMPERATURE + 2] / a.value[GG_Q_TEMPERATURE] - 1) < 1e-9);
  }
}

/* Half-rough contacts are outside a theory's range between any species; smooth or perfectly rough contacts are not. */
static void range_looks_at_all_pairs(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_USF, 0.1, 0.95, -1);
  s.n_species = 2;
  s.species[0].fraction = 0.5, s.species[1] = s.species[0];
  gg_model m = model_of(&s);
  assert_null(gg_theory_beyond(&gg_theory_gaussian_closure, &m));
  s.collision.beta[gg_pair(0, 1)] = s.collision.beta[gg_pair(1, 1)] = 0;
  m = model_of(&s);
  assert_non_null(gg_theory_beyond(&gg_theory_gaussian_closure, &m));
  s.collision.beta[gg_pair(0, 1)] = s.collision.beta[gg_pair(1, 1)] = 1;
  m = model_of(&s);
  assert_null(gg_theory_beyond(&gg_theory_gaussian_closure, &m));
}

/* The published example: N1 = 0.24, N2 = -0.0203 at e = 0.9; leading coefficients are those of the elastic Burnett
 * equations, N1 = w2 x and N2 = (w6/4 - w2) x with x = 5/8 1.016034 eps, w2 = 2.028, w6 = 7.424. */
static void sela_goldhirsch(void **state)
{
  (void)state;
  gg_model m = model_for(GG_USF, 0.01, 0.9, -1);
  assert_close(value_of(&gg_theory_sela_goldhirsch1998, &m, GG_Q_N1), 0.24007, 2e-5);
  assert_close(value_of(&gg_theory_sela_goldhirsch1998, &m, GG_Q_N2), -0.02036, 2.5e-4);
  m = model_for(GG_USF, 0, 1 - 5e-7, -1);
  double x = 0.625 * 1.016034 * 1e-6;
  assert_close(value_of(&gg_theory_sela_goldhirsch1998, &m, GG_Q_N1), 2.028 * x, 2e-4);
  assert_close(value_of(&gg_theory_sela_goldhirsch1998, &m, GG_Q_N2), (7.424 / 4 - 2.028) * x, 5e-4);
  m = model_for(GG_USF, 0.3, 0.9, -1);
  assert_refused(&gg_theory_sela_goldhirsch1998, &m, "dilute");
  m = model_for(GG_USF, 0.01, 0.9, 0);
  assert_refused(&gg_theory_sela_goldhirsch1998, &m, "smooth");
}

/* Carnahan & Starling: Z = (1 + phi + phi^2 - phi^3)/(1-phi)^3; equal species of a mixture are one species. */
static void enskog_equation_of_state(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.5; phi += 0.05) {
    double Z = (1 + phi + phi * phi - phi * phi * phi) / pow(1 - phi, 3);
    gg_scene s = scene_of(GG_EQUILIBRIUM, phi, 1, -1);
    gg_model m = model_of(&s);
    gg_theory_answer one = answer_of(&gg_theory_enskog, &m);
    assert_close(one.value[GG_Q_COMPRESSIBILITY], Z, 1e-13);
    assert_close(one.value[GG_Q_PRESSURE], Z * 0.5 * (phi == 0 ? 1 : phi), 1e-13); /* T_0 = 1/2 */
    s.n_species = 2;
    s.species[1] = s.species[0];
    m = model_of(&s);
    gg_theory_answer two = answer_of(&gg_theory_enskog, &m);
    assert_close(two.value[GG_Q_COMPRESSIBILITY], Z, 1e-13);
    assert_close(two.value[GG_Q_COLLISION_RATE], one.value[GG_Q_COLLISION_RATE], 1e-13);
    assert_close(two.value[GG_Q_MEAN_FREE_PATH], one.value[GG_Q_MEAN_FREE_PATH], 1e-13);
  }
}

/* Mean free time 0.1303 of the elastic fluid at n d^3 = 0.5, T = 1 (Lue, J. Chem. Phys. 122 (2005) 044513). */
static void enskog_mean_free_time(void **state)
{
  (void)state;
  gg_model m = model_for(GG_EQUILIBRIUM, M_PI / 12, 1, -1);
  double rate = value_of(&gg_theory_enskog, &m, GG_Q_COLLISION_RATE) * sqrt(2); /* from T = 1/2 to T = 1 */
  assert_close(1 / rate, 0.1303, 0.005);
}

/* N = 8000, phi = 0.01, chi = 1: l = 11.79 d without chi, 11.49 d with; L = 74.8 d; Kn = 0.1536. */
static void enskog_knudsen(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_EQUILIBRIUM, 0.01, 1, -1);
  s.particles = 8000;
  gg_model m;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_close(value_of(&gg_theory_enskog, &m, GG_Q_MEAN_FREE_PATH), 11.49, 5e-4);
  assert_close(cbrt(m.volume), 74.8, 1e-3);
  assert_close(value_of(&gg_theory_enskog, &m, GG_Q_KNUDSEN), 0.1536, 5e-4);
}

static void enskog_refuses(void **state)
{
  (void)state;
  gg_model m = model_for(GG_EQUILIBRIUM, 0.2, 0.9, -1);
  assert_refused(&gg_theory_enskog, &m, "elastic");
  m = model_for(GG_USF, 0.2, 0.9, -1);
  assert_refused(&gg_theory_enskog, &m, "this scene is uniform shear");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(list_is_complete),         cmocka_unit_test(three_species),
      cmocka_unit_test(no_number_leaks),          cmocka_unit_test(sela_goldhirsch),
      cmocka_unit_test(enskog_equation_of_state), cmocka_unit_test(enskog_mean_free_time),
      cmocka_unit_test(range_looks_at_all_pairs), cmocka_unit_test(enskog_knudsen),
      cmocka_unit_test(enskog_refuses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
