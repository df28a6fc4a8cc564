/* Old groups: names in a heap, links in leaves of a tree that is sorted by name. */
#include <stdio.h>
#include <string.h>

#include "files/h5/hdf5_format.h"

enum { LONGEST_NAME = 256, MOST_CHILDREN = 1 << 12, TREE = 24, ENTRY = 40 };

typedef struct group {
  uint64_t tree, names, names_bytes;
} group;

static bool damaged(gg_h5_in *in)
{
  gg_h5_in_failed(in, "it is damaged: a group in it");
  return false;
}

/* The name that begins there, cut to `LONGEST_NAME`. */
static bool name_at(gg_h5_in *in, const group *g, uint64_t at, char name[LONGEST_NAME])
{
  if (at >= g->names_bytes) return damaged(in);
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
  if (memcmp(heap, "HEAP", 4) != 0) return damaged(in);
  g->names_bytes = gg_h5_word(heap + 8, 8);
  g->names = gg_h5_word(heap + 24, 8);
  return g->names <= in->size && g->names_bytes <= in->size - g->names ? true : damaged(in);
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
      return damaged(in), 0;
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
  if (memcmp(leaf, "SNOD", 4) != 0 || n > MOST_CHILDREN) return damaged(in), 0;
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

/* Where the k-th object of the path is, which ends at `end`. */
static void note(gg_h5_trail *t, const char *path, size_t end, uint64_t at)
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
    if (at) note(t, path, (size_t)(from - path), at);
  }
  return 0;
}

bool gg_h5_exists(gg_h5_in *in, const char *path)
{
  return !in->failed && gg_h5_find(in, path) != 0 && !in->failed;
}
