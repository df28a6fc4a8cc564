#include "files/export/export.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/c_locale.h"
#include "base/memory.h"
#include "files/curve_table.h"
#include "files/export/csv_tables.h"
#include "files/export/xyz.h"

typedef enum gg_export_content { RESULTS, CURVE, NUMBERS, TRAJECTORY } gg_export_content;

typedef struct target {
  char *path;
  gg_export_content content;
  const json_t *curve;
  dev_t device; /* of the file that stands there */
  ino_t inode;  /* 0: none does */
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

/* Of an engine or a theory; `whose` is "" where there is but one. */
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
  for (int k = 0; k < 2; k++) {
    const gg_stored_engine *e = &j->stored->engine[k];
    if (e->name) add_curves_of(j, j->stored->comparison ? e->name : "", json_object_get(e->document, "curves"));
  }
  json_object_foreach(json_object_get(j->stored->document, GG_THEORY_CURVES), theory, curves)
      add_curves_of(j, theory, curves);
  if (gg_files_csv_numbers(NULL, j->stored))
    add(j, NUMBERS, NULL, (const char *const[]){"numbers", NULL, NULL}, ".csv");
}

static const char *lack(unsigned parts)
{
  return parts == GG_EXPORT_TRAJECTORY ? GG_NO_POSITIONS
         : parts == GG_EXPORT_CURVES   ? "it holds no curves"
                                       : "it holds neither curves nor positions of grains";
}

static gg_status plan(job *j, const char *path, unsigned parts, gg_error *err)
{
  static const char *const nothing[3];
  if (parts & GG_EXPORT_RESULTS) add(j, RESULTS, NULL, nothing, ".csv");
  if (parts & GG_EXPORT_CURVES) add_curves(j);
  if (parts & GG_EXPORT_TRAJECTORY) GG_TRY(gg_files_stored_trajectory_open(&j->trajectory, path, err));
  if (j->trajectory.n_frames) add(j, TRAJECTORY, NULL, nothing, ".xyz");
  if (j->failed) return gg_base_out_of_memory(err);
  return j->n ? GG_OK : gg_base_fail(err, GG_FAILED, "%s: nothing to export: %s", path, lack(parts));
}

/* Who names a device or a pipe wants all to go there, and nothing beside it: in /dev it would stay. */
static gg_status check_prefix(const char *prefix, gg_error *err)
{
  struct stat about;
  const bool in_dev = strncmp(prefix, "/dev/", 5) == 0 || strncmp(prefix, "/proc/", 6) == 0; /* /dev/stdout > file */
  if (stat(prefix, &about) != 0 || (!in_dev && S_ISREG(about.st_mode)) || S_ISDIR(about.st_mode)) return GG_OK;
  return gg_base_fail(err, GG_BAD_INPUT,
                      "%s: is a device or a pipe; tables and trajectories are files, whose names the prefix begins",
                      prefix);
}

/* What stands there already, which is to be one file for each. */
static gg_status look_at(job *j, size_t i, gg_error *err)
{
  gg_output_path place;
  target *t = &j->target[i];
  GG_TRY(gg_base_output_path_find(&place, t->path, err));
  if (place.there) t->device = place.about.st_dev, t->inode = place.about.st_ino;
  bool stream = place.stream;
  gg_base_output_path_clear(&place);
  if (stream)
    return gg_base_fail(err, GG_BAD_FILE, "%s: is a device or a pipe; tables and trajectories are files", t->path);
  for (const target *k = j->target; t->inode && k < t; k++)
    if (k->inode == t->inode && k->device == t->device)
      return gg_base_fail(err, GG_BAD_INPUT, "%s: would be the same file as %s; choose another prefix", t->path,
                          k->path);
  return GG_OK;
}

/* Of two that lead to one place where nothing stands yet, the second finds it locked. */
static gg_status open_target(job *j, size_t i, const char *path, gg_error *err)
{
  target *t = &j->target[i];
  if (gg_base_path_is_same_file(t->path, path))
    return gg_base_fail(err, GG_BAD_INPUT,
                        "%s: would be both the result and what is exported from it; choose another prefix", t->path);
  GG_TRY(look_at(j, i, err));
  return gg_base_atomic_open(&t->file, t->path, err);
}

static gg_status open_all(job *j, const char *path, gg_error *err)
{
  for (size_t i = 0; i < j->n; i++) GG_TRY(open_target(j, i, path, err));
  return GG_OK;
}

static gg_status write_trajectory(gg_stored_trajectory *t, gg_text_out *out, gg_error *err)
{
  double edges[9];
  gg_frame frame;
  for (size_t k = 0; k < t->n_frames && out->status == GG_OK; k++) {
    GG_TRY(gg_files_stored_trajectory_frame(t, k, &frame, edges, err));
    gg_files_xyz_frame(out, t, &frame, edges);
    gg_run_frame_free(&frame);
  }
  return GG_OK;
}

static gg_status write_target(job *j, target *t, gg_error *err)
{
  gg_text_out out;
  gg_status status = GG_OK;
  gg_base_file_writer_begin(&out, &t->file, err);
  if (t->content == CURVE) gg_files_csv_curve(&out, t->curve);
  if (t->content == NUMBERS) gg_files_csv_numbers(&out, j->stored);
  if (t->content == RESULTS && j->stored->comparison) gg_files_csv_comparison(&out, j->stored);
  if (t->content == RESULTS && !j->stored->comparison) gg_files_csv_results(&out, j->stored);
  if (t->content == TRAJECTORY) status = write_trajectory(&j->trajectory, &out, err);
  return status == GG_OK ? gg_base_file_writer_end(&out) : status;
}

/* None is put in place before all are written. */
static gg_status write_all(job *j, gg_error *err)
{
  gg_status status = GG_OK;
  locale_t before = gg_base_c_locale_enter();
  for (size_t i = 0; i < j->n && status == GG_OK; i++) status = write_target(j, &j->target[i], err);
  gg_base_c_locale_leave(before);
  for (size_t i = 0; i < j->n && status == GG_OK; i++) status = gg_base_atomic_commit(&j->target[i].file, err);
  return status;
}

static void clear(job *j)
{
  gg_files_stored_trajectory_close(&j->trajectory);
  for (size_t i = 0; i < j->n; i++) {
    gg_base_atomic_abandon(&j->target[i].file);
    free(j->target[i].path);
  }
  free(j);
}

gg_status gg_export_result(const gg_stored_result *stored, const char *path, const char *prefix, unsigned parts,
                           void (*written)(void *context, const char *file), void *context, gg_error *err)
{
  job *j = gg_base_array_new(1, sizeof *j, err);
  if (!j) return GG_FAILED;
  j->stored = stored, j->prefix = prefix;
  gg_status status = check_prefix(prefix, err);
  if (status == GG_OK) status = plan(j, path, parts, err);
  if (status == GG_OK) status = open_all(j, path, err);
  if (status == GG_OK) status = write_all(j, err);
  for (size_t i = 0; i < j->n && status == GG_OK && written; i++) written(context, j->target[i].path);
  clear(j);
  return status;
}
