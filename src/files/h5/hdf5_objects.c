/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The objects of an HDF5 file: headers of groups and arrays, members of groups, attributes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "files/h5/hdf5_format.h"

/* Headers of objects, version 1: messages in one block, or in several of which one names the next. */

enum { PREFIX = 16, MESSAGE = 8 };
static const char bad_header[] = "it is damaged: the header of an object in it",
                  bad_group[] = "it is damaged: a group in it";

typedef struct walk {
  gg_h5_look *look;
  void *context;
  unsigned left;             /* messages */
  uint64_t next, next_bytes; /* the block to follow; 0: none */
  bool done;
} walk;

static bool damaged(gg_h5_in *in, const char *what)
{
  return gg_h5_in_failed(in, what), false;
}

static bool show_block(gg_h5_in *in, walk *w, const unsigned char *block, uint64_t bytes)
{
  while (bytes >= MESSAGE && w->left > 0 && !w->done) {
    const gg_h5_message m = {(unsigned)gg_h5_word(block, 2), block[4], (unsigned)gg_h5_word(block + 2, 2),
                             block + MESSAGE};
    if (m.size > bytes - MESSAGE) return damaged(in, bad_header);
    w->left--;
    if (m.kind == GG_H5_CONTINUED) {
      if (m.size < 16 || w->next) return damaged(in, bad_header);
      w->next = gg_h5_word(m.data, 8);
      w->next_bytes = gg_h5_word(m.data + 8, 8);
    } else {
      w->done = w->look(in, &m, w->context);
    }
    block += MESSAGE + m.size;
    bytes -= MESSAGE + m.size;
  }
  return !in->failed;
}

/* Each block takes a message of those that are left to name it, so that no circle is followed for ever. */
bool gg_h5_messages(gg_h5_in *in, uint64_t header, gg_h5_look *look, void *context)
{
  unsigned char start[PREFIX];
  if (!gg_h5_bytes(in, header, start, sizeof start)) return false;
  if (start[0] == 'O') return gg_h5_in_failed(in, "it is of a form of HDF5 that graingas does not write"), false;
  if (start[0] != 1) return damaged(in, bad_header);
  walk w = {.look = look, .context = context, .left = (unsigned)gg_h5_word(start + 2, 2)};
  w.next = header + PREFIX;
  w.next_bytes = gg_h5_word(start + 8, 4);
  while (w.next && w.left > 0 && !w.done && !in->failed) {
    const uint64_t at = w.next, bytes = w.next_bytes;
    if (bytes > 16 * GG_H5_MOST_HEADER || bytes > in->size) return damaged(in, bad_header);
    GG_FREED unsigned char *block = malloc(bytes + 1);
    w.next = 0;
    if (!block)
      gg_h5_in_failed(in, "out of memory");
    else if (gg_h5_bytes(in, at, block, bytes))
      show_block(in, &w, block, bytes);
  }
  return !in->failed;
}

/* Old groups: names in a heap, links in leaves of a tree that is sorted by name. */
enum { LONGEST_NAME = 256, MOST_CHILDREN = 1 << 12, TREE = 24, ENTRY = 40 };

typedef struct group {
  uint64_t tree, names, names_bytes;
} group;

/* The name that begins there, cut to `LONGEST_NAME`. */
static bool name_at(gg_h5_in *in, const group *g, uint64_t at, char name[LONGEST_NAME])
{
  if (at >= g->names_bytes) return damaged(in, bad_group);
  const uint64_t left = g->names_bytes - at;
  const size_t n = left < LONGEST_NAME - 1 ? (size_t)left : LONGEST_NAME - 1;
  name[n] = '\0';
  return gg_h5_bytes(in, g->names + at, name, n);
}

static bool find_table(gg_h5_in *in, const gg_h5_message *m, void *context)
{
  group *g = context;
  (void)in;
  if (m->kind != GG_H5_TABLE || m->size < 16) return false;
  g->tree = gg_h5_word(m->data, 8);
  g->names = gg_h5_word(m->data + 8, 8);
  return true;
}

static bool open_heap(gg_h5_in *in, group *g)
{
  unsigned char heap[32];
  if (!gg_h5_bytes(in, g->names, heap, sizeof heap)) return false;
  if (memcmp(heap, "HEAP", 4) != 0) return damaged(in, bad_group);
  g->names_bytes = gg_h5_word(heap + 8, 8);
  g->names = gg_h5_word(heap + 24, 8);
  return g->names <= in->size && g->names_bytes <= in->size - g->names ? true : damaged(in, bad_group);
}

/* The first child whose last name is not before `word`, of a node with so many; *at: where it is. */
static bool choose_child(gg_h5_in *in, const group *g, const char *word, uint64_t keys, unsigned n, uint64_t *at)
{
  unsigned char pair[16];
  char name[LONGEST_NAME];
  unsigned low = 0, high = n; /* the one is among low .. high - 1 */
  while (high - low > 1) {
    const unsigned middle = low + (high - low) / 2; /* its key: the last name of the child before */
    if (!gg_h5_bytes(in, keys + 16 * (uint64_t)middle, pair, 8)) return false;
    if (!name_at(in, g, gg_h5_word(pair, 8), name)) return false;
    if (strcmp(word, name) > 0)
      low = middle;
    else
      high = middle;
  }
  if (!gg_h5_bytes(in, keys + 16 * (uint64_t)low, pair, 16)) return false;
  *at = gg_h5_word(pair + 8, 8);
  return true;
}

/* Down the tree, each level lower than the one before, to the leaf where the name has to be; 0: to none. */
static uint64_t find_leaf(gg_h5_in *in, const group *g, const char *word)
{
  uint64_t at = g->tree;
  for (int level = -1; level != 0;) {
    unsigned char node[TREE];
    if (!gg_h5_bytes(in, at, node, sizeof node)) return 0;
    const unsigned n = (unsigned)gg_h5_word(node + 6, 2);
    if (memcmp(node, "TREE", 4) != 0 || node[4] != 0 || (level > 0 && node[5] != level - 1) || n > MOST_CHILDREN)
      return damaged(in, bad_group), 0;
    level = node[5];
    if (n == 0) return 0;
    if (!choose_child(in, g, word, at + TREE, n, &at)) return 0;
    if (level == 0) break;
  }
  return at;
}

static uint64_t find_in_leaf(gg_h5_in *in, const group *g, const char *word, uint64_t at)
{
  unsigned char leaf[8], entry[ENTRY];
  char name[LONGEST_NAME];
  if (!gg_h5_bytes(in, at, leaf, sizeof leaf)) return 0;
  const unsigned n = (unsigned)gg_h5_word(leaf + 6, 2);
  if (memcmp(leaf, "SNOD", 4) != 0 || n > MOST_CHILDREN) return damaged(in, bad_group), 0;
  for (unsigned i = 0; i < n; i++) {
    if (!gg_h5_bytes(in, at + 8 + (uint64_t)ENTRY * i, entry, sizeof entry)) return 0;
    if (!name_at(in, g, gg_h5_word(entry, 8), name)) return 0;
    if (strcmp(word, name) == 0) return gg_h5_word(entry + 8, 8);
  }
  return 0;
}

static bool open_group(gg_h5_in *in, uint64_t header, group *g)
{
  gg_h5_trail *t = &in->trail;
  if (header == t->group) {
    *g = (group){t->tree, t->names, t->names_bytes};
    return true;
  }
  if (!gg_h5_messages(in, header, find_table, g) || !g->tree) return false; /* an array has no members */
  if (!open_heap(in, g)) return false;
  t->group = header, t->tree = g->tree, t->names = g->names, t->names_bytes = g->names_bytes;
  return true;
}

static uint64_t find_member(gg_h5_in *in, uint64_t header, const char *word)
{
  group g = {0};
  if (!open_group(in, header, &g)) return 0;
  const uint64_t leaf = find_leaf(in, &g, word);
  const uint64_t found = leaf ? find_in_leaf(in, &g, word, leaf) : 0;
  return found == GG_H5_NOWHERE ? 0 : found; /* a link to elsewhere */
}

/* Forgets what the path has not in common with the last; returns where the rest of it begins. */
static const char *follow_trail(gg_h5_trail *t, const char *path)
{
  size_t same = 0;
  while (path[same] && path[same] == t->path[same]) same++;
  while (t->depth > 0) {
    const size_t end = t->end[t->depth - 1];
    if (end <= same && (path[end] == '/' || path[end] == '\0')) return path + end;
    t->depth--;
  }
  return path;
}

/* Position of the k-th object of the path, which ends at `end`. */
static void remember(gg_h5_trail *t, const char *path, size_t end, uint64_t at)
{
  if (end >= sizeof t->path || t->depth == GG_H5_DEEPEST) return;
  memcpy(t->path, path, end);
  t->path[end] = '\0';
  t->end[t->depth] = end;
  t->at[t->depth++] = at;
}

uint64_t gg_h5_find(gg_h5_in *in, const char *path)
{
  char word[LONGEST_NAME];
  gg_h5_trail *t = &in->trail;
  const char *from = follow_trail(t, path);
  uint64_t at = t->depth ? t->at[t->depth - 1] : in->root;
  while (at && !in->failed) {
    from += strspn(from, "/");
    const size_t length = strcspn(from, "/");
    if (length == 0) return at;
    if (length >= sizeof word) return 0;
    snprintf(word, sizeof word, "%.*s", (int)length, from);
    at = find_member(in, at, word);
    from += length;
    if (at) remember(t, path, (size_t)(from - path), at);
  }
  return 0;
}

bool gg_h5_exists(gg_h5_in *in, const char *path)
{
  return !in->failed && gg_h5_find(in, path) != 0 && !in->failed;
}

/* Attributes: name, type, dimensions and value in one message of an object's header. */

typedef struct attribute {
  const char *wanted;
  bool found;
  gg_h5_type type;
  gg_h5_space space;
  unsigned char *value; /* of all elements, and a zero; NULL: not as it has to be */
} attribute;

/* The parts of a message, the first version filling each up to eight bytes. */
static bool part(const unsigned char **at, size_t *left, size_t size, bool padded, const unsigned char **found)
{
  const size_t whole = padded ? (size + 7) / 8 * 8 : size;
  if (whole > *left) return false;
  *found = *at;
  *at += whole;
  *left -= whole;
  return true;
}

static bool read_value(attribute *a, const unsigned char *at, size_t left, const size_t size[3], bool padded)
{
  const unsigned char *name, *type, *space;
  const size_t length = strlen(a->wanted);
  uint64_t bytes;
  if (!part(&at, &left, size[0], padded, &name) || size[0] != length + 1 || memcmp(name, a->wanted, length + 1) != 0)
    return false;
  a->found = true;
  if (!part(&at, &left, size[1], padded, &type) || !part(&at, &left, size[2], padded, &space)) return true;
  if (!gg_h5_type_of(type, size[1], &a->type) || !gg_h5_space_of(space, size[2], &a->space)) return true;
  if (__builtin_mul_overflow(a->space.n, a->type.size, &bytes) || bytes > left) return true;
  a->value = calloc(bytes + 1, 1);
  if (a->value && bytes) memcpy(a->value, at, bytes);
  return true;
}

static bool read_attribute_message(gg_h5_in *in, const gg_h5_message *m, void *context)
{
  const unsigned char *d = m->data;
  (void)in;
  if (m->kind != GG_H5_ATTRIBUTE || m->flags & 2 || m->size < 9 || d[0] < 1 || d[0] > 3) return false;
  const size_t size[] = {gg_h5_word(d + 2, 2), gg_h5_word(d + 4, 2), gg_h5_word(d + 6, 2)}, head = d[0] == 3 ? 9 : 8;
  if (d[0] > 1 && d[1] != 0) return false; /* its type stands elsewhere */
  return read_value(context, d + head, m->size - head, size, d[0] == 1);
}

/* Its value is to be freed. */
static bool find(gg_h5_in *in, const char *object, attribute *a)
{
  const uint64_t header = in->failed ? 0 : gg_h5_find(in, object);
  if (header) gg_h5_messages(in, header, read_attribute_message, a);
  return a->found && !in->failed;
}

static attribute read_it(gg_h5_in *in, const char *object, const char *name)
{
  attribute a = {.wanted = name};
  if (!find(in, object, &a))
    gg_h5_refuse(in, name, "is not there");
  else if (!a.value)
    gg_h5_refuse(in, name, "is damaged");
  return a;
}

bool gg_h5_has_attribute(gg_h5_in *in, const char *object, const char *name)
{
  attribute a = {.wanted = name};
  const bool there = find(in, object, &a);
  free(a.value);
  return there;
}

char *gg_h5_read_text_attribute(gg_h5_in *in, const char *object, const char *name)
{
  if (in->failed) return NULL;
  const attribute a = read_it(in, object, name);
  if (!in->failed && a.type.kind == GG_H5_TEXT && a.space.n == 1) return (char *)a.value;
  gg_h5_refuse(in, name, "is not a text of fixed length");
  free(a.value);
  return NULL;
}

void gg_h5_read_initials(gg_h5_in *in, const char *object, const char *name, char *letters, size_t n)
{
  if (in->failed) return;
  const attribute a = read_it(in, object, name);
  const bool good = !in->failed && a.type.kind == GG_H5_TEXT && a.space.n == n;
  for (size_t i = 0; good && i < n; i++) letters[i] = (char)a.value[i * a.type.size];
  if (!good) gg_h5_refuse(in, name, "are not valid texts");
  free(a.value);
}

void gg_h5_read_attribute(gg_h5_in *in, const char *object, const char *name, gg_item_type type, void *value)
{
  if (in->failed) return;
  const attribute a = read_it(in, object, name);
  if (!in->failed && (a.space.n != 1 || !gg_h5_convert(&a.type, a.value, type, value, 1)))
    gg_h5_refuse(in, name, "is not a number");
  free(a.value);
}
