/* Do the grains still move? Under gravity a flow may come to rest, or to creep: grains lie on each other, and contacts
 * that last, which hard spheres do not have, are collisions without end. Their share shows it; time hardly gets on. */
#include "run/replicas.h"

/* Flows that get on stay below half, dense chutes too; heaps come to nine tenths and more. */
#define LASTING_SHARE 0.9
/* Tested after so many collisions a grain. */
enum { STRETCH = 2000 };

void gg_run_replicas_check_arrest(gg_replicas *all)
{
  struct gg_replicas_state *s = &all->state;
  uint64_t collisions = 0, treated = 0;
  if (all->model.gravity[1] == 0) return;
  for (int i = 0; i < all->n; i++) {
    gg_engine_state e;
    all->replica[i].engine->ops->state(all->replica[i].engine, &e);
    collisions += e.collisions, treated += e.treated;
  }
  uint64_t stretch = collisions - s->stretch_collisions;
  if ((double)stretch < 0.5 * STRETCH * (double)all->model.n * all->n) return;
  double share = (double)(treated - s->stretch_treated) / (double)stretch;
  s->arrest_share = share > LASTING_SHARE ? share : 0;
  s->stretch_collisions = collisions, s->stretch_treated = treated;
}
