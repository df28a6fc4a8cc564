/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every array of a file in chunks that are shuffled and compressed, as h5repack -f SHUF -f GZIP leaves them. */
#include "compressed.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 400 };

typedef struct names {
  size_t n;
  char *name[MOST];
} names;

static herr_t note(hid_t file, const char *name, const H5O_info_t *about, void *all)
{
  names *list = all;
  (void)file;
  if (about->type == H5O_TYPE_DATASET && list->n < MOST) list->name[list->n++] = strdup(name);
  return 0;
}

static herr_t copy_attribute(hid_t from, const char *name, const H5A_info_t *about, void *to)
{
  hid_t old = H5Aopen(from, name, H5P_DEFAULT), type = H5Aget_type(old), space = H5Aget_space(old);
  void *value = calloc(1, about->data_size + 1);
  hid_t new = H5Acreate(*(hid_t *)to, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (H5Aread(old, type, value) < 0 || H5Awrite(new, type, value) < 0) abort();
  free(value);
  H5Aclose(new), H5Sclose(space), H5Tclose(type), H5Aclose(old);
  return 0;
}

static void compress_one(hid_t file, const char *name)
{
  hsize_t size[H5S_MAX_RANK];
  hid_t old = H5Dopen(file, name, H5P_DEFAULT), space = H5Dget_space(old), type = H5Dget_type(old);
  const int rank = H5Sget_simple_extent_dims(space, size, NULL);
  const size_t n = (size_t)H5Sget_simple_extent_npoints(space);
  if (rank > 0 && n > 0 && H5Tis_variable_str(type) <= 0) {
    void *data = malloc(n * H5Tget_size(type));
    hid_t how = H5Pcreate(H5P_DATASET_CREATE), flat = H5Screate_simple(rank, size, NULL);
    H5Pset_chunk(how, rank, size), H5Pset_shuffle(how), H5Pset_deflate(how, 6);
    hid_t new = H5Dcreate(file, "compressed", type, flat, H5P_DEFAULT, how, H5P_DEFAULT);
    if (!data || H5Dread(old, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0 ||
        H5Dwrite(new, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
      abort();
    H5Aiterate(old, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, copy_attribute, &new);
    free(data);
    H5Dclose(new), H5Sclose(flat), H5Pclose(how);
    H5Ldelete(file, name, H5P_DEFAULT);
    H5Lmove(file, "compressed", file, name, H5P_DEFAULT, H5P_DEFAULT);
  }
  H5Tclose(type), H5Sclose(space), H5Dclose(old);
}

void fuzz_compress(hid_t file)
{
  names list = {0};
  if (H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, note, &list) < 0) abort();
  for (size_t i = 0; i < list.n; i++) {
    compress_one(file, list.name[i]);
    free(list.name[i]);
  }
}
