/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between processes that share the replicas of runs: a head, the same for all, and perhaps bytes after it.
 * Both ends are the same program (GG_MESSAGE_REGISTER), so that structs go as they are. */
#ifndef GG_RUN_WORKERS_MESSAGE_H
#define GG_RUN_WORKERS_MESSAGE_H

#include "base/archive.h"
#include "run/scheduler.h"

typedef enum gg_run_message_kind {
  /* To rank 0. */
  GG_MESSAGE_REGISTER, /* a worker is ready; error.message: what it was built from */
  GG_MESSAGE_STATUS,   /* how far a task is; also: the worker is alive */
  GG_MESSAGE_DONE,     /* a task is over, with its status; then the replica's archive, if there is a replica */
  /* To the others. */
  GG_MESSAGE_SCENE,    /* a new run; then its scene */
  GG_MESSAGE_TASK,     /* a task; then the replica's archive, if it comes from elsewhere */
  GG_MESSAGE_STOP,     /* tasks of a run end where they are */
  GG_MESSAGE_END,      /* of a run */
  GG_MESSAGE_SHUTDOWN, /* of all */
  GG_MESSAGE_KINDS
} gg_run_message_kind;

/* Origin of a replica: it is created, it is in the archive after the message, or the rank still has it. */
typedef enum gg_run_origin { GG_ORIGIN_NEW, GG_ORIGIN_ARCHIVE, GG_ORIGIN_THERE } gg_run_origin;

typedef struct gg_run_message {
  int64_t kind, run, replica, task; /* task: its number, which no other has */
  int64_t origin, adapt, threads, status;
  double priority;
  uint64_t due;
  gg_run_task_status reached;
  gg_error error;
} gg_run_message;

/* Message and bytes after it in one block of memory, the caller's to free; NULL: out of memory. */
void *gg_run_message_pack(const gg_run_message *head, const void *bytes, size_t n, size_t *size);
void *gg_run_message_pack_archive(const gg_run_message *head, const gg_archive *archive, size_t *size);
/* False: the block is no message. */
bool gg_run_message_read(const void *block, size_t size, gg_run_message *head);
gg_status gg_run_message_archive(const void *block, size_t size, gg_archive *archive, gg_error *err);
gg_status gg_run_message_scene(const void *block, size_t size, gg_scene *scene, gg_error *err);

/* Identity of this build; both ends must have the same. */
void gg_run_message_build(char *text, size_t size);

/* A message travels by polling: microseconds of sleep until the next poll, short while messages come. */
int gg_run_message_nap(int last, bool any);

#endif
