/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file in memory, with a path: sealed, and read the way that commands read files. */
#ifndef GG_FUZZ_IMAGE_H
#define GG_FUZZ_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base.h"

typedef struct fuzz_image {
  uint8_t *data, *changed; /* of an HDF5 file, without its seal; and that file, where it is changed */
  size_t size, words;
  uint32_t *listed; /* its words that are not 0 */
  char path[32];    /* of a file in memory, of which `changed` is a view */
} fuzz_image;

/* The file at the path, which is removed, or bytes without a seal, which are taken over. Ends the program if there are
 * none. */
fuzz_image fuzz_image_of(const char *path);
fuzz_image fuzz_image_of_bytes(void *data, size_t size);
/* small_result.c: of a result at the path, which is removed, what readers look at; with the scene as it was given. */
fuzz_image fuzz_small_result(const char *path, const char *scene, bool compressed);
/* The image with records of an input put into it, sealed; its path. To be taken back before the next change. */
const char *fuzz_image_change(fuzz_image *image, const uint8_t *data, size_t size);
void fuzz_image_take_back(fuzz_image *image, const uint8_t *data, size_t size);

#endif
