/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/md_allocate.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "md/aligned_memory.h"
#include "md/parallel/parallel.h"
#include "md/select_search.h"
#include "simd/dispatch.h"

gg_status gg_md_allocate_last(gg_md *e, gg_error *err)
{
  e->last = gg_base_array_new(e->n, sizeof *e->last, err);
  if (!e->last) return GG_FAILED;
  for (uint32_t i = 0; i < e->n; i++) e->last[i] = -INFINITY;
  return GG_OK;
}

static gg_status allocate(gg_md *e, gg_error *err)
{
  const gg_model *m = &e->model;
  e->n = (uint32_t)m->n;
  e->grain = gg_md_new_lines((size_t)e->n + 1, sizeof *e->grain, err);
  e->node = gg_md_new_lines(e->n, sizeof *e->node, err);
  e->id = gg_base_array_new(e->n, sizeof *e->id, err);
  e->candidates = gg_md_new_pages(2 * GG_MD_CANDIDATES_APART, sizeof *e->candidates, err);
  if (!e->grain || !e->node || !e->id || !e->candidates) return GG_FAILED;
  e->grain[e->n].r = (gg_vec){NAN, NAN, NAN};
  if (m->rule != GG_SMOOTH && !(e->spin = gg_base_array_new(e->n, sizeof *e->spin, err))) return GG_FAILED;
  GG_TRY(gg_common_coefficient_tables_new(m, &e->tables, err));
  if (m->contact_time > 0) GG_TRY(gg_md_allocate_last(e, err));
  return gg_md_queue_make(&e->queue, e->n, err);
}

gg_status gg_md_allocate_lists(gg_md *e, gg_error *err)
{
  e->search.kind = GG_MD_NEIGHBOUR_LISTS;
  e->search.lists.skin = gg_md_new_lines((size_t)e->n + 1, sizeof *e->search.lists.skin, err);
  e->search.lists.neighbour = gg_md_new_lines(e->n, GG_MD_LIST * sizeof *e->search.lists.neighbour, err);
  if (!e->search.lists.skin || !e->search.lists.neighbour) return GG_FAILED;
  e->search.lists.skin[e->n].centre = (gg_vec){NAN, NAN, NAN};
  return GG_OK;
}

gg_status gg_md_allocate(const gg_model *model, gg_md **engine, gg_error *err)
{
  GG_TRY(gg_simd_instructions_check(err));
  gg_md *e = gg_base_array_new(1, sizeof *e, err);
  if (!e) return GG_FAILED;
  e->model = *model;
  e->model.start = NULL; /* it ends with the call */
  for (int a = 0; a < 3; a++) {
    e->box.edge[a] = model->box[a];
    e->box.inverse[a] = 1 / model->box[a];
  }
  for (int a = 0; a < 3; a++)
    if (gg_common_surface_is_closed(model, a)) e->box.inverse[a] = 0; /* no image across a wall */
  e->box.image_velocity = model->shear_rate * model->box[1];
  e->gravity = (gg_vec){model->gravity[0], model->gravity[1], model->gravity[2]};
  e->falls = gg_dot(e->gravity, e->gravity) > 0;
  e->heat = gg_common_heat_of(model);
  e->noise = gg_common_thermostat_kicks(model);
  if (model->bath.on && model->bath.drag[0] == 0)
    e->heat = model->bath.noise[0] > 0 ? GG_HEAT_KICKS : GG_UNHEATED, e->noise = model->bath.noise[0];
  gg_status status = gg_md_contacts_make(&e->contacts, model, err);
  if (status == GG_OK) status = allocate(e, err);
  if (status != GG_OK) {
    gg_md_free(e);
    return status;
  }
  *engine = e;
  return GG_OK;
}

static void free_search(gg_md_search_state *search)
{
  if (search->kind == GG_MD_NEIGHBOUR_LISTS) {
    free(search->lists.skin);
    free(search->lists.neighbour);
  } else if (gg_md_search_has_rows(search->kind)) {
    if (search->rows.row) free(search->rows.row - 1);
  }
  for (int a = 0; a < 3; a++) free(search->near[a]);
}

void gg_md_free(gg_md *e)
{
  if (!e) return;
  gg_md_parallel_free(e);
  gg_md_contacts_free(&e->contacts);
  gg_md_queue_free(&e->queue);
  gg_md_cells_free(&e->cells);
  free_search(&e->search);
  free(e->grain);
  free(e->node);
  free(e->spin);
  gg_common_coefficient_tables_free(e->tables);
  free(e->last);
  free(e->image);
  free(e->id);
  free(e->candidates);
  free(e->kicks.order);
  free(e);
}

/* Mean number of grains in a cell; a grain is in several overlapping cells. */
static double grains_per_cell(const gg_model *m, gg_md_search_kind kind, const int32_t n[3])
{
  double per_cell = (double)m->n;
  for (int a = 0; a < 3; a++) {
    const double width = m->box[a] / n[a];
    per_cell *= (gg_md_search_overlaps(kind) ? 1 + gg_md_reach(m) / width : 1) / n[a];
  }
  return per_cell;
}

/* Memory of the cells. Cells hold seven grains, and the room of all is doubled when one is full: at five standard
 * deviations above the mean. */
static double bytes_of_cells(const gg_model *m, gg_md_search_kind kind, const int32_t n[3])
{
  const double mean = grains_per_cell(m, kind, n), fullest = mean + 5 * sqrt(mean);
  double words = kind == GG_MD_NEIGHBOUR_LISTS ? 16 : 8;
  if (gg_md_has_small_cells(m, kind))
    return ((double)n[0] * n[1] * n[2] * GG_MD_SMALL_CELL + (double)m->n) * sizeof(uint32_t);
  while (words - 1 < fullest) words *= 2;
  return (double)n[0] * n[1] * n[2] * words * sizeof(uint32_t);
}

double gg_md_bytes(const gg_model *m)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(m, &radius, n);
  double each = sizeof(gg_md_grain) + sizeof(gg_md_node) + sizeof(uint32_t) + sizeof(gg_md_bucket) / 4.0;
  if (m->rule != GG_SMOOTH) each += sizeof(gg_vec);
  if (m->contact_time > 0) each += sizeof(double);
  if (kind == GG_MD_NEIGHBOUR_LISTS) each += sizeof(gg_md_skin) + GG_MD_LIST * sizeof(uint32_t);
  return each * (double)m->n + bytes_of_cells(m, kind, n);
}
