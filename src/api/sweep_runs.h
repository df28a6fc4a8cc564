/* The points of a sweep at work side by side. */
#ifndef GG_DOOR_SWEEP_COURSES_H
#define GG_DOOR_SWEEP_COURSES_H

#include <pthread.h>
#include <stdatomic.h>

#include "api/sweep.h"
#include "base/string_list.h"
#include "run/scheduler.h"

typedef enum gg_item_state {
  GG_ITEM_WAITS,
  GG_ITEM_RUNS,
  GG_ITEM_ELSEWHERE, /* another process was at it when it was last looked at */
  GG_ITEM_ENDED,
  GG_ITEM_TOLD /* ended, and the caller knows */
} gg_item_state;

typedef struct gg_sweep_item {
  size_t i; /* the point */
  gg_item_state state;
  gg_status status;
  bool fell_short, here; /* here: by this process */
  double looked, fraction, relative_error;
  char message[512];
} gg_sweep_item;

typedef struct gg_courses {
  gg_sweep *sweep;
  const char *folder;
  gg_sweep_options options;
  int threads_each; /* of a point, where there is no crew */
  gg_crew *crew;    /* NULL: one point at a time */
  atomic_bool stopped;
  pthread_mutex_t lock; /* for all below */
  pthread_cond_t news;
  size_t n;
  gg_sweep_item *item;
  size_t done_before, short_before; /* points of which there was a file, and of these those that ended short */
  double started;                   /* clock reading */
  size_t at_work;                   /* threads */
  gg_text_list warnings;
  size_t warned; /* of them the caller was told */
} gg_courses;

/* sweep_progress.c: tell the caller where all stands; and, with the lock held, but not while the caller is told, of
 * warnings and of points that have ended. */
void gg_api_sweep_report_progress(gg_courses *courses);
void gg_api_sweep_report_status(gg_courses *courses);

/* Work off all items, `at_once` at a time, and tell the caller meanwhile; GG_OK whatever became of each. */
gg_status gg_api_sweep_runs_advance(gg_courses *courses, size_t at_once, gg_error *err);

#endif
