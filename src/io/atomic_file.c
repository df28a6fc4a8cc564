/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "io/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/memory.h"
#include "io/output_path.h"

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
  return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: another process is writing it (%s)", path,
                      *who ? who : "it has just begun");
}

/* True if the path still names the file that was opened: its last owner may have removed it in between. */
static bool still_there(int fd, const char *path)
{
  struct stat mine, there;
  return fstat(fd, &mine) == 0 && stat(path, &there) == 0 && mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

/* True if the file system has no locks: writers then leave other processes' files alone. */
static bool cannot_lock(int number)
{
  return number == ENOLCK || number == ENOSYS || number == EOPNOTSUPP || number == EINVAL;
}

/* Open the lock file. Another user's can only be opened for reading (*foreign), which is enough to lock it. */
static int open_lock(const char *path, bool *foreign)
{
  int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  *foreign = fd < 0 && errno == EACCES;
  if (!*foreign) return fd;
  fd = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0 && errno == ENOENT) errno = EACCES; /* no lock file, and it cannot be created */
  return fd;
}

/* Try once to take the lock. GG_OK with l->fd = -1: the lock file was replaced meanwhile; try again. */
static gg_status try_once(gg_file_lock *l, const char *path, bool *sure, gg_error *err)
{
  bool foreign;
  int fd = open_lock(l->path, &foreign);
  if (fd < 0) return gg_io_path_write_error(path, strerror(errno), err);
  gg_status status = GG_OK;
  *sure = flock(fd, LOCK_EX | LOCK_NB) == 0;
  if (!*sure && !cannot_lock(errno)) {
    l->busy = errno != EINTR;
    if (l->busy) status = in_use(fd, path, err);
  } else if (still_there(fd, l->path) && !(foreign && unlink(l->path) == 0)) {
    l->fd = fd; /* another user's lock of a dead process is replaced if the folder permits it */
    return GG_OK;
  }
  close(fd);
  return status;
}

gg_status gg_io_file_lock_take(gg_file_lock *l, const char *target, const char *path, gg_error *err)
{
  *l = GG_FILE_LOCK_NONE;
  if (asprintf(&l->path, "%s" GG_LOCK_SUFFIX, target) < 0) return gg_io_path_write_error(path, strerror(ENOMEM), err);
  gg_status status = GG_OK;
  bool sure = false;
  while (status == GG_OK && l->fd < 0) status = try_once(l, path, &sure, err);
  if (status == GG_OK) {
    sign(l->fd);
    char *temporary = NULL;
    if (sure && asprintf(&temporary, "%s" GG_TEMPORARY_SUFFIX, target) >= 0) {
      unlink(temporary);
      free(temporary);
    }
    return GG_OK;
  }
  free(l->path);
  *l = (gg_file_lock){.fd = -1, .busy = l->busy};
  return status;
}

void gg_io_file_lock_release(gg_file_lock *l)
{
  if (l->fd >= 0) {
    unlink(l->path); /* while it is still held: nobody else's is removed */
    close(l->fd);
  }
  free(l->path);
  *l = GG_FILE_LOCK_NONE;
}

static gg_status cannot(const gg_atomic_file *f, int number, gg_error *err)
{
  return gg_io_path_write_error(f->path, strerror(number), err);
}

/* Open a device or pipe. Opening a pipe without a reader would block for ever: wait a second for the reader. */
static gg_status open_stream(gg_atomic_file *f, gg_error *err)
{
  const struct timespec moment = {0, 10 * 1000 * 1000};
  for (int i = 0; i < 100; i++) {
    f->fd = open(f->path, O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (f->fd >= 0 || errno != ENXIO) break;
    nanosleep(&moment, NULL);
  }
  if (f->fd < 0 && errno == ENXIO) return gg_io_path_write_error(f->path, "nobody reads from this pipe", err);
  return f->fd >= 0 ? GG_OK : cannot(f, errno, err);
}

/* PATH, whose it is, and how temporary files end. 0, or the number of an error. */
static int create(gg_atomic_file *f, const char *whose)
{
  free(f->temporary);
  if (asprintf(&f->temporary, "%s%s" GG_TEMPORARY_SUFFIX, f->place.target, whose) < 0) {
    f->temporary = NULL;
    return ENOMEM;
  }
  /* A private file stays private while it is rewritten. */
  f->fd = open(f->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, f->place.there ? 0600 : 0666);
  return f->fd >= 0 ? 0 : errno;
}

/* Open the temporary file; a second name is tried where no lock can tell whether the first belongs to a living
 * process. */
static gg_status open_temporary(gg_atomic_file *f, gg_error *err)
{
  int number = create(f, "");
  if (number == EEXIST) {
    char host[65] = "", own[100];
    gethostname(host, sizeof host - 1);
    snprintf(own, sizeof own, ".%s-%ld", host, (long)getpid());
    number = create(f, own);
  }
  return number ? cannot(f, number, err) : GG_OK;
}

static gg_status begin(gg_atomic_file *f, const char *path, bool locked, gg_error *err)
{
  GG_TRY(gg_io_output_path_find(&f->place, path, err));
  f->path = strdup(path);
  if (!f->path) return gg_io_path_write_error(path, strerror(ENOMEM), err);
  if (f->place.stream) return open_stream(f, err);
  if (!locked) GG_TRY(gg_io_file_lock_take(&f->lock, f->place.target, path, err));
  return open_temporary(f, err);
}

gg_status gg_io_atomic_open(gg_atomic_file *f, const char *path, bool locked, gg_error *err)
{
  *f = GG_ATOMIC_NONE;
  gg_status status = begin(f, path, locked, err);
  if (status != GG_OK) gg_io_atomic_abandon(f);
  return status;
}

/* A pipe whose reader has gone is an error, not the end of the program that uses the library. */
static ssize_t write_calmly(int fd, const void *data, size_t size)
{
  sigset_t pipe, before, pending;
  const struct timespec now = {0};
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  bool had = sigpending(&pending) == 0 && sigismember(&pending, SIGPIPE) == 1;
  pthread_sigmask(SIG_BLOCK, &pipe, &before);
  ssize_t done = write(fd, data, size);
  int number = errno;
  if (done < 0 && number == EPIPE && !had) sigtimedwait(&pipe, NULL, &now);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  errno = number;
  return done;
}

/* Wait for the reader of a pipe; after a request to stop, a second at most. */
static bool wait_for_reader(const gg_atomic_file *f)
{
  struct pollfd out = {.fd = f->fd, .events = POLLOUT};
  for (int ready = 0; ready <= 0;) {
    ready = poll(&out, 1, 1000);
    if (ready < 0 && errno != EINTR) return true; /* writing reports why */
    if (ready == 0 && f->stop.asked && gg_stop_asked(&f->stop)) return false;
  }
  return true;
}

gg_status gg_io_atomic_write(gg_atomic_file *f, const void *data, size_t size, gg_error *err)
{
  const char *from = data;
  while (size > 0) {
    if (f->place.stream && !wait_for_reader(f))
      return gg_io_path_write_error(f->path, "its reader stalled, and the run was interrupted", err);
    ssize_t done = f->place.stream ? write_calmly(f->fd, from, size) : write(f->fd, from, size);
    if (done < 0 && (errno == EINTR || (errno == EAGAIN && f->place.stream))) continue;
    if (done < 0) return cannot(f, errno, err);
    from += done, size -= (size_t)done;
  }
  return GG_OK;
}

/* The new name is on the disk only once its folder is. */
static void sync_folder(const char *path)
{
  char *copy = strdup(path);
  int fd = copy ? open(dirname(copy), O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
  if (fd >= 0) {
    fsync(fd);
    close(fd);
  }
  free(copy);
}

static void keep_owner_and_mode(const gg_atomic_file *f)
{
  const struct stat *was = &f->place.about;
  if (!f->place.there) return;
  if (fchown(f->fd, was->st_uid, was->st_gid) != 0) errno = 0; /* only root may give files away */
  if (fchmod(f->fd, was->st_mode & 0777) != 0) errno = 0;
}

static bool put_in_place(gg_atomic_file *f)
{
  keep_owner_and_mode(f);
  if (fsync(f->fd) != 0 || rename(f->temporary, f->place.target) != 0) return false;
  sync_folder(f->place.target);
  free(f->temporary);
  f->temporary = NULL;
  return true;
}

/* Keep the temporary file after a failure, since it may be the only copy of hours of work. It gets a name that the next
 * writer does not remove, if it can be renamed. */
static gg_status keep(gg_atomic_file *f, int number, gg_error *err)
{
  GG_FREED char *name = NULL;
  if (asprintf(&name, "%s" GG_KEPT_SUFFIX, f->place.target) < 0) name = NULL;
  const bool named = name && rename(f->temporary, name) == 0;
  gg_status status = gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: %s; what was written is kept in %s",
                                  f->path, strerror(number), named ? name : f->temporary);
  free(f->temporary);
  f->temporary = NULL;
  return status;
}

gg_status gg_io_atomic_commit(gg_atomic_file *f, gg_status status, gg_error *err)
{
  bool done = status != GG_OK;
  if (!done && f->place.stream) {
    done = close(f->fd) == 0; /* some devices and pipes report failed writes only now */
    f->fd = -1;
  } else if (!done) {
    done = put_in_place(f);
  }
  if (!done) status = f->temporary && !f->repeated ? keep(f, errno, err) : cannot(f, errno, err);
  gg_io_atomic_abandon(f);
  return status;
}

void gg_io_atomic_abandon(gg_atomic_file *f)
{
  if (f->fd >= 0) close(f->fd);
  if (f->temporary && f->fd >= 0) unlink(f->temporary);
  gg_io_file_lock_release(&f->lock);
  gg_io_output_path_clear(&f->place);
  free(f->temporary);
  free(f->path);
  *f = GG_ATOMIC_NONE;
}

gg_status gg_io_atomic_check_writable(const char *path, const char *why_regular, gg_error *err)
{
  gg_atomic_file file;
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  GG_TRY(gg_io_output_path_find(&place, path, err));
  if (place.stream) return gg_base_fail(err, GG_BAD_FILE, "%s: is a device or a pipe; %s", path, why_regular);
  GG_TRY(gg_io_atomic_open(&file, path, false, err));
  gg_io_atomic_abandon(&file);
  return GG_OK;
}
