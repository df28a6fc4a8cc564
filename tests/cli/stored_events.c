/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reference for cli/independent: a run with every sample and every collision of all its replicas, and what the
 * C interface says of it, by the public header alone.
 *   stored_events SCENE.yaml FOLDER REPLICAS COLLISIONS [SAMPLES]
 * FOLDER/result.json: the result; interface.json: the same, asked one by one; samples.bin: what an observable is shown;
 * grains.bin, sums.bin, events.bin: the simulations of the same streams at the samples' times and in between, of all
 * replicas; rule.bin: states of both grains around COLLISIONS single collisions. Every number is a double. SAMPLES: the
 * run is stopped after so many of all replicas together, in the midst of one. Without COLLISIONS no grains are stored.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graingas.h"

enum { MOST_REPLICAS = 8, MOST_SAMPLES = 100000 };

typedef struct recorder {
  const char *folder;
  FILE *samples, *grains, *sums, *events, *rule;
  int replicas;
  size_t all, most; /* samples of all replicas, and those that there may be */
  size_t n[MOST_REPLICAS];
  double *elapsed[MOST_REPLICAS];
  double replica, sample; /* of the simulation that goes on */
  gg_collision_event last;
} recorder;

static void must(int status, const gg_error *err)
{
  if (status == GG_OK) return;
  fprintf(stderr, "%s\n", err->message);
  exit(1);
}

static FILE *file(const recorder *r, const char *name)
{
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", r->folder, name);
  FILE *f = fopen(path, "wb");
  if (!f) perror(path), exit(1);
  return f;
}

static void put(FILE *f, const double *x, size_t n)
{
  if (fwrite(x, sizeof *x, n, f) != n) perror("stored_events"), exit(1);
}

/* One thread: replicas have their first samples in the order of their streams. */
static void sample(void *context, void *state, const gg_sample *s, double *values)
{
  recorder *r = context;
  int *number = state; /* of the replica, from 1 */
  if (!*number) *number = ++r->replicas;
  const int k = *number - 1;
  if (k >= MOST_REPLICAS || r->n[k] >= MOST_SAMPLES) abort();
  if (!r->elapsed[k]) r->elapsed[k] = calloc(MOST_SAMPLES, sizeof(double));
  r->elapsed[k][r->n[k]++] = s->elapsed;
  r->all++;
  const double head[] = {k, s->time, s->elapsed, (double)s->collisions, s->dissipation};
  put(r->samples, head, sizeof head / sizeof *head);
  put(r->samples, &s->stress[0][0], 9);
  put(r->samples, s->velocity, 3 * s->n);
  if (s->spin) put(r->samples, s->spin, 3 * s->n);
  *values = s->time;
}

static int stop(void *context)
{
  const recorder *r = context;
  return r->most && r->all >= r->most;
}

static void run(recorder *r, const gg_scene *bare)
{
  static const gg_quantity_definition quantity = {"recorded", "1", "time"};
  const gg_observable_definition mine = {"recorder", NULL, 1, &quantity, sizeof(int), sample, NULL, r};
  gg_scene *scene;
  gg_result *result;
  gg_error err;
  gg_measurement m;
  char *text;
  must(gg_scene_copy(bare, &scene, &err), &err);
  must(gg_scene_add_observable(scene, &mine, &err), &err);
  const gg_run_options options = {.size = sizeof options, .context = r, .stop = stop};
  const gg_status status = gg_run(scene, &options, &result, &err);
  if (!r->most || status != GG_INTERRUPTED) must(status, &err);
  must(gg_result_to_json(result, &text, &err), &err);
  FILE *f = file(r, "result.json");
  fputs(text, f);
  fclose(f);
  free(text);
  f = file(r, "interface.json");
  fputs("{", f);
  for (size_t i = 0; gg_result_at(result, i, &m, NULL) == GG_OK; i++)
    fprintf(f, "%s\"%s\": [%.17g, %.17g, \"%s\"]", i ? ", " : "", m.name, m.mean, m.error, m.unit);
  fputs("}", f);
  fclose(f);
  gg_result_free(result);
  gg_scene_free(scene);
}

static void on_collision(void *context, const gg_collision_event *e)
{
  recorder *r = context;
  const double row[] = {r->replica,     r->sample,     e->time,       (double)e->grain[0], (double)e->grain[1],
                        e->k[0],        e->k[1],       e->k[2],       e->velocity[0],      e->velocity[1],
                        e->velocity[2], e->impulse[0], e->impulse[1], e->impulse[2]};
  r->last = *e;
  if (r->replica >= 0) put(r->events, row, sizeof row / sizeof *row);
}

typedef struct room {
  gg_simulation_state state;
  size_t n;
  double *position, *velocity, *spin;
  int *species;
} room;

static void take(gg_simulation *s, room *to)
{
  gg_error err;
  must(gg_simulation_get_state(s, &to->state, &err), &err);
  if (!to->position) {
    to->n = to->state.grains;
    to->position = calloc(9 * to->n, sizeof(double));
    to->velocity = to->position + 3 * to->n, to->spin = to->velocity + 3 * to->n;
    to->species = calloc(to->n, sizeof(int));
  }
  const gg_grains into = {to->position, to->velocity, to->spin, to->species};
  must(gg_simulation_get_grains(s, &into, &err), &err);
}

static void follow(recorder *r, const gg_scene *scene, int replica)
{
  gg_error err;
  gg_simulation *s;
  gg_simulation_sums sums;
  room now = {0};
  must(gg_simulation_new(scene, &(gg_start_options){.size = sizeof(gg_start_options), .stream = (uint64_t)replica}, &s,
                         &err),
       &err);
  must(gg_simulation_on_collision(s, on_collision, r, &err), &err);
  r->replica = replica;
  for (size_t i = 0; i < r->n[replica]; i++) {
    r->sample = (double)i;
    must(gg_simulation_advance(s, r->elapsed[replica][i], &err), &err);
    must(gg_simulation_take_sums(s, &sums, &err), &err);
    take(s, &now);
    const double head[] = {now.state.time, now.state.temperature, now.state.rotational_temperature,
                           now.state.image_offset};
    put(r->grains, head, 4);
    put(r->grains, now.position, 9 * now.n);
    for (size_t k = 0; k < now.n; k++) put(r->grains, (const double[]){now.species[k]}, 1);
    const double last[] = {sums.time, (double)sums.collisions, sums.dissipation};
    put(r->sums, last, 3);
    put(r->sums, &sums.collisional_stress[0][0], 9);
    for (int wall = 0; wall < 2; wall++) put(r->sums, sums.wall_impulse[wall], 3);
    put(r->sums, sums.wall_heat, 2);
  }
  gg_simulation_free(s);
  free(now.position);
  free(now.species);
}

static void put_pair(recorder *r, const room *at)
{
  for (int i = 0; i < 2; i++) {
    size_t g = 3 * r->last.grain[i];
    put(r->rule, at->position + g, 3);
    put(r->rule, at->velocity + g, 3);
    put(r->rule, at->spin + g, 3);
  }
}

static void single_collisions(recorder *r, const gg_scene *scene, int collisions)
{
  gg_error err;
  gg_simulation *s;
  room before = {0}, after = {0};
  must(gg_simulation_new(scene, NULL, &s, &err), &err);
  must(gg_simulation_on_collision(s, on_collision, r, &err), &err);
  r->replica = -1;
  for (int i = 0; i < collisions; i++) {
    take(s, &before);
    must(gg_simulation_collide(s, 1, &err), &err);
    take(s, &after);
    const gg_collision_event *e = &r->last;
    const double head[] = {before.state.time, e->time, e->species[0], e->species[1]};
    put(r->rule, head, 4);
    put(r->rule, e->k, 3);
    put(r->rule, e->velocity, 3);
    put(r->rule, e->impulse, 3);
    put_pair(r, &before);
    put_pair(r, &after);
  }
  gg_simulation_free(s);
  free(before.position), free(before.species);
  free(after.position), free(after.species);
}

int main(int argc, char **argv)
{
  gg_error err;
  gg_scene *scene;
  if (argc < 5) return fprintf(stderr, "stored_events SCENE.yaml FOLDER REPLICAS COLLISIONS [SAMPLES]\n"), 2;
  const int collisions = atoi(argv[4]);
  recorder r = {.folder = argv[2], .most = argc > 5 ? (size_t)atoi(argv[5]) : 0};
  must(gg_scene_load(argv[1], &scene, &err), &err);
  must(gg_scene_set(scene, "run.replicas", argv[3], &err), &err);
  r.samples = file(&r, "samples.bin"), r.grains = file(&r, "grains.bin"), r.sums = file(&r, "sums.bin");
  r.events = file(&r, "events.bin"), r.rule = file(&r, "rule.bin");
  run(&r, scene);
  for (int k = 0; k < r.replicas && collisions; k++) follow(&r, scene, k);
  single_collisions(&r, scene, collisions);
  for (int k = 0; k < r.replicas; k++) free(r.elapsed[k]);
  FILE *const files[] = {r.samples, r.grains, r.sums, r.events, r.rule};
  for (int k = 0; k < 5; k++)
    if (fclose(files[k])) return perror("stored_events"), 1;
  gg_scene_free(scene);
  return 0;
}
