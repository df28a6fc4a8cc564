/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results: quantities, curves and grains; to and from files and documents; pictures and tables of files. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/memory.h"
#include "base/text.h"
#include "files/export.h"
#include "files/h5/result_file.h"
#include "files/h5/result_restore.h"
#include "files/result_document.h"
#include "plot/plot.h"

static gg_measurement measurement(const gg_result *r, const gg_quantity_row *row)
{
  const gg_estimate *e = &r->value[row->quantity];
  return (gg_measurement){.name = row->name,
                          .mean = e->mean,
                          .error = e->error,
                          .correlation_time = e->correlation_time,
                          .samples = e->samples,
                          .unit = row->unit,
                          .reason = isnan(e->mean) ? e->reason : NULL,
                          .correlation_time_unit = r->correlation_time_unit,
                          .symbol = *row->symbol ? row->symbol : NULL};
}

gg_status gg_result_find(const gg_result *result, const char *quantity, gg_measurement *found, gg_error *err)
{
  GG_NEED(result, quantity, found);
  const gg_quantity_row *row;
  GG_TRY(gg_api_row_find(&result->rows, quantity, &row, err));
  *found = measurement(result, row);
  return GG_OK;
}

gg_status gg_result_at(const gg_result *result, size_t i, gg_measurement *found, gg_error *err)
{
  GG_NEED(result, found);
  const gg_quantity_rows *rows = &result->rows;
  if (i >= (size_t)rows->n) return GG_REFUSE(err, "gg_result_at: there are %d quantities", rows->n);
  *found = measurement(result, &rows->row[i]);
  return GG_OK;
}

gg_status gg_result_get(const gg_result *result, const char *quantity, double *mean, double *error, gg_error *err)
{
  gg_measurement m;
  GG_NEED(result, quantity);
  GG_TRY(gg_result_find(result, quantity, &m, err));
  if (isnan(m.mean)) return GG_REFUSE(err, "'%s' cannot be had here: %s", quantity, m.reason);
  if (mean) *mean = m.mean;
  if (error) *error = m.error;
  return GG_OK;
}

gg_status gg_result_covariance(const gg_result *result, const char *quantity, const char *other, double *covariance,
                               gg_error *err)
{
  GG_NEED(covariance);
  *covariance = NAN;
  GG_NEED(result, quantity, other);
  const gg_quantity_row *one, *second;
  const char *why;
  GG_TRY(gg_api_row_find(&result->rows, quantity, &one, err));
  GG_TRY(gg_api_row_find(&result->rows, other, &second, err));
  *covariance = gg_run_result_covariance(result, one->quantity, second->quantity, &why);
  if (!why) return GG_OK;
  return GG_REFUSE(err, "the covariance of '%s' and '%s' cannot be had here: %s", quantity, other, why);
}

const char *gg_result_unit(const gg_result *result, const char *quantity)
{
  gg_measurement m;
  return gg_result_find(result, quantity, &m, NULL) == GG_OK && !isnan(m.mean) ? m.unit : NULL;
}

int gg_result_is_steady(const gg_result *result)
{
  return result && gg_run_is_steady(result->steadiness);
}

gg_status gg_result_get_info(const gg_result *result, gg_result_info *info, gg_error *err)
{
  GG_NEED(result, info);
  const gg_result *r = result;
  *info = (gg_result_info){.engine = r->engine,
                           .steady = gg_result_is_steady(r),
                           .verdict = r->steadiness_text,
                           .metastable = r->steadiness == GG_METASTABLE,
                           .escape_rate = r->escape_rate,
                           .grains = r->model.n,
                           .grains_chosen = *r->ensemble_text ? r->ensemble_text : NULL,
                           .window = {r->history.window[0], r->history.window[1]},
                           .collisions = r->averaging.collisions,
                           .cpu_seconds = r->averaging.cpu_seconds,
                           .total_collisions = r->total.collisions,
                           .total_cpu_seconds = r->total.cpu_seconds,
                           .wall_seconds = r->total.wall_seconds,
                           .version = r->origin.version,
                           .command = r->origin.command,
                           .machine = r->origin.machine,
                           .date = r->origin.date,
                           .frames = r->origin.frames};
  return GG_OK;
}

const gg_scene *gg_result_scene(const gg_result *result)
{
  return result ? result->scene : NULL;
}

const char *gg_result_warning(const gg_result *result, size_t i)
{
  return result ? gg_base_string_list_at(&result->warnings, i) : NULL;
}

gg_status gg_result_history(const gg_result *result, const char *quantity, size_t *n, const double **time,
                            const double **value, gg_error *err)
{
  GG_NEED(result, quantity, n);
  const gg_quantity_row *row;
  GG_TRY(gg_api_row_find(&result->rows, quantity, &row, err));
  for (int k = 0; k < GG_N_HISTORY; k++) {
    if (gg_common_quantity_of_history(k) != row->quantity || !result->history.value[k]) continue;
    *n = result->history.n;
    if (time) *time = result->history.time;
    if (value) *value = result->history.value[k];
    return GG_OK;
  }
  char followed[300] = "";
  for (int k = 0; k < GG_N_HISTORY; k++)
    if (result->history.value[k])
      gg_base_text_append(followed, sizeof followed, "%s%s", *followed ? ", " : "",
                          gg_common_quantity_name(gg_common_quantity_of_history(k)));
  return GG_REFUSE(err, "'%s' is not followed in time; allowed: %s", quantity, followed);
}

/* The i-th curve; NULL, with the message, after the last. */
static const gg_curve *curve_at(const gg_result *r, size_t i, gg_error *err)
{
  if (i < (size_t)r->curves.n) return &r->curves.curve[i];
  GG_REFUSE(err, "this result has %d curves", r->curves.n);
  return NULL;
}

gg_curve_data gg_api_curve_view(const gg_curve *c)
{
  return (gg_curve_data){.name = c->name,
                         .observable = c->group,
                         .panel = c->panel,
                         .label = c->label,
                         .x_name = c->x_name,
                         .x_unit = c->x_unit,
                         .y_name = c->y_name,
                         .unit = c->unit,
                         .log_x = c->log_x,
                         .log_y = c->log_y,
                         .n = c->n,
                         .x = c->x,
                         .value = c->value,
                         .error = c->error,
                         .law = c->reference,
                         .law_label = c->reference ? c->reference_label : NULL,
                         .samples = c->samples};
}

gg_status gg_result_curve(const gg_result *result, size_t i, gg_curve_data *curve, gg_error *err)
{
  GG_NEED(result, curve);
  const gg_curve *c = curve_at(result, i, err);
  return c ? *curve = gg_api_curve_view(c), GG_OK : GG_BAD_INPUT;
}

gg_status gg_api_curve_number(const gg_curve *c, size_t k, const char *unit, gg_measurement *number, gg_error *err)
{
  if (k >= (size_t)c->n_numbers)
    return GG_REFUSE(err, "%d numbers were derived from the curve %s", c->n_numbers, c->name);
  const gg_curve_number *p = &c->number[k];
  *number = (gg_measurement){.name = p->name,
                             .mean = p->value,
                             .error = p->error,
                             .correlation_time = NAN,
                             .samples = c->samples,
                             .unit = p->unit,
                             .reason = isnan(p->value) ? "it cannot be derived from this curve" : NULL,
                             .correlation_time_unit = unit};
  return GG_OK;
}

gg_status gg_result_curve_number(const gg_result *result, size_t i, size_t k, gg_measurement *number, gg_error *err)
{
  GG_NEED(result, number);
  const gg_curve *c = curve_at(result, i, err);
  return c ? gg_api_curve_number(c, k, result->correlation_time_unit, number, err) : GG_BAD_INPUT;
}

gg_status gg_result_grains(const gg_result *result, const gg_grains *into, gg_error *err)
{
  GG_NEED(result, into);
  const gg_frame *f = &result->final;
  if (!f->velocity) return GG_REFUSE(err, "this result holds no grains");
  if (into->position && !f->position)
    return GG_REFUSE(err, "%s is spatially homogeneous: it has no positions", result->engine);
  gg_measure_frame_copy(f, into->position, into->velocity, into->spin, into->species);
  return GG_OK;
}

gg_status gg_result_to_json(const gg_result *result, char **text, gg_error *err)
{
  GG_NEED(result, text);
  return gg_api_text_copy(gg_files_run_document(result), text, err);
}

static gg_status finish(gg_result_file *file, const gg_result *run, const gg_comparison *both, gg_error *err)
{
  return both ? gg_files_result_file_finish_comparison(file, both, err)
              : gg_files_result_file_finish_run(file, run, err);
}

gg_status gg_api_file_write(const gg_result *run, const gg_comparison *both, const char *function, const char *path,
                            const gg_stop *stop, gg_error *err)
{
  gg_result_file file;
  GG_TRY(gg_files_result_file_open(&file, path, run->origin.command ? run->origin.command : function, err));
  file.file.stop = *stop;
  file.stop = &file.file.stop;
  return gg_base_callback_settle(finish(&file, run, both, err), err);
}

gg_status gg_api_file_to_bytes(const gg_result *run, const gg_comparison *both, const char *function, void **bytes,
                               size_t *size, gg_error *err)
{
  gg_result_file file;
  GG_TRY(gg_files_result_file_open(&file, NULL, run->origin.command ? run->origin.command : function, err));
  GG_TRY(finish(&file, run, both, err));
  *bytes = file.bytes, *size = file.size;
  return GG_OK;
}

gg_status gg_result_write(const gg_result *result, const char *path, int (*stop)(void *context), void *context,
                          gg_error *err)
{
  GG_NEED(result, path);
  return gg_api_file_write(result, NULL, __func__, path, &GG_STOP_OF(stop, context), err);
}

gg_status gg_result_to_bytes(const gg_result *result, void **bytes, size_t *size, gg_error *err)
{
  GG_NEED(result, bytes, size);
  return gg_api_file_to_bytes(result, NULL, __func__, bytes, size, err);
}

static gg_status restore(gg_stored_result *stored, const char *path, gg_result **result, gg_error *err)
{
  if (stored->comparison) return GG_REFUSE(err, "%s: holds a comparison: read it with gg_comparison_read", path);
  return gg_files_result_restore(stored, gg_files_stored_first(stored), result, err);
}

gg_status gg_result_read(const char *path, gg_result **result, gg_error *err)
{
  GG_NEED(path, result);
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_files_stored_result_read(&stored, path, err));
  return restore(&stored, path, result, err);
}

gg_status gg_result_from_bytes(const void *bytes, size_t size, gg_result **result, gg_error *err)
{
  GG_NEED(bytes, result);
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_files_stored_result_from_bytes(&stored, bytes, size, err));
  return restore(&stored, "the bytes", result, err);
}

gg_status gg_plot(const char *result_file, const char *picture, const char *format, const char *width,
                  void (*drawn)(void *context, const char *picture), int (*stop)(void *context), void *context,
                  gg_error *err)
{
  GG_NEED(result_file, picture);
  if (gg_io_path_is_same_file(result_file, picture))
    return GG_REFUSE(err, "%s: would be both the result and its picture; choose another picture", picture);
  gg_plot_paper paper;
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_plot_paper_choose(&paper, picture, format, width, err));
  GG_TRY(gg_files_stored_result_read(&stored, result_file, err));
  const unsigned before = gg_base_memory_failures();
  gg_status status = gg_plot_pages_check(&stored, &paper, result_file, picture, err);
  if (status == GG_OK) status = gg_plot_result_draw(&stored, &paper, picture, err);
  if (status == GG_OK && drawn) drawn(context, picture);
  if (status == GG_OK)
    status = gg_plot_pages_draw(&stored, &paper, picture, drawn, context, &GG_STOP_OF(stop, context), err);
  status = gg_base_callback_settle(status, err);
  return gg_base_memory_check(before, status, err); /* otherwise a picture could lack its title */
}

gg_status gg_result_file_notice(const char *result_file, char *text, size_t size, gg_error *err)
{
  GG_NEED(result_file, text);
  if (!size) return GG_REFUSE(err, "gg_result_file_notice: there is no room for a text");
  return gg_files_stored_result_notice(result_file, text, size, err);
}

gg_status gg_export(const char *result_file, const char *prefix, unsigned parts,
                    void (*written)(void *context, const char *file), void (*progress)(void *context, double fraction),
                    int (*stop)(void *context), void *context, gg_error *err)
{
  GG_NEED(result_file, prefix);
  const char *slash = strrchr(prefix, '/'), *name = slash ? slash + 1 : prefix;
  if (!*name) return GG_REFUSE(err, "'%s': the files need a prefix to their names", prefix);
  if (!(parts & GG_EXPORT_ALL) || parts & ~(unsigned)GG_EXPORT_ALL)
    return GG_REFUSE(err, "%s: %u is not a set of parts to export; allowed: sums of GG_EXPORT_...", result_file, parts);
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_files_stored_result_read(&stored, result_file, err));
  gg_status status = gg_files_export_result(&stored, result_file, prefix, parts, written, progress, context,
                                            &GG_STOP_OF(stop, context), err);
  return gg_base_callback_settle(status, err);
}
