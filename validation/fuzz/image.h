/* A file in memory, with a path: sealed, and read the way that commands read files. */
#ifndef GG_FUZZ_IMAGE_H
#define GG_FUZZ_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "base.h"

typedef struct fuzz_image {
  uint8_t *data; /* of an HDF5 file, without its seal; room for one behind it */
  size_t size, words;
  uint32_t *listed; /* its words that are not 0 */
} fuzz_image;

/* The file at the path, which is removed. Ends the program if it cannot be had. */
fuzz_image fuzz_image_of(const char *path);
/* The image with records of an input put into it, sealed; returns a path that holds until the next call. */
const char *fuzz_image_changed(const fuzz_image *image, const uint8_t *data, size_t size);

#endif
