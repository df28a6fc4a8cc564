/* What the file of a point says: means, numbers read off curves, theories. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure/stretched_tail.h"
#include "reproduce/points.h"
#include "scene/scene_reader.h"
#include "theory/theory.h"

static double real(const json_t *object, const char *key)
{
  const json_t *value = json_object_get(object, key);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

static gg_told value_of(const json_t *entry)
{
  return (gg_told){real(entry, "mean"), real(entry, "stderr"), json_string_value(json_object_get(entry, "unit"))};
}

gg_told gg_reproduce_figure_quantity(const gg_figure_point *point, int engine, const char *quantity)
{
  const json_t *results = json_object_get(point->stored.engine[engine].document, "results");
  return value_of(json_object_get(results, quantity));
}

const json_t *gg_reproduce_figure_curve(const gg_figure_point *point, int engine, const char *curve)
{
  return json_object_get(json_object_get(point->stored.engine[engine].document, "curves"), curve);
}

gg_told gg_reproduce_figure_curve_number(const gg_figure_point *point, int engine, const char *curve,
                                         const char *number, const double tail[2])
{
  const json_t *of = gg_reproduce_figure_curve(point, engine, curve);
  char over_range[40];
  if (tail[0] < tail[1])
    gg_measure_stretched_tail_name(over_range, sizeof over_range, number, tail), number = over_range;
  return value_of(json_object_get(json_object_get(of, "numbers"), number));
}

static gg_told evaluated(const gg_scene *scene, const char *theory, const char *quantity)
{
  gg_model model;
  gg_theory_answer answer;
  gg_quantity q = gg_common_quantity_find(quantity);
  gg_scene finished = *scene;
  if (gg_scene_finish(&finished, NULL) != GG_OK || gg_common_model_make(&finished, GG_MD, &model, NULL) != GG_OK ||
      gg_theory_evaluate(gg_theory_find(theory), &model, &answer, NULL) != GG_OK)
    return GG_NO_VALUE;
  return (gg_told){answer.value[q], isnan(answer.error[q]) ? 0 : answer.error[q], NULL};
}

gg_told gg_reproduce_figure_theory(const gg_figure_point *point, const char *theory, const char *quantity,
                                   const char *key, double at)
{
  gg_scene scene = point->scene;
  char text[32];
  if (!key) {
    const json_t *all = json_object_get(json_object_get(point->stored.document, "theory"), theory);
    const json_t *said = json_object_get(all, quantity);
    if (said) return (gg_told){real(said, "mean"), isnan(real(said, "error")) ? 0 : real(said, "error"), NULL};
    return evaluated(&scene, theory, quantity);
  }
  snprintf(text, sizeof text, "%.15g", at);
  if (gg_scene_override(&scene, key, text, NULL) != GG_OK) return GG_NO_VALUE;
  return evaluated(&scene, theory, quantity);
}

static gg_told raw(const gg_asked *a, const gg_figure_point *point)
{
  const gg_source *s = a->source;
  if (a->engine < 0) return gg_reproduce_figure_theory(point, a->theory, a->name, a->key, a->at);
  if (s->kind == GG_OF_NUMBER) return gg_reproduce_figure_curve_number(point, a->engine, a->name, s->number, s->tail);
  return gg_reproduce_figure_quantity(point, a->engine, a->name);
}

static bool same_value(const gg_scene *a, const gg_scene *b, const char *key)
{
  json_t *of_a = gg_scene_key_json(a, key), *of_b = gg_scene_key_json(b, key);
  bool same = json_equal(of_a, of_b);
  json_decref(of_a);
  json_decref(of_b);
  return same;
}

static bool is_free(const gg_conditions *c, const char *key)
{
  for (int i = 0; i < c->n; i++)
    if (strcmp(c->of[i].key, key) == 0) return true;
  return false;
}

/* The point that differs from this one in these keys only. */
static const gg_figure_point *relative(const gg_figure_points *all, const gg_figure_point *to, const gg_conditions *c)
{
  for (size_t i = 0; i < all->n; i++) {
    const gg_figure_point *p = &all->point[i];
    bool same = gg_reproduce_scene_meets(&p->scene, c);
    for (size_t k = 0; same && k < p->n_varied; k++)
      same = is_free(c, p->varied[k]) || same_value(&p->scene, &to->scene, p->varied[k]);
    for (size_t k = 0; same && k < to->n_varied; k++)
      same = is_free(c, to->varied[k]) || same_value(&p->scene, &to->scene, to->varied[k]);
    if (same) return p;
  }
  return NULL;
}

static gg_told reference_of(const gg_asked *a, const gg_figure_point *point)
{
  const gg_source *s = a->source;
  if (s->relative_theory) return gg_reproduce_figure_theory(point, s->relative_theory, a->name, a->key, a->at);
  const gg_figure_point *other = relative(a->points, point, &s->relative_to);
  gg_asked same = *a;
  if (other && a->key && is_free(&s->relative_to, a->key)) same.key = NULL;
  return other ? raw(&same, other) : GG_NO_VALUE;
}

gg_told gg_reproduce_figure_value(const gg_asked *a, const gg_figure_point *point, double x)
{
  static const gg_expression ratio = {3, {{'p', 1}, {'p', 2}, {'/', 0}}};
  const gg_source *s = a->source;
  bool is_relative = s->relative_theory || s->relative_to.n;
  gg_told value = raw(a, point), reference = {0, 0, NULL};
  const gg_expression *as = s->as.n ? &s->as : is_relative ? &ratio : NULL;
  if (!as) return value;
  if (is_relative) reference = reference_of(a, point);
  gg_variables at = {x, value.mean, reference.mean, NAN};
  double mean = gg_reproduce_expression_value(as, at),
         error = fabs(gg_reproduce_expression_slope(as, at, 'y')) * value.error;
  if (is_relative) error = hypot(error, gg_reproduce_expression_slope(as, at, 'r') * reference.error);
  /* relative to itself: exactly that, for both are one number */
  if (is_relative && value.mean == reference.mean && value.error == reference.error) error = 0;
  return (gg_told){mean, error, NULL};
}
