#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "common/extension.h"
#include "door/run.h"
#include "door/sweep.h"
#include "io/c_locale.h"
#include "sweep/folder.h"

/* The work's result, if there is one: what it is written to is called work until it is known how it ended. */
typedef struct ended {
  gg_status status;
  bool some; /* there is a result, and it was written */
} ended;

static ended run(const gg_scene *scene, const gg_run_options *options, gg_crew *crew, gg_error *err)
{
  gg_result *result = NULL;
  ended e = {gg_door_run_by(crew, scene, options, &result, err), result != NULL};
  gg_result_free(result);
  return e;
}

static ended compare(const gg_scene *scene, const gg_run_options *options, gg_crew *crew, gg_error *err)
{
  gg_comparison *c = NULL;
  ended e = {gg_door_compare_by(crew, scene, options, &c, err), c != NULL};
  gg_comparison_free(c);
  return e;
}

static ended evaluate(const gg_scene *scene, const gg_run_options *options, gg_error *err)
{
  gg_comparison *c = NULL;
  gg_result_file file;
  gg_status status = gg_evaluate_theories(scene, NULL, &c, err);
  for (int k = 0; c && k < 2; k++) snprintf(c->refusal[k], sizeof c->refusal[k], "it was not asked to");
  if (status == GG_OK) status = gg_result_file_open(&file, options->output, options->command, err);
  if (status == GG_OK) status = gg_result_file_finish_comparison(&file, c, err);
  gg_comparison_free(c);
  return (ended){status, status == GG_OK};
}

static ended do_it(const gg_point_task *t, const gg_scene *scene, const gg_run_options *options, gg_error *err)
{
  switch (t->sweep->settings.does) {
  case GG_DOES_COMPARE: return compare(scene, options, t->crew, err);
  case GG_DOES_THEORY: return evaluate(scene, options, err);
  default: return run(scene, options, t->crew, err);
  }
}

/* A checkpoint that cannot be gone on from is none: the point begins anew, and comes to the same bits. */
static ended from_checkpoint(const gg_point_task *t, const gg_scene *scene, gg_run_options *options, gg_error *err)
{
  char text[600];
  gg_status readable = gg_checkpoint_about(options->checkpoint, &(gg_checkpoint_info){0}, NULL, err);
  if (readable == GG_OK) {
    options->resume = options->checkpoint;
    ended e = do_it(t, scene, options, err);
    if (e.some || (e.status != GG_BAD_INPUT && e.status != GG_BAD_FILE)) return e;
  }
  snprintf(text, sizeof text, "the point begins anew: %.500s", err->message);
  if (options->warn) options->warn(options->context, text);
  options->resume = NULL;
  return do_it(t, scene, options, err);
}

static gg_status do_point(const gg_point_task *t, gg_scene *scene, gg_run_options *options, bool *fell_short,
                          gg_error *err)
{
  const uint64_t id = t->sweep->point[t->i].id;
  bool keeps = scene->output.checkpoint_every > 0 && t->sweep->settings.does != GG_DOES_THEORY;
  bool begun = keeps && access(options->checkpoint, F_OK) == 0;
  if (!keeps) options->checkpoint = NULL;
  ended e = begun ? from_checkpoint(t, scene, options, err) : do_it(t, scene, options, err);
  *fell_short = e.status == GG_FAILED && e.some;
  if (e.status != GG_OK && !*fell_short) return e.status;
  GG_TRY(gg_point_publish(t->folder, id, *fell_short, err));
  return e.status;
}

gg_status gg_point_do(const gg_point_task *t, bool *fell_short, gg_error *err)
{
  gg_scene scene;
  const uint64_t id = t->sweep->point[t->i].id;
  gg_run_options options = t->options;
  char *work = gg_point_path(t->folder, id, ".work.h5"), *checkpoint = gg_point_path(t->folder, id, ".checkpoint.h5");
  options.output = work;
  options.checkpoint = checkpoint;
  *fell_short = false;
  locale_t before = gg_c_locale_enter();
  gg_status status =
      work && checkpoint ? gg_sweep_resolve(t->sweep, t->i, &scene, err) : gg_fail(err, GG_FAILED, "out of memory");
  gg_c_locale_leave(before);
  if (status == GG_OK) status = do_point(t, &scene, &options, fell_short, err);
  free(work);
  free(checkpoint);
  return status;
}
