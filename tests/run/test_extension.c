/* What a user's program brings: observables are measured as ours are, theories answer beside ours, a law of restitution
 * is obeyed by both engines; whatever is wrong with a definition is refused. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "io/document.h"
#include "io/scene/reader.h"
#include "run/run.h"

static gg_scene *scene_of(const char *yaml)
{
  gg_scene *scene = NULL;
  gg_error err;
  if (gg_scene_parse(yaml, "scene", &scene, &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_scene_finish(scene, &err) != GG_OK) fail_msg("%s", err.message); /* as runs do with their copies */
  return scene;
}

static gg_result *run(const gg_scene *scene, int threads)
{
  gg_result *result = NULL;
  gg_error err;
  if (gg_run_scene(scene, NULL, threads, NULL, &result, &err) != GG_OK) fail_msg("%s", err.message);
  return result;
}

static const char sheared[] = "{flow: usf, phi: 0.1, particles: 400, run: {collisions: 100, warmup: 20}}";
static const char sheared_dsmc[] = "{flow: usf, engine: dsmc, phi: 0.1, run: {collisions: 60, warmup: 20}}";

/* ---- observables ---- */

static void sample_temperature(void *context, void *state, const gg_sample *s, double *values)
{
  double sum = 0, *samples = state;
  (void)context;
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) sum += s->velocity[i][a] * s->velocity[i][a];
  values[0] = sum / (3 * (double)s->n);
  values[1] = -s->stress[0][1];
  values[2] = ++*samples;
}

static void count_collision(void *context, void *state, const gg_collision_view *c)
{
  double normal_speed = 0, one = 0;
  for (int a = 0; a < 3; a++)
    normal_speed += c->normal[a] * c->relative_velocity[a], one += c->normal[a] * c->normal[a];
  (void)context;
  if (normal_speed > 0 && fabs(one - 1) < 1e-12) ((uint64_t *)state)[0]++;
}
static void sample_collisions(void *context, void *state, const gg_sample *s, double *values)
{
  uint64_t *count = state;
  (void)context;
  values[0] = 2 * (double)*count / ((double)s->n * s->elapsed);
  *count = 0;
}

static const gg_quantity_definition own_temperature[] = {
    {"my_temperature", "d^2 gamma^2", "<C.C>/3"}, {"my_stress", "rho_p d^2 gamma^2", NULL}, {"my_samples", NULL, NULL}};
static const gg_quantity_definition own_rate[] = {{"my_rate", "gamma", NULL}};
static const gg_observable_definition thermometer = {"thermometer",  "a temperature",    3,    own_temperature,
                                                     sizeof(double), sample_temperature, NULL, NULL};
static const gg_observable_definition counter = {
    "counter", NULL, 1, own_rate, sizeof(uint64_t), sample_collisions, count_collision, NULL};

static void add(gg_scene *scene, const gg_observable_definition *o)
{
  gg_error err;
  if (gg_scene_add_observable(scene, o, &err) != GG_OK) fail_msg("%s", err.message);
}

static void same_estimate(const gg_result *r, const char *name, gg_quantity q, double tolerance)
{
  const gg_estimate *mine = &r->value[gg_quantity_find_in(&r->model, name)], *ours = &r->value[q];
  if (!(fabs(mine->mean / ours->mean - 1) < tolerance && fabs(mine->error / ours->error - 1) < 1e-2))
    fail_msg("%s = %.12g +- %g, ours %.12g +- %g", name, mine->mean, mine->error, ours->mean, ours->error);
  assert_int_equal(mine->samples, ours->samples);
}

/* A quantity of one's own that is one of ours has its mean and its error, in either engine, smooth and rough. */
static void test_observable(void **state)
{
  (void)state;
  const char *const scenes[] = {sheared, sheared_dsmc,
                                "{flow: usf, phi: 0.1, particles: 400, collision: {beta: 0}, run: {collisions: 100, "
                                "warmup: 20, replicas: 2}}"};
  for (int k = 0; k < 3; k++) {
    gg_scene *scene = scene_of(scenes[k]);
    add(scene, &thermometer);
    add(scene, &counter);
    gg_result *r = run(scene, 2);
    gg_scene_free(scene); /* a result keeps the names */
    same_estimate(r, "my_temperature", GG_Q_TEMPERATURE, 1e-9);
    same_estimate(r, "my_rate", GG_Q_COLLISION_RATE, 1e-9);
    const gg_estimate *stress = &r->value[gg_quantity_find_in(&r->model, "my_stress")];
    assert_true(fabs(stress->mean / -r->value[GG_Q_P_XY_COLLISIONAL].mean - 1) < 1e-9);
    assert_true(r->value[gg_quantity_find_in(&r->model, "my_samples")].mean > 20);
    json_t *document = gg_run_document(r),
           *mine = json_object_get(json_object_get(document, "results"), "my_temperature");
    assert_string_equal(json_string_value(json_object_get(mine, "unit")), "d^2 gamma^2");
    assert_true(json_is_real(json_object_get(mine, "stderr")));
    json_decref(document);
    double mean;
    assert_int_equal(gg_result_get(r, "my_rate", &mean, NULL, NULL), GG_OK);
    assert_string_equal(gg_result_unit(r, "my_samples"), "1");
    gg_result_free(r);
  }
}

/* An observable changes nothing of the run in md, even one that is shown every collision. */
static void test_observer_leaves_no_trace(void **state)
{
  (void)state;
  gg_scene *scene = scene_of(sheared), *counted = scene_of(sheared);
  add(counted, &counter);
  gg_result *r = run(scene, 1), *w = run(counted, 1);
  assert_true(r->value[GG_Q_PRESSURE].mean == w->value[GG_Q_PRESSURE].mean);
  gg_result_free(r), gg_result_free(w);
  gg_scene_free(scene), gg_scene_free(counted);
}

static void sample_nan(void *context, void *state, const gg_sample *s, double *values)
{
  (void)context, (void)state, (void)s, (void)values; /* as it is preset */
}

static void test_no_number(void **state)
{
  (void)state;
  const gg_quantity_definition q = {"nothing", NULL, NULL};
  const gg_observable_definition o = {"silent", NULL, 1, &q, 0, sample_nan, NULL, NULL};
  gg_scene *scene = scene_of(sheared);
  add(scene, &o);
  gg_result *r = run(scene, 1);
  gg_error err;
  assert_int_equal(gg_result_get(r, "nothing", NULL, NULL, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "no number"));
  gg_result_free(r);
  gg_scene_free(scene);
}

static void refused(gg_status status, const gg_error *err, const char *word)
{
  assert_int_equal(status, GG_BAD_INPUT);
  if (!strstr(err->message, word)) fail_msg("'%s' does not say '%s'", err->message, word);
}

static void test_bad_observables(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *scene = scene_of(sheared);
  const struct {
    const char *name, *quantity, *word;
    int n;
  } cases[] = {{NULL, "x", "missing", 1},        {"two words", "x", "no name", 1},   {"o", "1x", "no name", 1},
               {"o", NULL, "missing", 1},        {"o", "temperature", "taken", 1},   {"o", "x", "at least one", 0},
               {"thermometer", "x", "taken", 1}, {"o", "my_temperature", "taken", 1}};
  add(scene, &thermometer);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    const gg_quantity_definition q = {cases[k].quantity, NULL, NULL};
    const gg_observable_definition o = {cases[k].name, NULL, cases[k].n, &q, 0, sample_nan, NULL, NULL};
    refused(gg_scene_add_observable(scene, &o, &err), &err, cases[k].word);
  }
  gg_observable_definition o = thermometer;
  o.name = "o", o.quantities = own_rate, o.n_quantities = 1, o.sample = NULL;
  refused(gg_scene_add_observable(scene, &o, &err), &err, "sample");
  refused(gg_scene_add_observable(scene, NULL, &err), &err, "definition");
  refused(gg_scene_add_observable(NULL, &counter, &err), &err, "scene");
  gg_quantity_definition many[40] = {{0}};
  o.sample = sample_nan, o.quantities = many, o.n_quantities = 40;
  refused(gg_scene_add_observable(scene, &o, &err), &err, "at most");
  gg_quantity_definition lines = {"x", "two\nlines", NULL};
  o.quantities = &lines, o.n_quantities = 1;
  refused(gg_scene_add_observable(scene, &o, &err), &err, "one line");
  assert_int_equal(gg_extension_quantities(scene->extension), 3); /* as it was */
  gg_scene_free(scene);
}

/* ---- theories ---- */

static const char *pressure_of_enskog(void *context, const gg_facts *f, double *values)
{
  int *asked = context;
  ++*asked;
  if (strcmp(f->flow, "equilibrium") != 0) return "describes equilibrium";
  values[0] = f->stress_unit * f->density * f->temperature * (1 + 4 * f->phi * f->pairs[0].contact_value);
  values[2] = 7;
  return NULL;
}

static void test_theory(void **state)
{
  (void)state;
  int asked = 0;
  gg_error err;
  const char *const quantities[] = {"pressure", "cooling_rate", "my_samples"};
  const gg_theory_definition mine = {"mine", NULL, "a note of 2026", NULL, 3, quantities, pressure_of_enskog, &asked};
  const char yaml[] = "{flow: equilibrium, phi: 0.1, particles: 400, run: {collisions: 60, warmup: 20}}";
  gg_scene *scene = scene_of(yaml);
  refused(gg_scene_add_theory(scene, &mine, &err), &err, "my_samples"); /* not yet */
  add(scene, &thermometer);
  assert_int_equal(gg_scene_add_theory(scene, &mine, &err), GG_OK);
  refused(gg_scene_add_theory(scene, &mine, &err), &err, "taken");
  gg_theory_definition bad = mine;
  bad.name = "enskog";
  refused(gg_scene_add_theory(scene, &bad, &err), &err, "taken");
  bad.name = "other", bad.evaluate = NULL;
  refused(gg_scene_add_theory(scene, &bad, &err), &err, "evaluate");
  refused(gg_scene_add_theory(scene, NULL, &err), &err, "definition");

  gg_comparison c;
  if (gg_compare_scene(scene, NULL, 2, NULL, &c, &err) != GG_OK) fail_msg("%s", err.message);
  gg_scene_free(scene);
  assert_int_equal(asked, 1);
  json_t *document = gg_comparison_document(&c), *theory = json_object_get(document, "theory");
  double own = json_number_value(json_object_get(json_object_get(json_object_get(theory, "mine"), "pressure"), "mean"));
  double ours =
      json_number_value(json_object_get(json_object_get(json_object_get(theory, "enskog"), "pressure"), "mean"));
  assert_true(fabs(own / ours - 1) < 1e-12);
  assert_null(json_object_get(json_object_get(theory, "mine"), "cooling_rate"));
  json_t *row, *found = NULL;
  size_t i;
  json_array_foreach(json_object_get(document, "comparison"), i, row)
  {
    const char *quantity = json_string_value(json_object_get(row, "quantity"));
    if (strcmp(quantity, "my_samples") == 0) found = row;
    if (strcmp(quantity, "pressure") == 0)
      assert_true(json_is_real(json_object_get(json_object_get(row, "md_theory_deviation"), "mine")));
  }
  assert_non_null(found);
  assert_true(json_is_real(json_object_get(json_object_get(found, "md_theory_deviation"), "mine")));
  json_decref(document);
  gg_comparison_clear(&c);
}

/* ---- restitution ---- */

static double constant(void *context, double speed, int one, int two)
{
  (void)speed, (void)one, (void)two;
  return *(const double *)context;
}

static double falling(void *context, double speed, int one, int two)
{
  (void)context, (void)one, (void)two;
  return 1 / (1 + 0.08 * pow(speed, 0.2));
}

static double above_one(void *context, double speed, int one, int two)
{
  (void)context, (void)one, (void)two;
  return speed > 100 ? 1.5 : 0.9;
}

static void set_law(gg_scene *scene, const char *name, gg_restitution *law, void *context)
{
  gg_error err;
  if (gg_scene_set_restitution(scene, name, law, context, &err) != GG_OK) fail_msg("%s", err.message);
}

/* A law that returns a constant is that constant: the same run of md, bit for bit, smooth, rough and of two species;
 * the same means of dsmc, which takes another path. */
static void test_constant_law(void **state)
{
  (void)state;
  double e = 0.9;
  const char *const scenes[] = {
      sheared,
      "{flow: usf, phi: 0.3, particles: 400, collision: {beta: 0.2, mu: 0.3}, run: {collisions: 40, warmup: 10}}",
      "{flow: hcs, phi: 0.1, particles: 400, species: [{fraction: 0.5}, {fraction: 0.5, mass: 4}], run: {collisions: "
      "40, "
      "warmup: 10}}",
      "{flow: hss, phi: 0.1, particles: 400, run: {collisions: 40, warmup: 10}}"};
  for (int k = 0; k < 4; k++) {
    gg_scene *plain = scene_of(scenes[k]), *lawful = scene_of(scenes[k]);
    set_law(lawful, "constant", constant, &e);
    gg_result *one = run(plain, 1), *two = run(lawful, 1);
    assert_true(one->model.temperature0 == two->model.temperature0);
    assert_int_equal(one->final.n, two->final.n);
    assert_memory_equal(one->final.velocity, two->final.velocity, 3 * one->final.n * sizeof(double));
    assert_int_equal(one->total.collisions, two->total.collisions);
    gg_result_free(one), gg_result_free(two);
    gg_scene_free(plain), gg_scene_free(lawful);
  }
}

static void test_constant_law_dsmc(void **state)
{
  (void)state;
  double e = 0.9;
  gg_scene *plain = scene_of(sheared_dsmc), *lawful = scene_of(sheared_dsmc);
  set_law(lawful, "constant", constant, &e);
  gg_result *one = run(plain, 1), *two = run(lawful, 1);
  const gg_quantity all[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY, GG_Q_DISSIPATION};
  for (int k = 0; k < 4; k++) {
    double z = gg_z_score(&one->value[all[k]], &two->value[all[k]]);
    if (!(fabs(z) < 4.5)) fail_msg("%s: z = %.1f", gg_quantity_name(all[k]), z);
  }
  gg_result_free(one), gg_result_free(two);
  gg_scene_free(plain), gg_scene_free(lawful);
}

/* Both engines under a law e(g): shear work is what collisions lose; they agree where the gas is dilute. Theories of a
 * constant e do not apply. */
static void test_falling_law(void **state)
{
  (void)state;
  gg_error err;
  gg_comparison c;
  gg_scene *scene = scene_of("{flow: usf, phi: 0.01, particles: 1000, run: {collisions: 400, warmup: 60}}");
  set_law(scene, "falling", falling, NULL);
  if (gg_compare_scene(scene, NULL, 2, NULL, &c, &err) != GG_OK) fail_msg("%s", err.message);
  for (int k = 0; k < 2; k++) {
    const gg_estimate *balance = &c.by_engine[k]->value[GG_Q_ENERGY_BALANCE];
    if (!(fabs(balance->mean - 1) < 4.5 * balance->error && balance->error < 0.02))
      fail_msg("energy balance %g +- %g", balance->mean, balance->error);
  }
  double md = c.by_engine[GG_MD]->value[GG_Q_TEMPERATURE].mean,
         dsmc = c.by_engine[GG_DSMC]->value[GG_Q_TEMPERATURE].mean;
  double z = gg_z_score(&c.by_engine[GG_MD]->value[GG_Q_TEMPERATURE], &c.by_engine[GG_DSMC]->value[GG_Q_TEMPERATURE]);
  print_message("# T: md %g, dsmc %g, z = %.1f\n", md, dsmc, z);
  assert_true(fabs(md / dsmc - 1) < 0.01 || fabs(z) < 3);
  for (int i = 0; i < c.n_theories; i++) assert_false(c.theory[i].applies);
  assert_non_null(strstr(c.theory[0].reason, "'falling'"));
  gg_comparison_clear(&c);
  gg_scene_free(scene);
}

/* e = 1 below a speed that nothing reaches is a gas that loses nothing; 0.5 above one that all exceed is e = 0.5. */
static void test_limits_of_a_table(void **state)
{
  (void)state;
  gg_error err;
  const double far[] = {1e6, 1e7}, near[] = {1e-9, 1e-8}, e[] = {1, 0.5};
  gg_scene *scene = scene_of("{flow: hcs, engine: dsmc, phi: 0.1, run: {collisions: 40, warmup: 5}}");
  assert_int_equal(gg_scene_set_restitution_table(scene, "far", 2, far, e, &err), GG_OK);
  gg_result *r = run(scene, 1);
  assert_true(fabs(r->value[GG_Q_COOLING_RATE].mean) < 1e-9);
  gg_result_free(r);
  assert_int_equal(gg_scene_set_restitution_table(scene, "near", 2, near, e, &err), GG_OK);
  r = run(scene, 1);
  gg_scene *half =
      scene_of("{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.5}, run: {collisions: 40, warmup: 5}}");
  gg_result *expected = run(half, 1);
  double z = gg_z_score(&r->value[GG_Q_COOLING_RATE], &expected->value[GG_Q_COOLING_RATE]);
  if (!(fabs(z) < 4.5)) fail_msg("cooling rate: z = %.1f", z);
  gg_result_free(r), gg_result_free(expected);
  gg_scene_free(scene), gg_scene_free(half);
}

/* Velocities of a cooling gas are brought back now and then: a law of speed must not notice. With e = 1 below a speed
 * the gas stops cooling there, at the same temperature in both engines. */
static void test_law_of_a_cooling_gas(void **state)
{
  (void)state;
  gg_error err;
  const double speed[] = {0.02, 0.04}, e[] = {1, 0.6};
  double coldest[2];
  for (int k = 0; k < 2; k++) {
    gg_scene *scene = scene_of("{flow: hcs, phi: 0.01, particles: 300, run: {collisions: 600, warmup: 10}}");
    gg_scene_set(scene, "engine", k ? "dsmc" : "md", NULL);
    assert_int_equal(gg_scene_set_restitution_table(scene, "stops", 2, speed, e, &err), GG_OK);
    gg_result *r = NULL;
    gg_run_scene(scene, NULL, 1, NULL, &r, &err);
    assert_non_null(r);
    coldest[k] = r->history.value[0][r->history.n - 1];
    print_message("# %s: T = %g at the end\n", r->engine, coldest[k]);
    assert_true(coldest[k] > 1e-6 && coldest[k] < 1e-3);
    gg_result_free(r);
    gg_scene_free(scene);
  }
  assert_true(fabs(log(coldest[0] / coldest[1])) < 0.3);
}

static void test_bad_laws(void **state)
{
  (void)state;
  gg_error err;
  double e = 0.9, nan = NAN;
  const double speed[] = {1, 2}, back[] = {2, 1}, good[] = {0.9, 0.8}, bad[] = {0.9, 1.1};
  gg_scene *scene = scene_of(sheared);
  refused(gg_scene_set_restitution(NULL, "x", constant, &e, &err), &err, "scene");
  refused(gg_scene_set_restitution(scene, NULL, constant, &e, &err), &err, "missing");
  refused(gg_scene_set_restitution(scene, "x y", constant, &e, &err), &err, "no name");
  refused(gg_scene_set_restitution(scene, "x", constant, &nan, &err), &err, "from 0 to 1");
  refused(gg_scene_set_restitution(scene, "x", above_one, NULL, &err), &err, "1.5");
  refused(gg_scene_set_restitution_table(scene, "x", 0, speed, good, &err), &err, "table");
  refused(gg_scene_set_restitution_table(scene, "x", 2, NULL, good, &err), &err, "table");
  refused(gg_scene_set_restitution_table(scene, "x", 2, back, good, &err), &err, "ascend");
  refused(gg_scene_set_restitution_table(scene, "x", 2, speed, bad, &err), &err, "from 0 to 1");
  assert_null(scene->extension);
  set_law(scene, "x", constant, &e);
  set_law(scene, NULL, NULL, NULL); /* back to a constant */
  gg_model m;
  assert_int_equal(gg_model_make(scene, GG_MD, &m, &err), GG_OK);
  assert_true(m.law.e == NULL);
  gg_scene_free(scene);
}

/* ---- checkpoints and threads ---- */

typedef struct stopping {
  gg_archive last;
  int left;
} stopping;

static bool interrupted(void *context)
{
  return ((stopping *)context)->left-- <= 0;
}

static gg_status keep(void *context, gg_archive *archive, gg_error *err)
{
  stopping *s = context;
  gg_archive_clear(&s->last);
  return gg_archive_append(&s->last, archive, err);
}

/* A run under a law and with an observable of its own goes on bit for bit, if both are registered again, and says so if
 * they are not. */
static void test_resume(void **state)
{
  (void)state;
  gg_error err;
  const char yaml[] = "{flow: hcs, phi: 0.1, particles: 300, run: {collisions: 120, warmup: 10}, output: "
                      "{checkpoint_every: 1000}}";
  gg_scene *scene = scene_of(yaml), *bare = scene_of(yaml);
  set_law(scene, "falling", falling, NULL);
  add(scene, &thermometer);
  gg_result *whole = NULL, *resumed = NULL;
  gg_run_scene(scene, NULL, 1, NULL, &whole, &err); /* its state is not steady: e rises as it cools */
  stopping s = {.left = 40};
  gg_hooks hooks = {.context = &s, .interrupted = interrupted, .checkpoint = keep};
  gg_result *cut = NULL;
  assert_int_equal(gg_run_scene(scene, NULL, 1, &hooks, &cut, &err), GG_INTERRUPTED);
  gg_result_free(cut);
  cut = NULL;
  refused(gg_run_scene(bare, &s.last, 1, NULL, &cut, &err), &err, "law falling; observable thermometer");
  assert_null(cut);
  gg_run_scene(scene, &s.last, 1, NULL, &resumed, &err);
  assert_non_null(whole);
  assert_non_null(resumed);
  assert_memory_equal(whole->final.velocity, resumed->final.velocity, 3 * whole->final.n * sizeof(double));
  int q = gg_quantity_find_in(&whole->model, "my_temperature");
  assert_true(whole->value[q].mean == resumed->value[q].mean);
  gg_archive_clear(&s.last);
  gg_result_free(whole), gg_result_free(resumed);
  gg_scene_free(scene), gg_scene_free(bare);
}

static void *run_in_thread(void *scene)
{
  return run(scene, 1);
}

/* Two scenes in two threads, each with its own additions, do not see each other. */
static void test_two_threads(void **state)
{
  (void)state;
  double e[] = {0.9, 0.7};
  gg_scene *scene[2];
  gg_result *alone[2], *beside[2];
  pthread_t thread[2];
  for (int k = 0; k < 2; k++) {
    scene[k] = scene_of(sheared);
    set_law(scene[k], "constant", constant, &e[k]);
    add(scene[k], k ? &counter : &thermometer);
    alone[k] = run(scene[k], 1);
  }
  for (int k = 0; k < 2; k++) assert_int_equal(pthread_create(&thread[k], NULL, run_in_thread, scene[k]), 0);
  for (int k = 0; k < 2; k++) {
    void *result;
    pthread_join(thread[k], &result);
    beside[k] = result;
    int q = gg_quantity_find_in(&beside[k]->model, k ? "my_rate" : "my_temperature");
    assert_true(q < GG_MOST_QUANTITIES);
    assert_true(alone[k]->value[q].mean == beside[k]->value[q].mean);
    gg_result_free(alone[k]), gg_result_free(beside[k]);
    gg_scene_free(scene[k]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_observable),
      cmocka_unit_test(test_observer_leaves_no_trace),
      cmocka_unit_test(test_no_number),
      cmocka_unit_test(test_bad_observables),
      cmocka_unit_test(test_theory),
      cmocka_unit_test(test_constant_law),
      cmocka_unit_test(test_constant_law_dsmc),
      cmocka_unit_test(test_falling_law),
      cmocka_unit_test(test_limits_of_a_table),
      cmocka_unit_test(test_law_of_a_cooling_gas),
      cmocka_unit_test(test_bad_laws),
      cmocka_unit_test(test_resume),
      cmocka_unit_test(test_two_threads),
  };
  return cmocka_run_group_tests_name("extension", tests, NULL, NULL);
}
