#include "io/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static gg_status cannot(const char *path, int number, gg_error *err)
{
  return gg_fail(err, GG_BAD_FILE, "%s: cannot be written: %s", path, strerror(number));
}

gg_status gg_atomic_open(gg_atomic_file *f, const char *path, gg_error *err)
{
  struct stat about;
  *f = (gg_atomic_file){.fd = -1};
  if (stat(path, &about) == 0 && S_ISDIR(about.st_mode)) return cannot(path, EISDIR, err);
  f->path = strdup(path);
  for (int i = 0; f->path && f->fd < 0 && i < 100; i++) {
    free(f->temporary);
    if (asprintf(&f->temporary, "%s.tmp%ld-%d", path, (long)getpid(), i) < 0) f->temporary = NULL;
    if (!f->temporary) break;
    f->fd = open(f->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (f->fd < 0 && errno != EEXIST) break;
  }
  if (f->fd >= 0) return GG_OK;
  int number = f->temporary ? errno : ENOMEM;
  free(f->path);
  free(f->temporary);
  *f = (gg_atomic_file){.fd = -1};
  return cannot(path, number, err);
}

gg_status gg_atomic_write(gg_atomic_file *f, const void *data, size_t size, gg_error *err)
{
  const char *from = data;
  while (size > 0) {
    ssize_t done = write(f->fd, from, size);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return cannot(f->path, errno, err);
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

gg_status gg_atomic_commit(gg_atomic_file *f, gg_error *err)
{
  bool renamed = fsync(f->fd) == 0 && rename(f->temporary, f->path) == 0;
  if (!renamed) {
    gg_status status = cannot(f->path, errno, err);
    gg_atomic_abandon(f);
    return status;
  }
  sync_folder(f->path);
  free(f->temporary);
  f->temporary = NULL;
  gg_atomic_abandon(f);
  return GG_OK;
}

void gg_atomic_abandon(gg_atomic_file *f)
{
  if (!f->path) return;
  if (f->fd >= 0) close(f->fd);
  if (f->temporary) unlink(f->temporary);
  free(f->temporary);
  free(f->path);
  *f = (gg_atomic_file){.fd = -1};
}

gg_status gg_check_writable(const char *path, gg_error *err)
{
  gg_atomic_file file;
  GG_TRY(gg_atomic_open(&file, path, err));
  gg_atomic_abandon(&file);
  return GG_OK;
}
