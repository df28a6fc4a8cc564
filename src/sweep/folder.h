/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The folder of a sweep: a file a point. */
#ifndef GG_SWEEP_FOLDER_H
#define GG_SWEEP_FOLDER_H

#include "io/atomic_file.h"
#include "sweep/point_state.h" /* made of the public header (src/sweep/meson.build) */
#include "sweep/sweep.h"

void gg_sweep_point_name(uint64_t id, char name[GG_POINT_NAME]);

/* FOLDER/NAME and an ending: ".h5", ".short.h5", ".work.h5" (until it is known which of both), ".checkpoint.h5". In a
 * buffer of PATH_MAX bytes, which it returns; empty where the folder's name is too long. */
char *gg_sweep_point_path(const char *folder, uint64_t id, const char *ending, char *path);
/* State of a point by its files: missing, done or short. */
gg_point_state gg_sweep_point_status(const char *folder, uint64_t id);
/* The same, with the file read: it may be of another build, or damaged. */
gg_point_state gg_sweep_point_state(const char *folder, uint64_t id);

/* Make the folder if it is missing (not its parents), and check that files can be made in it. `holds` ends the message
 * if something else has the name. */
gg_status gg_sweep_folder_prepare(const char *folder, const char *holds, gg_error *err);
/* Name of the copy of the sweep, FOLDER/sweep.yaml, in a buffer of PATH_MAX bytes; false if the name is too long. */
bool gg_sweep_folder_text_path(const char *folder, char *path);
gg_status gg_sweep_folder_note(const gg_sweep *sweep, const char *folder, gg_error *err);
/* Check that the file of the point is whole and of this build (any_build: of any). Otherwise it is renamed to
 * NAME.old.h5, and the point is missing; not if another process holds the point, or for lack of memory. */
typedef enum gg_point_file { GG_POINT_FILE_GOOD, GG_POINT_FILE_OTHER_BUILD, GG_POINT_FILE_DAMAGED } gg_point_file;
gg_point_file gg_sweep_point_set_aside(const char *folder, uint64_t id, bool any_build);
/* Remove the temporary files of a killed process beside points that are done: checkpoints, locks, partial results. */
void gg_sweep_folder_tidy(const char *folder);
/* Lock a point, so that no other process runs it at the same time. GG_OK with lock->fd -1: another process runs it, or
 * it has just been done. */
gg_status gg_sweep_point_claim(const char *folder, uint64_t id, gg_file_lock *lock, gg_error *err);
/* The file of the point is complete: give it its name. */
gg_status gg_sweep_point_publish(const char *folder, uint64_t id, bool fell_short, gg_error *err);

#endif
