/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles across the channel, both engines side by side: a row for each profile; with `all` a table of every slab. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/print.h"
#include "cli/report.h"

/* The same profile of both results. */
typedef struct pair {
  gg_curve_data one, two;
} pair;

/* Whether the heights agree to a hundredth of a slab. */
static bool is_alike(const gg_curve_data *a, const gg_curve_data *b)
{
  bool alike = a->n == b->n;
  for (size_t i = 0; alike && i < a->n; i++)
    alike = fabs(a->x[i] - b->x[i]) <= 1e-2 * fabs(a->x[a->n - 1] - a->x[0]) / (double)a->n;
  return alike;
}

static bool find(const gg_result *r, const gg_curve_data *like, gg_curve_data *found)
{
  for (size_t i = 0; gg_result_curve(r, i, found, NULL) == GG_OK; i++)
    if (strcmp(found->name, like->name) == 0) return is_alike(found, like);
  return false;
}

static bool is_part(const char *name)
{
  return strstr(name, "_kinetic") || strstr(name, "_collisional");
}

/* The next profile that both results have, from curve *i on. */
static bool next_pair(const gg_result *one, const gg_result *two, bool all, size_t *i, pair *p)
{
  while (gg_result_curve(one, (*i)++, &p->one, NULL) == GG_OK)
    if (strncmp(p->one.name, "profile_", 8) == 0 && (all || !is_part(p->one.name)) && find(two, &p->one, &p->two))
      return true;
  return false;
}

static double z_of(const pair *p, size_t i)
{
  const double error = hypot(p->one.error[i], p->two.error[i]);
  return error > 0 ? (p->one.value[i] - p->two.value[i]) / error : NAN;
}

static void put_profile(gg_table *t, const pair *p)
{
  double squares = 0, most = 0, at = 0;
  int n = 0;
  for (size_t i = 0; i < p->one.n; i++) {
    const double z = z_of(p, i);
    if (!isfinite(z)) continue;
    squares += z * z, n++;
    if (fabs(z) > fabs(most)) most = z, at = p->one.x[i];
  }
  if (n == 0) return;
  const int row = gg_cli_table_row(t);
  snprintf(gg_cli_table_cell(t, row, 0), GG_TABLE_CELL, "%s", p->one.name);
  snprintf(gg_cli_table_cell(t, row, 1), GG_TABLE_CELL, "%d", n);
  snprintf(gg_cli_table_cell(t, row, 2), GG_TABLE_CELL, "%.2f", squares / n);
  snprintf(gg_cli_table_cell(t, row, 3), GG_TABLE_CELL, "%+.1f", most);
  snprintf(gg_cli_table_cell(t, row, 4), GG_TABLE_CELL, "%.3g", at);
}

static void print(gg_table *t)
{
  if (t && t->n_rows) {
    printf("\n");
    gg_cli_table_print(t, stdout, 1);
  }
  free(t);
}

static void print_slabs(const pair *p)
{
  gg_table *t = gg_cli_table_new();
  if (!t) return;
  gg_cli_table_column(t, p->one.x_name, true);
  const int md = gg_cli_table_column(t, p->one.name, true), dsmc = gg_cli_table_column(t, "dsmc", true),
            z = gg_cli_table_column(t, "z", true);
  for (size_t i = 0; i < p->one.n && t->n_rows < GG_TABLE_ROWS; i++) {
    const int row = gg_cli_table_row(t);
    snprintf(gg_cli_table_cell(t, row, 0), GG_TABLE_CELL, "%.4g", p->one.x[i]);
    if (isfinite(p->one.value[i]))
      gg_format_estimate(p->one.value[i], p->one.error[i], gg_cli_table_cell(t, row, md), GG_TABLE_CELL);
    if (isfinite(p->two.value[i]))
      gg_format_estimate(p->two.value[i], p->two.error[i], gg_cli_table_cell(t, row, dsmc), GG_TABLE_CELL);
    if (isfinite(z_of(p, i))) snprintf(gg_cli_table_cell(t, row, z), GG_TABLE_CELL, "%+.1f", z_of(p, i));
  }
  print(t);
}

void gg_cli_print_profiles(const gg_result *md, const gg_result *dsmc, bool all)
{
  static const char *const heads[] = {"profiles, md and dsmc", "points", "chi^2/points", "largest z", "at y"};
  pair p;
  gg_table *t = gg_cli_table_new();
  if (!t) return;
  for (int k = 0; k < 5; k++) gg_cli_table_column(t, heads[k], k > 0);
  for (size_t i = 0; next_pair(md, dsmc, all, &i, &p) && t->n_rows < GG_TABLE_ROWS;) put_profile(t, &p);
  print(t);
  for (size_t i = 0; all && next_pair(md, dsmc, false, &i, &p);) print_slabs(&p);
}
