/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas fingerprint: hash of the state after a number of collisions. */
#include <inttypes.h>
#include <stdio.h>

#include "cli/options.h"

enum { COLLISIONS = 100000 };

typedef struct fingerprint {
  char title[200], engine[16], seed[32];
  gg_simulation_state state;
  uint64_t hash;
} fingerprint;

static gg_status fingerprint_of(const gg_scene *scene, uint64_t collisions, fingerprint *f, gg_error *err)
{
  gg_simulation *simulation = NULL;
  gg_status status = gg_scene_title(scene, f->title, sizeof f->title, err);
  if (status == GG_OK) status = gg_scene_get(scene, "engine", f->engine, sizeof f->engine, err);
  if (status == GG_OK) status = gg_scene_get(scene, "run.seed", f->seed, sizeof f->seed, err);
  if (status == GG_OK) status = gg_simulation_new(scene, NULL, &simulation, err);
  if (status == GG_OK) status = gg_simulation_collide(simulation, collisions, err);
  if (status == GG_OK) status = gg_simulation_get_state(simulation, &f->state, err);
  if (status == GG_OK) status = gg_simulation_hash(simulation, &f->hash, err);
  gg_simulation_free(simulation);
  return status;
}

static void print(const fingerprint *f, bool json)
{
  const gg_simulation_state *s = &f->state;
  if (json)
    printf(
        "{\"graingas\": \"%s\", \"engine\": \"%s\", \"seed\": %s, \"particles\": %zu, \"collisions\": %" PRIu64
        ", \"time\": %.17g, \"temperature\": %.17g, \"rotational_temperature\": %.17g, \"fingerprint\": \"%016" PRIx64
        "\"}\n",
        gg_version(), f->engine, f->seed, s->grains, s->collisions, s->time, s->temperature, s->rotational_temperature,
        f->hash);
  else
    printf("%s\n%s, %zu grains, seed %s, after %" PRIu64 " collisions: T = %.6g, theta = %.6g\nfingerprint %016" PRIx64
           "\n",
           f->title, f->engine, s->grains, f->seed, s->collisions, s->temperature, s->rotational_temperature, f->hash);
}

int gg_cli_fingerprint_main(const gg_options *o)
{
  gg_error err;
  gg_scene *scene;
  fingerprint found = {0};
  if (gg_cli_options_scene(o, &scene, &err) != GG_OK) return gg_cli_report(&err);
  gg_status status = fingerprint_of(scene, o->collisions ? o->collisions : COLLISIONS, &found, &err);
  if (status == GG_OK) print(&found, o->json);
  gg_scene_free(scene);
  return gg_cli_report_scene(o, status, &err);
}
