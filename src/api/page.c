/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gg_page_write: a copy of the teaching page (built by `ninja page`) with a scene. */
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "api/api.h"
#include "api/page_places.h"
#include "base/memory.h"
#include "io/atomic_file.h"

/* Placeholder in the page for the scene that it starts with, as JSON; null: the default scene. */
static const char *const marker = "\"@given@\"";

/* Build folder of the running program FOLDER/src/cli/graingas; "" for an installed program and for programs that use
 * the library. (Binaries hold no path of the sources.) */
static void find_build_folder(char folder[PATH_MAX])
{
  char ninja[PATH_MAX + 16];
  const ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
  folder[length > 0 ? length : 0] = '\0';
  for (int up = 0; up < 3 && *folder; up++) *strrchr(folder, '/') = '\0';
  snprintf(ninja, sizeof ninja, "%s/build.ninja", folder);
  if (*folder && access(ninja, F_OK) != 0) *folder = '\0';
}

/* Whether only this user and root can write to the path, so that nobody else can replace the page. */
static bool is_safe(const char *path)
{
  struct stat about;
  return stat(path, &about) == 0 && (about.st_uid == geteuid() || about.st_uid == 0) && !(about.st_mode & 022);
}

/* Path of the page: the installed page, or that of the build folder for a program that runs there. */
static gg_status find_page(char page[PATH_MAX + 16], gg_error *err)
{
  char folder[PATH_MAX];
  find_build_folder(folder);
  snprintf(page, PATH_MAX + 16, "%s%s", folder, *folder ? "/page.html" : GG_PAGE_INSTALLED);
  if (access(page, R_OK) != 0)
    return gg_base_fail(err, GG_BAD_FILE,
                        "there is no page: no %s; in the sources `ninja -C build page` makes it, with emscripten "
                        "(./check --page installs that); or name a page: graingas page --page FILE",
                        page);
  if (!*folder || (is_safe(folder) && is_safe(page))) return GG_OK;
  return gg_base_fail(
      err, GG_BAD_FILE,
      "%s: others can write there, and could put another page in its place; chmod go-w its folder and the file", page);
}

static gg_status read_all(FILE *in, const char *path, char **text, gg_error *err)
{
  struct stat about;
  if (fstat(fileno(in), &about) == 0 && !S_ISREG(about.st_mode))
    return gg_base_fail(err, GG_BAD_FILE, "%s: is no file, but a folder or a device", path);
  size_t room = 0;
  if (getdelim(text, &room, '\0', in) >= 0) return GG_OK;
  return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, feof(in) ? "it is empty" : strerror(errno));
}

static gg_status read_page(const char *given, char **text, gg_error *err)
{
  char found[PATH_MAX + 16];
  if (!given) GG_TRY(find_page(found, err));
  const char *path = given ? given : found;
  GG_CLOSED FILE *in = fopen(path, "rb");
  return in ? read_all(in, path, text, err)
            : gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
}

/* The scene as a JSON string inside a script element: '<' is escaped, so that no text can end the element. */
static gg_status scene_literal(const gg_scene *scene, char **literal, gg_error *err)
{
  GG_FREED char *yaml = NULL;
  GG_TRY(gg_scene_to_yaml(scene, &yaml, err));
  json_auto_t *string = json_string(yaml);
  GG_FREED char *plain = string ? json_dumps(string, JSON_ENCODE_ANY | JSON_ENSURE_ASCII) : NULL;
  *literal = plain ? gg_base_array_new(6 * strlen(plain) + 1, 1, err) : NULL;
  char *to = *literal;
  for (const char *at = plain; to && *at; at++) to += sprintf(to, *at == '<' ? "\\u003c" : "%c", *at);
  return *literal ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status write_parts(const char *path, const char *page, const char *scene, gg_error *err)
{
  const char *at = strstr(page, marker), *rest = at ? at + strlen(marker) : NULL;
  gg_atomic_file file = GG_ATOMIC_NONE;
  if (!at) return gg_base_fail(err, GG_BAD_FILE, "no page of graingas, or one that has a scene already");
  GG_TRY(gg_io_atomic_open(&file, path, false, err));
  gg_status status = gg_io_atomic_write(&file, page, (size_t)(at - page), err);
  if (status == GG_OK) status = gg_io_atomic_write(&file, scene, strlen(scene), err);
  if (status == GG_OK) status = gg_io_atomic_write(&file, rest, strlen(rest), err);
  return gg_io_atomic_commit(&file, status, err);
}

gg_status gg_page_write(const char *page, const gg_scene *scene, const char *path, gg_error *err)
{
  GG_FREED char *text = NULL, *literal = NULL;
  GG_NEED(path);
  if (scene) GG_TRY(gg_scene_check(scene, err));
  GG_TRY(read_page(page, &text, err));
  if (scene) GG_TRY(scene_literal(scene, &literal, err));
  return write_parts(path, text, scene ? literal : "null", err);
}
