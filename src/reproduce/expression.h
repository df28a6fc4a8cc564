/* Formulas of entries: those of base/expression.h in x, y, r, v. */
#ifndef GG_EXPRESSION_H
#define GG_EXPRESSION_H

#include "base/expression.h"

typedef struct gg_variables {
  double x, y, r, v;
} gg_variables;

gg_status gg_reproduce_expression_parse(gg_expression *e, const char *text, gg_error *err);
double gg_reproduce_expression_value(const gg_expression *e, gg_variables at);
/* Its derivative with respect to y, and to r. */
double gg_reproduce_expression_slope(const gg_expression *e, gg_variables at, char variable);

#endif
