/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes on the way: each is one key at one time, and is applied as an override is. */
#include <math.h>
#include <string.h>

#include "scene/scene_reader.h"

int gg_scene_protocol_count(const gg_scene *s, double time)
{
  int n = 0;
  while (n < GG_MAX_CHANGES && *s->protocol[n].key && s->protocol[n].at <= time) n++;
  return n;
}

gg_status gg_scene_protocol_apply(const gg_scene *scene, int n, gg_scene *changed, gg_error *err)
{
  *changed = *scene;
  changed->fixed.clock_rate = gg_scene_clock_rate(scene); /* units are those of the start */
  for (int i = 0; i < n; i++) GG_TRY(gg_scene_override(changed, scene->protocol[i].key, scene->protocol[i].value, err));
  return GG_OK;
}

gg_status gg_scene_check_shear_rate(const gg_scene *changed, gg_error *err)
{
  const double most = 1000, first = gg_scene_clock_rate(changed), rate = changed->shear_rate;
  if (rate <= first * most * (1 + 1e-12) && rate >= first / most * (1 - 1e-12)) return GG_OK;
  return gg_base_fail(err, GG_BAD_INPUT,
                      "key 'shear_rate': %g is not allowed on the way from %g; allowed: from %g to %g", rate, first,
                      first / most, first * most);
}

double gg_scene_strain(const gg_scene *scene, double time)
{
  if (!gg_flow_is_sheared(scene->flow)) return 0;
  const double unit = gg_scene_clock_rate(scene);
  double strain = 0, from = 0, rate = scene->shear_rate;
  for (const gg_change *c = scene->protocol; c < scene->protocol + GG_MAX_CHANGES && *c->key; c++) {
    const double at = c->at * unit;
    gg_scene then = *scene;
    if (strcmp(c->key, "shear_rate") != 0 || at >= time || gg_scene_override(&then, c->key, c->value, NULL) != GG_OK)
      continue;
    strain += rate / unit * (at - from);
    from = at, rate = then.shear_rate;
  }
  return strain + rate / unit * (time - from);
}
