/* A figure as tables. */
#include <math.h>

#include "base/checked_json.h"
#include "base/file_writer.h"
#include "base/memory.h"
#include "base/text.h"
#include "reproduce/figures.h"

static const char *const engines[] = {"md", "dsmc"};

static void put(gg_csv *csv, double value)
{
  json_t *number = isfinite(value) ? json_real(value) : json_null();
  gg_base_csv_json(csv, number);
  json_decref(number);
}

static void put_count(gg_csv *csv, int n)
{
  json_t *number = json_integer(n);
  gg_base_csv_json(csv, number);
  json_decref(number);
}

static void put_rows(gg_csv *csv, const gg_drawn_panel *p, int panel)
{
  for (size_t i = 0; i < p->n; i++)
    for (size_t k = 0; k < p->drawn[i].n; k++) {
      const gg_drawn *d = &p->drawn[i];
      put_count(csv, panel);
      gg_base_csv_text(csv, p->x_label);
      gg_base_csv_text(csv, p->y_label);
      gg_base_csv_text(csv, *p->y_unit ? p->y_unit : "1");
      gg_base_csv_text(csv, d->method);
      gg_base_csv_text(csv, d->group);
      put(csv, d->x[k]), put(csv, d->x_error[k]), put(csv, d->y[k]), put(csv, d->error[k]);
      gg_base_csv_end_row(csv);
    }
}

static void put_head(gg_csv *csv, const char *const *names)
{
  for (; *names; names++) gg_base_csv_text(csv, *names);
  gg_base_csv_end_row(csv);
}

static void put_points(gg_csv *csv, const gg_figure *f)
{
  static const char *const head[] = {"panel", "x_name",   "y_name", "y_unit",   "method", "line",
                                     "x",     "x_stderr", "y",      "y_stderr", NULL};
  put_head(csv, head);
  for (int i = 0; i < f->entry->n_panels; i++) put_rows(csv, &f->panel[i], i + 1);
}

static void put_numbers(gg_csv *csv, const gg_figure *f)
{
  static const char *const head[] = {"what", "where", "paper", "paper_error", "method", "mean", "stderr", "z", NULL};
  put_head(csv, head);
  for (int i = 0; i < f->entry->n_numbers; i++) {
    const gg_stated_row *row = &f->row[i];
    for (int k = 0; k < 2 + row->of->theories.n; k++) {
      const gg_told *v = k < 2 ? &row->engine[k] : &row->theory[k - 2];
      if (!isfinite(v->mean)) continue;
      gg_base_csv_text(csv, row->of->what);
      gg_base_csv_text(csv, row->of->where);
      put(csv, row->of->paper), put(csv, row->of->error);
      gg_base_csv_text(csv, k < 2 ? engines[k] : row->of->theories.text[k - 2]);
      put(csv, v->mean), put(csv, v->error), put(csv, k < 2 ? row->z[k] : NAN);
      gg_base_csv_end_row(csv);
    }
  }
}

static gg_status write(const gg_figure *f, const char *path, void (*rows)(gg_csv *, const gg_figure *), gg_error *err)
{
  gg_atomic_file file;
  gg_file_writer out;
  GG_TRY(gg_base_atomic_open(&file, path, err));
  const unsigned lacked = gg_base_memory_failures(); /* a number that JSON had no room for would be an empty cell */
  locale_t before = gg_base_c_locale_enter();
  gg_base_file_writer_begin(&out, &file, err);
  gg_csv csv = {.out = &out};
  rows(&csv, f);
  gg_status status = gg_base_memory_check(lacked, gg_base_file_writer_end(&out), err);
  gg_base_c_locale_leave(before);
  if (status == GG_OK) return gg_base_atomic_commit(&file, err);
  gg_base_atomic_abandon(&file);
  return status;
}

gg_status gg_reproduce_figure_write_csv(const gg_figure *f, const char *path, gg_error *err)
{
  return write(f, path, put_points, err);
}

gg_status gg_reproduce_figure_write_numbers(const gg_figure *f, const char *path, gg_error *err)
{
  return write(f, path, put_numbers, err);
}
