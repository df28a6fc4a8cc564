#include <math.h>

#include "io/curves.h"

static json_t *real(double x)
{
  return isfinite(x) ? json_real(x) : json_null();
}

static json_t *array(const double *x, size_t n)
{
  json_t *list = json_array();
  for (size_t i = 0; i < n; i++) json_array_append_new(list, real(x[i]));
  return list;
}

static json_t *numbers_json(const gg_curve *c)
{
  json_t *numbers = json_object();
  for (int i = 0; i < c->n_numbers; i++) {
    const gg_curve_number *p = &c->number[i];
    json_object_set_new(
        numbers, p->name,
        json_pack("{s:o, s:o, s:s}", "mean", real(p->value), "stderr", real(p->error), "unit", p->unit));
  }
  return numbers;
}

static json_t *curve_json(const gg_curve *c)
{
  json_t *o = json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:I}", "group", c->group, "panel", c->panel,
                        "label", c->label, "x_name", c->x_name, "x_unit", c->x_unit, "y_name", c->y_name, "unit",
                        c->unit, "log_x", c->log_x, "log_y", c->log_y, "samples", (json_int_t)c->samples);
  if (c->folded) json_object_set_new(o, "folded", json_true());
  json_object_set_new(o, "x", array(c->x, c->n));
  json_object_set_new(o, "value", array(c->value, c->n));
  json_object_set_new(o, "stderr", array(c->error, c->n));
  json_object_set_new(o, "numbers", numbers_json(c));
  if (c->reference)
    json_object_set_new(o, "reference",
                        json_pack("{s:s, s:o}", "label", c->reference_label, "value", array(c->reference, c->n)));
  return o;
}

json_t *gg_curves_json(const gg_curves *curves)
{
  json_t *all = json_object();
  for (int k = 0; k < curves->n; k++) json_object_set_new(all, curves->curve[k].name, curve_json(&curves->curve[k]));
  return all;
}
