/* What processes that share the replicas of a run say to each other: a head, the same for all, and perhaps bytes behind
 * it. Both ends are the same program (hello), so that structs go as they are. */
#ifndef GG_MESSAGE_H
#define GG_MESSAGE_H

#include "base/archive.h"
#include "common/scene.h"

typedef enum gg_message_kind {
  /* To rank 0. */
  GG_HELLO, /* I am there; error.message: what I was built from */
  GG_NEWS,  /* how far a piece of work is; also: I still live */
  GG_DONE,  /* a piece of work is over, with what status; behind it the replica's archive, if there is a replica */
  /* To the others. */
  GG_SCENE,  /* a new run; behind it the scene */
  GG_WORK,   /* let a replica take samples until it has `due`; behind it its archive, if it comes from elsewhere */
  GG_STOP,   /* end all pieces of a run where they are */
  GG_FORGET, /* a run is over */
  GG_LEAVE,  /* so is everything */
  GG_MESSAGE_KINDS
} gg_message_kind;

/* Where a replica comes from: made anew, out of the archive behind the message, or who gets it still has it. */
typedef enum gg_origin { GG_ANEW, GG_BY_ARCHIVE, GG_STILL_THERE } gg_origin;

typedef struct gg_replica_news {
  uint64_t samples;
  double collisions_per_grain, cpu;
} gg_replica_news;

typedef struct gg_message {
  int64_t kind, run, replica, piece; /* piece: number of a piece of work; each is told apart from those before */
  int64_t origin, adapt, threads, status;
  double urgency; /* of the work: the relative error of its run */
  uint64_t due;
  gg_replica_news news;
  gg_error error;
} gg_message;

/* Message and bytes behind it in one block of memory, the caller's to free; NULL: out of memory. */
void *gg_run_message_pack(const gg_message *head, const void *bytes, size_t n, size_t *size);
void *gg_run_message_pack_archive(const gg_message *head, const gg_archive *archive, size_t *size);
/* False: it is none. */
bool gg_run_message_read(const void *block, size_t size, gg_message *head);
gg_status gg_run_message_archive(const void *block, size_t size, gg_archive *archive, gg_error *err);
gg_status gg_run_message_scene(const void *block, size_t size, gg_scene *scene, gg_error *err);

/* What this program was built from, as far as the other end has to agree. */
void gg_run_message_build(char *text, size_t size);

#endif
