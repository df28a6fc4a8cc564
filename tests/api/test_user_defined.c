/* SPDX-License-Identifier: GPL-3.0-or-later */
/* User-defined parts of a scene, by the public interface alone: found again in files, right in a cooling gas, refused
 * where it would spoil files. */
#include <stdatomic.h>
#include <stdbool.h>

#include "api_test.h"

static void sample_T(void *context, void *state, const gg_sample *s, double *values)
{
  double sum = 0;
  (void)context, (void)state;
  for (size_t i = 0; i < 3 * s->n; i++) sum += s->velocity[i] * s->velocity[i];
  values[0] = sum / (3 * (double)s->n);
  values[1] = NAN;
}

static const char *say(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)facts;
  values[0] = 7;
  values[1] = 8;
  return NULL;
}

/* In Latin-1, and with what a terminal acts on. */
static const char *say_in_latin1(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)facts, (void)values;
  return "ist nicht f\xfcr \x1b[31mdas";
}

static const char *say_nothing(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)facts, (void)values;
  return "is for fluids";
}

/* A file also has the catalogue entries of its quantities and theories, those that did not apply included. */
static void assert_told(const gg_comparison *c)
{
  gg_theory_info t = {0};
  gg_error err;
  char *text;
  size_t i = 0;
  while (gg_comparison_theory(c, i, &t, &err) == GG_OK && strcmp(t.name, "silent") != 0) i++;
  assert_string_equal(t.name, "silent");
  assert_string_equal(t.reason, "silent is for fluids");
  assert_true(strcmp(t.title, "Another") == 0 && strcmp(t.citation, "a letter") == 0);
  assert_ok(gg_comparison_to_json(c, &text, &err));
  assert_non_null(strstr(text, "\"doc\": \"by my own thermometer\""));
  free(text);
}

static void add_all(gg_scene *s)
{
  gg_error err;
  const gg_quantity_definition quantities[] = {{"my_T", "d\xc2\xb2 gamma\xc2\xb2", "by my own thermometer"},
                                               {"nothing", NULL, NULL}};
  const gg_observable_definition o = {"thermometer", NULL, 2, quantities, 0, sample_T, NULL, NULL};
  const char *const names[] = {"my_T", "pressure"};
  const gg_theory_definition t = {"mine", "My theory", "a note", NULL, 2, names, say, NULL};
  assert_ok(gg_scene_add_observable(s, &o, &err));
  assert_ok(gg_scene_add_theory(s, &t, &err));
  const gg_theory_definition silent = {"silent", "Another", "a letter", "none", 2, names, say_nothing, NULL};
  assert_ok(gg_scene_add_theory(s, &silent, &err));
}

/* User-defined means, the reason of a missing one, z-scores and theory are the same after two writes and reads. */
static void user_defined_results_are_read_back(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(
      "{flow: usf, phi: 0.05, particles: 200, collision: {beta: 0}, dsmc: {particles: 500}, run: {collisions: 3000}}");
  gg_comparison *c[3] = {NULL};
  add_all(s);
  gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_own.h5"}, &c[0], &err);
  gg_scene_free(s);
  assert_non_null(c[0]);
  assert_ok(gg_comparison_read("t_own.h5", &c[1], &err));
  assert_ok(gg_comparison_write(c[1], "t_own_again.h5", NULL, NULL, &err));
  assert_ok(gg_comparison_read("t_own_again.h5", &c[2], &err));
  gg_measurement md[3], dsmc, none;
  double z[3], value, deviation[3];
  for (int k = 0; k < 3; k++) {
    const gg_result *r = gg_comparison_result(c[k], "md");
    assert_ok(gg_result_find(r, "my_T", &md[k], &err));
    assert_string_equal(md[k].unit, "d\xc2\xb2 gamma\xc2\xb2");
    assert_null(md[k].symbol);
    assert_true(md[k].mean == md[0].mean && md[k].error == md[0].error && md[k].samples == md[0].samples);
    assert_ok(gg_result_find(gg_comparison_result(c[k], "dsmc"), "my_T", &dsmc, &err));
    assert_true(dsmc.mean != md[k].mean);
    assert_ok(gg_result_find(r, "nothing", &none, &err));
    assert_non_null(strstr(none.reason, "NaN or infinite"));
    assert_ok(gg_comparison_agreement(c[k], "my_T", &z[k], NULL, &err));
    assert_true(z[k] == z[0] && !isnan(z[0]));
    assert_ok(gg_comparison_theory_value(c[k], "mine", "my_T", &value, &deviation[k], &err));
    assert_true(value == 7 && deviation[k] == deviation[0]);
    assert_ok(gg_comparison_theory_value(c[k], "mine", "pressure", &value, NULL, &err));
    assert_true(value == 8);
    assert_told(c[k]);
  }
  for (int k = 0; k < 3; k++) gg_comparison_free(c[k]);
}

static void read_back_run(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, engine: dsmc, phi: 0.05, dsmc: {particles: 200}, run: {collisions: 300}}");
  gg_result *r = NULL, *back = NULL;
  gg_comparison *c = NULL;
  double mean[2];
  add_all(s);
  assert_ok(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_own.h5"}, &r, &err));
  assert_ok(gg_result_read("t_own.h5", &back, &err));
  assert_ok(gg_result_get(r, "my_T", &mean[0], NULL, &err));
  assert_ok(gg_result_get(back, "my_T", &mean[1], NULL, &err));
  assert_true(mean[0] == mean[1]);
  gg_result_free(back);
  /* As a comparison of one, which is written as the run that it is. */
  assert_ok(gg_comparison_read("t_own.h5", &c, &err));
  assert_ok(gg_result_get(gg_comparison_result(c, "dsmc"), "my_T", &mean[1], NULL, &err));
  assert_true(mean[0] == mean[1]);
  assert_ok(gg_comparison_write(c, "t_own.h5", NULL, NULL, &err));
  assert_ok(gg_result_read("t_own.h5", &back, &err));
  assert_ok(gg_result_get(back, "my_T", &mean[1], NULL, &err));
  assert_true(mean[0] == mean[1]);
  gg_comparison_free(c);
  gg_result_free(back);
  gg_result_free(r);
  gg_scene_free(s);
}

static double softening(void *context, double speed, int one, int two)
{
  (void)context, (void)one, (void)two;
  return 1 - 0.3 * speed / (1 + speed);
}

/* The law is not in the file, but that no theory applied under it is. */
static void theories_under_a_law(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.05, particles: 200, run: {collisions: 200}}");
  gg_comparison *c = NULL, *back = NULL;
  gg_theory_info t;
  size_t n = 0;
  assert_ok(gg_scene_set_restitution(s, "softening", softening, NULL, &err));
  gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_law.h5"}, &c, &err);
  assert_non_null(c);
  assert_ok(gg_comparison_read("t_law.h5", &back, &err));
  for (; gg_comparison_theory(back, n, &t, NULL) == GG_OK; n++) {
    assert_non_null(t.reason);
    assert_non_null(strstr(t.reason, "softening"));
  }
  assert_true(n > 5);
  gg_comparison_free(c);
  gg_comparison_free(back);
  gg_scene_free(s);
}

static const char *name_thermostat(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)values;
  return facts->thermostat;
}

/* A user-defined theory reads the word of the scene, also of a thermostat of a given strength. */
static void theories_read_the_thermostat_of_the_scene(void **state)
{
  (void)state;
  static const char *const words[][2] = {{"flow: usf", "none"},
                                         {"flow: hss", "gaussian"},
                                         {"flow: hss, gaussian_rate: 0.1", "gaussian"},
                                         {"flow: hss, thermostat: white_noise", "white_noise"},
                                         {"flow: heated_shear, noise_strength: 2", "white_noise"},
                                         {"flow: usf, thermostat: bath", "bath"}};
  const char *const names[] = {"pressure"};
  const gg_theory_definition theory = {"reader", "Reader", NULL, NULL, 1, names, name_thermostat, NULL};
  for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
    char text[160], reason[80];
    gg_error err;
    gg_comparison *c = NULL;
    gg_theory_info t;
    snprintf(text, sizeof text, "{%s, phi: 0.05, collision: {e: 0.9}}", words[k][0]);
    snprintf(reason, sizeof reason, "reader %s", words[k][1]);
    gg_scene *s = scene_of(text);
    assert_ok(gg_scene_add_theory(s, &theory, &err));
    assert_ok(gg_theories_evaluate(s, "reader", NULL, NULL, &c, &err));
    assert_ok(gg_comparison_theory(c, 0, &t, &err));
    assert_string_equal(t.reason, reason);
    gg_comparison_free(c);
    gg_scene_free(s);
  }
}

/* A law is noted in results; that it took the place of collision.e, where that was given. */
static void law_noted(void **state)
{
  (void)state;
  gg_error err;
  for (int given = 0; given < 2; given++) {
    gg_scene *s = scene_of("{flow: usf, phi: 0.05, particles: 200, run: {collisions: 100}}");
    gg_result *r = NULL;
    const char *warning;
    bool noted = false, replaced = false;
    if (given) assert_ok(gg_scene_set(s, "collision.e", "0.8", &err));
    assert_ok(gg_scene_set_restitution(s, "softening", softening, NULL, &err));
    gg_run(s, NULL, &r, &err);
    for (size_t i = 0; (warning = gg_result_warning(r, i)); i++) {
      noted |= strstr(warning, "restitution law 'softening'") != NULL;
      replaced |= strstr(warning, "collision.e was not in force") != NULL;
    }
    assert_true(noted && replaced == given);
    gg_result_free(r);
    gg_scene_free(s);
  }
}

/* Right at the speeds at which laws are tried, which are powers of 10^(1/4); between two of them NaN, or 5. */
static double patchy(void *bad, double speed, int one, int two)
{
  const bool nan = speed > 1.35 && speed < 1.5;
  const bool large = speed > 1.5 && speed < 1.7 && one == two;
  if (nan || large) atomic_fetch_add((atomic_ullong *)bad, 1);
  return nan ? NAN : large ? 5 : 0.9;
}

/* A value of a law outside 0 to 1, or NaN, is clamped and counted: every engine and boundary, threads, replicas
 * and species; the result has the number, a warning says it, also read back. */
static void clamped_laws(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "{flow: usf, engine: md, phi: 0.1, particles: 300, run: {collisions: 60, warmup: 0, replicas: 2}}",
      "{flow: hss, engine: md, phi: 0.1, particles: 300, run: {collisions: 60, warmup: 0}, species: [{mass: 1}, {mass: "
      "2}]}",
      "{flow: couette, engine: md, phi: 0.1, particles: 300, run: {collisions: 60, warmup: 0}}",
      "{flow: usf, engine: dsmc, phi: 0.1, run: {collisions: 60, warmup: 0}}",
      "{flow: usf, engine: dsmc, phi: 0.1, collision: {beta: 0}, run: {collisions: 60, warmup: 0}, dsmc: {particles: "
      "12000}}",
      "{flow: hss, engine: dsmc, phi: 0.1, run: {collisions: 60, warmup: 0, replicas: 2}, species: [{mass: 1}, {mass: "
      "2}]}",
      "{flow: couette, engine: dsmc, phi: 0.1, run: {collisions: 30, warmup: 0}, dsmc: {particles: 12000}}",
  };
  gg_error err;
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
    gg_scene *s = scene_of(scenes[k]);
    gg_result *r[2] = {NULL};
    atomic_ullong bad = 0;
    assert_ok(gg_scene_set_restitution(s, "patchy", patchy, &bad, &err));
    gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_patchy.h5", .threads = 2}, &r[0], &err);
    assert_non_null(r[0]);
    assert_ok(gg_result_read("t_patchy.h5", &r[1], &err));
    for (int i = 0; i < 2; i++) {
      char number[60], *text;
      const char *warning;
      bool said = false;
      snprintf(number, sizeof number, "\"law_clamped\": %llu", bad);
      assert_ok(gg_result_to_json(r[i], &text, &err));
      if (!bad || !strstr(text, number))
        fail_msg("%s: %s is missing: %.60s", scenes[k], number, strstr(text, "\"law_clamped"));
      free(text);
      snprintf(number, sizeof number, "at the speeds of %llu collisions", bad);
      for (size_t w = 0; (warning = gg_result_warning(r[i], w)); w++) said |= strstr(warning, number) != NULL;
      assert_true(said);
      gg_result_free(r[i]);
    }
    gg_scene_free(s);
  }
}

typedef struct impacts {
  double sum, count, least, most; /* of the ratio of <(k.g)^2> to T, over all intervals while averaging */
} impacts;

static void hit(void *context, void *state, const gg_collision_view *c)
{
  double speed = 0;
  (void)context;
  for (int a = 0; a < 3; a++) speed += c->normal[a] * c->relative_velocity[a];
  ((impacts *)state)->sum += speed * speed;
  ((impacts *)state)->count++;
}

static void compare_T(void *context, void *state, const gg_sample *s, double *values)
{
  impacts *now = state, *all = context;
  double T;
  sample_T(NULL, NULL, s, values);
  T = values[0];
  if (now->count > 0) {
    double ratio = now->sum / now->count / T;
    all->least = fmin(all->least, ratio);
    all->most = fmax(all->most, ratio);
  }
  now->sum = now->count = 0;
}

/* The velocities of a cooling gas are brought back now and then: collisions are shown in units of the start all the
 * same, in the interval after that, too; and so are the grains that are left at the end. */
static void collisions_of_a_cooling_gas_have_units_of_the_start(void **state)
{
  (void)state;
  gg_error err;
  for (int k = 0; k < 2; k++) {
    gg_scene *s = scene_of("{flow: hcs, phi: 0.01, particles: 400, dsmc: {particles: 400}, collision: {e: 0.7}, run: "
                           "{collisions: 200, warmup: 10}}");
    impacts all = {.least = INFINITY};
    const gg_quantity_definition quantities[] = {{"T_now", "v_0^2", NULL}, {"unused", NULL, NULL}};
    const gg_observable_definition o = {"impacts", NULL, 2, quantities, sizeof(impacts), compare_T, hit, &all};
    gg_result *r = NULL;
    assert_ok(gg_scene_set(s, "engine", k ? "dsmc" : "md", &err));
    assert_ok(gg_scene_add_observable(s, &o, &err));
    gg_run(s, NULL, &r, &err);
    assert_non_null(r);
    const double *time, *T;
    size_t n;
    assert_ok(gg_result_history(r, "temperature", &n, &time, &T, &err));
    assert_true(T[n - 1] < 1e-6); /* brought back several times */
    if (!(all.least > 2 && all.most < 10)) fail_msg("<g_n^2>/T from %g to %g", all.least, all.most);
    double velocity[1200], sum = 0;
    assert_ok(gg_result_grains(r, &(gg_grains){.velocity = velocity}, &err));
    for (int i = 0; i < 1200; i++) sum += velocity[i] * velocity[i] / 1200;
    assert_true(fabs(sum / T[n - 1] - 1) < 1e-9);
    gg_result_free(r);
    gg_scene_free(s);
  }
}

/* Text that is not UTF-8 would leave no document of the run; names of built-in observables are taken. */
static void invalid_names_are_rejected(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1}");
  const char *const bad[] = {"m\xb2", "\xc2", "\xe0\x80\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "a\tb", "\x7f"};
  gg_quantity_definition q = {"x", NULL, NULL};
  gg_observable_definition o = {"mine", NULL, 1, &q, 0, sample_T, NULL, NULL};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    q.unit = bad[k];
    assert_refused(gg_scene_add_observable(s, &o, &err), "UTF-8");
  }
  q.unit = NULL;
  o.name = "diffusion";
  assert_refused(gg_scene_add_observable(s, &o, &err), "taken");
  o.name = "\xe9tat";
  assert_refused(gg_scene_add_observable(s, &o, &err), "not a valid name");
  o.name = "mine";
  q.unit = "\xc2\xb5m \xe2\x82\xac \xf0\x9f\x8c\xbe";
  assert_ok(gg_scene_add_observable(s, &o, &err));
  gg_scene_free(s);
}

static size_t entries(gg_catalogue catalogue, const gg_scene *s, gg_entry *last)
{
  gg_error err;
  gg_entry entry;
  size_t n = 0;
  while (gg_catalogue_entry(catalogue, n, s, &entry, &err) == GG_OK) *last = entry, n++;
  return n;
}

/* Catalogues of observables and theories end with the user-defined ones of the scene. */
static void catalogues_end_with_user_defined_entries(void **state)
{
  (void)state;
  gg_entry last;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1}");
  const size_t observables = entries(GG_CATALOGUE_OBSERVABLES, s, &last);
  const size_t theories = entries(GG_CATALOGUE_THEORIES, s, &last);
  add_all(s);
  assert_int_equal(entries(GG_CATALOGUE_OBSERVABLES, s, &last), observables + 1);
  assert_string_equal(last.name, "thermometer");
  assert_int_equal(entries(GG_CATALOGUE_THEORIES, s, &last), theories + 2);
  assert_string_equal(last.name, "silent");
  assert_int_equal(entries(GG_CATALOGUE_OBSERVABLES, NULL, &last), observables);
  gg_scene_free(s);
}

/* A reason that is no UTF-8 is made harmless: documents and files are written all the same. */
static void reason_in_latin1(void **state)
{
  (void)state;
  gg_error err;
  gg_comparison *c = NULL;
  gg_theory_info t = {0};
  char *text;
  const char *const names[] = {"pressure"};
  const gg_theory_definition theory = {"mine", NULL, NULL, NULL, 1, names, say_in_latin1, NULL};
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, particles: 50, collision: {beta: 0}, dsmc: {particles: 50}, run: "
                         "{collisions: 20, warmup: 2}}");
  assert_ok(gg_scene_add_theory(s, &theory, &err));
  gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_latin1.h5"}, &c, &err);
  assert_int_equal(access("t_latin1.h5", F_OK), 0);
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK && strcmp(t.name, "mine") != 0;) i++;
  assert_string_equal(t.reason, "mine ist nicht f?r ?[31mdas");
  assert_ok(gg_comparison_to_json(c, &text, &err));
  assert_non_null(strstr(text, "mine ist nicht f?r"));
  unlink("t_latin1.h5");
  free(text);
  gg_comparison_free(c);
  gg_scene_free(s);
}

/* A theory that is not whole is refused by what it lacks; so is the ninth. */
static void theories_refused(void **state)
{
  (void)state;
  gg_error err;
  char name[16];
  const char *const good[] = {"N1"}, *const unknown[] = {"N1", "warmth"}, *const none[] = {NULL};
  gg_scene *s = scene_of("{flow: usf, phi: 0.1}");
  gg_theory_definition t = {"mine", NULL, NULL, NULL, 1, good, say_nothing, NULL};
  assert_refused(gg_scene_add_theory(s, NULL, &err), "the definition is missing");
  t.n_quantities = 0;
  assert_refused(gg_scene_add_theory(s, &t, &err), "at least one quantity");
  t.n_quantities = 2, t.quantities = unknown;
  assert_refused(gg_scene_add_theory(s, &t, &err), "no quantity called 'warmth'");
  t.n_quantities = 1, t.quantities = none;
  assert_refused(gg_scene_add_theory(s, &t, &err), "no quantity called ''");
  t.quantities = good, t.evaluate = NULL;
  assert_refused(gg_scene_add_theory(s, &t, &err), "`evaluate` is missing");
  t.evaluate = say_nothing, t.name = "grad";
  assert_refused(gg_scene_add_theory(s, &t, &err), "taken");
  const char *const columns[] = {"md", "Z", "unit", "dsmc_stderr", "mine_error"};
  for (int k = 0; k < 5; k++) {
    t.name = columns[k];
    assert_refused(gg_scene_add_theory(s, &t, &err), "reserved for columns of tables");
  }
  t.name = name;
  for (int k = 0; k < 8; k++) {
    snprintf(name, sizeof name, "mine_%d", k);
    assert_ok(gg_scene_add_theory(s, &t, &err));
    assert_refused(gg_scene_add_theory(s, &t, &err), "taken");
  }
  snprintf(name, sizeof name, "mine_9");
  assert_refused(gg_scene_add_theory(s, &t, &err), "at most 8 user-defined theories");
  gg_scene_free(s);
}

/* Invalid definitions of observables, in the order of the checks. */
static void observables_refused(void **state)
{
  (void)state;
  gg_error err;
  char long_name[42], long_text[502], name[16];
  memset(long_name, 'a', 41), long_name[41] = 0;
  memset(long_text, 'a', 501), long_text[501] = 0;
  const gg_quantity_definition same[] = {{"x", NULL, NULL}, {"x", NULL, NULL}}, shared = {"N1", NULL, NULL},
                               nameless = {NULL, NULL, NULL}, long_unit = {"x", long_name, NULL},
                               long_doc = {"x", NULL, long_text};
  const struct {
    gg_observable_definition o;
    const char *said;
  } bad[] = {{{NULL, NULL, 1, same, 0, sample_T, NULL, NULL}, "observable: a name is missing"},
             {{"", NULL, 1, same, 0, sample_T, NULL, NULL}, "observable: a name is missing"},
             {{"1st", NULL, 1, same, 0, sample_T, NULL, NULL}, "'1st' is not a valid name"},
             {{"[x", NULL, 1, same, 0, sample_T, NULL, NULL}, "'[x' is not a valid name"},
             {{"a-b", NULL, 1, same, 0, sample_T, NULL, NULL}, "'a-b' is not a valid name"},
             {{"a:b", NULL, 1, same, 0, sample_T, NULL, NULL}, "'a:b' is not a valid name"},
             {{"a{b", NULL, 1, same, 0, sample_T, NULL, NULL}, "'a{b' is not a valid name"},
             {{long_name, NULL, 1, same, 0, sample_T, NULL, NULL}, "at most 40"},
             {{"x", long_text, 1, same, 0, sample_T, NULL, NULL}, "at most 500 bytes"},
             {{"x", NULL, 1, same, 0, NULL, NULL, NULL}, "`sample` is missing"},
             {{"x", NULL, 0, same, 0, sample_T, NULL, NULL}, "at least one quantity"},
             {{"x", NULL, 1, NULL, 0, sample_T, NULL, NULL}, "at least one quantity"},
             {{"x", NULL, 1000, same, 0, sample_T, NULL, NULL}, "user-defined quantities"},
             {{"x", NULL, 1, same, (1u << 24) + 1, sample_T, NULL, NULL}, "16 MiB"},
             {{"x", NULL, 2, same, 0, sample_T, NULL, NULL}, "quantity: the name 'x' is taken"},
             {{"x", NULL, 1, &shared, 0, sample_T, NULL, NULL}, "quantity: the name 'N1' is taken"},
             {{"x", NULL, 1, &nameless, 0, sample_T, NULL, NULL}, "quantity: a name is missing"},
             {{"x", NULL, 1, &long_unit, 0, sample_T, NULL, NULL}, "at most 40 bytes"},
             {{"x", NULL, 1, &long_doc, 0, sample_T, NULL, NULL}, "at most 500 bytes"}};
  gg_scene *s = scene_of("{flow: usf, phi: 0.1}");
  assert_refused(gg_scene_add_observable(s, NULL, &err), "the definition is missing");
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
    assert_refused(gg_scene_add_observable(s, &bad[k].o, &err), bad[k].said);
  assert_refused(gg_scene_add_observable(NULL, &bad[9].o, &err), "the scene is missing");
  assert_refused(gg_scene_add_theory(NULL, NULL, &err), "the scene is missing");
  /* A registered observable takes its name, and the number of user-defined quantities is limited. */
  gg_quantity_definition q = {name, NULL, NULL};
  gg_observable_definition o = {name, NULL, 1, &q, 0, sample_T, NULL, NULL};
  int n = 0;
  for (gg_status status = GG_OK; status == GG_OK; n += status == GG_OK) {
    snprintf(name, sizeof name, "own_%d", n);
    status = gg_scene_add_observable(s, &o, &err);
    if (status == GG_OK) assert_refused(gg_scene_add_observable(s, &o, &err), "observable: the name");
  }
  assert_true(n >= 8 && strstr(err.message, "user-defined quantities"));
  gg_scene_free(s);
}

/* A law, and a table of one: speeds ascend, e is from 0 to 1. */
static void laws_refused(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1}");
  const struct {
    double speed[2], e[2];
    const char *said;
  } bad[] = {{{-1, 1}, {1, 1}, "speed 1 of the table is -1; speeds must ascend from 0 on"},
             {{0, INFINITY}, {1, 1}, "speed 2 of the table is inf"},
             {{0, NAN}, {1, 1}, "speed 2 of the table is nan"},
             {{1, 1}, {1, 1}, "speed 2 of the table is 1"},
             {{0, 1}, {1.1, 1}, "e 1 of the table is 1.1; it must be from 0 to 1"},
             {{0, 1}, {1, -0.1}, "e 2 of the table is -0.1"},
             {{0, 1}, {1, NAN}, "e 2 of the table is nan"}};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
    assert_refused(gg_scene_set_restitution_table(s, "soft", 2, bad[k].speed, bad[k].e, &err), bad[k].said);
  const double *speed = bad[0].speed;
  assert_refused(gg_scene_set_restitution_table(NULL, "soft", 2, speed, speed, &err), "the scene is missing");
  assert_refused(gg_scene_set_restitution_table(s, NULL, 2, speed, speed, &err), "a name is missing");
  assert_refused(gg_scene_set_restitution_table(s, "soft", 0, speed, speed, &err), "a table has 1 to");
  assert_refused(gg_scene_set_restitution_table(s, "soft", (1u << 20) + 1, speed, speed, &err), "a table has 1 to");
  assert_refused(gg_scene_set_restitution_table(s, "soft", 2, NULL, speed, &err), "a table has 1 to");
  assert_refused(gg_scene_set_restitution_table(s, "soft", 2, speed, NULL, &err), "a table has 1 to");
  assert_refused(gg_scene_set_restitution(NULL, "soft", softening, NULL, &err), "the scene is missing");
  assert_refused(gg_scene_set_restitution(s, "so ft", softening, NULL, &err), "is not a valid name");
  /* Taken away again, collision.e is in force: the bits of a scene that never had one. */
  gg_simulation *m[2] = {NULL};
  gg_simulation_state now[2];
  for (int k = 0; k < 2; k++) {
    if (k) assert_ok(gg_scene_set_restitution(s, "softening", softening, NULL, &err));
    if (k) assert_ok(gg_scene_set_restitution(s, NULL, NULL, NULL, &err));
    assert_ok(gg_simulation_new(s, NULL, &m[k], &err));
    assert_ok(gg_simulation_collide(m[k], 500, &err));
    assert_ok(gg_simulation_get_state(m[k], &now[k], &err));
    gg_simulation_free(m[k]);
  }
  assert_true(now[0].temperature == now[1].temperature);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(user_defined_results_are_read_back),
      cmocka_unit_test(read_back_run),
      cmocka_unit_test(theories_under_a_law),
      cmocka_unit_test(theories_read_the_thermostat_of_the_scene),
      cmocka_unit_test(collisions_of_a_cooling_gas_have_units_of_the_start),
      cmocka_unit_test(invalid_names_are_rejected),
      cmocka_unit_test(law_noted),
      cmocka_unit_test(catalogues_end_with_user_defined_entries),
      cmocka_unit_test(theories_refused),
      cmocka_unit_test(observables_refused),
      cmocka_unit_test(laws_refused),
      cmocka_unit_test(clamped_laws),
      cmocka_unit_test(reason_in_latin1),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
