/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both engines and the theories in one table, and the causes of their differences. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/definition.h"
#include "cli/print.h"
#include "cli/report.h"

enum { MOST_THEORIES = 32 };

/* The result that theories are compared with: md, or dsmc without md. */
static const gg_result *reference(const gg_comparison *c)
{
  const gg_result *md = gg_comparison_result(c, "md");
  return md ? md : gg_comparison_result(c, "dsmc");
}

static bool both_ran(const gg_comparison *c)
{
  return gg_comparison_result(c, "md") && gg_comparison_result(c, "dsmc");
}

static double value_of(const gg_comparison *c, const char *theory, const char *quantity, double *deviation)
{
  double value = NAN;
  gg_comparison_theory_value(c, theory, quantity, &value, deviation, NULL);
  return value;
}

static bool is_shown(const gg_comparison *c, const gg_comparison_row *row, bool all)
{
  gg_theory_info t;
  if (gg_cli_quantity_is_minor(row->name) && !all) return false;
  if (reference(c)) return !isnan(row->mean[0]) || !isnan(row->mean[1]);
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK; i++)
    if (!isnan(value_of(c, t.name, row->name, NULL))) return true;
  return false;
}

/* The next printed row; false after the last. */
static bool next_shown(const gg_comparison *c, bool all, size_t *i, gg_comparison_row *row)
{
  while (gg_comparison_at(c, (*i)++, row, NULL) == GG_OK)
    if (is_shown(c, row, all)) return true;
  return false;
}

/* True if values are of one time, and most of those of theories of the steady state. */
static bool is_in_time(const gg_comparison *c)
{
  return reference(c) && gg_cli_is_followed(gg_comparison_scene(c));
}

/* The value of a theory in the table: of a gas that is followed in time only beside a value that is comparable. */
static double shown_value(const gg_comparison *c, const char *theory, const char *quantity, double *deviation)
{
  const double value = value_of(c, theory, quantity, deviation);
  return is_in_time(c) && isnan(*deviation) ? NAN : value;
}

/* Column of each theory; -1 for theories without a printed value. */
static int theory_columns(gg_table *t, const gg_comparison *c, bool all, int column[MOST_THEORIES])
{
  int n = 0;
  gg_theory_info theory;
  for (size_t i = 0; i < MOST_THEORIES; i++) {
    gg_comparison_row row;
    double deviation;
    column[i] = -1;
    if (gg_comparison_theory(c, i, &theory, NULL) != GG_OK) continue;
    for (size_t k = 0; column[i] < 0 && next_shown(c, all, &k, &row);)
      if (!isnan(shown_value(c, theory.name, row.name, &deviation)))
        column[i] = gg_cli_table_column(t, theory.name, true), n++;
  }
  return n;
}

static void put_engines(gg_table *t, int at, const gg_comparison *c, const gg_comparison_row *row)
{
  int column = 2;
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    if (!gg_comparison_result(c, gg_cli_engines[k])) continue;
    if (!isnan(row->mean[k]))
      gg_format_estimate(row->mean[k], row->error[k], gg_cli_table_cell(t, at, column), GG_TABLE_CELL);
    column++;
  }
  if (isfinite(row->z))
    snprintf(gg_cli_table_cell(t, at, column), GG_TABLE_CELL, "%+.1f%s", row->z, row->beyond ? "!" : " ");
}

static gg_table *tabulate(const gg_comparison *c, bool all, int *n_theories)
{
  int column[MOST_THEORIES];
  gg_comparison_row row;
  gg_theory_info theory;
  gg_table *t = gg_cli_table_new();
  if (!t) return NULL;
  gg_cli_table_column(t, "quantity", false);
  gg_cli_table_column(t, "unit", false);
  for (int k = 0; k < GG_CLI_ENGINES; k++)
    if (gg_comparison_result(c, gg_cli_engines[k])) gg_cli_table_column(t, gg_cli_engines[k], true);
  if (both_ran(c)) gg_cli_table_column(t, "z", true);
  *n_theories = theory_columns(t, c, all, column);
  for (size_t i = 0; next_shown(c, all, &i, &row);) {
    int at = gg_cli_table_row(t);
    snprintf(gg_cli_table_cell(t, at, 0), GG_TABLE_CELL, "%s", row.name);
    snprintf(gg_cli_table_cell(t, at, 1), GG_TABLE_CELL, "%s", row.unit);
    if (reference(c)) put_engines(t, at, c, &row);
    for (size_t k = 0; k < MOST_THEORIES && gg_comparison_theory(c, k, &theory, NULL) == GG_OK; k++) {
      double deviation = NAN, value = column[k] < 0 ? NAN : shown_value(c, theory.name, row.name, &deviation);
      if (!isnan(value)) gg_cli_format_answer(value, deviation, reference(c), gg_cli_table_cell(t, at, column[k]));
    }
  }
  return t;
}

enum { ONE = 160, MOST = 800 };
static const double far = 3; /* standard errors */

/* "temperature by +1.9(3) %", "N1 by -0.012(3)" */
static void put_departure(const char *quantity, const gg_departure *d, char text[ONE])
{
  char number[64];
  bool ratio = !isnan(d->deviation);
  if (ratio)
    gg_format_estimate(100 * d->deviation, 100 * d->deviation_error, number, sizeof number);
  else
    gg_format_estimate(d->difference, d->error, number, sizeof number);
  snprintf(text, ONE, "%s by %s%s%s", quantity, number[0] == '-' ? "" : "+", number, ratio ? " %" : "");
}

/* The headline quantities in which an engine deviates significantly; otherwise the deviation of the first. */
typedef struct verdict {
  int compared, off;
  char list[MOST], first[ONE];
} verdict;

static verdict weigh(const gg_comparison *c, int engine)
{
  gg_comparison_row row;
  verdict v = {0};
  for (size_t i = 0; gg_comparison_at(c, i, &row, NULL) == GG_OK; i++) {
    char text[ONE];
    const gg_departure *d = &row.departure[engine];
    if (isnan(d->z) || !d->headline) continue;
    put_departure(row.name, d, text);
    if (!v.compared++) snprintf(v.first, sizeof v.first, "%s", text);
    if (fabs(d->z) > far) gg_cli_append(v.list, sizeof v.list, "%s%s", v.off++ ? ", " : "", text);
  }
  return v;
}

/* Print each engine's deviation from Enskog's equation solved without random numbers, if there is a solution. */
static void print_verdicts(const gg_comparison *c)
{
  bool any = false;
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    verdict v = weigh(c, k);
    if (!v.compared) continue;
    if (!any) printf("\n");
    any = true;
    if (v.off)
      gg_cli_print_paragraph(stdout, 2, "%s differs from Enskog's equation (enskog_hermite) in %s", gg_cli_engines[k],
                             v.list);
    else
      gg_cli_print_paragraph(stdout, 2,
                             "%s agrees with Enskog's equation (enskog_hermite) within %g standard errors in %d main "
                             "quantities, %s",
                             gg_cli_engines[k], far, v.compared, v.first);
  }
}

/* Print causes of the marked z-scores, or that none is known. */
static void print_causes(const gg_comparison *c, bool all)
{
  bool marked = false;
  gg_comparison_row row;
  gg_remark r;
  for (size_t i = 0; !marked && next_shown(c, all, &i, &row);) marked = row.beyond;
  if (!marked) return;
  printf("\n");
  gg_cli_print_wrapped(stdout, "!: ", "md deviates from Enskog's equation more than expected:");
  for (size_t i = 0; gg_comparison_remark(c, i, &r, NULL) == GG_OK; i++)
    if (!r.theory) gg_cli_print_wrapped(stdout, "  - ", r.cause);
}

/* Print causes of the theories' deviations. */
static void print_remarks(const gg_comparison *c)
{
  bool any = false;
  gg_remark r;
  for (size_t i = 0; gg_comparison_remark(c, i, &r, NULL) == GG_OK; i++) {
    char text[400];
    if (!r.theory) continue;
    if (!any) printf("\n");
    if (!any) gg_cli_print_wrapped(stdout, "", "Theories that deviate more than expected, and why:");
    any = true;
    snprintf(text, sizeof text, "%s, %s %+.1f %%: %s", r.theory, r.quantity, 100 * r.deviation, r.cause);
    gg_cli_print_wrapped(stdout, "  - ", text);
  }
}

static void print_inapplicable(const gg_comparison *c)
{
  char list[800] = "";
  gg_theory_info t;
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK; i++)
    if (t.reason) gg_cli_append(list, sizeof list, "%s%s", *list ? ", " : "", t.name);
  if (!*list) return;
  printf("\n");
  gg_cli_print_paragraph(stdout, 2, "Theories for other scenes (graingas theory says why): %s", list);
}

static void print_legend(const gg_comparison *c, int n_theories)
{
  gg_result_info against;
  char deviation[80] = "";
  if (n_theories && gg_result_get_info(reference(c), &against, NULL) == GG_OK)
    snprintf(deviation, sizeof deviation, "; %%: deviation of a theory from %s", against.engine);
  printf("\n");
  gg_cli_print_paragraph(stdout, 0, "(..): standard error of the last digits%s%s",
                         both_ran(c) ? "; z: (md - dsmc) over their combined standard error" : "", deviation);
  if (reference(c)) gg_cli_print_headline(gg_comparison_scene(c));
  if (is_in_time(c))
    gg_cli_print_paragraph(stdout, 0,
                           "values are those at the end; kinetic theory in time stands beside the curves of "
                           "the results and their picture, that of the steady state in `graingas theory`");
}

void gg_cli_print_comparison(const gg_comparison *c, bool all)
{
  int n_theories;
  GG_CLI_FREED gg_table *t = tabulate(c, all, &n_theories);
  if (!t) return;
  gg_cli_print_head(gg_comparison_scene(c));
  gg_cli_table_print(t, stdout, 1);
  print_legend(c, n_theories);
  print_verdicts(c);
  print_causes(c, all);
  print_remarks(c);
  gg_cli_print_curves(NULL, c, all);
  printf("\n");
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    const char *refusal = gg_comparison_refusal(c, gg_cli_engines[k]);
    if (gg_comparison_result(c, gg_cli_engines[k])) gg_cli_print_effort(gg_comparison_result(c, gg_cli_engines[k]));
    if (refusal) gg_cli_print_paragraph(stdout, 6, "%-5s not run: %s", gg_cli_engines[k], refusal);
  }
  print_inapplicable(c);
  for (int k = 0; k < GG_CLI_ENGINES; k++)
    if (gg_comparison_result(c, gg_cli_engines[k]))
      gg_cli_print_warnings(gg_comparison_result(c, gg_cli_engines[k]), NULL);
}

/* Print the largest relative numerical error of a theory, with its quantity; a quantity may be 0 within its error. */
static void print_numerical_error(const gg_comparison *c, const char *theory)
{
  double most = 0;
  gg_comparison_row row;
  char text[300], worst[64] = "", zero[200] = "";
  for (size_t i = 0; gg_comparison_at(c, i, &row, NULL) == GG_OK; i++) {
    double error = NAN;
    gg_comparison_theory_error(c, theory, row.name, &error, NULL);
    const double relative = error / fabs(value_of(c, theory, row.name, NULL));
    if (relative >= 1) gg_cli_append(zero, sizeof zero, " %s is 0 to %.1g.", row.name, error);
    if (relative < 1 && relative > most) most = relative, snprintf(worst, sizeof worst, "%s", row.name);
  }
  if (!*worst) return;
  snprintf(text, sizeof text, "solved numerically, to %.1g %% of %s and better of all others.%s", 100 * most, worst,
           zero);
  gg_cli_print_wrapped(stdout, "  Here: ", text);
}

/* The last x with a value; INFINITY if all values are known. */
static double end_of(const gg_curve_data *curve)
{
  size_t n = curve->n;
  while (n > 0 && isnan(curve->value[n - 1])) n--;
  return n == curve->n ? INFINITY : n ? curve->x[n - 1] : NAN;
}

static void print_curves(const gg_comparison *c, const char *theory)
{
  gg_curve_data curve, next;
  double end = INFINITY;
  int n = 0;
  for (size_t i = 0; gg_comparison_theory_curve(c, theory, i, &curve, NULL) == GG_OK; i++) {
    n++, end = fmin(end, end_of(&curve));
    if (gg_comparison_theory_curve(c, theory, i + 1, &next, NULL) == GG_OK &&
        strcmp(next.observable, curve.observable) == 0)
      continue;
    char text[240], known[80] = "";
    if (isfinite(end)) snprintf(known, sizeof known, "; known up to %s = %.3g", curve.x_name, end);
    snprintf(text, sizeof text, "%d curves of %s (--json; compare and plot draw them)%s.", n, curve.observable, known);
    gg_cli_print_wrapped(stdout, "  Here: ", text);
    n = 0, end = INFINITY;
  }
}

void gg_cli_print_theories(const gg_comparison *c, bool all)
{
  int n_theories;
  gg_theory_info theory;
  GG_CLI_FREED gg_table *t = tabulate(c, all, &n_theories);
  if (!t) return;
  gg_cli_print_head(gg_comparison_scene(c));
  if (n_theories) gg_cli_table_print(t, stdout, 2);
  gg_cli_print_curves(NULL, c, all);
  printf("\n");
  for (size_t i = 0; gg_comparison_theory(c, i, &theory, NULL) == GG_OK; i++) {
    if (theory.reason) continue;
    gg_cli_print_paragraph(stdout, 2, "%s: %s (%s)\n%s", theory.name, theory.title, theory.citation,
                           theory.assumptions);
    if (theory.beyond) gg_cli_print_wrapped(stdout, "  Here: ", theory.beyond);
    print_numerical_error(c, theory.name);
    print_curves(c, theory.name);
  }
  for (size_t i = 0; gg_comparison_theory(c, i, &theory, NULL) == GG_OK; i++)
    if (theory.reason) gg_cli_print_paragraph(stdout, 2, "%s", theory.reason);
}
