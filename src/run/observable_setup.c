/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observables of a replica: those that the scene requests and its gas can have. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/observable.h"
#include "run/protocol_times.h"
#include "run/replica.h"
#include "scene/fields.h"

/* A requested observable, and the gas that it is to measure. */
typedef void visit_requested(void *context, const gg_observable *o, const gg_model *gas);

/* A gas that is followed in time is measured after its last change. */
static gg_status each_requested(const gg_scene *scene, const gg_model *model, visit_requested *visit, void *context,
                                gg_error *err)
{
  const gg_engine_kind engine = model->ensemble ? GG_DSMC : GG_MD; /* that of the scene may be another */
  const bool changes = gg_scene_protocol_count(scene, INFINITY) > 0;
  GG_FREED gg_model *end = changes ? gg_base_array_new(1, sizeof *end, err) : NULL;
  if (changes && !end) return GG_FAILED;
  if (changes) GG_TRY(gg_run_protocol_end_model(scene, engine, end, err));
  for (int i = 0; gg_measure_observables[i]; i++)
    if (scene->measure & gg_measure_observables[i]->flag) visit(context, gg_measure_observables[i], end ? end : model);
  return GG_OK;
}

static void add_flag(void *flags, const gg_observable *o, const gg_model *gas)
{
  if (gg_measure_observable_applies(o, gas)) *(unsigned *)flags |= o->flag;
}

gg_status gg_run_measured(const gg_scene *scene, const gg_model *model, unsigned *flags, gg_error *err)
{
  *flags = 0;
  return each_requested(scene, model, add_flag, flags, err);
}

typedef struct reasons {
  void (*line)(void *context, const char *text);
  void *context;
} reasons;

static void report_reason(void *context, const gg_observable *o, const gg_model *gas)
{
  const reasons *to = context;
  char text[200];
  if (gg_measure_observable_applies(o, gas)) return;
  snprintf(text, sizeof text, "%s is not measured: %s", o->name, o->refuses(gas));
  to->line(to->context, text);
}

gg_status gg_run_unmeasured(const gg_scene *scene, const gg_model *model, void (*line)(void *context, const char *text),
                            void *context, gg_error *err)
{
  return each_requested(scene, model, report_reason, &(reasons){line, context}, err);
}

gg_status gg_run_replica_setup_observables(gg_replica *r, const gg_scene *scene, gg_error *err)
{
  unsigned flags;
  if ((gg_measure_user_observables(&r->model) || scene->measure & ~GG_MEASURE_RHEOLOGY) &&
      !(scene->measure & GG_MEASURE_RHEOLOGY))
    return GG_REFUSE(err, "measure: add rheology: by it a run knows when the gas is steady and the run is done");
  GG_TRY(gg_run_measured(scene, &r->model, &flags, err));
  GG_TRY(gg_measure_sampler_init(&r->sampler, &r->model, flags, err));
  return gg_statistics_series_init(&r->series, r->sampler.width, err);
}
