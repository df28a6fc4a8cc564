/* Scenes in files, and the scenes of the public interface. */
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/c_locale.h"
#include "io/scene/draft.h"

enum { MAX_BYTES = 1 << 20 };

/* All of an open file, or what is wrong with it. */
static gg_status read_text(int fd, const char *path, char *text, size_t *length, gg_error *err)
{
  struct stat about;
  if (fstat(fd, &about) == 0 && S_ISDIR(about.st_mode))
    return gg_fail(err, GG_BAD_FILE, "%s: cannot be read: it is a folder", path);
  *length = 0;
  for (ssize_t got = 1; got != 0 && *length <= MAX_BYTES;) {
    got = read(fd, text + *length, MAX_BYTES + 1 - *length);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return gg_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    *length += (size_t)got;
  }
  if (*length >= 8 && memcmp(text, "\x89HDF\r\n\x1a\n", 8) == 0)
    return gg_fail(err, GG_BAD_INPUT, "%s: is an HDF5 file, not a scene (for a result: graingas info, graingas plot)",
                   path);
  if (*length > MAX_BYTES) return gg_fail(err, GG_BAD_INPUT, "%s: is not a scene: larger than 1 MiB", path);
  return GG_OK;
}

gg_status gg_scene_draft_load(gg_scene_draft *draft, const char *path, gg_error *err)
{
  int fd = open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return gg_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
  size_t length = 0;
  char *text = gg_new_array(MAX_BYTES + 1, 1, err);
  gg_status status = text ? read_text(fd, path, text, &length, err) : GG_FAILED;
  close(fd);
  if (status == GG_OK) status = gg_scene_draft_parse(draft, text, length, path, err);
  free(text);
  return status;
}

static gg_status publish(gg_scene_draft *draft, gg_status status, const char *name, gg_scene **scene, gg_error *err)
{
  if (status == GG_OK) status = gg_scene_draft_finish(draft, name, err);
  if (status == GG_OK)
    *scene = &draft->scene;
  else
    free(draft);
  return status;
}

gg_status gg_scene_load(const char *path, gg_scene **scene, gg_error *err)
{
  *scene = NULL;
  gg_scene_draft *draft = gg_new_array(1, sizeof *draft, err);
  if (!draft) return GG_FAILED;
  gg_scene_draft_start(draft);
  locale_t before = gg_c_locale_enter();
  gg_status status = publish(draft, gg_scene_draft_load(draft, path, err), path, scene, err);
  gg_c_locale_leave(before);
  return status;
}

gg_status gg_scene_parse(const char *yaml, const char *name, gg_scene **scene, gg_error *err)
{
  *scene = NULL;
  gg_scene_draft *draft = gg_new_array(1, sizeof *draft, err);
  if (!draft) return GG_FAILED;
  gg_scene_draft_start(draft);
  locale_t before = gg_c_locale_enter();
  gg_status status = publish(draft, gg_scene_draft_parse(draft, yaml, strlen(yaml), name, err), name, scene, err);
  gg_c_locale_leave(before);
  return status;
}

gg_status gg_scene_set(gg_scene *scene, const char *key, const char *value, gg_error *err)
{
  gg_scene_draft *draft = (gg_scene_draft *)scene, changed = *draft;
  locale_t before = gg_c_locale_enter();
  gg_status status = gg_scene_draft_set(&changed, key, value, err);
  if (status == GG_OK) status = gg_scene_draft_finish(&changed, "the scene", err);
  gg_c_locale_leave(before);
  if (status == GG_OK) *draft = changed;
  return status;
}

void gg_scene_free(gg_scene *scene)
{
  if (scene) gg_extension_release(scene->extension);
  free(scene);
}
