/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/sweep_table.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/memory.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_reader.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/result_file.h"
#include "files/result_document.h"
#include "graingas.h"
#include "io/checked_json.h"
#include "io/file_writer.h"
#include "run/result.h"
#include "scene/model_of_scene.h"
#include "sweep/folder.h"
#include "sweep/point_deviations.h"
#include "theory/theory.h"

void gg_sweep_point_table_clear(gg_point_table *t)
{
  for (size_t i = 0; i < t->n_documents; i++) json_decref(t->document[i]);
  free(t->document);
  free(t->row);
  gg_base_string_list_clear(&t->texts);
  *t = (gg_point_table){0};
}

bool gg_sweep_point_table_has(const gg_point_table *t, const char *method, const char *quantity)
{
  size_t i = 0;
  while (i < t->n &&
         ((method && strcmp(t->row[i].method, method) != 0) || (quantity && strcmp(t->row[i].quantity, quantity) != 0)))
    i++;
  return i < t->n;
}

bool gg_sweep_next_word(const char **list, char word[64])
{
  if (!*list || !**list) return false;
  const size_t length = strcspn(*list, ",");
  snprintf(word, 64, "%.*s", (int)length, *list);
  *list += length + ((*list)[length] == ',');
  return true;
}

static gg_status add_row(gg_point_table *t, const gg_point_row *row, gg_error *err)
{
  if (t->n == t->room) {
    size_t room = t->room ? 2 * t->room : 256;
    gg_point_row *grown = realloc(t->row, room * sizeof *grown);
    if (!grown) return gg_base_out_of_memory(err);
    t->row = grown;
    t->room = room;
  }
  t->row[t->n++] = *row;
  return GG_OK;
}

static gg_status add_quantities(gg_point_table *t, gg_point_row row, json_t *quantities, const char *error,
                                gg_error *err)
{
  const char *name;
  json_t *one;
  json_object_foreach(quantities, name, one)
  {
    row.quantity = name;
    row.unit = json_string_value(json_object_get(one, "unit"));
    row.mean = gg_io_json_number(one, "mean");
    row.error = gg_io_json_number(one, error);
    if (!isnan(row.mean)) GG_TRY(add_row(t, &row, err));
  }
  return GG_OK;
}

static gg_status add_run(gg_point_table *t, gg_point_row row, json_t *document, gg_error *err)
{
  if (!json_is_object(document)) return GG_OK; /* an engine that could not run the scene */
  row.method = json_string_value(json_object_get(document, "engine"));
  row.steady = json_is_true(json_object_get(document, "steady"));
  row.seconds = gg_io_json_number(json_object_get(document, "total"), "cpu_seconds");
  row.contact_time = gg_io_json_number(json_object_get(document, "engine_state"), "contact_time");
  return row.method ? add_quantities(t, row, json_object_get(document, "results"), "stderr", err) : GG_OK;
}

/* Add theories of the sweep's file, evaluated now: the file may have changed since the point was run. */
static gg_status add_own_theories(gg_point_table *t, gg_point_row row, const gg_model *m, gg_error *err)
{
  GG_FREED gg_quantity_rows *rows = gg_base_array_new(1, sizeof *rows, err);
  if (!rows) return GG_FAILED;
  gg_run_rows_make(m, rows);
  for (int i = 0; i < gg_common_extension_theories(m->extension); i++) {
    const gg_theory *theory = gg_common_extension_face(m->extension, i);
    gg_theory_answer answer;
    if (gg_theory_evaluate(theory, m, &answer, NULL) != GG_OK) continue;
    row.method = theory->name;
    for (int k = 0; k < rows->n; k++) {
      row.quantity = rows->row[k].name, row.unit = rows->row[k].unit;
      row.mean = answer.value[rows->row[k].quantity], row.error = NAN;
      if (isfinite(row.mean)) GG_TRY(add_row(t, &row, err));
    }
  }
  return GG_OK;
}

static bool is_own(const gg_extension *x, const char *theory)
{
  bool found = false;
  for (int i = 0; i < gg_common_extension_theories(x); i++)
    found |= strcmp(gg_common_extension_theory(x, i)->name, theory) == 0;
  return found;
}

static gg_status add_document(gg_point_table *t, gg_point_row row, json_t *document, const gg_scene *scene,
                              gg_error *err)
{
  const char *name;
  json_t *theory;
  if (!json_object_get(document, "comparison")) return add_run(t, row, document, err);
  GG_TRY(add_run(t, row, json_object_get(document, "md"), err));
  GG_TRY(add_run(t, row, json_object_get(document, "dsmc"), err));
  row.theory = row.steady = true;
  row.seconds = row.contact_time = NAN;
  json_object_foreach(json_object_get(document, "theory"), name, theory)
  {
    row.method = name;
    if (!is_own(scene->extension, name)) GG_TRY(add_quantities(t, row, theory, "error", err));
  }
  gg_model model;
  if (!scene->extension) return GG_OK;
  GG_TRY(gg_scene_model_make(scene, GG_MD, &model, err));
  return add_own_theories(t, row, &model, err);
}

static gg_status read_document(const char *path, json_t **document, char **scene, gg_error *err)
{
  GG_CLEARED(gg_h5_in_close) gg_h5_in h = {.fd = -1};
  gg_h5_open(&h, path, false);
  GG_FREED char *text = h.failed ? NULL : gg_h5_read_text(&h, "/graingas/document");
  const char *why = "out of memory";
  *document = text ? gg_files_document_read(text, &why) : NULL;
  if (!*document && !h.failed) gg_h5_in_failed(&h, why);
  *scene = h.failed ? NULL : gg_h5_read_text(&h, "/graingas/scene");
  return gg_h5_in_status(&h, path, err);
}

static gg_status add_read_point(gg_point_table *t, gg_point_row row, const gg_scene *scene, json_t *document,
                                char *yaml, gg_error *err)
{
  const size_t first = t->n;
  row.version = json_string_value(json_object_get(document, "graingas"));
  row.build = json_string_value(json_object_get(document, "build"));
  t->n_other_builds += !row.build || strcmp(row.build, gg_base_build_identity) != 0;
  GG_TRY(add_document(t, row, document, scene, err));
  return gg_sweep_point_deviations(t, first, document, yaml, err);
}

static gg_status add_point(gg_point_table *t, const gg_sweep *sweep, const char *folder, size_t i, gg_error *err)
{
  gg_scene scene;
  const uint64_t id = sweep->point[i].id;
  const gg_point_state state = gg_sweep_point_status(folder, id);
  if (state == GG_POINT_MISSING) return GG_OK;
  GG_TRY(gg_sweep_resolve(sweep, i, &scene, err));
  gg_point_row row = {.point = i, .seed = scene.run.seed, .fell_short = state == GG_POINT_SHORT};
  gg_sweep_point_name(id, row.file);
  char path[PATH_MAX];
  GG_FREED char *yaml = NULL;
  json_auto_t *document = NULL;
  gg_sweep_point_path(folder, id, row.fell_short ? ".short.h5" : ".h5", path);
  GG_TRY(read_document(path, &document, &yaml, err));
  GG_TRY(gg_sweep_point_check(&scene, sweep->settings.does, json_object_get(document, "scene"), path, err));
  t->document[t->n_documents++] = json_incref(document);
  return add_read_point(t, row, &scene, document, yaml, err);
}

gg_status gg_sweep_point_table_read(gg_point_table *t, const gg_sweep *sweep, const char *folder, const gg_stop *stop,
                                    gg_error *err)
{
  *t = (gg_point_table){0};
  t->document = gg_base_array_new(sweep->n, sizeof *t->document, err);
  if (!t->document) return GG_FAILED;
  for (size_t i = 0; i < sweep->n; i++) {
    GG_TRY(gg_stop_check(stop, err));
    GG_TRY(add_point(t, sweep, folder, i, err));
  }
  if (!t->n_documents)
    return gg_base_fail(err, GG_FAILED, "%s: none of the sweep's %zu points is there", folder, sweep->n);
  return GG_OK;
}

void gg_sweep_point_table_warn(const gg_point_table *t, const char *more,
                               void (*warn)(void *context, const char *message), void *context)
{
  char text[200];
  if (!t->n_other_builds || !warn) return;
  snprintf(text, sizeof text, "%zu of %zu points are by another build of graingas, whose numbers may differ%s",
           t->n_other_builds, t->n_documents, more);
  warn(context, text);
}

/* Columns after those of the point and its keys. Whole numbers and truths have a value in every row, so that readers
 * find one type in a column: seed and `short` are those of the point, theories count as steady. */
typedef enum kind { NUMBER, WHOLE, TRUTH, TEXT, NAME } kind;
static const struct {
  const char *name;
  kind kind;
  size_t offset;
} columns[] = {
    {"method", TEXT, offsetof(gg_point_row, method)},
    {"quantity", TEXT, offsetof(gg_point_row, quantity)},
    {"mean", NUMBER, offsetof(gg_point_row, mean)},
    {"error", NUMBER, offsetof(gg_point_row, error)},
    {"unit", TEXT, offsetof(gg_point_row, unit)},
    {"reference", TEXT, offsetof(gg_point_row, reference)},
    {"reference_mean", NUMBER, offsetof(gg_point_row, reference_mean)},
    {"difference", NUMBER, offsetof(gg_point_row, difference)},
    {"difference_error", NUMBER, offsetof(gg_point_row, difference_error)},
    {"deviation", NUMBER, offsetof(gg_point_row, deviation)},
    {"deviation_error", NUMBER, offsetof(gg_point_row, deviation_error)},
    {"z", NUMBER, offsetof(gg_point_row, z)},
    {"beyond_expected", TRUTH, offsetof(gg_point_row, beyond)},
    {"cause", TEXT, offsetof(gg_point_row, cause)},
    {"structure", TEXT, offsetof(gg_point_row, structure)},
    {"contact_time", NUMBER, offsetof(gg_point_row, contact_time)},
    {"seed", WHOLE, offsetof(gg_point_row, seed)},
    {"steady", TRUTH, offsetof(gg_point_row, steady)},
    {"short", TRUTH, offsetof(gg_point_row, fell_short)},
    {"seconds", NUMBER, offsetof(gg_point_row, seconds)},
    {"file", NAME, offsetof(gg_point_row, file)},
    {"version", TEXT, offsetof(gg_point_row, version)},
    {"build", TEXT, offsetof(gg_point_row, build)},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static const void *cell(const gg_point_row *row, size_t c)
{
  return (const char *)row + columns[c].offset;
}

static const char *text_of(const gg_point_row *row, size_t c)
{
  const void *at = cell(row, c);
  return columns[c].kind == NAME ? at : *(const char *const *)at;
}

static void put_count(gg_csv *csv, uint64_t n)
{
  char text[24];
  snprintf(text, sizeof text, "%" PRIu64, n);
  gg_io_csv_text(csv, text);
}

static void put_cell(gg_csv *csv, const gg_point_row *row, size_t c)
{
  const void *at = cell(row, c);
  json_auto_t *value = NULL;
  switch (columns[c].kind) {
  case NUMBER:
    value = isfinite(*(const double *)at) ? json_real(*(const double *)at) : NULL;
    gg_io_csv_json(csv, value);
    return;
  case WHOLE: put_count(csv, *(const uint64_t *)at); return;
  case TRUTH: gg_io_csv_text(csv, *(const bool *)at ? "true" : "false"); return;
  default: gg_io_csv_text(csv, text_of(row, c));
  }
}

/* Write infinity as readers of tables expect it: YAML's ".inf" is a text for them. */
static const char *plain_value(const char *yaml)
{
  return strcmp(yaml, ".inf") == 0 ? "inf" : yaml;
}

static void put_row(gg_csv *csv, const gg_sweep *sweep, const gg_point_row *row)
{
  put_count(csv, row->point + 1);
  for (size_t k = 0; gg_sweep_column_key(sweep, k); k++)
    gg_io_csv_text(csv, plain_value(gg_sweep_column_value(sweep, row->point, k)));
  for (size_t c = 0; c < COLUMNS; c++) put_cell(csv, row, c);
  gg_io_csv_end_row(csv);
}

gg_status gg_sweep_point_table_write_csv(const gg_point_table *t, const gg_sweep *sweep, const char *path,
                                         gg_error *err)
{
  gg_atomic_file file;
  GG_TRY(gg_io_atomic_open(&file, path, false, err));
  GG_FREED gg_file_writer *out = gg_base_array_new(1, sizeof *out, err);
  if (!out) return gg_io_atomic_abandon(&file), GG_FAILED;
  const unsigned before = gg_base_memory_failures();
  gg_io_file_writer_begin(out, &file, err);
  gg_csv csv = {.out = out};
  gg_io_csv_text(&csv, "point");
  for (size_t k = 0; gg_sweep_column_key(sweep, k); k++) gg_io_csv_text(&csv, gg_sweep_column_key(sweep, k));
  for (size_t c = 0; c < COLUMNS; c++) gg_io_csv_text(&csv, columns[c].name);
  gg_io_csv_end_row(&csv);
  for (size_t i = 0; i < t->n; i++) put_row(&csv, sweep, &t->row[i]);
  return gg_io_atomic_commit(&file, gg_base_memory_check(before, gg_io_file_writer_end(out), err), err);
}

/* Room for a column of each type. */
typedef struct column {
  gg_h5 *h;
  size_t n;
  double *number;
  int64_t *whole;
  uint8_t *truth;
  const char **text;
} column;

static void write_column(const column *c, const char *name, kind of)
{
  const hsize_t n = c->n;
  char path[160];
  snprintf(path, sizeof path, "/graingas/table/%s", name);
  switch (of) {
  case NUMBER: gg_h5_array(c->h, path, H5T_NATIVE_DOUBLE, 1, &n, c->number); break;
  case WHOLE: gg_h5_array(c->h, path, H5T_NATIVE_INT64, 1, &n, c->whole); break;
  case TRUTH: gg_h5_array(c->h, path, H5T_NATIVE_UINT8, 1, &n, c->truth); break;
  default: gg_h5_texts(c->h, path, c->text, c->n);
  }
}

/* True for digits alone: seeds are larger than the whole numbers that a double holds. */
static bool is_whole(const char *text, long long *n)
{
  char *end;
  errno = 0;
  *n = strtoll(text, &end, 10);
  return end != text && !*end && errno == 0;
}

/* Write the column of a varied key: whole numbers or numbers if every point has one, else texts. */
static void write_key(const column *c, const gg_point_table *t, const gg_sweep *sweep, size_t k)
{
  bool numbers = true, wholes = true;
  for (size_t i = 0; i < t->n; i++) {
    char *end;
    long long n = 0;
    c->text[i] = plain_value(gg_sweep_column_value(sweep, t->row[i].point, k));
    c->number[i] = strtod(c->text[i], &end);
    numbers = numbers && !*end && end != c->text[i];
    wholes = is_whole(c->text[i], &n) && wholes;
    c->whole[i] = n;
  }
  write_column(c, gg_sweep_column_key(sweep, k), wholes ? WHOLE : numbers ? NUMBER : TEXT);
}

static void fill_column(const column *out, const gg_point_table *t, size_t c)
{
  for (size_t i = 0; i < t->n; i++) {
    const gg_point_row *row = &t->row[i];
    const char *text = columns[c].kind >= TEXT ? text_of(row, c) : NULL;
    switch (columns[c].kind) {
    case NUMBER: out->number[i] = *(const double *)cell(row, c); break;
    case WHOLE: out->whole[i] = (int64_t) * (const uint64_t *)cell(row, c); break;
    case TRUTH: out->truth[i] = *(const bool *)cell(row, c); break;
    default: out->text[i] = text ? text : "";
    }
  }
}

static void write_columns(const column *out, const gg_point_table *t, const gg_sweep *sweep)
{
  for (size_t i = 0; i < t->n; i++) out->whole[i] = (int64_t)t->row[i].point + 1;
  write_column(out, "point", WHOLE);
  for (size_t k = 0; gg_sweep_column_key(sweep, k); k++) write_key(out, t, sweep, k);
  for (size_t c = 0; c < COLUMNS; c++) {
    fill_column(out, t, c);
    write_column(out, columns[c].name, columns[c].kind);
  }
}

static gg_status write_image(gg_h5 *h, const char *path, gg_error *err)
{
  size_t size = 0;
  gg_atomic_file file;
  GG_FREED void *image = gg_h5_image(h, &size);
  gg_h5_close(h);
  GG_TRY(gg_h5_status(h, path, "written", err));
  GG_TRY(gg_io_atomic_open(&file, path, false, err));
  return gg_io_atomic_commit(&file, gg_files_checksum_trailer_write(&file, image, size, NULL, err), err);
}

gg_status gg_sweep_point_table_write_h5(const gg_point_table *t, const gg_sweep *sweep, const char *path,
                                        const char *command, gg_error *err)
{
  gg_h5 h;
  GG_FREED double *number = gg_base_array_new(t->n, sizeof *number, err);
  GG_FREED int64_t *whole = gg_base_array_new(t->n, sizeof *whole, err);
  GG_FREED uint8_t *truth = gg_base_array_new(t->n, sizeof *truth, err);
  GG_FREED const char **text = gg_base_array_new(t->n, sizeof *text, err);
  if (!number || !whole || !truth || !text) return GG_FAILED;
  gg_h5_create(&h, NULL);
  gg_h5_group(&h, "/graingas/table");
  gg_h5_text(&h, "/graingas/version", gg_base_build_version);
  gg_h5_text(&h, "/graingas/command", command);
  gg_h5_text_attribute(&h, "/graingas", "kind", "sweep");
  write_columns(&(column){&h, t->n, number, whole, truth, text}, t, sweep);
  return write_image(&h, path, err);
}

/* A value as a number if it is one, else as its YAML. */
static json_t *value_json(const char *text)
{
  long long n;
  if (is_whole(text, &n)) return json_integer(n);
  char *end;
  double x = strtod(text, &end);
  if (*end || end == text || !isfinite(x)) return json_string(text);
  return x == floor(x) && fabs(x) < 1e15 ? json_integer((json_int_t)x) : json_real(x);
}

static json_t *point_json(const gg_sweep *sweep, const char *folder, size_t i)
{
  static const char *const states[] = {[GG_POINT_MISSING] = "missing",
                                       [GG_POINT_DONE] = "done",
                                       [GG_POINT_SHORT] = "short",
                                       [GG_POINT_OTHER_BUILD] = "other build",
                                       [GG_POINT_DAMAGED] = "damaged"};
  char name[GG_POINT_NAME];
  gg_scene scene;
  if (gg_sweep_resolve(sweep, i, &scene, NULL) != GG_OK)
    return gg_io_json_made(NULL); /* the scene was checked before, so memory is short */
  json_t *keys = json_object();
  gg_sweep_point_name(sweep->point[i].id, name);
  for (size_t k = 0; gg_sweep_column_key(sweep, k); k++)
    json_object_set_new(keys, gg_sweep_column_key(sweep, k), value_json(gg_sweep_column_value(sweep, i, k)));
  return json_pack("{s:I, s:o, s:s, s:s, s:f, s:I, s:I}", "point", (json_int_t)i + 1, "keys", keys, "name", name,
                   "state", states[gg_sweep_point_state(folder, sweep->point[i].id)], "cpu_seconds",
                   sweep->point[i].seconds, "replicas", (json_int_t)scene.run.replicas, "seed",
                   (json_int_t)scene.run.seed);
}

/* A name as JSON, with ? for bytes that may not be UTF-8. Jansson's first refusal is then no lack of memory. */
static json_t *name_as_text(const char *name)
{
  json_t *text = (json_string)(name);
  if (text) return text;
  GG_FREED char *plain = strdup(name);
  for (char *c = plain; c && *c; c++)
    if (*c & 0x80) *c = '?';
  return plain ? json_string(plain) : gg_io_json_made(NULL);
}

json_t *gg_sweep_document(const gg_sweep *sweep, const char *folder)
{
  const unsigned before = gg_base_memory_failures();
  json_t *points = json_array();
  for (size_t i = 0; i < sweep->n; i++) json_array_append_new(points, point_json(sweep, folder, i));
  return gg_io_json_end(before, json_pack("{s:s, s:s, s:o, s:o}", "graingas", gg_base_build_version, "does",
                                          gg_sweep_does_words[sweep->settings.does], "folder", name_as_text(folder),
                                          "points", points));
}
