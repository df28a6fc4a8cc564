#include "image.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/h5/seal.h"
#include "patch.h"

static void fail(const char *what, const char *path)
{
  fprintf(stderr, "image: %s: %s\n", path, what);
  abort();
}

fuzz_image fuzz_image_of(const char *path)
{
  fuzz_image image = {0};
  struct stat about;
  FILE *in = fopen(path, "rb");
  if (!in || fstat(fileno(in), &about) != 0 || about.st_size < GG_SEAL_SIZE) fail("cannot be read", path);
  const size_t whole = (size_t)about.st_size;
  image.size = whole - GG_SEAL_SIZE;
  image.data = malloc(whole);
  image.listed = malloc(whole);
  if (!image.data || !image.listed || fread(image.data, 1, whole, in) != whole) fail("cannot be read", path);
  image.words = fuzz_list_words(image.data, image.size, image.listed, whole / sizeof *image.listed);
  fclose(in);
  unlink(path);
  return image;
}

const char *fuzz_image_changed(const fuzz_image *image, const uint8_t *data, size_t size)
{
  static int fd = -1;
  static char path[64];
  const size_t whole = image->size + GG_SEAL_SIZE;
  if (fd < 0) fd = memfd_create("graingas-fuzz", MFD_CLOEXEC);
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  uint8_t *changed = malloc(whole);
  if (!changed || fd < 0) fail("out of memory", path);
  memcpy(changed, image->data, image->size);
  fuzz_patch(changed, image->size, image->listed, image->words, data, size);
  gg_seal_of(changed, image->size, changed + image->size);
  if (ftruncate(fd, (off_t)whole) != 0 || pwrite(fd, changed, whole, 0) != (ssize_t)whole)
    fail("cannot be written", path);
  free(changed);
  return path;
}
