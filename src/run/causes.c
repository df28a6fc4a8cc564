/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/causes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "run/default_size.h"
#include "run/z_scores.h"
#include "scene/scene.h"
#include "theory/md_causes.h"

static const char unknown[] = "no known cause";

/* Relative, or as it is. */
static double size_of(const gg_comparison *c, gg_quantity q)
{
  gg_reference reference;
  const gg_estimate *md = &c->by_engine[GG_MD]->value[q];
  if (!gg_run_reference_find(c, gg_run_rows_at(&c->rows, q), &reference)) return NAN;
  const gg_departure d = gg_run_reference_deviation(q, md, &reference.value);
  return isfinite(d.deviation) ? d.deviation : d.difference;
}

/* Add the sentence unless it is in the list. */
static void add(void *list, const char *text)
{
  gg_causes *causes = list;
  for (int i = 0; i < causes->n; i++)
    if (strcmp(causes->text[i], text) == 0) return;
  if (causes->n < GG_MOST_CAUSES) snprintf(causes->text[causes->n++], sizeof *causes->text, "%s", text);
}

static gg_mean mean_of(const gg_result *r, gg_quantity q)
{
  return (gg_mean){.mean = r->value[q].mean, .error = r->value[q].error};
}

bool gg_run_structure(const gg_result *r, char *text, size_t size)
{
  const gg_mean density = mean_of(r, GG_Q_DENSITY_WAVES), momentum = mean_of(r, GG_Q_MOMENTUM_WAVES);
  return gg_theory_structure(&density, &momentum, text, size);
}

static int add_known(const gg_comparison *c, gg_quantity q, gg_causes *causes)
{
  const gg_result *md = c->by_engine[GG_MD];
  const gg_engine_state *s = &md->engine_state;
  const gg_theory_difference d = {.model = &c->model,
                                  .q = q,
                                  .by = size_of(c, q),
                                  .unsteady = md->steadiness == GG_NOT_STEADY ? md->steadiness_text : NULL,
                                  .T = md->value[GG_Q_TEMPERATURE].mean,
                                  .rate = md->value[GG_Q_COLLISION_RATE].mean,
                                  .density_waves = mean_of(md, GG_Q_DENSITY_WAVES),
                                  .momentum_waves = mean_of(md, GG_Q_MOMENTUM_WAVES),
                                  .treated = s->collisions ? (double)s->treated / (double)s->collisions : 0,
                                  .default_size = gg_run_default_size(md->scene),
                                  .usual_size = gg_scene_defaults().particles};
  return gg_theory_md_causes(&d, add, causes);
}

void gg_run_causes_of(const gg_comparison *c, gg_quantity q, gg_causes *causes)
{
  causes->n = 0;
  if (gg_run_results_disagree(c, q) && add_known(c, q, causes) == 0) add(causes, unknown);
}

void gg_run_causes_find(const gg_comparison *c, gg_causes *causes)
{
  char none[sizeof *causes->text - 40] = "";
  causes->n = 0;
  for (int i = 0; i < c->rows.n; i++) {
    const gg_quantity_row *row = &c->rows.row[i];
    if (!gg_run_results_disagree(c, row->quantity) || add_known(c, row->quantity, causes)) continue;
    gg_base_text_append(none, sizeof none, "%s%s", *none ? ", " : "", row->name);
  }
  if (!*none) return;
  char text[sizeof *causes->text];
  snprintf(text, sizeof text, "%s of the difference in %s", unknown, none);
  add(causes, text);
}
