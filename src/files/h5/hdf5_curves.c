#include <math.h>
#include <stdio.h>

#include "files/curve_table.h"
#include "files/h5/hdf5_writer.h"

static void write_numbers(gg_h5 *h, const char *base, const gg_curve *c)
{
  char path[256];
  for (int i = 0; i < c->n_numbers; i++) {
    const gg_curve_number *p = &c->number[i];
    if (!isfinite(p->value)) continue; /* what cannot be had is not there */
    snprintf(path, sizeof path, "%s/numbers/%s/mean", base, p->name);
    gg_h5_number(h, path, p->value);
    gg_h5_text_attribute(h, path, "unit", p->unit);
    if (!isfinite(p->error)) continue;
    snprintf(path, sizeof path, "%s/numbers/%s/stderr", base, p->name);
    gg_h5_number(h, path, p->error);
    gg_h5_text_attribute(h, path, "unit", p->unit);
  }
}

static void write_reference(gg_h5 *h, const char *base, const gg_curve *c)
{
  char path[200];
  hsize_t n = c->n;
  snprintf(path, sizeof path, "%s/reference", base);
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &n, c->reference);
  gg_h5_text_attribute(h, path, "unit", c->unit);
  gg_h5_text_attribute(h, path, "label", c->reference_label);
}

static void write_curve(gg_h5 *h, const char *group, const gg_curve *c)
{
  char base[160], path[200];
  hsize_t n = c->n;
  const struct {
    const char *name, *unit;
    const double *data;
  } arrays[] = {{"x", c->x_unit, c->x}, {"value", c->unit, c->value}, {"stderr", c->unit, c->error}};
  snprintf(base, sizeof base, "%s/curves/%s", group, c->name);
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    snprintf(path, sizeof path, "%s/%s", base, arrays[i].name);
    gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 1, &n, arrays[i].data);
    gg_h5_text_attribute(h, path, "unit", arrays[i].unit);
  }
  if (c->reference) write_reference(h, base, c);
  gg_h5_text_attribute(h, base, "group", c->group);
  gg_h5_text_attribute(h, base, "x", c->x_name);
  gg_h5_text_attribute(h, base, "value", c->y_name);
  if (c->folded) gg_h5_text_attribute(h, base, "folded", "yes");
  gg_h5_attribute(h, base, "samples", H5T_NATIVE_UINT64, &c->samples, 0);
  write_numbers(h, base, c);
}

void gg_h5_write_curves(gg_h5 *h, const char *group, const gg_curves *curves)
{
  for (int k = 0; k < curves->n; k++) write_curve(h, group, &curves->curve[k]);
}
