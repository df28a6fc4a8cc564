/* Checkpoints in files: an archive, the scene it belongs to, and a checksum. Written whole; the one before is kept
 * beside it as FILE.1, and taken if FILE is missing or damaged. */
#ifndef GG_CHECKPOINT_FILE_H
#define GG_CHECKPOINT_FILE_H

#include "common/archive.h"
#include "common/scene.h"

gg_status gg_checkpoint_write(const char *path, const gg_archive *archive, const gg_scene *scene, gg_error *err);
/* Fills an empty archive. *older: FILE.1 had to be taken. GG_BAD_FILE if neither can be read. */
gg_status gg_checkpoint_read(const char *path, gg_archive *archive, bool *older, gg_error *err);
/* "usf.h5" -> "usf.checkpoint.h5"; to be freed. */
char *gg_checkpoint_path(const char *result_path);

#endif
