/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep's file, from its text to the scenes of its points. */
#include "sweep/sweep.h"
#include "fuzz.h"
#include "graingas.h"
#include "text.h"

enum { MOST_POINTS = 12 }; /* that are checked here; a sweep may have a hundred thousand */

static void look(const gg_sweep *sweep)
{
  gg_sweep_point about;
  gg_scene *scene = NULL;
  char *json = NULL;
  for (size_t i = 0; i < gg_sweep_points(sweep); i++) {
    gg_sweep_at(sweep, i, &about, NULL);
    for (size_t k = 0; gg_sweep_key(sweep, k); k++) gg_sweep_value(sweep, i, k);
  }
  if (gg_sweep_scene(sweep, 0, &scene, NULL) == GG_OK) gg_scene_free(scene);
  if (gg_sweep_to_json(sweep, NULL, &json, NULL) == GG_OK) free(json);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  gg_sweep *sweep = NULL;
  gg_error err;
  char *text = fuzz_text(data, size);
  if (text && gg_sweep_parse(text, "sweep.yaml", &sweep, &err) == GG_OK) {
    size_t n = gg_sweep_count(sweep);
    if (n <= MOST_POINTS && gg_sweep_check(sweep, &err) == GG_OK) look(sweep);
  }
  gg_sweep_free(sweep);
  free(text);
  return 0;
}
