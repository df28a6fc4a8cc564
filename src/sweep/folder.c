/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/build.h"
#include "base/memory.h"
#include "files/h5/hdf5_reader.h"
#include "io/output_path.h"

void gg_sweep_point_name(uint64_t id, char name[GG_POINT_NAME])
{
  snprintf(name, GG_POINT_NAME, "%016" PRIx64, id);
}

char *gg_sweep_point_path(const char *folder, uint64_t id, const char *ending, char *path)
{
  if (snprintf(path, PATH_MAX, "%s/%016" PRIx64 "%s", folder, id, ending) >= PATH_MAX) *path = '\0';
  return path;
}

/* True for a regular file that begins like HDF5: results appear whole under their name, and other files of that name
 * (of a full disk, of an editor) do not count. Allocates nothing: for lack of memory finished points would count as
 * missing. */
static bool is_there(const char *folder, uint64_t id, const char *ending)
{
  static const char hdf5[] = "\211HDF\r\n\032\n";
  char name[GG_POINT_NAME + 16], begins[sizeof hdf5 - 1];
  struct stat about;
  snprintf(name, sizeof name, "%016" PRIx64 "%s", id, ending);
  const int where = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int file = where >= 0 ? openat(where, name, O_RDONLY | O_NONBLOCK | O_CLOEXEC) : -1;
  if (where >= 0) close(where);
  if (file < 0) return false;
  bool yes = fstat(file, &about) == 0 && S_ISREG(about.st_mode) &&
             read(file, begins, sizeof begins) == (ssize_t)sizeof begins && memcmp(begins, hdf5, sizeof begins) == 0;
  close(file);
  return yes;
}

gg_point_state gg_sweep_point_status(const char *folder, uint64_t id)
{
  return is_there(folder, id, ".h5")         ? GG_POINT_DONE
         : is_there(folder, id, ".short.h5") ? GG_POINT_SHORT
                                             : GG_POINT_MISSING;
}

static gg_point_file check_file(const char *path, bool any_build)
{
  GG_CLEARED(gg_h5_in_close) gg_h5_in h = {.fd = -1};
  gg_point_file found = GG_POINT_FILE_GOOD;
  const unsigned before = gg_base_memory_failures();
  gg_h5_open(&h, path, false);
  GG_FREED char *build =
      !h.failed && gg_h5_exists(&h, "/graingas/build") ? gg_h5_read_text(&h, "/graingas/build") : NULL;
  if (h.failed)
    found = GG_POINT_FILE_DAMAGED;
  else if (!any_build && (!build || strcmp(build, gg_base_build_identity) != 0))
    found = GG_POINT_FILE_OTHER_BUILD;
  return gg_base_memory_failures() == before ? found : GG_POINT_FILE_GOOD;
}

gg_point_state gg_sweep_point_state(const char *folder, uint64_t id)
{
  char path[PATH_MAX];
  const gg_point_state there = gg_sweep_point_status(folder, id);
  if (there == GG_POINT_MISSING) return there;
  switch (check_file(gg_sweep_point_path(folder, id, there == GG_POINT_SHORT ? ".short.h5" : ".h5", path), false)) {
  case GG_POINT_FILE_OTHER_BUILD: return GG_POINT_OTHER_BUILD;
  case GG_POINT_FILE_DAMAGED: return GG_POINT_DAMAGED;
  default: return there;
  }
}

/* Check the file again under the lock of the point: another process may have replaced it. */
static gg_point_file set_aside(const char *folder, uint64_t id, const char *ending, bool any_build)
{
  gg_file_lock lock;
  char path[PATH_MAX], result[PATH_MAX], aside[PATH_MAX];
  gg_sweep_point_path(folder, id, ending, path);
  gg_sweep_point_path(folder, id, ".h5", result);
  gg_sweep_point_path(folder, id, ".old.h5", aside);
  if (!is_there(folder, id, ending) || check_file(path, any_build) == GG_POINT_FILE_GOOD) return GG_POINT_FILE_GOOD;
  if (gg_io_file_lock_take(&lock, result, result, NULL) != GG_OK) return GG_POINT_FILE_GOOD;
  gg_point_file found = is_there(folder, id, ending) ? check_file(path, any_build) : GG_POINT_FILE_GOOD;
  if (found != GG_POINT_FILE_GOOD && rename(path, aside) != 0) found = GG_POINT_FILE_GOOD;
  gg_io_file_lock_release(&lock);
  return found;
}

gg_point_file gg_sweep_point_set_aside(const char *folder, uint64_t id, bool any_build)
{
  const gg_point_file whole = set_aside(folder, id, ".h5", any_build),
                      shorter = set_aside(folder, id, ".short.h5", any_build);
  return whole > shorter ? whole : shorter;
}

gg_status gg_sweep_folder_prepare(const char *folder, const char *holds, gg_error *err)
{
  struct stat about;
  enum { LONGEST_NAME = 64 }; /* of a file in the folder */
  if (!*folder) return GG_REFUSE(err, "the folder's name is empty: %s", holds);
  if (strlen(folder) + LONGEST_NAME > PATH_MAX) return gg_io_path_write_error(folder, strerror(ENAMETOOLONG), err);
  if (mkdir(folder, 0777) != 0 && errno != EEXIST) return gg_io_path_write_error(folder, strerror(errno), err);
  if (stat(folder, &about) != 0) return gg_io_path_write_error(folder, strerror(errno), err);
  if (!S_ISDIR(about.st_mode)) {
    gg_error why;
    gg_base_fail(&why, GG_BAD_INPUT, "it is no folder; %s", holds);
    return gg_io_path_write_error(folder, why.message, err);
  }
  if (access(folder, W_OK | X_OK) != 0) return gg_io_path_write_error(folder, strerror(errno), err);
  return GG_OK;
}

gg_status gg_sweep_point_claim(const char *folder, uint64_t id, gg_file_lock *lock, gg_error *err)
{
  char path[PATH_MAX];
  *lock = GG_FILE_LOCK_NONE;
  gg_sweep_point_path(folder, id, ".h5", path);
  gg_status status = gg_io_file_lock_take(lock, path, path, err);
  if (status != GG_OK && lock->busy) return GG_OK;
  if (status == GG_OK && gg_sweep_point_status(folder, id) != GG_POINT_MISSING) gg_io_file_lock_release(lock);
  return status;
}

/* The point of a temporary file, "0123456789abcdef.checkpoint.h5"; 0: it is something else, such as the result. */
static uint64_t point_of_temporary(const char *name)
{
  static const char *const endings[] = {".checkpoint.h5", ".checkpoint.h5.1", ".checkpoint.frames",
                                        ".checkpoint.frames.new", ".work.h5"};
  char *end;
  if (strspn(name, "0123456789abcdef") != 16) return 0;
  uint64_t id = strtoull(name, &end, 16);
  size_t length = strlen(end), cut = 0;
  for (int i = 0; i < 2; i++) {
    static const char *const suffixes[] = {GG_TEMPORARY_SUFFIX, GG_LOCK_SUFFIX};
    size_t n = strlen(suffixes[i]);
    if (length > n && strcmp(end + length - n, suffixes[i]) == 0) cut = n;
  }
  for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
    if (strlen(endings[i]) == length - cut && strncmp(end, endings[i], length - cut) == 0) return id;
  return cut && length - cut == 3 && strncmp(end, ".h5", 3) == 0 ? id : 0;
}

/* Remove the temporary files of a point unless a process holds it. */
static void remove_temporary(const char *folder, uint64_t id, const char *name)
{
  gg_file_lock lock;
  char path[PATH_MAX], result[PATH_MAX];
  gg_sweep_point_path(folder, id, ".h5", result);
  if (gg_sweep_point_status(folder, id) == GG_POINT_MISSING) return;
  if (gg_io_file_lock_take(&lock, result, result, NULL) != GG_OK) return;
  if (snprintf(path, PATH_MAX, "%s/%s", folder, name) < PATH_MAX) unlink(path);
  gg_io_file_lock_release(&lock);
}

void gg_sweep_folder_tidy(const char *folder)
{
  DIR *all = opendir(folder);
  if (!all) return;
  for (struct dirent *entry; (entry = readdir(all));) {
    uint64_t id = point_of_temporary(entry->d_name);
    if (id) remove_temporary(folder, id, entry->d_name);
  }
  closedir(all);
}

/* Rename a finished result. Allocates nothing, so that it cannot stay under its working name for lack of memory. */
gg_status gg_sweep_point_publish(const char *folder, uint64_t id, bool fell_short, gg_error *err)
{
  char from[PATH_MAX], to[PATH_MAX];
  gg_sweep_point_path(folder, id, ".work.h5", from);
  gg_sweep_point_path(folder, id, fell_short ? ".short.h5" : ".h5", to);
  if (rename(from, to) == 0) return GG_OK;
  return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: %s; what was written is kept in %s", to,
                      strerror(errno), from);
}
