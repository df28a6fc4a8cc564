/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: a checkpoint file with changed words and a valid checksum, read as `info` reads it. archive.c resumes
 * from changed archives. The first byte selects the run; the others are records (patch.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "files/h5/checkpoint_file.h"
#include "fuzz.h"
#include "graingas.h"
#include "image.h"

/* Largest size of an item (numbers; bytes: eight times as many) and largest number of items of the scene. Small files
 * make the target fast; `info` needs no more. */
enum { LONGEST = 64, MOST_OF_SCENE = 4 };

static void cut(gg_archive *a)
{
  size_t kept = 0, of_scene = 0;
  for (size_t i = 0; i < a->n_items; i++) {
    gg_item item = a->items[i];
    const size_t longest = item.type == GG_ITEM_U8 ? 8 * LONGEST : LONGEST;
    if (item.count > longest) item.count = longest;
    if (strncmp(item.name, "scene/", 6) == 0 && ++of_scene > MOST_OF_SCENE)
      free(item.data);
    else
      a->items[kept++] = item;
  }
  a->n_items = kept;
}

static fuzz_image make(size_t which)
{
  char path[80];
  const fuzz_base *base = fuzz_base_of(which);
  gg_archive small = {0};
  snprintf(path, sizeof path, "/tmp/graingas-fuzz-%ld.h5", (long)getpid());
  if (gg_base_archive_append(&small, &base->archive, NULL) != GG_OK) abort();
  cut(&small);
  gg_files_checkpoint_write(path, false, true, &small, &base->scene, NULL);
  gg_base_archive_clear(&small);
  return fuzz_image_of(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static fuzz_image images[FUZZ_BASES];
  if (size < 1) return 0;
  const size_t which = data[0] % FUZZ_BASES;
  if (!images[which].data) images[which] = make(which);
  const char *path = fuzz_image_change(&images[which], data + 1, size - 1);
  gg_checkpoint_info about;
  gg_scene *scene = NULL;
  if (gg_checkpoint_about(path, &about, &scene, NULL) == GG_OK) gg_scene_free(scene);
  fuzz_image_restore(&images[which], data + 1, size - 1);
  return 0;
}
