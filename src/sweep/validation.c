/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/validation.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/build.h"
#include "base/memory.h"
#include "files/result_document.h"
#include "graingas.h"
#include "io/file_writer.h"
#include "sweep/deviation_maps.h"
#include "sweep/verdict.h"

typedef struct validating {
  const gg_validate_options *options;
  void (*written)(void *context, const char *file);
  void *context;
  const gg_stop *stop;
  FILE *maps; /* the part of the page with the maps; NULL: no page */
} validating;

/* Path of a picture relative to the folder of the page, if both names begin with that folder. */
static const char *seen_from(const char *page, const char *picture)
{
  const char *slash = strrchr(page, '/');
  const size_t folder = slash ? (size_t)(slash - page) + 1 : 0;
  return strncmp(page, picture, folder) == 0 ? picture + folder : picture;
}

static void note_map(void *context, const char *picture, const char *quantity)
{
  const validating *v = context;
  if (v->written) v->written(v->context, picture);
  if (v->maps)
    fprintf(v->maps, "![deviations of %s](%s)\n\n", quantity,
            seen_from(v->options->page ? v->options->page : "", picture));
}

static gg_status draw_maps(validating *v, const gg_grid_view *view, gg_error *err)
{
  const gg_validate_options *o = v->options;
  const gg_map_choice choice = {o->show, o->theories, o->picture, o->width, v->stop};
  if (!o->picture) return GG_OK;
  gg_status status = gg_sweep_deviation_maps_draw(view, &choice, note_map, v, err);
  const bool chosen = o->show || o->theories || o->width;
  if (status == GG_OK || chosen || status == GG_BAD_FILE || status == GG_INTERRUPTED || !o->warn) return status;
  o->warn(v->context, err ? err->message : "there are no maps");
  return GG_OK;
}

static void put_head(gg_file_writer *out, const gg_point_table *t)
{
  char line[400], date[24];
  const time_t now = time(NULL);
  struct tm utc;
  strftime(date, sizeof date, "%Y-%m-%d", gmtime_r(&now, &utc));
  gg_io_file_writer_put(out, "# md, dsmc, Enskog's equation and theories over a grid\n\n");
  snprintf(line, sizeof line, "Written by `graingas validate` on %s, graingas %s. Do not edit.\n\n", date,
           gg_base_build_version);
  gg_io_file_writer_put(out, line);
  if (t->n_other_builds) {
    snprintf(line, sizeof line, "%zu points are by another build.\n\n", t->n_other_builds);
    gg_io_file_writer_put(out, line);
  }
}

static gg_status write_page(const gg_validate_options *o, const gg_point_table *t, const char *maps,
                            const char *verdict, gg_error *err)
{
  gg_atomic_file file;
  GG_TRY(gg_io_atomic_open(&file, o->page, false, err));
  GG_FREED gg_file_writer *out = gg_base_array_new(1, sizeof *out, err);
  if (!out) return gg_io_atomic_abandon(&file), GG_FAILED;
  gg_io_file_writer_begin(out, &file, err);
  put_head(out, t);
  gg_io_file_writer_put(out, verdict);
  if (*maps)
    gg_io_file_writer_put(out, "## Maps\n\nRelative deviations at each point, in per cent; of N1 and N2 differences. "
                               "Enskog is the noise-free solution, `enskog_hermite`. Lines between cells: 1 % "
                               "(dashed), 5 %, 20 % (thick). Hatched: below two standard errors. Red: a cross where a "
                               "run is not steady, a triangle where md is clustered or swirls, a diamond where it is "
                               "collapsed. Panels marked \"against dsmc\" have no noise-free solution.\n\n");
  gg_io_file_writer_put(out, maps);
  return gg_io_atomic_commit(&file, gg_io_file_writer_end(out), err);
}

static gg_status print_verdict(const gg_grid_view *view, const gg_agreement *agreement, const char *repeat, char **text,
                               gg_error *err)
{
  GG_FREED char *made = NULL;
  FILE *out = gg_base_memory_stream_open(&made);
  if (!out) return gg_base_out_of_memory(err);
  gg_status status = gg_sweep_verdict_print(view, agreement, repeat, out, err);
  if (!gg_base_memory_stream_close(out, &made)) return gg_base_out_of_memory(err);
  if (status == GG_OK) GG_HAND_OVER(text, made);
  return status;
}

static gg_status draw(validating *v, const gg_grid_view *view, const gg_point_table *t, const char *verdict,
                      gg_error *err)
{
  GG_FREED char *maps = NULL;
  if (!(v->maps = gg_base_memory_stream_open(&maps))) return gg_base_out_of_memory(err);
  gg_status status = draw_maps(v, view, err);
  if (!gg_base_memory_stream_close(v->maps, &maps)) return gg_base_out_of_memory(err);
  GG_TRY(status);
  GG_TRY(gg_stop_check(v->stop, err));
  if (!v->options->page) return GG_OK;
  GG_TRY(write_page(v->options, t, maps, verdict, err));
  if (v->written) v->written(v->context, v->options->page);
  return GG_OK;
}

static gg_status validate(validating *v, const gg_grid_view *view, const gg_point_table *t, char **text, gg_error *err)
{
  gg_agreement agreement;
  gg_sweep_agreement_make(&agreement, view);
  GG_TRY(print_verdict(view, &agreement, v->options->repeat, text, err));
  GG_TRY(draw(v, view, t, *text, err));
  if (v->options->json) {
    free(*text);
    json_auto_t *document = gg_sweep_verdict_document(view, &agreement, v->options->repeat);
    *text = document ? gg_files_document_text(document) : NULL;
    if (!*text) return gg_base_out_of_memory(err);
  }
  if (!agreement.n_values)
    return gg_base_fail(err, GG_FAILED,
                        "nothing was judged: of %zu points with a result %zu have no noise-free solution, and dsmc is "
                        "not steady at %zu others",
                        t->n_documents, agreement.unanswered, agreement.unsteady);
  if (!agreement.fails) return GG_OK;
  return gg_base_fail(err, GG_FAILED, "dsmc and the noise-free solution disagree beyond chance");
}

gg_status gg_sweep_validate_table(const gg_point_table *t, const gg_sweep *sweep, const gg_validate_options *options,
                                  void (*written)(void *context, const char *file), void *context, const gg_stop *stop,
                                  char **text, gg_error *err)
{
  GG_CLEARED(gg_sweep_grid_view_clear) gg_grid_view view = {0};
  validating v = {.options = options, .written = written, .context = context, .stop = stop};
  GG_TRY(gg_sweep_grid_view_make(&view, t, sweep, err));
  return validate(&v, &view, t, text, err);
}
