#include "cli/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/table.h"
#include "io/document.h"
#include "io/text.h"
#include "run/agreement.h"

void gg_cli_print_document(json_t *document)
{
  char *text = document ? gg_document_text(document) : NULL;
  if (text) puts(text);
  free(text);
  json_decref(document);
}

/* Left to --all: parts and components that few look at first. */
static bool is_minor(gg_quantity q)
{
  if (q >= GG_N_QUANTITIES) return false;
  const char *name = gg_quantity_name(q);
  if (q == GG_Q_VISCOSITY_REDUCED_KINETIC) return false;
  static const char *const minor[] = {"_kinetic", "_collisional", "P_yx",       "kurtosis",
                                      "skewness", "knudsen",      "dissipation"};
  for (size_t i = 0; i < sizeof minor / sizeof *minor; i++)
    if (strstr(name, minor[i])) return true;
  return false;
}

static void print_head(const gg_scene *scene)
{
  char title[240];
  gg_scene_title(scene, title, sizeof title);
  printf("\n%s\n\n", title);
}

/* "md    1000 grains, 2.1 M collisions averaged over in 3.2 s (0.65 M/s); no drift over ..." */
static void print_effort(const gg_result *r)
{
  char collisions[24], rate[24], seconds[24];
  const gg_effort *a = &r->averaging;
  gg_format_count((double)a->collisions, collisions, sizeof collisions);
  gg_format_count((double)a->collisions / a->cpu_seconds, rate, sizeof rate);
  gg_format_duration(a->cpu_seconds, seconds, sizeof seconds);
  printf("%-5s %ld grains; %s collisions averaged over in %s of processor time", r->engine, (long)r->model.n,
         collisions, seconds);
  if (a->cpu_seconds > 0) printf(" (%s/s)", rate);
  printf("\n      %s: %s\n", r->steadiness == GG_STEADY ? "steady" : "not steady", r->steadiness_text);
}

static void print_warnings(const gg_result *r)
{
  fflush(stdout);
  for (int i = 0; i < r->n_warnings; i++) fprintf(stderr, "warning: %s: %s\n", r->engine, r->warnings[i]);
}

static void put_mean(gg_table *t, int row, int column, const gg_result *r, gg_quantity q)
{
  if (r && !isnan(r->value[q].mean))
    gg_format_estimate(r->value[q].mean, r->value[q].error, gg_table_cell(t, row, column), GG_TABLE_CELL);
}

static bool has(const gg_result *r, gg_quantity q)
{
  return r && !isnan(r->value[q].mean);
}

void gg_print_run(const gg_result *r, bool all)
{
  gg_table *t = gg_table_new();
  if (!t) return;
  gg_table_column(t, "quantity", false);
  gg_table_column(t, r->engine, true);
  gg_table_column(t, "unit", false);
  gg_table_column(t, "samples", true);
  for (int i = 0; i < gg_quantities_of(&r->model); i++) {
    gg_quantity q = (gg_quantity)i;
    if (!has(r, q) || (is_minor(q) && !all)) continue;
    int row = gg_table_row(t);
    snprintf(gg_table_cell(t, row, 0), GG_TABLE_CELL, "%s", gg_quantity_name_in(&r->model, q));
    put_mean(t, row, 1, r, q);
    snprintf(gg_table_cell(t, row, 2), GG_TABLE_CELL, "%s", gg_quantity_unit(q, &r->model));
    snprintf(gg_table_cell(t, row, 3), GG_TABLE_CELL, "%lu", (unsigned long)r->value[q].samples);
  }
  print_head(&r->scene);
  gg_table_print(t, stdout, gg_terminal_width(), 1);
  free(t);
  gg_print_numbers(r, NULL, all);
  printf("\n");
  print_effort(r);
  print_warnings(r);
}

static void put_theory(gg_table *t, int row, int column, const gg_comparison *c, int theory, gg_quantity q)
{
  double value = c->theory[theory].answer.value[q];
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  const gg_result *against = has(md, q) ? md : has(dsmc, q) ? dsmc : NULL;
  if (!isfinite(value)) return;
  double deviation = against ? gg_deviation(&against->value[q], value) : NAN;
  char *cell = gg_table_cell(t, row, column);
  if (isnan(deviation))
    snprintf(cell, GG_TABLE_CELL, against ? "%.4g        " : "%.5g", value);
  else if (fabs(deviation) < 9.995)
    snprintf(cell, GG_TABLE_CELL, "%.4g %+6.1f%%", value, 100 * deviation);
  else
    snprintf(cell, GG_TABLE_CELL, "%.4g %+6.0fx", value, deviation + 1);
}

static bool answers(const gg_comparison *c, int theory, gg_quantity q)
{
  return c->theory[theory].applies && isfinite(c->theory[theory].answer.value[q]);
}

static bool shown(const gg_comparison *c, gg_quantity q, bool all)
{
  bool simulated = c->by_engine[GG_MD] || c->by_engine[GG_DSMC];
  if (is_minor(q) && !all) return false;
  if (simulated) return has(c->by_engine[GG_MD], q) || has(c->by_engine[GG_DSMC], q);
  for (int i = 0; i < c->n_theories; i++)
    if (answers(c, i, q)) return true;
  return false;
}

/* A theory with nothing to say on what is shown gets no column. */
static int theory_columns(gg_table *t, const gg_comparison *c, bool all, int *column)
{
  int n = 0;
  for (int i = 0; i < c->n_theories; i++) {
    column[i] = -1;
    for (int q = 0; q < gg_quantities_of(&c->model) && column[i] < 0; q++)
      if (shown(c, (gg_quantity)q, all) && answers(c, i, (gg_quantity)q))
        column[i] = gg_table_column(t, c->theory[i].theory->name, true), n++;
  }
  return n;
}

static void put_engines(gg_table *t, int row, const gg_comparison *c, gg_quantity q)
{
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  int column = 2;
  if (md) put_mean(t, row, column++, md, q);
  if (dsmc) put_mean(t, row, column++, dsmc, q);
  double z = has(md, q) && has(dsmc, q) ? gg_z_score(&md->value[q], &dsmc->value[q]) : NAN;
  if (isfinite(z)) snprintf(gg_table_cell(t, row, column), GG_TABLE_CELL, "%+.1f%s", z, gg_disagree(c, q) ? "!" : " ");
}

static gg_table *tabulate(const gg_comparison *c, bool engines, bool all, int *n_theories)
{
  gg_table *t = gg_table_new();
  int column[sizeof c->theory / sizeof *c->theory];
  if (!t) return NULL;
  gg_table_column(t, "quantity", false);
  gg_table_column(t, "unit", false);
  for (int k = 0; engines && k < 2; k++)
    if (c->by_engine[k]) gg_table_column(t, c->by_engine[k]->engine, true);
  if (engines && c->by_engine[GG_MD] && c->by_engine[GG_DSMC]) gg_table_column(t, "z", true);
  *n_theories = theory_columns(t, c, all, column);
  for (int i = 0; i < gg_quantities_of(&c->model); i++) {
    gg_quantity q = (gg_quantity)i;
    if (!shown(c, q, all)) continue;
    int row = gg_table_row(t);
    snprintf(gg_table_cell(t, row, 0), GG_TABLE_CELL, "%s", gg_quantity_name_in(&c->model, q));
    snprintf(gg_table_cell(t, row, 1), GG_TABLE_CELL, "%s", gg_quantity_unit(q, &c->model));
    if (engines) put_engines(t, row, c, q);
    for (int k = 0; k < c->n_theories; k++)
      if (column[k] >= 0) put_theory(t, row, column[k], c, k, q);
  }
  return t;
}

/* What stands behind the marked z-scores. */
static void print_causes(const gg_comparison *c, bool all)
{
  const char *cause[8];
  int marked = 0;
  for (int q = 0; q < gg_quantities_of(&c->model); q++) marked += shown(c, (gg_quantity)q, all) && gg_disagree(c, (gg_quantity)q);
  if (!marked) return;
  printf("\n!: md and dsmc differ by more than is expected here. Causes that apply to this scene:\n");
  int n = gg_causes_of_disagreement(c, cause, 8);
  for (int i = 0; i < n; i++) gg_print_wrapped(stdout, "  - ", cause[i], 98);
}

/* What stands behind theories' deviations. */
static void print_remarks(const gg_comparison *c)
{
  gg_theory_remark r[GG_MOST_THEORIES];
  int n = gg_theory_remarks(c, r);
  if (n) printf("\nTheories further off than is expected of solutions of one problem, and why:\n");
  for (int i = 0; i < n; i++) {
    char text[400];
    snprintf(text, sizeof text, "%s, %s %+.1f %%: %s", r[i].theory->name, gg_quantity_name_in(&c->model, r[i].quantity),
             100 * r[i].deviation, r[i].cause);
    gg_print_wrapped(stdout, "  - ", text, 98);
  }
}

static void print_inapplicable(const gg_comparison *c)
{
  size_t used = 0;
  for (int i = 0; i < c->n_theories; i++) {
    const char *name = c->theory[i].theory->name;
    if (c->theory[i].applies) continue;
    if (!used)
      used = (size_t)printf("\nTheories for other scenes (graingas theory says why): %s", name) - 1;
    else if (used + strlen(name) > 96)
      used = (size_t)printf(",\n%s", name) - 2;
    else
      used += (size_t)printf(", %s", name);
  }
  if (used) printf("\n");
}

void gg_print_comparison(const gg_comparison *c, bool all)
{
  int n_theories;
  gg_table *t = tabulate(c, true, all, &n_theories);
  if (!t) return;
  print_head(&c->scene);
  gg_table_print(t, stdout, gg_terminal_width(), 1);
  free(t);
  const gg_result *against = c->by_engine[GG_MD] ? c->by_engine[GG_MD] : c->by_engine[GG_DSMC];
  bool both = c->by_engine[GG_MD] && c->by_engine[GG_DSMC];
  printf("\n(..): standard error of the last digits");
  if (both) printf("; z: (md - dsmc) over their combined standard error");
  if (n_theories && against) printf(";%s%%: deviation of a theory from %s", both ? "\n" : " ", against->engine);
  printf("\n");
  print_causes(c, all);
  print_remarks(c);
  gg_print_numbers(c->by_engine[GG_MD], c->by_engine[GG_DSMC], all);
  printf("\n");
  for (int k = 0; k < 2; k++) {
    if (c->by_engine[k]) print_effort(c->by_engine[k]);
    if (c->refusal[k][0]) printf("%-5s not run: %s\n", gg_engine_ops_of((gg_engine_kind)k)->name, c->refusal[k]);
  }
  print_inapplicable(c);
  for (int k = 0; k < 2; k++)
    if (c->by_engine[k]) print_warnings(c->by_engine[k]);
}

void gg_print_theories(const gg_scene *scene, const gg_comparison *c, bool all)
{
  int n_theories;
  gg_table *t = tabulate(c, false, all, &n_theories);
  if (!t) return;
  print_head(scene);
  if (n_theories) gg_table_print(t, stdout, gg_terminal_width(), 1);
  free(t);
  printf("\n");
  for (int i = 0; i < c->n_theories; i++) {
    const gg_theory *theory = c->theory[i].theory;
    if (!c->theory[i].applies) continue;
    printf("%s: %s (%s)\n  %s\n", theory->name, theory->title, theory->citation, theory->assumptions);
    const char *beyond = gg_theory_beyond(theory, &c->model);
    if (beyond) printf("  Here: %s.\n", beyond);
  }
  for (int i = 0; i < c->n_theories; i++)
    if (!c->theory[i].applies) printf("%s\n", c->theory[i].reason);
}
