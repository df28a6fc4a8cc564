#include "theory/theory_curves.h"

#include <math.h>

static const double share = 0.25;

static double step(const gg_curve *a, const gg_curve *b, size_t i)
{
  return fabs(a->value[i] - b->value[i]);
}

static size_t middle_of(const gg_curve *c)
{
  size_t at = 0;
  for (size_t i = 0; i < c->n; i++)
    if (fabs(c->x[i]) < fabs(c->x[at])) at = i;
  return at;
}

/* What an error is held against: a distribution's own value; of others the largest value that is known. */
static double scale_of(const gg_curve *c)
{
  double most = 0;
  for (size_t i = 0; i < c->n && !c->log_y; i++)
    if (c->error[i] <= share * fabs(c->value[i])) most = fmax(most, fabs(c->value[i]));
  return most;
}

/* How far it is known to one side of the middle; what lies beyond is taken away. The last x that is. */
static double cut(gg_curve *c, double scale, size_t from, int direction)
{
  double last = c->x[from];
  bool known = true;
  for (size_t i = from; i < c->n; i += (size_t)direction) { /* below 0 it wraps round, and ends */
    known = known && c->error[i] <= share * (c->log_y ? c->value[i] : scale) && (!c->log_y || c->value[i] > 0);
    if (known)
      last = c->x[i];
    else
      c->value[i] = c->error[i] = NAN;
  }
  return last;
}

void gg_theory_curves_converge(gg_curves *last, const gg_curves *before, const gg_curves *earlier)
{
  for (int k = 0; k < last->n; k++) {
    gg_curve *c = &last->curve[k];
    for (size_t i = 0; i < c->n; i++) {
      c->error[i] = step(c, &before->curve[k], i);
      if (earlier) c->error[i] = fmax(c->error[i], step(c, &earlier->curve[k], i) / 10);
    }
    for (int i = 0; i < c->n_numbers; i++) {
      double value = c->number[i].value, error = fabs(value - before->curve[k].number[i].value);
      if (earlier) error = fmax(error, fabs(value - earlier->curve[k].number[i].value) / 10);
      c->number[i].error = error;
    }
    size_t middle = middle_of(c);
    double scale = scale_of(c), to = cut(c, scale, middle, 1), from = middle ? cut(c, scale, middle, -1) : c->x[0];
    gg_measure_curve_put_setting(c, "known_from", from, c->x_unit);
    gg_measure_curve_put_setting(c, "known_to", to, c->x_unit);
  }
}
