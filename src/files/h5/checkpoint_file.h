/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoints in files: an archive, the scene it belongs to, and a checksum. Written whole; the one before is kept
 * beside it as FILE.1, and taken if FILE is missing or damaged. */
#ifndef GG_CHECKPOINT_FILE_H
#define GG_CHECKPOINT_FILE_H

#include "base/archive.h"

typedef struct gg_scene gg_scene;

struct gg_h5_in;

/* How states are laid out in a checkpoint; to be raised with whatever is stored otherwise, so that a file from before
 * is refused by name. 2: the scene's keys one by one; 3: spins under md's Gaussian thermostat as they are outside. */
enum { GG_CHECKPOINT_LAYOUT = 8 };

/* `locked`: the caller holds the lock of this path (io/atomic_file.h). `keep`: the one before is kept. False of the
 * first of a run that does not resume from the one at FILE: that one is not kept as FILE.1, and the FILE.1 that was
 * there is removed, since neither is a fall-back of this run. */
gg_status gg_files_checkpoint_write(const char *path, bool locked, bool keep, const gg_archive *archive,
                                    const gg_scene *scene, gg_error *err);
/* Name of FILE.1 where FILE is a link; to be freed. NULL: nowhere, or out of memory, which is noted. */
char *gg_files_checkpoint_before(const char *path);
/* Remove FILE.1. */
gg_status gg_files_checkpoint_remove_before(const char *path, gg_error *err);

/* True if `file` is FILE or FILE.1 of this path. False if out of memory, which is counted. */
bool gg_files_checkpoint_is_of(const char *file, const char *path);

#define GG_CHECKPOINTS_ARE "checkpoints take each other's place, and are files"

/* Fills an empty archive. *older: FILE.1 had to be taken. GG_BAD_FILE if neither can be read, and where a build of
 * another identity wrote them, unless any_build: of this layout they are readable, and their numbers may be others. */
gg_status gg_files_checkpoint_read(const char *path, bool any_build, gg_archive *archive, bool *older, gg_error *err);

/* A checkpoint as bytes, to be freed, and back: what its file would hold. */
gg_status gg_files_checkpoint_to_bytes(const gg_archive *archive, const gg_scene *scene, void **bytes, size_t *size,
                                       gg_error *err);
gg_status gg_files_checkpoint_from_bytes(const void *bytes, size_t size, gg_archive *archive, gg_error *err);

/* Fails the file, open, where a build of another layout wrote its checkpoint, or (unless any_build) of another
 * identity.
 */
void gg_files_checkpoint_check_version(struct gg_h5_in *h, bool any_build);

/* The scene of a checkpoint that was read, as YAML, to be freed; NULL where it cannot be read. */
char *gg_files_checkpoint_scene(const char *path, bool older);

#endif
