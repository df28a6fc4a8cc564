/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A result with planted numbers, as a run would leave it. */
#ifndef PLANTED_H
#define PLANTED_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run/run.h"
#include "scene/model_of_scene.h"

enum { PLANTED_GRAINS = 40, PLANTED_SAMPLES = 50 };

static inline gg_frame planted_frame(uint64_t step, bool positions)
{
  gg_frame f = {.time = 0.5 * (double)step, .step = step, .n = PLANTED_GRAINS};
  f.position = positions ? calloc(3 * f.n, sizeof(double)) : NULL;
  f.velocity = calloc(3 * f.n, sizeof(double));
  f.spin = calloc(3 * f.n, sizeof(double));
  f.id = calloc(f.n, sizeof(int64_t));
  for (size_t i = 0; i < f.n; i++) {
    f.id[i] = (int64_t)((i * 7 + step) % f.n); /* grains come in any order */
    for (size_t a = 0; a < 3; a++) {
      double x = (double)f.id[i] + 0.1 * (double)a + 1e-3 * (double)step;
      if (positions) f.position[3 * i + a] = x;
      f.velocity[3 * i + a] = -x, f.spin[3 * i + a] = 2 * x;
    }
  }
  return f;
}

static inline gg_result *planted_result(gg_engine_kind engine)
{
  gg_result *r = calloc(1, sizeof *r);
  const gg_scene defaults = gg_scene_defaults();
  r->scene = gg_scene_copy_new(&defaults, NULL);
  r->scene->phi = 0.3, r->scene->particles = PLANTED_GRAINS, r->scene->engine = engine;
  for (int p = 0; p < GG_PAIRS; p++) r->scene->collision.beta[p] = 0;
  gg_scene_model_make(r->scene, engine, &r->model, NULL);
  r->model.n = PLANTED_GRAINS;
  r->engine = engine == GG_MD ? "md" : "dsmc";
  gg_run_result_label(r);
  snprintf(r->steadiness_text, sizeof r->steadiness_text, "no trend");
  for (int q = 0; q < GG_N_QUANTITIES; q++) r->value[q].mean = r->value[q].error = r->value[q].correlation_time = NAN;
  r->value[GG_Q_TEMPERATURE] = (gg_estimate){1.0 / 3, 0.001, 1.7, 400, ""};
  r->value[GG_Q_PRESSURE] = (gg_estimate){0.1 + 0.2, 0.002, 0.7, 400, ""};
  r->value[GG_Q_N2] = (gg_estimate){0.001, 0.002, 0.7, 400, ""};
  strcpy(r->value[GG_Q_KNUDSEN].reason, "there is no box");
  strcpy(r->value[GG_Q_A2].reason, "there is no box");
  gg_history *h = &r->history;
  h->n = PLANTED_SAMPLES, h->window[0] = 3, h->window[1] = PLANTED_SAMPLES;
  h->time = calloc(h->n, sizeof(double));
  for (int k = 0; k < GG_N_HISTORY; k++) {
    h->value[k] = calloc(h->n, sizeof(double));
    for (size_t i = 0; i < h->n; i++) h->value[k][i] = k < 6 ? (double)k + exp(-(double)i / 10) : NAN;
  }
  for (size_t i = 0; i < h->n; i++) h->time[i] = (double)i + 1;
  r->final = planted_frame(100, engine == GG_MD);
  r->averaging = (gg_effort){12000000, 7.9, NAN};
  r->total = (gg_effort){13000000, 8.9, 9.1};
  GG_WARN(r, "planted warning");
  return r;
}

static inline gg_comparison *planted_comparison(void)
{
  gg_comparison *c = calloc(1, sizeof *c);
  c->by_engine[GG_MD] = planted_result(GG_MD);
  c->by_engine[GG_DSMC] = planted_result(GG_DSMC);
  c->by_engine[GG_DSMC]->value[GG_Q_TEMPERATURE].mean -= 0.01;
  c->scene = gg_scene_copy_new(c->by_engine[GG_MD]->scene, NULL);
  assert_int_equal(gg_run_compare_theories(&c->by_engine[GG_MD]->model, NULL, c, NULL), GG_OK);
  return c;
}

static inline void planted_comparison_free(gg_comparison *c)
{
  gg_run_comparison_clear(c);
  free(c);
}

#endif
