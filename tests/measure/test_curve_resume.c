/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run interrupted while it averages, and resumed from its checkpoint, leaves the same curves to the last bit as one
 * that was not: bins, origins in time, and counters all go through the checkpoint. Two replicas,
 * both engines. */
#include "curve_test.h"

typedef struct stop {
  int left; /* questions until the interruption; negative: never */
  gg_archive saved;
} stop;

static bool interrupted(void *context)
{
  stop *s = context;
  return s->left >= 0 && s->left-- == 0;
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

static void resume(gg_engine_kind engine, int curves)
{
  gg_scene scene = gg_scene_defaults();
  scene.engine = engine, scene.phi = 0.1, scene.particles = 200, scene.dsmc.particles = 900, scene.run.replicas = 2;
  for (int q = 0; q < GG_PAIRS; q++) scene.collision.beta[q] = 0;
  scene.run.collisions = 150, scene.run.warmup = 20;
  scene.output.checkpoint_every = 1e6;
  for (int i = 0; gg_measure_observables[i]; i++) scene.measure |= gg_measure_observables[i]->flag;
  gg_result *whole = ct_run(scene), *resumed = NULL;
  stop s = {.left = 97};
  gg_run_callbacks hooks = {.context = &s, .interrupted = interrupted, .checkpoint = keep};
  gg_error err = {0};
  assert_int_equal(gg_run_scene(&scene, NULL, 1, &hooks, &resumed, &err), GG_INTERRUPTED);
  assert_non_null(resumed); /* the results so far */
  gg_result_free(resumed);
  resumed = NULL;
  assert_true(s.saved.n_items > 0);
  if (gg_run_scene(&scene, &s.saved, 1, NULL, &resumed, &err) != GG_OK) fail_msg("%s", err.message);
  assert_int_equal(whole->curves.n, resumed->curves.n);
  assert_true(whole->curves.n > curves);
  for (int k = 0; k < whole->curves.n; k++) {
    const gg_curve *a = &whole->curves.curve[k], *b = &resumed->curves.curve[k];
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->samples, b->samples);
    assert_memory_equal(a->value, b->value, a->n * sizeof(double));
    assert_memory_equal(a->error, b->error, a->n * sizeof(double));
  }
  gg_result_free(whole);
  gg_result_free(resumed);
  gg_base_archive_clear(&s.saved);
}

static void same_curves(void **state)
{
  (void)state;
  resume(GG_MD, 40);
  resume(GG_DSMC, 15);
}

/* Observables other than rheology do not run alone, and say so. */
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
