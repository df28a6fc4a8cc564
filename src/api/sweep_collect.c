/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gg_sweep_collect: the results of a sweep as tables and a picture. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "api/api.h"
#include "base/cancellation.h"
#include "io/atomic_file.h"
#include "sweep/sweep_table.h"

typedef struct collecting {
  const gg_sweep *sweep;
  gg_collect_options options;
  gg_point_table table;
  char csv[PATH_MAX], h5[PATH_MAX], svg[PATH_MAX];
  const char *picture; /* NULL: none */
  void (*written)(void *context, const char *file);
  void *context;
} collecting;

static void report_file(const collecting *c, const char *file)
{
  if (c->written) c->written(c->context, file);
}

/* Whether a failed picture is only a warning, e.g. because words have no axis: the tables are complete. */
static bool may_lack_picture(const collecting *c, gg_status status, const gg_error *err)
{
  const gg_collect_options *o = &c->options;
  const bool chosen = o->picture || o->width || o->over || o->show || o->log || o->relative_to || o->theories;
  if (!o->warn || chosen || status == GG_BAD_FILE || status == GG_INTERRUPTED) return false;
  o->warn(c->context, err ? err->message : "there is no picture");
  return true;
}

static bool has_theories(const gg_point_table *t)
{
  size_t i = 0;
  while (i < t->n && !t->row[i].theory) i++;
  return i < t->n;
}

/* Evaluate theories between the points; those that are done if interrupted. Without any, warn: lines then connect the
 * points. */
static gg_status evaluate_lines(const collecting *c, const char *folder, gg_picture_lines *lines, gg_error *err)
{
  gg_error why, unread;
  char path[PATH_MAX];
  const gg_collect_options *o = &c->options;
  const gg_sweep_options options = {.size = sizeof options,
                                    .threads = o->threads,
                                    .command = o->command,
                                    .context = c->context,
                                    .progress = o->progress,
                                    .stop = o->stop};
  gg_status status = snprintf(path, sizeof path, "%s/lines", folder) < PATH_MAX
                         ? GG_OK
                         : gg_io_path_write_error(folder, strerror(ENAMETOOLONG), &why);
  if (status == GG_OK) {
    status = gg_sweep_run(lines->sweep, path, &options, &why);
    gg_sweep_point_table_read(&lines->table, lines->sweep, path, NULL, &unread);
  }
  if (status == GG_INTERRUPTED) return gg_base_fail(err, status, "%s", why.message);
  if (!lines->table.n && o->warn) {
    char text[sizeof why.message + 80];
    snprintf(text, sizeof text, "lines of theories are drawn from point to point: %s", why.message);
    o->warn(c->context, text);
  }
  return GG_OK;
}

static gg_status draw_picture(const collecting *c, const char *folder, gg_error *err)
{
  const gg_collect_options *o = &c->options;
  gg_picture_lines lines = {0};
  gg_picture_choice choice = {
      .show = o->show, .log = o->log, .relative_to = o->relative_to, .theories = o->theories, .lines = &lines};
  GG_TRY(gg_sweep_axis_choose(c->sweep, o->over, o->log, &choice.axis, err));
  GG_TRY(gg_sweep_picture_check(&c->table, c->sweep, &choice, err));
  if (has_theories(&c->table)) GG_TRY(gg_sweep_lines_make(c->sweep, &choice.axis, &lines.sweep, err));
  gg_status interrupted = lines.sweep ? evaluate_lines(c, folder, &lines, err) : GG_OK;
  if (!lines.table.n) choice.lines = NULL;
  gg_error why;
  gg_status status = gg_sweep_point_table_draw(&c->table, c->sweep, &choice, c->picture, o->width, &why);
  if (status != GG_OK) gg_base_fail(err, status, "%s", why.message);
  gg_sweep_point_table_clear(&lines.table);
  gg_sweep_lines_free(lines.sweep, &choice.axis);
  if (status == GG_OK) report_file(c, c->picture);
  return status == GG_OK ? interrupted : status;
}

static gg_status write_all(collecting *c, const char *folder, gg_error *err)
{
  const char *command = c->options.command ? c->options.command : "the graingas library";
  GG_TRY(gg_io_atomic_check_writable(c->csv, "tables are files", err)); /* before the work */
  GG_TRY(gg_io_atomic_check_writable(c->h5, "tables are files", err));
  if (c->picture) GG_TRY(gg_io_atomic_check_writable(c->picture, "pictures are files", err));
  GG_TRY(gg_sweep_point_table_read(&c->table, c->sweep, folder, NULL, err));
  gg_sweep_point_table_warn(&c->table, ": see the column `build`; the sweep runs them again", c->options.warn,
                            c->context);
  GG_TRY(gg_sweep_point_table_write_csv(&c->table, c->sweep, c->csv, err));
  report_file(c, c->csv);
  GG_TRY(gg_sweep_point_table_write_h5(&c->table, c->sweep, c->h5, command, err));
  report_file(c, c->h5);
  if (!c->picture) return GG_OK;
  gg_status status = draw_picture(c, folder, err);
  return status == GG_OK || !may_lack_picture(c, status, err) ? status : GG_OK;
}

gg_status gg_sweep_collect(gg_sweep *sweep, const char *folder, const char *prefix, const gg_collect_options *options,
                           void (*written)(void *context, const char *file), void *context, gg_error *err)
{
  GG_NEED(sweep, folder, prefix);
  GG_TRY(gg_sweep_check(sweep, err));
  GG_USE_READING(sweep);
  collecting c = {.sweep = sweep, .written = written, .context = context};
  GG_COPY_OPTIONS(c.options, options);
  snprintf(c.csv, PATH_MAX, "%s.csv", prefix);
  snprintf(c.svg, PATH_MAX, "%s.svg", prefix);
  if (snprintf(c.h5, PATH_MAX, "%s.h5", prefix) >= PATH_MAX - 1)
    return gg_io_path_write_error(prefix, strerror(ENAMETOOLONG), err);
  c.picture = c.options.picture ? c.options.picture : c.svg;
  if (strcmp(c.picture, "none") == 0) c.picture = NULL;
  gg_status status = write_all(&c, folder, err);
  gg_sweep_point_table_clear(&c.table);
  return gg_base_callback_settle(status, err);
}
