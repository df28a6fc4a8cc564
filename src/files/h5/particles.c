/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/h5/particles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/model.h"
#include "measure/curve.h"
#include "scene/fields.h"

#define GRAINS "/particles/grains"

static void write_number_of_each(gg_h5 *h, const char *path, const double *of_species, const uint8_t *species, size_t n,
                                 const char *unit)
{
  double *each = calloc(n, sizeof *each);
  for (size_t i = 0; each && i < n; i++) each[i] = of_species[species[i]];
  gg_h5_numbers(h, path, each, n, unit);
  free(each);
}

/* In the order of their numbers. */
static void write_kinds(gg_h5 *h, const gg_model *model, const gg_frame *frame, const size_t *order)
{
  hsize_t n = frame->n;
  int64_t *id = calloc(frame->n, sizeof *id);
  uint8_t *species = calloc(frame->n, 1);
  for (size_t i = 0; id && species && i < frame->n; i++) {
    id[i] = (int64_t)i;
    species[i] = frame->species ? frame->species[order[i]] : 0;
  }
  gg_h5_array(h, GRAINS "/id", H5T_NATIVE_INT64, 1, &n, id);
  gg_h5_array(h, GRAINS "/species", H5T_NATIVE_UINT8, 1, &n, species);
  if (species) {
    write_number_of_each(h, GRAINS "/mass", model->mass, species, n, "m");
    write_number_of_each(h, GRAINS "/diameter", model->diameter, species, n,
                         model->boltzmann ? "d" : gg_measure_curve_unit(model, "length"));
  }
  free(id);
  free(species);
}

/* Readers look for units at the arrays, and MDAnalysis refuses a file if it finds one there that it does not know,
 * among which are all of ours: of position, velocity and time they stand at the groups. */
static void write_units(gg_h5 *h, bool boxed, const gg_model *model, const gg_frame *frame)
{
  const char *velocity = gg_measure_curve_unit(model, "velocity"), *length = gg_measure_curve_unit(model, "length");
  const char *spin = model->boltzmann ? velocity : gg_measure_curve_unit(model, "spin");
  gg_h5_text_attribute(h, GRAINS, "time_unit", gg_measure_curve_unit(model, "time"));
  gg_h5_text_attribute(h, GRAINS "/velocity", "unit", velocity);
  if (frame->position) gg_h5_text_attribute(h, GRAINS "/position", "unit", length);
  if (boxed) gg_h5_text_attribute(h, GRAINS "/box/edges", "unit", length);
  if (!frame->spin) return;
  gg_h5_text_attribute(h, GRAINS "/spin", "unit", spin);
  gg_h5_text_attribute(h, GRAINS "/spin/value", "unit", spin);
  gg_h5_text_attribute(h, GRAINS "/spin", "doc", model->boltzmann ? "surface velocity (d/2) omega" : "omega");
}

static void write_frame_of_reference(gg_h5 *h, bool boxed, const gg_model *model)
{
  const char *text = !gg_model_is_sheared(model) ? "laboratory: no flow is imposed"
                     : boxed ? "peculiar: relative to the imposed flow; in the laboratory x has shear_rate (y - L_y/2) "
                               "more, y the position and L_y = box/edges/value[1][1]"
                             : "peculiar: relative to the flow at the one point that the ensemble stands for";
  gg_h5_text_attribute(h, GRAINS "/velocity", "frame", text);
  gg_h5_attribute(h, GRAINS "/velocity", "shear_rate", H5T_NATIVE_DOUBLE, &model->shear_rate, 0);
}

/* The numbers in memory are doubles all the same. */
static void create_vectors(gg_h5 *h, const gg_h5_particles *p, gg_h5_rows *rows, const char *name)
{
  const hsize_t row[2] = {p->n, 3};
  const hid_t type = rows == &p->image ? H5T_NATIVE_INT32 : p->single ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
  gg_h5_rows_create(h, rows, gg_h5_path(h, GRAINS "/%s/value", name), type, 2, row);
  rows->type = H5T_NATIVE_DOUBLE;
}

static void start_vectors(gg_h5 *h, gg_h5_particles *p, gg_h5_rows *rows, const char *name, const double *data)
{
  rows->dataset = -1;
  if (!data) return;
  create_vectors(h, p, rows, name);
  gg_h5_link(h, GRAINS "/velocity/step", gg_h5_path(h, GRAINS "/%s/step", name));
  gg_h5_link(h, GRAINS "/velocity/time", gg_h5_path(h, GRAINS "/%s/time", name));
}

static void start_box(gg_h5 *h, gg_h5_particles *p, const gg_model *model)
{
  const int dimension = 3;
  const char *boundary[3];
  for (int a = 0; a < dimension; a++)
    boundary[a] = !p->boxed || gg_common_surface_is_closed(model, a) ? "none" : "periodic";
  gg_h5_group(h, GRAINS "/box");
  gg_h5_attribute(h, GRAINS "/box", "dimension", H5T_NATIVE_INT, &dimension, 0);
  gg_h5_texts_attribute(h, GRAINS "/box", "boundary", boundary, 3);
  if (!p->boxed) return;
  const hsize_t row[2] = {3, 3};
  gg_h5_rows_create(h, &p->edges, GRAINS "/box/edges/value", H5T_NATIVE_DOUBLE, 2, row);
  gg_h5_link(h, GRAINS "/velocity/step", GRAINS "/box/edges/step");
  gg_h5_link(h, GRAINS "/velocity/time", GRAINS "/box/edges/time");
}

static void start(gg_h5 *h, gg_h5_particles *p, const gg_model *model, const gg_frame *frame, const size_t *order)
{
  p->started = true, p->n = frame->n;
  p->edges.dataset = -1;
  gg_h5_rows_create(h, &p->step, GRAINS "/velocity/step", H5T_NATIVE_UINT64, 0, NULL);
  gg_h5_rows_create(h, &p->time, GRAINS "/velocity/time", H5T_NATIVE_DOUBLE, 0, NULL);
  create_vectors(h, p, &p->velocity, "velocity");
  start_vectors(h, p, &p->position, "position", frame->position);
  start_vectors(h, p, &p->spin, "spin", frame->spin);
  start_vectors(h, p, &p->image, "image", frame->image);
  start_box(h, p, model);
  write_kinds(h, model, frame, order); /* what does not change in time */
  write_units(h, p->boxed, model, frame);
  write_frame_of_reference(h, p->boxed, model);
}

static void append_vectors(gg_h5 *h, gg_h5_rows *rows, const double *data, const size_t *order, double *sorted,
                           size_t n)
{
  if (!data) return;
  for (size_t i = 0; i < n; i++) memcpy(sorted + 3 * i, data + 3 * order[i], 3 * sizeof *data);
  gg_h5_rows_append(h, rows, sorted);
}

/* A view of it: the arrays stay the caller's. */
static gg_frame stored_part(const gg_h5_particles *p, const gg_frame *frame)
{
  gg_frame part = *frame;
  if (p->left_out & GG_FIELDS_POSITION) part.position = NULL;
  if (p->left_out & GG_FIELDS_SPIN) part.spin = NULL;
  if (p->left_out & GG_FIELDS_IMAGE) part.image = NULL;
  return part;
}

void gg_h5_particles_append(gg_h5 *h, gg_h5_particles *p, const gg_model *model, const gg_frame *whole)
{
  if (h->failed) return;
  const gg_frame part = stored_part(p, whole), *frame = &part;
  gg_error err = {.message = "out of memory for a frame"};
  size_t *order = gg_measure_frame_order(frame, &err);
  double *sorted = malloc(3 * frame->n * sizeof *sorted);
  if (!order || !sorted) {
    gg_h5_failed(h, err.message);
  } else {
    p->boxed = whole->position != NULL;
    if (!p->started) start(h, p, model, frame, order);
    /* Under shear the image above moves (Lees & Edwards 1972): the second edge leans towards the nearest one, so that
     * periodic images of the stored box are those of the simulation. */
    const double edges[9] = {model->box[0], 0, 0, frame->tilt, model->box[1], 0, 0, 0, model->box[2]};
    gg_h5_rows_append(h, &p->step, &frame->step);
    gg_h5_rows_append(h, &p->time, &frame->time);
    if (p->boxed) gg_h5_rows_append(h, &p->edges, edges);
    append_vectors(h, &p->position, frame->position, order, sorted, p->n);
    append_vectors(h, &p->velocity, frame->velocity, order, sorted, p->n);
    append_vectors(h, &p->spin, frame->spin, order, sorted, p->n);
    append_vectors(h, &p->image, frame->image, order, sorted, p->n);
    p->last_step = frame->step;
  }
  free(order);
  free(sorted);
}

enum { ARRAYS = 7 };
static gg_h5_rows *array_of(gg_h5_particles *p, int i)
{
  gg_h5_rows *const all[ARRAYS] = {&p->step, &p->time, &p->edges, &p->position, &p->velocity, &p->spin, &p->image};
  return all[i];
}

void gg_h5_particles_drop(gg_h5 *h, gg_h5_particles *p, uint64_t step)
{
  if (!p->started || h->failed) return;
  size_t n = 0;
  for (uint64_t at = 0; n < p->step.n && !h->failed; n++) {
    gg_h5_rows_read(h, &p->step, n, &at);
    if (at > step) break;
  }
  for (int i = 0; n && i < ARRAYS; i++)
    if (array_of(p, i)->dataset >= 0) gg_h5_rows_drop(h, array_of(p, i), n);
  if (!p->step.n) p->last_step = 0;
}

void gg_h5_particles_close(gg_h5 *h, gg_h5_particles *p)
{
  if (!p->started) return;
  for (int i = 0; i < ARRAYS; i++) gg_h5_rows_close(h, array_of(p, i));
}
