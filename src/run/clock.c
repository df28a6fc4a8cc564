#include "run/clock.h"

#include <time.h>

static double read_clock(clockid_t id)
{
  struct timespec t;
  clock_gettime(id, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double gg_wall_now(void)
{
  return read_clock(CLOCK_MONOTONIC);
}

double gg_cpu_now(void)
{
  return read_clock(CLOCK_THREAD_CPUTIME_ID);
}
