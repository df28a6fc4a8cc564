/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run: warm-up to the steady state, averaging to the requested error, one result. Engine-blind. */
#ifndef GG_RUN_H
#define GG_RUN_H

#include "run/causes.h"
#include "run/result.h"
#include "theory/theory_list.h"

/* The public header defines these. */
typedef struct gg_comparison gg_comparison;
typedef struct gg_workers gg_workers;
typedef struct gg_progress gg_progress;
typedef struct gg_checkpoint_part gg_checkpoint_part;

typedef struct gg_run_scheduler gg_run_scheduler; /* run/scheduler.h */
struct gg_replica;                                /* run/replica.h */

/* Callbacks of the caller during a run; every member may be NULL. Calls come from threads of the run, never
 * two at once. */
typedef struct gg_run_callbacks {
  void *context;
  void (*progress)(void *context, const gg_progress *progress);
  /* Polled several times a second, from the start on; true ends the run with GG_INTERRUPTED. */
  bool (*interrupted)(void *context);
  gg_status (*frame)(void *context, const gg_frame *frame, gg_error *err); /* every output.trajectory_every */
  /* After each sample of the first replica, where the scene has output.log. */
  gg_status (*sample)(void *context, const struct gg_replica *replica, gg_error *err);
  /* Every output.checkpoint_every seconds, at an interruption, and when a run is over before its time: store it whole,
   * with all frames that came before. Items may be added. */
  gg_status (*checkpoint)(void *context, gg_archive *archive, gg_error *err);
  gg_run_scheduler *scheduler; /* shared with other runs, borrowed; NULL: one of its own */
  gg_workers *workers;         /* other processes that share the replicas, with a scheduler of their own; borrowed */
  const gg_model *model;       /* made by the caller; NULL, or a run that resumes: made here */
} gg_run_callbacks;

/* Run the scene's engine. `resume` (may be NULL) is an archive that a checkpoint stored; `threads` runs replicas side
 * by side, and shares out a large ensemble of engine dsmc where there are more threads than that needs; the result does
 * not depend on it. GG_FAILED with *result set: ended short of what was requested; GG_INTERRUPTED, and GG_BAD_FILE from
 * a callback, with *result set: so far. Stopped while many grains were placed, no *result. The caller frees *result
 * with gg_result_free. */
gg_status gg_run_scene(const gg_scene *scene, const gg_archive *resume, int threads, const gg_run_callbacks *callbacks,
                       gg_result **result, gg_error *err);

/* start_model.c: the model of a run of the scene's engine, `made` or made here (NULL), with the temperature that it
 * starts from. */
gg_status gg_run_start_make(const gg_scene *scene, const gg_model *made, const gg_stop *stop, gg_model *model,
                            gg_error *err);

/* How far a run's archive is; GG_BAD_FILE of any other. */
gg_status gg_run_how_far(const gg_archive *archive, gg_checkpoint_part *part, gg_error *err);

/* Both engines and every theory. */
enum { GG_MOST_THEORIES = GG_N_THEORIES + GG_MOST_OWN_THEORIES };
struct gg_comparison {
  gg_scene *scene;
  gg_model model; /* md's */
  gg_quantity_rows rows;
  gg_result
      *by_engine[GG_N_ENGINES]; /* GG_MD, GG_DSMC; NULL where the engine cannot run the scene, with the reason below */
  char refusal[GG_N_ENGINES][256];
  int n_theories;
  struct {
    const gg_theory *theory;
    bool applies;
    char reason[256]; /* why not */
    gg_theory_answer answer;
    gg_curves curves; /* of what the scene measures; owned */
  } theory[GG_MOST_THEORIES];
  gg_causes causes;        /* why md differs, found when all was there */
  gg_string_list warnings; /* of the scene */
  char *document;          /* JSON as it was stored; NULL of a comparison that was not read from a file */
  bool of_one;             /* that file is one of a run */
  gg_extension *own;       /* names of what that file's program had brought; else NULL */
};

/* The result of the first engine that has one; NULL: none. */
static inline const gg_result *gg_run_comparison_first(const gg_comparison *c)
{
  for (int k = 0; k < GG_N_ENGINES; k++)
    if (c->by_engine[k]) return c->by_engine[k];
  return NULL;
}

/* `resume` (may be NULL): an archive that the checkpoint callback stored; each engine resumes from its part. Also after
 * a failure the comparison holds what there is, and is to be cleared. */
gg_status gg_run_compare_scene(const gg_scene *scene, const gg_archive *resume, int threads,
                               const gg_run_callbacks *callbacks, gg_comparison *comparison, gg_error *err);
void gg_run_comparison_clear(gg_comparison *comparison);

/* Evaluate the theories for the comparison's scene: fills only model and theory[], which borrow from it, and warns of
 * curves that cannot be had. `wanted`: those to evaluate, by the index of gg_theory_of; NULL: all. */
gg_status gg_run_compare_theories(const gg_model *model, const bool *wanted, gg_comparison *comparison, gg_error *err);

#endif
