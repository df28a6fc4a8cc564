/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loaded before the C library (LD_PRELOAD), this makes one call of a program that changes files fail, or kills the
 * program there. Calls are counted from 1: opening for writing, write, pwrite, writev, ftruncate, fsync, fdatasync,
 * rename, mkdir, and close of files opened for writing. Calls inside the C library's streams are not intercepted.
 *
 * FAULT_AT    number of the call (0 or unset: none fails, all are counted)
 * FAULT_WITH  ENOSPC, EIO, EDQUOT: the call fails with this error. short: it writes half and succeeds. kill-before,
 *             kill-after: SIGKILL before or after it. kill-in: SIGKILL after half of the write
 * FAULT_ON    count only calls on files whose path contains this word
 * FAULT_LAST  if set, all later calls fail, too, as on a disk that stays full
 * FAULT_PAGE  a file of one page, mapped by the program that started this one: counts so far, see `page` */
#undef _FILE_OFFSET_BITS /* with it open and open64 would be one name */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

typedef struct page {
  _Atomic uint64_t calls, faults;
  _Atomic uint64_t stored; /* number of files renamed to *.checkpoint.h5 */
  _Atomic uint64_t used;   /* processor time at the last of them, in nanoseconds */
  char what[256];          /* the first call that failed */
} page;

enum { NOTHING, FAILS, SHORT, KILLS_BEFORE, KILLS_IN, KILLS_AFTER };

static struct {
  uint64_t at;
  int does, number;
  bool last;
  const char *on;
  page *page;
} plan;
static page own;
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void map_page(const char *path)
{
  plan.page = &own;
  int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1; /* not counted: plan.at is still 0 */
  void *at = fd >= 0 ? mmap(NULL, sizeof own, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
  if (at != MAP_FAILED) plan.page = at;
}

static void read_plan(void)
{
  static const struct {
    const char *word;
    int does, number;
  } words[] = {
      {"ENOSPC", FAILS, ENOSPC},        {"EIO", FAILS, EIO},      {"EDQUOT", FAILS, EDQUOT},     {"short", SHORT, 0},
      {"kill-before", KILLS_BEFORE, 0}, {"kill-in", KILLS_IN, 0}, {"kill-after", KILLS_AFTER, 0}};
  const char *at = getenv("FAULT_AT"), *with = getenv("FAULT_WITH");
  for (size_t i = 0; with && i < sizeof words / sizeof *words; i++)
    if (strcmp(with, words[i].word) == 0) plan.does = words[i].does, plan.number = words[i].number;
  plan.last = getenv("FAULT_LAST") != NULL;
  plan.on = getenv("FAULT_ON");
  map_page(getenv("FAULT_PAGE"));
  plan.at = at ? strtoull(at, NULL, 10) : 0;
}

/* True while read_plan runs: its calls are not counted. */
static _Thread_local bool inside;

static void make_plan(void)
{
  if (inside) return;
  inside = true;
  pthread_once(&once, read_plan);
  inside = false;
}

static void *real(const char *name)
{
  void *found = dlsym(RTLD_NEXT, name);
  if (!found) _exit(99);
  return found;
}
#define REAL(name) (__extension__(__typeof__(&name)) real(#name))

/* True for terminals, /dev/null and /dev/full (not /dev/shm), and for the counts of scripts/coverage, which are not
 * files of the program. */
static bool is_no_file(const char *path)
{
  const char *end = strrchr(path, '.');
  return (strncmp(path, "/dev/", 5) == 0 && strncmp(path, "/dev/shm/", 9) != 0) || (end && strcmp(end, ".gcda") == 0);
}

static bool path_of(int fd, char path[PATH_MAX])
{
  char link[40];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  ssize_t n = readlink(link, path, PATH_MAX - 1);
  path[n > 0 ? n : 0] = '\0';
  return n > 0 && path[0] == '/' && !is_no_file(path);
}

/* Count the call; returns its fate. */
static int count(const char *call, const char *path)
{
  make_plan();
  if (inside || (plan.on && !strstr(path, plan.on))) return NOTHING;
  uint64_t k = atomic_fetch_add(&plan.page->calls, 1) + 1;
  bool hit = plan.at && (k == plan.at || (plan.last && k > plan.at));
  if (!hit) return NOTHING;
  if (atomic_fetch_add(&plan.page->faults, 1) == 0)
    snprintf(plan.page->what, sizeof plan.page->what, "%s %.230s", call, path);
  if (plan.does == KILLS_BEFORE) kill(getpid(), SIGKILL);
  errno = plan.number;
  return plan.does;
}

static int count_fd(const char *call, int fd)
{
  char path[PATH_MAX];
  return path_of(fd, path) ? count(call, path) : NOTHING;
}

static void after(int does)
{
  if (does == KILLS_AFTER || does == KILLS_IN) kill(getpid(), SIGKILL);
}

static bool for_writing(int flags)
{
  return (flags & O_ACCMODE) != O_RDONLY || flags & O_CREAT;
}

static mode_t mode_of(int flags, va_list list)
{
  return flags & (O_CREAT | (O_TMPFILE & ~O_DIRECTORY)) ? (mode_t)va_arg(list, int) : 0;
}

static int opened(int folder, const char *path, int flags, mode_t mode)
{
  /* Before HDF5 creates a file in memory it tries to open one that does not exist. */
  bool changes = for_writing(flags) && (flags & O_CREAT || access(path, F_OK) == 0);
  int does = changes && !is_no_file(path) && strncmp(path, "/proc/", 6) != 0 ? count("open", path) : NOTHING;
  if (does == FAILS) return -1;
  int fd = REAL(openat)(folder, path, flags, mode);
  after(does);
  return fd;
}

#define OPENS(name)                                                                                                    \
  int name(const char *path, int flags, ...)                                                                           \
  {                                                                                                                    \
    va_list list;                                                                                                      \
    va_start(list, flags);                                                                                             \
    mode_t mode = mode_of(flags, list);                                                                                \
    va_end(list);                                                                                                      \
    return opened(AT_FDCWD, path, flags, mode);                                                                        \
  }
#define OPENS_AT(name)                                                                                                 \
  int name(int folder, const char *path, int flags, ...)                                                               \
  {                                                                                                                    \
    va_list list;                                                                                                      \
    va_start(list, flags);                                                                                             \
    mode_t mode = mode_of(flags, list);                                                                                \
    va_end(list);                                                                                                      \
    return opened(folder, path, flags, mode);                                                                          \
  }
OPENS(open)
OPENS(open64)
OPENS_AT(openat)
OPENS_AT(openat64)

int creat(const char *path, mode_t mode)
{
  return opened(AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, mode);
}

/* Size of a shortened write. It is at least one byte, so that callers who retry make progress. */
static size_t cut(int does, size_t size)
{
  return (does == SHORT || does == KILLS_IN) && size > 1 ? size / 2 : size;
}

ssize_t write(int fd, const void *data, size_t size)
{
  int does = count_fd("write", fd);
  if (does == FAILS) return -1;
  ssize_t done = REAL(write)(fd, data, cut(does, size));
  after(does);
  return done;
}

static ssize_t written_at(int fd, const void *data, size_t size, off_t at)
{
  int does = count_fd("pwrite", fd);
  if (does == FAILS) return -1;
  ssize_t done = REAL(pwrite)(fd, data, cut(does, size), at);
  after(does);
  return done;
}

ssize_t pwrite(int fd, const void *data, size_t size, off_t at)
{
  return written_at(fd, data, size, at);
}

ssize_t pwrite64(int fd, const void *data, size_t size, off_t at)
{
  return written_at(fd, data, size, at);
}

ssize_t writev(int fd, const struct iovec *pieces, int n)
{
  int does = count_fd("writev", fd);
  if (does == FAILS) return -1;
  ssize_t done = REAL(writev)(fd, pieces, (does == SHORT || does == KILLS_IN) && n > 1 ? n / 2 : n);
  after(does);
  return done;
}

static int on_fd(const char *call, int fd, int (*then)(int fd))
{
  int does = count_fd(call, fd);
  if (does == FAILS) return -1;
  int done = then(fd);
  after(does);
  return done;
}

int fsync(int fd)
{
  return on_fd("fsync", fd, REAL(fsync));
}

int fdatasync(int fd)
{
  return on_fd("fdatasync", fd, REAL(fdatasync));
}

/* The file is closed even if the call fails, as the kernel's close does. */
int close(int fd)
{
  int flags = fcntl(fd, F_GETFL), does = flags >= 0 && for_writing(flags) ? count_fd("close", fd) : NOTHING;
  int number = errno, done = REAL(close)(fd);
  after(does);
  if (does != FAILS) return done;
  errno = number;
  return -1;
}

static int truncated(int fd, off_t size)
{
  int does = count_fd("ftruncate", fd);
  if (does == FAILS) return -1;
  int done = REAL(ftruncate)(fd, size);
  after(does);
  return done;
}

int ftruncate(int fd, off_t size)
{
  return truncated(fd, size);
}

int ftruncate64(int fd, off_t size)
{
  return truncated(fd, size);
}

/* Record the processor time at which a checkpoint is in place. */
static void note(const char *to)
{
  static const char ending[] = ".checkpoint.h5";
  struct timespec t;
  size_t length = strlen(to);
  if (length < sizeof ending || strcmp(to + length - sizeof ending + 1, ending) != 0) return;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  atomic_store(&plan.page->used, (uint64_t)t.tv_sec * 1000000000 + (uint64_t)t.tv_nsec);
  atomic_fetch_add(&plan.page->stored, 1);
}

int rename(const char *from, const char *to)
{
  int does = count("rename", to);
  if (does == FAILS) return -1;
  int done = REAL(rename)(from, to);
  if (done == 0) note(to);
  after(does);
  return done;
}

int mkdir(const char *path, mode_t mode)
{
  int does = count("mkdir", path);
  if (does == FAILS) return -1;
  int done = REAL(mkdir)(path, mode);
  after(does);
  return done;
}
