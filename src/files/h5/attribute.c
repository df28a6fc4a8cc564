/* Attributes: name, type, dimensions and value in one message of an object's header. */
#include <stdlib.h>
#include <string.h>

#include "files/h5/hdf5_format.h"

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

static bool look(gg_h5_in *in, const gg_h5_message *m, void *context)
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
  if (header) gg_h5_messages(in, header, look, a);
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
  if (!good) gg_h5_refuse(in, name, "are not the texts that they should be");
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
