/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/export.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "common/engine.h"
#include "common/species.h"
#include "files/curve_table.h"
#include "files/positions.h"
#include "graingas.h"
#include "io/checked_json.h"

static void put_numbers(gg_file_writer *out, const double *x, int n, const char *before)
{
  for (int a = 0; a < n; a++) {
    gg_io_file_writer_put(out, a ? " " : before);
    gg_io_file_writer_put_number(out, x[a]);
  }
}

static void put_word(gg_file_writer *out, const char *key, const char *value)
{
  gg_io_file_writer_put(out, " ");
  gg_io_file_writer_put(out, key);
  gg_io_file_writer_put(out, "=\"");
  gg_io_file_writer_put(out, value);
  gg_io_file_writer_put(out, "\"");
}

static void put_number(gg_file_writer *out, const char *key, double value)
{
  gg_io_file_writer_put(out, " ");
  gg_io_file_writer_put(out, key);
  gg_io_file_writer_put(out, "=");
  gg_io_file_writer_put_number(out, value);
}

static void put_head(gg_file_writer *out, const gg_stored_trajectory *t, const gg_frame *f, const double *edges)
{
  char text[64];
  snprintf(text, sizeof text, "%zu\n", f->n);
  gg_io_file_writer_put(out, text);
  put_numbers(out, edges, 9, "Lattice=\"");
  gg_io_file_writer_put(out, "\" Properties=species:S:1:pos:R:3:velo:R:3");
  if (f->spin) gg_io_file_writer_put(out, ":omega:R:3");
  gg_io_file_writer_put(out, ":radius:R:1:mass:R:1:momenta:R:3:masses:R:1:id:I:1");
  snprintf(text, sizeof text, "%s %s %s", t->periodic[0] ? "T" : "F", t->periodic[1] ? "T" : "F",
           t->periodic[2] ? "T" : "F");
  put_word(out, "pbc", text);
  put_number(out, "Time", f->time);
  snprintf(text, sizeof text, " collisions=%llu", (unsigned long long)f->step);
  gg_io_file_writer_put(out, text);
  put_number(out, "shear_rate", t->shear_rate);
  put_word(out, "length_unit", t->length_unit);
  put_word(out, "velocity_unit", t->velocity_unit);
  if (t->spin_unit) put_word(out, "omega_unit", t->spin_unit);
  put_word(out, "time_unit", t->time_unit);
  gg_io_file_writer_put(out, "\n");
}

/* Shift x by box lengths into the cell, which is tilted under shear. */
static double into_cell(double x, double y, const double *edges)
{
  double lean = edges[3], length = edges[0];
  return lean == 0 ? x : x - length * floor((x - lean * (y / edges[4])) / length);
}

void gg_files_xyz_frame(gg_file_writer *out, const gg_stored_trajectory *t, const gg_frame *f, const double edges[9])
{
  put_head(out, t, f, edges);
  for (size_t i = 0; i < f->n && out->status == GG_OK; i++) {
    char id[24];
    const double *r = f->position + 3 * i, place[3] = {into_cell(r[0], r[1], edges), r[1], r[2]};
    const double *v = f->velocity + 3 * i, m = t->mass[i], radius_mass[2] = {0.5 * t->diameter[i], m};
    const double momentum_mass[4] = {m * v[0], m * v[1], m * v[2], m};
    gg_io_file_writer_put(out, gg_files_xyz_element(t->species[i]));
    put_numbers(out, place, 3, " ");
    put_numbers(out, v, 3, " ");
    if (f->spin) put_numbers(out, f->spin + 3 * i, 3, " ");
    put_numbers(out, radius_mass, 2, " ");
    put_numbers(out, momentum_mass, 4, " "); /* the names that ASE looks for; OVITO: velo and mass */
    snprintf(id, sizeof id, " %zu\n", i);
    gg_io_file_writer_put(out, id);
  }
}

static void put_words(gg_csv *csv, const char *const *words, size_t n)
{
  for (size_t i = 0; i < n; i++) gg_io_csv_text(csv, words[i]);
}

static void put_members(gg_csv *csv, const json_t *object, const char *const *keys, size_t n)
{
  for (size_t i = 0; i < n; i++) gg_io_csv_json(csv, json_object_get(object, keys[i]));
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* Table of a run: one line per quantity, with mean, standard error, unit, samples, correlation time, and whether the
 * run was steady. */
static void put_results(gg_file_writer *out, const gg_stored_result *stored)
{
  static const char *const keys[] = {"mean", "stderr", "unit", "samples", "correlation_time", "correlation_time_unit"};
  gg_csv csv = {.out = out};
  const char *name;
  json_t *one;
  gg_io_csv_text(&csv, "quantity");
  put_words(&csv, keys, COUNT(keys));
  put_words(&csv, (const char *const[]){"steady", "reason"}, 2);
  gg_io_csv_end_row(&csv);
  json_object_foreach(json_object_get(stored->document, "results"), name, one)
  {
    gg_io_csv_text(&csv, name);
    put_members(&csv, one, keys, COUNT(keys));
    gg_io_csv_json(&csv, json_object_get(stored->document, "steady"));
    gg_io_csv_json(&csv, json_object_get(one, "reason"));
    gg_io_csv_end_row(&csv);
  }
}

/* Head of the columns of an engine in a comparison. */
static const char *const members[] = {"mean", "stderr", "samples", "correlation_time"};

static void put_engine_head(gg_csv *csv, const char *engine)
{
  char text[64];
  for (size_t i = 0; i < COUNT(members); i++) {
    snprintf(text, sizeof text, "%s_%s", engine, members[i]);
    gg_io_csv_text(csv, text);
  }
  snprintf(text, sizeof text, "%s_steady", engine);
  gg_io_csv_text(csv, text);
}

static bool has_errors(json_t *theory)
{
  const char *name;
  json_t *one;
  json_object_foreach(theory, name, one) if (json_object_get(one, "error")) return true;
  return false;
}

static void put_comparison_head(gg_csv *csv, const gg_stored_result *stored)
{
  const char *name;
  json_t *theory;
  char text[96];
  put_words(csv, (const char *const[]){"quantity", "unit"}, 2);
  for (int k = 0; k < GG_N_ENGINES; k++) put_engine_head(csv, gg_common_engine_of(k)->name);
  put_words(csv, (const char *const[]){"correlation_time_unit", "md_dsmc_z", "beyond_expected"}, 3);
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
  {
    gg_io_csv_text(csv, name);
    snprintf(text, sizeof text, "%s_error", name);
    if (has_errors(theory)) gg_io_csv_text(csv, text);
  }
  gg_io_csv_end_row(csv);
}

static void put_comparison_row(gg_csv *csv, const gg_stored_result *stored, const json_t *row)
{
  const char *quantity = json_string_value(json_object_get(row, "quantity")), *name;
  const json_t *unit = NULL;
  json_t *theory;
  if (!quantity) return;
  gg_io_csv_text(csv, quantity);
  gg_io_csv_json(csv, json_object_get(row, "unit"));
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const gg_stored_engine *e = &stored->engine[k];
    const json_t *one = e->name ? json_object_get(json_object_get(e->document, "results"), quantity) : NULL;
    put_members(csv, one, members, COUNT(members));
    gg_io_csv_json(csv, one ? json_object_get(stored->engine[k].document, "steady") : NULL);
    if (one) unit = json_object_get(one, "correlation_time_unit");
  }
  gg_io_csv_json(csv, unit);
  put_members(csv, row, (const char *const[]){"md_dsmc_z", "beyond_expected"}, 2);
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
  {
    const json_t *said = json_object_get(theory, quantity);
    gg_io_csv_json(csv, json_object_get(said, "mean"));
    if (has_errors(theory)) gg_io_csv_json(csv, json_object_get(said, "error"));
  }
  gg_io_csv_end_row(csv);
}

/* Table of a comparison: one line per quantity, with both engines, z, and the value of each theory. */
static void put_comparison(gg_file_writer *out, const gg_stored_result *stored)
{
  gg_csv csv = {.out = out};
  size_t i;
  json_t *row;
  put_comparison_head(&csv, stored);
  json_array_foreach(json_object_get(stored->document, "comparison"), i, row) put_comparison_row(&csv, stored, row);
}

/* A curve: x, mean, standard error, and the law beside it if there is one. */
static void put_curve(gg_file_writer *out, const json_t *curve)
{
  gg_csv csv = {.out = out};
  const json_t *law = json_object_get(curve, "reference");
  const char *unit = gg_io_json_string(curve, "unit");
  gg_io_csv_head(&csv, gg_io_json_string(curve, "x_name"), gg_io_json_string(curve, "x_unit"));
  gg_io_csv_head(&csv, gg_io_json_string(curve, "y_name"), unit);
  gg_io_csv_head(&csv, "stderr", unit);
  if (law) gg_io_csv_head(&csv, gg_io_json_string(law, "label"), unit);
  gg_io_csv_end_row(&csv);
  for (size_t i = 0; i < json_array_size(json_object_get(curve, "x")); i++) {
    gg_io_csv_json(&csv, json_array_get(json_object_get(curve, "x"), i));
    gg_io_csv_json(&csv, json_array_get(json_object_get(curve, "value"), i));
    gg_io_csv_json(&csv, json_array_get(json_object_get(curve, "stderr"), i));
    if (law) gg_io_csv_json(&csv, json_array_get(json_object_get(law, "value"), i));
    gg_io_csv_end_row(&csv);
  }
}

static bool put_numbers_of(gg_csv *csv, const char *whose, json_t *curves)
{
  static const char *const keys[] = {"mean", "stderr", "unit"};
  const char *curve, *number;
  json_t *of, *one;
  bool any = false;
  json_object_foreach(curves, curve, of)
  {
    json_object_foreach(json_object_get(of, "numbers"), number, one)
    {
      any = true;
      if (!csv->out) return true;
      put_words(csv, (const char *const[]){whose, gg_io_json_string(of, "group"), curve, number}, 4);
      put_members(csv, one, keys, COUNT(keys));
      gg_io_csv_end_row(csv);
    }
  }
  return any;
}

/* Numbers derived from all curves: exponents, coefficients; true if there are any (`out` may be NULL to ask). */
static bool put_curve_numbers(gg_file_writer *out, const gg_stored_result *stored)
{
  static const char *const head[] = {"engine", "observable", "curve", "number", "mean", "stderr", "unit"};
  gg_csv csv = {.out = out};
  const char *theory;
  json_t *curves;
  bool any = false;
  if (out) {
    put_words(&csv, head, COUNT(head));
    gg_io_csv_end_row(&csv);
  }
  for (int k = 0; k < GG_N_ENGINES; k++)
    if (stored->engine[k].name)
      any |= put_numbers_of(&csv, stored->engine[k].name, json_object_get(stored->engine[k].document, "curves"));
  json_object_foreach(json_object_get(stored->document, GG_THEORY_CURVES), theory, curves) any |=
      put_numbers_of(&csv, theory, curves);
  return any;
}

typedef enum gg_export_content { RESULTS, CURVE, NUMBERS, TRAJECTORY } gg_export_content;

typedef struct target {
  char *path;
  gg_export_content content;
  const json_t *curve;
  dev_t device; /* of the file that stands there */
  ino_t inode;  /* 0: none does */
  bool filled;  /* it is not empty */
  gg_atomic_file file;
} target;

/* Curves of two engines and of theories, and the others. */
enum { MOST_TARGETS = 3 * GG_MOST_CURVES + 3 };

typedef struct job {
  const gg_stored_result *stored;
  const char *prefix;
  gg_stored_trajectory trajectory;
  size_t n;
  bool failed; /* out of memory */
  void (*progress)(void *context, double share);
  void *context;
  const gg_stop *stop;
  target target[MOST_TARGETS];
} job;

/* PREFIX + the words, joined by _ + ENDING. An engine's name is "" outside of comparisons. */
static void add(job *j, gg_export_content content, const json_t *curve, const char *const words[3], const char *ending)
{
  char middle[160] = "";
  size_t used = 0;
  if (j->n == MOST_TARGETS) return;
  for (int i = 0; i < 3 && used < sizeof middle; i++)
    if (words[i] && *words[i]) used += (size_t)snprintf(middle + used, sizeof middle - used, "_%s", words[i]);
  target *t = &j->target[j->n++];
  *t = (target){.content = content, .curve = curve, .file = GG_ATOMIC_NONE};
  if (asprintf(&t->path, "%s%s%s", j->prefix, middle, ending) < 0) t->path = NULL;
  j->failed |= !t->path;
}

/* Curves of an engine or a theory; `whose` is "" where there is only one. */
static void add_curves_of(job *j, const char *whose, json_t *curves)
{
  const char *name;
  json_t *curve;
  json_object_foreach(curves, name, curve)
  {
    const char *observable = json_string_value(json_object_get(curve, "group"));
    add(j, CURVE, curve, (const char *const[]){whose, observable, name}, ".csv");
  }
}

static void add_curves(job *j)
{
  const char *theory;
  json_t *curves;
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const gg_stored_engine *e = &j->stored->engine[k];
    if (e->name) add_curves_of(j, j->stored->comparison ? e->name : "", json_object_get(e->document, "curves"));
  }
  json_object_foreach(json_object_get(j->stored->document, GG_THEORY_CURVES), theory, curves)
      add_curves_of(j, theory, curves);
  if (put_curve_numbers(NULL, j->stored)) add(j, NUMBERS, NULL, (const char *const[]){"numbers", NULL, NULL}, ".csv");
}

static gg_status plan(job *j, const char *path, unsigned parts, gg_error *err)
{
  static const char *const nothing[3];
  if (parts & GG_EXPORT_RESULTS) add(j, RESULTS, NULL, nothing, ".csv");
  if (parts & GG_EXPORT_CURVES) add_curves(j);
  if (parts & GG_EXPORT_TRAJECTORY) GG_TRY(gg_files_stored_trajectory_open(&j->trajectory, path, err));
  if (j->trajectory.n_frames) add(j, TRAJECTORY, NULL, nothing, ".xyz");
  if (j->failed) return gg_base_out_of_memory(err);
  if (j->n) return GG_OK;
  return gg_base_fail(err, GG_FAILED, "%s: nothing to export: %s", path,
                      parts == GG_EXPORT_TRAJECTORY ? GG_NO_POSITIONS
                      : parts == GG_EXPORT_CURVES   ? "it holds no curves"
                                                    : "it holds neither curves nor positions of grains");
}

/* A device or a pipe gets everything, and no file is made beside it: in /dev it would remain. */
static gg_status check_prefix(const char *prefix, gg_error *err)
{
  struct stat about;
  const bool in_dev = strncmp(prefix, "/dev/", 5) == 0 || strncmp(prefix, "/proc/", 6) == 0; /* /dev/stdout > file */
  if (stat(prefix, &about) != 0 || (!in_dev && S_ISREG(about.st_mode)) || S_ISDIR(about.st_mode)) return GG_OK;
  return GG_REFUSE(err, "%s: is a device or a pipe; tables and trajectories are files, whose names the prefix begins",
                   prefix);
}

/* Check what is there already: one file for each output. */
static gg_status look_at(job *j, size_t i, gg_error *err)
{
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  target *t = &j->target[i];
  GG_TRY(gg_io_output_path_find(&place, t->path, err));
  if (place.there) t->device = place.about.st_dev, t->inode = place.about.st_ino, t->filled = place.about.st_size > 0;
  if (place.stream)
    return gg_base_fail(err, GG_BAD_FILE, "%s: is a device or a pipe; tables and trajectories are files", t->path);
  for (const target *k = j->target; t->inode && k < t; k++)
    if (k->inode == t->inode && k->device == t->device)
      return GG_REFUSE(err, "%s: would be the same file as %s; choose another prefix", t->path, k->path);
  return GG_OK;
}

/* If two paths name the same new file, the second finds it locked. */
static gg_status open_target(job *j, size_t i, const char *path, gg_error *err)
{
  target *t = &j->target[i];
  if (gg_io_path_is_same_file(t->path, path))
    return GG_REFUSE(err, "%s: would be both the result and what is exported from it; choose another prefix", t->path);
  GG_TRY(look_at(j, i, err));
  return gg_io_atomic_open(&t->file, t->path, false, err);
}

/* One line of a file, from 0, to be freed; NULL where it has not so many, or cannot be read. */
static char *read_line(const char *path, int line)
{
  GG_CLOSED FILE *in = path ? fopen(path, "r") : NULL;
  char *text = NULL;
  size_t room = 0;
  bool there = in != NULL;
  for (int k = 0; k <= line && there; k++) there = getline(&text, &room, in) > 0;
  return there ? text : (free(text), NULL);
}

/* An existing file may be replaced if it is an earlier export: its head is that of the new one; a trajectory is
 * recognised by its second line. */
static bool is_export(const target *t)
{
  const int line = t->content == TRAJECTORY;
  GG_FREED char *there = read_line(t->path, line), *now = read_line(t->file.temporary, line);
  return there && now && (line ? strncmp(there, "Lattice=", 8) == 0 : strcmp(there, now) == 0);
}

static gg_status check_replaced(const job *j, gg_error *err)
{
  for (const target *t = j->target; t < j->target + j->n; t++)
    if (t->filled && !is_export(t))
      return gg_base_fail(err, GG_BAD_FILE,
                          "%s: is there and was not made by an export like this; nothing was replaced: give --output "
                          "another name, or remove it",
                          t->path);
  return GG_OK;
}

static gg_status write_trajectory(job *j, gg_file_writer *out, gg_error *err)
{
  gg_stored_trajectory *t = &j->trajectory;
  double edges[9];
  gg_frame frame;
  for (size_t k = 0; k < t->n_frames && out->status == GG_OK; k++) {
    GG_TRY(gg_files_stored_trajectory_frame(t, k, &frame, edges, err));
    gg_files_xyz_frame(out, t, &frame, edges);
    gg_measure_frame_free(&frame);
    if (j->progress) j->progress(j->context, (double)(k + 1) / (double)t->n_frames);
  }
  return GG_OK;
}

static gg_status write_target(job *j, target *t, gg_error *err)
{
  gg_file_writer out;
  gg_status status = GG_OK;
  gg_io_file_writer_begin(&out, &t->file, err);
  out.stop = j->stop;
  if (t->content == CURVE) put_curve(&out, t->curve);
  if (t->content == NUMBERS) put_curve_numbers(&out, j->stored);
  if (t->content == RESULTS && j->stored->comparison) put_comparison(&out, j->stored);
  if (t->content == RESULTS && !j->stored->comparison) put_results(&out, j->stored);
  if (t->content == TRAJECTORY) status = write_trajectory(j, &out, err);
  return status == GG_OK ? gg_io_file_writer_end(&out) : status;
}

/* Write all files before the first is put in place, so that a failed write changes no file. */
static gg_status write_all(job *j, gg_error *err)
{
  gg_status status = GG_OK;
  for (size_t i = 0; i < j->n && status == GG_OK; i++) status = write_target(j, &j->target[i], err);
  if (status == GG_OK) status = gg_stop_check(j->stop, err);
  if (status == GG_OK) status = check_replaced(j, err);
  for (size_t i = 0; i < j->n && status == GG_OK; i++) status = gg_io_atomic_commit(&j->target[i].file, GG_OK, err);
  return status;
}

static void clear(job *j)
{
  gg_files_stored_trajectory_close(&j->trajectory);
  for (size_t i = 0; i < j->n; i++) {
    gg_io_atomic_abandon(&j->target[i].file);
    free(j->target[i].path);
  }
  free(j);
}

gg_status gg_files_export_result(const gg_stored_result *stored, const char *path, const char *prefix, unsigned parts,
                                 void (*written)(void *context, const char *file),
                                 void (*progress)(void *context, double share), void *context, const gg_stop *stop,
                                 gg_error *err)
{
  job *j = gg_base_array_new(1, sizeof *j, err);
  if (!j) return GG_FAILED;
  j->stored = stored, j->prefix = prefix, j->progress = progress, j->context = context, j->stop = stop;
  gg_status status = check_prefix(prefix, err);
  if (status == GG_OK) status = plan(j, path, parts, err);
  for (size_t i = 0; i < j->n && status == GG_OK; i++) status = open_target(j, i, path, err);
  if (status == GG_OK) status = write_all(j, err);
  for (size_t i = 0; i < j->n && status == GG_OK && written; i++) written(context, j->target[i].path);
  clear(j);
  return status;
}
