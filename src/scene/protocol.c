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

/* The rate after change i; `before` if it changes another key. */
static double rate_after(const gg_scene *s, int i, double before)
{
  gg_scene then = *s;
  if (strcmp(s->protocol[i].key, "shear_rate") != 0) return before;
  return gg_scene_override(&then, "shear_rate", s->protocol[i].value, NULL) == GG_OK ? then.shear.rate : before;
}

double gg_scene_unit_rate(const gg_scene *s)
{
  double most = fabs(s->shear.rate);
  for (int i = 0; s->shear.rate == 0 && i < GG_MAX_CHANGES && *s->protocol[i].key; i++)
    most = fmax(most, fabs(rate_after(s, i, 0)));
  return most;
}

gg_status gg_scene_check_shear_rate(const gg_scene *changed, gg_error *err)
{
  const double most = 1000, unit = gg_scene_clock_rate(changed), rate = changed->shear.rate, size = fabs(rate);
  const bool small = size < unit / most * (1 - 1e-12), any_sign = changed->flow == GG_USF;
  if (*changed->shear.formula) return GG_REFUSE(err, "key 'shear_rate': a formula is for the start");
  if (size <= unit * most * (1 + 1e-12) && (rate == 0 || !small) && (any_sign || rate > 0)) return GG_OK;
  return GG_REFUSE(err, "key 'shear_rate': %g is not allowed on the way from %g; allowed: from %g to %g%s", rate, unit,
                   unit / most, unit * most, any_sign ? ", such a rate below 0, and 0" : "");
}

double gg_scene_strain(const gg_scene *scene, double time)
{
  if (!gg_flow_is_sheared(scene->flow)) return 0;
  const double unit = gg_scene_clock_rate(scene);
  if (gg_scene_shear_steps(scene) > 0) return gg_scene_shear_strain(scene, time / unit);
  double strain = 0, from = 0, rate = scene->shear.rate;
  for (int i = 0; i < GG_MAX_CHANGES && *scene->protocol[i].key; i++) {
    const double at = scene->protocol[i].at * unit;
    if (strcmp(scene->protocol[i].key, "shear_rate") != 0 || at >= time) continue;
    strain += rate / unit * (at - from);
    from = at, rate = rate_after(scene, i, rate);
  }
  return strain + rate / unit * (time - from);
}
