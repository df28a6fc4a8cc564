/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One call of gg_run or gg_compare: options turned into the callbacks of a run, and its files. */
#ifndef GG_API_RUN_H
#define GG_API_RUN_H

#include <stdatomic.h>

#include "api/api.h"
#include "files/frame_log.h"
#include "files/h5/result_file.h"
#include "run/run.h"

/* Files that are to be removed once the run is done, by where links lead. */
enum { GG_TEMPORARY_CHECKPOINT, GG_TEMPORARY_BEFORE, GG_TEMPORARY_FRAMES, GG_TEMPORARIES };

/* run_log.c: the rows of output.log. */
typedef struct gg_sample_log {
  int fd;     /* -1: none */
  char *path; /* NULL: none */
  bool json;  /* a JSON object a line; else CSV */
  gg_file_lock lock;
  struct gg_sample_log_state { /* plain data: saved as bytes */
    uint64_t sample, rows;     /* of the last row; rows in the sums: since averaging began */
  } state;
  size_t width;
  double *sum, *mean; /* over those rows, of each channel */
} gg_sample_log;

typedef struct gg_run_call {
  gg_run_options options;
  bool comparison; /* both engines and the theories; else the scene's engine */
  gg_run_callbacks callbacks;
  gg_scene scene;      /* finished */
  gg_model model;      /* of the scene's engine: for the run and for its frames */
  gg_archive resume;   /* empty: from the start */
  gg_result_file file; /* of options.output */
  gg_frame_log log;    /* of the frames of a run that keeps checkpoints */
  gg_sample_log samples;
  bool frames_missing;             /* those before the resumption, which did not ask for any */
  bool stored;                     /* a checkpoint */
  bool started;                    /* all before the run itself went well */
  bool resume_lost;                /* the checkpoint to resume from, or its frames, are damaged */
  bool resumes_in_place;           /* from what is beside its own checkpoint */
  bool replaces;                   /* a checkpoint that cannot be resumed: a point of a sweep */
  char *temporary[GG_TEMPORARIES]; /* of a run that keeps checkpoints */
  gg_string_list warnings;         /* keys without effect */
  atomic_bool stopped;
  atomic_bool callback_failed;
  gg_error callback_reason;
  gg_file_lock lock; /* of options.checkpoint */
} gg_run_call;

/* What is more about a run that is a point of a sweep. */
typedef struct gg_point_call {
  gg_run_scheduler *scheduler; /* which the caller has entered; NULL: the run's own, or the workers' */
  /* Give the output, which is in place, the name that says how the run ended: before its checkpoints are removed. */
  gg_status (*publish)(void *context, gg_status run, gg_error *err);
  void *context;
  bool resume_lost; /* set: the checkpoint to resume cannot be used */
} gg_point_call;
/* gg_run and gg_compare, also for a point (NULL: it is none). *made, set where there is anything: both engines and the
 * theories, or the result of the scene's engine alone. */
gg_status gg_api_run_simulate(gg_point_call *point, const gg_scene *scene, const gg_run_options *options,
                              bool comparison, gg_comparison **made, gg_error *err);

/* output_files.c, before the run: no two of the files that are read and written are one, and a result is not called
 * like a picture; the picture and the pages beside it can be written. */
gg_status gg_api_files_check(const gg_run_call *run, gg_error *err);
gg_status gg_api_picture_check(const gg_run_call *run, gg_error *err);

/* The log that the scene names: beside the output, unless its path is absolute or the output is a device or a pipe. */
gg_status gg_api_log_name(gg_run_call *run, gg_error *err);
/* Before the run: opens it, and cuts it to what the checkpoint to resume from has. */
gg_status gg_api_log_begin(gg_run_call *run, gg_error *err);
gg_status gg_api_log_mark(const gg_run_call *run, gg_archive *archive, gg_error *err);
void gg_api_log_end(gg_run_call *run);

/* run_trajectory.c: the frames of a run go to the result as they come. Where checkpoints are kept, they go to the log
 * beside them, and to the result at the end. What a resumed run had before goes first. */
gg_status gg_api_trajectory_begin(gg_run_call *run, gg_error *err);
/* All frames so far are on the disk; a checkpoint says how many they are. */
gg_status gg_api_trajectory_mark(const gg_run_call *run, gg_archive *archive, gg_error *err);
/* How many they are, by an archive. */
uint64_t gg_api_trajectory_frames(const gg_archive *archive);
/* Before the result is written. */
gg_status gg_api_trajectory_finish(gg_run_call *run, gg_result *result, gg_error *err);
void gg_api_trajectory_end(gg_run_call *run);

#endif
