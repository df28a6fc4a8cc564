/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The calls that are to fail. */
#include <stdlib.h>
#include <string.h>

#include "memory.h"

const char scene_text[] = "flow: usf\nphi: 0.2\nparticles: 60\ncollision: {e: 0.9, beta: 0.3, mu: 0.4}\n"
                          "dsmc: {particles: 100}\nmeasure: [rheology, velocity_distributions]\n"
                          "run: {collisions: 40, warmup: 10}\n";
static const char simple_text[] = "flow: hcs\nphi: 0.1\nparticles: 60\ncollision: {e: 0.9}\ndsmc: {particles: 100}\n"
                                  "run: {collisions: 40, warmup: 10}\n";
const char sweep_text[] = "flow: usf\nphi: 0.2\nparticles: 60\nrun: {collisions: 40, warmup: 10}\n"
                          "vary: {phi: [0.1, 0.2]}\n";

static bool reported; /* lack of memory, for a point of a sweep */

bool lack_was_reported(void)
{
  const bool was = reported;
  reported = false;
  return was;
}

static void count_line(void *context, const char *text)
{
  (void)text;
  ((things *)context)->lines++;
}

static void count_file(void *context, const char *file)
{
  count_line(context, file);
}

#define STEP(call)                                                                                                     \
  do {                                                                                                                 \
    gg_status step = (call);                                                                                           \
    if (step != GG_OK) return step;                                                                                    \
  } while (0)

static gg_status scenes(things *t, gg_error *err)
{
  STEP(gg_scene_parse(scene_text, "memory", &t->other, err));
  STEP(gg_scene_set(t->other, "collision.e", "0.8", err));
  STEP(gg_scene_check(t->other, err));
  STEP(gg_scene_to_yaml(t->other, &t->text[0], err));
  STEP(gg_scene_to_json(t->other, &t->text[1], err));
  STEP(gg_scene_describe(t->other, "md", count_line, t, err));
  STEP(gg_scene_warnings(t->other, "md", count_line, t, err));
  return gg_scene_get(t->other, "collision.e", (char *)t->numbers, sizeof t->numbers, err);
}

static gg_status steps(things *t, gg_error *err)
{
  gg_simulation_state s;
  STEP(gg_simulation_new(t->scene, NULL, &t->simulation, err));
  STEP(gg_simulation_collide(t->simulation, 500, err));
  STEP(gg_simulation_get_state(t->simulation, &s, err));
  t->numbers[0] = s.temperature, t->numbers[1] = s.time, t->numbers[2] = (double)s.collisions;
  return GG_OK;
}

static gg_status steps_dsmc(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "engine", "dsmc", err));
  return steps(t, err);
}

static gg_status save(things *t, gg_error *err)
{
  STEP(steps(t, err));
  STEP(gg_simulation_save(t->simulation, "saved.h5", NULL, NULL, err));
  gg_simulation_free(t->simulation);
  gg_trajectory_free(t->trajectory);
  t->simulation = NULL;
  STEP(gg_simulation_load("saved.h5", NULL, NULL, NULL, &t->simulation, err));
  return gg_checkpoint_about("saved.h5", &(gg_checkpoint_info){0}, NULL, err);
}

static gg_status save_to_bytes(things *t, gg_error *err)
{
  void *bytes;
  size_t size;
  STEP(steps(t, err));
  STEP(gg_simulation_to_bytes(t->simulation, NULL, NULL, &bytes, &size, err));
  gg_simulation_free(t->simulation);
  t->simulation = NULL;
  const gg_status read = gg_simulation_from_bytes(bytes, size, NULL, NULL, NULL, &t->simulation, err);
  free(bytes);
  return read;
}

static gg_status run(things *t, gg_error *err)
{
  return gg_run(t->scene, NULL, &t->result, err);
}

static gg_status run_dsmc(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "engine", "dsmc", err));
  return run(t, err);
}

static gg_status run_all(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "measure",
                    "[rheology, velocity_distributions, velocity_correlations, orientation, sonine, collisions, "
                    "pair_correlation, structure, diffusion, impact_speed]",
                    err));
  return run(t, err);
}

/* With everything that is written on the way. */
static gg_status run_to_file(things *t, gg_error *err)
{
  const gg_run_options o = {.size = sizeof o, .output = "new.h5", .checkpoint = "new.checkpoint.h5"};
  STEP(gg_scene_set(t->scene, "output", "{trajectory_every: 5, checkpoint_every: 1.0e-6}", err));
  STEP(gg_run(t->scene, &o, &t->result, err));
  t->written = true;
  return gg_result_to_json(t->result, &t->text[0], err);
}

static gg_status go_on(things *t, gg_error *err)
{
  const gg_run_options o = {
      .size = sizeof o, .output = "new.h5", .checkpoint = "there.checkpoint.h5", .resume = "there.checkpoint.h5"};
  STEP(gg_scene_set(t->scene, "output", "{trajectory_every: 5, checkpoint_every: 1.0e-6}", err));
  return gg_run(t->scene, &o, &t->result, err);
}

static gg_status compare(things *t, gg_error *err)
{
  const gg_run_options o = {.size = sizeof o, .output = "new.h5"};
  STEP(gg_compare(t->scene, &o, &t->comparison, err));
  t->written = true;
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static gg_status theories(things *t, gg_error *err)
{
  STEP(gg_scene_parse(simple_text, "simple", &t->other, err));
  STEP(gg_theories_evaluate(t->other, NULL, NULL, NULL, &t->comparison, err));
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static gg_status theories_rough(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "collision", "{e: 0.9, beta: 0}", err));
  STEP(gg_theories_evaluate(t->scene, NULL, NULL, NULL, &t->comparison, err));
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static void note_ended(void *context, size_t i, gg_status status, const char *file, const char *message)
{
  (void)context, (void)i, (void)status, (void)file;
  if (strstr(message, "memory")) reported = true;
}

static gg_status sweep(things *t, gg_error *err)
{
  const gg_sweep_options o = {.size = sizeof o, .ended = note_ended};
  STEP(gg_sweep_parse(sweep_text, "sweep", &t->sweep, err));
  STEP(gg_sweep_check(t->sweep, err));
  return gg_sweep_run(t->sweep, "new.sweep", &o, err);
}

static gg_status collect(things *t, gg_error *err)
{
  const gg_collect_options o = {.size = sizeof o, .picture = "none"};
  t->written = true; /* the first table may be there whole without the second */
  STEP(gg_sweep_parse(sweep_text, "sweep", &t->sweep, err));
  STEP(gg_sweep_check(t->sweep, err));
  STEP(gg_sweep_collect(t->sweep, "there.sweep", "new", &o, count_file, t, err));
  return gg_sweep_to_json(t->sweep, "there.sweep", &t->text[0], err);
}

static gg_status read_result(things *t, gg_error *err)
{
  STEP(gg_result_read("there.h5", &t->result, err));
  return gg_result_to_json(t->result, &t->text[0], err);
}

/* As a result of another process is read, and what its means have in common. */
static gg_status read_bytes(things *t, gg_error *err)
{
  void *bytes;
  size_t size;
  STEP(gg_result_read("there.h5", &t->result, err));
  STEP(gg_result_to_bytes(t->result, &bytes, &size, err));
  gg_result_free(t->result);
  t->result = NULL;
  const gg_status read = gg_result_from_bytes(bytes, size, &t->result, err);
  free(bytes);
  STEP(read);
  STEP(gg_result_covariance(t->result, "temperature", "pressure", &t->numbers[0], err));
  return gg_result_to_json(t->result, &t->text[0], err);
}

static gg_status read_comparison(things *t, gg_error *err)
{
  STEP(gg_comparison_read("both.h5", &t->comparison, err));
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static gg_status play(things *t, gg_error *err)
{
  gg_simulation_state state;
  STEP(gg_trajectory_open("both.h5", &t->trajectory, err));
  return gg_trajectory_frame(t->trajectory, 0, &state, NULL, err);
}

static gg_status export(things *t, gg_error *err)
{
  return gg_export("there.h5", "new", GG_EXPORT_ALL, count_file, NULL, NULL, t, err);
}

static gg_status plot(things *t, gg_error *err)
{
  t->written = true; /* a page that fails keeps none of the others from being drawn */
  return gg_plot("there.h5", "new.svg", NULL, NULL, count_file, NULL, t, err);
}

static gg_status extend(things *t, gg_error *err)
{
  static const double speed[] = {0.1, 1}, e[] = {0.95, 0.8};
  static const gg_quantity_definition own = {"own", "1", "a number"};
  const gg_observable_definition observable = {.name = "mine", .n_quantities = 1, .quantities = &own};
  STEP(gg_scene_copy(t->scene, &t->other, err));
  STEP(gg_scene_set_restitution_table(t->other, "soft", 2, speed, e, err));
  gg_status refused = gg_scene_add_observable(t->other, &observable, err); /* it lacks its function */
  if (refused != GG_BAD_INPUT && refused != GG_FAILED) return GG_FAILED;
  return gg_run(t->other, NULL, &t->result, err);
}

const memory_call calls[] = {{"scenes", scenes},
                             {"steps, md", steps},
                             {"steps, dsmc", steps_dsmc},
                             {"run, md", run},
                             {"run, dsmc", run_dsmc},
                             {"run, every observable", run_all},
                             {"a law of one's own", extend},
                             {"theories", theories},
                             {"theories, rough", theories_rough},
                             {"save and load", save},
                             {"save and load as bytes", save_to_bytes},
                             {"run to a file", run_to_file},
                             {"go on", go_on},
                             {"compare to a file", compare},
                             {"sweep", sweep},
                             {"collect", collect},
                             {"read a result", read_result},
                             {"read a result as bytes", read_bytes},
                             {"read a comparison", read_comparison},
                             {"read a trajectory", play},
                             {"export", export},
                             {"plot", plot},
                             {NULL, NULL}};

void clear(things *t)
{
  gg_scene_free(t->scene);
  gg_scene_free(t->other);
  gg_result_free(t->result);
  gg_comparison_free(t->comparison);
  gg_simulation_free(t->simulation);
  gg_trajectory_free(t->trajectory);
  gg_sweep_free(t->sweep);
  for (size_t i = 0; i < sizeof t->text / sizeof *t->text; i++) free(t->text[i]);
}
