/* What the elements of an array or attribute are, and how many. */
#include "files/h5/hdf5_format.h"

/* Numbers that fill their bytes, as processors have them, and texts of fixed length. */
bool gg_h5_type_of(const unsigned char *data, size_t size, gg_h5_type *type)
{
  *type = (gg_h5_type){.kind = GG_H5_OTHER};
  if (size < 8) return false;
  const unsigned class = data[0] & 15, bits = data[1];
  type->size = gg_h5_word(data + 4, 4);
  type->backwards = bits & 1;
  if (class == 0 && size >= 12) {
    const bool whole = gg_h5_word(data + 8, 2) == 0 && gg_h5_word(data + 10, 2) == 8 * type->size;
    const bool sized = type->size == 1 || type->size == 2 || type->size == 4 || type->size == 8;
    if (whole && sized) type->kind = GG_H5_WHOLE;
    type->is_signed = bits & 8;
  } else if (class == 1 && size >= 20) { /* binary32 and binary64: where sign, exponent and fraction stand */
    const bool four = type->size == 4 && data[2] == 31 && data[12] == 23 && data[13] == 8 && data[15] == 23;
    const bool eight = type->size == 8 && data[2] == 63 && data[12] == 52 && data[13] == 11 && data[15] == 52;
    if ((four || eight) && !(bits & 64)) type->kind = GG_H5_REAL;
  } else if (class == 3) {
    type->backwards = false;
    type->kind = GG_H5_TEXT;
  }
  return type->size > 0;
}

bool gg_h5_space_of(const unsigned char *data, size_t size, gg_h5_space *space)
{
  *space = (gg_h5_space){.n = 1};
  if (size < 4 || (data[0] != 1 && data[0] != 2)) return false;
  const size_t head = data[0] == 1 ? 8 : 4;
  const int rank = data[1];
  if (data[0] == 2 && data[3] == 2) return space->n = 0, true; /* nothing at all */
  if (rank > GG_H5_MOST_RANK || size < head + 8 * (size_t)rank) return false;
  space->rank = rank;
  for (int a = 0; a < rank; a++) {
    space->dims[a] = gg_h5_word(data + head + 8 * a, 8);
    if (__builtin_mul_overflow(space->n, space->dims[a], &space->n)) return false;
  }
  return space->n <= INT64_MAX;
}
