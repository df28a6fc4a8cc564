/* What the grains of a trajectory are, and what its numbers mean. */
#include <stdio.h>
#include <stdlib.h>

#include "files/h5/particles.h"
#include "measure/curve.h"

#define GRAINS "/particles/grains"

static void write_number_of_each(gg_h5 *h, const char *path, const double *of_species, const uint8_t *species,
                                 hsize_t n, const char *unit)
{
  double *each = calloc(n, sizeof *each);
  if (!each) {
    gg_h5_failed(h, "out of memory");
    return;
  }
  for (hsize_t i = 0; i < n; i++) each[i] = of_species[species[i]];
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &n, each);
  gg_h5_text_attribute(h, path, "unit", unit);
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
  if (!id || !species) {
    gg_h5_failed(h, "out of memory");
  } else {
    gg_h5_array(h, GRAINS "/id", H5T_NATIVE_INT64, 1, &n, id);
    gg_h5_array(h, GRAINS "/species", H5T_NATIVE_UINT8, 1, &n, species);
    write_number_of_each(h, GRAINS "/mass", model->mass, species, n, "m");
    write_number_of_each(h, GRAINS "/diameter", model->diameter, species, n,
                         model->boltzmann ? "d" : gg_measure_curve_unit(model, "length"));
  }
  free(id);
  free(species);
}

/* Readers look for units at the arrays, and MDAnalysis refuses a file if it finds one there that it does not know,
 * among which are all of ours: of position, velocity and time they stand at the groups. */
static void write_units(gg_h5 *h, const gg_model *model, const gg_frame *frame)
{
  const char *velocity = gg_measure_curve_unit(model, "velocity"), *length = gg_measure_curve_unit(model, "length");
  const char *spin = model->boltzmann ? velocity : gg_measure_curve_unit(model, "spin");
  gg_h5_text_attribute(h, GRAINS, "time_unit", gg_measure_curve_unit(model, "time"));
  gg_h5_text_attribute(h, GRAINS "/velocity", "unit", velocity);
  if (frame->position) gg_h5_text_attribute(h, GRAINS "/position", "unit", length);
  if (frame->position) gg_h5_text_attribute(h, GRAINS "/box/edges", "unit", length);
  if (!frame->spin) return;
  gg_h5_text_attribute(h, GRAINS "/spin", "unit", spin);
  gg_h5_text_attribute(h, GRAINS "/spin/value", "unit", spin);
  gg_h5_text_attribute(h, GRAINS "/spin", "doc", model->boltzmann ? "surface velocity (d/2) omega" : "omega");
}

static void write_frame_of_reference(gg_h5 *h, const gg_model *model, const gg_frame *frame)
{
  const char *text =
      model->shear_rate == 0 ? "laboratory: no flow is imposed"
      : frame->position
          ? "peculiar: relative to the imposed flow; in the laboratory x has shear_rate (y - L_y/2) more, "
            "y the position and L_y = box/edges/value[1][1]"
          : "peculiar: relative to the flow at the one point that the ensemble stands for";
  gg_h5_text_attribute(h, GRAINS "/velocity", "frame", text);
  gg_h5_attribute(h, GRAINS "/velocity", "shear_rate", H5T_NATIVE_DOUBLE, &model->shear_rate, 0);
}

void gg_h5_write_grains(gg_h5 *h, const gg_model *model, const gg_frame *frame, const size_t *order)
{
  write_kinds(h, model, frame, order);
  write_units(h, model, frame);
  write_frame_of_reference(h, model, frame);
}
