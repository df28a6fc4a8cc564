/* What is no number any more. Collisions look at what they leave behind (event_loop.h); here all grains are looked at,
 * once in as many events as there are grains: whatever it came from, no run goes on with it. */
#include <math.h>

#include "md/md_state.h"

static bool is_number(gg_vec a, gg_vec b)
{
  return fabs((a.x + a.y + a.z) + (b.x + b.y + b.z)) < INFINITY;
}

bool gg_md_check_numbers(gg_md *e)
{
  if (e->no_number || e->k.events < e->check_at) return !e->no_number;
  e->check_at = e->k.events + e->n;
  const gg_vec none = {0, 0, 0};
  for (uint32_t i = 0; i < e->n; i++)
    if (!is_number(e->grain[i].r, e->grain[i].v) || !is_number(e->spin ? e->spin[i] : none, none)) e->no_number = true;
  if (e->no_number) e->k.collisions_left = 0;
  return !e->no_number;
}
