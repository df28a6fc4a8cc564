#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "api/run.h"
#include "api/sweep.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "common/extension.h"
#include "sweep/folder.h"

typedef struct ended {
  gg_status status;
  bool some;        /* there is a result */
  bool resume_lost; /* its checkpoint cannot be gone on from */
} ended;

/* What it was written to is called work until it is known how it ended. */
static gg_status publish(void *task, gg_status run, gg_error *err)
{
  const gg_point_task *t = task;
  return gg_sweep_point_publish(t->folder, t->sweep->point[t->i].id, run == GG_FAILED, err);
}

static ended evaluate(gg_point_task *t, const gg_scene *scene, const gg_run_options *options, gg_error *err)
{
  gg_comparison *c = NULL;
  gg_result_file file;
  gg_status status = gg_theories_evaluate(scene, NULL, &c, err);
  for (int k = 0; c && k < 2; k++) snprintf(c->refusal[k], sizeof c->refusal[k], "it was not asked to");
  if (status == GG_OK) status = gg_files_result_file_open(&file, options->output, options->command, err);
  if (status == GG_OK) status = gg_files_result_file_finish_comparison(&file, c, err);
  if (status == GG_OK) status = publish(t, GG_OK, err);
  gg_comparison_free(c);
  return (ended){.status = status, .some = status == GG_OK};
}

static ended do_it(const gg_point_task *t, const gg_scene *scene, const gg_run_options *options, gg_error *err)
{
  gg_point_task task = *t;
  gg_point_call point = {.scheduler = t->scheduler, .publish = publish, .context = &task};
  gg_comparison *c = NULL;
  if (t->sweep->settings.does == GG_DOES_THEORY) return evaluate(&task, scene, options, err);
  bool comparison = t->sweep->settings.does == GG_DOES_COMPARE;
  gg_status status = gg_api_run_simulate(&point, scene, options, comparison, &c, err);
  gg_comparison_free(c);
  return (ended){status, c != NULL, point.resume_lost};
}

/* A checkpoint that cannot be gone on from is none: the point begins anew, and comes to the same bits. Not where the
 * disk cannot be written to: then the checkpoint waits for better times. */
static ended from_checkpoint(const gg_point_task *t, const gg_scene *scene, gg_run_options *options, gg_error *err)
{
  char text[600];
  gg_status readable = gg_checkpoint_about(options->checkpoint, &(gg_checkpoint_info){0}, NULL, err);
  if (readable == GG_OK) {
    options->resume = options->checkpoint;
    ended e = do_it(t, scene, options, err);
    if (!e.resume_lost) return e;
  }
  snprintf(text, sizeof text, "the point begins anew: %.500s", err->message);
  if (options->warn) options->warn(options->context, text);
  options->resume = NULL;
  return do_it(t, scene, options, err);
}

/* Between two checkpoints there is a moment with the one before alone. */
static bool is_begun(const char *checkpoint)
{
  char *before = NULL;
  bool begun = access(checkpoint, F_OK) == 0;
  if (begun || asprintf(&before, "%s.1", checkpoint) < 0) return begun;
  begun = access(before, F_OK) == 0;
  free(before);
  return begun;
}

static gg_status do_point(const gg_point_task *t, gg_scene *scene, gg_run_options *options, bool *fell_short,
                          gg_error *err)
{
  bool keeps = scene->output.checkpoint_every > 0 && t->sweep->settings.does != GG_DOES_THEORY;
  bool begun = keeps && is_begun(options->checkpoint);
  if (!keeps) options->checkpoint = NULL;
  ended e = begun ? from_checkpoint(t, scene, options, err) : do_it(t, scene, options, err);
  *fell_short = e.status == GG_FAILED && e.some;
  return e.status;
}

gg_status gg_api_point_run(const gg_point_task *t, bool *fell_short, gg_error *err)
{
  gg_scene scene;
  const uint64_t id = t->sweep->point[t->i].id;
  gg_run_options options = t->options;
  char *work = gg_sweep_point_path(t->folder, id, ".work.h5"),
       *checkpoint = gg_sweep_point_path(t->folder, id, ".checkpoint.h5");
  options.output = work;
  options.checkpoint = checkpoint;
  *fell_short = false;
  locale_t before = gg_base_c_locale_enter();
  gg_status status = work && checkpoint ? gg_sweep_resolve(t->sweep, t->i, &scene, err) : gg_base_out_of_memory(err);
  gg_base_c_locale_leave(before);
  if (status == GG_OK) status = do_point(t, &scene, &options, fell_short, err);
  free(work);
  free(checkpoint);
  return status;
}
