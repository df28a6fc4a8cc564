/* A checkpoint whose checksum is right, words of the file changed: the archive that comes out of it, and what `info`
 * says. What a run makes of archives: archive.c. The first byte chooses the run; the rest are records (patch.h). */
#include <stdio.h>
#include <unistd.h>

#include "fuzz.h"
#include "graingas.h"
#include "image.h"
#include "io/h5/checkpoint_file.h"

static fuzz_image make(size_t which)
{
  char path[80];
  const fuzz_base *base = fuzz_base_of(which);
  snprintf(path, sizeof path, "/tmp/graingas-fuzz-%ld.h5", (long)getpid());
  gg_checkpoint_write(path, false, &base->archive, &base->scene, NULL);
  return fuzz_image_of(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static fuzz_image images[FUZZ_BASES];
  if (size < 1) return 0;
  const size_t which = data[0] % FUZZ_BASES;
  if (!images[which].data) images[which] = make(which);
  const char *path = fuzz_image_changed(&images[which], data + 1, size - 1);
  gg_archive archive = {0};
  gg_checkpoint_info about;
  gg_scene *scene = NULL;
  bool older;
  if (gg_checkpoint_read(path, &archive, &older, NULL) == GG_OK) gg_archive_clear(&archive);
  if (gg_checkpoint_about(path, &about, &scene, NULL) == GG_OK) gg_scene_free(scene);
  return 0;
}
