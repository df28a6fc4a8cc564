/* Scenes in files. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "scene/scene_reader.h"

enum { MAX_BYTES = GG_SCENE_MAX_BYTES + 1 }; /* enough to see that it is too large */

/* All of an open file, or what is wrong with it. */
static gg_status read_text(int fd, const char *path, char *text, size_t *length, gg_error *err)
{
  struct stat about;
  if (fstat(fd, &about) == 0 && S_ISDIR(about.st_mode))
    return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: it is a folder", path);
  *length = 0;
  for (ssize_t got = 1; got != 0 && *length < MAX_BYTES;) {
    got = read(fd, text + *length, MAX_BYTES - *length);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    *length += (size_t)got;
  }
  if (*length >= 8 && memcmp(text, "\x89HDF\r\n\x1a\n", 8) == 0)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "%s: is an HDF5 file, not a scene (for a result: graingas info, graingas plot)", path);
  return GG_OK;
}

gg_status gg_scene_file_text(const char *path, char **out, size_t *length, gg_error *err)
{
  bool standard = strcmp(path, "-") == 0;
  int fd = standard ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
  char *text = gg_base_array_new(MAX_BYTES, 1, err);
  gg_status status = text ? read_text(fd, path, text, length, err) : GG_FAILED;
  close(fd);
  if (status == GG_OK)
    *out = text;
  else
    free(text);
  return status;
}

const char *gg_scene_file_name(const char *path)
{
  return strcmp(path, "-") == 0 ? "standard input" : path;
}

gg_status gg_scene_read_file(gg_scene *scene, const char *path, gg_error *err)
{
  char *text;
  size_t length;
  GG_TRY(gg_scene_file_text(path, &text, &length, err));
  gg_status status = gg_scene_read(scene, text, length, gg_scene_file_name(path), err);
  free(text);
  return status;
}
