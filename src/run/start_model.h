/* Where a run starts: close to the steady state that theory expects, so that the warm-up is short. Only the start
 * depends on it; the warm-up forgets it. */
#ifndef GG_START_MODEL_H
#define GG_START_MODEL_H

#include "common/model.h"

gg_status gg_run_start_near_steady(gg_model *model, gg_error *err);
/* The model of a run of the scene's engine, `made` or made here (NULL), with the temperature that it starts from. */
gg_status gg_run_start_make(const gg_scene *scene, const gg_model *made, gg_model *model, gg_error *err);

#endif
