/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, with the real engines: what is no number ends a run within one sampling interval, with a message that says
 * so, whether anybody measures it or not; in md at the very collision that it comes from. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "dsmc/dsmc.h"
#include "dsmc/walls/channel.h"
#include "md/md_state.h"
#include "run/replica.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

static gg_scene scene_of(const char *yaml, gg_engine_kind engine)
{
  gg_scene s = gg_scene_defaults();
  gg_error err = {0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&s, &err) != GG_OK)
    fail_msg("%s", err.message);
  s.engine = engine;
  return s;
}

enum { WHAT_VELOCITY, WHAT_SPIN, KINDS };

/* A spin is noticed when it has spoilt a velocity: one of fifty grains does not collide in two samples. */
static void plant(gg_replica *r, int what)
{
  if (r->model.walled && r->model.ensemble) {
    gg_dsmc_channel *d = (gg_dsmc_channel *)r->engine;
    for (int i = 7; i < 10; i++) *(what == WHAT_SPIN ? &d->grains.s[i].z : &d->grains.at[i].c.z) = NAN;
    return;
  }
  if (!r->model.homogeneous) {
    gg_md *e = (gg_md *)r->engine;
    *(what == WHAT_SPIN ? &e->spin[7].z : &e->grain[7].v.z) = NAN;
    return;
  }
  gg_dsmc_population *p = &((gg_dsmc *)r->engine)->ensemble.of[0];
  gg_dsmc_block_set(p, what == WHAT_SPIN ? p->s : p->c, 7, (gg_vec){0, 0, NAN});
}

static void planted_in(const char *yaml, gg_engine_kind engine, int what)
{
  enum { BEFORE = 20 };
  const gg_scene s = scene_of(yaml, engine);
  gg_model m;
  gg_replica r;
  gg_error err = {0};
  if (gg_scene_model_make(&s, engine, &m, &err) != GG_OK || gg_common_engine_of(engine)->accepts(&m, NULL) != GG_OK ||
      (what == WHAT_SPIN && m.rule == GG_SMOOTH))
    return;
  if (gg_run_replica_create(&r, &s, &m, 0, &err) != GG_OK) fail_msg("%s: %s", yaml, err.message);
  assert_int_equal(gg_run_replica_advance(&r, BEFORE, true, NULL, &err), GG_OK);
  plant(&r, what);
  if (gg_run_replica_advance(&r, BEFORE + 2, true, NULL, &err) != GG_FAILED)
    fail_msg("%s, engine %d, %s", yaml, (int)engine, what == WHAT_SPIN ? "spin" : "velocity");
  if (r.clock.samples > BEFORE) fail_msg("%s: %d samples later", yaml, (int)r.clock.samples - BEFORE);
  if (!strstr(err.message, "NaN or infinite") && !strstr(err.message, "range of double precision"))
    fail_msg("%s: %s", yaml, err.message);
  gg_run_replica_clear(&r);
}

static void within_an_interval(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "{flow: usf, phi: 0.1, particles: 300, collision: {beta: 0}}",
      "{flow: usf, phi: 0.49, particles: 500}",
      "{flow: usf, phi: 0.01, particles: 500}",
      "{flow: hcs, phi: 0.01, particles: 500, collision: {beta: 0, mu: 0.5}}",
      "{flow: hcs, phi: 0.45, particles: 500}",
      "{flow: hss, phi: 0.1, particles: 300}",
      "{flow: hss, thermostat: white_noise, phi: 0.1, particles: 300, collision: {beta: 0}}",
      "{flow: couette, phi: 0.1, particles: 300, collision: {beta: 0}}",
      "{flow: usf, phi: 0.1, particles: 300, measure: [rheology, diffusion]}",
      "{flow: equilibrium, phi: 0.2, particles: 300, measure: [rheology, pair_correlation]}",
      "{flow: usf, phi: 0, particles: 2000, dsmc: {particles: 70000}}",
      "{flow: usf, phi: 0.1, particles: 300, dsmc: {particles: 3000, precision: single}}",
  };
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++)
    for (int what = 0; what < KINDS; what++) {
      planted_in(scenes[k], GG_MD, what);
      planted_in(scenes[k], GG_DSMC, what);
    }
}

typedef struct culprit {
  gg_md *e;
  uint64_t at;
} culprit;

/* The last of a collision's velocities to be set is spoilt by the next one's. */
static void spoil(void *context, const gg_collision_record *collision)
{
  const culprit *c = context;
  for (uint32_t i = 0; c->e->k.collisions == c->at && i < c->e->n; i++)
    if (c->e->id[i] == collision->id[0]) c->e->grain[i].v.x = NAN;
}

static void at_its_collision(void **state)
{
  (void)state;
  gg_scene s = scene_of("{flow: usf, phi: 0.49, particles: 500}", GG_MD);
  gg_model m;
  gg_engine *engine;
  gg_error err = {0};
  double gone;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
  assert_int_equal(gg_md_ops.create(&m, 1, 0, &engine, &err), GG_OK);
  culprit c = {(gg_md *)engine, 1234};
  assert_int_equal(gg_md_ops.set_callback(engine, spoil, &c, &err), GG_OK);
  assert_int_equal(gg_md_ops.advance(engine, INFINITY, 100000, &gone, &err), GG_FAILED);
  assert_non_null(strstr(err.message, "NaN or infinite"));
  assert_int_equal(c.e->k.collisions, c.at + 1);
  assert_int_equal(gg_md_ops.advance(engine, INFINITY, 1, &gone, &err), GG_FAILED);
  gg_md_ops.destroy(engine);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(within_an_interval), cmocka_unit_test(at_its_collision)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
