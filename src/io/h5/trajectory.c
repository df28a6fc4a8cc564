#include "io/h5/trajectory.h"

#include <stdlib.h>
#include <string.h>

#define GRAINS "/particles/grains"

/* Three texts of one length: "periodic" or "none". */
static void read_boundary(gg_stored_trajectory *t)
{
  gg_h5 *h = &t->h;
  if (h->failed) return;
  hid_t attribute = H5Aopen_by_name(h->file, GRAINS "/box", "boundary", H5P_DEFAULT, H5P_DEFAULT);
  hid_t type = attribute < 0 ? -1 : H5Aget_type(attribute), space = attribute < 0 ? -1 : H5Aget_space(attribute);
  bool texts = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
               H5Sget_simple_extent_npoints(space) == 3;
  size_t length = texts ? H5Tget_size(type) : 0;
  char *text = texts ? calloc(3, length) : NULL;
  if (text && H5Aread(attribute, type, text) >= 0)
    for (size_t a = 0; a < 3; a++) t->periodic[a] = text[a * length] == 'p';
  else
    gg_h5_failed(h, "the boundaries of its box are not known");
  free(text);
  if (space >= 0) H5Sclose(space);
  if (type >= 0) H5Tclose(type);
  if (attribute >= 0) H5Aclose(attribute);
}

static void *read_of_each(gg_stored_trajectory *t, const char *path, hid_t type, size_t item)
{
  size_t n = 0;
  void *data = gg_h5_read_array(&t->h, path, type, item, &n);
  if (data && n != t->n) gg_h5_failed(&t->h, "what its grains are is not known of all");
  return data;
}

static void read_kinds(gg_stored_trajectory *t)
{
  gg_h5 *h = &t->h;
  free(gg_h5_read_array(h, GRAINS "/id", H5T_NATIVE_INT64, sizeof(int64_t), &t->n));
  t->species = read_of_each(t, GRAINS "/species", H5T_NATIVE_UINT8, 1);
  t->diameter = read_of_each(t, GRAINS "/diameter", H5T_NATIVE_DOUBLE, sizeof(double));
  t->mass = read_of_each(t, GRAINS "/mass", H5T_NATIVE_DOUBLE, sizeof(double));
  t->length_unit = gg_h5_read_text_attribute(h, GRAINS "/position", "unit");
  t->velocity_unit = gg_h5_read_text_attribute(h, GRAINS "/velocity", "unit");
  t->time_unit = gg_h5_read_text_attribute(h, GRAINS, "time_unit");
  if (gg_h5_exists(h, GRAINS "/spin")) t->spin_unit = gg_h5_read_text_attribute(h, GRAINS "/spin", "unit");
  gg_h5_read_attribute(h, GRAINS "/velocity", "shear_rate", H5T_NATIVE_DOUBLE, &t->shear_rate);
}

gg_status gg_stored_trajectory_open(gg_stored_trajectory *t, const char *path, gg_error *err)
{
  *t = (gg_stored_trajectory){.path = strdup(path)};
  if (!t->path) return gg_fail(err, GG_FAILED, "out of memory");
  gg_h5_open(&t->h, path);
  if (gg_h5_exists(&t->h, GRAINS "/position/value")) {
    free(gg_h5_read_array(&t->h, GRAINS "/velocity/step", H5T_NATIVE_INT64, sizeof(int64_t), &t->n_frames));
    read_kinds(t);
    read_boundary(t);
  }
  return gg_h5_status(&t->h, path, "read", err);
}

static double *read_vectors(gg_stored_trajectory *t, const char *path, size_t k)
{
  return gg_h5_read_row(&t->h, path, k, H5T_NATIVE_DOUBLE, sizeof(double), 3 * t->n);
}

/* One row of numbers into its place. */
static void read_into(gg_stored_trajectory *t, const char *path, size_t k, hid_t type, size_t item, size_t items,
                      void *place)
{
  void *row = gg_h5_read_row(&t->h, path, k, type, item, items);
  if (row) memcpy(place, row, items * item);
  free(row);
}

gg_status gg_stored_trajectory_frame(gg_stored_trajectory *t, size_t k, gg_frame *frame, double edges[9], gg_error *err)
{
  *frame = (gg_frame){.n = t->n};
  read_into(t, GRAINS "/velocity/step", k, H5T_NATIVE_UINT64, sizeof frame->step, 1, &frame->step);
  read_into(t, GRAINS "/velocity/time", k, H5T_NATIVE_DOUBLE, sizeof frame->time, 1, &frame->time);
  read_into(t, GRAINS "/box/edges/value", k, H5T_NATIVE_DOUBLE, sizeof *edges, 9, edges);
  frame->position = read_vectors(t, GRAINS "/position/value", k);
  frame->velocity = read_vectors(t, GRAINS "/velocity/value", k);
  if (t->spin_unit) frame->spin = read_vectors(t, GRAINS "/spin/value", k);
  gg_status status = gg_h5_status(&t->h, t->path, "read", err);
  if (status != GG_OK) gg_frame_free(frame);
  return status;
}

void gg_stored_trajectory_close(gg_stored_trajectory *t)
{
  void *const all[] = {t->path,        t->species,       t->diameter,  t->mass,
                       t->length_unit, t->velocity_unit, t->spin_unit, t->time_unit};
  if (t->path) gg_h5_close(&t->h);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
  *t = (gg_stored_trajectory){0};
}
