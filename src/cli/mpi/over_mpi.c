/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages are sent in parts whose size fits into an int; the tag says whether more parts follow. Only gg_mpi_end
 * blocks. */
#include <errno.h>
#include <mpi.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/mpi/mpi.h"

enum { LAST_PART, MORE_FOLLOWS };
#ifndef GG_LARGEST_PART /* bytes; smaller in a test */
#define GG_LARGEST_PART ((size_t)1 << 30)
#endif
enum { LONGEST_WAIT = 5 }; /* seconds that the end blocks for processes that no longer answer */

typedef struct sending {
  MPI_Request request;
  int to;
  bool more;   /* further parts of the message follow */
  void *block; /* the message, freed after its last part; NULL in other parts */
  struct sending *next;
} sending;

typedef struct incoming { /* the received parts of a message */
  char *block;
  size_t size;
} incoming;

typedef struct process {
  char machine[120]; /* host name and namespace of process ids */
  long pid;
} process;

typedef struct post {
  int rank, size;
  sending *first;
  incoming *from;
  process *process;
  bool *lost;
} post;

/* Whether an earlier part to the same process is still being sent. */
static bool is_behind(const post *p, const sending *s)
{
  const sending *before = p->first;
  while (before != s && !(before->more && before->to == s->to)) before = before->next;
  return before != s;
}

/* Remove delivered parts and free their blocks. The last part of a message is removed only after all parts before: MPI
 * completes a short last part at once, while it may still read earlier parts of the block. */
static void push(post *p)
{
  for (sending **at = &p->first; *at;) {
    int done = 0;
    sending *s = *at;
    if (!is_behind(p, s) && (MPI_Test(&s->request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS || done)) {
      *at = s->next;
      free(s->block);
      free(s);
    } else {
      at = &s->next;
    }
  }
}

/* Send one part; MPI keeps the order of parts. */
static int send_part(post *p, int to, const char *part, size_t size, int tag, void *block)
{
  sending *s = calloc(1, sizeof *s), **at = &p->first;
  if (!s) return 1;
  s->to = to, s->more = tag == MORE_FOLLOWS, s->block = block;
  if (MPI_Isend(part, (int)size, MPI_BYTE, to, tag, MPI_COMM_WORLD, &s->request) != MPI_SUCCESS) {
    free(s);
    return 1;
  }
  while (*at) at = &(*at)->next;
  *at = s;
  return 0;
}

/* Send a message. If it fails midway, MPI may still read the parts already sent, so the block is not freed. */
static int send(void *context, int to, void *block, size_t size)
{
  const char *part = block;
  for (; size > GG_LARGEST_PART; size -= GG_LARGEST_PART, part += GG_LARGEST_PART)
    if (send_part(context, to, part, GG_LARGEST_PART, MORE_FOLLOWS, NULL) != 0) break;
  if (size <= GG_LARGEST_PART && send_part(context, to, part, size, LAST_PART, block) == 0) return 0;
  if (part == block) free(block);
  return 1;
}

/* Whether a process is lost. This is known only for processes on the same machine. */
static int is_lost(void *context, int rank)
{
  post *p = context;
  const process *me = &p->process[p->rank], *other = &p->process[rank];
  if (strcmp(me->machine, other->machine) == 0 && kill((pid_t)other->pid, 0) != 0 && errno == ESRCH)
    p->lost[rank] = true;
  return p->lost[rank];
}

/* Receive an announced part. 1: its sender was lost first; then the rest never comes, and MPI keeps the block, which it
 * may still write. MPI_Recv would wait for ever. */
static int receive_part(post *p, const MPI_Status *status)
{
  incoming *in = &p->from[status->MPI_SOURCE];
  MPI_Request request;
  int count, done = 0;
  MPI_Get_count(status, MPI_BYTE, &count);
  char *block = realloc(in->block, in->size + (size_t)count + 1);
  if (!block) return -1;
  in->block = block;
  if (MPI_Irecv(block + in->size, count, MPI_BYTE, status->MPI_SOURCE, status->MPI_TAG, MPI_COMM_WORLD, &request) !=
      MPI_SUCCESS)
    return -1;
  for (bool lost = false; !done;) {
    if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) return -1;
    if (!done && lost) {
      *in = (incoming){0};
      return 1;
    }
    lost = is_lost(p, status->MPI_SOURCE);
  }
  in->size += (size_t)count;
  return 0;
}

static int receive(void *context, int *from, void **block, size_t *size)
{
  post *p = context;
  push(p);
  for (;;) {
    int there = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS) return -1;
    if (!there) return 0;
    incoming *in = &p->from[status.MPI_SOURCE];
    const int result = receive_part(p, &status);
    if (result < 0) return -1;
    if (result > 0 || status.MPI_TAG == MORE_FOLLOWS) continue;
    *from = status.MPI_SOURCE;
    *block = in->block, *size = in->size;
    *in = (incoming){0};
    return 1;
  }
}

static void warn(void *context, const char *message)
{
  (void)context;
  fprintf(stderr, "warning: %s\n", message);
}

static process myself(void)
{
  process me = {.pid = getpid()};
  char host[60] = "", numbers[50] = "";
  gethostname(host, sizeof host - 1);
  if (readlink("/proc/self/ns/pid", numbers, sizeof numbers - 1) < 0) numbers[0] = 0;
  snprintf(me.machine, sizeof me.machine, "%s %s", host, numbers);
  return me;
}

static void clear(post *p)
{
  if (!p) return;
  for (int i = 0; p->from && i < p->size; i++) free(p->from[i].block);
  free(p->from), free(p->process), free(p->lost), free(p);
}

static post *open_post(void)
{
  post *p = calloc(1, sizeof *p);
  if (!p) return NULL;
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &p->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &p->size);
  size_t n = (size_t)p->size;
  p->from = calloc(n, sizeof *p->from);
  p->process = calloc(n, sizeof *p->process);
  p->lost = calloc(n, sizeof *p->lost);
  process me = myself();
  if (p->from && p->process && p->lost &&
      MPI_Allgather(&me, sizeof me, MPI_BYTE, p->process, sizeof me, MPI_BYTE, MPI_COMM_WORLD) == MPI_SUCCESS)
    return p;
  clear(p);
  return NULL;
}

gg_status gg_mpi_begin(gg_messages *messages, gg_error *err)
{
  int level;
  post *p = NULL;
  if (MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &level) == MPI_SUCCESS && level >= MPI_THREAD_SERIALIZED)
    p = open_post();
  if (!p) {
    err->status = GG_FAILED;
    snprintf(err->message, sizeof err->message, "MPI could not be started, or lets no threads send messages in turn");
    return GG_FAILED;
  }
  *messages = (gg_messages){p->rank, p->size, p, send, receive, is_lost, warn};
  return GG_OK;
}

static volatile int exit_code; /* for the signal handler */

static void leave(int number)
{
  (void)number;
  _exit(exit_code);
}

/* Whether a part is still being sent to a process that is not lost. */
static bool owes(post *p)
{
  for (const sending *s = p->first; s; s = s->next)
    if (!is_lost(p, s->to)) return true;
  return false;
}

/* Block until all parts are delivered, for LONGEST_WAIT seconds at most. */
static void wait_for_arrival(post *p)
{
  struct timespec start, now;
  clock_gettime(CLOCK_MONOTONIC, &start);
  for (now = start; push(p), owes(p) && now.tv_sec - start.tv_sec <= LONGEST_WAIT; usleep(1000))
    clock_gettime(CLOCK_MONOTONIC, &now);
}

/* Give up parts that are not delivered. Their blocks are not freed, since MPI may read them until the process ends. */
static bool give_up(post *p)
{
  bool any = p->first;
  for (sending *s = p->first, *next; s; s = next) {
    next = s->next;
    MPI_Request_free(&s->request);
    free(s);
  }
  p->first = NULL;
  return any;
}

/* MPI_Finalize blocks until all processes call it. A loss on another machine may be unknown: then the alarm ends the
 * process. */
void gg_mpi_end(gg_messages *messages, int code)
{
  post *p = messages->context;
  bool all = true;
  fflush(NULL);
  exit_code = code;
  wait_for_arrival(p);
  for (int i = 0; i < p->size; i++) all &= !is_lost(p, i);
  all &= !give_up(p);
  signal(SIGALRM, leave);
  alarm(LONGEST_WAIT);
  if (all) MPI_Finalize();
  alarm(0);
  clear(p);
}
