/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stored trajectories, one frame at a time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "api/simulation.h"
#include "base/busy.h"
#include "base/memory.h"
#include "files/h5/result_reader.h"
#include "files/h5/result_restore.h"
#include "scene/fields.h"

struct gg_trajectory {
  gg_busy busy;
  gg_stored_trajectory stored;
  gg_scene scene; /* as it was run */
  gg_model model;
  gg_moments last; /* moments of the last frame; last.model is NULL before the first frame */
};

static gg_status read_scene(gg_trajectory *t, const char *path, gg_error *err)
{
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_files_stored_result_read(&stored, path, err));
  return gg_files_stored_scene(&stored, gg_files_stored_first(&stored), &t->scene, &t->model, err);
}

static void destroy(void *trajectory)
{
  gg_trajectory *t = trajectory;
  gg_files_stored_trajectory_close(&t->stored);
  free(t);
}

gg_status gg_trajectory_open(const char *path, gg_trajectory **trajectory, gg_error *err)
{
  GG_NEED(path, trajectory);
  gg_trajectory *t = gg_base_array_new(1, sizeof *t, err);
  if (!t) return GG_FAILED;
  gg_base_busy_init(&t->busy, "trajectory", destroy, t);
  gg_status status = read_scene(t, path, err);
  if (status == GG_OK) status = gg_files_stored_trajectory_open(&t->stored, path, err);
  if (status == GG_OK && !t->stored.n_frames)
    status = gg_base_fail(err, GG_FAILED, "%s: nothing to play: " GG_NO_POSITIONS, path);
  if (status == GG_OK)
    *trajectory = t;
  else
    gg_trajectory_free(t);
  return status;
}

void gg_trajectory_free(gg_trajectory *trajectory)
{
  if (trajectory) gg_base_busy_free(&trajectory->busy);
}

const gg_scene *gg_trajectory_scene(const gg_trajectory *trajectory)
{
  return trajectory ? &trajectory->scene : NULL;
}

size_t gg_trajectory_frames(const gg_trajectory *trajectory)
{
  return trajectory ? trajectory->stored.n_frames : 0;
}

/* Set the state of a frame. edges[3] is the shift of the images above, from -box/2 to box/2. */
static gg_status set_state(const gg_trajectory *t, const gg_frame *f, const double edges[9], gg_simulation_state *state,
                           gg_error *err)
{
  *state = (gg_simulation_state){.time = f->time, .collisions = f->step, .strain = gg_scene_strain(&t->scene, f->time)};
  gg_api_moments_state(&t->last, 1, state);
  for (int a = 0; a < 3; a++) {
    state->box[a] = edges[4 * a];
    if (!(state->box[a] > 0 && state->box[a] < INFINITY && fabs(edges[3]) <= edges[0]))
      return gg_base_fail(err, GG_BAD_FILE, "%s: a frame of its trajectory has an invalid box", t->stored.path);
  }
  state->image_offset = edges[3] < 0 ? edges[3] + edges[0] : edges[3];
  return GG_OK;
}

gg_status gg_trajectory_frame(gg_trajectory *trajectory, size_t k, gg_simulation_state *state, const gg_grains *into,
                              gg_error *err)
{
  GG_NEED_ALONE(trajectory);
  gg_trajectory *t = trajectory;
  gg_frame f;
  double edges[9] = {0};
  if (k >= t->stored.n_frames)
    return GG_REFUSE(err, "there is no frame %zu: this trajectory has %zu, counted from 0", k, t->stored.n_frames);
  GG_TRY(gg_files_stored_trajectory_frame(&t->stored, k, &f, edges, err));
  if (t->model.n_species > 1) f.species = t->stored.species;
  gg_status status = gg_run_frame_check(&f, &t->model, err);
  if (status == GG_OK) {
    t->last = (gg_moments){.model = &t->model};
    gg_measure_frame_visit(&f, &t->model, gg_measure_moments_add, &t->last);
  }
  if (status == GG_OK && state) status = set_state(t, &f, edges, state, err);
  if (status == GG_OK && into) gg_measure_frame_copy(&f, into->position, into->velocity, into->spin, into->species);
  f.species = NULL; /* belongs to the trajectory */
  gg_measure_frame_free(&f);
  return status;
}

gg_status gg_trajectory_get_species(const gg_trajectory *trajectory, int species, gg_species_state *state,
                                    gg_error *err)
{
  GG_NEED_READING(trajectory, state);
  if (!trajectory->last.model) return GG_REFUSE(err, "read a frame of the trajectory first");
  return gg_api_moments_species(&trajectory->last, species, 1, state, err);
}
