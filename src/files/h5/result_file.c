/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/h5/result_file.h"

#include <errno.h>
#include <math.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "base/build.h"
#include "base/machine.h"
#include "base/memory.h"
#include "base/text.h"
#include "files/curve_table.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/particles.h"
#include "files/result_document.h"
#include "scene/fields.h"

static void write_h5md(gg_h5 *h)
{
  const int version[2] = {1, 1};
  struct passwd entry, *found = NULL;
  char buffer[4096];
  if (getpwuid_r(getuid(), &entry, buffer, sizeof buffer, &found) != 0) found = NULL;
  gg_h5_group(h, "/h5md/author");
  gg_h5_group(h, "/h5md/creator");
  gg_h5_attribute(h, "/h5md", "version", H5T_NATIVE_INT, version, 2);
  gg_h5_text_attribute(h, "/h5md/author", "name", found ? found->pw_name : "unknown");
  gg_h5_text_attribute(h, "/h5md/creator", "name", "graingas");
  gg_h5_text_attribute(h, "/h5md/creator", "version", gg_base_build_version);
}

/* "Linux 6.1.0 x86_64, Intel(R) Xeon(R) ..., 16 processors" */
static void describe_machine(char *text, size_t size)
{
  struct utsname system;
  char model[200];
  if (uname(&system) != 0) system = (struct utsname){.sysname = "unknown"};
  gg_base_machine_processor(model, sizeof model);
  snprintf(text, size, "%.64s %.64s %.64s, %s, %ld processors", system.sysname, system.release, system.machine, model,
           gg_base_machine_cores());
}

static void write_header(gg_h5 *h, const char *command, const gg_scene *scene, const char *document)
{
  char machine[480], date[32];
  gg_base_machine_date(date, sizeof date);
  describe_machine(machine, sizeof machine);
  write_h5md(h);
  gg_h5_text(h, "/graingas/version", gg_base_build_version);
  gg_h5_text(h, "/graingas/build", gg_base_build_identity);
  gg_h5_text(h, "/graingas/command", command);
  gg_h5_text(h, "/graingas/machine", machine);
  gg_h5_text(h, "/graingas/date", date);
  gg_h5_count(h, "/graingas/seed", scene->run.seed);
  char *yaml = gg_scene_yaml(scene);
  gg_h5_text(h, "/graingas/scene", yaml);
  free(yaml);
  gg_h5_text(h, "/graingas/document", document);
}

static void write_estimate(gg_h5 *h, const char *group, const gg_quantity_row *row, const gg_result *r)
{
  const gg_estimate *e = &r->value[row->quantity];
  const struct {
    const char *name;
    double value;
    const char *unit; /* NULL: that of the quantity, beside it */
  } numbers[] = {{"mean", e->mean, NULL},
                 {"stderr", e->error, NULL},
                 {"correlation_time", e->correlation_time, r->correlation_time_unit}};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    if (!isnan(numbers[i].value)) /* what cannot be had is not there */
      gg_h5_number(h, gg_h5_path(h, "%s/results/%s/%s", group, row->name, numbers[i].name), numbers[i].value,
                   numbers[i].unit);
  gg_h5_count(h, gg_h5_path(h, "%s/results/%s/samples", group, row->name), e->samples);
  gg_h5_text(h, gg_h5_path(h, "%s/results/%s/unit", group, row->name), row->unit);
  gg_h5_text_attribute(h, gg_h5_path(h, "%s/results/%s", group, row->name), "doc", row->doc);
}

/* A table, and the names of its rows, which are those of its columns, a line each. */
static void write_correlations(gg_h5 *h, const char *group, const gg_result *r)
{
  const gg_correlations *c = &r->correlations;
  const hsize_t size[] = {c->n, c->n};
  char *names = NULL;
  if (!c->n) return;
  FILE *out = gg_base_memory_stream_open(&names);
  for (size_t i = 0; out && i < c->n; i++) fprintf(out, "%s\n", gg_run_rows_at(&r->rows, c->quantity[i])->name);
  gg_h5_array(h, gg_h5_path(h, "%s/correlations/coefficients", group), H5T_NATIVE_DOUBLE, 2, size, c->coefficient);
  gg_base_memory_stream_close(out, &names);
  gg_h5_text(h, gg_h5_path(h, "%s/correlations/quantities", group), names);
  free(names);
}

static void write_effort(gg_h5 *h, const char *group, const char *name, const gg_effort *effort)
{
  gg_h5_count(h, gg_h5_path(h, "%s/%s/collisions", group, name), effort->collisions);
  gg_h5_number(h, gg_h5_path(h, "%s/%s/cpu_seconds", group, name), effort->cpu_seconds, NULL);
}

static void write_times(gg_h5 *h, const char *group, const gg_history *history)
{
  const hsize_t n = history->n;
  int64_t *step = malloc((history->n + 1) * sizeof *step);
  for (size_t i = 0; step && i < history->n; i++) step[i] = (int64_t)i + 1;
  gg_h5_array(h, gg_h5_path(h, "%s/step", group), H5T_NATIVE_INT64, 1, &n, step);
  free(step);
  gg_h5_numbers(h, gg_h5_path(h, "%s/time", group), history->time, history->n, NULL);
}

/* Times are the same for every observable: written once, linked from the others. */
static void write_series(gg_h5 *h, const char *observables, const gg_result *r, int k, char *first, size_t size)
{
  const gg_quantity_row *row = gg_run_rows_at(&r->rows, gg_common_quantity_of_history(k));
  char group[120];
  snprintf(group, sizeof group, "%s%s", observables, row->name);
  gg_h5_numbers(h, gg_h5_path(h, "%s/value", group), r->history.value[k], r->history.n, row->unit);
  gg_h5_text_attribute(h, group, "doc", row->doc);
  if (*first) {
    gg_h5_link(h, gg_h5_path(h, "%s/step", first), gg_h5_path(h, "%s/step", group));
    gg_h5_link(h, gg_h5_path(h, "%s/time", first), gg_h5_path(h, "%s/time", group));
    return;
  }
  write_times(h, group, &r->history);
  snprintf(first, size, "%s", group);
}

static bool has_values(const gg_history *history, int k)
{
  for (size_t i = 0; history->value[k] && i < history->n; i++)
    if (!isnan(history->value[k][i])) return true;
  return false;
}

static void write_warnings(gg_h5 *h, const char *group, const gg_result *r)
{
  char *text = NULL;
  FILE *out = gg_base_memory_stream_open(&text);
  for (size_t i = 0; out && i < r->warnings.n; i++) fprintf(out, "%s\n", r->warnings.text[i]);
  gg_base_memory_stream_close(out, &text);
  gg_h5_text(h, gg_h5_path(h, "%s/warnings", group), text);
  free(text);
}

static void write_curve_numbers(gg_h5 *h, const char *base, const gg_curve *c)
{
  for (int i = 0; i < c->n_numbers; i++) {
    const gg_curve_number *p = &c->number[i];
    if (!isfinite(p->value)) continue; /* what cannot be had is not there */
    gg_h5_number(h, gg_h5_path(h, "%s/numbers/%s/mean", base, p->name), p->value, p->unit);
    if (isfinite(p->error)) gg_h5_number(h, gg_h5_path(h, "%s/numbers/%s/stderr", base, p->name), p->error, p->unit);
  }
}

static void write_curve(gg_h5 *h, const char *group, const gg_curve *c)
{
  char base[160];
  snprintf(base, sizeof base, "%s/curves/%s", group, c->name);
  gg_h5_numbers(h, gg_h5_path(h, "%s/x", base), c->x, c->n, c->x_unit);
  gg_h5_numbers(h, gg_h5_path(h, "%s/value", base), c->value, c->n, c->unit);
  gg_h5_numbers(h, gg_h5_path(h, "%s/stderr", base), c->error, c->n, c->unit);
  if (c->reference) {
    const char *path = gg_h5_path(h, "%s/reference", base);
    gg_h5_numbers(h, path, c->reference, c->n, c->unit);
    gg_h5_text_attribute(h, path, "label", c->reference_label);
  }
  gg_h5_text_attribute(h, base, "group", c->group);
  gg_h5_text_attribute(h, base, "x", c->x_name);
  gg_h5_text_attribute(h, base, "value", c->y_name);
  if (c->folded) gg_h5_text_attribute(h, base, "folded", "yes");
  gg_h5_attribute(h, base, "samples", H5T_NATIVE_UINT64, &c->samples, 0);
  write_curve_numbers(h, base, c);
}

static void write_curves(gg_h5 *h, const char *group, const gg_curves *curves)
{
  for (int k = 0; k < curves->n; k++) write_curve(h, group, &curves->curve[k]);
}

/* `observables` is what the names of its series begin with: "/observables/md_". */
static void write_engine(gg_h5 *h, const char *group, const char *observables, const gg_result *r)
{
  static const char *const verdicts[] = {
      [GG_STEADY] = "steady", [GG_METASTABLE] = "metastable", [GG_NOT_STEADY] = "not steady", [GG_HEATING] = "heating"};
  char first[120] = "";
  gg_h5_group(h, gg_h5_path(h, "%s/results", group));
  for (int i = 0; i < r->rows.n; i++)
    if (gg_files_quantity_is_measured(&r->value[r->rows.row[i].quantity])) write_estimate(h, group, &r->rows.row[i], r);
  write_correlations(h, group, r);
  gg_h5_text(h, gg_h5_path(h, "%s/engine", group), r->engine);
  const char *verdict = gg_h5_path(h, "%s/verdict", group);
  gg_h5_text(h, verdict, gg_scene_is_followed(r->scene) ? "followed" : verdicts[r->steadiness]);
  gg_h5_text_attribute(h, verdict, "why", r->steadiness_text);
  gg_h5_numbers(h, gg_h5_path(h, "%s/window", group), r->history.window, 2, NULL);
  write_effort(h, group, "averaging", &r->averaging);
  write_effort(h, group, "total", &r->total);
  write_warnings(h, group, r);
  for (int k = 0; k < GG_N_HISTORY; k++)
    if (has_values(&r->history, k)) write_series(h, observables, r, k, first, sizeof first);
  write_curves(h, group, &r->curves);
}

static void write_answers(gg_h5 *h, const char *group, const gg_quantity_rows *rows, const gg_theory_answer *a)
{
  for (int k = 0; k < rows->n; k++) {
    const gg_quantity_row *row = &rows->row[k];
    const double value = a->value[row->quantity], error = a->error[row->quantity];
    if (!isfinite(value)) continue;
    gg_h5_number(h, gg_h5_path(h, "%s/%s/mean", group, row->name), value, NULL);
    if (isfinite(error)) gg_h5_number(h, gg_h5_path(h, "%s/%s/error", group, row->name), error, NULL);
    gg_h5_text(h, gg_h5_path(h, "%s/%s/unit", group, row->name), row->unit);
  }
}

static void write_theories(gg_h5 *h, const gg_comparison *c)
{
  char group[96];
  for (int i = 0; i < c->n_theories; i++) {
    if (!c->theory[i].applies) continue;
    snprintf(group, sizeof group, "/graingas/theory/%s", c->theory[i].theory->name);
    gg_h5_group(h, group);
    gg_h5_text_attribute(h, group, "citation", c->theory[i].theory->citation);
    write_answers(h, group, &c->rows, &c->theory[i].answer);
    write_curves(h, group, &c->theory[i].curves);
  }
}

typedef struct gg_result_writer {
  bool streaming; /* frames go to the disk as they come; otherwise the file is made in memory */
  gg_h5 h;
  gg_h5_particles particles;
} gg_result_writer;

gg_status gg_files_result_file_open(gg_result_file *f, const char *path, const char *command, gg_error *err)
{
  *f = (gg_result_file){.file = GG_ATOMIC_NONE, .command = command, .in_memory = !path};
  return path ? gg_io_atomic_open(&f->file, path, false, err) : GG_OK;
}

static void forget(gg_result_file *f)
{
  gg_result_writer *w = f->now;
  f->now = NULL;
  if (!w) return;
  gg_h5_particles_close(&w->h, &w->particles);
  if (w->h.file >= 0) gg_h5_close(&w->h);
  free(w);
}

void gg_files_result_file_abandon(gg_result_file *f)
{
  forget(f);
  gg_io_atomic_abandon(&f->file);
}

/* On the disk under its temporary name, or in memory: what is small, and what goes to a device or pipe. */
static gg_status create(gg_result_file *f, bool streaming, gg_error *err)
{
  if (f->now) return GG_OK;
  gg_result_writer *w = gg_base_array_new(1, sizeof *w, err);
  if (!w) {
    gg_files_result_file_abandon(f);
    return GG_FAILED;
  }
  w->streaming = streaming;
  w->particles.single = f->scene && f->scene->output.precision == GG_SINGLE;
  w->particles.left_out = f->scene ? GG_FIELDS_ALL & ~f->scene->output.fields : 0;
  gg_h5_create(&w->h, streaming ? f->file.temporary : NULL);
  w->h.stop = f->stop;
  f->now = w;
  return GG_OK;
}

/* HDF5 recovers badly from a full disk: ask first. */
static gg_status check_room(const gg_result_file *f, const gg_frame *frame, gg_error *err)
{
  struct statvfs disk;
  double needed = 2.0 * (double)frame->n * 9 * sizeof(double) + (1 << 22);
  if (f->file.place.stream) return GG_OK;
  if (fstatvfs(f->file.fd, &disk) == 0 && (double)disk.f_bavail * (double)disk.f_frsize < needed)
    return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: %s", f->file.path, strerror(ENOSPC));
  return GG_OK;
}

gg_status gg_files_result_file_frame(gg_result_file *f, const gg_model *model, const gg_frame *frame, gg_error *err)
{
  GG_TRY(check_room(f, frame, err));
  GG_TRY(create(f, !f->file.place.stream, err));
  gg_h5_particles_append(&f->now->h, &f->now->particles, model, frame);
  return gg_h5_status(&f->now->h, f->file.path, "written", err);
}

/* HDF5 wrote it, in an order of its own: it is read once for its checksum. */
static gg_status append_trailer(gg_result_file *f, gg_error *err)
{
  unsigned char trailer[GG_TRAILER_SIZE];
  if (gg_files_checksum_trailer_of_file(f->file.fd, trailer) != 0 || lseek(f->file.fd, 0, SEEK_END) < 0)
    return gg_io_path_write_error(f->file.path, strerror(errno), err);
  return gg_io_atomic_write(&f->file, trailer, sizeof trailer, err);
}

/* Close what was streamed, or write what was made in memory; then put it in place. */
static gg_status finish(gg_result_file *f, gg_error *err)
{
  gg_result_writer *w = f->now;
  gg_h5_particles_close(&w->h, &w->particles);
  size_t size = 0;
  void *image = w->streaming ? NULL : gg_h5_image(&w->h, &size);
  gg_h5_close(&w->h);
  gg_status status = gg_h5_status(&w->h, f->in_memory ? "the result" : f->file.path, "written", err);
  if (status == GG_OK && f->in_memory) {
    f->bytes = image ? gg_files_checksum_trailer_append(image, size, err) : NULL;
    f->size = size + GG_TRAILER_SIZE;
    forget(f);
    return f->bytes ? GG_OK : GG_FAILED;
  }
  if (status == GG_OK)
    status =
        w->streaming ? append_trailer(f, err) : gg_files_checksum_trailer_write(&f->file, image, size, f->stop, err);
  free(image);
  forget(f);
  if (status == GG_OK && f->stop && gg_stop_asked(f->stop))
    status = gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted", f->file.path);
  return gg_io_atomic_commit(&f->file, status, err);
}

static void write_document(gg_result_file *f, const gg_scene *scene, json_t *document)
{
  char *text = document ? gg_files_document_text(document) : NULL;
  write_header(&f->now->h, f->command, scene, text);
  free(text);
  json_decref(document);
}

static void write_last_frame(gg_result_file *f, const gg_result *r)
{
  gg_result_writer *w = f->now;
  if (r->scene->output.after == GG_AFTER_WARMUP) gg_h5_particles_drop(&w->h, &w->particles, r->window_step);
  bool fresh = !w->particles.started || r->final.step > w->particles.last_step;
  if (r->final.n && r->final.velocity && fresh) gg_h5_particles_append(&w->h, &w->particles, &r->model, &r->final);
}

gg_status gg_files_result_file_finish_run(gg_result_file *f, const gg_result *result, gg_error *err)
{
  f->scene = result->scene;
  GG_TRY(create(f, false, err));
  write_document(f, result->scene, gg_files_run_document(result));
  gg_h5_text_attribute(&f->now->h, "/graingas", "kind", "run");
  write_engine(&f->now->h, "/graingas", "/observables/", result);
  write_last_frame(f, result);
  return finish(f, err);
}

gg_status gg_files_result_file_finish_comparison(gg_result_file *f, const gg_comparison *c, gg_error *err)
{
  const gg_result *first = gg_run_comparison_first(c);
  f->scene = c->scene;
  GG_TRY(create(f, false, err));
  write_document(f, c->scene, gg_files_comparison_document(c));
  gg_h5_text_attribute(&f->now->h, "/graingas", "kind", "compare");
  for (int k = 0; k < GG_N_ENGINES; k++) {
    char group[64], observables[64];
    snprintf(group, sizeof group, "/graingas/%s", gg_common_engine_of(k)->name);
    snprintf(observables, sizeof observables, "/observables/%s_", gg_common_engine_of(k)->name);
    if (c->by_engine[k]) write_engine(&f->now->h, group, observables, c->by_engine[k]);
  }
  write_theories(&f->now->h, c);
  if (first) write_last_frame(f, first);
  return finish(f, err);
}
