/* When an engine shows its collisions: always, or in episodes. A Monte Carlo engine is some thirty times slower while
 * it shows them, so that an episode of one sample in a hundred costs a third of the run. Errors ask for sixteen
 * episodes, whatever the length of a run: they are close together at first, and further and further apart. They depend
 * on the samples of the window alone: a resumed run has them where the uninterrupted one has. */
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
    if (!gg_observable_wants_collisions(r->observable[k], &r->model)) continue;
    any = true;
    if (!r->observable[k]->begin_episode) *some_will_do = false;
  }
  return any;
}

/* Samples since the last episode began: sixteen episodes follow each other at the least distance, as many at twice it,
 * and so on up to the largest. */
static uint64_t since_episode(uint64_t sample)
{
  uint64_t apart = GG_EPISODES_APART_FIRST;
  for (; apart < GG_EPISODES_APART && sample >= GG_EPISODES_ALIKE * apart; apart *= 2)
    sample -= GG_EPISODES_ALIKE * apart;
  return sample % apart;
}

gg_status gg_replica_show_collisions(gg_replica *r, gg_error *err)
{
  bool in_episodes;
  if (!are_asked_for(r, &in_episodes)) return GG_OK;
  const uint64_t at = since_episode(r->clock.window_samples);
  const enum gg_shown wanted = !in_episodes || at < GG_EPISODE ? GG_SHOWN : GG_HIDDEN;
  const bool begins = in_episodes && at == 0 && !r->clock.part; /* and not in an interval that was stopped */
  for (int k = 0; k < r->n_observables && begins; k++)
    if (r->observable[k]->begin_episode) r->observable[k]->begin_episode(r->self[k]);
  if (wanted == r->shown) return GG_OK;
  r->shown = wanted;
  return r->engine->ops->set_callback(r->engine, wanted == GG_SHOWN ? add_collision : NULL, r, err);
}

bool gg_replica_in_episode(const gg_replica *r, int k)
{
  bool in_episodes;
  return r->observable[k]->begin_episode && are_asked_for(r, &in_episodes) && in_episodes &&
         since_episode(r->clock.window_samples) < GG_EPISODE - 1;
}
