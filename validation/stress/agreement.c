/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means of both engines, and of Enskog's equation solved without random numbers, beside each other. */
#include <math.h>
#include <stdio.h>

#include "corner.h"

static double departure_of(const gg_comparison *c, const char *engine, const char *quantity)
{
  gg_departure d;
  return gg_comparison_departure(c, engine, quantity, &d, NULL) == GG_OK ? d.z : NAN;
}

void corner_compare_means(const corner *c, finding *md, finding *dsmc)
{
  gg_comparison *both = NULL;
  gg_scene *scene = NULL;
  gg_error err;
  gg_status status = gg_scene_parse(c->scene, c->name, &scene, &err);
  if (status == GG_OK) status = gg_compare(scene, NULL, &both, &err);
  gg_scene_free(scene);
  if (!both) {
    snprintf(md->reason, sizeof md->reason, "comparison: %.900s", err.message);
    snprintf(dsmc->reason, sizeof dsmc->reason, "comparison: %.900s", err.message);
    md->ended = dsmc->ended = true;
    return;
  }
  double z = NAN;
  (void)gg_comparison_agreement(both, c->agrees, &z, NULL, NULL);
  md->z = dsmc->z = c->apart ? NAN : z;
  md->departure = c->apart ? NAN : departure_of(both, "md", c->agrees);
  dsmc->departure = departure_of(both, "dsmc", c->agrees);
  gg_comparison_free(both);
}
