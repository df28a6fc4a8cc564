/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observables of a replica: those that the scene requests, their bins and their memory. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/observable.h"
#include "measure/wall_modes.h"
#include "run/protocol_times.h"
#include "run/replica.h"
#include "scene/fields.h"

/* Add an observable to the replica; its channels begin at *width, which is increased by their number. */
static gg_status attach_one(gg_replica *r, const gg_observable *o, size_t *width, gg_error *err)
{
  int k = r->n_observables;
  r->self[k] = o->create(&r->model, err);
  if (!r->self[k]) return GG_FAILED;
  r->observable[k] = o;
  r->n_observables++;
  r->offset[k] = *width;
  if (o->rows) *width += o->rows->width(&r->model);
  const gg_observable_curves *c = o->curves;
  if (!c) return GG_OK;
  if (c->parts > r->parts) r->parts = c->parts;
  r->every[k] = c->every_of ? c->every_of(r->self[k]) : c->every;
  GG_TRY(gg_statistics_bins_init(&r->bins[k], c->bins(r->self[k]), err));
  r->bins[k].whole = c->of_transient && c->of_transient(r->self[k]);
  r->of_transient |= r->bins[k].whole;
  return GG_OK;
}

/* A requested observable, and the gas that it is to measure. */
typedef void visit_requested(void *context, const gg_observable *o, const gg_model *gas);

/* A gas that is followed in time is measured after its last change. */
static gg_status each_requested(const gg_scene *scene, const gg_model *model, visit_requested *visit, void *context,
                                gg_error *err)
{
  const gg_engine_kind engine = model->ensemble ? GG_DSMC : GG_MD; /* that of the scene may be another */
  const bool changes = gg_scene_protocol_count(scene, INFINITY) > 0;
  gg_model *end = changes ? gg_base_array_new(1, sizeof *end, err) : NULL;
  if (changes && !end) return GG_FAILED;
  gg_status status = changes ? gg_run_protocol_end_model(scene, engine, end, err) : GG_OK;
  for (int i = 0; gg_measure_observables[i] && status == GG_OK; i++)
    if (scene->measure & gg_measure_observables[i]->flag) visit(context, gg_measure_observables[i], end ? end : model);
  free(end);
  return status;
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
  size_t width = 0;
  bool curves = false, positions = false;
  unsigned flags;
  r->parts = 1;
  const gg_observable *own = gg_measure_user_observables(&r->model);
  if ((own || scene->measure & ~GG_MEASURE_RHEOLOGY) && !(scene->measure & GG_MEASURE_RHEOLOGY))
    return gg_base_fail(err, GG_BAD_INPUT,
                        "measure: add rheology: by it a run knows when the gas is steady and the run is done");
  GG_TRY(gg_run_measured(scene, &r->model, &flags, err));
  for (int i = 0; gg_measure_observables[i]; i++)
    if (flags & gg_measure_observables[i]->flag) GG_TRY(attach_one(r, gg_measure_observables[i], &width, err));
  for (int k = 0; k < r->n_observables; k++) {
    if (r->observable[k]->curves) curves = true;
    if (r->observable[k]->positions && !r->model.homogeneous) positions = true;
  }
  if (own) GG_TRY(attach_one(r, own, &width, err));
  r->wall_modes_at = width;
  width += (size_t)gg_measure_wall_modes(&r->model);
  r->row = gg_base_array_new(width, sizeof *r->row, err);
  if (!r->row) return GG_FAILED;
  const bool framed = r->model.frame != GG_FRAME_IMPOSED;
  if (curves || framed) GG_TRY(gg_measure_snapshot_init(&r->snapshot, &r->model, positions || framed, err));
  if (framed && !(r->framed = gg_base_array_new(1, sizeof *r->framed, err))) return GG_FAILED;
  if (framed) GG_TRY(gg_measure_framed_init(r->framed, &r->model, err));
  if (r->model.walled && !(r->flow = gg_base_array_new(1, sizeof *r->flow, err))) return GG_FAILED;
  if (r->flow) gg_measure_slabs_init(&r->flow->window, &r->model);
  return gg_statistics_series_init(&r->series, width, err);
}

void gg_run_replica_clear_observables(gg_replica *r)
{
  for (int k = 0; k < r->n_observables; k++) {
    r->observable[k]->destroy(r->self[k]);
    gg_statistics_bins_clear(&r->bins[k]);
  }
  gg_measure_snapshot_clear(&r->snapshot);
  if (r->framed) gg_measure_framed_clear(r->framed);
  free(r->framed);
  free(r->flow);
  r->framed = NULL, r->flow = NULL;
}

/* The sums of the flow between walls, of every slab. */
static size_t flow_bytes(const gg_replica *r)
{
  return (size_t)r->flow->window.n * sizeof *r->flow->window.slab;
}

gg_status gg_run_replica_save_observables(const gg_replica *r, gg_archive *a, gg_error *err)
{
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable *o = r->observable[k];
    if (o->curves) GG_TRY(gg_statistics_bins_save(&r->bins[k], o->name, a, err));
    if (!o->memory) continue;
    size_t bytes;
    const void *memory = o->memory(r->self[k], &bytes);
    char name[64];
    snprintf(name, sizeof name, "observable/%s", o->name);
    GG_TRY(gg_base_archive_put(a, name, GG_ITEM_U8, memory, bytes, err));
  }
  if (!r->flow) return GG_OK;
  return gg_base_archive_put(a, "replica/flow", GG_ITEM_U8, r->flow->window.slab, flow_bytes(r), err);
}

gg_status gg_run_replica_restore_observables(gg_replica *r, const gg_archive *a, gg_error *err)
{
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable *o = r->observable[k];
    if (o->curves) GG_TRY(gg_statistics_bins_restore(&r->bins[k], o->name, a, err));
    if (!o->memory) continue;
    size_t bytes;
    void *memory = o->memory(r->self[k], &bytes);
    char name[64];
    snprintf(name, sizeof name, "observable/%s", o->name);
    GG_TRY(gg_base_archive_get(a, name, GG_ITEM_U8, memory, bytes, err));
    if (o->is_memory && !o->is_memory(r->self[k]))
      return gg_base_fail(err, GG_BAD_FILE, "the checkpoint is damaged: what '%s' remembers", o->name);
  }
  if (!r->flow) return GG_OK;
  GG_TRY(gg_base_archive_get(a, "replica/flow", GG_ITEM_U8, r->flow->window.slab, flow_bytes(r), err));
  gg_measure_local_frame_of_flow(&r->flow->frame, &r->model, &r->flow->window);
  return GG_OK;
}
