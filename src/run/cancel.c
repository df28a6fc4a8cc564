/* When a run is to stop before its end: the caller's hook says so, or time is up. Looked at by all who work for it,
 * engines at their start and in the midst of an interval included. */
#include "base/clock.h"
#include "run/replicas.h"

static bool out_of_time(const gg_replicas *all)
{
  return all->plan.time_limit > 0 && all->state.wall + gg_base_clock_wall() - all->started > all->plan.time_limit;
}

static bool hook_asks(gg_replicas *all)
{
  if (!all->hooks || !all->hooks->interrupted) return false;
  pthread_mutex_lock(&all->lock);
  bool yes = all->hooks->interrupted(all->hooks->context);
  pthread_mutex_unlock(&all->lock);
  return yes;
}

/* Once said, it holds: all replicas stop. */
static bool asked(void *context)
{
  gg_replicas *all = context;
  if (atomic_load(&all->stopped) != GG_GOES_ON) return true;
  if (atomic_load(&all->pausing)) return true;
  int why = hook_asks(all) ? GG_STOP_ASKED : out_of_time(all) ? GG_OUT_OF_TIME : GG_GOES_ON, before = GG_GOES_ON;
  if (why != GG_GOES_ON) atomic_compare_exchange_strong(&all->stopped, &before, why);
  return why != GG_GOES_ON;
}

void gg_run_replicas_watch(gg_replicas *all)
{
  pthread_mutex_init(&all->lock, NULL);
  atomic_init(&all->stopped, GG_GOES_ON);
  atomic_init(&all->pausing, false);
  all->stop = (gg_stop){asked, all};
  all->model.stop = &all->stop;
}

void gg_run_replicas_unwatch(gg_replicas *all)
{
  if (all->model.stop) pthread_mutex_destroy(&all->lock);
  all->model.stop = NULL;
}
