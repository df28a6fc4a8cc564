/* The campaign of one scene: replicas in lockstep through warm-up and averaging, to the end that the scene asks for. */
#ifndef GG_CAMPAIGN_H
#define GG_CAMPAIGN_H

#include "run/replica.h"

typedef struct gg_plan {        /* what is asked, settled before the run; in samples a replica */
  uint64_t warmup, least, most; /* warm-up; shortest window that can be judged; asked length, 0: until the error */
  uint64_t longest;             /* window after which the asked error counts as out of reach */
  double relative_error;        /* 0: not asked */
  double time_limit;            /* seconds, 0: none */
  bool find_steady;             /* extend the warm-up while the window drifts */
} gg_plan;

typedef struct gg_judgement { /* of the present window */
  double relative_error;      /* of the worst headline quantity; NaN: not known */
  gg_quantity worst;
  bool drifting;
  gg_quantity drifter;
  double drift_z, drift_relative;
  double slowest; /* longest correlation time of the watched, in samples */
  bool trusted;   /* every headline error rests on long enough blocks */
} gg_judgement;

typedef struct gg_campaign {
  gg_scene scene;
  gg_model model;
  gg_plan plan;
  int threads, n;
  gg_replica *replicas;
  const gg_hooks *hooks;
  struct gg_campaign_state {                      /* plain data: saved as bytes */
    int64_t averaging;                            /* 0: warm-up */
    uint64_t due;                                 /* samples that every replica is to have taken */
    uint64_t window_at;                           /* samples when the window was opened */
    uint64_t goal;                                /* samples at which the window is judged next */
    uint64_t restarts;                            /* windows given up for drift */
    int64_t exact;                                /* at the last judgement, errors were as small as asked */
    double wall;                                  /* seconds used before this process */
    uint64_t stretch_collisions, stretch_treated; /* of all replicas, where the present stretch began (standstill.c) */
    double standstill; /* share of contacts that last, if there was little else; 0: the grains move */
  } state;
  gg_judgement last;
  double started, last_checkpoint; /* clock readings */
} gg_campaign;

gg_plan gg_plan_of(const gg_scene *scene, const gg_model *model);

gg_status gg_campaign_create(gg_campaign *c, const gg_scene *scene, const gg_archive *resume, int threads,
                             const gg_hooks *hooks, gg_error *err);
gg_status gg_campaign_execute(gg_campaign *c, gg_error *err);
void gg_campaign_clear(gg_campaign *c);

gg_status gg_campaign_save(const gg_campaign *c, gg_archive *archive, gg_error *err);
gg_status gg_campaign_restore(gg_campaign *c, const gg_archive *archive, gg_error *err);

/* standstill.c: under gravity, have the grains come to rest? Tells c->state.standstill. */
void gg_campaign_look_for_standstill(gg_campaign *c);

/* Judge the window; with `final`, against everything watched. */
gg_status gg_campaign_judge(gg_campaign *c, gg_judgement *j, gg_error *err);
/* Mean of one quantity over the window of all replicas; NaN if no observable here has it. */
gg_status gg_campaign_mean(const gg_campaign *c, gg_quantity q, gg_mean *mean, gg_error *err);

/* report_curves.c: the curves of all replicas together, and a warning for each observable that this model cannot have.
 */
gg_status gg_campaign_report_curves(const gg_campaign *c, gg_result *result, gg_error *err);

/* The result of where the campaign stands. */
gg_status gg_campaign_report(gg_campaign *c, gg_result *result, gg_error *err);

#endif
