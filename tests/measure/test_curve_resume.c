/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run that is interrupted while it averages, and resumed from its checkpoint, gives the same curves and means to
 * the last bit as an uninterrupted one: bins, origins in time, and counters are all in the checkpoint, and changes
 * by a protocol are in force again. Every observable, both engines, two replicas; before, between and after changes. */
#include "curve_test.h"
#include "graingas.h"
#include "run/replica.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

/* Interruption at a frame: frames are at the same places of every run, checks for a stop are not. */
typedef struct stop {
  int left; /* frames of the first replica until the interruption */
  gg_archive saved;
} stop;

static gg_status count_frame(void *context, const gg_frame *frame, gg_error *err)
{
  (void)frame, (void)err;
  ((stop *)context)->left--;
  return GG_OK;
}

static bool interrupted(void *context)
{
  return ((stop *)context)->left <= 0;
}

static gg_status keep(void *context, gg_archive *archive, gg_error *err)
{
  stop *s = context;
  gg_archive nested = {0};
  gg_base_archive_clear(&s->saved);
  GG_TRY(gg_base_archive_nest(&nested, "all", archive, err));
  gg_status status = gg_base_archive_unnest(&s->saved, "all", &nested, err);
  gg_base_archive_clear(&nested);
  return status;
}

static gg_scene read_scene(const char *yaml, gg_engine_kind engine)
{
  gg_scene s = gg_scene_defaults();
  gg_error err = {0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK) fail_msg("%s", err.message);
  s.engine = engine, s.run.replicas = 2, s.output.checkpoint_every = 1e6, s.output.trajectory_every = 2;
  for (int i = 0; gg_measure_observables[i]; i++) s.measure |= gg_measure_observables[i]->flag;
  if (gg_scene_finish(&s, &err) != GG_OK) fail_msg("%s", err.message);
  return s;
}

static void compare(const gg_result *a, const gg_result *b)
{
  for (int i = 0; i < a->rows.n; i++) {
    const gg_estimate *one = &a->value[a->rows.row[i].quantity], *two = &b->value[a->rows.row[i].quantity];
    if (memcmp(&one->mean, &two->mean, sizeof one->mean) != 0 ||
        memcmp(&one->error, &two->error, sizeof one->error) != 0)
      fail_msg("%s: %.9g +- %.9g, expected %.9g +- %.9g", a->rows.row[i].name, two->mean, two->error, one->mean,
               one->error);
  }
  assert_int_equal(a->curves.n, b->curves.n);
  for (int k = 0; k < a->curves.n; k++) {
    const gg_curve *c = &a->curves.curve[k], *d = &b->curves.curve[k];
    assert_string_equal(c->name, d->name);
    assert_int_equal(c->samples, d->samples);
    if (memcmp(c->value, d->value, c->n * sizeof(double)) != 0 ||
        memcmp(c->error, d->error, c->n * sizeof(double)) != 0)
      fail_msg("%s differs", c->name);
    for (int i = 0; i < c->n_numbers; i++)
      assert_memory_equal(&c->number[i].value, &d->number[i].value, sizeof(double));
  }
}

/* Interrupt the run after a fraction of all frames, and resume it. */
static void resume(const gg_scene *scene, const gg_result *whole, int frames, double share)
{
  gg_result *resumed = NULL;
  gg_error err = {0};
  stop s = {.left = (int)(share * frames)};
  gg_run_callbacks hooks = {.context = &s, .frame = count_frame, .interrupted = interrupted, .checkpoint = keep};
  assert_int_equal(gg_run_scene(scene, NULL, 1, &hooks, &resumed, &err), GG_INTERRUPTED);
  assert_non_null(resumed); /* the results so far */
  gg_result_free(resumed);
  resumed = NULL;
  assert_true(s.saved.n_items > 0);
  hooks = (gg_run_callbacks){.context = &s, .frame = count_frame};
  if (gg_run_scene(scene, &s.saved, 1, &hooks, &resumed, &err) != GG_OK) fail_msg("%s", err.message);
  compare(whole, resumed);
  gg_result_free(resumed);
  gg_base_archive_clear(&s.saved);
}

/* Flags of the measured observables. */
static unsigned measured(const gg_scene *scene)
{
  gg_model m;
  unsigned flags;
  assert_int_equal(gg_scene_model_make(scene, scene->engine, &m, NULL), GG_OK);
  assert_int_equal(gg_run_measured(scene, &m, &flags, NULL), GG_OK);
  return flags;
}

static unsigned resume_scene(const char *yaml, gg_engine_kind engine)
{
  enum { MOST = 1 << 30 };
  gg_scene scene = read_scene(yaml, engine);
  gg_result *whole = NULL;
  gg_error err = {0};
  stop s = {.left = MOST};
  gg_run_callbacks hooks = {.context = &s, .frame = count_frame};
  if (gg_run_scene(&scene, NULL, 1, &hooks, &whole, &err) != GG_OK) fail_msg("%s", err.message);
  assert_true(whole->curves.n > 0);
  const int frames = MOST - s.left;
  resume(&scene, whole, frames, 0.9);
  if (gg_scene_is_followed(&scene)) resume(&scene, whole, frames, 0.3); /* before the last change */
  gg_result_free(whole);
  return measured(&scene);
}

#define MD 1
#define DSMC 2
#define FEW "particles: 60, dsmc: {particles: 200}"

static const struct {
  const char *yaml;
  int engines;
} scenes[] = {
    {"{flow: usf, phi: 0.1, temperature: 1, collision: {e: 0.8, beta: 0}, " FEW ", run: {collisions: 60, warmup: 10}}",
     MD | DSMC},
    {"{flow: hcs, phi: 0.1, collision: {e: 0.8}, " FEW ", run: {collisions: 60, warmup: 20}}", DSMC},
    {"{flow: hcs, phi: 0.1, collision: {e: 1}, " FEW ", run: {collisions: 60, warmup: 10}}", MD},
    {"{flow: small_shear, phi: 0.1, collision: {e: 0.8}, " FEW ", run: {collisions: 60, warmup: 10}}", DSMC},
    {"{flow: couette, phi: 0.1, collision: {e: 0.9, beta: 0}, " FEW ", run: {collisions: 60, warmup: 10}}", MD | DSMC},
    {"{flow: usf, phi: 0.1, temperature: 1, collision: {e: 0.8, beta: 0, law: viscoelastic, speed: 1}, " FEW
     ", run: {duration: 40}, "
     "protocol: [{at: 8, shear_rate: 2}, {at: 20.3, collision.beta: 0.5, collision.e: 0.7}]}",
     MD | DSMC},
    {"{flow: hcs, phi: 0.1, collision: {e: 0.7}, " FEW
     ", start: {wave: 0.3}, aspect: [1, 1.5, 1], run: {duration: 90}}",
     MD | DSMC},
    {"{flow: hss, phi: 0.1, collision: {e: 0.8}, " FEW
     ", start: {wave: 0.3}, aspect: [1, 1.5, 1], run: {duration: 30}}",
     MD | DSMC},
    {"{flow: hss, thermostat: bath, bath: {drag: 0.1}, phi: 0.1, collision: {e: 0.8}, " FEW
     ", start: {wave: 0.3}, aspect: [1, 1.5, 1], run: {duration: 30}}",
     DSMC},
    {"{flow: hcs, phi: 0.1, collision: {e: 1}, " FEW ", run: {duration: 30}, protocol: [{at: 9, collision.e: 0.7}]}",
     DSMC},
    {"{flow: hcs, phi: 0.1, collision: {e: 0.9}, " FEW ", run: {duration: 60}, protocol: [{at: 20, collision.e: 1}]}",
     MD},
};

static void same_curves(void **state)
{
  (void)state;
  unsigned flags = 0;
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
    for (gg_engine_kind engine = 0; engine <= GG_DSMC; engine++)
      if (scenes[i].engines & (engine == GG_MD ? MD : DSMC)) flags |= resume_scene(scenes[i].yaml, engine);
  for (int i = 0; gg_measure_observables[i]; i++)
    if (!(flags & gg_measure_observables[i]->flag))
      fail_msg("%s was measured in no scene", gg_measure_observables[i]->name);
}

/* Observables other than rheology need it; the error names it. */
static void rheology_needed(void **state)
{
  (void)state;
  gg_scene scene = gg_scene_defaults();
  scene.phi = 0.1;
  scene.measure = GG_MEASURE_CELLS;
  gg_result *r = NULL;
  gg_error err = {0};
  assert_int_equal(gg_run_scene(&scene, NULL, 1, NULL, &r, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "rheology"));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(same_curves),
      cmocka_unit_test(rheology_needed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
