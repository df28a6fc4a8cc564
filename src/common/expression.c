/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/expression.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "common/portable_functions.h"

typedef struct function {
  const char *name;
  double (*of)(double), (*portable)(double);
  double (*of_two)(double, double); /* NULL: of one */
} function;

static const function functions[] = {{"ln", log, gg_common_portable_ln, NULL},
                                     {"log10", log10, gg_common_portable_log10, NULL},
                                     {"exp", exp, gg_common_portable_exp, NULL},
                                     {"sqrt", sqrt, sqrt, NULL},
                                     {"abs", fabs, fabs, NULL},
                                     {"sin", sin, gg_common_portable_sin, NULL},
                                     {"cos", cos, gg_common_portable_cos, NULL},
                                     {"atan", atan, gg_common_portable_atan, NULL},
                                     {"tanh", tanh, gg_common_portable_tanh, NULL},
                                     {"erf", erf, gg_common_portable_erf, NULL},
                                     {"min", NULL, NULL, fmin},
                                     {"max", NULL, NULL, fmax},
                                     {NULL, NULL, NULL, NULL}};

typedef struct parser {
  const char *text, *at;
  const char *const *variables;
  gg_expression *e;
  int depth;
  gg_error *err;
} parser;

static gg_status conditional(parser *p);

static gg_status refuse(const parser *p, const char *what)
{
  return gg_base_fail(p->err, GG_BAD_INPUT, "'%.200s' at character %td: %s", p->text, p->at - p->text + 1, what);
}

static void skip(parser *p)
{
  while (*p->at == ' ') p->at++;
}

static gg_status add(const parser *p, char code, double number)
{
  if (p->e->n == GG_EXPRESSION_STEPS) return refuse(p, "the formula is too long");
  p->e->step[p->e->n].code = code;
  p->e->step[p->e->n++].number = number;
  return GG_OK;
}

static bool is(const char *name, size_t length, const char *word)
{
  return strlen(word) == length && strncmp(word, name, length) == 0;
}

static gg_status refuse_word(const parser *p)
{
  char known[600] = "";
  for (int k = 0; p->variables[k]; k++) gg_base_text_append(known, sizeof known, "%s, ", p->variables[k]);
  gg_base_text_append(known, sizeof known, "pi, inf");
  for (int k = 0; functions[k].name; k++) gg_base_text_append(known, sizeof known, ", %s", functions[k].name);
  return gg_base_fail(p->err, GG_BAD_INPUT, "'%.200s' at character %td: not known; there are %s", p->text,
                      p->at - p->text + 1, known);
}

bool gg_common_expression_knows(const char *word)
{
  static const char *const words[] = {"pi", "inf", "if", "else"};
  bool known = false;
  for (size_t k = 0; k < sizeof words / sizeof *words; k++) known |= strcmp(words[k], word) == 0;
  for (int k = 0; functions[k].name; k++) known |= strcmp(functions[k].name, word) == 0;
  return known;
}

static gg_status word(parser *p)
{
  size_t length = 0;
  while (isalnum((unsigned char)p->at[length]) || p->at[length] == '_') length++;
  const char *name = p->at;
  p->at += length;
  for (int k = 0; p->variables[k]; k++)
    if (is(name, length, p->variables[k])) return add(p, 'p', k);
  if (is(name, length, "pi")) return add(p, 'n', M_PI);
  if (is(name, length, "inf")) return add(p, 'n', INFINITY);
  for (int k = 0; functions[k].name; k++) {
    if (!is(name, length, functions[k].name)) continue;
    skip(p);
    if (*p->at++ != '(') return p->at--, refuse(p, "( is missing after a function");
    GG_TRY(conditional(p));
    if (functions[k].of_two) {
      if (*p->at++ != ',') return p->at--, refuse(p, "a comma and a second argument are missing");
      GG_TRY(conditional(p));
    }
    if (*p->at++ != ')') return p->at--, refuse(p, ") is missing");
    return add(p, 'f', k);
  }
  p->at = name;
  return refuse_word(p);
}

static gg_status atom(parser *p)
{
  char *end;
  skip(p);
  if (*p->at == '(') {
    p->at++;
    GG_TRY(conditional(p));
    if (*p->at != ')') return refuse(p, ") is missing");
    p->at++;
  } else if (isdigit((unsigned char)*p->at) || *p->at == '.') {
    double number = strtod(p->at, &end);
    p->at = end;
    GG_TRY(add(p, 'n', number));
  } else if (isalpha((unsigned char)*p->at)) {
    GG_TRY(word(p));
  } else {
    return refuse(p, "a number, a name or ( is missing");
  }
  skip(p);
  return GG_OK;
}

/* The sign binds less than ^, and ^ from the right: -x^2, 2^x^2. */
static gg_status power(parser *p)
{
  skip(p);
  if (*p->at == '-' || *p->at == '+') {
    char sign = *p->at++;
    if (++p->depth > GG_EXPRESSION_STEPS) return refuse(p, "the formula is too deep");
    GG_TRY(power(p));
    return sign == '-' ? add(p, '_', 0) : GG_OK;
  }
  GG_TRY(atom(p));
  if (*p->at != '^') return GG_OK;
  p->at++;
  if (++p->depth > GG_EXPRESSION_STEPS) return refuse(p, "the formula is too deep");
  GG_TRY(power(p));
  return add(p, '^', 0);
}

static gg_status product(parser *p)
{
  GG_TRY(power(p));
  while (*p->at == '*' || *p->at == '/') {
    char sign = *p->at++;
    GG_TRY(power(p));
    GG_TRY(add(p, sign, 0));
  }
  return GG_OK;
}

static gg_status sum(parser *p)
{
  if (++p->depth > GG_EXPRESSION_STEPS) return refuse(p, "the formula is too deep");
  GG_TRY(product(p));
  while (*p->at == '+' || *p->at == '-') {
    char sign = *p->at++;
    GG_TRY(product(p));
    GG_TRY(add(p, sign, 0));
  }
  return GG_OK;
}

static gg_status comparison(parser *p)
{
  GG_TRY(sum(p));
  const char sign = *p->at;
  const bool equal = sign && p->at[1] == '=';
  if (!sign || !strchr("<>=", sign) || (sign == '=' && !equal)) return GG_OK;
  p->at += 1 + equal;
  GG_TRY(sum(p));
  return add(p, sign == '=' || !equal ? sign : sign == '<' ? 'l' : 'g', 0);
}

/* Go past this word, if it comes next. */
static bool takes(parser *p, const char *word)
{
  const size_t length = strlen(word);
  if (strncmp(p->at, word, length) != 0 || isalnum((unsigned char)p->at[length]) || p->at[length] == '_') return false;
  p->at += length;
  return true;
}

/* `a if b else c`, c from the right. */
static gg_status conditional(parser *p)
{
  GG_TRY(comparison(p));
  if (!takes(p, "if")) return GG_OK;
  GG_TRY(comparison(p));
  if (!takes(p, "else")) return refuse(p, "else is missing after if");
  if (++p->depth > GG_EXPRESSION_STEPS) return refuse(p, "the formula is too deep");
  GG_TRY(conditional(p));
  return add(p, '?', 0);
}

gg_status gg_common_expression_parse(gg_expression *e, const char *text, const char *const *variables, gg_error *err)
{
  parser p = {text, text, variables, e, 0, err};
  e->n = 0;
  GG_TRY(conditional(&p));
  return *p.at ? refuse(&p, "not expected here") : GG_OK;
}

static double combine(char code, bool portable, double a, double b)
{
  switch (code) {
  case '+': return a + b;
  case '-': return a - b;
  case '*': return a * b;
  case '/': return a / b;
  case '<': return a < b;
  case '>': return a > b;
  case 'l': return a <= b;
  case 'g': return a >= b;
  case '=': return a == b;
  default: return portable ? gg_common_portable_pow(a, b) : pow(a, b);
  }
}

/* Put the value of a function in the place of its arguments; the new height of the stack. */
static int call(const function *f, bool portable, double *stack, int top)
{
  if (!f->of_two) return stack[top - 1] = (portable ? f->portable : f->of)(stack[top - 1]), top;
  stack[top - 2] = f->of_two(stack[top - 2], stack[top - 1]);
  return top - 1;
}

static bool compares(char code)
{
  return strchr("<>lg=", code) != NULL;
}

static double evaluate(const gg_expression *e, bool portable, const double *at, uint64_t *branch)
{
  double stack[GG_EXPRESSION_STEPS];
  int top = 0;
  *branch = 0;
  for (int i = 0; i < e->n; i++) {
    double *last = stack + (top ? top - 1 : 0);
    switch (e->step[i].code) {
    case 'n': stack[top++] = e->step[i].number; break;
    case 'p': stack[top++] = at[(int)e->step[i].number]; break;
    case '_': *last = -*last; break;
    case 'f': top = call(&functions[(int)e->step[i].number], portable, stack, top); break;
    case '?':
      top -= 2;
      *branch = 2 * *branch + (stack[top] != 0);
      stack[top - 1] = isnan(stack[top]) ? NAN : stack[top] != 0 ? stack[top - 1] : stack[top + 1];
      break;
    default:
      top--;
      stack[top - 1] = combine(e->step[i].code, portable, stack[top - 1], stack[top]);
      if (compares(e->step[i].code)) *branch = 2 * *branch + (stack[top - 1] != 0);
    }
  }
  return top ? stack[0] : NAN;
}

double gg_common_expression_value(const gg_expression *e, const double *at)
{
  uint64_t branch;
  return evaluate(e, false, at, &branch);
}

double gg_common_expression_branch(const gg_expression *e, const double *at, uint64_t *branch)
{
  return evaluate(e, true, at, branch);
}

/* Gauss-Legendre quadrature of 8 points, the upper half of the nodes and their weights. */
enum { HALF = 4 };
static const double node[HALF] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
static const double weight[HALF] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

/* The same bits on every machine. */
static double value_at(const gg_expression *e, double t)
{
  uint64_t unused;
  return gg_common_expression_branch(e, &t, &unused);
}

double gg_common_expression_mean(const gg_expression *e, double from, double length, double *largest)
{
  double sum = 0, most = 0;
  for (int end = 0; end < 2; end++) most = fmax(most, fabs(value_at(e, from + end * length)));
  for (int k = 0; k < 2 * HALF; k++) {
    const double at = (1 + (k % 2 ? 1 : -1) * node[k / 2]) / 2, value = value_at(e, from + at * length);
    sum += weight[k / 2] / 2 * value;
    most = fmax(most, fabs(value));
  }
  *largest = isfinite(sum) ? most : NAN;
  return sum;
}
