/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of engines and theories side by side: the numbers derived from them; profiles across the gap, a row each. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/print.h"
#include "cli/report.h"

void gg_cli_format_answer(double value, double deviation, bool beside, char *cell)
{
  if (isnan(deviation))
    snprintf(cell, GG_TABLE_CELL, beside ? "%.4g        " : "%.5g", value);
  else if (fabs(deviation) < 9.995)
    snprintf(cell, GG_TABLE_CELL, "%.4g %+6.1f%%", value, 100 * deviation);
  else
    snprintf(cell, GG_TABLE_CELL, "%.4g %+6.0fx", value, deviation + 1);
}

/* An engine's result, or a theory of a comparison (result NULL). */
typedef struct source {
  const char *name;
  const gg_result *result;
  const gg_comparison *theories;
} source;

enum { MOST_SOURCES = 12 };
typedef struct sources {
  int n, n_engines;
  source of[MOST_SOURCES];
} sources;

static bool curve_at(const source *s, size_t i, gg_curve_data *c)
{
  return (s->result ? gg_result_curve(s->result, i, c, NULL)
                    : gg_comparison_theory_curve(s->theories, s->name, i, c, NULL)) == GG_OK;
}

static bool number_at(const source *s, size_t i, size_t k, gg_measurement *number)
{
  return (s->result ? gg_result_curve_number(s->result, i, k, number, NULL)
                    : gg_comparison_theory_curve_number(s->theories, s->name, i, k, number, NULL)) == GG_OK;
}

static bool find_curve(const source *s, const char *name, size_t *i, gg_curve_data *found)
{
  for (*i = 0; curve_at(s, *i, found); ++*i)
    if (strcmp(found->name, name) == 0) return true;
  return false;
}

static bool find_number(const source *s, const char *curve, const char *name, gg_measurement *found)
{
  size_t i;
  gg_curve_data c;
  if (!find_curve(s, curve, &i, &c)) return false;
  for (size_t k = 0; number_at(s, i, k, found); k++)
    if (strcmp(found->name, name) == 0) return true;
  return false;
}

static void add_source(sources *all, source s)
{
  gg_curve_data c;
  if (all->n < MOST_SOURCES && curve_at(&s, 0, &c)) all->of[all->n++] = s;
}

static sources sources_of(const gg_result *run, const gg_comparison *c)
{
  sources all = {0};
  gg_theory_info t;
  gg_result_info about;
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    const gg_result *r = run && k == 0 ? run : gg_comparison_result(c, gg_cli_engines[k]);
    if (gg_result_get_info(r, &about, NULL) == GG_OK) add_source(&all, (source){about.engine, r, NULL});
  }
  all.n_engines = all.n;
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK; i++) add_source(&all, (source){t.name, NULL, c});
  return all;
}

/* Numbers that only --all prints: starts of fits, alternative estimates, numbers that are also quantities. */
static const char *const minor_numbers[] = {
    "fit_",           "_likelihood", "kurtosis", "skewness",       "rate_unit",  "_2_4.5", "_3.3_5.5",
    "knudsen",        "cells",       "_slabs",   "solid_fraction", "_corrected", "_box",   "second_moment",
    "long_time_tail", "core_",       NULL};

static bool is_minor(const char *name)
{
  for (const char *const *part = minor_numbers; *part; part++)
    if (strstr(name, *part)) return true;
  return false;
}

/* A mean with its error, or the answer of a theory with its deviation from a mean (NULL: none). */
static void put_value(const source *s, double mean, double error, const gg_measurement *reference, char *cell)
{
  const bool off = reference && fabs(reference->mean) > 3 * reference->error;
  if (s->result)
    gg_format_estimate(mean, error, cell, GG_TABLE_CELL);
  else
    gg_cli_format_answer(mean, off ? mean / reference->mean - 1 : NAN, reference != NULL, cell);
}

static void put_number(gg_table *t, const sources *all, const char *curve, const gg_measurement *number)
{
  gg_measurement by[MOST_SOURCES];
  const gg_measurement *first = NULL;
  if (t->n_rows == GG_TABLE_ROWS) return;
  const int row = gg_cli_table_row(t);
  snprintf(gg_cli_table_cell(t, row, 0), GG_TABLE_CELL, "%s", curve);
  snprintf(gg_cli_table_cell(t, row, 1), GG_TABLE_CELL, strcmp(number->unit, "1") == 0 ? "%s" : "%s [%s]", number->name,
           number->unit);
  for (int k = 0, column = 2; k < all->n; k++, column++) {
    by[k].error = 0; /* as of settings, which have no z */
    if (find_number(&all->of[k], curve, number->name, &by[k])) {
      put_value(&all->of[k], by[k].mean, by[k].error, first, gg_cli_table_cell(t, row, column));
      if (!first && all->of[k].result) first = &by[k];
    }
    if (k != 1 || all->n_engines != 2) continue;
    const double z = (by[0].mean - by[1].mean) / hypot(by[0].error, by[1].error);
    column++;
    if (by[0].error > 0 && by[1].error > 0 && isfinite(z))
      snprintf(gg_cli_table_cell(t, row, column), GG_TABLE_CELL, "%+.1f", z);
  }
}

/* Add the numbers of a source that no earlier one has. */
static void put_numbers(gg_table *t, const sources *all, int which, bool with_minor, char last[64])
{
  gg_curve_data c;
  gg_measurement p, elsewhere;
  for (size_t i = 0; curve_at(&all->of[which], i, &c); i++)
    for (size_t k = 0; number_at(&all->of[which], i, k, &p); k++) {
      bool known = !isfinite(p.mean) || (!with_minor && is_minor(p.name));
      for (int s = 0; s < which && !known; s++) known = find_number(&all->of[s], c.name, p.name, &elsewhere);
      if (known) continue;
      put_number(t, all, c.name, &p);
      if (strcmp(last, c.name) == 0) *gg_cli_table_cell(t, t->n_rows - 1, 0) = '\0';
      snprintf(last, 64, "%s", c.name);
    }
}

static void print(const gg_table *t, int keep)
{
  if (!t->n_rows) return;
  printf("\n");
  gg_cli_table_print(t, stdout, keep);
  if (t->n_rows == GG_TABLE_ROWS) printf("... and more than fit here: see the result file or --json\n");
}

static void print_numbers(const sources *all, bool with_minor)
{
  char last[64] = "";
  GG_CLI_FREED gg_table *t = gg_cli_table_new();
  if (!t) return;
  gg_cli_table_column(t, "derived from", false);
  gg_cli_table_column(t, "", false);
  for (int k = 0; k < all->n; k++) {
    gg_cli_table_column(t, all->of[k].name, true);
    if (k == 1 && all->n_engines == 2) gg_cli_table_column(t, "z", true);
  }
  for (int k = 0; k < all->n; k++) put_numbers(t, all, k, with_minor, last);
  print(t, 2);
}

/* The next profile of the first engine, from curve *i on. */
static bool next_profile(const sources *all, bool with_parts, size_t *i, gg_curve_data *c)
{
  while (curve_at(&all->of[0], (*i)++, c))
    if (strncmp(c->name, "profile_", 8) == 0 &&
        (with_parts || (!strstr(c->name, "_kinetic") && !strstr(c->name, "_collisional"))))
      return true;
  return false;
}

/* The same profile of a source; false unless its heights agree to a hundredth of a slab. */
static bool find_alike(const source *s, const gg_curve_data *like, gg_curve_data *found)
{
  size_t k;
  bool alike = find_curve(s, like->name, &k, found) && found->n == like->n;
  for (size_t i = 0; alike && i < like->n; i++)
    alike = fabs(found->x[i] - like->x[i]) <= 1e-2 * fabs(like->x[like->n - 1] - like->x[0]) / (double)like->n;
  return alike;
}

/* chi^2 a point of two profiles, and the largest difference over the largest value of the first, with its height.
 * Theories leave out layers at walls (core_from, core_to). */
static void put_agreement(const gg_curve_data *a, const source *other, char *cell)
{
  int n = 0;
  gg_curve_data b;
  gg_measurement from, to;
  double squares = 0, size = 0, most = 0, at = 0;
  if (!find_alike(other, a, &b)) return;
  if (!find_number(other, a->name, "core_from", &from)) from.mean = -INFINITY;
  if (!find_number(other, a->name, "core_to", &to)) to.mean = INFINITY;
  for (size_t i = 0; i < a->n; i++) {
    const double off = b.value[i] - a->value[i], z = off / hypot(a->error[i], b.error[i]);
    if (!isfinite(z) || a->x[i] < from.mean || a->x[i] > to.mean) continue;
    squares += z * z, n++, size = fmax(size, fabs(a->value[i]));
    if (fabs(off) >= fabs(most)) most = off, at = a->x[i];
  }
  if (n) snprintf(cell, GG_TABLE_CELL, "%.3g %+6.1f%% at %4.3g", squares / n, 100 * most / size, at);
}

static void print_profiles(const sources *all, bool with_parts)
{
  gg_curve_data one, other;
  GG_CLI_FREED gg_table *t = gg_cli_table_new();
  if (!t) return;
  gg_cli_table_column(t, "profiles", false);
  for (int a = 0; a < all->n_engines; a++)
    for (int b = a + 1; b < all->n; b++) {
      char head[GG_TABLE_CELL];
      snprintf(head, sizeof head, "%s - %s", all->of[b].name, all->of[a].name);
      gg_cli_table_column(t, head, true);
    }
  for (size_t i = 0; next_profile(all, with_parts, &i, &one) && t->n_rows < GG_TABLE_ROWS;) {
    const int row = gg_cli_table_row(t);
    int column = 1;
    snprintf(gg_cli_table_cell(t, row, 0), GG_TABLE_CELL, "%s", one.name);
    for (int a = 0; a < all->n_engines; a++)
      for (int b = a + 1; b < all->n; b++, column++)
        if (find_alike(&all->of[a], &one, &other))
          put_agreement(&other, &all->of[b], gg_cli_table_cell(t, row, column));
  }
  print(t, 1);
  if (t->n_rows)
    gg_cli_print_paragraph(stdout, 0,
                           "profiles: chi^2/points, largest difference over the largest value, its height; "
                           "theories without layers at walls, 2.5 mean free paths or 2 d");
}

void gg_cli_print_curves(const gg_result *run, const gg_comparison *c, bool all)
{
  const sources from = sources_of(run, c);
  print_numbers(&from, all);
  if (from.n_engines > 0 && from.n > 1) print_profiles(&from, all);
}
