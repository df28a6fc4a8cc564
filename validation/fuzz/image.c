/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/h5/checksum_trailer.h"
#include "patch.h"

static void fail(const char *what, const char *path)
{
  fprintf(stderr, "image: %s: %s\n", path, what);
  abort();
}

/* A file in memory, to be read by its path and changed in place: what is copied for an input is what it changes. */
static void view(fuzz_image *image)
{
  const size_t whole = image->size + GG_TRAILER_SIZE;
  const int fd = memfd_create("graingas-fuzz", MFD_CLOEXEC);
  snprintf(image->path, sizeof image->path, "/proc/self/fd/%d", fd);
  if (fd < 0 || ftruncate(fd, (off_t)whole) != 0) fail("cannot be made", image->path);
  image->changed = mmap(NULL, whole, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (image->changed == MAP_FAILED) fail("cannot be made", image->path);
  memcpy(image->changed, image->data, image->size);
}

fuzz_image fuzz_image_of_bytes(void *data, size_t size)
{
  fuzz_image image = {.data = data, .size = size, .listed = malloc(size + 1)};
  if (!data || !image.listed) fail("cannot be had", "a file");
  image.words = fuzz_list_words(image.data, size, image.listed, size / sizeof *image.listed);
  view(&image);
  return image;
}

fuzz_image fuzz_image_of(const char *path)
{
  struct stat about;
  FILE *in = fopen(path, "rb");
  if (!in || fstat(fileno(in), &about) != 0 || about.st_size <= GG_TRAILER_SIZE) fail("cannot be read", path);
  const size_t size = (size_t)about.st_size - GG_TRAILER_SIZE;
  void *data = malloc(size);
  if (!data || fread(data, 1, size, in) != size) fail("cannot be read", path);
  fclose(in);
  unlink(path);
  return fuzz_image_of_bytes(data, size);
}

const char *fuzz_image_change(fuzz_image *image, const uint8_t *data, size_t size)
{
  fuzz_patch(image->changed, image->size, image->listed, image->words, data, size);
  gg_files_checksum_trailer_of(image->changed, image->size, image->changed + image->size);
  return image->path;
}

void fuzz_image_restore(fuzz_image *image, const uint8_t *data, size_t size)
{
  fuzz_unpatch(image->changed, image->data, image->size, image->listed, image->words, data, size);
}
