/* The groups of a result file. */
#include <math.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include "base/memory_stream.h"
#include "files/curve_table.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/result_file.h"
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
  gg_h5_ints_attribute(h, "/h5md", "version", version, 2);
  gg_h5_text_attribute(h, "/h5md/author", "name", found ? found->pw_name : "unknown");
  gg_h5_text_attribute(h, "/h5md/creator", "name", "graingas");
  gg_h5_text_attribute(h, "/h5md/creator", "version", GG_VERSION);
}

/* "Linux 6.1.0 x86_64, Intel(R) Xeon(R) ..., 16 processors" */
static void describe_machine(char *text, size_t size)
{
  struct utsname system;
  char line[256], model[200] = "unknown processor";
  if (uname(&system) != 0) system = (struct utsname){.sysname = "unknown"};
  FILE *in = fopen("/proc/cpuinfo", "r");
  while (in && fgets(line, sizeof line, in))
    if (sscanf(line, "model name : %199[^\n]", model) == 1) break;
  if (in) fclose(in);
  snprintf(text, size, "%.64s %.64s %.64s, %s, %ld processors", system.sysname, system.release, system.machine, model,
           sysconf(_SC_NPROCESSORS_ONLN));
}

void gg_h5_write_header(gg_h5 *h, const char *command, const gg_scene *scene, const char *document)
{
  char machine[480], date[32];
  time_t now = time(NULL);
  struct tm utc;
  strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
  describe_machine(machine, sizeof machine);
  write_h5md(h);
  gg_h5_text(h, "/graingas/version", GG_VERSION);
  gg_h5_text(h, "/graingas/command", command);
  gg_h5_text(h, "/graingas/machine", machine);
  gg_h5_text(h, "/graingas/date", date);
  gg_h5_count(h, "/graingas/seed", scene->run.seed);
  char *yaml = gg_scene_yaml(scene);
  if (yaml)
    gg_h5_text(h, "/graingas/scene", yaml);
  else
    gg_h5_failed(h, "out of memory");
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
  char path[160];
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    if (isnan(numbers[i].value)) continue; /* what cannot be had is not there */
    snprintf(path, sizeof path, "%s/results/%s/%s", group, row->name, numbers[i].name);
    gg_h5_number(h, path, numbers[i].value);
    if (numbers[i].unit) gg_h5_text_attribute(h, path, "unit", numbers[i].unit);
  }
  snprintf(path, sizeof path, "%s/results/%s/samples", group, row->name);
  gg_h5_count(h, path, e->samples);
  snprintf(path, sizeof path, "%s/results/%s/unit", group, row->name);
  gg_h5_text(h, path, row->unit);
  snprintf(path, sizeof path, "%s/results/%s", group, row->name);
  gg_h5_text_attribute(h, path, "doc", row->doc);
}

static void write_effort(gg_h5 *h, const char *group, const char *name, const gg_effort *effort)
{
  char path[160];
  snprintf(path, sizeof path, "%s/%s/collisions", group, name);
  gg_h5_count(h, path, effort->collisions);
  snprintf(path, sizeof path, "%s/%s/cpu_seconds", group, name);
  gg_h5_number(h, path, effort->cpu_seconds);
}

/* Times are the same for every observable: written once, linked from the others. */
static void write_series(gg_h5 *h, const char *observables, const gg_result *r, int k, char *first, size_t size)
{
  const gg_history *history = &r->history;
  const gg_quantity_row *row = gg_run_rows_at(&r->rows, gg_common_quantity_of_history(k));
  hsize_t n = history->n;
  char group[120], path[160], target[160];
  snprintf(group, sizeof group, "%s%s", observables, row->name);
  snprintf(path, sizeof path, "%s/value", group);
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &n, history->value[k]);
  gg_h5_text_attribute(h, path, "unit", row->unit);
  gg_h5_text_attribute(h, group, "doc", row->doc);
  if (*first) {
    snprintf(path, sizeof path, "%s/step", group);
    snprintf(target, sizeof target, "%s/step", first);
    gg_h5_link(h, target, path);
    snprintf(path, sizeof path, "%s/time", group);
    snprintf(target, sizeof target, "%s/time", first);
    gg_h5_link(h, target, path);
    return;
  }
  int64_t *step = malloc((history->n + 1) * sizeof *step);
  for (size_t i = 0; step && i < history->n; i++) step[i] = (int64_t)i + 1;
  snprintf(path, sizeof path, "%s/step", group);
  if (step)
    gg_h5_array(h, path, H5T_NATIVE_INT64, 1, &n, step);
  else
    gg_h5_failed(h, "out of memory");
  free(step);
  snprintf(path, sizeof path, "%s/time", group);
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &n, history->time);
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
  char *text = NULL, path[160];
  FILE *out = gg_base_memory_stream_open(&text);
  for (size_t i = 0; out && i < r->warnings.n; i++) fprintf(out, "%s\n", r->warnings.text[i]);
  snprintf(path, sizeof path, "%s/warnings", group);
  if (gg_base_memory_stream_close(out, &text))
    gg_h5_text(h, path, text);
  else
    gg_h5_failed(h, "out of memory");
  free(text);
}

void gg_h5_write_engine(gg_h5 *h, const char *group, const char *observables, const gg_result *r)
{
  static const char *const verdicts[] = {
      [GG_STEADY] = "steady", [GG_NOT_STEADY] = "not steady", [GG_HEATING] = "heating"};
  char path[160], first[120] = "";
  snprintf(path, sizeof path, "%s/results", group);
  gg_h5_group(h, path);
  for (int i = 0; i < r->rows.n; i++)
    if (gg_files_quantity_is_measured(&r->value[r->rows.row[i].quantity])) write_estimate(h, group, &r->rows.row[i], r);
  snprintf(path, sizeof path, "%s/engine", group);
  gg_h5_text(h, path, r->engine);
  snprintf(path, sizeof path, "%s/verdict", group);
  gg_h5_text(h, path, verdicts[r->steadiness]);
  gg_h5_text_attribute(h, path, "why", r->steadiness_text);
  const hsize_t two = 2;
  snprintf(path, sizeof path, "%s/window", group);
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &two, r->history.window);
  write_effort(h, group, "averaging", &r->averaging);
  write_effort(h, group, "total", &r->total);
  write_warnings(h, group, r);
  for (int k = 0; k < GG_N_HISTORY; k++)
    if (has_values(&r->history, k)) write_series(h, observables, r, k, first, sizeof first);
  gg_h5_write_curves(h, group, &r->curves);
}

static void write_numbers(gg_h5 *h, const char *group, const gg_quantity_rows *rows, const gg_theory_answer *a)
{
  char path[160];
  for (int k = 0; k < rows->n; k++) {
    const gg_quantity_row *row = &rows->row[k];
    const double value = a->value[row->quantity], error = a->error[row->quantity];
    if (!isfinite(value)) continue;
    snprintf(path, sizeof path, "%s/%s/mean", group, row->name);
    gg_h5_number(h, path, value);
    snprintf(path, sizeof path, "%s/%s/error", group, row->name);
    if (isfinite(error)) gg_h5_number(h, path, error);
    snprintf(path, sizeof path, "%s/%s/unit", group, row->name);
    gg_h5_text(h, path, row->unit);
  }
}

void gg_h5_write_theories(gg_h5 *h, const gg_comparison *c)
{
  char group[96];
  for (int i = 0; i < c->n_theories; i++) {
    if (!c->theory[i].applies) continue;
    snprintf(group, sizeof group, "/graingas/theory/%s", c->theory[i].theory->name);
    gg_h5_group(h, group);
    gg_h5_text_attribute(h, group, "citation", c->theory[i].theory->citation);
    write_numbers(h, group, &c->rows, &c->theory[i].answer);
    gg_h5_write_curves(h, group, &c->theory[i].curves);
  }
}
