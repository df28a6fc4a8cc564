#include "reproduce/expression.h"

#include <math.h>

gg_status gg_reproduce_expression_parse(gg_expression *e, const char *text, gg_error *err)
{
  static const char *const names[] = {"x", "y", "r", "v", NULL};
  return gg_base_expression_parse(e, text, names, err);
}

double gg_reproduce_expression_value(const gg_expression *e, gg_variables at)
{
  return gg_base_expression_value(e, (const double[]){at.x, at.y, at.r, at.v});
}

double gg_reproduce_expression_slope(const gg_expression *e, gg_variables at, char variable)
{
  double *of = variable == 'r'   ? &at.r
               : variable == 'x' ? &at.x
                                 : &at.y,
         here = *of, step = 1e-5 * (here == 0 ? 1 : fabs(here));
  *of = here + step;
  double above = gg_reproduce_expression_value(e, at);
  *of = here - step;
  return (above - gg_reproduce_expression_value(e, at)) / (2 * step);
}
