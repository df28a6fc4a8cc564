/* Arrays, numbers and texts back from HDF5 files. */
#include <stdlib.h>

#include "io/h5/h5.h"

/* The length of a text type as we write them; 0: it is none. */
static size_t text_length(hid_t type)
{
  bool text = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
  return text ? H5Tget_size(type) : 0;
}

/* One thing, not an array of them? */
static bool is_one(hid_t space)
{
  bool one = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
  if (space >= 0) H5Sclose(space);
  return one;
}

char *gg_h5_read_text(gg_h5 *h, const char *path)
{
  if (h->failed) return NULL;
  hid_t dataset = H5Dopen2(h->file, path, H5P_DEFAULT), type = dataset < 0 ? -1 : H5Dget_type(dataset);
  size_t length = is_one(dataset < 0 ? -1 : H5Dget_space(dataset)) ? text_length(type) : 0;
  char *text = length ? calloc(length + 1, 1) : NULL;
  if (!text || H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) < 0) {
    gg_h5_failed(h, path);
    free(text);
    text = NULL;
  }
  if (type >= 0) H5Tclose(type);
  if (dataset >= 0) H5Dclose(dataset);
  return text;
}

char *gg_h5_read_text_attribute(gg_h5 *h, const char *object, const char *name)
{
  if (h->failed) return NULL;
  hid_t attribute = H5Aopen_by_name(h->file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  hid_t type = attribute < 0 ? -1 : H5Aget_type(attribute);
  size_t length = is_one(attribute < 0 ? -1 : H5Aget_space(attribute)) ? text_length(type) : 0;
  char *text = length ? calloc(length + 1, 1) : NULL;
  if (!text || H5Aread(attribute, type, text) < 0) {
    gg_h5_failed(h, name);
    free(text);
    text = NULL;
  }
  if (type >= 0) H5Tclose(type);
  if (attribute >= 0) H5Aclose(attribute);
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

/* `k`: which; NULL: the last. */
static void *read_row(gg_h5 *h, const char *path, const hsize_t *k, hid_t type, size_t item, size_t items)
{
  if (h->failed) return NULL;
  hsize_t size[3] = {0}, from[3] = {0}, row = 1;
  hid_t dataset = H5Dopen2(h->file, path, H5P_DEFAULT), space = dataset < 0 ? -1 : H5Dget_space(dataset);
  int rank = space < 0 ? 0 : H5Sget_simple_extent_ndims(space);
  if (rank >= 1 && rank <= 3) H5Sget_simple_extent_dims(space, size, NULL);
  for (int a = 1; a < rank && a < 3; a++) row *= size[a];
  void *data = (k ? *k < size[0] : size[0] > 0) && row == items ? calloc(items, item) : NULL;
  from[0] = k ? *k : size[0] - 1, size[0] = 1;
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

void *gg_h5_read_row(gg_h5 *h, const char *path, hsize_t k, hid_t type, size_t item, size_t items)
{
  return read_row(h, path, &k, type, item, items);
}

void *gg_h5_read_last_row(gg_h5 *h, const char *path, hid_t type, size_t item, size_t items)
{
  return read_row(h, path, NULL, type, item, items);
}

bool gg_h5_has_attribute(gg_h5 *h, const char *object, const char *name)
{
  return !h->failed && H5Aexists_by_name(h->file, object, name, H5P_DEFAULT) > 0;
}

void gg_h5_read_attribute(gg_h5 *h, const char *object, const char *name, hid_t type, void *value)
{
  if (h->failed) return;
  hid_t attribute = H5Aopen_by_name(h->file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0 || H5Aread(attribute, type, value) < 0) gg_h5_failed(h, name);
  if (attribute >= 0) H5Aclose(attribute);
}
