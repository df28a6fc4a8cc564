/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5's format as far as it is read here (File Format Specification, version 3). Functions return false where a file
 * is not as it must be, and have said so. */
#ifndef GG_H5_FORMAT_H
#define GG_H5_FORMAT_H

#include "files/h5/hdf5_reader.h"

enum { GG_H5_MOST_RANK = 4, GG_H5_MOST_HEADER = 1 << 16 };
#define GG_H5_NOWHERE UINT64_MAX

/* file_reader.c: bytes of the file, all of them within it; whole numbers, lowest byte first. */
bool gg_h5_bytes(gg_h5_in *in, uint64_t at, void *to, uint64_t n);
uint64_t gg_h5_word(const unsigned char *from, int bytes);
/* A failure, with what was being read. Always false. */
bool gg_h5_refuse(gg_h5_in *in, const char *what, const char *why);

/* hdf5_objects.c: where the header of an object is; 0: there is none of that path. */
uint64_t gg_h5_find(gg_h5_in *in, const char *path);

/* hdf5_objects.c: the messages of an object's header. */
typedef enum gg_h5_kind {
  GG_H5_SPACE = 1,
  GG_H5_TYPE = 3,
  GG_H5_EXTERNAL = 7,
  GG_H5_LAYOUT = 8,
  GG_H5_FILTER = 11,
  GG_H5_ATTRIBUTE = 12,
  GG_H5_CONTINUED = 16,
  GG_H5_TABLE = 17
} gg_h5_kind;
typedef struct gg_h5_message {
  unsigned kind, flags, size;
  const unsigned char *data;
} gg_h5_message;
/* Shown until one call says that it has seen enough: true. */
typedef bool gg_h5_look(gg_h5_in *in, const gg_h5_message *message, void *context);
bool gg_h5_messages(gg_h5_in *in, uint64_t header, gg_h5_look *look, void *context);

/* hdf5_types.c: what an array's elements are, and how many. */
typedef struct gg_h5_type {
  enum { GG_H5_OTHER, GG_H5_WHOLE, GG_H5_REAL, GG_H5_TEXT } kind;
  bool is_signed, backwards; /* highest byte first */
  size_t size;
} gg_h5_type;
typedef struct gg_h5_space {
  int rank;
  uint64_t dims[GG_H5_MOST_RANK], n;
} gg_h5_space;
bool gg_h5_type_of(const unsigned char *data, size_t size, gg_h5_type *type);
bool gg_h5_space_of(const unsigned char *data, size_t size, gg_h5_space *space);

/* Filters of chunks in the order in which they were applied on writing; 1 to 3 as HDF5 numbers them. */
enum { GG_H5_GZIP = 1, GG_H5_SHUFFLE = 2, GG_H5_FLETCHER32 = 3, GG_H5_MOST_FILTERS = 4 };

/* An array, and elements of it. */
typedef struct gg_h5_array_in {
  gg_h5_type type;
  gg_h5_space space;
  bool chunked;
  uint64_t at, bytes; /* of the data, or of the tree of chunks */
  uint64_t chunk[GG_H5_MOST_RANK];
  int n_filters;
  unsigned filter[GG_H5_MOST_FILTERS];
} gg_h5_array_in;
bool gg_h5_array_at(gg_h5_in *in, const char *path, gg_h5_array_in *array);
/* Rows `from` .. `from` + `n` - 1 as they stand in the file, into room of their size. A scalar is row 0. */
bool gg_h5_rows_of(gg_h5_in *in, const char *path, const gg_h5_array_in *array, uint64_t from, uint64_t n, void *to);
/* Elements of a row; 0 where there is none. */
uint64_t gg_h5_row_size(const gg_h5_space *space);

/* hdf5_filters.c: what is wrong with the message of an array's filters; NULL: they are known. */
const char *gg_h5_filters_of(const unsigned char *data, size_t size, gg_h5_array_in *array);
/* A stored chunk back to its `bytes` bytes; bits of `skipped` are filters that were left out. False: it is damaged, or
 * there is no memory. */
bool gg_h5_filters_undo(const gg_h5_array_in *array, unsigned skipped, const unsigned char *stored, size_t n,
                        unsigned char *chunk, size_t bytes);

/* hdf5_types.c: n numbers of a file in another type. False: these are no numbers. */
bool gg_h5_convert(const gg_h5_type *from, const void *data, gg_item_type type, void *to, size_t n);

#endif
