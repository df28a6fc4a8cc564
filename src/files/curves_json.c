#include <math.h>

#include "base/checked_json.h"
#include "base/memory.h"
#include "files/curve_table.h"

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

json_t *gg_files_curves_json(const gg_curves *curves)
{
  json_t *all = json_object();
  for (int k = 0; k < curves->n; k++) json_object_set_new(all, curves->curve[k].name, curve_json(&curves->curve[k]));
  return all;
}

static double number(const json_t *object, const char *key)
{
  const json_t *value = json_object_get(object, key);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

static const char *text(const json_t *object, const char *key)
{
  const char *value = json_string_value(json_object_get(object, key));
  return value ? value : "";
}

static void fill(double *to, size_t n, const json_t *list)
{
  for (size_t i = 0; i < n; i++) {
    const json_t *value = json_array_get(list, i);
    to[i] = json_is_number(value) ? json_number_value(value) : NAN;
  }
}

static void restore_numbers(gg_curve *c, const json_t *numbers)
{
  const char *name;
  json_t *one;
  json_object_foreach((json_t *)(uintptr_t)numbers, name, one)
  {
    int n = c->n_numbers;
    gg_measure_curve_put_number(c, name, number(one, "mean"), text(one, "unit"));
    if (c->n_numbers > n) c->number[n].error = number(one, "stderr");
    if (c->n_numbers > n) c->number[n].setting = c->number[n].error == 0;
  }
}

static gg_status restore(gg_curves *list, const char *name, const json_t *stored, gg_error *err)
{
  const json_t *law = json_object_get(stored, "reference");
  list->group = text(stored, "group");
  list->samples = (uint64_t)json_integer_value(json_object_get(stored, "samples"));
  gg_curve *c = gg_measure_curve_add(list, json_array_size(json_object_get(stored, "x")), name, text(stored, "panel"),
                                     text(stored, "label"));
  list->group = NULL; /* every curve has its own copy */
  if (list->failed) return gg_base_out_of_memory_for(err, "the curve %s", name);
  gg_measure_curve_axes(c, text(stored, "x_name"), text(stored, "x_unit"), text(stored, "y_name"),
                        text(stored, "unit"));
  c->folded = json_is_true(json_object_get(stored, "folded"));
  c->log_x = json_is_true(json_object_get(stored, "log_x"));
  c->log_y = json_is_true(json_object_get(stored, "log_y"));
  fill(c->x, c->n, json_object_get(stored, "x"));
  fill(c->value, c->n, json_object_get(stored, "value"));
  fill(c->error, c->n, json_object_get(stored, "stderr"));
  restore_numbers(c, json_object_get(stored, "numbers"));
  if (!law) return GG_OK;
  gg_measure_curve_beside(c, text(law, "label"), gg_measure_curve_level, &(double){0});
  if (c->law_lost) return gg_base_out_of_memory_for(err, "the curve %s", name);
  if (c->reference) fill(c->reference, c->n, json_object_get(law, "value"));
  return GG_OK;
}

gg_status gg_files_curves_from_json(gg_curves *list, const json_t *curves, gg_error *err)
{
  const char *name;
  json_t *stored;
  json_object_foreach((json_t *)(uintptr_t)curves, name, stored) GG_TRY(restore(list, name, stored, err));
  return GG_OK;
}
