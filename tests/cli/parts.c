/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A message in several parts, as one above a gigabyte is, arrives whole although MPI sends its short last part long
 * before the others. cli/mpi starts this under mpirun with two processes; parts have a megabyte here. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/mpi/mpi.h"

enum { N_SIZES = 4, A_WHILE = 200000 /* microseconds */ };
static const size_t sizes[N_SIZES] = {(3 << 20) + 10, 1, 2 << 20, (1 << 20) + 1};

static char at(size_t i)
{
  return (char)(i % 251);
}

static int send_all(gg_messages *m)
{
  int from;
  void *block;
  size_t size;
  for (int k = 0; k < N_SIZES; k++) {
    char *text = malloc(sizes[k]);
    if (!text) return 1;
    for (size_t i = 0; i < sizes[k]; i++) text[i] = at(i);
    if (m->send(m->context, 1, text, sizes[k]) != 0) return 1;
  }
  /* The other rank does not receive yet. Blocks of completed sends are freed by receive(); overwrite freed memory. */
  for (int i = 0; i < 20; i++) {
    usleep(A_WHILE / 40);
    if (m->receive(m->context, &from, &block, &size) != 0) return 1;
    for (int k = 0; k < N_SIZES; k++) {
      char *other = malloc(sizes[k]);
      if (!other) return 1;
      memset(other, 255, sizes[k]);
      free(other);
    }
  }
  return 0;
}

static int receive_all(gg_messages *m)
{
  usleep(A_WHILE);
  for (int k = 0; k < N_SIZES; k++) {
    int from, got;
    void *block;
    size_t size, wrong = 0;
    while ((got = m->receive(m->context, &from, &block, &size)) == 0) usleep(1000);
    if (got < 0 || from != 0 || size != sizes[k]) return 1;
    for (size_t i = 0; i < size; i++) wrong += ((char *)block)[i] != at(i);
    free(block);
    if (wrong) printf("message %d: %zu of %zu bytes are others\n", k, wrong, size);
    if (wrong) return 1;
  }
  return 0;
}

int main(void)
{
  gg_messages m;
  gg_error err;
  if (gg_mpi_begin(&m, &err) != GG_OK) return 1;
  int failed = m.rank == 0 ? send_all(&m) : receive_all(&m);
  gg_mpi_end(&m, failed);
  return failed;
}
