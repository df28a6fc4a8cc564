/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small formulas, "y/(1+y)" or "0.9 if v < 2 else 0.6": + - * / ^, comparisons, which are 1 or 0, parentheses, numbers,
 * pi, inf, functions of one argument or two, and variables that the caller names. Both branches of a condition are
 * computed; one is taken, and NaN as a condition takes NaN. Functions are those of the C library, but of
 * gg_common_expression_branch. */
#ifndef GG_COMMON_EXPRESSION_H
#define GG_COMMON_EXPRESSION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

enum { GG_EXPRESSION_STEPS = 64 };

/* In postfix order; n = 0: not given. */
typedef struct gg_expression {
  int n;
  struct {
    char code;     /* 'n' a number, 'p' a variable, an operator, '_' the sign, 'f' a function, '?' a condition */
    double number; /* of 'p' and 'f' their index */
  } step[GG_EXPRESSION_STEPS];
} gg_expression;

/* `variables` ends with NULL. GG_BAD_INPUT says what is wrong and at which character. */
gg_status gg_common_expression_parse(gg_expression *e, const char *text, const char *const *variables, gg_error *err);
/* Whether formulas have the word: a constant, a function, if, else. */
bool gg_common_expression_knows(const char *word);
/* With the values of all variables, in their order. */
double gg_common_expression_value(const gg_expression *e, const double *at);
/* The same with the same bits everywhere (common/portable_functions.h), and which comparisons and conditions are true,
 * a bit each: where two values have one *branch, no step of a comparison is between them. */
double gg_common_expression_branch(const gg_expression *e, const double *at, uint64_t *branch);
/* Mean over an interval of a formula of one variable, with the same bits everywhere; *largest: its largest absolute
 * value at the ends and at the nodes, NaN if the mean is not finite. */
double gg_common_expression_mean(const gg_expression *e, double from, double length, double *largest);

#endif
