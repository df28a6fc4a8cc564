/* Small formulas of entries, "y/(1+y)": + - * / ^, parentheses, numbers, pi, inf, functions of one argument, and the
 * variables x, y, r, v. */
#ifndef GG_EXPRESSION_H
#define GG_EXPRESSION_H

#include <stdbool.h>

#include "base/error.h"

enum { GG_EXPRESSION_STEPS = 64 };

/* In postfix order; n = 0: not given. */
typedef struct gg_expression {
  int n;
  struct {
    char code; /* 'n' a number, 'x' 'y' 'r' 'v' a variable, an operator, '_' the sign, 'f' a function */
    double number;
  } step[GG_EXPRESSION_STEPS];
} gg_expression;

typedef struct gg_variables {
  double x, y, r, v;
} gg_variables;

/* GG_BAD_INPUT says what is wrong and at which character. */
gg_status gg_reproduce_expression_parse(gg_expression *e, const char *text, gg_error *err);
double gg_reproduce_expression_value(const gg_expression *e, gg_variables at);
/* Its derivative with respect to y, and to r. */
double gg_reproduce_expression_slope(const gg_expression *e, gg_variables at, char variable);

#endif
