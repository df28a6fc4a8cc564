/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of the files of a run before it starts. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "api/run.h"
#include "base/memory.h"
#include "common/engine.h"
#include "files/h5/checkpoint_file.h"
#include "measure/observable.h"
#include "plot/plot.h"

typedef struct file {
  const char *path, *role, *option; /* option: the option that names the file; NULL: the file is only read */
} file;

typedef gg_status page_check(const char *page, const char *picture, const void *context, gg_error *err);

/* Whether two files may be the same: a checkpoint may replace the checkpoint that the run resumes from. */
static bool may_be_same(const file *a, const file *b)
{
  return !a->path || !b->path || (!a->option && !b->option) || (a->role[4] == 'c' && b->role[4] == 'c');
}

static gg_status check_pairs(const file *all, int n, gg_error *err)
{
  for (int i = 0; i < n; i++)
    for (int j = i + 1; j < n; j++)
      if (!may_be_same(&all[i], &all[j]) && gg_io_path_is_same_file(all[i].path, all[j].path))
        return GG_REFUSE(err, "%s: would be both %s and %s; choose another %s", all[i].path, all[i].role, all[j].role,
                         all[i].option);
  return GG_OK;
}

static gg_status check_page(const char *picture, const char *engine, const char *group, const gg_plot_paper *paper,
                            page_check *check, const void *context, gg_error *err)
{
  GG_FREED char *page = gg_plot_page_name(picture, engine, group, paper);
  return page ? check(page, picture, context, err) : gg_base_out_of_memory(err);
}

/* Check all pages that the run may draw. If an engine rejects an observable, its page is not drawn. */
static gg_status for_pages(const gg_api_run_call *r, page_check *check, const void *context, gg_error *err)
{
  gg_plot_paper paper;
  const char *picture = r->options.picture;
  if (!picture) return GG_OK;
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, r->options.picture_width, err));
  GG_TRY(check_page(picture, "", GG_SNAPSHOT_PAGE, &paper, check, context, err));
  for (int k = 0; k < (r->comparison ? 2 : 1); k++)
    for (int i = 0; gg_measure_observables[i]; i++) {
      const gg_observable *o = gg_measure_observables[i];
      const char *engine = r->comparison ? gg_common_engine_of(k)->name : "";
      if (!o->curves || !(r->scene.measure & o->flag)) continue;
      GG_TRY(check_page(picture, engine, o->name, &paper, check, context, err));
      if (r->comparison) GG_TRY(check_page(picture, "", o->name, &paper, check, context, err));
    }
  return GG_OK;
}

/* `context`: array of files that ends with a NULL role. */
static gg_status check_apart(const char *page, const char *picture, const void *context, gg_error *err)
{
  for (const file *f = context; f->role; f++)
    if (gg_io_path_is_same_file(page, f->path))
      return GG_REFUSE(err, "%s: would be both %s and " GG_PAGE_BESIDE "; choose another picture", page, f->role,
                       picture);
  return GG_OK;
}

static gg_status check_page_writable(const char *page, const char *picture, const void *context, gg_error *err)
{
  (void)picture, (void)context;
  return gg_io_atomic_check_writable(page, GG_PICTURES_ARE, err);
}

/* Reject a result with the name of a picture, table or text: the user wants one, or would lose one. */
static gg_status check_ending(const char *output, gg_error *err)
{
  static const char *const others[] = {".svg", ".png", ".pdf", ".gp",   ".eps",  ".jpg",
                                       ".csv", ".txt", ".xyz", ".json", ".yaml", ".yml"};
  const char *ending = output ? strrchr(output, '.') : NULL;
  for (size_t i = 0; ending && i < sizeof others / sizeof *others; i++)
    if (strcasecmp(ending, others[i]) == 0)
      return GG_REFUSE(err,
                       "%s: results are HDF5: choose FILE.h5; `graingas plot` draws pictures, `graingas export` tables",
                       output);
  return GG_OK;
}

/* The picture is drawn from the result file after the run. */
gg_status gg_api_picture_check(const gg_api_run_call *r, gg_error *err)
{
  gg_plot_paper paper;
  const gg_run_options *o = &r->options;
  if (!o->picture) return GG_OK;
  GG_CLEARED(gg_io_output_path_clear) gg_output_path place = {0};
  GG_TRY(gg_plot_paper_choose(&paper, o->picture, NULL, o->picture_width, err));
  if (!o->output) return GG_REFUSE(err, "%s: a picture is drawn from an output file: set --output FILE.h5", o->picture);
  GG_TRY(gg_io_output_path_find(&place, o->output, err));
  if (place.stream)
    return GG_REFUSE(err, "%s: a picture is drawn from the output file, and %s keeps none", o->picture, o->output);
  GG_TRY(gg_io_atomic_check_writable(o->picture, GG_PICTURES_ARE, err));
  return for_pages(r, check_page_writable, NULL, err);
}

gg_status gg_api_files_check(const gg_api_run_call *r, gg_error *err)
{
  const gg_run_options *o = &r->options;
  GG_FREED char *second = o->checkpoint ? gg_files_checkpoint_before(o->checkpoint) : NULL;
  GG_FREED char *third = o->resume ? gg_files_checkpoint_before(o->resume) : NULL;
  GG_FREED char *frames = o->checkpoint ? gg_files_frame_log_path(o->checkpoint) : NULL;
  const file all[] = {{o->output, "the result", "output"},
                      {o->picture, "the picture", "picture"},
                      {o->checkpoint, "the checkpoint", "checkpoint"},
                      {second, "the checkpoint before", "checkpoint"},
                      {frames, "the frames beside the checkpoint", "checkpoint"},
                      {o->resume, "the checkpoint to resume from", NULL},
                      {third, "the checkpoint before it", NULL},
                      {r->samples.path, "the log", "output.log"},
                      {o->input, "the scene", NULL},
                      {NULL, NULL, NULL}};
  GG_TRY(check_pairs(all, sizeof all / sizeof *all - 1, err));
  GG_TRY(for_pages(r, check_apart, all, err));
  return check_ending(o->output, err);
}
