/* One figure from beginning to end: run, drawn, written. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/atomic_file.h"
#include "base/memory.h"
#include "plot/plot.h"
#include "reproduce/figures.h"
#include "sweep/folder.h"

static const char *const endings[] = {".h5",  ".csv",           "_numbers.csv",  ".svg",
                                      ".png", "_snapshots.svg", "_snapshots.png"};
enum { H5, CSV, NUMBERS, SVG, PNG, GRAINS_SVG, GRAINS_PNG, FILES };

typedef struct outputs {
  const gg_reproduce_options *options;
  char base[64];
} outputs;

static bool is_wanted(const gg_figure *f, int file)
{
  if (file == NUMBERS) return f->entry->n_numbers > 0;
  if (file == CSV) return gg_reproduce_figure_has(f, false);
  return file < GRAINS_SVG || (gg_reproduce_figure_has(f, true) && gg_reproduce_figure_has(f, false));
}

static char *path_of(const outputs *o, int file)
{
  char *path = NULL;
  const char *folder = o->options->folder;
  int made = asprintf(&path, "%s%s%s%s", folder ? folder : "", folder ? "/" : "", o->base, endings[file]);
  return made < 0 ? NULL : path;
}

static gg_status write_one(const outputs *o, const gg_figure *f, const gg_figure_points *points, int file,
                           const char *path, gg_error *err)
{
  switch (file) {
  case H5: return gg_reproduce_figure_write_h5(f, path, o->options->command, err);
  case CSV: return gg_reproduce_figure_write_csv(f, path, err);
  case NUMBERS: return gg_reproduce_figure_write_numbers(f, path, err);
  case SVG:
  case PNG: return gg_reproduce_figure_draw(f, points, path, err);
  default: return gg_reproduce_figure_draw_snapshots(f, points, path, err);
  }
}

/* Could all of them be written? Asked before the run, and then they are. */
static gg_status each_file(const outputs *o, const gg_figure *f, const gg_figure_points *points, gg_error *err)
{
  if (!points) GG_TRY(gg_plot_gnuplot_is_there(err));
  for (int file = 0; file < FILES; file++) {
    if (!is_wanted(f, file)) continue;
    char *path = path_of(o, file);
    gg_status status = path ? GG_OK : gg_base_out_of_memory(err);
    if (status == GG_OK && !points) status = gg_base_atomic_check_writable(path, "a figure's files are files", err);
    if (status == GG_OK && points) status = write_one(o, f, points, file, path, err);
    if (status == GG_OK && points && o->options->written) o->options->written(o->options->context, path);
    free(path);
    GG_TRY(status);
  }
  return GG_OK;
}

static void tell_numbers(const gg_reproduce_options *o, const gg_figure *f)
{
  for (int i = 0; i < f->entry->n_numbers && o->number; i++) {
    const gg_stated_row *row = &f->row[i];
    gg_figure_number number = {.figure = f->entry->figure,
                               .what = row->of->what,
                               .where = row->of->where,
                               .paper = row->of->paper,
                               .paper_error = row->of->error,
                               .md = row->engine[0].mean,
                               .md_error = row->engine[0].error,
                               .md_z = row->z[0],
                               .dsmc = row->engine[1].mean,
                               .dsmc_error = row->engine[1].error,
                               .dsmc_z = row->z[1]};
    o->number(o->context, &number);
  }
}

static gg_status fill(gg_figure *f, const gg_figure_points *points, gg_error *err)
{
  for (int i = 0; i < f->entry->n_panels; i++)
    GG_TRY(gg_reproduce_panel_make(&f->panel[i], &f->entry->panel[i], points, err));
  return gg_reproduce_stated_rows(f->entry, points, f->row, err);
}

static gg_status finish(const outputs *o, gg_figure *f, const gg_figure_points *points, gg_error *err)
{
  const unsigned before = gg_base_memory_failures(); /* a value that lacks memory is like one that is not there */
  GG_TRY(gg_base_memory_check(before, fill(f, points, err), err));
  GG_TRY(each_file(o, f, points, err));
  tell_numbers(o->options, f);
  return GG_OK;
}

gg_status gg_reproduce_figure_reproduce(const gg_figure_entry *entry, const gg_reproduce_options *options,
                                        gg_error *err)
{
  outputs o = {.options = options};
  gg_figure_points points = {0};
  gg_error later;
  gg_figure *f = gg_base_array_new(1, sizeof *f, err);
  if (!f) return GG_FAILED;
  *f = (gg_figure){.entry = entry, .quick = options->quick};
  gg_reproduce_figure_base(entry, o.base, sizeof o.base);
  gg_status status = GG_OK;
  if (options->folder) status = gg_sweep_folder_prepare(options->folder, "a figure is several files", err);
  if (status == GG_OK) status = each_file(&o, f, NULL, err);
  if (status == GG_OK) status = gg_reproduce_figure_run(entry, options, &points, err);
  if (status == GG_OK || (status == GG_FAILED && points.n)) {
    gg_status finished = finish(&o, f, &points, &later);
    if (finished != GG_OK) status = gg_base_fail(err, finished, "%s: %s", entry->figure, later.message);
  }
  for (int i = 0; i < entry->n_panels; i++) gg_reproduce_panel_clear(&f->panel[i]);
  gg_reproduce_figure_points_clear(&points);
  free(f);
  return status;
}
