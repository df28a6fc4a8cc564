/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/run.h"

#include "scene/fields.h"
#include "scene/model_of_scene.h"
#include "theory/near_steady.h"

gg_status gg_run_start_make(const gg_scene *scene, const gg_model *made, const gg_stop *stop, gg_model *model,
                            gg_error *err)
{
  if (made)
    *model = *made;
  else
    GG_TRY(gg_scene_model_make(scene, scene->engine, model, err));
  model->stop = stop;
  /* Start near the steady state of the rate that is the unit, if the shear rests, is reversed or changes. */
  const double rate = model->shear_rate;
  if (gg_model_is_sheared(model) && (rate <= 0 || gg_scene_shear_steps(scene) > 0)) model->shear_rate = 1;
  if (scene->start.temperature == GG_AUTO) GG_TRY(gg_theory_start_near_steady(model, err));
  model->shear_rate = rate;
  gg_scene_model_set_ratio(scene, model);
  return GG_OK;
}
