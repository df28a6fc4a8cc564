/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A result file whose checksum is right, words of it changed: what `info`, `plot` and `export` read of it. The first
 * byte chooses a run or a comparison, who reads it, and whether its arrays are compressed; the rest are records
 * (patch.h).
 */
#include <stdio.h>
#include <unistd.h>

#include "files/h5/result_reader.h"
#include "fuzz.h"
#include "graingas.h"
#include "image.h"

static const char *const scenes[] = {
    "{flow: usf, phi: 0.1, particles: 10, collision: {e: 0.9, beta: 0}, run: {collisions: 6, warmup: 2}, output: "
    "{trajectory_every: 4}}",
    "{flow: couette, phi: 0.1, particles: 10, measure: [rheology, profiles], run: {collisions: 6, warmup: 2}, output: "
    "{trajectory_every: 4}}",
    "{flow: hcs, phi: 0.1, engine: dsmc, species: [{fraction: 0.5}, {fraction: 0.5, mass: 2}], dsmc: {particles: 16}, "
    "run: {collisions: 6, warmup: 2}}",
    "{flow: equilibrium, phi: 0.1, particles: 10, dsmc: {particles: 16}, run: {collisions: 6, warmup: 2}}"};
enum { FILES = sizeof scenes / sizeof *scenes, COMPARED = 3 };

static fuzz_image make(size_t which, bool compressed)
{
  char path[80];
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  gg_comparison *comparison = NULL;
  snprintf(path, sizeof path, "/tmp/graingas-fuzz-%ld.h5", (long)getpid());
  const gg_run_options options = {.size = sizeof options, .output = path};
  if (gg_scene_parse(scenes[which], "base", &scene, NULL) != GG_OK) abort();
  if (which == COMPARED)
    gg_compare(scene, &options, &comparison, NULL);
  else
    gg_run(scene, &options, &result, NULL);
  gg_comparison_free(comparison);
  gg_result_free(result);
  gg_scene_free(scene);
  return fuzz_small_result(path, scenes[which], compressed);
}

static void read_frames(const char *path)
{
  gg_stored_trajectory t;
  gg_frame frame;
  double edges[9];
  if (gg_files_stored_trajectory_open(&t, path, NULL) == GG_OK)
    for (size_t k = 0; k < t.n_frames && k < 10; k++)
      if (gg_files_stored_trajectory_frame(&t, k, &frame, edges, NULL) == GG_OK) gg_measure_frame_free(&frame);
  gg_files_stored_trajectory_close(&t);
}

static void read_comparison(const char *path)
{
  gg_comparison *c = NULL;
  char *text = NULL;
  if (gg_comparison_read(path, &c, NULL) == GG_OK && gg_comparison_to_json(c, &text, NULL) == GG_OK) free(text);
  gg_comparison_free(c);
}

static bool is_read(const char *path)
{
  gg_stored_result stored;
  if (gg_files_stored_result_read(&stored, path, NULL) != GG_OK) return false;
  gg_files_stored_result_clear(&stored);
  return true;
}

static void read_stored(const char *path)
{
  is_read(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static fuzz_image images[2][FILES];
  static void (*const readers[])(const char *) = {read_stored, read_comparison, read_frames};
  if (size < 1) return 0;
  const bool compressed = data[0] & 0x80;
  fuzz_image *image = &images[compressed][data[0] % FILES];
  if (!image->data) {
    *image = make(data[0] % FILES, compressed);
    if (!is_read(fuzz_image_change(image, NULL, 0))) abort();
  }
  readers[data[0] / FILES % 3](fuzz_image_change(image, data + 1, size - 1));
  fuzz_image_restore(image, data + 1, size - 1);
  return 0;
}
