#include "base/available_memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

/* The number that a file holds, or that stands behind `key` in one of its lines; INFINITY if there is none ("max"). */
static double number_in(const char *path, const char *key)
{
  char line[256];
  double value = INFINITY, found;
  FILE *in = fopen(path, "r");
  if (!in) return INFINITY;
  while (fgets(line, sizeof line, in)) {
    if (strncmp(line, key, strlen(key)) != 0 || sscanf(line + strlen(key), " %lf", &found) != 1) continue;
    value = found;
    break;
  }
  fclose(in);
  return value;
}

/* What is left of a group's limit; its file cache can be had back. */
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
  FILE *in = fopen("/proc/self/cgroup", "r");
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
  if (in) fclose(in);
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
