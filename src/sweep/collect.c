#include "sweep/collect.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked_json.h"
#include "base/csv.h"
#include "base/memory.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/result_file.h"
#include "sweep/folder.h"
#include "sweep/sweep_document.h"

static const char *key_of(const gg_sweep *sweep, size_t varied, size_t k)
{
  return sweep->varied[varied].key[k];
}

static const char *value_of(const gg_sweep *sweep, size_t point, size_t varied, size_t k)
{
  const gg_varied *v = &sweep->varied[varied];
  return v->value[gg_sweep_row(sweep, point, varied) * v->n_keys + k];
}

static void put_number(gg_csv *csv, double x)
{
  json_t *value = isfinite(x) ? json_real(x) : NULL;
  gg_base_csv_json(csv, value);
  json_decref(value);
}

static void put_count(gg_csv *csv, uint64_t n)
{
  char text[24];
  snprintf(text, sizeof text, "%" PRIu64, n);
  gg_base_csv_text(csv, text);
}

static void put_head(gg_csv *csv, const gg_sweep *sweep)
{
  static const char *const rest[] = {"method", "quantity", "mean",  "error",   "unit",
                                     "seed",   "steady",   "short", "seconds", "file"};
  gg_base_csv_text(csv, "point");
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++) gg_base_csv_text(csv, key_of(sweep, f, k));
  for (size_t i = 0; i < sizeof rest / sizeof *rest; i++) gg_base_csv_text(csv, rest[i]);
  gg_base_csv_end_row(csv);
}

static void put_row(gg_csv *csv, const gg_sweep *sweep, const gg_cli_table_row *row)
{
  char name[GG_POINT_NAME];
  gg_sweep_point_name(sweep->point[row->point].id, name);
  put_count(csv, row->point + 1);
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++) gg_base_csv_text(csv, value_of(sweep, row->point, f, k));
  gg_base_csv_text(csv, row->method);
  gg_base_csv_text(csv, row->quantity);
  put_number(csv, row->mean);
  put_number(csv, row->error);
  gg_base_csv_text(csv, row->unit);
  if (row->theory)
    for (int i = 0; i < 3; i++) gg_base_csv_text(csv, NULL);
  else
    put_count(csv, row->seed), gg_base_csv_text(csv, row->steady ? "true" : "false"),
        gg_base_csv_text(csv, row->fell_short ? "true" : "false");
  put_number(csv, row->seconds);
  gg_base_csv_text(csv, name);
  gg_base_csv_end_row(csv);
}

gg_status gg_sweep_point_table_write_csv(const gg_point_table *t, const gg_sweep *sweep, const char *path,
                                         gg_error *err)
{
  gg_atomic_file file;
  GG_TRY(gg_base_atomic_open(&file, path, err));
  gg_text_out *out = gg_base_array_new(1, sizeof *out, err);
  if (!out) return gg_base_atomic_abandon(&file), GG_FAILED;
  bool before = gg_base_memory_begin();
  gg_base_file_writer_begin(out, &file, err);
  gg_csv csv = {.out = out};
  put_head(&csv, sweep);
  for (size_t i = 0; i < t->n; i++) put_row(&csv, sweep, &t->row[i]);
  gg_status status = gg_base_memory_check(before, gg_base_file_writer_end(out), err);
  free(out);
  if (status == GG_OK) return gg_base_atomic_commit(&file, err);
  gg_base_atomic_abandon(&file);
  return status;
}

/* A column of numbers or texts, filled row by row. */
typedef struct column {
  gg_h5 *h;
  size_t n;
  double *number;
  const char **text;
} column;

static void write_numbers(column *c, const char *name)
{
  const hsize_t n = c->n;
  char path[160];
  snprintf(path, sizeof path, "/graingas/table/%s", name);
  gg_h5_array(c->h, path, H5T_NATIVE_DOUBLE, 1, &n, c->number);
}

static void write_texts(column *c, const char *name)
{
  char path[160];
  snprintf(path, sizeof path, "/graingas/table/%s", name);
  gg_h5_texts(c->h, path, c->text, c->n);
}

/* Texts of the points' names, which no row holds. */
static void write_files(column *c, const gg_point_table *t, const gg_sweep *sweep, char (*name)[GG_POINT_NAME])
{
  for (size_t i = 0; i < t->n; i++) {
    gg_sweep_point_name(sweep->point[t->row[i].point].id, name[i]);
    c->text[i] = name[i];
  }
  write_texts(c, "file");
}

/* Numbers, where every point has one. */
static void write_key(column *c, const gg_point_table *t, const gg_sweep *sweep, size_t f, size_t k)
{
  bool numbers = true;
  for (size_t i = 0; i < t->n; i++) {
    char *end;
    c->text[i] = value_of(sweep, t->row[i].point, f, k);
    c->number[i] = strtod(c->text[i], &end);
    numbers = numbers && !*end && end != c->text[i];
  }
  if (numbers)
    write_numbers(c, key_of(sweep, f, k));
  else
    write_texts(c, key_of(sweep, f, k));
}

#define NUMBERS(name, of_row)                                                                                          \
  do {                                                                                                                 \
    for (size_t i = 0; i < t->n; i++) {                                                                                \
      const gg_cli_table_row *row = &t->row[i];                                                                        \
      c->number[i] = (double)(of_row);                                                                                 \
    }                                                                                                                  \
    write_numbers(c, name);                                                                                            \
  } while (0)

#define TEXTS(name, member)                                                                                            \
  do {                                                                                                                 \
    for (size_t i = 0; i < t->n; i++) c->text[i] = t->row[i].member ? t->row[i].member : "";                           \
    write_texts(c, name);                                                                                              \
  } while (0)

static void write_columns(column *c, const gg_point_table *t, const gg_sweep *sweep)
{
  NUMBERS("point", row->point + 1);
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++) write_key(c, t, sweep, f, k);
  TEXTS("method", method);
  TEXTS("quantity", quantity);
  TEXTS("unit", unit);
  NUMBERS("mean", row->mean);
  NUMBERS("error", row->error);
  NUMBERS("seed", row->theory ? NAN : (double)row->seed);
  NUMBERS("steady", row->theory ? NAN : row->steady);
  NUMBERS("short", row->theory ? NAN : row->fell_short);
  NUMBERS("seconds", row->seconds);
}

static gg_status write_image(gg_h5 *h, const char *path, gg_error *err)
{
  size_t size = 0;
  gg_atomic_file file;
  unsigned char seal[GG_SEAL_SIZE];
  void *image = gg_h5_image(h, &size);
  gg_h5_close(h);
  gg_status status = gg_h5_status(h, path, "written", err);
  if (status == GG_OK) status = gg_base_atomic_open(&file, path, err);
  if (status != GG_OK) return free(image), status;
  gg_files_checksum_trailer_of(image, size, seal);
  status = gg_base_atomic_write(&file, image, size, err);
  if (status == GG_OK) status = gg_base_atomic_write(&file, seal, sizeof seal, err);
  free(image);
  if (status == GG_OK) return gg_base_atomic_commit(&file, err);
  gg_base_atomic_abandon(&file);
  return status;
}

gg_status gg_sweep_point_table_write_h5(const gg_point_table *t, const gg_sweep *sweep, const char *path,
                                        const char *command, gg_error *err)
{
  gg_h5 h;
  column c = {&h, t->n, gg_base_array_new(t->n, sizeof(double), err), gg_base_array_new(t->n, sizeof(char *), err)};
  char(*name)[GG_POINT_NAME] = gg_base_array_new(t->n, sizeof *name, err);
  gg_status status = c.number && c.text && name ? GG_OK : GG_FAILED;
  if (status == GG_OK) {
    gg_h5_create_in_memory(&h);
    gg_h5_group(&h, "/graingas/table");
    gg_h5_text(&h, "/graingas/version", GG_VERSION);
    gg_h5_text(&h, "/graingas/command", command);
    gg_h5_text_attribute(&h, "/graingas", "kind", "sweep");
    write_columns(&c, t, sweep);
    write_files(&c, t, sweep, name);
    status = write_image(&h, path, err);
  }
  free(c.number);
  free(c.text);
  free(name);
  return status;
}
