/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "io/output_path.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"

enum {
  MOST_LINKS = 40, /* as many as the system follows */
  MOST_LOOKS = 20  /* that another writer may spoil, one after the other */
};

gg_status gg_io_path_write_error(const char *path, const char *why, gg_error *err)
{
  return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: %s", path, why);
}

static char *folder_of(const char *path)
{
  GG_FREED char *copy = strdup(path);
  return copy ? strdup(dirname(copy)) : NULL;
}

/* One link: from where it stands to where it leads; to be freed. */
static char *follow_one(const char *link)
{
  char to[PATH_MAX], *at = NULL;
  ssize_t length = readlink(link, to, sizeof to - 1);
  if (length < 0) return NULL;
  to[length] = '\0';
  if (to[0] == '/') return strdup(to);
  GG_FREED char *folder = folder_of(link);
  return folder && asprintf(&at, "%s/%s", folder, to) >= 0 ? at : NULL;
}

char *gg_io_path_follow_links(const char *path)
{
  struct stat about;
  errno = 0;
  char *at = strdup(path);
  for (int i = 0; at && lstat(at, &about) == 0 && S_ISLNK(about.st_mode); i++) {
    char *next = i < MOST_LINKS ? follow_one(at) : NULL;
    free(at);
    at = next;
  }
  if (!at && errno == ENOMEM) gg_base_memory_lacked();
  return at;
}

static bool is_one(const struct stat *a, const struct stat *b)
{
  return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

/* True if it is the standard output or error, where a file's content would be mixed with messages; not for devices. */
static bool is_standard(const struct stat *about)
{
  struct stat own;
  for (int fd = STDOUT_FILENO; fd <= STDERR_FILENO; fd++)
    if (fstat(fd, &own) == 0 && is_one(about, &own) && (!S_ISCHR(own.st_mode) || isatty(fd))) return true;
  return false;
}

/* In a folder like /tmp only the owner of a file may replace it. */
static bool is_pinned(const char *target, const struct stat *about)
{
  struct stat folder;
  GG_FREED char *path = folder_of(target);
  return path && stat(path, &folder) == 0 && folder.st_mode & S_ISVTX && geteuid() != 0 && geteuid() != about->st_uid &&
         geteuid() != folder.st_uid;
}

/* Require write permission although the file is replaced, not written to: a user has removed it for a reason. This
 * holds for root, too, who could write anyway. */
static gg_status check_file(const gg_output_path *place, const char *path, gg_error *err)
{
  if (!(place->about.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)))
    return gg_io_path_write_error(path, "it is write-protected", err);
  int fd = open(place->target, O_WRONLY | O_CLOEXEC);
  if (fd < 0) return gg_io_path_write_error(path, strerror(errno), err);
  close(fd);
  if (is_pinned(place->target, &place->about))
    return gg_io_path_write_error(path, "it belongs to another user, and only they may replace it", err);
  return GG_OK;
}

static gg_status check(gg_output_path *place, const char *path, bool named, gg_error *err)
{
  const mode_t mode = place->about.st_mode;
  if (S_ISDIR(mode)) return gg_io_path_write_error(path, strerror(EISDIR), err);
  if (S_ISBLK(mode) || S_ISSOCK(mode)) return gg_io_path_write_error(path, "it is a disk or a socket, not a file", err);
  if (is_standard(&place->about))
    return gg_io_path_write_error(path, "standard output is for tables and messages; choose a file", err);
  place->stream = !S_ISREG(mode);
  place->there = !place->stream;
  if (!place->there) return GG_OK;
  return named ? check_file(place, path, err) : gg_io_path_write_error(path, "it is an open file without a name", err);
}

/* Inspect the path: what is there, and whether it is the end of the links. */
static gg_status look(gg_output_path *place, const char *path, bool *something, bool *named, gg_error *err)
{
  struct stat target;
  *something = stat(path, &place->about) == 0;
  if (!*something && errno != ENOENT) return gg_io_path_write_error(path, strerror(errno), err);
  place->target = gg_io_path_follow_links(path);
  if (!place->target) return gg_io_path_write_error(path, strerror(ENOMEM), err);
  *named = *something &&
           (!S_ISREG(place->about.st_mode) || (stat(place->target, &target) == 0 && is_one(&target, &place->about)));
  return GG_OK;
}

/* Another writer may replace the file between the two calls of stat in look(): then repeat both. */
gg_status gg_io_output_path_find(gg_output_path *place, const char *path, gg_error *err)
{
  *place = (gg_output_path){0};
  if (!*path) return GG_REFUSE(err, "a file to write has an empty name");
  bool something = true, named = false;
  gg_status status = GG_OK;
  for (int i = 0; i < MOST_LOOKS && status == GG_OK && something && !named; i++) {
    gg_io_output_path_clear(place);
    status = look(place, path, &something, &named, err);
  }
  if (status == GG_OK && something) status = check(place, path, named, err);
  if (status != GG_OK) gg_io_output_path_clear(place);
  return status;
}

void gg_io_output_path_clear(gg_output_path *place)
{
  free(place->target);
  *place = (gg_output_path){0};
}

/* True if two paths, neither of which exists, have the same folder and name after links are followed. */
static bool same_name(const char *a, const char *b)
{
  struct stat one, two;
  char *target[2] = {gg_io_path_follow_links(a), gg_io_path_follow_links(b)}, *folder[2] = {NULL, NULL},
       *copy[2] = {NULL, NULL};
  bool same = target[0] && target[1];
  for (int i = 0; same && i < 2; i++) {
    folder[i] = folder_of(target[i]), copy[i] = strdup(target[i]);
    same = folder[i] && copy[i];
    if (!same) gg_base_memory_lacked();
  }
  same = same && stat(folder[0], &one) == 0 && stat(folder[1], &two) == 0 && is_one(&one, &two) &&
         strcmp(basename(copy[0]), basename(copy[1])) == 0;
  for (int i = 0; i < 2; i++) {
    free(target[i]);
    free(folder[i]);
    free(copy[i]);
  }
  return same;
}

bool gg_io_path_is_same_file(const char *a, const char *b)
{
  struct stat one, two;
  if (!a || !b || !*a || !*b) return false;
  bool first = stat(a, &one) == 0, second = stat(b, &two) == 0;
  if (first && second) return is_one(&one, &two) && S_ISREG(one.st_mode);
  return !first && !second && same_name(a, b);
}
