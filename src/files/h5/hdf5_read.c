/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays, numbers and texts back from files. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
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
  GG_FREED void *raw = calloc(n + 1, a->type.size);
  void *data = calloc(n + 1, gg_base_archive_item_size(type));
  bool good = raw && data;
  if (!good) gg_h5_in_failed(in, "out of memory");
  good = good && gg_h5_rows_of(in, path, a, from, rows, raw);
  if (good && !gg_h5_convert(&a->type, raw, type, data, n)) good = gg_h5_refuse(in, path, "holds no numbers");
  return good ? data : (free(data), NULL);
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

void *gg_h5_read_row(gg_h5_in *in, const char *path, uint64_t k, gg_item_type type, size_t items)
{
  gg_h5_array_in a;
  if (in->failed || !gg_h5_array_at(in, path, &a)) return NULL;
  const uint64_t rows = a.space.rank ? a.space.dims[0] : 0;
  if (rows == 0 || (k != GG_H5_LAST && k >= rows) || gg_h5_row_size(&a.space) != items)
    return gg_h5_refuse(in, path, "does not have the number of rows expected"), NULL;
  return read_rows(in, path, &a, k == GG_H5_LAST ? rows - 1 : k, 1, type);
}

/* The elements of arrays: in one piece, or in chunks that a tree finds. */

enum { TREE = 24, MOST_CHILDREN = 1 << 12 };

typedef struct parts {
  gg_h5_array_in *array;
  bool type, space, layout;
  const char *wrong;
} parts;

static void read_layout(gg_h5_array_in *a, const unsigned char *d, unsigned size, parts *p)
{
  p->layout = true;
  if (size < 3 || d[0] != 3 || d[1] < 1 || d[1] > 2) {
    p->wrong = "is stored in a way that graingas does not write";
  } else if (d[1] == 1 && size >= 18) {
    a->at = gg_h5_word(d + 2, 8);
    a->bytes = gg_h5_word(d + 10, 8);
  } else if (d[1] == 2 && d[2] >= 2 && d[2] <= GG_H5_MOST_RANK + 1 && size >= 11 + 4u * d[2]) {
    a->chunked = true;
    a->at = gg_h5_word(d + 3, 8);
    for (int i = 0; i < d[2] - 1; i++) a->chunk[i] = gg_h5_word(d + 11 + 4 * i, 4);
    for (int i = d[2] - 1; i < GG_H5_MOST_RANK; i++) a->chunk[i] = 0;
    a->bytes = gg_h5_word(d + 11 + 4 * (d[2] - 1), 4); /* of an element */
  } else {
    p->wrong = "is damaged";
  }
}

static bool look(gg_h5_in *in, const gg_h5_message *m, void *context)
{
  parts *p = context;
  const char *unknown = NULL;
  const bool shared = m->flags & 2;
  (void)in;
  switch (m->kind) {
  case GG_H5_TYPE: p->type = !shared && gg_h5_type_of(m->data, m->size, &p->array->type); break;
  case GG_H5_SPACE: p->space = !shared && gg_h5_space_of(m->data, m->size, &p->array->space); break;
  case GG_H5_LAYOUT: read_layout(p->array, m->data, m->size, p); break;
  case GG_H5_FILTER: unknown = shared ? "is damaged" : gg_h5_filters_of(m->data, m->size, p->array); break;
  case GG_H5_EXTERNAL: p->wrong = "is stored in another file"; break;
  default: break;
  }
  if (unknown) p->wrong = unknown;
  return false;
}

/* Nothing that a file claims to hold is larger than the file; what is compressed well, by a limit. */
static const char *check(const gg_h5_in *in, const gg_h5_array_in *a)
{
  enum { MOST_RATIO = 32, MOST_SMALL = 64 << 20 };
  uint64_t bytes, most = in->size;
  if (a->n_filters) most = MOST_RATIO * most < MOST_SMALL ? MOST_SMALL : MOST_RATIO * most;
  if (__builtin_mul_overflow(a->space.n, a->type.size, &bytes) || bytes > most) return "is larger than its file";
  if (!a->chunked) return bytes == 0 || a->bytes >= bytes ? NULL : "is damaged";
  if (a->bytes != a->type.size || a->space.rank == 0) return "is damaged";
  uint64_t chunk = a->type.size;
  for (int i = 0; i < GG_H5_MOST_RANK; i++) { /* wider than the array: many large ones would hold next to nothing */
    const bool used = i<a->space.rank, wide = i> 0 && a->chunk[i] > a->space.dims[i];
    if (used != (a->chunk[i] > 0) || (used && (wide || __builtin_mul_overflow(chunk, a->chunk[i], &chunk))))
      return "is damaged";
  }
  return chunk <= most || bytes == 0 ? NULL : "is larger than its file";
}

bool gg_h5_array_at(gg_h5_in *in, const char *path, gg_h5_array_in *array)
{
  *array = (gg_h5_array_in){0};
  parts p = {.array = array};
  const uint64_t header = in->failed ? 0 : gg_h5_find(in, path);
  if (!header) return gg_h5_refuse(in, path, "is not there");
  if (!gg_h5_messages(in, header, look, &p)) return false;
  if (!p.layout && !p.type) return gg_h5_refuse(in, path, "is not an array");
  if (!p.type || !p.space || !p.layout) return gg_h5_refuse(in, path, p.wrong ? p.wrong : "is damaged");
  const char *wrong = p.wrong ? p.wrong : check(in, array);
  return wrong ? gg_h5_refuse(in, path, wrong) : true;
}

uint64_t gg_h5_row_size(const gg_h5_space *s)
{
  uint64_t size = 1;
  if (s->n == 0) return 0;
  for (int a = 1; a < s->rank; a++) size *= s->dims[a];
  return size;
}

static bool is_before(const gg_h5_array_in *a, const uint64_t *place, const unsigned char *key)
{
  for (int i = 0; i < a->space.rank; i++) {
    const uint64_t first = gg_h5_word(key + 8 + 8 * i, 8);
    if (place[i] != first) return place[i] < first;
  }
  return false;
}

/* The last child of a node whose key is not beyond the place: its key, and after it where it is. */
static bool choose_child(gg_h5_in *in, const gg_h5_array_in *a, const uint64_t *place, uint64_t keys, unsigned n,
                         unsigned char *key)
{
  const uint64_t each = 8 + 8 * (uint64_t)(a->space.rank + 1) + 8;
  unsigned low = 0, high = n;
  while (high - low > 1) {
    const unsigned middle = low + (high - low) / 2;
    if (!gg_h5_bytes(in, keys + each * middle, key, each)) return false;
    if (is_before(a, place, key))
      high = middle;
    else
      low = middle;
  }
  return gg_h5_bytes(in, keys + each * low, key, each);
}

typedef struct stored_chunk {
  uint64_t at, bytes; /* in the file */
  unsigned skipped;   /* filters, a bit each */
} stored_chunk;

static bool find_chunk(gg_h5_in *in, const gg_h5_array_in *a, const uint64_t *place, stored_chunk *found)
{
  uint64_t at = a->at;
  for (int level = -1;;) {
    unsigned char node[TREE], key[8 + 8 * (GG_H5_MOST_RANK + 1) + 8];
    if (!gg_h5_bytes(in, at, node, sizeof node)) return false;
    const unsigned n = (unsigned)gg_h5_word(node + 6, 2);
    if (memcmp(node, "TREE", 4) != 0 || node[4] != 1 || (level > 0 && node[5] != level - 1) || n == 0 ||
        n > MOST_CHILDREN)
      return false;
    level = node[5];
    if (!choose_child(in, a, place, at + TREE, n, key)) return false;
    at = gg_h5_word(key + 8 + 8 * (a->space.rank + 1), 8);
    if (level > 0) continue;
    *found = (stored_chunk){at, gg_h5_word(key, 4), (unsigned)gg_h5_word(key + 4, 4)};
    for (int i = 0; i < a->space.rank; i++)
      if (place[i] != gg_h5_word(key + 8 + 8 * i, 8)) return false;
    return true;
  }
}

/* Copy the part of a chunk within rows from .. from + n - 1, line by line of its last dimension. */
static void copy_chunk(const gg_h5_array_in *a, const uint64_t *place, const unsigned char *chunk, uint64_t from,
                       uint64_t n, unsigned char *to)
{
  const gg_h5_space *s = &a->space;
  const int last = s->rank - 1;
  uint64_t within[GG_H5_MOST_RANK] = {0}, lines = 1;
  for (int i = 0; i < last; i++) lines *= a->chunk[i];
  for (uint64_t line = 0; line < lines; line++) {
    uint64_t rest = line, index = 0;
    bool inside = true;
    for (int i = last - 1; i >= 0; i--) within[i] = rest % a->chunk[i], rest /= a->chunk[i];
    for (int i = 0; i <= last; i++) {
      const uint64_t x = place[i] + (i < last ? within[i] : 0);
      inside = inside && (i == 0 && last > 0 ? x >= from && x < from + n : x < s->dims[i]);
      index = index * s->dims[i] + (i == 0 ? x - from : x);
    }
    if (!inside) continue;
    uint64_t skip = last == 0 && place[0] < from ? from - place[0] : 0; /* of rows that are single numbers */
    const uint64_t end = last == 0 ? from + n : s->dims[last];
    const uint64_t left = end - place[last] < a->chunk[last] ? end - place[last] : a->chunk[last];
    if (skip >= left) continue;
    memcpy(to + (index + skip) * a->type.size, chunk + (line * a->chunk[last] + skip) * a->type.size,
           (left - skip) * a->type.size);
  }
}

/* The next chunk's place; false after the last that touches rows up to `end` - 1. */
static bool next_place(const gg_h5_array_in *a, uint64_t end, uint64_t *place)
{
  for (int i = a->space.rank - 1; i >= 0; i--) {
    place[i] += a->chunk[i];
    if (place[i] < (i == 0 ? end : a->space.dims[i])) return true;
    if (i > 0) place[i] = 0;
  }
  return false;
}

/* Without filters it is stored as it is. */
static bool read_chunk(gg_h5_in *in, const gg_h5_array_in *a, const stored_chunk *s, unsigned char *chunk,
                       uint64_t bytes)
{
  if (!a->n_filters) return s->bytes == bytes && s->skipped == 0 && gg_h5_bytes(in, s->at, chunk, bytes);
  GG_FREED unsigned char *stored = s->bytes <= in->size ? malloc(s->bytes + 1) : NULL;
  return stored && gg_h5_bytes(in, s->at, stored, s->bytes) &&
         gg_h5_filters_undo(a, s->skipped, stored, s->bytes, chunk, bytes);
}

static bool read_chunks(gg_h5_in *in, const gg_h5_array_in *a, uint64_t from, uint64_t n, unsigned char *to)
{
  uint64_t place[GG_H5_MOST_RANK] = {from / a->chunk[0] * a->chunk[0]}, bytes = a->type.size;
  stored_chunk s;
  for (int i = 0; i < a->space.rank; i++) bytes *= a->chunk[i];
  GG_FREED unsigned char *chunk = malloc(bytes);
  bool good = chunk != NULL;
  do {
    good = good && find_chunk(in, a, place, &s) && read_chunk(in, a, &s, chunk, bytes);
    if (good) copy_chunk(a, place, chunk, from, n, to);
  } while (good && next_place(a, from + n, place));
  return good;
}

bool gg_h5_rows_of(gg_h5_in *in, const char *path, const gg_h5_array_in *a, uint64_t from, uint64_t n, void *to)
{
  const uint64_t row = gg_h5_row_size(&a->space) * a->type.size, rows = a->space.rank ? a->space.dims[0] : 1;
  if (n == 0 || row == 0) return !in->failed;
  if (from > rows || n > rows - from) return gg_h5_refuse(in, path, "has fewer rows than expected");
  if (a->chunked) return read_chunks(in, a, from, n, to) ? true : gg_h5_refuse(in, path, "is damaged");
  if (a->at > in->size) return gg_h5_refuse(in, path, "is damaged");
  return gg_h5_bytes(in, a->at + from * row, to, n * row);
}
