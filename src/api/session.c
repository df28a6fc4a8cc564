/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sessions: runs that the caller advances in pieces and reads in between. */
#include <math.h>
#include <stdlib.h>

#include "api/api.h"
#include "base/busy.h"
#include "base/clock.h"
#include "base/memory.h"
#include "common/engine.h"
#include "common/extension.h"
#include "run/replicas.h"
#include "scene/fields.h"

struct gg_session {
  gg_busy busy;
  gg_scene scene; /* completed and checked */
  gg_replicas all;
  gg_run_callbacks callbacks;
  double until;  /* wall time of the end of this piece; INFINITY during the start */
  bool over;     /* the run has ended, */
  gg_status end; /* with this status */
  gg_error why;
  gg_progress progress;
};

static bool time_is_up(void *context)
{
  const gg_session *s = context;
  return gg_base_busy_is_freed(&s->busy) || gg_base_clock_wall() >= s->until;
}

static void note_progress(void *context, const gg_progress *progress)
{
  gg_session *s = context;
  s->progress = *progress;
}

static gg_status make(gg_session *s, const gg_scene *scene, gg_error *err)
{
  GG_TRY(gg_api_scene_finish(scene, &s->scene, err));
  if (!gg_scene_is_given(&s->scene, "run.replicas")) s->scene.run.replicas = 1;
  if (s->scene.run.replicas != 1)
    return GG_REFUSE(err, "run.replicas: %lld; a session has 1, gg_run takes more", (long long)s->scene.run.replicas);
  s->callbacks = (gg_run_callbacks){.context = s, .progress = note_progress, .interrupted = time_is_up};
  s->progress = (gg_progress){.engine = gg_common_engine_of(s->scene.engine)->name,
                              .phase = "warm-up",
                              .relative_error = NAN,
                              .time_left = NAN,
                              .limit_in = INFINITY,
                              .replicas = 1};
  s->until = INFINITY;
  return gg_run_replicas_create(&s->all, &s->scene, NULL, 1, &s->callbacks, err);
}

static void destroy(void *session)
{
  gg_session *s = session;
  gg_run_replicas_clear(&s->all);
  gg_common_extension_release(s->scene.extension);
  free(s);
}

gg_status gg_session_new(const gg_scene *scene, gg_session **session, gg_error *err)
{
  GG_NEED(scene, session);
  GG_FREED gg_session *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return GG_FAILED;
  gg_base_busy_init(&s->busy, "session", destroy, s);
  GG_TRY(make(s, scene, err));
  gg_common_extension_hold(s->scene.extension);
  return GG_HAND_OVER(session, s), GG_OK;
}

void gg_session_free(gg_session *s)
{
  if (s) gg_base_busy_free(&s->busy);
}

gg_status gg_session_advance(gg_session *session, double seconds, int *over, gg_error *err)
{
  GG_NEED(session);
  gg_session *s = session;
  if (!(seconds > 0)) return GG_REFUSE(err, "gg_session_advance: cannot advance for %g seconds", seconds);
  GG_USE_ALONE(session);
  if (!s->over) {
    s->until = gg_base_clock_wall() + seconds;
    int stopped = GG_STOP_REQUESTED;
    atomic_compare_exchange_strong(&s->all.stopped, &stopped, GG_NOT_STOPPED);
    s->end = gg_run_replicas_run(&s->all, &s->why);
    s->over = s->end != GG_INTERRUPTED;
    if (s->end == GG_OK) s->end = gg_run_replicas_check_end(&s->all, &s->why);
  }
  if (over) *over = s->over;
  if (!s->over || s->end == GG_OK) return GG_OK;
  if (err) *err = s->why;
  return s->end;
}

gg_status gg_session_get_progress(const gg_session *session, gg_progress *progress, gg_error *err)
{
  GG_NEED_READING(session, progress);
  *progress = session->progress;
  return GG_OK;
}

gg_status gg_session_result(gg_session *session, gg_result **result, gg_error *err)
{
  GG_NEED_ALONE(session, result);
  GG_CLEARED(gg_run_result_freed) gg_result *made = gg_base_array_new(1, sizeof *made, err);
  if (!made) return GG_FAILED;
  if (session->over) gg_run_replicas_level(&session->all);
  GG_TRY(gg_run_replicas_report(&session->all, made, err));
  return GG_HAND_OVER(result, made), GG_OK;
}
