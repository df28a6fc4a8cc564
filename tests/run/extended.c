/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "extended.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "graingas.h"
#include "scene/scene_reader.h"

gg_scene *scene_of(const char *yaml)
{
  gg_scene *scene = NULL;
  gg_error err;
  if (gg_scene_parse(yaml, "scene", &scene, &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_scene_finish(scene, &err) != GG_OK) fail_msg("%s", err.message); /* as runs do with their copies */
  return scene;
}

gg_result *run(const gg_scene *scene, int threads)
{
  gg_result *result = NULL;
  gg_error err;
  if (gg_run_scene(scene, NULL, threads, NULL, &result, &err) != GG_OK) fail_msg("%s", err.message);
  return result;
}

const char sheared[] = "{flow: usf, phi: 0.1, particles: 400, run: {collisions: 100, warmup: 20}}";
const char sheared_dsmc[] = "{flow: usf, engine: dsmc, phi: 0.1, run: {collisions: 60, warmup: 20}}";

static void sample_temperature(void *context, void *state, const gg_sample *s, double *values)
{
  double sum = 0, *samples = state;
  (void)context;
  for (size_t i = 0; i < 3 * s->n; i++) sum += s->velocity[i] * s->velocity[i];
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
const gg_observable_definition thermometer = {"thermometer",  "a temperature",    3,    own_temperature,
                                              sizeof(double), sample_temperature, NULL, NULL};
const gg_observable_definition counter = {"counter",       NULL, 1, own_rate, sizeof(uint64_t), sample_collisions,
                                          count_collision, NULL};

void add(gg_scene *scene, const gg_observable_definition *o)
{
  gg_error err;
  if (gg_scene_add_observable(scene, o, &err) != GG_OK) fail_msg("%s", err.message);
}

void refused(gg_status status, const gg_error *err, const char *word)
{
  assert_int_equal(status, GG_BAD_INPUT);
  if (!strstr(err->message, word)) fail_msg("'%s' does not say '%s'", err->message, word);
}

double constant(void *context, double speed, int one, int two)
{
  (void)speed, (void)one, (void)two;
  return *(const double *)context;
}

double falling(void *context, double speed, int one, int two)
{
  (void)context, (void)one, (void)two;
  return 1 / (1 + 0.08 * pow(speed, 0.2));
}

void set_law(gg_scene *scene, const char *name, gg_restitution *law, void *context)
{
  gg_error err;
  if (gg_scene_set_restitution(scene, name, law, context, &err) != GG_OK) fail_msg("%s", err.message);
}
