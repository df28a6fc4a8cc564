/* What a run tells of itself while it goes on. */
#include <math.h>

#include "base/clock.h"
#include "run/replicas.h"
#include "run/workers/workers.h"

/* Looks at the errors between two tests, for the outlook alone: of windows a quarter as long as is tested at least,
 * each longer by a twentieth than the last, and never more than a hundredth of the time. */
static void look(gg_replicas *all, double window)
{
  gg_convergence c;
  double before = gg_base_clock_wall(), first = (double)(all->plan.least << all->state.restarts) / 4;
  if (!all->state.averaging || window < fmax(first, 1.05 * all->looked_at) || before < all->next_look) return;
  if (gg_run_replicas_convergence(all, &c, NULL) == GG_OK) gg_run_progress_record_errors(&all->outlook, window, &c);
  all->looked_at = window;
  double now = gg_base_clock_wall();
  all->next_look = now + 100 * (now - before);
}

/* Of replica i, also while other processes have it. */
static gg_replica_news news_of(const gg_replicas *all, int i)
{
  const gg_replica *r = &all->replica[i];
  if (all->share && gg_run_share_is_busy(all->share)) return gg_run_share_news(all->share, i);
  return (gg_replica_news){r->clock.samples, gg_run_replica_collisions_per_grain(r), r->clock.cpu};
}

/* That all replicas have, also while other processes are at them. */
static double samples_so_far(const gg_replicas *all)
{
  uint64_t least = all->state.due;
  if (!all->share || !gg_run_share_is_busy(all->share)) return (double)gg_run_replicas_least(all);
  for (int i = 0; i < all->n; i++) {
    uint64_t has = gg_run_share_news(all->share, i).samples;
    least = has < least ? has : least;
  }
  return (double)least;
}

/* When a run of usual noise, 3/sqrt(grains samples), ends: where nothing is known of the errors of this one. */
static double usual_end(const gg_replicas *all)
{
  double noise = 3 / all->plan.relative_error, grains = (double)all->model.n * all->n;
  double window = fmax(1.5 * (double)(all->plan.least << all->state.restarts), 1.15 * noise * noise / grains);
  if (all->plan.most) window = fmin(window, (double)all->plan.most);
  double begins = (double)(all->state.averaging ? all->state.window_at : all->plan.warmup);
  return fmax(begins + window, 1.25 * (double)all->state.goal);
}

/* NaN: not known. What a sample takes where curves are measured is known only after some of the averaging. */
static double time_left(const gg_replicas *all, double due, gg_end end, double limit_in)
{
  double left = (end.at - due) * gg_run_progress_pace(&all->outlook);
  bool alike = all->state.averaging || all->replica[0].n_observables <= 1;
  return isfinite(left) && end.known && alike ? fmin(left, limit_in) : NAN;
}

void gg_run_replicas_report_progress(gg_replicas *all, bool over)
{
  if (!all->hooks || !all->hooks->progress) return;
  double due = samples_so_far(all);
  double window = all->state.averaging ? due - (double)all->state.window_at : 0;
  if (!over && !(all->share && gg_run_share_is_busy(all->share)) && gg_run_replicas_are_level(all)) look(all, window);
  double collisions = 0, cpu = 0, now = gg_base_clock_wall();
  for (int i = 0; i < all->n; i++) {
    gg_replica_news news = news_of(all, i);
    collisions += news.collisions_per_grain * (double)all->model.n / 2;
    cpu += news.cpu;
  }
  gg_run_progress_record_time(&all->outlook, now, due);
  gg_end end = gg_run_progress_end(&all->outlook, &all->plan, &all->state);
  double limit = all->plan.time_limit;
  double used = all->state.wall + now - all->started;
  double done = gg_run_progress_fraction(&all->outlook, due, isfinite(end.at) ? end.at : usual_end(all),
                                         limit > 0 ? used / limit : NAN);
  gg_progress p = {
      .engine = all->replica[0].engine->ops->name,
      .phase = all->state.averaging ? "averaging" : "warm-up",
      .fraction = over ? 1 : done,
      .collisions = (uint64_t)collisions,
      .rate = cpu > 0 ? collisions / cpu : 0,
      .relative_error = window >= (double)all->plan.least ? all->last.relative_error : NAN,
      .time_left = over ? 0 : time_left(all, due, end, limit > 0 ? fmax(limit - used, 0) : INFINITY),
      .replicas = all->n,
  };
  pthread_mutex_lock(&all->lock); /* of those who share the work, some may ask just now whether to stop */
  all->hooks->progress(all->hooks->context, &p);
  pthread_mutex_unlock(&all->lock);
}
