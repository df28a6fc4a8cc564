/* Arrays, numbers and texts into HDF5 files. */
#include <stdlib.h>
#include <string.h>

#include "files/h5/hdf5_writer.h"

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
  hid_t type = text_type(strlen(text));
  write_dataset(h, path, type, H5Screate(H5S_SCALAR), text);
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
  char *packed = pack(h, texts, n, &longest);
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
  char *packed = pack(h, texts, n, &longest);
  if (!packed) return;
  hid_t type = text_type(longest);
  gg_h5_array(h, path, type, 1, &count, packed);
  H5Tclose(type);
  free(packed);
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

/* What HDF5 kept of the rows is written only now: where that fails, zeros stand in its place. */
void gg_h5_rows_close(gg_h5 *h, gg_h5_rows *rows)
{
  if (rows->dataset >= 0 && H5Dclose(rows->dataset) < 0) gg_h5_failed(h, "an array cannot be closed");
  rows->dataset = -1;
}
