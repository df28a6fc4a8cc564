/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gg_run and gg_compare. */
#include "api/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"
#include "common/engine.h"
#include "common/extension.h"
#include "files/h5/checkpoint_file.h"
#include "run/cost_estimate.h"
#include "run/scheduler.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"

/* Called after every callback: a failed callback stops the run, on whatever thread it ran. */
static void note_failure(gg_api_run_call *r)
{
  if (!gg_base_callback_failed()) return;
  gg_base_callback_settle(GG_OK, atomic_exchange(&r->callback_failed, true) ? NULL : &r->callback_reason);
  atomic_store(&r->stopped, true);
}

static void report_progress(void *context, const gg_progress *progress)
{
  gg_api_run_call *r = context;
  if (r->options.progress && r->options.progress(r->options.context, progress)) atomic_store(&r->stopped, true);
  note_failure(r);
}

/* Whether a callback has requested the end of the run. */
static bool is_stopped(void *context)
{
  gg_api_run_call *r = context;
  if (r->options.stop && r->options.stop(r->options.context)) atomic_store(&r->stopped, true);
  note_failure(r);
  return atomic_load(&r->stopped);
}

static gg_status store_checkpoint(void *context, gg_archive *archive, gg_error *err)
{
  gg_api_run_call *r = context;
  gg_status status = gg_api_trajectory_mark(r, archive, err);
  if (status == GG_OK) status = gg_api_log_mark(r, archive, err);
  if (status != GG_OK) return status;
  GG_TRY(gg_files_checkpoint_write(r->options.checkpoint, true, !r->log.place, archive, &r->scene, err));
  r->stored = true;
  GG_TRY(gg_files_frame_log_put_in_place(&r->log, err));
  if (r->options.stored) r->options.stored(r->options.context, r->options.checkpoint);
  note_failure(r);
  return GG_OK;
}

static gg_status read_resume(gg_api_run_call *r, gg_error *err)
{
  bool older;
  char text[1024];
  const char *path = r->options.resume;
  gg_status status = gg_files_checkpoint_read(path, r->options.accept_version, &r->resume, &older, err);
  r->resume_lost = status != GG_OK;
  if (status != GG_OK) return status;
  snprintf(text, sizeof text, "%s cannot be read; resuming from the earlier one, %s.1", path, path);
  if (older && r->options.warn) r->options.warn(r->options.context, text);
  return GG_OK;
}

/* Lock the checkpoint until the end of the run, so that no other run writes it. */
static gg_status lock_checkpoint(gg_api_run_call *r, gg_error *err)
{
  const char *path = r->options.checkpoint;
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  GG_TRY(gg_io_output_path_find(&place, path, err));
  return place.stream ? gg_base_fail(err, GG_BAD_FILE, "%s: is a device or a pipe; " GG_CHECKPOINTS_ARE, path)
                      : gg_io_file_lock_take(&r->lock, place.target, path, err);
}

/* Reject links: checkpoints and frames are renamed and removed, and the target of a link may be another file. */
static gg_status check_links(const gg_api_run_call *r, gg_error *err)
{
  struct stat about;
  GG_FREED char *frames = gg_files_frame_log_path(r->options.checkpoint);
  GG_FREED char *before = gg_files_checkpoint_before(r->options.checkpoint);
  GG_FREED char *fresh = frames ? gg_files_frame_log_new_path(frames) : NULL;
  const char *all[] = {r->options.checkpoint, before, frames, fresh};
  if (!before || !fresh) return gg_base_out_of_memory(err);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (lstat(all[i], &about) == 0 && S_ISLNK(about.st_mode))
      return gg_io_path_write_error(
          all[i], "it is a link, and checkpoints are removed at the end: remove it, or choose another output", err);
  return GG_OK;
}

/* Protect the checkpoint of an interrupted run, which may hold hours of work. Only a run that resumes it replaces it.
 */
static gg_status check_earlier(const gg_api_run_call *r, gg_error *err)
{
  const char *path = r->options.checkpoint;
  GG_FREED char *before = gg_files_checkpoint_before(path);
  if (!before) return gg_base_out_of_memory(err);
  const bool there = access(path, F_OK) == 0 || access(before, F_OK) == 0;
  if (!there || r->resumes_in_place || r->replaces) return GG_OK;
  return gg_base_fail(err, GG_BAD_FILE,
                      "%s: holds the state of a run: resume it (--resume %s), remove it, or choose another output",
                      path, path);
}

/* Allocate the names before the run: at its end, a lack of memory could no longer fail it. */
static gg_status name_temporaries(gg_api_run_call *r, gg_error *err)
{
  const char *path = r->options.checkpoint;
  GG_FREED char *frames = gg_files_frame_log_path(path);
  r->temporary[GG_TEMPORARY_CHECKPOINT] = gg_io_path_follow_links(path);
  r->temporary[GG_TEMPORARY_BEFORE] = gg_files_checkpoint_before(path);
  r->temporary[GG_TEMPORARY_FRAMES] = frames ? gg_io_path_follow_links(frames) : NULL;
  for (int i = 0; i < GG_TEMPORARIES; i++)
    if (!r->temporary[i]) return gg_base_out_of_memory(err);
  return GG_OK;
}

static gg_status begin_checkpoints(gg_api_run_call *r, gg_error *err)
{
  const gg_run_options *o = &r->options;
  if (!o->checkpoint && r->scene.output.state == GG_STATE_KEPT)
    return GG_REFUSE(err, "output.state: kept needs a file for checkpoints");
  if (o->checkpoint) GG_TRY(check_links(r, err));
  if (o->checkpoint) GG_TRY(lock_checkpoint(r, err));
  if (o->resume) GG_TRY(read_resume(r, err));
  r->resumes_in_place = o->checkpoint && r->resume.n_items > 0 && gg_files_checkpoint_is_of(o->resume, o->checkpoint);
  if (o->checkpoint) GG_TRY(check_earlier(r, err));
  return o->checkpoint ? name_temporaries(r, err) : GG_OK;
}

/* A resumed run has its grains from the checkpoint. */
static gg_status read_start(gg_api_run_call *r, gg_error *err)
{
  if (!gg_files_positions_are_read(&r->scene) || r->options.resume) return GG_OK;
  if (!r->comparison && r->scene.engine != GG_MD) return GG_OK;
  if (r->options.workers) return GG_REFUSE(err, "start.positions: a file needs a run in one process");
  GG_FREED gg_model *md = gg_base_array_new(1, sizeof *md, err);
  if (!md) return GG_FAILED;
  GG_TRY(gg_scene_model_make(&r->scene, GG_MD, md, err));
  r->model.start = &r->start.grains;
  return gg_files_positions_read(&r->scene, md, &r->start, err);
}

static gg_status begin(gg_api_run_call *r, const gg_scene *scene, const gg_run_options *options, bool comparison,
                       bool replaces, gg_error *err)
{
  r->file.file = GG_ATOMIC_NONE;
  r->lock = GG_FILE_LOCK_NONE;
  r->log.fd = r->samples.fd = -1;
  r->samples.lock = GG_FILE_LOCK_NONE;
  r->comparison = comparison;
  r->replaces = replaces;
  r->options = *options;
  if (r->options.threads < 1) r->options.threads = 1;
  if (!r->options.command) r->options.command = "the graingas library";
  atomic_init(&r->stopped, false);
  atomic_init(&r->callback_failed, false);
  r->callbacks = (gg_run_callbacks){.context = r,
                                    .progress = report_progress,
                                    .interrupted = is_stopped,
                                    .checkpoint = r->options.checkpoint ? store_checkpoint : NULL,
                                    .workers = r->options.workers,
                                    .model = &r->model};
  GG_TRY(gg_api_scene_finish(scene, &r->scene, err));
  GG_TRY(gg_scene_model_make(&r->scene, r->scene.engine, &r->model, err));
  GG_TRY(read_start(r, err));
  GG_TRY(gg_api_log_name(r, err));
  GG_TRY(gg_api_files_check(r, err));
  GG_TRY(begin_checkpoints(r, err));
  if (r->options.output) GG_TRY(gg_files_result_file_open(&r->file, r->options.output, r->options.command, err));
  r->file.file.stop = (gg_stop){is_stopped, r};
  return gg_api_picture_check(r, err);
}

static void end(gg_api_run_call *r)
{
  gg_files_result_file_abandon(&r->file);
  gg_api_trajectory_end(r);
  gg_api_log_end(r);
  gg_io_file_lock_release(&r->lock);
  gg_base_archive_clear(&r->resume);
  gg_files_positions_free(&r->start);
  for (int i = 0; i < GG_TEMPORARIES; i++) free(r->temporary[i]);
  gg_base_string_list_clear(&r->warnings);
}

static void warn_if_dilute(gg_api_run_call *r)
{
  enum { LEAST = 20 };
  const double ratio = gg_run_cost_dilute(&r->scene, &r->model);
  if (ratio < LEAST) return;
  gg_base_string_list_add(
      &r->warnings,
      "so dilute a gas takes about %.0f times less time a collision with engine: dsmc, which is exact there",
      10 * round(ratio / 10));
}

static void warn_of_keys(gg_api_run_call *r)
{
  const gg_engine_kind engine = r->scene.engine;
  if (r->comparison)
    gg_scene_ineffective_keys(&r->scene, GG_USE_MD | GG_USE_DSMC | GG_USE_THEORY, &r->warnings);
  else if (gg_common_engine_of(engine)->accepts(&r->model, NULL) == GG_OK)
    gg_scene_ineffective_keys(&r->scene, 1u << engine, &r->warnings);
  if (!r->comparison && engine == GG_MD) warn_if_dilute(r);
  for (size_t i = 0; i < r->warnings.n && r->options.warn; i++)
    r->options.warn(r->options.context, r->warnings.text[i]);
}

/* Run both engines, or the engine of the scene. Warnings about keys are the first of a comparison, the last of a run.
 */
static gg_status run_engines(gg_api_run_call *r, gg_comparison *c, gg_error *err)
{
  const gg_archive *resume = r->resume.n_items ? &r->resume : NULL;
  gg_result **result = &c->by_engine[r->scene.engine];
  if (!r->comparison) GG_TRY(gg_api_trajectory_begin(r, err));
  GG_TRY(gg_api_log_begin(r, err));
  r->started = true;
  gg_status status = r->comparison ? gg_run_compare_scene(&r->scene, resume, r->options.threads, &r->callbacks, c, err)
                                   : gg_run_scene(&r->scene, resume, r->options.threads, &r->callbacks, result, err);
  if (r->comparison) gg_base_string_list_move(&r->warnings, &c->warnings);
  if (r->comparison || *result)
    gg_base_string_list_move(r->comparison ? &c->warnings : &(*result)->warnings, &r->warnings);
  return status;
}

static gg_status write_output(gg_api_run_call *r, const gg_comparison *c, gg_error *err)
{
  if (r->comparison) return gg_files_result_file_finish_comparison(&r->file, c, err);
  gg_result *result = c->by_engine[r->scene.engine];
  GG_TRY(gg_api_trajectory_finish(r, result, err));
  return gg_files_result_file_finish_run(&r->file, result, err);
}

/* The result is in place: remove the checkpoints of this run, all but the last one if the scene says so. */
static void remove_checkpoints(gg_api_run_call *r)
{
  struct stat about;
  if (!r->options.output || !r->options.checkpoint || !(r->stored || r->resumes_in_place)) return;
  const bool kept = r->scene.output.state == GG_STATE_KEPT;
  for (int i = 0; i < GG_TEMPORARIES; i++)
    if ((!kept || i == GG_TEMPORARY_BEFORE) && stat(r->temporary[i], &about) == 0 && S_ISREG(about.st_mode))
      unlink(r->temporary[i]);
}

/* Write the results, commit them, and remove the checkpoints of a finished run. A point of a sweep is also finished if
 * it ended before its stopping criteria. */
static gg_status finish(gg_api_run_call *r, gg_point_call *point, gg_status status, const gg_comparison *c,
                        gg_error *err)
{
  const bool whole = c && (status == GG_OK || status == GG_FAILED), named = point && point->commit && whole;
  gg_status written = GG_OK;
  if (whole && r->options.output) {
    gg_run_scheduler_leave(r->callbacks.scheduler); /* let other runs compute while the disk is busy */
    written = write_output(r, c, err);
    gg_run_scheduler_enter(r->callbacks.scheduler);
  }
  if (named && written == GG_OK) written = point->commit(point->context, status, err);
  if ((status == GG_OK || named) && written == GG_OK) remove_checkpoints(r);
  bool rejected = r->resume.n_items && r->started && !c && (status == GG_BAD_FILE || status == GG_BAD_INPUT);
  if (point) point->resume_lost = r->resume_lost || rejected;
  return written;
}

/* The status of writing if it failed, with both messages; otherwise the status of the run. */
static gg_status status_of(gg_status run, gg_status written, const gg_error *why, gg_error *err)
{
  if (written == GG_OK) return run;
  if (run == GG_OK) return gg_base_fail(err, written, "%s", why->message);
  char message[sizeof why->message];
  memcpy(message, why->message, sizeof message);
  return gg_base_fail(err, written, "%.500s; and %.500s", message, err ? err->message : "");
}

static gg_status simulate(gg_api_run_call *r, gg_point_call *point, const gg_scene *scene,
                          const gg_run_options *options, bool comparison, gg_comparison **made, gg_error *err)
{
  gg_error why = {0};
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *c = gg_base_array_new(1, sizeof *c, err);
  if (!c) return GG_FAILED;
  const unsigned before = gg_base_memory_failures();
  gg_status status = begin(r, scene, options, comparison, point != NULL, err);
  r->callbacks.scheduler = point ? point->scheduler : NULL;
  if (status == GG_OK) {
    warn_of_keys(r);
    status = run_engines(r, c, err);
  }
  bool has_results = gg_run_comparison_first(c) || (comparison && status == GG_OK);
  if (gg_base_memory_failures() != before && status == GG_OK) { /* e.g. a warning is missing */
    status = gg_base_out_of_memory(err);
    has_results = false;
  }
  gg_status written = finish(r, point, status, has_results ? c : NULL, &why);
  end(r);
  note_failure(r);
  if (atomic_load(&r->callback_failed)) status = gg_base_fail(err, GG_FAILED, "%s", r->callback_reason.message);
  if (has_results) GG_HAND_OVER(made, c);
  return status_of(status, written, &why, err);
}

gg_status gg_api_run_simulate(gg_point_call *point, const gg_scene *scene, const gg_run_options *options,
                              bool comparison, gg_comparison **made, gg_error *err)
{
  GG_FREED gg_api_run_call *r = gg_base_array_new(1, sizeof *r, err); /* too large for small stacks */
  if (!r) return GG_FAILED;
  gg_extension *held = gg_common_extension_hold(scene->extension); /* the scene may be freed during the run */
  gg_status status = simulate(r, point, scene, options, comparison, made, err);
  gg_common_extension_release(held);
  return status;
}

gg_status gg_run(const gg_scene *scene, const gg_run_options *options, gg_result **result, gg_error *err)
{
  GG_NEED(scene, result);
  gg_run_options own;
  GG_COPY_OPTIONS(own, options);
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *made = NULL;
  gg_status status = gg_api_run_simulate(NULL, scene, &own, false, &made, err);
  for (int k = 0; made && k < GG_N_ENGINES; k++)
    if (made->by_engine[k]) GG_HAND_OVER(result, made->by_engine[k]);
  return status;
}

gg_status gg_compare(const gg_scene *scene, const gg_run_options *options, gg_comparison **comparison, gg_error *err)
{
  GG_NEED(scene, comparison);
  gg_run_options own;
  GG_COPY_OPTIONS(own, options);
  return gg_api_run_simulate(NULL, scene, &own, true, comparison, err);
}
