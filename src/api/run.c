/* Runs and comparisons with options. */
#include "api/run.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/c_locale.h"
#include "base/memory.h"
#include "common/engine.h"
#include "files/h5/checkpoint_file.h"
#include "run/scheduler.h"
#include "scene/fields.h"

static void hear_progress(void *context, const gg_progress *progress)
{
  gg_door_run *r = context;
  if (r->options.progress && r->options.progress(r->options.context, progress)) atomic_store(&r->stopped, true);
}

/* Does the caller want the run to end? */
static bool is_stopped(void *context)
{
  gg_door_run *r = context;
  if (r->options.stop && r->options.stop(r->options.context)) atomic_store(&r->stopped, true);
  return atomic_load(&r->stopped);
}

static gg_status store_checkpoint(void *context, gg_archive *archive, gg_error *err)
{
  gg_door_run *r = context;
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_api_trajectory_mark(r, archive, err);
  if (status == GG_OK)
    status = r->log.place ? gg_files_checkpoint_replace(r->options.checkpoint, archive, &r->scene, err)
                          : gg_files_checkpoint_write(r->options.checkpoint, true, archive, &r->scene, err);
  gg_base_c_locale_leave(before);
  if (status != GG_OK) return status;
  r->stored = true;
  GG_TRY(gg_files_frame_log_put_in_place(&r->log, err));
  if (r->options.stored) r->options.stored(r->options.context, r->options.checkpoint);
  return GG_OK;
}

static gg_status read_resume(gg_door_run *r, gg_error *err)
{
  bool older;
  char text[1024];
  const char *path = r->options.resume;
  gg_status status = gg_files_checkpoint_read(path, &r->resume, &older, err);
  r->resume_lost = status != GG_OK;
  if (status != GG_OK) return status;
  snprintf(text, sizeof text, "%s cannot be read; going on from the one before, %s.1", path, path);
  if (older && r->options.warn) r->options.warn(r->options.context, text);
  return GG_OK;
}

/* From here to the end of the run nobody else writes it. */
static gg_status lock_checkpoint(gg_door_run *r, gg_error *err)
{
  const char *path = r->options.checkpoint;
  gg_output_path place;
  GG_TRY(gg_base_output_path_find(&place, path, err));
  gg_status status = place.stream
                         ? gg_base_fail(err, GG_BAD_FILE, "%s: is a device or a pipe; " GG_CHECKPOINTS_ARE, path)
                         : gg_base_file_lock_take(&r->lock, place.target, path, err);
  gg_base_output_path_clear(&place);
  return status;
}

/* Before the run: at its end, with the results in place, there may be no memory for a name. */
static gg_status name_passing(gg_door_run *r, gg_error *err)
{
  const char *path = r->options.checkpoint;
  char *frames = gg_files_frame_log_path(path);
  r->passing[GG_PASSING_CHECKPOINT] = gg_base_path_follow_links(path);
  r->passing[GG_PASSING_BEFORE] = gg_files_checkpoint_before(path);
  r->passing[GG_PASSING_FRAMES] = frames ? gg_base_path_follow_links(frames) : NULL;
  free(frames);
  for (int i = 0; i < GG_PASSINGS; i++)
    if (!r->passing[i]) return gg_base_out_of_memory(err);
  return GG_OK;
}

static gg_status begin_checkpoints(gg_door_run *r, gg_error *err)
{
  const gg_run_options *o = &r->options;
  if (o->checkpoint) GG_TRY(lock_checkpoint(r, err));
  if (o->resume) GG_TRY(read_resume(r, err));
  r->goes_on_there = o->checkpoint && r->resume.n_items > 0 && gg_files_checkpoint_is_of(o->resume, o->checkpoint);
  return o->checkpoint ? name_passing(r, err) : GG_OK;
}

gg_status gg_api_run_begin(gg_door_run *r, const gg_scene *scene, const gg_run_options *options, bool comparison,
                           gg_hooks *hooks, gg_error *err)
{
  memset(r, 0, sizeof *r);
  r->file = (gg_result_file){.file = GG_ATOMIC_NONE};
  r->lock = GG_FILE_LOCK_NONE;
  r->log.fd = -1;
  r->comparison = comparison;
  if (options) r->options = *options;
  if (r->options.threads < 1) r->options.threads = 1;
  if (!r->options.command) r->options.command = "the graingas library";
  atomic_init(&r->stopped, false);
  *hooks =
      (gg_hooks){.context = r, .progress = hear_progress, .interrupted = is_stopped, .workers = r->options.workers};
  if (r->options.checkpoint) hooks->checkpoint = store_checkpoint;
  GG_TRY(gg_api_scene_finish(scene, &r->scene, err));
  GG_TRY(gg_common_model_make(&r->scene, r->scene.engine, &r->model, err));
  GG_TRY(gg_api_files_check(r, err));
  GG_TRY(begin_checkpoints(r, err));
  if (r->options.output) GG_TRY(gg_files_result_file_open(&r->file, r->options.output, r->options.command, err));
  r->file.file.stop = (gg_stop){is_stopped, r};
  return gg_api_picture_check(r, err);
}

void gg_api_run_end(gg_door_run *r)
{
  gg_files_result_file_abandon(&r->file);
  gg_api_trajectory_end(r);
  gg_base_file_lock_release(&r->lock);
  gg_base_archive_clear(&r->resume);
  for (int i = 0; i < GG_PASSINGS; i++) free(r->passing[i]);
  gg_base_string_list_clear(&r->warnings);
}

const gg_archive *gg_api_run_resume(const gg_door_run *r)
{
  return r->resume.n_items ? &r->resume : NULL;
}

/* All is done and the result in place: the run's own checkpoints have had their day. */
static void remove_checkpoints(gg_door_run *r)
{
  struct stat about;
  if (!r->options.output || !r->options.checkpoint || !(r->stored || r->goes_on_there)) return;
  for (int i = 0; i < GG_PASSINGS; i++)
    if (stat(r->passing[i], &about) == 0 && S_ISREG(about.st_mode)) unlink(r->passing[i]);
}

gg_status gg_api_run_close(gg_door_run *r, gg_door_point *point, bool some, gg_status status, gg_status written,
                           gg_error *err)
{
  if (point && point->publish && some && (status == GG_OK || status == GG_FAILED) && written == GG_OK)
    written = point->publish(point->context, status, err);
  bool short_point = point && point->publish && some && status == GG_FAILED; /* it counts as done */
  if ((status == GG_OK || short_point) && written == GG_OK) remove_checkpoints(r);
  bool refused = gg_api_run_resume(r) && !some && (status == GG_BAD_FILE || status == GG_BAD_INPUT) && r->ran;
  if (point) point->resume_lost = r->resume_lost || refused;
  return written;
}

gg_status gg_api_run_status(gg_status run, gg_status written, const gg_error *why, gg_error *err)
{
  if (written == GG_OK) return run;
  if (run == GG_OK) return gg_base_fail(err, written, "%s", why->message);
  char message[sizeof why->message];
  memcpy(message, why->message, sizeof message);
  return gg_base_fail(err, written, "%.500s; and %.500s", message, err ? err->message : "");
}

void gg_api_run_estimate(gg_door_run *r, unsigned uses)
{
  gg_scene_ineffective_keys(&r->scene, uses, &r->warnings);
  for (size_t i = 0; i < r->warnings.n && r->options.warn; i++)
    r->options.warn(r->options.context, r->warnings.text[i]);
}

gg_status gg_run(const gg_scene *scene, const gg_run_options *options, gg_result **result, gg_error *err)
{
  GG_NEED(scene);
  GG_NEED(result);
  return gg_api_run_with(NULL, scene, options, result, err);
}

gg_status gg_api_run_with(gg_door_point *point, const gg_scene *scene, const gg_run_options *options,
                          gg_result **result, gg_error *err)
{
  gg_crew *crew = point ? point->crew : NULL;
  gg_door_run run;
  gg_hooks hooks;
  gg_error why = {0};
  gg_result *made = NULL;
  const bool before = gg_base_memory_begin();
  gg_status status = gg_api_run_begin(&run, scene, options, false, &hooks, err), written = GG_OK;
  gg_engine_kind engine = run.scene.engine;
  hooks.crew = crew;
  if (status == GG_OK && gg_run_engine_ops_of(engine)->accepts(&run.model, NULL) == GG_OK)
    gg_api_run_estimate(&run, 1u << engine);
  if (status == GG_OK) status = gg_api_trajectory_begin(&run, &hooks, err);
  run.ran = status == GG_OK;
  if (status == GG_OK)
    status = gg_run_scene(&run.scene, gg_api_run_resume(&run), run.options.threads, &hooks, &made, err);
  for (size_t i = 0; made && i < run.warnings.n; i++) gg_run_result_warn(made, "%s", run.warnings.text[i]);
  if (gg_base_memory_end(before) && status == GG_OK) { /* it lacks a warning, or worse */
    gg_result_free(made);
    made = NULL;
    status = gg_base_out_of_memory(err);
  }
  if (made && run.options.output && (status == GG_OK || status == GG_FAILED)) {
    gg_run_crew_pause(crew); /* disks take their time */
    written = gg_api_trajectory_finish(&run, made, &why);
    if (written == GG_OK) written = gg_files_result_file_finish_run(&run.file, made, &why);
    gg_run_crew_go_on(crew);
  }
  written = gg_api_run_close(&run, point, made != NULL, status, written, &why);
  gg_api_run_end(&run);
  if (made) *result = made;
  return gg_api_run_status(status, written, &why, err);
}
