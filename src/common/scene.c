#include "common/scene.h"

#include <math.h>

gg_scene gg_common_scene_defaults(void)
{
  gg_scene s = {
      .flow = GG_USF,
      .engine = GG_MD,
      .contact_value = GG_CARNAHAN_STARLING,
      .phi = GG_AUTO,
      .particles = 1000,
      .shear_rate = 1,
      .temperature = GG_AUTO,
      .aspect = {1, 1, 1},
      .n_species = 1,
      .collision = {.speed = GG_AUTO},
      .walls = {.e = 0.9, .beta = 1, .mu = INFINITY, .speed = 1},
      .run = {.relative_error = GG_AUTO,
              .collisions = GG_AUTO,
              .time_limit = GG_AUTO,
              .warmup = GG_AUTO,
              .replicas = 1,
              .seed = 1},
      .md = {.contact_time = GG_AUTO},
      .dsmc = {.time_step = GG_AUTO, .chosen_for = GG_AUTO},
      .measure = GG_MEASURE_RHEOLOGY,
  };
  for (int i = 0; i < GG_MAX_SPECIES; i++) s.species[i] = (gg_species){i == 0, 1, 1, 0.4};
  for (int p = 0; p < GG_PAIRS; p++) {
    s.collision.e[p] = 0.9;
    s.collision.beta[p] = -1;
    s.collision.mu[p] = INFINITY;
  }
  return s;
}
