/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/h5/hdf5_writer.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The system's word for it ("No space left on device") stands at the bottom of HDF5's error stack. */
static herr_t find_cause(unsigned n, const H5E_error2_t *entry, void *context)
{
  gg_h5 *h = context;
  const char *start = entry->desc ? strstr(entry->desc, "error message = '") : NULL;
  (void)n;
  if (entry->maj_num == H5E_RESOURCE && entry->min_num == H5E_NOSPACE) {
    snprintf(h->why, sizeof h->why, "out of memory");
    return 1;
  }
  if (!start) return 0;
  start += strlen("error message = '");
  const char *end = strchr(start, '\'');
  snprintf(h->why, sizeof h->why, "%.*s", end ? (int)(end - start) : 100, start);
  return 1;
}

void gg_h5_failed(gg_h5 *h, const char *what)
{
  if (h->failed) return;
  h->failed = true;
  /* HDF5 does not always say that it was memory that it lacked; what fails then ends before anything else can. */
  snprintf(h->why, sizeof h->why, "%.200s", errno == ENOMEM ? "out of memory" : what);
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, find_cause, h);
}

/* HDF5 crashes where some of its allocations fail: not even the error is its own then. */
static bool has_room(gg_h5 *h)
{
  if (gg_base_memory_is_room()) return true;
  h->failed = true;
  snprintf(h->why, sizeof h->why, "out of memory");
  return false;
}

/* True if nothing remains to be done. */
static bool is_over(gg_h5 *h)
{
  if (!h->failed && h->stop && gg_stop_asked(h->stop)) h->failed = h->interrupted = true;
  return h->failed || !has_room(h);
}

/* False, with the reason: the first call initialises HDF5. */
static bool start(gg_h5 *h)
{
  *h = (gg_h5){.file = -1};
  if (!has_room(h)) return false;
  errno = 0;
  H5Eget_auto2(H5E_DEFAULT, &h->print, &h->print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  return h->silenced = true;
}

void gg_h5_create(gg_h5 *h, const char *path)
{
  char name[40]; /* HDF5 takes open files of one name for one file, those in memory, too: each has its own */
  if (!start(h)) return;
  snprintf(name, sizeof name, "graingas-%p", (void *)h);
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  bool ready = H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0 &&
               /* the form that hdf5_reader.h reads */
               H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST) >= 0 &&
               (path || H5Pset_fapl_core(access, 1 << 20, 0) >= 0);
  if (!ready) gg_h5_failed(h, "out of memory");
  if (ready) h->file = H5Fcreate(path ? path : name, H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (h->file < 0) gg_h5_failed(h, "HDF5 cannot create it"); /* before the next call clears HDF5's error stack */
  H5Pclose(access);
}

void *gg_h5_image(gg_h5 *h, size_t *size)
{
  if (is_over(h)) return NULL;
  ssize_t needed = H5Fflush(h->file, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(h->file, NULL, 0);
  void *image = needed > 0 ? malloc((size_t)needed) : NULL;
  if (!image || H5Fget_file_image(h->file, image, (size_t)needed) < 0) {
    gg_h5_failed(h, "out of memory");
    free(image);
    return NULL;
  }
  *size = (size_t)needed;
  return image;
}

void gg_h5_close(gg_h5 *h)
{
  if (h->file >= 0 && H5Fclose(h->file) < 0) gg_h5_failed(h, "HDF5 cannot close it");
  if (h->silenced) H5Eset_auto2(H5E_DEFAULT, h->print, h->print_data);
  h->silenced = false;
  h->file = -1;
}

gg_status gg_h5_status(const gg_h5 *h, const char *path, const char *verb, gg_error *err)
{
  if (h->interrupted) return gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted", path);
  return h->failed ? gg_base_fail(err, GG_BAD_FILE, "%s: cannot be %s: %s", path, verb, h->why) : GG_OK;
}

static bool exists(gg_h5 *h, const char *path)
{
  char part[256];
  if (h->failed) return false;
  for (const char *end = path + 1;; end++) { /* every group on the way must exist, too */
    if (*end && *end != '/') continue;
    snprintf(part, sizeof part, "%.*s", (int)(end - path), path);
    if (H5Lexists(h->file, part, H5P_DEFAULT) <= 0) return false;
    if (!*end) return true;
  }
}

const char *gg_h5_path(gg_h5 *h, const char *format, ...)
{
  char *path = h->path[h->last ^= 1];
  va_list args;
  va_start(args, format);
  vsnprintf(path, sizeof h->path[0], format, args);
  va_end(args);
  return path;
}

void gg_h5_group(gg_h5 *h, const char *path)
{
  if (is_over(h) || exists(h, path)) return;
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  hid_t group = H5Gcreate2(h->file, path, links, H5P_DEFAULT, H5P_DEFAULT);
  if (group < 0) gg_h5_failed(h, path);
  H5Gclose(group);
  H5Pclose(links);
}

void gg_h5_link(gg_h5 *h, const char *target, const char *path)
{
  if (is_over(h)) return;
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  if (H5Lcreate_hard(h->file, target, h->file, path, links, H5P_DEFAULT) < 0) gg_h5_failed(h, path);
  H5Pclose(links);
}

/* Arrays, numbers and texts into HDF5 files. */

/* Texts have a fixed length: those of variable length stand elsewhere in a file, where a damaged one leads HDF5 astray.
 */
static hid_t text_type(size_t length)
{
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length ? length : 1);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

static hid_t new_dataset(gg_h5 *h, const char *path, hid_t type, hid_t space, hid_t properties)
{
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  hid_t dataset = H5Dcreate2(h->file, path, type, space, links, properties, H5P_DEFAULT);
  if (dataset < 0) gg_h5_failed(h, path);
  H5Pclose(links);
  return dataset;
}

/* Rank 0: one value. */
void gg_h5_array(gg_h5 *h, const char *path, hid_t type, int rank, const hsize_t *dims, const void *data)
{
  if (!data) gg_h5_failed(h, "out of memory");
  if (is_over(h)) return;
  hid_t space = H5Screate_simple(rank, dims, NULL), dataset = new_dataset(h, path, type, space, H5P_DEFAULT);
  if (dataset >= 0) {
    if (H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) gg_h5_failed(h, path);
    if (H5Dclose(dataset) < 0) gg_h5_failed(h, path);
  }
  H5Sclose(space);
}

void gg_h5_text(gg_h5 *h, const char *path, const char *text)
{
  if (is_over(h)) return;
  hid_t type = text_type(text ? strlen(text) : 0);
  gg_h5_array(h, path, type, 0, NULL, text);
  H5Tclose(type);
}

void gg_h5_number(gg_h5 *h, const char *path, double value, const char *unit)
{
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 0, NULL, &value);
  if (unit) gg_h5_text_attribute(h, path, "unit", unit);
}

void gg_h5_count(gg_h5 *h, const char *path, uint64_t value)
{
  gg_h5_array(h, path, H5T_NATIVE_UINT64, 0, NULL, &value);
}

void gg_h5_numbers(gg_h5 *h, const char *path, const double *values, size_t n, const char *unit)
{
  const hsize_t count = n;
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &count, values);
  if (unit) gg_h5_text_attribute(h, path, "unit", unit);
}

void gg_h5_attribute(gg_h5 *h, const char *object, const char *name, hid_t type, const void *values, size_t n)
{
  if (is_over(h)) return;
  hsize_t count = n;
  hid_t space = H5Screate_simple(n > 0, &count, NULL);
  hid_t attribute = H5Acreate_by_name(h->file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0 || H5Awrite(attribute, type, values) < 0) gg_h5_failed(h, name);
  H5Aclose(attribute);
  H5Sclose(space);
}

void gg_h5_text_attribute(gg_h5 *h, const char *object, const char *name, const char *text)
{
  if (is_over(h)) return;
  hid_t type = text_type(strlen(text));
  gg_h5_attribute(h, object, name, type, text, 0);
  H5Tclose(type);
}

/* All of the longest one's size, filled up with zeros. */
static char *pack(gg_h5 *h, const char *const *texts, size_t n, size_t *longest)
{
  *longest = 1;
  for (size_t i = 0; i < n; i++) *longest = strlen(texts[i]) > *longest ? strlen(texts[i]) : *longest;
  char *packed = calloc(n ? n : 1, *longest);
  if (!packed) gg_h5_failed(h, "out of memory");
  for (size_t i = 0; packed && i < n; i++) memcpy(packed + i * *longest, texts[i], strlen(texts[i]));
  return packed;
}

void gg_h5_texts_attribute(gg_h5 *h, const char *object, const char *name, const char *const *texts, size_t n)
{
  size_t longest;
  char *packed = is_over(h) ? NULL : pack(h, texts, n, &longest);
  if (!packed) return;
  hid_t type = text_type(longest);
  gg_h5_attribute(h, object, name, type, packed, n);
  H5Tclose(type);
  free(packed);
}

void gg_h5_texts(gg_h5 *h, const char *path, const char *const *texts, size_t n)
{
  size_t longest;
  const hsize_t count = n;
  char *packed = is_over(h) ? NULL : pack(h, texts, n, &longest);
  if (!packed) return;
  hid_t type = text_type(longest);
  gg_h5_array(h, path, type, 1, &count, packed);
  H5Tclose(type);
  free(packed);
}

/* A megabyte a chunk at most, and at most one row, which is divided evenly: a chunk is stored whole, also where the row
 * ends within it. Small rows are gathered. */
static void chunk_of(const gg_h5_rows *rows, hsize_t *chunk)
{
  hsize_t item = H5Tget_size(rows->type), width = rows->row_rank > 1 ? rows->row[1] : 1;
  hsize_t room = (1 << 20) / (item * width), parts = (rows->row[0] + room - 1) / room;
  chunk[0] = rows->row_rank ? 1 : 1024;
  chunk[1] = parts ? (rows->row[0] + parts - 1) / parts : 1;
  chunk[2] = width;
}

void gg_h5_rows_create(gg_h5 *h, gg_h5_rows *rows, const char *path, hid_t type, int row_rank, const hsize_t *row)
{
  *rows = (gg_h5_rows){.dataset = -1, .type = type, .row_rank = row_rank};
  if (is_over(h)) return;
  hsize_t dims[3] = {0}, most[3] = {H5S_UNLIMITED}, chunk[3];
  for (int a = 0; a < row_rank; a++) rows->row[a] = dims[a + 1] = most[a + 1] = row[a];
  chunk_of(rows, chunk);
  hid_t properties = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(row_rank + 1, dims, most);
  H5Pset_chunk(properties, row_rank + 1, chunk);
  rows->dataset = new_dataset(h, path, type, space, properties);
  H5Sclose(space);
  H5Pclose(properties);
}

static void set_rows(gg_h5 *h, gg_h5_rows *rows, hsize_t n)
{
  const hsize_t whole[3] = {n, rows->row[0], rows->row[1]};
  if (H5Dset_extent(rows->dataset, whole) < 0) gg_h5_failed(h, "an array cannot grow or shrink");
  rows->n = n;
}

static void move_row(gg_h5 *h, const gg_h5_rows *rows, hsize_t at, bool write, void *data)
{
  const hsize_t from[3] = {at}, size[3] = {1, rows->row[0], rows->row[1]};
  hid_t file = H5Dget_space(rows->dataset), memory = H5Screate_simple(rows->row_rank + 1, size, NULL);
  H5Sselect_hyperslab(file, H5S_SELECT_SET, from, NULL, size, NULL);
  herr_t moved = write ? H5Dwrite(rows->dataset, rows->type, memory, file, H5P_DEFAULT, data)
                       : H5Dread(rows->dataset, rows->type, memory, file, H5P_DEFAULT, data);
  if (moved < 0) gg_h5_failed(h, write ? "an array cannot grow" : "an array cannot be read back");
  H5Sclose(file);
  H5Sclose(memory);
}

void gg_h5_rows_append(gg_h5 *h, gg_h5_rows *rows, const void *data)
{
  if (is_over(h)) return;
  set_rows(h, rows, rows->n + 1);
  move_row(h, rows, rows->n - 1, true, (void *)(uintptr_t)data);
}

void gg_h5_rows_read(gg_h5 *h, const gg_h5_rows *rows, size_t row, void *data)
{
  if (!is_over(h)) move_row(h, rows, row, false, data);
}

void gg_h5_rows_drop(gg_h5 *h, gg_h5_rows *rows, size_t n)
{
  size_t size = H5Tget_size(rows->type);
  for (int a = 0; a < rows->row_rank; a++) size *= rows->row[a];
  void *row = malloc(size);
  if (!row) gg_h5_failed(h, "out of memory");
  for (hsize_t i = n; row && i < rows->n && !is_over(h); i++) {
    move_row(h, rows, i, false, row);
    if (!h->failed) move_row(h, rows, i - n, true, row);
  }
  free(row);
  if (!is_over(h)) set_rows(h, rows, rows->n - n);
}

/* HDF5 writes the rows that it kept only now; if that fails, zeros are in their place. */
void gg_h5_rows_close(gg_h5 *h, gg_h5_rows *rows)
{
  if (rows->dataset >= 0 && H5Dclose(rows->dataset) < 0) gg_h5_failed(h, "an array cannot be closed");
  rows->dataset = -1;
}
