#include "base/file_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/output_path.h"

/* "process 4711 on kepler, since 2026-11-22 08:46:42" */
static void sign(int fd)
{
  char host[65] = "", since[24], text[160];
  struct tm local;
  time_t now = time(NULL);
  gethostname(host, sizeof host - 1);
  strftime(since, sizeof since, "%Y-%m-%d %H:%M:%S", localtime_r(&now, &local));
  int length = snprintf(text, sizeof text, "process %ld on %s, since %s\n", (long)getpid(), host, since);
  /* Only for messages: that it could not be written is no reason to stop. */
  if (ftruncate(fd, 0) != 0 || pwrite(fd, text, (size_t)length, 0) != length) return;
}

static gg_status in_use(int fd, const char *path, gg_error *err)
{
  char who[160] = "";
  ssize_t length = pread(fd, who, sizeof who - 1, 0);
  who[length > 0 ? strcspn(who, "\n") : 0] = '\0';
  return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: another run is writing it (%s)", path,
                      *who ? who : "it has just begun");
}

/* Does what was opened still stand there? Who held it before may have taken it away in between. */
static bool still_there(int fd, const char *path)
{
  struct stat mine, there;
  return fstat(fd, &mine) == 0 && stat(path, &there) == 0 && mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

/* File systems without locks: go on, and let be what may be somebody else's. */
static bool cannot_lock(int number)
{
  return number == ENOLCK || number == ENOSYS || number == EOPNOTSUPP || number == EINVAL;
}

static void clean_up(const char *target)
{
  char *temporary = NULL;
  if (asprintf(&temporary, "%s" GG_TEMPORARY_SUFFIX, target) < 0) return;
  unlink(temporary);
  free(temporary);
}

/* Another user's can be locked, too, if not written. */
static int open_lock(const char *path, bool *foreign)
{
  int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  *foreign = fd < 0 && errno == EACCES;
  if (!*foreign) return fd;
  fd = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0 && errno == ENOENT) errno = EACCES; /* there is none, and none may be made */
  return fd;
}

/* One try: GG_OK with l->fd still -1 means another one. */
static gg_status try_once(gg_file_lock *l, const char *path, bool *sure, gg_error *err)
{
  bool foreign;
  int fd = open_lock(l->path, &foreign);
  if (fd < 0) return gg_base_path_write_error(path, strerror(errno), err);
  gg_status status = GG_OK;
  *sure = flock(fd, LOCK_EX | LOCK_NB) == 0;
  if (!*sure && !cannot_lock(errno)) {
    l->busy = errno != EINTR;
    if (l->busy) status = in_use(fd, path, err);
  } else if (still_there(fd, l->path) && !(foreign && unlink(l->path) == 0)) {
    l->fd = fd; /* but a dead one's of another user gives way to one of one's own, where the folder lets it */
    return GG_OK;
  }
  close(fd);
  return status;
}

gg_status gg_base_file_lock_take(gg_file_lock *l, const char *target, const char *path, gg_error *err)
{
  *l = GG_FILE_LOCK_NONE;
  if (asprintf(&l->path, "%s" GG_LOCK_SUFFIX, target) < 0) return gg_base_path_write_error(path, strerror(ENOMEM), err);
  gg_status status = GG_OK;
  bool sure = false;
  while (status == GG_OK && l->fd < 0) status = try_once(l, path, &sure, err);
  if (status == GG_OK) {
    sign(l->fd);
    if (sure) clean_up(target);
    return GG_OK;
  }
  free(l->path);
  *l = (gg_file_lock){.fd = -1, .busy = l->busy};
  return status;
}

void gg_base_file_lock_release(gg_file_lock *l)
{
  if (l->fd >= 0) {
    unlink(l->path); /* while it is still held: nobody else's is removed */
    close(l->fd);
  }
  free(l->path);
  *l = GG_FILE_LOCK_NONE;
}
