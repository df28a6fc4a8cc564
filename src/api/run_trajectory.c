/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames of a run: to its result, or to a frame log beside its checkpoint.
 *
 * If a run does not resume from the log beside its checkpoint, an earlier run may still need that log. So the run
 * writes X.frames.new, and its first checkpoint replaces the files of the earlier run in three steps. After a kill -9
 * the next run finds the log that is needed by the mark in the checkpoint (resolve_new). There are
 * - before the steps: X.h5, X.h5.1 and X.frames of the earlier run, which can be resumed; X.frames.new is not needed;
 * - once X.h5 is replaced: the new X.h5 with X.frames.new, and X.h5.1 of the earlier run with X.frames;
 * - once X.h5.1 is removed: the new X.h5 with X.frames.new; X.frames of the earlier run is not needed;
 * - once X.frames is replaced: X.h5 and X.frames of the new run. */
#include <errno.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "api/run.h"
#include "base/memory.h"
#include "files/h5/checkpoint_file.h"

static const char mark_item[] = "trajectory/mark", name_item[] = "trajectory/name";
enum { NAME = 256 };

static gg_status store_in_result(void *context, const gg_frame *frame, gg_error *err)
{
  gg_api_run_call *r = context;
  r->file.scene = &r->scene;
  return gg_files_result_file_frame(&r->file, &r->model, frame, err);
}

static gg_status store_in_log(void *context, const gg_frame *frame, gg_error *err)
{
  return gg_files_frame_log_append(&((gg_api_run_call *)context)->log, frame, err);
}

/* Store a frame of a log, after validation: the file may have been changed. */
static gg_status store_from_log(void *context, const gg_frame *frame, gg_error *err)
{
  GG_TRY(gg_run_frame_check(frame, &((gg_api_run_call *)context)->model, err));
  return store_in_result(context, frame, err);
}

/* Path of the log of the checkpoint to resume, to be freed. The log has the name of the checkpoint, or, if only the
 * checkpoint was copied and renamed, the name that is stored in it. */
static char *log_of_resume(const gg_api_run_call *r)
{
  char *path = gg_files_frame_log_path(r->options.resume), *copy = NULL, *other = NULL, name[NAME];
  bool there = path && access(path, F_OK) == 0;
  if (!there && path && gg_base_archive_get(&r->resume, name_item, GG_ITEM_U8, name, NAME, NULL) == GG_OK) {
    copy = strdup(r->options.resume);
    if (!copy || asprintf(&other, "%s/%.*s", dirname(copy), NAME, name) < 0) other = NULL;
  }
  if (other && access(other, F_OK) == 0) {
    free(path);
    path = other, other = NULL;
  }
  free(copy);
  free(other);
  return path;
}

/* Open the log up to the mark; or X.frames.new, if the run was killed before the log was renamed. */
static gg_status open_one_of_two(gg_api_run_call *r, gg_frame_log *log, const char *path, const gg_frame_mark *mark,
                                 gg_error *err)
{
  gg_status status = gg_files_frame_log_open_at(log, path, mark, &r->file.file.stop, err);
  GG_FREED char *fresh = status == GG_BAD_FILE ? gg_files_frame_log_new_path(path) : NULL;
  if (fresh) {
    gg_status other = gg_files_frame_log_open_at(log, fresh, mark, &r->file.file.stop, NULL);
    if (other == GG_INTERRUPTED) gg_base_fail(err, other, "interrupted");
    if (other != GG_BAD_FILE) status = other;
  }
  return status;
}

/* Open the log with the frames before the checkpoint. All frames are checked. */
static gg_status open_earlier(gg_api_run_call *r, gg_frame_log *earlier, gg_error *err)
{
  gg_frame_mark mark;
  gg_error why;
  GG_TRY(gg_base_archive_get(&r->resume, mark_item, GG_ITEM_U8, &mark, sizeof mark, err));
  if (!mark.frames) return GG_OK;
  GG_FREED char *path = log_of_resume(r);
  if (!path) return gg_base_out_of_memory(err);
  gg_status status = open_one_of_two(r, earlier, path, &mark, &why);
  if (status != GG_BAD_FILE) return status == GG_OK ? GG_OK : gg_base_fail(err, status, "%s", why.message);
  r->resume_lost = true;
  return gg_base_fail(err, status,
                      "%s. It belongs to the checkpoint, with the %llu frames of the trajectory before it; without it "
                      "the run can be resumed with output.trajectory_every: 0",
                      why.message, (unsigned long long)mark.frames);
}

static gg_status open_log(gg_api_run_call *r, const gg_frame_log *earlier, gg_error *err)
{
  const char *target = r->temporary[GG_TEMPORARY_FRAMES];
  GG_FREED char *path = gg_files_frame_log_path(r->options.checkpoint);
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  if (!path) return gg_base_out_of_memory(err);
  GG_TRY(gg_io_output_path_find(&place, path, err));
  if (place.stream) return gg_io_path_write_error(path, "it is a device or a pipe; frames are kept in files", err);
  bool there = earlier->fd >= 0 ? gg_files_frame_log_is_at(earlier, target) : r->resumes_in_place;
  return there ? gg_files_frame_log_open(&r->log, target, err) : gg_files_frame_log_open_new(&r->log, target, err);
}

/* Mark of the checkpoint at options.checkpoint; no frames without such a checkpoint. */
static gg_frame_mark mark_there(const gg_api_run_call *r)
{
  gg_frame_mark mark = {0};
  GG_CLEARED(gg_base_archive_clear) gg_archive there = {0};
  bool older, on = r->resumes_in_place;
  if (!on && gg_files_checkpoint_read(r->options.checkpoint, true, &there, &older, NULL) != GG_OK) return mark;
  if (gg_base_archive_get(on ? &r->resume : &there, mark_item, GG_ITEM_U8, &mark, sizeof mark, NULL) != GG_OK)
    mark = (gg_frame_mark){0};
  return mark;
}

/* A killed run has left X.frames.new: rename it to X.frames if the checkpoint needs it, otherwise remove it. */
static gg_status commit_or_remove(gg_api_run_call *r, const char *path, const char *fresh, gg_error *err)
{
  gg_frame_log log = {.fd = -1};
  gg_frame_mark mark = mark_there(r);
  gg_status status = mark.frames ? open_one_of_two(r, &log, path, &mark, err) : GG_BAD_FILE;
  bool needed = log.fd >= 0 && gg_files_frame_log_is_at(&log, fresh);
  gg_files_frame_log_close(&log);
  if (status == GG_INTERRUPTED) return status;
  if (needed) GG_TRY(gg_files_checkpoint_remove_before(r->options.checkpoint, err));
  if ((needed ? rename(fresh, path) : unlink(fresh)) != 0) return gg_io_path_write_error(fresh, strerror(errno), err);
  return GG_OK;
}

static gg_status resolve_new(gg_api_run_call *r, gg_error *err)
{
  const char *path = r->temporary[GG_TEMPORARY_FRAMES];
  GG_FREED char *fresh = gg_files_frame_log_new_path(path);
  if (!fresh) return gg_base_out_of_memory(err);
  return access(fresh, F_OK) == 0 ? commit_or_remove(r, path, fresh, err) : GG_OK;
}

gg_status gg_api_trajectory_begin(gg_api_run_call *r, gg_error *err)
{
  if (r->options.checkpoint) GG_TRY(resolve_new(r, err));
  if (!r->options.output || !(r->scene.output.trajectory_every > 0)) return GG_OK;
  GG_CLEARED(gg_files_frame_log_close) gg_frame_log earlier = {.fd = -1};
  r->frames_missing = r->resume.n_items > 0 && !gg_base_archive_find(&r->resume, mark_item);
  r->callbacks.frame = r->options.checkpoint ? store_in_log : store_in_result;
  if (r->resume.n_items > 0 && !r->frames_missing) GG_TRY(open_earlier(r, &earlier, err));
  if (r->options.checkpoint) GG_TRY(open_log(r, &earlier, err));
  if (earlier.fd < 0) return GG_OK;
  return r->log.fd >= 0 ? gg_files_frame_log_take_over(&r->log, &earlier, err)
                        : gg_files_frame_log_replay(&earlier, store_from_log, r, err);
}

uint64_t gg_api_trajectory_frames(const gg_archive *a)
{
  gg_frame_mark mark = {0};
  return gg_base_archive_get(a, mark_item, GG_ITEM_U8, &mark, sizeof mark, NULL) == GG_OK ? mark.frames : 0;
}

gg_status gg_api_trajectory_mark(const gg_api_run_call *r, gg_archive *archive, gg_error *err)
{
  char name[NAME] = "";
  if (r->log.fd < 0) return GG_OK;
  GG_TRY(gg_files_frame_log_sync(&r->log, err));
  GG_FREED char *path = gg_files_frame_log_path(r->options.checkpoint);
  if (!path) return gg_base_out_of_memory(err);
  const char *slash = strrchr(path, '/');
  snprintf(name, sizeof name, "%s", slash ? slash + 1 : path);
  GG_TRY(gg_base_archive_put(archive, name_item, GG_ITEM_U8, name, sizeof name, err));
  return gg_base_archive_put(archive, mark_item, GG_ITEM_U8, &r->log.mark, sizeof r->log.mark, err);
}

/* Copy a frame from the log. Copying gigabytes takes seconds, so a run that can be resumed may be interrupted here. */
static gg_status move_to_result(void *context, const gg_frame *frame, gg_error *err)
{
  gg_api_run_call *r = context;
  if (r->stored && gg_stop_asked(&r->file.file.stop))
    return gg_base_fail(err, GG_INTERRUPTED, "interrupted while the trajectory was put into %s", r->options.output);
  return store_from_log(context, frame, err);
}

gg_status gg_api_trajectory_finish(gg_api_run_call *r, gg_result *result, gg_error *err)
{
  if (r->frames_missing) GG_WARN(result, "the trajectory begins where the run was resumed: the run before kept none");
  return r->log.fd >= 0 ? gg_files_frame_log_replay(&r->log, move_to_result, r, err) : GG_OK;
}

void gg_api_trajectory_end(gg_api_run_call *r)
{
  if (r->log.fd >= 0 && r->log.created && !r->stored) unlink(r->log.path);
  gg_files_frame_log_close(&r->log);
}
