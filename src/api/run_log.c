/* SPDX-License-Identifier: GPL-3.0-or-later */
/* output.log: a row for each sample of the first replica, appended during the run. A checkpoint holds the number of the
 * last row and the sums of the means, so that a resumed run cuts later rows and continues the same file. */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "api/run.h"
#include "base/memory.h"
#include "base/text.h"
#include "run/replica.h"
#include "run/series_means.h"

static const char state_item[] = "log/state", sums_item[] = "log/sums";
static const char csv_begins[] = "sample,time,", json_begins[] = "{\"sample\": ";

/* Number of the sample of a line; 0 for the line of column names. */
static uint64_t sample_of(const char *line, bool json)
{
  return strtoull(line + (json && strncmp(line, json_begins, strlen(json_begins)) == 0 ? strlen(json_begins) : 0), NULL,
                  10);
}

static gg_status write_error(const gg_sample_log *log, gg_error *err)
{
  return gg_io_path_write_error(log->path, strerror(errno), err);
}

/* Reject a file that is not a log: a scene of unknown origin could name any file. */
static gg_status check_is_log(const gg_sample_log *log, gg_error *err)
{
  const char *begins = log->json ? json_begins : csv_begins;
  char there[16] = "";
  const ssize_t n = pread(log->fd, there, strlen(begins), 0);
  if (n < 0) return write_error(log, err);
  if (n == 0 || strcmp(there, begins) == 0) return GG_OK;
  return gg_io_path_write_error(log->path, "it is there, and no log of a run: remove it, or choose another name", err);
}

/* Bytes of the complete rows up to this sample, and the number of rows of samples among them. */
static off_t bytes_up_to(const gg_sample_log *log, uint64_t sample, uint64_t *rows)
{
  GG_FREED char *line = NULL;
  size_t size = 0;
  off_t end = 0;
  const int fd = sample ? dup(log->fd) : -1;
  GG_CLOSED FILE *in = fd >= 0 ? fdopen(fd, "r") : NULL;
  if (in) rewind(in);
  for (ssize_t n; in && (n = getline(&line, &size, in)) > 0 && line[n - 1] == '\n'; end += n) {
    const uint64_t at = sample_of(line, log->json);
    if (at > sample) break;
    *rows += at > 0;
  }
  return end;
}

/* Cut the file after the last complete row up to this sample; 0: cut everything. */
static gg_status cut(const gg_sample_log *log, uint64_t sample, gg_error *err)
{
  return ftruncate(log->fd, bytes_up_to(log, sample, &(uint64_t){0})) == 0 ? GG_OK : write_error(log, err);
}

static gg_status append(const gg_sample_log *log, const char *text, size_t size, gg_error *err)
{
  while (size > 0) {
    const ssize_t n = write(log->fd, text, size);
    if (n < 0 && errno != EINTR) return write_error(log, err);
    if (n > 0) text += n, size -= (size_t)n;
  }
  return GG_OK;
}

static void put_number(FILE *out, const gg_sample_log *log, const char *name, const char *end, double x)
{
  if (log->json) fprintf(out, ", \"%s%s\": ", name, end);
  if (!log->json) fputc(',', out);
  if (isfinite(x)) fprintf(out, "%.9g", x);
  if (!isfinite(x) && log->json) fputs("null", out);
}

static void put_names(FILE *out, const gg_quantity *list, int n, bool temperature)
{
  fprintf(out, "%stime,collisions_per_grain,averaging%s", "sample,", temperature ? ",temperature" : "");
  for (int i = 0; i < n; i++) fprintf(out, ",%s", gg_common_quantity_name(list[i]));
  for (int i = 0; i < n; i++) fprintf(out, ",%s_mean", gg_common_quantity_name(list[i]));
  fputc('\n', out);
}

/* Write a row: values of the interval before the sample, and means over the averaging window so far. The columns are
 * those of the start. If a protocol changes the gas, quantities that it no longer has are empty. */
static void put_row(FILE *out, const gg_sample_log *log, const gg_model *start, const gg_replica *r)
{
  gg_quantity list[GG_N_QUANTITIES];
  gg_function f;
  const int n = gg_run_headline_quantities(start, list);
  const bool temperature = !gg_model_keeps_temperature(start);
  if (!log->json && lseek(log->fd, 0, SEEK_END) == 0) put_names(out, list, n, temperature);
  fprintf(out, "%s%llu", log->json ? json_begins : "", (unsigned long long)r->clock.samples);
  put_number(out, log, "time", "", r->clock.time);
  put_number(out, log, "collisions_per_grain", "", gg_run_replica_collisions_per_grain(r));
  put_number(out, log, "averaging", "", r->clock.averaging ? 1 : 0);
  if (temperature) put_number(out, log, "temperature", "", ldexp(r->clock.temperature, -2 * (int)r->clock.power));
  for (int mean = 0; mean < 2; mean++)
    for (int i = 0; i < n; i++) {
      const int k = gg_measure_sampler_find(&r->sampler, list[i], &f);
      double x = NAN;
      if (k >= 0 && (!mean || log->state.rows))
        x = gg_function_value(f, (mean ? log->mean : r->sampler.row) + r->sampler.offset[k], &r->model);
      put_number(out, log, gg_common_quantity_name(list[i]), mean ? "_mean" : "", x);
    }
  fputs(log->json ? "}\n" : "\n", out);
}

static gg_status add_to_sums(gg_sample_log *log, const gg_replica *r, gg_error *err)
{
  const size_t width = r->series.width;
  if (log->width != width) {
    free(log->sum);
    log->state.rows = 0;
    log->sum = gg_base_array_new(2 * width + 2, sizeof *log->sum, err);
    if (!log->sum) return GG_FAILED;
    log->width = width;
  }
  log->mean = log->sum + width + 1;
  if (!r->clock.averaging) return GG_OK;
  if (r->clock.window_samples == 1) {
    log->state.rows = 0;
    memset(log->sum, 0, width * sizeof *log->sum);
  }
  log->state.rows++;
  for (size_t i = 0; i < width; i++) {
    log->sum[i] += r->sampler.row[i];
    log->mean[i] = log->sum[i] / (double)log->state.rows;
  }
  return GG_OK;
}

static gg_status log_sample(void *context, const gg_replica *r, gg_error *err)
{
  gg_sample_log *log = &((gg_api_run_call *)context)->samples;
  GG_FREED char *text = NULL;
  size_t size = 0;
  GG_TRY(add_to_sums(log, r, err));
  if (r->clock.samples <= log->state.sample)
    GG_TRY(cut(log, r->clock.samples - 1, err)); /* the replica was restarted after a collapse */
  FILE *out = open_memstream(&text, &size);
  if (!out) return gg_base_out_of_memory(err);
  put_row(out, log, &((const gg_api_run_call *)context)->model, r);
  log->state.sample = r->clock.samples;
  return fclose(out) == 0 ? append(log, text, size, err) : gg_base_out_of_memory(err);
}

/* Restore the sums. A run that kept no log stored none; its means begin at the resumption. */
static gg_status restore(gg_sample_log *log, const gg_archive *a, gg_error *err)
{
  const gg_item *sums = gg_base_archive_find(a, sums_item);
  if (!sums || gg_base_archive_get(a, state_item, GG_ITEM_U8, &log->state, sizeof log->state, NULL) != GG_OK)
    return GG_OK;
  log->width = sums->count;
  log->sum = gg_base_array_new(2 * log->width + 2, sizeof *log->sum, err);
  return log->sum ? gg_base_archive_get(a, sums_item, GG_ITEM_F64, log->sum, log->width, err) : GG_FAILED;
}

static gg_status open_file(gg_sample_log *log, const char *path, gg_error *err)
{
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  GG_TRY(gg_io_output_path_find(&place, path, err));
  if (place.stream) return gg_io_path_write_error(path, "it is a device or a pipe; logs are files", err);
  GG_TRY(gg_io_file_lock_take(&log->lock, place.target, path, err));
  log->fd = open(place.target, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
  return log->fd < 0 ? write_error(log, err) : GG_OK;
}

gg_status gg_api_log_name(gg_api_run_call *r, gg_error *err)
{
  const char *name = r->scene.output.log, *output = r->options.output;
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  if (!*name) return GG_OK;
  if (output) GG_TRY(gg_io_output_path_find(&place, output, err));
  const char *slash = output && *name != '/' && !place.stream ? strrchr(output, '/') : NULL;
  if (asprintf(&r->samples.path, "%.*s%s", slash ? (int)(slash - output) + 1 : 0, output ? output : "", name) < 0)
    r->samples.path = NULL;
  return r->samples.path ? GG_OK : gg_base_out_of_memory(err);
}

/* Warn before the rows of an earlier run are replaced, so that a command repeated by mistake can be stopped. */
static void warn_of_replacing(const gg_api_run_call *r)
{
  const gg_sample_log *log = &r->samples;
  uint64_t n = 0;
  GG_FREED char *text = NULL;
  if (r->options.warn && log->state.sample == 0) bytes_up_to(log, UINT64_MAX, &n);
  if (n == 0) return;
  if (asprintf(&text, "%s holds %" PRIu64 " rows of an earlier run, and is replaced", log->path, n) < 0) return;
  gg_base_text_make_printable(text);
  r->options.warn(r->options.context, text);
}

gg_status gg_api_log_begin(gg_api_run_call *r, gg_error *err)
{
  gg_sample_log *log = &r->samples;
  if (!log->path || r->comparison) return GG_OK;
  const char *ending = strrchr(log->path, '.');
  log->json = ending && strcmp(ending, ".jsonl") == 0;
  GG_TRY(open_file(log, log->path, err));
  GG_TRY(check_is_log(log, err));
  GG_TRY(restore(log, &r->resume, err));
  r->callbacks.sample = log_sample;
  warn_of_replacing(r);
  return cut(log, log->state.sample, err);
}

gg_status gg_api_log_mark(const gg_api_run_call *r, gg_archive *a, gg_error *err)
{
  const gg_sample_log *log = &r->samples;
  if (log->fd < 0 || !log->sum) return GG_OK;
  GG_TRY(gg_base_archive_put(a, state_item, GG_ITEM_U8, &log->state, sizeof log->state, err));
  return gg_base_archive_put(a, sums_item, GG_ITEM_F64, log->sum, log->width, err);
}

void gg_api_log_end(gg_api_run_call *r)
{
  if (r->samples.fd >= 0) close(r->samples.fd);
  free(r->samples.sum);
  free(r->samples.path);
  gg_io_file_lock_release(&r->samples.lock);
}
