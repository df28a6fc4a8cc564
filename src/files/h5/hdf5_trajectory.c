#include "files/h5/hdf5_trajectory.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

#define GRAINS "/particles/grains"

/* Three texts: "periodic" or "none". */
static void read_boundary(gg_stored_trajectory *t)
{
  char letter[3] = "";
  gg_h5_read_initials(&t->h, GRAINS "/box", "boundary", letter, 3);
  for (size_t a = 0; a < 3; a++) t->periodic[a] = letter[a] == 'p';
}

static void *read_of_each(gg_stored_trajectory *t, const char *path, gg_item_type type)
{
  size_t n = 0;
  void *data = gg_h5_read_array(&t->h, path, type, &n);
  if (data && n != t->n) gg_h5_in_failed(&t->h, "what its grains are is not known of all");
  return data;
}

static void read_kinds(gg_stored_trajectory *t)
{
  gg_h5_in *h = &t->h;
  t->n = gg_h5_count_of(h, GRAINS "/id");
  t->species = read_of_each(t, GRAINS "/species", GG_ITEM_U8);
  t->diameter = read_of_each(t, GRAINS "/diameter", GG_ITEM_F64);
  t->mass = read_of_each(t, GRAINS "/mass", GG_ITEM_F64);
  t->length_unit = gg_h5_read_text_attribute(h, GRAINS "/position", "unit");
  t->velocity_unit = gg_h5_read_text_attribute(h, GRAINS "/velocity", "unit");
  t->time_unit = gg_h5_read_text_attribute(h, GRAINS, "time_unit");
  if (gg_h5_exists(h, GRAINS "/spin")) t->spin_unit = gg_h5_read_text_attribute(h, GRAINS "/spin", "unit");
  gg_h5_read_attribute(h, GRAINS "/velocity", "shear_rate", GG_ITEM_F64, &t->shear_rate);
}

gg_status gg_files_stored_trajectory_open(gg_stored_trajectory *t, const char *path, gg_error *err)
{
  *t = (gg_stored_trajectory){.path = strdup(path)};
  if (!t->path) return gg_base_out_of_memory(err);
  gg_h5_open(&t->h, path);
  if (gg_h5_exists(&t->h, GRAINS "/position/value")) {
    t->n_frames = gg_h5_count_of(&t->h, GRAINS "/velocity/step");
    read_kinds(t);
    read_boundary(t);
  }
  return gg_h5_in_status(&t->h, path, err);
}

static double *read_vectors(gg_stored_trajectory *t, const char *path, size_t k)
{
  return gg_h5_read_row(&t->h, path, k, GG_ITEM_F64, 3 * t->n);
}

/* One row of numbers into its place. */
static void read_into(gg_stored_trajectory *t, const char *path, size_t k, gg_item_type type, size_t items, void *place)
{
  void *row = gg_h5_read_row(&t->h, path, k, type, items);
  if (row) memcpy(place, row, items * gg_base_archive_item_size(type));
  free(row);
}

gg_status gg_files_stored_trajectory_frame(gg_stored_trajectory *t, size_t k, gg_frame *frame, double edges[9],
                                           gg_error *err)
{
  *frame = (gg_frame){.n = t->n};
  read_into(t, GRAINS "/velocity/step", k, GG_ITEM_U64, 1, &frame->step);
  read_into(t, GRAINS "/velocity/time", k, GG_ITEM_F64, 1, &frame->time);
  read_into(t, GRAINS "/box/edges/value", k, GG_ITEM_F64, 9, edges);
  frame->position = read_vectors(t, GRAINS "/position/value", k);
  frame->velocity = read_vectors(t, GRAINS "/velocity/value", k);
  if (t->spin_unit) frame->spin = read_vectors(t, GRAINS "/spin/value", k);
  gg_status status = gg_h5_in_status(&t->h, t->path, err);
  if (status != GG_OK) gg_run_frame_free(frame);
  return status;
}

void gg_files_stored_trajectory_close(gg_stored_trajectory *t)
{
  void *const all[] = {t->path,        t->species,       t->diameter,  t->mass,
                       t->length_unit, t->velocity_unit, t->spin_unit, t->time_unit};
  if (t->path) gg_h5_in_close(&t->h);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
  *t = (gg_stored_trajectory){0};
}
