/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One call of gg_run or gg_compare: its options, the callbacks of the run, and its files. */
#ifndef GG_API_RUN_H
#define GG_API_RUN_H

#include <stdatomic.h>

#include "api/api.h"
#include "files/frame_log.h"
#include "files/h5/result_file.h"
#include "files/positions.h"
#include "run/run.h"
#include "scene/scene.h"

/* Files that are removed at the end of the run. Their names are those after following links. */
enum { GG_TEMPORARY_CHECKPOINT, GG_TEMPORARY_BEFORE, GG_TEMPORARY_FRAMES, GG_TEMPORARIES };

/* run_log.c: the rows of output.log. */
typedef struct gg_sample_log {
  int fd;     /* -1: none */
  char *path; /* NULL: none */
  bool json;  /* a JSON object a line; else CSV */
  gg_file_lock lock;
  struct gg_sample_log_state { /* plain data: saved as bytes */
    uint64_t sample, rows;     /* sample of the last row; rows in the sums, since averaging began */
  } state;
  size_t width;
  double *sum, *mean; /* over these rows, of each channel */
} gg_sample_log;

typedef struct gg_api_run_call {
  gg_run_options options;
  bool comparison; /* both engines and the theories; otherwise the engine of the scene */
  gg_run_callbacks callbacks;
  gg_scene scene;      /* completed and checked */
  gg_model model;      /* for the scene's engine; used by the run and for its frames */
  gg_positions start;  /* start.positions of a file */
  gg_archive resume;   /* empty: a new run */
  gg_result_file file; /* options.output */
  gg_frame_log log;    /* frames of a run that keeps checkpoints */
  gg_sample_log samples;
  bool frames_missing;             /* the run before the resumption stored no frames */
  bool stored;                     /* a checkpoint was written */
  bool started;                    /* the preparations succeeded, and the run was called */
  bool resume_lost;                /* the checkpoint to resume from, or its frame log, is damaged */
  bool resumes_in_place;           /* options.resume is options.checkpoint */
  bool replaces;                   /* may replace an earlier checkpoint: set for points of sweeps */
  char *temporary[GG_TEMPORARIES]; /* NULL without checkpoints */
  gg_string_list warnings;         /* keys without effect */
  atomic_bool stopped;
  atomic_bool callback_failed;
  gg_error callback_reason;
  gg_file_lock lock; /* on options.checkpoint */
} gg_api_run_call;

/* Further arguments of a run that is a point of a sweep. */
typedef struct gg_point_call {
  gg_run_scheduler *scheduler; /* entered by the caller; NULL: a new one, or that of the workers */
  /* Rename the finished output by the run's status (NAME.h5 or NAME.short.h5), before the checkpoints are removed. */
  gg_status (*commit)(void *context, gg_status run, gg_error *err);
  void *context;
  bool resume_lost; /* set if the checkpoint cannot be resumed */
} gg_point_call;
/* gg_run and gg_compare; `point` is NULL outside of sweeps. *made is set if there are any results: of both engines and
 * the theories, or only of the scene's engine. */
gg_status gg_api_run_simulate(gg_point_call *point, const gg_scene *scene, const gg_run_options *options,
                              bool comparison, gg_comparison **made, gg_error *err);

/* output_files.c: check the files before the run. All files that are read and written differ, and the result does not
 * have the name of a picture; the picture and the pages beside it can be written. */
gg_status gg_api_files_check(const gg_api_run_call *run, gg_error *err);
gg_status gg_api_picture_check(const gg_api_run_call *run, gg_error *err);

/* run_log.c: name of the log (output.log of the scene). It is beside the output, unless its path is absolute or the
 * output is a device or a pipe. */
gg_status gg_api_log_name(gg_api_run_call *run, gg_error *err);
/* Open the log and cut it after the last row of the checkpoint to resume from. */
gg_status gg_api_log_begin(gg_api_run_call *run, gg_error *err);
gg_status gg_api_log_mark(const gg_api_run_call *run, gg_archive *archive, gg_error *err);
void gg_api_log_end(gg_api_run_call *run);

/* run_trajectory.c: frames are written to the result at once. With checkpoints they are written to the frame log beside
 * the checkpoint, and copied to the result at the end. The earlier frames of a resumed run come first. */
gg_status gg_api_trajectory_begin(gg_api_run_call *run, gg_error *err);
/* Flush all frames to disk and store their number in the checkpoint. */
gg_status gg_api_trajectory_mark(const gg_api_run_call *run, gg_archive *archive, gg_error *err);
/* Number of frames in a checkpoint. */
uint64_t gg_api_trajectory_frames(const gg_archive *archive);
/* Copy the frame log to the result. */
gg_status gg_api_trajectory_finish(gg_api_run_call *run, gg_result *result, gg_error *err);
void gg_api_trajectory_end(gg_api_run_call *run);

#endif
