/* What gg_run and gg_compare have in common: options turned into the hooks of a run. */
#ifndef GG_DOOR_RUN_H
#define GG_DOOR_RUN_H

#include <stdatomic.h>

#include "api/api.h"
#include "files/frame_log.h"
#include "files/h5/result_file.h"
#include "run/run.h"

/* Files that are to be removed once the run is done, by where links lead. */
enum { GG_PASSING_CHECKPOINT, GG_PASSING_BEFORE, GG_PASSING_FRAMES, GG_PASSINGS };

typedef struct gg_door_run {
  gg_run_options options;
  gg_scene scene;             /* finished */
  gg_archive resume;          /* empty: from the start */
  gg_result_file file;        /* of options.output */
  gg_model model;             /* of the frames */
  gg_frame_log log;           /* of the frames of a run that keeps checkpoints */
  bool late;                  /* frames before the resumption were not asked for */
  bool stored;                /* a checkpoint */
  bool comparison;            /* of both engines */
  bool ran;                   /* all before the run itself went well */
  bool resume_lost;           /* what it was to go on from cannot be gone on from */
  bool goes_on_there;         /* from what is beside its own checkpoint */
  char *passing[GG_PASSINGS]; /* of a run that keeps checkpoints */
  gg_text_list warnings;      /* of the scene, for what it is used for */
  atomic_bool stopped;
  gg_file_lock lock; /* of options.checkpoint */
} gg_door_run;

/* Of one engine or a comparison. Finish the scene, read what is resumed from, see that the output can be written; hooks
 * for the run, which last as long as `run`. To be followed by gg_api_run_end, also on failure. */
gg_status gg_api_run_begin(gg_door_run *run, const gg_scene *scene, const gg_run_options *options, bool comparison,
                           gg_hooks *hooks, gg_error *err);
void gg_api_run_end(gg_door_run *run);
/* output_files.c: no two of the files that are read and written are one, and a result is not called like a picture; the
 * picture that is to be drawn could be, and all that may come beside it. What cannot be written is better known before
 * the run than after it. */
gg_status gg_api_files_check(const gg_door_run *run, gg_error *err);
gg_status gg_api_picture_check(const gg_door_run *run, gg_error *err);
/* Note and tell, once begun, which keys have no effect on what the scene is used for (scene/ineffective_keys.h). */
void gg_api_run_estimate(gg_door_run *run, unsigned uses);
/* What is more about a run that is a point of a sweep. */
typedef struct gg_door_point {
  gg_crew *crew; /* that does it (run/scheduler.h), and the caller is one of; NULL: none */
  /* Give the output, which is in place, the name that says how the run ended: before its checkpoints are removed. */
  gg_status (*publish)(void *context, gg_status run, gg_error *err);
  void *context;
  bool resume_lost; /* set: what it was to go on from cannot be gone on from */
} gg_door_point;
/* gg_run and gg_compare for a point; NULL: they are none. */
gg_status gg_api_run_with(gg_door_point *point, const gg_scene *scene, const gg_run_options *options,
                          gg_result **result, gg_error *err);
gg_status gg_api_compare_with(gg_door_point *point, const gg_scene *scene, const gg_run_options *options,
                              gg_comparison **comparison, gg_error *err);
/* Once the result was written, GG_OK or not: publish it, if that is asked for, and see to the checkpoints. */
gg_status gg_api_run_close(gg_door_run *run, gg_door_point *point, bool some, gg_status status, gg_status written,
                           gg_error *err);
/* What to resume from, or NULL. */
const gg_archive *gg_api_run_resume(const gg_door_run *run);
/* run_trajectory.c: the frames of a run, to the result as they come, or where checkpoints are kept, to the log beside
 * them and to the result at the end. Begun after the run; what a resumed run had before goes first. */
gg_status gg_api_trajectory_begin(gg_door_run *run, gg_hooks *hooks, gg_error *err);
/* All frames so far are safe; a checkpoint says how many they are. */
gg_status gg_api_trajectory_mark(const gg_door_run *run, gg_archive *archive, gg_error *err);
/* How many they are, by an archive. */
uint64_t gg_api_trajectory_frames(const gg_archive *archive);
/* Before the result is written. */
gg_status gg_api_trajectory_finish(gg_door_run *run, gg_result *result, gg_error *err);
void gg_api_trajectory_end(gg_door_run *run);
/* The status of a run whose output was or was not written: the worse of the two, with both messages. */
gg_status gg_api_run_status(gg_status run, gg_status written, const gg_error *why, gg_error *err);

#endif
