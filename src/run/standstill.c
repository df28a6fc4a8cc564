/* Do the grains still move? Under gravity a flow may come to rest, or to creep: grains lie on each other, and contacts
 * that last, which hard spheres do not have, are collisions without end. Their share shows it; time hardly gets on. */
#include "run/campaign.h"

/* Flows that get on stay below half, dense chutes too; heaps come to nine tenths and more. */
#define LASTING_SHARE 0.9
/* Looked at after so many collisions a grain. */
enum { STRETCH = 2000 };

void gg_campaign_look_for_standstill(gg_campaign *c)
{
  struct gg_campaign_state *s = &c->state;
  uint64_t collisions = 0, treated = 0;
  if (c->model.gravity[1] == 0) return;
  for (int i = 0; i < c->n; i++) {
    gg_engine_state e;
    c->replicas[i].engine->ops->state(c->replicas[i].engine, &e);
    collisions += e.collisions, treated += e.treated;
  }
  uint64_t stretch = collisions - s->stretch_collisions;
  if ((double)stretch < 0.5 * STRETCH * (double)c->model.n * c->n) return;
  double share = (double)(treated - s->stretch_treated) / (double)stretch;
  s->standstill = share > LASTING_SHARE ? share : 0;
  s->stretch_collisions = collisions, s->stretch_treated = treated;
}
