/* Arrays, numbers and texts back from files. */
#include <stdlib.h>
#include <string.h>

#include "files/h5/hdf5_format.h"

char *gg_h5_read_text(gg_h5_in *in, const char *path)
{
  gg_h5_array_in a;
  if (in->failed || !gg_h5_array_at(in, path, &a)) return NULL;
  if (a.type.kind != GG_H5_TEXT || a.space.n != 1) return gg_h5_refuse(in, path, "is not a text of fixed length"), NULL;
  char *text = calloc(a.type.size + 1, 1);
  if (!text) return gg_h5_in_failed(in, "out of memory"), NULL;
  if (gg_h5_rows_of(in, path, &a, 0, 1, text)) return text;
  free(text);
  return NULL;
}

/* Rows of an array as numbers of the type; one element of room more, so that none is not NULL. */
static void *read_rows(gg_h5_in *in, const char *path, const gg_h5_array_in *a, uint64_t from, uint64_t rows,
                       gg_item_type type)
{
  const uint64_t n = rows * gg_h5_row_size(&a->space);
  void *raw = calloc(n + 1, a->type.size), *data = calloc(n + 1, gg_base_archive_item_size(type));
  bool good = raw && data;
  if (!good) gg_h5_in_failed(in, "out of memory");
  good = good && gg_h5_rows_of(in, path, a, from, rows, raw);
  if (good && !gg_h5_convert(&a->type, raw, type, data, n)) good = gg_h5_refuse(in, path, "holds no numbers");
  free(raw);
  if (good) return data;
  free(data);
  return NULL;
}

void *gg_h5_read_array(gg_h5_in *in, const char *path, gg_item_type type, size_t *count)
{
  gg_h5_array_in a;
  *count = 0;
  if (in->failed || !gg_h5_array_at(in, path, &a)) return NULL;
  void *data = read_rows(in, path, &a, 0, a.space.rank ? a.space.dims[0] : 1, type);
  *count = data ? a.space.n : 0;
  return data;
}

size_t gg_h5_count_of(gg_h5_in *in, const char *path)
{
  gg_h5_array_in a;
  if (!gg_h5_exists(in, path) || !gg_h5_array_at(in, path, &a)) return 0;
  return a.space.n;
}

/* `k`: which; NULL: the last. */
static void *read_row(gg_h5_in *in, const char *path, const uint64_t *k, gg_item_type type, size_t items)
{
  gg_h5_array_in a;
  if (in->failed || !gg_h5_array_at(in, path, &a)) return NULL;
  const uint64_t rows = a.space.rank ? a.space.dims[0] : 0;
  if (rows == 0 || (k && *k >= rows) || gg_h5_row_size(&a.space) != items)
    return gg_h5_refuse(in, path, "has not the rows that are needed"), NULL;
  return read_rows(in, path, &a, k ? *k : rows - 1, 1, type);
}

void *gg_h5_read_row(gg_h5_in *in, const char *path, uint64_t k, gg_item_type type, size_t items)
{
  return read_row(in, path, &k, type, items);
}

void *gg_h5_read_last_row(gg_h5_in *in, const char *path, gg_item_type type, size_t items)
{
  return read_row(in, path, NULL, type, items);
}
