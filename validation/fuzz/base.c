/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_reader.h"
#include "graingas.h"

enum { LOOKS = 12 }; /* at whether to stop, until it does: a few samples */

/* Cells and lists, shear and walls, spins and species, every observable with a memory; both engines. Velocity
 * distributions and collisions of sheared grains stand beside a theory that takes longer than all of the
 * run. */
static const char *const scenes[FUZZ_BASES] = {
    "flow: usf\nphi: 0.1\nparticles: 14\ncollision: {e: 0.9, beta: 0, mu: 0.5}\n"
    "measure: [rheology, pair_correlation]\nrun: {collisions: 40, warmup: 2}\n",
    "flow: couette\nphi: 0.1\nparticles: 12\nmeasure: [rheology, profiles]\nrun: {collisions: 40, warmup: 2}\n",
    "flow: equilibrium\nphi: 0.3\nparticles: 40\nspecies: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]\n"
    "measure: [rheology, diffusion, collisions]\nrun: {collisions: 40, warmup: 2}\n",
    "flow: usf\nphi: 0.1\nengine: dsmc\ndsmc: {particles: 16}\nspecies: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]\n"
    "run: {collisions: 40, warmup: 2}\n",
    "flow: hss\nphi: 0.45\nparticles: 130\ncollision: {e: 0.9}\nthermostat: white_noise\nrun: {collisions: 40, "
    "warmup: 2}\n",
    "flow: equilibrium\nphi: 0.1\nengine: dsmc\ndsmc: {particles: 16}\nmeasure: [rheology, velocity_distributions]\n"
    "run: {collisions: 40, warmup: 2}\n"};

static void fail(const char *scene, const gg_error *err)
{
  fprintf(stderr, "base: %s: %s\n", scene, err->message);
  abort();
}

static gg_status keep(void *context, gg_archive *archive, gg_error *err)
{
  gg_base_archive_clear(context);
  return gg_base_archive_append(context, archive, err);
}

static int looks;

static bool enough(void *context)
{
  (void)context;
  return ++looks > LOOKS;
}

static void make(fuzz_base *b, const char *text)
{
  gg_error err = {.message = ""};
  gg_result *result = NULL;
  const gg_run_callbacks hooks = {.context = &b->archive, .checkpoint = keep, .interrupted = enough};
  looks = 0;
  b->scene = gg_scene_defaults();
  if (gg_scene_read(&b->scene, text, strlen(text), "base", &err) != GG_OK || gg_scene_finish(&b->scene, &err) != GG_OK)
    fail(text, &err);
  gg_run_scene(&b->scene, NULL, 1, &hooks, &result, &err);
  gg_result_free(result);
  if (!b->archive.n_items) fail(text, &err);
}

const fuzz_base *fuzz_base_of(size_t which)
{
  static fuzz_base bases[FUZZ_BASES];
  fuzz_base *b = &bases[which % FUZZ_BASES];
  if (!b->archive.n_items) make(b, scenes[which % FUZZ_BASES]);
  return b;
}
