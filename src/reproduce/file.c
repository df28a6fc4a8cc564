/* A figure as an HDF5 file: /panel_1/series_1/x, y, x_stderr, y_stderr with their method and line as attributes;
 * numbers of the paper under /numbers; the entry's text under /entry. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/atomic_file.h"
#include "base/build.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_writer.h"
#include "reproduce/figures.h"

static void put_array(gg_h5 *h, const char *group, const char *name, size_t n, const double *values, const char *unit)
{
  char path[96];
  hsize_t dims = n;
  snprintf(path, sizeof path, "%s/%s", group, name);
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &dims, values);
  gg_h5_text_attribute(h, path, "unit", unit && *unit ? unit : "1");
}

static void put_panel(gg_h5 *h, const gg_drawn_panel *p, int number)
{
  char group[48];
  snprintf(group, sizeof group, "/panel_%d", number);
  gg_h5_group(h, group);
  gg_h5_text_attribute(h, group, "x", p->x_label);
  gg_h5_text_attribute(h, group, "y", p->y_label);
  if (p->of->title) gg_h5_text_attribute(h, group, "title", p->of->title);
  for (size_t i = 0; i < p->n; i++) {
    const gg_drawn *d = &p->drawn[i];
    if (!d->n) continue;
    snprintf(group, sizeof group, "/panel_%d/series_%zu", number, i + 1);
    gg_h5_group(h, group);
    gg_h5_text_attribute(h, group, "method", d->method);
    gg_h5_text_attribute(h, group, "line", d->group);
    put_array(h, group, "x", d->n, d->x, p->x_unit);
    put_array(h, group, "y", d->n, d->y, p->y_unit);
    put_array(h, group, "x_stderr", d->n, d->x_error, p->x_unit);
    put_array(h, group, "y_stderr", d->n, d->error, p->y_unit);
  }
}

static void put_number(gg_h5 *h, const char *group, const char *name, gg_told value)
{
  char path[160];
  if (!isfinite(value.mean)) return;
  snprintf(path, sizeof path, "%s/%s/mean", group, name);
  gg_h5_number(h, path, value.mean);
  snprintf(path, sizeof path, "%s/%s/stderr", group, name);
  gg_h5_number(h, path, value.error);
}

static void put_stated(gg_h5 *h, const gg_stated_row *row, int number)
{
  char group[48];
  snprintf(group, sizeof group, "/numbers/%d", number);
  gg_h5_group(h, group);
  gg_h5_text_attribute(h, group, "what", row->of->what);
  if (row->of->where) gg_h5_text_attribute(h, group, "where", row->of->where);
  put_number(h, group, "paper", (gg_told){row->of->paper, row->of->error, NULL});
  put_number(h, group, "md", row->engine[0]);
  put_number(h, group, "dsmc", row->engine[1]);
  for (int k = 0; k < row->of->theories.n; k++) put_number(h, group, row->of->theories.text[k], row->theory[k]);
}

static void put_figure(gg_h5 *h, const gg_figure *f, const char *command)
{
  const char *yaml = "";
  for (size_t k = 0; gg_entry_files[k].file; k++)
    if (gg_entry_files[k].file == f->entry->file) yaml = gg_entry_files[k].yaml;
  gg_h5_text(h, "/figure", f->entry->figure);
  gg_h5_text(h, "/shows", f->entry->shows);
  gg_h5_text(h, "/precision", f->quick ? "quick" : "full");
  gg_h5_text(h, "/entry", yaml);
  gg_h5_text(h, "/version", gg_base_build_version);
  gg_h5_text(h, "/command", command ? command : "the graingas library");
  for (int i = 0; i < f->entry->n_panels; i++) put_panel(h, &f->panel[i], i + 1);
  for (int i = 0; i < f->entry->n_numbers; i++) put_stated(h, &f->row[i], i + 1);
}

static gg_status put_in_place(const char *path, const void *image, size_t size, gg_error *err)
{
  gg_atomic_file file;
  GG_TRY(gg_base_atomic_open(&file, path, err));
  gg_status status = gg_files_checksum_trailer_write(&file, image, size, err);
  if (status == GG_OK) return gg_base_atomic_commit(&file, err);
  gg_base_atomic_abandon(&file);
  return status;
}

gg_status gg_reproduce_figure_write_h5(const gg_figure *f, const char *path, const char *command, gg_error *err)
{
  gg_h5 h;
  size_t size = 0;
  gg_h5_create_in_memory(&h);
  put_figure(&h, f, command);
  void *image = gg_h5_image(&h, &size);
  gg_h5_close(&h);
  gg_status status = gg_h5_status(&h, path, "written", err);
  if (status == GG_OK) status = put_in_place(path, image, size, err);
  free(image);
  return status;
}
