/* Inside of workers.c and dispatcher.c: who is there, what they have, and the post. */
#ifndef GG_WORKERS_POOL_H
#define GG_WORKERS_POOL_H

#include "run/workers/task.h"
#include "run/workers/workers.h"

typedef struct gg_rank {
  bool there, lost; /* it said hello; it is gone */
  int replicas;     /* that belong to it, of all runs */
  int pieces;       /* it has to do */
  bool cut_off;     /* something could not be sent to it, which it will never answer */
  double heard;     /* when; or when it was given the first of its pieces */
} gg_rank;

typedef enum gg_piece_state { GG_IDLE, GG_HERE, GG_SENT, GG_BACK, GG_LOST } gg_piece_state;

typedef struct gg_piece { /* of work, on one replica */
  int owner;              /* rank */
  bool still_there;       /* the owner has the replica as it is here */
  _Atomic int state;      /* gg_piece_state */
  int64_t number;         /* what the answer has to name */
  int sent_to;            /* rank that was asked last */
  gg_job job;             /* of this process */
  void *block;            /* what came back */
  size_t size;
  gg_replica_news news;
  gg_status status;
  gg_error err;
} gg_piece;

struct gg_share {
  gg_workers *workers;
  gg_replicas *all;
  int64_t run;
  gg_piece *piece; /* one a replica */
  bool *told;      /* rank by rank: it has the scene */
  bool adapt;
  uint64_t due;
  bool stopping;       /* all are asked to end where they are */
  pthread_cond_t news; /* a piece is back, or it is this run's turn to look after the post */
  bool waits;
  gg_hooks hooks; /* of the replicas of this process */
  gg_share *next;
};

struct gg_workers {
  gg_messages messages;
  int threads;
  pthread_mutex_t lock; /* for all below, and for the messages */
  gg_gate gate;         /* of this process */
  bool reading;         /* a run's thread looks after the post, for all */
  gg_rank *rank;
  gg_share *shares;
  int64_t runs, pieces; /* numbers given out */
  double looked;        /* when it was last seen who is lost */
};

/* With the lock held. Take in what has arrived (true: something has), and see who is lost. */
bool gg_workers_attend(gg_workers *w);
/* Of those that are there, the one with the fewest replicas. */
int gg_workers_least(const gg_workers *w);
void gg_workers_send(gg_workers *w, int to, void *block, size_t size);
/* dispatcher.c: a rank is lost; what it had of this run is given to others. */
void gg_run_share_lose(gg_share *share, int rank);

#endif
