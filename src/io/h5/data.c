/* Arrays, numbers and texts in HDF5 files. */
#include <stdlib.h>
#include <string.h>

#include "io/h5/h5.h"

static hid_t text_type(void)
{
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

static hid_t new_dataset(gg_h5 *h, const char *path, hid_t type, hid_t space, hid_t properties)
{
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  hid_t dataset = H5Dcreate2(h->file, path, type, space, links, properties, H5P_DEFAULT);
  H5Pclose(links);
  if (dataset < 0) gg_h5_failed(h, path);
  return dataset;
}

static void write_dataset(gg_h5 *h, const char *path, hid_t type, hid_t space, const void *data)
{
  hid_t dataset = h->failed ? -1 : new_dataset(h, path, type, space, H5P_DEFAULT);
  if (dataset >= 0) {
    if (H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) gg_h5_failed(h, path);
    if (H5Dclose(dataset) < 0) gg_h5_failed(h, path);
  }
  H5Sclose(space);
}

void gg_h5_text(gg_h5 *h, const char *path, const char *text)
{
  hid_t type = text_type();
  write_dataset(h, path, type, H5Screate(H5S_SCALAR), &text);
  H5Tclose(type);
}

void gg_h5_number(gg_h5 *h, const char *path, double value)
{
  write_dataset(h, path, H5T_NATIVE_DOUBLE, H5Screate(H5S_SCALAR), &value);
}

void gg_h5_count(gg_h5 *h, const char *path, uint64_t value)
{
  write_dataset(h, path, H5T_NATIVE_UINT64, H5Screate(H5S_SCALAR), &value);
}

void gg_h5_array(gg_h5 *h, const char *path, hid_t type, int rank, const hsize_t *dims, const void *data)
{
  write_dataset(h, path, type, H5Screate_simple(rank, dims, NULL), data);
}

void gg_h5_attribute(gg_h5 *h, const char *object, const char *name, hid_t type, const void *values, size_t n)
{
  if (h->failed) return;
  hsize_t count = n;
  hid_t space = n ? H5Screate_simple(1, &count, NULL) : H5Screate(H5S_SCALAR);
  hid_t attribute = H5Acreate_by_name(h->file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0 || H5Awrite(attribute, type, values) < 0) gg_h5_failed(h, name);
  H5Aclose(attribute);
  H5Sclose(space);
}

void gg_h5_text_attribute(gg_h5 *h, const char *object, const char *name, const char *text)
{
  hid_t type = text_type();
  gg_h5_attribute(h, object, name, type, &text, 0);
  H5Tclose(type);
}

void gg_h5_texts_attribute(gg_h5 *h, const char *object, const char *name, const char *const *texts, size_t n)
{
  hid_t type = text_type();
  gg_h5_attribute(h, object, name, type, texts, n);
  H5Tclose(type);
}

void gg_h5_ints_attribute(gg_h5 *h, const char *object, const char *name, const int *values, size_t n)
{
  gg_h5_attribute(h, object, name, H5T_NATIVE_INT, values, n);
}

/* A megabyte a chunk, at most one row; small rows are gathered. */
static void chunk_of(const gg_h5_rows *rows, hsize_t *chunk)
{
  hsize_t item = H5Tget_size(rows->type), width = rows->row_rank > 1 ? rows->row[1] : 1;
  hsize_t room = (1 << 20) / (item * width);
  chunk[0] = rows->row_rank ? 1 : 1024;
  chunk[1] = rows->row[0] < room ? rows->row[0] : room;
  chunk[2] = width;
}

void gg_h5_rows_create(gg_h5 *h, gg_h5_rows *rows, const char *path, hid_t type, int row_rank, const hsize_t *row)
{
  *rows = (gg_h5_rows){.dataset = -1, .type = type, .row_rank = row_rank};
  if (h->failed) return;
  hsize_t dims[3] = {0}, most[3] = {H5S_UNLIMITED}, chunk[3];
  for (int a = 0; a < row_rank; a++) rows->row[a] = dims[a + 1] = most[a + 1] = row[a];
  chunk_of(rows, chunk);
  hid_t properties = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(row_rank + 1, dims, most);
  H5Pset_chunk(properties, row_rank + 1, chunk);
  rows->dataset = new_dataset(h, path, type, space, properties);
  H5Sclose(space);
  H5Pclose(properties);
}

void gg_h5_rows_append(gg_h5 *h, gg_h5_rows *rows, const void *data)
{
  if (h->failed) return;
  int rank = rows->row_rank + 1;
  hsize_t from[3] = {rows->n}, size[3] = {1, rows->row[0], rows->row[1]};
  hsize_t whole[3] = {rows->n + 1, rows->row[0], rows->row[1]};
  if (H5Dset_extent(rows->dataset, whole) < 0) gg_h5_failed(h, "an array cannot grow");
  hid_t file = H5Dget_space(rows->dataset), memory = H5Screate_simple(rank, size, NULL);
  H5Sselect_hyperslab(file, H5S_SELECT_SET, from, NULL, size, NULL);
  if (H5Dwrite(rows->dataset, rows->type, memory, file, H5P_DEFAULT, data) < 0) gg_h5_failed(h, "an array cannot grow");
  H5Sclose(file);
  H5Sclose(memory);
  rows->n++;
}

void gg_h5_rows_close(gg_h5_rows *rows)
{
  if (rows->dataset >= 0) H5Dclose(rows->dataset);
  rows->dataset = -1;
}

char *gg_h5_read_text(gg_h5 *h, const char *path)
{
  if (h->failed) return NULL;
  char *inside = NULL, *text = NULL;
  hid_t dataset = H5Dopen2(h->file, path, H5P_DEFAULT), type = text_type();
  if (dataset < 0 || H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &inside) < 0 || !inside)
    gg_h5_failed(h, path);
  else
    text = strdup(inside);
  if (inside) H5free_memory(inside);
  H5Tclose(type);
  H5Dclose(dataset);
  return text;
}

void *gg_h5_read_array(gg_h5 *h, const char *path, hid_t type, size_t item, size_t *count)
{
  if (h->failed) return NULL;
  hid_t dataset = H5Dopen2(h->file, path, H5P_DEFAULT), space = dataset < 0 ? -1 : H5Dget_space(dataset);
  hssize_t n = space < 0 ? -1 : H5Sget_simple_extent_npoints(space);
  void *data = n < 0 ? NULL : calloc((size_t)n + 1, item);
  if (!data || H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    gg_h5_failed(h, path);
    free(data);
    data = NULL;
  }
  if (space >= 0) H5Sclose(space);
  if (dataset >= 0) H5Dclose(dataset);
  *count = data ? (size_t)n : 0;
  return data;
}

void *gg_h5_read_last_row(gg_h5 *h, const char *path, hid_t type, size_t item, size_t items)
{
  if (h->failed) return NULL;
  hsize_t size[3] = {0}, from[3] = {0}, row = 1;
  hid_t dataset = H5Dopen2(h->file, path, H5P_DEFAULT), space = dataset < 0 ? -1 : H5Dget_space(dataset);
  int rank = space < 0 ? 0 : H5Sget_simple_extent_ndims(space);
  if (rank >= 1 && rank <= 3) H5Sget_simple_extent_dims(space, size, NULL);
  for (int a = 1; a < rank && a < 3; a++) row *= size[a];
  void *data = size[0] && row == items ? calloc(items, item) : NULL;
  from[0] = size[0] - 1, size[0] = 1;
  hid_t memory = data ? H5Screate_simple(rank, size, NULL) : -1;
  bool read = data && H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, size, NULL) >= 0 &&
              H5Dread(dataset, type, memory, space, H5P_DEFAULT, data) >= 0;
  if (memory >= 0) H5Sclose(memory);
  if (space >= 0) H5Sclose(space);
  if (dataset >= 0) H5Dclose(dataset);
  if (read) return data;
  gg_h5_failed(h, path);
  free(data);
  return NULL;
}

void gg_h5_read_attribute(gg_h5 *h, const char *object, const char *name, hid_t type, void *value)
{
  if (h->failed) return;
  hid_t attribute = H5Aopen_by_name(h->file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0 || H5Aread(attribute, type, value) < 0) gg_h5_failed(h, name);
  if (attribute >= 0) H5Aclose(attribute);
}
