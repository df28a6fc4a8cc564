/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations from given grains; changes of grains and keys; copies. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/simulation.h"
#include "base/memory.h"
#include "common/engine_grains.h"
#include "common/extension.h"
#include "common/rng.h"
#include "scene/fields.h"
#include "scene/scene_reader.h"

static gg_grain_arrays arrays_of(const gg_grains *g)
{
  return (gg_grain_arrays){g->position, g->velocity, g->spin, g->species};
}

static gg_status create(gg_simulation *s, const gg_grains *grains, size_t n, uint64_t stream, gg_error *err)
{
  const gg_model *m = &s->model;
  const gg_grain_arrays given = arrays_of(grains);
  const gg_engine_ops *ops = gg_common_engine_of(s->scene.engine);
  GG_TRY(gg_common_grains_check(m, &given, n, err));
  if (m->n_species > 1 && !grains->species)
    return GG_REFUSE(err, "the scene has %d species: give the species of each grain", m->n_species);
  if (m->n_species > 1 && !m->homogeneous && !grains->position)
    return GG_REFUSE(err, "grains of several species need positions: the start would part the species");
  GG_CLEARED(gg_common_engine_grains_clear) gg_engine_grains a = {0};
  GG_TRY(gg_common_engine_grains_make(&a, n, err));
  gg_common_engine_grains_take(m, &given, 1, &a);
  a.grains = (gg_grain_arrays){.r = grains->position ? a.number : NULL,
                               .c = grains->velocity ? a.number + 3 * n : NULL,
                               .s = grains->spin ? a.number + 6 * n : NULL,
                               .species = a.species};
  return ops->create_with(m, s->scene.run.seed, stream * GG_STREAMS_PER_REPLICA, &a.grains, NULL, &s->engine, err);
}

/* The scene with the number of grains, if it gives none. */
static gg_status with_number(const gg_scene *scene, size_t n, gg_scene *counted, gg_error *err)
{
  char number[24];
  const char *key = gg_common_engine_of((int)scene->engine)->ensemble ? "dsmc.particles" : "particles";
  *counted = *scene;
  if (gg_scene_is_given(scene, key) || gg_scene_is_given(scene, "particles")) return GG_OK;
  snprintf(number, sizeof number, "%zu", n);
  return gg_scene_override(counted, key, number, err);
}

gg_status gg_simulation_from_grains(const gg_scene *scene, const gg_grains *grains, size_t n,
                                    const gg_start_options *options, gg_simulation **simulation, gg_error *err)
{
  GG_NEED(scene, grains, simulation);
  gg_simulation *s;
  gg_scene counted;
  GG_TRY(with_number(scene, n, &counted, err));
  counted.fixed.clock_rate = GG_AUTO; /* time is in units of this start */
  gg_start_options o;
  GG_COPY_OPTIONS(o, options);
  GG_TRY(gg_api_simulation_prepare(&counted, o.stop, o.context, &s, err));
  gg_status status = create(s, grains, n, o.stream, err);
  return gg_api_simulation_hand_over(s, status, simulation, err);
}

/* Replace the engine by one with this model and these grains (NULL members keep their values). On failure nothing
 * changes. */
static gg_status go_on(gg_simulation *s, const gg_model *model, const gg_grains *grains, gg_error *err)
{
  const size_t n = (size_t)model->n;
  const gg_engine_ops *ops = s->engine->ops;
  const gg_grain_arrays given = grains ? arrays_of(grains) : (gg_grain_arrays){0};
  gg_engine *engine = NULL;
  GG_CLEARED(gg_common_engine_grains_clear) gg_engine_grains a = {0};
  atomic_store(&s->stopped, false);
  gg_status status = gg_common_engine_grains_make(&a, n, err);
  if (status == GG_OK) {
    gg_common_engine_grains_read(s->engine, model, &a);
    if (grains) gg_common_engine_grains_take(model, &given, gg_api_simulation_unit(s), &a);
    status = ops->create_with(model, 0, 0, &a.grains, s->engine, &engine, err);
  }
  status = gg_base_callback_settle(status, err);
  if (status == GG_OK) status = gg_api_simulation_observe(s, engine, err);
  if (status != GG_OK) {
    if (engine) ops->destroy(engine);
    return status;
  }
  gg_api_simulation_collect(s);
  ops->destroy(s->engine);
  s->engine = engine;
  return GG_OK;
}

gg_status gg_simulation_set_grains(gg_simulation *simulation, const gg_grains *grains, size_t n, gg_error *err)
{
  GG_NEED_ALONE(simulation, grains);
  const gg_grain_arrays given = arrays_of(grains);
  GG_TRY(gg_common_grains_check(&simulation->model, &given, n, err));
  return go_on(simulation, &simulation->model, grains, err);
}

gg_status gg_simulation_copy(const gg_simulation *simulation, int (*stop)(void *context), void *context,
                             gg_simulation **copy, gg_error *err)
{
  GG_NEED_READING(simulation, copy);
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  gg_simulation *s = gg_api_simulation_like(simulation, err);
  if (!s) return GG_FAILED;
  s->stop_callback = stop, s->stop_context = context;
  archive.stop = &s->stop;
  const gg_engine_ops *ops = simulation->engine->ops;
  gg_status status = ops->save(simulation->engine, &archive, err);
  if (status == GG_OK) status = ops->restore(&s->model, &archive, &s->engine, err);
  return gg_api_simulation_hand_over(s, status, copy, err);
}

/* Whether a key may change during a simulation: it determines neither units nor box nor grains. */
static bool may_change(const char *key)
{
  const char *const keys[] = {"md.contact_time", "dsmc.time_step", "walls.e",           "walls.beta",
                              "walls.mu",        "gravity",        "walls.temperature", "walls.accommodation"};
  gg_field member;
  bool may = gg_scene_key_find(key, GG_MAX_SPECIES, &member) >= 0 && member.on_the_way;
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) may |= strcmp(key, keys[i]) == 0;
  return may;
}

static gg_status change(gg_simulation *s, gg_simulation *next, const char *key, gg_error *err)
{
  if (!gg_common_is_same_gas(&s->model, &next->model))
    return GG_REFUSE(err, "key '%.60s': this value needs other grains, another box or other units", key);
  next->model.stop = &s->stop;
  GG_TRY(go_on(s, &next->model, NULL, err));
  s->strained.strain = gg_api_simulation_strain(s), s->strained.until = s->clock.time;
  s->model = next->model;
  s->scene = next->scene; /* both scenes hold the same extension */
  return GG_OK;
}

static gg_status check_shear_rate(const gg_scene *changed, gg_error *err)
{
  char flows[160];
  if (gg_flow_is_sheared(changed->flow)) return gg_scene_check_shear_rate(changed, err);
  gg_common_flow_list(gg_flow_is_sheared, flows, sizeof flows);
  return GG_REFUSE(err, "key 'shear_rate': has no effect in flow: %s; allowed in flow: %s",
                   gg_flow_of(changed->flow)->word, flows);
}

gg_status gg_simulation_set(gg_simulation *simulation, const char *key, const char *value, gg_error *err)
{
  GG_NEED(simulation, key, value);
  if (!may_change(key))
    return GG_REFUSE(err,
                     "key '%.60s': cannot be changed on the way; allowed: " GG_PROTOCOL_KEYS
                     ", md.contact_time, dsmc.time_step, walls.e, walls.beta, walls.mu, walls.temperature, "
                     "walls.accommodation, gravity",
                     key);
  GG_USE_ALONE(simulation);
  gg_scene changed = simulation->scene;
  changed.fixed.clock_rate = gg_scene_clock_rate(&simulation->scene);
  gg_simulation *next = NULL;
  gg_status status = gg_scene_override(&changed, key, value, err);
  if (status == GG_OK && strcmp(key, "shear_rate") == 0) status = check_shear_rate(&changed, err);
  if (status == GG_OK) status = gg_api_simulation_prepare(&changed, NULL, NULL, &next, err);
  if (status == GG_OK) status = change(simulation, next, key, err);
  gg_simulation_free(next);
  return status;
}
