/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between processes when one process is killed while messages to it are pending, and one of its own is
 * announced: the others still receive theirs, do not wait for its message, and end at once. cli/mpi starts this under
 * mpirun --enable-recovery; rank 1 is killed. Rank 0 prints the seconds that its end took. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/mpi/mpi.h"

enum { LARGE = 8 << 20 }; /* bytes; MPI does not transfer so many before a matching receive */

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void post(gg_messages *m, int to, size_t size)
{
  char *block = malloc(size);
  if (!block) abort();
  memset(block, to, size);
  if (m->send(m->context, to, block, size) != 0) abort();
}

/* Wait for the next message and check that each byte is this rank's number. Returns the size. */
static size_t await(gg_messages *m)
{
  int from, got;
  void *block;
  size_t size;
  while ((got = m->receive(m->context, &from, &block, &size)) == 0) usleep(1000);
  if (got < 0) abort();
  for (size_t i = 0; i < size; i++)
    if (((char *)block)[i] != m->rank) abort();
  free(block);
  return size;
}

int main(void)
{
  gg_messages m;
  gg_error err;
  int from;
  void *block;
  size_t size;
  if (gg_mpi_begin(&m, &err) != GG_OK) return 1;
  if (m.rank == 1) {
    post(&m, 0, LARGE);
    raise(SIGKILL);
  }
  if (m.rank == 0) {
    for (int to = 1; to < m.size; to++) post(&m, to, LARGE), post(&m, to, 1);
    while (!m.lost(m.context, 1)) usleep(1000);
    for (int k = 0; k < 100; k++)
      if (m.receive(m.context, &from, &block, &size) != 0) return 1;
  } else if (await(&m) != LARGE || await(&m) != 1) {
    return 1;
  }
  double start = now();
  int rank = m.rank;
  gg_mpi_end(&m, 0);
  if (rank == 0) printf("%.2f\n", now() - start);
  return 0;
}
