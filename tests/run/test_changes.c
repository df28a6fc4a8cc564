/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: what is measured after a change of the protocol is what a run of the changed scene measures from the same
 * grains on, to the last bit. Every observable, every kind of change, both engines. The reference is a replica that was
 * created for the changed scene, and gets a copy of the engine just after the change. Energy is balanced across it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graingas.h"

#include "run/replica.h"
#include "run/run.h"
#include "run/series_means.h"
#include "scene/fields.h"
#include "scene/scene_reader.h"

/* Samples up to the change, and in all. The run has 100: times of change and of samples are the same numbers. */
enum { BEFORE = 4, ALL = 48 };

static void expect_ok(gg_status status, const char *what, const gg_error *err)
{
  if (status != GG_OK) fail_msg("%s: %s", what, err->message);
}

static void read_scene(const char *start, const char *change, gg_engine_kind engine, gg_scene *scene)
{
  char yaml[700];
  gg_error err = {0};
  snprintf(yaml, sizeof yaml,
           "{%s, particles: 50, dsmc: {particles: 80}, run: {duration: 100}, protocol: [{at: %d, %s}]}", start, BEFORE,
           change);
  *scene = gg_scene_defaults();
  expect_ok(gg_scene_read(scene, yaml, strlen(yaml), "test", &err), yaml, &err);
  scene->engine = engine;
  for (int i = 0; gg_measure_observables[i]; i++) scene->measure |= gg_measure_observables[i]->flag;
  expect_ok(gg_scene_finish(scene, &err), yaml, &err);
}

static void create(const gg_scene *scene, gg_replica *r)
{
  gg_model m;
  gg_error err = {0};
  expect_ok(gg_run_start_make(scene, NULL, NULL, &m, &err), "model", &err);
  expect_ok(gg_run_replica_create(r, scene, &m, 0, &err), "replica", &err);
}

/* Engine and clock of another; and what its rows remember of the sample before. */
static void continue_with(const gg_replica *from, gg_replica *to)
{
  gg_archive archive = {0};
  gg_error err = {0};
  const gg_engine_ops *ops = from->engine->ops;
  to->engine->ops->destroy(to->engine);
  expect_ok(ops->save(from->engine, &archive, &err), "save", &err);
  expect_ok(ops->restore(&to->model, &archive, &to->engine, &err), "restore", &err);
  gg_base_archive_clear(&archive);
  to->clock = from->clock;
  to->clock.changes = 0;
  assert_int_equal(from->sampler.n_observables, to->sampler.n_observables);
  for (int k = 0; k < to->sampler.n_observables; k++) {
    const gg_observable *o = to->sampler.observable[k];
    size_t bytes, same;
    assert_ptr_equal(o, from->sampler.observable[k]);
    if (!o->rows || !o->memory) continue;
    void *memory = o->memory(to->sampler.self[k], &bytes);
    memcpy(memory, o->memory(from->sampler.self[k], &same), bytes);
    assert_int_equal(bytes, same);
  }
}

static gg_curves curves_of(const gg_replica *r, int k)
{
  const gg_bins *list[] = {&r->sampler.bins[k]};
  const gg_observable *o = r->sampler.observable[k];
  gg_curves curves = {.model = &r->model};
  gg_error err = {0};
  expect_ok(gg_measure_curves_estimate(list, 1, o->curves->of_bins, r->sampler.self[k], o->name, 0, &curves, &err),
            o->name, &err);
  return curves;
}

static bool same_numbers(const double *a, const double *b, size_t n)
{
  for (size_t i = 0; i < n; i++)
    if (memcmp(&a[i], &b[i], sizeof *a) != 0 && !(isnan(a[i]) && isnan(b[i]))) return false;
  return true;
}

/* Curves with their numbers; returns how many points are known. */
static size_t compare_curves(const char *what, const gg_replica *a, const gg_replica *b, int k)
{
  gg_curves one = curves_of(a, k), two = curves_of(b, k);
  size_t known = 0;
  if (one.n != two.n) fail_msg("%s: %s: %d curves and %d", what, a->sampler.observable[k]->name, one.n, two.n);
  for (int i = 0; i < one.n; i++) {
    const gg_curve *c = &one.curve[i], *d = &two.curve[i];
    assert_string_equal(c->name, d->name);
    assert_int_equal(c->n, d->n);
    if (!same_numbers(c->x, d->x, c->n) || !same_numbers(c->value, d->value, c->n) ||
        !same_numbers(c->error, d->error, c->n))
      fail_msg("%s: %s differs", what, c->name);
    assert_int_equal(c->n_numbers, d->n_numbers);
    for (int j = 0; j < c->n_numbers; j++)
      if (!same_numbers(&c->number[j].value, &d->number[j].value, 1))
        fail_msg("%s: %s: %s is %.9g, expected %.9g", what, c->name, c->number[j].name, c->number[j].value,
                 d->number[j].value);
    for (size_t p = 0; p < c->n; p++) known += isfinite(c->value[p]);
  }
  gg_measure_curves_clear(&one);
  gg_measure_curves_clear(&two);
  return known;
}

static void compare_values(const char *what, const gg_replica *a, const gg_replica *b)
{
  for (int at = 0; at < gg_common_quantity_set_of(&a->model); at++) {
    const gg_quantity q = gg_common_quantity_at(&a->model, at);
    gg_function f;
    double value[2];
    const gg_replica *const both[] = {a, b};
    for (int i = 0; i < 2; i++) {
      const int k = gg_measure_sampler_find(&both[i]->sampler, q, &f);
      value[i] = k < 0 ? NAN : gg_function_value(f, both[i]->sampler.row + both[i]->sampler.offset[k], &both[i]->model);
    }
    if (!same_numbers(&value[0], &value[1], 1))
      fail_msg("%s: %s is %.9g, expected %.9g", what, gg_common_quantity_name(q), value[0], value[1]);
  }
}

/* Returns the flags of what was measured. */
static unsigned compare(const char *start, const char *change, gg_engine_kind engine)
{
  gg_scene scene, after;
  gg_replica changed, same;
  gg_error err = {0};
  char what[500];
  unsigned measured = 0;
  snprintf(what, sizeof what, "%s, %s, then %s", engine == GG_MD ? "md" : "dsmc", start, change);
  read_scene(start, change, engine, &scene);
  expect_ok(gg_scene_protocol_apply(&scene, gg_scene_protocol_count(&scene, INFINITY), &after, &err), what, &err);
  memset(after.protocol, 0, sizeof after.protocol);
  create(&scene, &changed);
  create(&after, &same);
  expect_ok(gg_run_replica_open_window(&changed, &err), what, &err);
  expect_ok(gg_run_replica_advance(&changed, BEFORE, false, NULL, &err), what, &err);
  assert_true(changed.clock.changes > 0);
  continue_with(&changed, &same);
  expect_ok(gg_run_replica_open_window(&same, &err), what, &err);
  expect_ok(gg_run_replica_advance(&changed, ALL, false, NULL, &err), what, &err);
  expect_ok(gg_run_replica_advance(&same, ALL, false, NULL, &err), what, &err);
  compare_values(what, &changed, &same);
  for (int k = 0; k < changed.sampler.n_observables; k++) {
    const gg_observable *o = changed.sampler.observable[k];
    measured |= o->flag;
    if (o->curves && compare_curves(what, &changed, &same, k) == 0) fail_msg("%s: %s measured nothing", what, o->name);
  }
  gg_run_replica_clear(&changed);
  gg_run_replica_clear(&same);
  return measured;
}

#define SHEARED "flow: usf, phi: 0.1, temperature: 1, collision: {e: 0.8, beta: 0.1}"
#define BATH                                                                                                           \
  "flow: hss, phi: 0.1, collision: {e: 0.8, beta: 0.1}, thermostat: bath, bath: {drag: 0.3, temperature: 1, "          \
  "rotation: 0.5}"
#define MIXTURE                                                                                                        \
  "flow: usf, phi: 0.1, temperature: 1, collision: {e: 0.9, beta: 0.2}, thermostat: bath, bath: {drag: 0.2, "          \
  "temperature: 1}, "                                                                                                  \
  "species: [{fraction: 0.6, drag: 1}, {fraction: 0.4, diameter: 1.5, mass: 3, drag: 3, inertia: 0.3}]"
#define COOLING "flow: hcs, phi: 0.1, collision: "

static const struct {
  const char *start, *change;
} table[] = {
    {SHEARED, "shear_rate: 3"},
    {SHEARED, "shear_rate: 0.4"},
    {SHEARED, "collision.e: 0.5"},
    {SHEARED, "collision.beta: 0.7"},
    {SHEARED, "collision.mu: 0.3"},
    {SHEARED, "collision.law: viscoelastic"},
    {SHEARED, "thermostat: bath, bath.drag: 0.2, bath.temperature: 2"},
    {"flow: usf, phi: 0.1, temperature: 1, collision: {e: 1}", "collision.e: 0.8"},
    {"flow: usf, phi: 0.1, temperature: 1, collision: {e: 0.9}", "collision.e: 1"},
    {BATH, "bath.temperature: 3"},
    {BATH, "bath.drag: 0.8"},
    {BATH, "bath.rotation: 0"},
    {BATH, "thermostat: white_noise"},
    {BATH, "thermostat: gaussian"},
    {"flow: hss, phi: 0.1, collision: {e: 0.8}, thermostat: gaussian, gaussian_rate: 0.2", "gaussian_rate: 0.4"},
    {"flow: hss, phi: 0.1, collision: {e: 0.8}, thermostat: white_noise, noise_strength: 0.2", "noise_strength: 0.5"},
    {MIXTURE, "collision.e: 0.6"},
    {MIXTURE, "shear_rate: 2, bath.temperature: 2"},
    {COOLING "{e: 0.98}", "collision.e: 0.4"},
    {COOLING "{e: 1}", "collision.e: 0.8"},
    {COOLING "{e: 0.9}", "collision.e: 1"},
    {COOLING "{e: 0.9}", "collision.law: viscoelastic"},
    {COOLING "{e: 0.9, law: viscoelastic}", "collision.law: constant"},
    {COOLING "{e: 0.9, beta: 0.5}", "collision.beta: -0.3"},
    {COOLING "{e: 0.9, beta: 0.5}", "collision.mu: 0.3"},
    {COOLING "{e: 0.9, beta: 0.5, mu: 0.3}", "collision.mu: .inf"},
    {COOLING "{e: 0.9}, start: {wave: 0.3}, aspect: [1, 2, 1]", "collision.e: 0.7"},
};

/* Followed runs have neither walls nor small_shear. */
static const unsigned never =
    GG_MEASURE_PROFILES | GG_MEASURE_FLUXES | GG_MEASURE_SLAB_DISTRIBUTIONS | GG_MEASURE_VISCOSITY;

static void as_from_the_start(void **state)
{
  (void)state;
  unsigned measured = 0;
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    for (gg_engine_kind engine = 0; engine <= GG_DSMC; engine++)
      measured |= compare(table[i].start, table[i].change, engine);
  for (int i = 0; gg_measure_observables[i]; i++)
    if (!((measured | never) & gg_measure_observables[i]->flag))
      fail_msg("%s was measured in no scene", gg_measure_observables[i]->name);
}

/* A run that ends within the first sample after a change of the drag has the energy balanced with the new one. */
static void energy_is_balanced_after_a_change_of_drag(void **state)
{
  (void)state;
  static const char yaml[] = "{flow: hss, phi: 0.1, particles: 1000, collision: {e: 0.8}, thermostat: bath, "
                             "bath: {drag: 0.1, temperature: 1}, dsmc: {particles: 50000}, run: {duration: 5, seed: 3, "
                             "replicas: 8}, protocol: [{at: 4.95, bath.drag: 1}]}";
  gg_scene scene = gg_scene_defaults();
  gg_error err = {0};
  gg_result *r = NULL;
  expect_ok(gg_scene_read(&scene, yaml, strlen(yaml), "test", &err), yaml, &err);
  scene.engine = GG_DSMC;
  expect_ok(gg_scene_finish(&scene, &err), yaml, &err);
  expect_ok(gg_run_scene(&scene, NULL, 1, NULL, &r, &err), yaml, &err);
  const gg_estimate *balance = &r->value[GG_Q_ENERGY_BALANCE];
  print_message("# energy balance %.4f +- %.4f\n", balance->mean, balance->error);
  assert_true(balance->error < 0.2 && fabs(balance->mean - 1) < 4 * balance->error);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(energy_is_balanced_after_a_change_of_drag),
      cmocka_unit_test(as_from_the_start),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
