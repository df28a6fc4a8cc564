/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of theories beside a stored result: a comparison has them in its file; for a run, which evaluates no theory,
 * they follow from its scene. */
#include <string.h>

#include "io/checked_json.h"
#include "files/curve_table.h"
#include "plot/plot.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

/* True if the run had a user-defined law of restitution, which is not in its scene. */
static bool has_law_of_its_own(const json_t *document)
{
  size_t i;
  json_t *line;
  json_array_foreach(json_object_get(document, "warnings"), i,
                     line) if (json_is_string(line) && strstr(json_string_value(line), GG_OWN_LAW)) return true;
  return false;
}

static json_t *from_scene(const char *yaml, gg_engine_kind engine, const gg_stop *stop)
{
  gg_model model;
  gg_scene scene = gg_scene_defaults();
  json_t *all = json_object();
  if (gg_scene_read(&scene, yaml, strlen(yaml), "scene", NULL) != GG_OK) return all;
  if (gg_scene_model_make(&scene, engine, &model, NULL) != GG_OK) return all;
  model.stop = stop;
  for (const gg_theory *const *t = gg_theory_theories; *t; t++) {
    gg_curves curves;
    if (gg_theory_curves(*t, &model, scene.measure, &curves, NULL) != GG_OK) continue;
    if (curves.n) json_object_set_new(all, (*t)->name, gg_files_curves_json(&curves));
    gg_measure_curves_clear(&curves);
  }
  return all;
}

json_t *gg_plot_theory_curves(const gg_stored_result *stored, const gg_stop *stop)
{
  json_t *there = json_object_get(stored->document, GG_THEORY_CURVES);
  if (there) return json_incref(there);
  if (stored->comparison || has_law_of_its_own(stored->document)) return json_object();
  return from_scene(stored->scene, gg_files_stored_first(stored), stop);
}
