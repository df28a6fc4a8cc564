/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The verdict on a grid for programs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/memory.h"
#include "common/quantity.h"
#include "io/checked_json.h"
#include "sweep/verdict.h"

/* The number of the point, and its keys as in the table. */
static json_t *point_json(const gg_grid_view *v, size_t point)
{
  const char *key;
  json_t *one = json_pack("{s:I}", "point", (json_int_t)point + 1);
  for (size_t k = 0; (key = gg_sweep_column_key(v->sweep, k)); k++) {
    const char *text = gg_sweep_column_value(v->sweep, point, k);
    char *end;
    const double x = strtod(text, &end);
    json_object_set_new(one, key, *end || !isfinite(x) ? json_string(text) : json_real(x));
  }
  return one;
}

static json_t *agreement_json(const gg_agreement *a)
{
  json_t *rows = json_array();
  for (int i = 0; i < a->n; i++) {
    const gg_scores *r = &a->row[i].scores;
    json_array_append_new(rows,
                          json_pack("{s:s, s:I, s:o, s:o, s:o, s:o, s:o, s:b}", "quantity", a->row[i].quantity,
                                    "points", (json_int_t)r->n, "mean_z", gg_io_json_finite(r->mean), "mean_z_allowed",
                                    gg_io_json_finite(r->most_mean), "mean_z2", gg_io_json_finite(r->variance),
                                    "mean_z2_allowed", gg_io_json_finite(r->most_variance), "largest_z",
                                    gg_io_json_finite(r->largest), "fails", r->fails));
  }
  json_t *agrees = a->n_values ? json_boolean(!a->fails) : json_null(); /* null: nothing was compared */
  return json_pack("{s:o, s:I, s:I, s:I, s:I, s:o, s:o}", "agrees", agrees, "points", (json_int_t)a->n_points, "values",
                   (json_int_t)a->n_values, "without_solution", (json_int_t)a->unanswered, "not_steady",
                   (json_int_t)a->unsteady, "z_allowed", gg_io_json_finite(a->most), "quantities", rows);
}

static json_t *worst_json(const gg_grid_view *v, const char *repeat)
{
  json_t *rows = json_array();
  GG_FREED const gg_point_row **found = gg_base_array_new(v->table->n + 1, sizeof(void *), NULL);
  for (size_t i = 0, n = found ? gg_sweep_find_worst(v, found) : 0; i < n; i++) {
    json_t *row = point_json(v, found[i]->point);
    json_object_update_new(row, json_pack("{s:o, s:s, s:o, s:o, s:o}", "z", gg_io_json_finite(found[i]->z), "quantity",
                                          found[i]->quantity, "dsmc", gg_io_json_finite(found[i]->mean), "error",
                                          gg_io_json_finite(found[i]->error), "enskog_hermite",
                                          gg_io_json_finite(found[i]->reference_mean)));
    if (repeat) json_object_set_new(row, "repeat", json_sprintf("%s %zu", repeat, found[i]->point + 1));
    json_array_append_new(rows, row);
  }
  return rows;
}

static void add_counts(json_t *rows, const gg_grid_view *v, const char *method, const char *quantity)
{
  const gg_off_counts c = gg_sweep_count_off(v, method, quantity);
  if (!c.n) return;
  json_t *beyond = json_object();
  for (int k = 0; k < GG_THRESHOLDS; k++) {
    char text[16];
    snprintf(text, sizeof text, "%g", gg_sweep_thresholds[k]);
    json_object_set_new(beyond, text, json_integer((json_int_t)c.off[k]));
  }
  json_array_append_new(rows,
                        json_pack("{s:s, s:s, s:I, s:o, s:o, s:o}", "method", method, "quantity", quantity, "points",
                                  (json_int_t)c.n, "beyond", beyond, "largest", gg_io_json_finite(c.largest), "where",
                                  c.where ? point_json(v, c.where->point) : json_null()));
}

/* Add the counts of the main quantities for every method. */
static json_t *counts_json(const gg_grid_view *v)
{
  json_t *rows = json_array();
  json_auto_t *seen = json_object();
  for (size_t i = 0; i < v->table->n; i++) {
    const char *method = v->table->row[i].method;
    if (json_object_get(seen, method)) continue;
    json_object_set_new(seen, method, json_true());
    for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++)
      if (gg_sweep_is_main_quantity(gg_common_quantity_name(q)))
        add_counts(rows, v, method, gg_common_quantity_name(q));
  }
  return rows;
}

static json_t *trouble_json(const gg_grid_view *v, gg_point_trouble *trouble)
{
  json_t *rows = json_array();
  for (size_t i = 0; i < v->sweep->n; i++) {
    const char *which = trouble(v, i);
    json_t *row = which ? point_json(v, i) : NULL;
    if (!row) continue;
    json_object_set_new(row, "what", json_string(which));
    json_array_append_new(rows, row);
  }
  return rows;
}

json_t *gg_sweep_verdict_document(const gg_grid_view *v, const gg_agreement *a, const char *repeat)
{
  const unsigned before = gg_base_memory_failures();
  return gg_io_json_end(before,
                        json_pack("{s:s, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o}", "graingas", gg_base_build_version,
                                  "points", (json_int_t)v->sweep->n, "done", (json_int_t)v->table->n_documents, "dsmc",
                                  agreement_json(a), "largest_z", worst_json(v, repeat), "deviations", counts_json(v),
                                  "not_steady", trouble_json(v, gg_sweep_not_steady), "not_homogeneous",
                                  trouble_json(v, gg_sweep_not_homogeneous), "without_reference",
                                  trouble_json(v, gg_sweep_no_reference)));
}
