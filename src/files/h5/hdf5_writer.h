/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing HDF5 in few words (reading: hdf5_reader.h). The first failure sticks: later calls do nothing, and
 * gg_h5_status reports it, so that a writer reads as the layout of its file. Paths may name groups that are still to be
 * made. */
#ifndef GG_H5_H
#define GG_H5_H

#include <hdf5.h>
#include <stdbool.h>

#include "base/cancellation.h"

typedef struct gg_h5 {
  hid_t file;
  bool failed, interrupted, silenced; /* silenced: HDF5 prints no errors */
  const gg_stop *stop;                /* polled before each array and text; set after the file is made; NULL: never */
  char why[256];
  char path[2][256]; /* of gg_h5_path */
  int last;
  H5E_auto2_t print; /* how HDF5 printed its errors before: it does not here */
  void *print_data;
} gg_h5;

/* A new file on disk, or in memory (path: NULL). */
void gg_h5_create(gg_h5 *h, const char *path);
/* The bytes of a file made in memory, to be freed. */
void *gg_h5_image(gg_h5 *h, size_t *size);
void gg_h5_close(gg_h5 *h);
/* GG_BAD_FILE "path: cannot be `verb`: why" if anything failed; GG_INTERRUPTED by stop. */
gg_status gg_h5_status(const gg_h5 *h, const char *path, const char *verb, gg_error *err);

/* A path in the file; the last two stay. */
const char *gg_h5_path(gg_h5 *h, const char *format, ...) GG_PRINTF(2, 3);
void gg_h5_group(gg_h5 *h, const char *path);
/* Text or data that are NULL could not be had: the file fails, out of memory. */
void gg_h5_text(gg_h5 *h, const char *path, const char *text);
/* n texts as an array of the longest one's size. */
void gg_h5_texts(gg_h5 *h, const char *path, const char *const *texts, size_t n);
void gg_h5_count(gg_h5 *h, const char *path, uint64_t value);
/* An array; `type` of the numbers in memory, and in the file. */
void gg_h5_array(gg_h5 *h, const char *path, hid_t type, int rank, const hsize_t *dims, const void *data);
/* A number, or an array of them, with its unit as an attribute; NULL: none. */
void gg_h5_number(gg_h5 *h, const char *path, double value, const char *unit);
void gg_h5_numbers(gg_h5 *h, const char *path, const double *values, size_t n, const char *unit);
/* A second name for the same thing. */
void gg_h5_link(gg_h5 *h, const char *target, const char *path);
void gg_h5_text_attribute(gg_h5 *h, const char *object, const char *name, const char *text);
void gg_h5_texts_attribute(gg_h5 *h, const char *object, const char *name, const char *const *texts, size_t n);
/* n numbers under the object, which is a file, group or array; n = 0: one, without dimensions */
void gg_h5_attribute(gg_h5 *h, const char *object, const char *name, hid_t type, const void *values, size_t n);

/* An array that grows by one row of `row_rank` dimensions at a time. */
typedef struct gg_h5_rows {
  hid_t dataset;
  hid_t type; /* of the numbers in memory */
  int row_rank;
  hsize_t row[2], n;
} gg_h5_rows;
void gg_h5_rows_create(gg_h5 *h, gg_h5_rows *rows, const char *path, hid_t type, int row_rank, const hsize_t *row);
void gg_h5_rows_append(gg_h5 *h, gg_h5_rows *rows, const void *data);
void gg_h5_rows_read(gg_h5 *h, const gg_h5_rows *rows, size_t row, void *data);
/* Remove the first `n` rows. */
void gg_h5_rows_drop(gg_h5 *h, gg_h5_rows *rows, size_t n);
void gg_h5_rows_close(gg_h5 *h, gg_h5_rows *rows);

/* Record a failure that the caller found, or HDF5's latest one. */
void gg_h5_failed(gg_h5 *h, const char *what);

#endif
