/* When an engine shows its collisions: always, or in bursts. A Monte Carlo engine is some thirty times slower while
 * it shows them, so that an episode of one sample in a hundred costs a third of the run. Errors ask for sixteen
 * bursts, whatever the length of a run: they are close together at first, and further and further apart. They depend
 * on the samples of the window alone: a resumed run has them where the uninterrupted one has. */
#include <math.h>

#include "run/replica.h"

static void add_collision(void *context, const gg_collision_record *collision)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->add_collision) r->observable[k]->add_collision(r->self[k], collision);
}

/* Does anybody ask for collisions; and is there nobody who has to have them all? */
static bool are_asked_for(const gg_replica *r, bool *some_will_do)
{
  bool any = false;
  *some_will_do = r->engine->ops->callback_slows && r->engine->ops->callback_slows(r->engine);
  for (int k = 0; k < r->n_observables; k++) {
    if (!gg_measure_observable_wants_collisions(r->observable[k], &r->model)) continue;
    any = true;
    if (!r->observable[k]->begin_episode) *some_will_do = false;
  }
  return any;
}

/* An episode is 24 collisions of a grain long, and of a grain of any species: what is seen of a flight begins with the
 * episode, and where grains of one kind collide a few times in it, only their short flights are seen whole. Grains that
 * collide yet more seldom than MOST_LONGER allows for have no flights then, instead of short ones. */
enum { EPISODE = 12, EPISODES_ALIKE = 16, APART_FIRST = 32, GROWTH = 32, MOST_LONGER = 32 };
gg_sampling_bursts gg_run_sampling_bursts_of(const gg_model *m)
{
  double slowest = INFINITY;
  for (int i = 0; i < m->n_species; i++) slowest = fmin(slowest, gg_common_model_species_rate(m, i, 1));
  double longer = fmin(ceil(gg_common_model_collision_rate(m, 1) / slowest * (1 - 1e-9)), MOST_LONGER);
  uint64_t length = EPISODE * (uint64_t)fmax(longer, 1), first = 2 * length > APART_FIRST ? 2 * length : APART_FIRST;
  return (gg_sampling_bursts){length, first, GROWTH * first, EPISODES_ALIKE * (GROWTH - 1) * first};
}

/* Samples since the last episode began: sixteen bursts follow each other at the least distance, as many at twice it,
 * and so on up to the largest. */
static uint64_t since_episode(const gg_sampling_bursts *e, uint64_t sample)
{
  uint64_t apart = e->first;
  for (; apart < e->apart && sample >= EPISODES_ALIKE * apart; apart *= 2) sample -= EPISODES_ALIKE * apart;
  return sample % apart;
}

gg_status gg_run_replica_observe_collisions(gg_replica *r, gg_error *err)
{
  bool in_bursts;
  if (!are_asked_for(r, &in_bursts)) return GG_OK;
  const gg_sampling_bursts bursts = gg_run_sampling_bursts_of(&r->model);
  const uint64_t at = since_episode(&bursts, r->clock.window_samples);
  const enum gg_observed wanted = !in_bursts || at < bursts.length ? GG_OBSERVED : GG_NOT_OBSERVED;
  const bool begins = in_bursts && at == 0 && !r->clock.part; /* and not in an interval that was stopped */
  for (int k = 0; k < r->n_observables && begins; k++)
    if (r->observable[k]->begin_episode) r->observable[k]->begin_episode(r->self[k]);
  if (wanted == r->shown) return GG_OK;
  r->shown = wanted;
  return r->engine->ops->set_callback(r->engine, wanted == GG_OBSERVED ? add_collision : NULL, r, err);
}

bool gg_run_replica_in_burst(const gg_replica *r, int k)
{
  bool in_bursts;
  const gg_sampling_bursts bursts = gg_run_sampling_bursts_of(&r->model);
  return r->observable[k]->begin_episode && are_asked_for(r, &in_bursts) && in_bursts &&
         since_episode(&bursts, r->clock.window_samples) < bursts.length - 1;
}
