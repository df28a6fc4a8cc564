/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stored results and checkpoints, read from HDF5. */
#include "files/h5/result_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/memory.h"
#include "base/text.h"
#include "files/h5/checkpoint_file.h"
#include "files/h5/hdf5_reader.h"
#include "files/result_document.h"
#include "io/checked_json.h"

/* Reject a checkpoint that this build cannot resume. States are saved as they are in memory: another layout cannot be
 * read. Another identity can, but the run would continue with other physics or another trajectory. */
void gg_files_checkpoint_check_version(struct gg_h5_in *h, bool any_build)
{
  int64_t layout = 1; /* the first layout has no number */
  GG_FREED char *version = gg_h5_read_text(h, "/checkpoint/version"), *identity = NULL;
  char why[300];
  if (!version) return;
  if (gg_h5_has_attribute(h, "/checkpoint/version", "layout"))
    gg_h5_read_attribute(h, "/checkpoint/version", "layout", GG_ITEM_I64, &layout);
  if (gg_h5_has_attribute(h, "/checkpoint/version", "identity"))
    identity = gg_h5_read_text_attribute(h, "/checkpoint/version", "identity");
  bool same = identity && strcmp(identity, gg_base_build_identity) == 0;
  snprintf(why, sizeof why,
           "graingas %.40s (build %.20s, layout %lld) wrote it, and this is graingas %s (build %s, layout %d): %s",
           version, identity ? identity : "unknown", (long long)layout, gg_base_build_version, gg_base_build_identity,
           GG_CHECKPOINT_LAYOUT,
           layout != GG_CHECKPOINT_LAYOUT
               ? "only a checkpoint of the same layout can be resumed"
               : "numbers may differ; --accept-version (in programs accept_version) resumes it anyway");
  if (layout != GG_CHECKPOINT_LAYOUT || (!same && !any_build)) gg_h5_in_failed(h, why);
}

static void read_series(gg_h5_in *h, gg_stored_engine *e, const char *observables, const char *name)
{
  char path[160];
  size_t n_times;
  if (e->n_series == GG_MAX_STORED_SERIES) return;
  snprintf(path, sizeof path, "%s%s/value", observables, name);
  if (!gg_h5_exists(h, path)) return;
  gg_stored_series *s = &e->series[e->n_series++];
  snprintf(s->name, sizeof s->name, "%s", name);
  s->value = gg_h5_read_array(h, path, GG_ITEM_F64, &s->n);
  snprintf(path, sizeof path, "%s%s/time", observables, name);
  s->time = gg_h5_read_array(h, path, GG_ITEM_F64, &n_times);
  if (n_times < s->n) s->n = n_times;
}

static void read_correlations(gg_h5_in *h, gg_stored_engine *e, const char *group)
{
  char path[160];
  snprintf(path, sizeof path, "%s/correlations/quantities", group);
  if (!gg_h5_exists(h, path)) return;
  e->correlated = gg_h5_read_text(h, path);
  snprintf(path, sizeof path, "%s/correlations/coefficients", group);
  e->coefficients = gg_h5_read_array(h, path, GG_ITEM_F64, &e->n_coefficients);
}

static void read_engine(gg_h5_in *h, gg_stored_engine *e, const char *group, const char *observables)
{
  char path[160];
  size_t n = 0;
  snprintf(path, sizeof path, "%s/window", group);
  GG_FREED double *window = gg_h5_read_array(h, path, GG_ITEM_F64, &n);
  if (n == 2) memcpy(e->window, window, sizeof e->window);
  read_correlations(h, e, group);
  for (int q = 0; q < GG_N_QUANTITIES; q++) read_series(h, e, observables, gg_common_quantity_name((gg_quantity)q));
}

static void read_engines(gg_h5_in *h, gg_stored_result *s)
{
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const char *name = gg_common_engine_of(k)->name;
    gg_stored_engine *e = &s->engine[k];
    char group[64] = "/graingas", observables[64] = "/observables/";
    json_t *document = s->document;
    if (s->comparison) {
      document = json_object_get(s->document, name);
      snprintf(group, sizeof group, "/graingas/%s", name);
      snprintf(observables, sizeof observables, "/observables/%s_", name);
    } else {
      const char *engine = json_string_value(json_object_get(document, "engine"));
      if (!engine || strcmp(engine, name) != 0) continue;
    }
    if (!json_is_object(document)) continue;
    e->name = name;
    e->document = document;
    read_engine(h, e, group, observables);
  }
}

#define GRAINS "/particles/grains"

/* One row of numbers into its place. */
static void read_into(gg_h5_in *h, const char *path, uint64_t k, gg_item_type type, size_t items, void *place)
{
  GG_FREED void *row = gg_h5_read_row(h, path, k, type, items);
  if (row) memcpy(place, row, items * gg_base_archive_item_size(type));
}

/* The k-th frame; grains of dsmc have no positions, smooth ones no spins. */
static void read_frame(gg_h5_in *h, uint64_t k, gg_frame *f, double edges[9])
{
  read_into(h, GRAINS "/velocity/step", k, GG_ITEM_U64, 1, &f->step);
  read_into(h, GRAINS "/velocity/time", k, GG_ITEM_F64, 1, &f->time);
  if (gg_h5_exists(h, GRAINS "/position/value")) {
    f->position = gg_h5_read_row(h, GRAINS "/position/value", k, GG_ITEM_F64, 3 * f->n);
    read_into(h, GRAINS "/box/edges/value", k, GG_ITEM_F64, 9, edges);
  }
  f->velocity = gg_h5_read_row(h, GRAINS "/velocity/value", k, GG_ITEM_F64, 3 * f->n);
  if (gg_h5_exists(h, GRAINS "/spin/value"))
    f->spin = gg_h5_read_row(h, GRAINS "/spin/value", k, GG_ITEM_F64, 3 * f->n);
}

static void read_last_frame(gg_h5_in *h, gg_stored_result *s)
{
  size_t kinds = 0;
  double edges[9] = {0};
  if (!s->n_frames || !s->n_grains) return;
  s->last.n = s->n_grains;
  read_frame(h, GG_H5_LAST, &s->last, edges);
  for (int a = 0; a < 3; a++) s->edge[a] = edges[4 * a];
  s->last.species = gg_h5_read_array(h, GRAINS "/species", GG_ITEM_U8, &kinds);
  if (!h->failed && kinds != s->n_grains) gg_h5_in_failed(h, "some of its grains are of an unknown species");
}

/* It is shown to people. */
static char *read_line(gg_h5_in *h, const char *path)
{
  char *text = gg_h5_read_text(h, path);
  if (text) gg_base_text_make_printable(text);
  return text;
}

/* An open file, which is closed. */
static gg_status read_all(gg_stored_result *s, gg_h5_in *in, const char *path, gg_error *err)
{
  *s = (gg_stored_result){0};
  const bool checkpoint = !in->failed && gg_h5_exists(in, "/checkpoint");
  if (checkpoint) gg_files_checkpoint_check_version(in, true);
  if (checkpoint && !in->failed)
    gg_h5_in_failed(in, "it is a checkpoint: resume it with graingas run SCENE.yaml --resume FILE, or load it where a "
                        "simulation was saved");
  if (!in->failed && gg_h5_exists(in, "/graingas/table"))
    gg_h5_in_failed(in, "it is the table of a sweep, for h5py; the results are the files in the sweep's folder");
  if (!in->failed && !gg_h5_exists(in, "/graingas/document")) gg_h5_in_failed(in, "it holds no result of graingas");
  GG_FREED char *text = gg_h5_read_text(in, "/graingas/document");
  s->changed = in->changed;
  s->version = read_line(in, "/graingas/version");
  s->command = read_line(in, "/graingas/command");
  s->machine = read_line(in, "/graingas/machine");
  s->date = read_line(in, "/graingas/date");
  s->scene = gg_h5_read_text(in, "/graingas/scene");
  const char *why = "out of memory";
  s->document = text ? gg_files_document_read(text, &why) : NULL;
  if (!s->document) gg_h5_in_failed(in, why);
  if (!in->failed) {
    s->comparison = json_object_get(s->document, "comparison") != NULL;
    read_engines(in, s);
    s->n_frames = gg_h5_count_of(in, GRAINS "/velocity/step");
    s->n_grains = gg_h5_count_of(in, GRAINS "/id");
    read_last_frame(in, s);
  }
  gg_h5_in_close(in);
  gg_status status = gg_h5_in_status(in, path, err);
  if (status != GG_OK) gg_files_stored_result_clear(s);
  return status;
}

gg_status gg_files_stored_result_read(gg_stored_result *s, const char *path, gg_error *err)
{
  gg_h5_in in;
  gg_h5_open(&in, path, true);
  return read_all(s, &in, path, err);
}

gg_status gg_files_stored_result_from_bytes(gg_stored_result *s, const void *bytes, size_t size, gg_error *err)
{
  gg_h5_in in;
  gg_h5_open_bytes(&in, bytes, size);
  return read_all(s, &in, "the bytes", err);
}

gg_engine_kind gg_files_stored_first(const gg_stored_result *s)
{
  int k = 0;
  while (k < GG_N_ENGINES - 1 && !s->engine[k].name) k++;
  return (gg_engine_kind)k;
}

void gg_files_stored_result_clear(gg_stored_result *s)
{
  for (int k = 0; k < GG_N_ENGINES; k++) {
    free(s->engine[k].correlated);
    free(s->engine[k].coefficients);
    for (int i = 0; i < s->engine[k].n_series; i++) {
      free(s->engine[k].series[i].time);
      free(s->engine[k].series[i].value);
    }
  }
  free(s->version);
  free(s->command);
  free(s->machine);
  free(s->date);
  free(s->scene);
  json_decref(s->document);
  gg_measure_frame_free(&s->last);
  *s = (gg_stored_result){0};
}

const gg_stored_series *gg_files_stored_series_find(const gg_stored_engine *e, const char *name)
{
  for (int i = 0; i < e->n_series; i++)
    if (strcmp(e->series[i].name, name) == 0) return &e->series[i];
  return NULL;
}

/* True if the file's version is newer than this one: "0.2.0+g123" than "0.1.0". */
static bool is_newer(const char *version)
{
  int there[3] = {0}, here[3] = {0};
  sscanf(version, "%d.%d.%d", &there[0], &there[1], &there[2]);
  sscanf(gg_base_build_version, "%d.%d.%d", &here[0], &here[1], &here[2]);
  for (int i = 0; i < 3; i++)
    if (there[i] != here[i]) return there[i] > here[i];
  return false;
}

gg_status gg_files_stored_result_notice(const char *path, char *text, size_t size, gg_error *err)
{
  GG_CLEARED(gg_h5_in_close) gg_h5_in h = {.fd = -1};
  gg_h5_open(&h, path, true);
  GG_FREED char *version = gg_h5_exists(&h, "/graingas/version") ? read_line(&h, "/graingas/version") : NULL;
  *text = '\0';
  if (h.changed) gg_base_text_append(text, size, "another program has changed it since graingas wrote it");
  if (version && is_newer(version))
    gg_base_text_append(text, size, "%sgraingas %.40s wrote it, and this is %s: what is newer in it is not shown",
                        *text ? "; " : "", version, gg_base_build_version);
  return gg_h5_in_status(&h, path, err);
}

static void *read_of_each(gg_stored_trajectory *t, const char *path, gg_item_type type)
{
  size_t n = 0;
  void *data = gg_h5_read_array(&t->h, path, type, &n);
  if (data && n != t->n) gg_h5_in_failed(&t->h, "the species of some grains is unknown");
  return data;
}

static void read_kinds(gg_stored_trajectory *t)
{
  gg_h5_in *h = &t->h;
  t->n = gg_h5_count_of(h, GRAINS "/id");
  t->species = read_of_each(t, GRAINS "/species", GG_ITEM_U8);
  t->diameter = read_of_each(t, GRAINS "/diameter", GG_ITEM_F64);
  t->mass = read_of_each(t, GRAINS "/mass", GG_ITEM_F64);
  t->length_unit = gg_h5_read_text_attribute(h, GRAINS "/position", "unit");
  t->velocity_unit = gg_h5_read_text_attribute(h, GRAINS "/velocity", "unit");
  t->time_unit = gg_h5_read_text_attribute(h, GRAINS, "time_unit");
  if (gg_h5_exists(h, GRAINS "/spin")) t->spin_unit = gg_h5_read_text_attribute(h, GRAINS "/spin", "unit");
  gg_h5_read_attribute(h, GRAINS "/velocity", "shear_rate", GG_ITEM_F64, &t->shear_rate);
}

gg_status gg_files_stored_trajectory_open(gg_stored_trajectory *t, const char *path, gg_error *err)
{
  *t = (gg_stored_trajectory){.path = strdup(path)};
  if (!t->path) return gg_base_out_of_memory(err);
  gg_h5_open(&t->h, path, true);
  if (gg_h5_exists(&t->h, GRAINS "/position/value")) {
    t->n_frames = gg_h5_count_of(&t->h, GRAINS "/velocity/step");
    read_kinds(t);
    char letter[3] = ""; /* of "periodic" or "none" */
    gg_h5_read_initials(&t->h, GRAINS "/box", "boundary", letter, 3);
    for (size_t a = 0; a < 3; a++) t->periodic[a] = letter[a] == 'p';
  }
  return gg_h5_in_status(&t->h, path, err);
}

gg_status gg_files_stored_trajectory_frame(gg_stored_trajectory *t, size_t k, gg_frame *frame, double edges[9],
                                           gg_error *err)
{
  *frame = (gg_frame){.n = t->n};
  read_frame(&t->h, k, frame, edges);
  gg_status status = gg_h5_in_status(&t->h, t->path, err);
  if (status != GG_OK) gg_measure_frame_free(frame);
  return status;
}

void gg_files_stored_trajectory_close(gg_stored_trajectory *t)
{
  void *const all[] = {t->path,        t->species,       t->diameter,  t->mass,
                       t->length_unit, t->velocity_unit, t->spin_unit, t->time_unit};
  if (t->path) gg_h5_in_close(&t->h);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
  *t = (gg_stored_trajectory){0};
}
