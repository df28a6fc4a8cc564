/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/memory.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>

static _Thread_local unsigned failures;

unsigned gg_base_memory_failures(void)
{
  return failures;
}

void gg_base_memory_lacked(void)
{
  failures++;
}

gg_status gg_base_memory_check(unsigned before, gg_status status, gg_error *err)
{
  return failures != before && status == GG_OK ? gg_base_out_of_memory(err) : status;
}

gg_status gg_base_out_of_memory(gg_error *err)
{
  gg_base_memory_lacked();
  return gg_base_fail(err, GG_FAILED, "out of memory");
}

gg_status gg_base_out_of_memory_for(gg_error *err, const char *format, ...)
{
  gg_error what;
  va_list args;
  va_start(args, format);
  vsnprintf(what.message, sizeof what.message, format, args);
  va_end(args);
  gg_base_memory_lacked();
  return gg_base_fail(err, GG_FAILED, "out of memory for %s", what.message);
}

void *gg_base_array_new(size_t count, size_t size, gg_error *err)
{
  void *block = calloc(count ? count : 1, size);
  if (!block) gg_base_out_of_memory_for(err, "%zu items of %zu bytes", count, size);
  return block;
}

void gg_base_freed(void *place)
{
  void *pointer;
  memcpy(&pointer, place, sizeof pointer);
  free(pointer);
}

void gg_base_closed(FILE **place)
{
  if (*place) fclose(*place);
}

/* Address space alone: malloc may fill what it gives (MALLOC_PERTURB_, which meson sets for tests), and HDF5's writer
 * asks here before each of its hundreds of calls. */
bool gg_base_memory_is_room(void)
{
  const size_t some = 1 << 22;
  void *reserve = mmap(NULL, some, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return reserve != MAP_FAILED && munmap(reserve, some) == 0;
}

/* The number that a file holds, or that stands behind `key` in one of its lines; INFINITY if there is none ("max"). */
static double number_in(const char *path, const char *key)
{
  char line[256];
  double found;
  GG_CLOSED FILE *in = fopen(path, "r");
  while (in && fgets(line, sizeof line, in))
    if (strncmp(line, key, strlen(key)) == 0 && sscanf(line + strlen(key), " %lf", &found) == 1) return found;
  return INFINITY;
}

/* Memory left within a group's limit; its file cache can be reclaimed. */
static double left_in_group(const char *folder, const char *limit, const char *usage, const char *cache)
{
  char path[2][320];
  snprintf(path[0], sizeof path[0], "%.250s/%s", folder, limit);
  snprintf(path[1], sizeof path[1], "%.250s/%s", folder, usage);
  double most = number_in(path[0], ""), used = number_in(path[1], "");
  if (!isfinite(most) || !isfinite(used)) return INFINITY;
  snprintf(path[0], sizeof path[0], "%.250s/memory.stat", folder);
  double kept = number_in(path[0], cache);
  return fmax(most - used + (isfinite(kept) ? kept : 0), 0);
}

/* This process's control groups (version 2: "0::/path") and those above, which may be narrower. */
static double left_in_groups(void)
{
  char line[256];
  double least =
      left_in_group("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_cache");
  GG_CLOSED FILE *in = fopen("/proc/self/cgroup", "r");
  while (in && fgets(line, sizeof line, in)) {
    if (strncmp(line, "0::", 3) != 0) continue;
    line[strcspn(line, "\n")] = 0;
    for (;;) {
      char folder[300];
      snprintf(folder, sizeof folder, "/sys/fs/cgroup%s", line + 3);
      least = fmin(least, left_in_group(folder, "memory.max", "memory.current", "inactive_file"));
      char *last = strrchr(line + 3, '/');
      if (!last || line[3] == 0) break;
      *last = 0;
    }
  }
  return least;
}

static double left_of_limit(int resource, const char *status)
{
  struct rlimit limit;
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return INFINITY;
  double used = 1024 * number_in("/proc/self/status", status);
  return fmax((double)limit.rlim_cur - (isfinite(used) ? used : 0), 0);
}

double gg_base_memory_available(void)
{
#ifdef __EMSCRIPTEN__
  return INFINITY; /* there are no files to ask, and a browser does not tell */
#endif
  double least = 1024 * number_in("/proc/meminfo", "MemAvailable:");
  least = fmin(least, left_in_groups());
  least = fmin(least, left_of_limit(RLIMIT_AS, "VmSize:"));
  return fmin(least, left_of_limit(RLIMIT_DATA, "VmData:"));
}

/* GSL's handler is one for the process, and so is this. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int inside;
static gsl_error_handler_t *previous;

static void note(const char *reason, const char *file, int line, int number)
{
  (void)reason, (void)file, (void)line;
  if (number == GSL_ENOMEM) gg_base_memory_lacked();
}

void gg_base_gsl_enter(void)
{
  pthread_mutex_lock(&lock);
  if (inside++ == 0) previous = gsl_set_error_handler(note);
  pthread_mutex_unlock(&lock);
}

void gg_base_gsl_leave(void)
{
  pthread_mutex_lock(&lock);
  if (--inside == 0) gsl_set_error_handler(previous);
  pthread_mutex_unlock(&lock);
}
