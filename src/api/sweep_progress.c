/* What the caller of a sweep is told while its points are at work. */
#include <math.h>
#include <stdlib.h>

#include "api/sweep_runs.h"
#include "base/clock.h"
#include "sweep/folder.h"

/* Seconds of all points, by what the forecast says of each, and how far they are. */
void gg_api_sweep_report_progress(gg_courses *all)
{
  const gg_sweep_options *o = &all->options;
  gg_sweep_progress p = {.points = all->n + all->done_before,
                         .done = all->done_before,
                         .fell_short = all->short_before,
                         .time_left = NAN,
                         .relative_error = NAN};
  double left = 0, gone = 0;
  if (!o->progress) return;
  pthread_mutex_lock(&all->lock);
  for (size_t k = 0; k < all->n; k++) {
    const gg_sweep_item *item = &all->item[k];
    const double seconds = all->sweep->point[item->i].seconds;
    bool ended = item->state >= GG_ITEM_ENDED, good = item->status == GG_OK || item->fell_short;
    p.done += ended && good;
    p.failed += ended && !good && item->status != GG_INTERRUPTED;
    p.fell_short += ended && item->fell_short;
    p.running += item->state == GG_ITEM_RUNS;
    p.elsewhere += item->state == GG_ITEM_ELSEWHERE;
    if (item->state == GG_ITEM_RUNS) p.relative_error = fmax(p.relative_error, item->relative_error);
    if (!ended && item->state != GG_ITEM_ELSEWHERE) left += seconds * (1 - item->fraction);
    if (ended ? item->here : item->state == GG_ITEM_RUNS) gone += seconds * item->fraction;
  }
  pthread_mutex_unlock(&all->lock);
  double elapsed = gg_base_clock_wall() - all->started;
  if (gone > 0 && elapsed > 1) p.time_left = left * elapsed / gone;
  o->progress(o->context, &p);
}

/* With the lock held, but not while the caller is told. */
static void tell_ended(gg_courses *all, gg_sweep_item *item)
{
  char *file = NULL;
  const gg_sweep_options *o = &all->options;
  item->state = GG_ITEM_TOLD;
  /* What another process did, it tells; but that a point could not even be claimed, nobody else does. */
  bool ours = item->here || item->status != GG_OK;
  if (!ours || !o->ended || item->status == GG_INTERRUPTED) return;
  const char *ending = item->fell_short ? ".short.h5" : ".h5";
  bool some = item->status == GG_OK || item->fell_short;
  if (some) file = gg_sweep_point_path(all->folder, all->sweep->point[item->i].id, ending);
  pthread_mutex_unlock(&all->lock);
  o->ended(o->context, item->i, item->status, file, item->message);
  free(file);
  pthread_mutex_lock(&all->lock);
}

void gg_api_sweep_report_status(gg_courses *all)
{
  const gg_sweep_options *o = &all->options;
  for (; all->warned < all->warnings.n; all->warned++)
    if (o->warn) o->warn(o->context, all->warnings.text[all->warned]);
  for (size_t k = 0; k < all->n; k++)
    if (all->item[k].state == GG_ITEM_ENDED) tell_ended(all, &all->item[k]);
}
