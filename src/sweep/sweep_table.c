#include "sweep/sweep_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked_json.h"
#include "base/memory.h"
#include "files/h5/hdf5_reader.h"
#include "sweep/folder.h"

void gg_sweep_point_table_clear(gg_point_table *t)
{
  for (size_t i = 0; i < t->n_documents; i++) json_decref(t->document[i]);
  free(t->document);
  free(t->row);
  *t = (gg_point_table){0};
}

static gg_status add_row(gg_point_table *t, const gg_cli_table_row *row, gg_error *err)
{
  if (t->n == t->room) {
    size_t room = t->room ? 2 * t->room : 256;
    gg_cli_table_row *grown = realloc(t->row, room * sizeof *grown);
    if (!grown) return gg_base_out_of_memory(err);
    t->row = grown;
    t->room = room;
  }
  t->row[t->n++] = *row;
  return GG_OK;
}

static double number(const json_t *object, const char *key)
{
  const json_t *value = json_object_get(object, key);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

/* Quantities of a method, of those that it has a mean of. */
static gg_status add_quantities(gg_point_table *t, gg_cli_table_row row, json_t *quantities, const char *error,
                                gg_error *err)
{
  const char *name;
  json_t *one;
  json_object_foreach(quantities, name, one)
  {
    row.quantity = name;
    row.unit = json_string_value(json_object_get(one, "unit"));
    row.mean = number(one, "mean");
    row.error = number(one, error);
    if (!isnan(row.mean)) GG_TRY(add_row(t, &row, err));
  }
  return GG_OK;
}

static gg_status add_run(gg_point_table *t, gg_cli_table_row row, json_t *document, gg_error *err)
{
  if (!json_is_object(document)) return GG_OK; /* an engine that could not run the scene */
  row.method = json_string_value(json_object_get(document, "engine"));
  row.steady = json_is_true(json_object_get(document, "steady"));
  row.seconds = number(json_object_get(document, "total"), "cpu_seconds");
  return row.method ? add_quantities(t, row, json_object_get(document, "results"), "stderr", err) : GG_OK;
}

static gg_status add_document(gg_point_table *t, gg_cli_table_row row, json_t *document, gg_error *err)
{
  const char *name;
  json_t *theory;
  if (!json_object_get(document, "comparison")) return add_run(t, row, document, err);
  GG_TRY(add_run(t, row, json_object_get(document, "md"), err));
  GG_TRY(add_run(t, row, json_object_get(document, "dsmc"), err));
  row.theory = row.steady = true;
  row.seconds = NAN;
  json_object_foreach(json_object_get(document, "theory"), name, theory)
  {
    row.method = name;
    GG_TRY(add_quantities(t, row, theory, "error", err));
  }
  return GG_OK;
}

static gg_status read_document(const char *path, json_t **document, gg_error *err)
{
  gg_h5_in h;
  gg_h5_open(&h, path);
  char *text = h.failed ? NULL : gg_h5_read_text(&h, "/graingas/document");
  const char *why = "out of memory";
  *document = text ? gg_base_json_read(text, &why) : NULL;
  free(text);
  if (!*document && !h.failed) gg_h5_in_failed(&h, why);
  gg_h5_in_close(&h);
  return gg_h5_in_status(&h, path, err);
}

static gg_status add_point(gg_point_table *t, const gg_sweep *sweep, const char *folder, size_t i, gg_error *err)
{
  gg_scene scene;
  const uint64_t id = sweep->point[i].id;
  const gg_point_state state = gg_sweep_point_status(folder, id);
  if (state == GG_POINT_MISSING) return GG_OK;
  GG_TRY(gg_sweep_resolve(sweep, i, &scene, err));
  const gg_cli_table_row row = {.point = i, .seed = scene.run.seed, .fell_short = state == GG_POINT_SHORT};
  char *path = gg_sweep_point_path(folder, id, row.fell_short ? ".short.h5" : ".h5");
  json_t *document = NULL;
  gg_status status = path ? read_document(path, &document, err) : gg_base_out_of_memory(err);
  if (status == GG_OK)
    status = gg_sweep_point_check(&scene, sweep->settings.does, json_object_get(document, "scene"), path, err);
  free(path);
  if (status != GG_OK) return json_decref(document), status;
  t->document[t->n_documents++] = document;
  t->n_points++;
  return add_document(t, row, document, err);
}

gg_status gg_sweep_point_table_read(gg_point_table *t, const gg_sweep *sweep, const char *folder, gg_error *err)
{
  *t = (gg_point_table){0};
  t->document = gg_base_array_new(sweep->n, sizeof *t->document, err);
  if (!t->document) return GG_FAILED;
  for (size_t i = 0; i < sweep->n; i++) GG_TRY(add_point(t, sweep, folder, i, err));
  if (!t->n_points)
    return gg_base_fail(err, GG_FAILED, "%s: none of the sweep's %zu points is there", folder, sweep->n);
  return GG_OK;
}
