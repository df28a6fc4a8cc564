/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file in memory with a path and a valid checksum trailer, which commands can read like any file. */
#ifndef GG_FUZZ_IMAGE_H
#define GG_FUZZ_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base.h"

typedef struct fuzz_image {
  uint8_t *data, *changed; /* HDF5 file without the trailer; the copy that is changed, mapped from `path` */
  size_t size, words;
  uint32_t *listed; /* indices of the words that are not 0 */
  char path[32];    /* of the file in memory */
} fuzz_image;

/* Image of the file at the path, which is removed, or of bytes without a trailer, which the image then owns. Aborts the
 * program if there is no file. */
fuzz_image fuzz_image_of(const char *path);
fuzz_image fuzz_image_of_bytes(void *data, size_t size);
/* small_result.c: image of the result at the path, which is removed, cut to the parts that readers read. `scene` is
 * its scene. */
fuzz_image fuzz_small_result(const char *path, const char *scene, bool compressed);
/* Apply the records of an input and write the checksum; returns the path. Call fuzz_image_restore with the same input
 * before the next change. */
const char *fuzz_image_change(fuzz_image *image, const uint8_t *data, size_t size);
void fuzz_image_restore(fuzz_image *image, const uint8_t *data, size_t size);

#endif
