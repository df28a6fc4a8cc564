/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replacement of the half of src/files/h5 that writes: the page in a browser reads results and writes none. Calls that
 * write return an error. */
#include <stdlib.h>
#include <string.h>

#include "files/h5/checkpoint_file.h"
#include "files/h5/result_file.h"

static gg_status refuse(const char *path, gg_error *err)
{
  return gg_base_fail(err, GG_BAD_FILE, "%s: this build of graingas writes no files", path);
}

gg_status gg_files_result_file_open(gg_result_file *f, const char *path, const char *command, gg_error *err)
{
  *f = (gg_result_file){.file = GG_ATOMIC_NONE, .command = command, .in_memory = !path};
  return refuse(path ? path : "the result", err);
}
gg_status gg_files_result_file_frame(gg_result_file *f, const gg_model *model, const gg_frame *frame, gg_error *err)
{
  (void)f, (void)model, (void)frame;
  return refuse("the trajectory", err);
}
gg_status gg_files_result_file_finish_run(gg_result_file *f, const gg_result *result, gg_error *err)
{
  (void)f, (void)result;
  return refuse("the result", err);
}
gg_status gg_files_result_file_finish_comparison(gg_result_file *f, const gg_comparison *comparison, gg_error *err)
{
  (void)f, (void)comparison;
  return refuse("the comparison", err);
}
void gg_files_result_file_abandon(gg_result_file *f)
{
  (void)f;
}

gg_status gg_files_checkpoint_write(const char *path, bool locked, bool keep, const gg_archive *archive,
                                    const gg_scene *scene, gg_error *err)
{
  (void)locked, (void)keep, (void)archive, (void)scene;
  return refuse(path, err);
}
gg_status gg_files_checkpoint_to_bytes(const gg_archive *archive, const gg_scene *scene, void **bytes, size_t *size,
                                       gg_error *err)
{
  (void)archive, (void)scene, (void)bytes, (void)size;
  return refuse("the simulation", err);
}
char *gg_files_checkpoint_before(const char *path)
{
  return strdup(path); /* a name without a file: it is the writing that is refused */
}
gg_status gg_files_checkpoint_remove_before(const char *path, gg_error *err)
{
  return refuse(path, err);
}
bool gg_files_checkpoint_is_of(const char *file, const char *path)
{
  (void)file, (void)path;
  return false;
}
gg_status gg_files_checkpoint_read(const char *path, bool any_build, gg_archive *archive, bool *older, gg_error *err)
{
  (void)any_build, (void)archive, (void)older;
  return refuse(path, err);
}
char *gg_files_checkpoint_scene(const char *path, bool older)
{
  (void)path, (void)older;
  return NULL;
}
