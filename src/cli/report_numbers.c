/* The numbers read off curves (exponents, contact values, coefficients), printed with their errors. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/report.h"
#include "cli/table.h"

/* Left to --all: where a fit began, second ways to the same number, what stands among the quantities already. */
static bool is_minor(const char *name)
{
  static const char *const minor[] = {"fit_",       "_likelihood", "kurtosis", "skewness",      "rate_unit",
                                      "_2_4.5",     "_3.3_5.5",    "knudsen",  "cells",         "solid_fraction",
                                      "_corrected", "_slabs",      "_box",     "second_moment", "long_time_tail"};
  for (size_t i = 0; i < sizeof minor / sizeof *minor; i++)
    if (strstr(name, minor[i])) return true;
  return false;
}

typedef struct listing {
  const gg_result *result[2]; /* either may be missing */
  gg_table *table;
  char curve[64]; /* named last */
} listing;

/* The number of that name on the curve of that name. */
static bool find(const gg_result *r, const char *curve, const char *name, gg_measurement *found)
{
  gg_curve_data c;
  for (size_t i = 0; r && gg_result_curve(r, i, &c, NULL) == GG_OK; i++) {
    if (strcmp(c.name, curve) != 0) continue;
    for (size_t k = 0; gg_result_curve_number(r, i, k, found, NULL) == GG_OK; k++)
      if (strcmp(found->name, name) == 0) return true;
  }
  return false;
}

static void put_row(listing *l, const char *curve, const gg_measurement *number)
{
  gg_measurement by[2];
  bool there[2];
  if (l->table->n_rows == GG_TABLE_ROWS) return;
  int row = gg_cli_table_row(l->table), column = 2;
  if (strcmp(l->curve, curve) != 0) snprintf(gg_cli_table_cell(l->table, row, 0), GG_TABLE_CELL, "%s", curve);
  snprintf(l->curve, sizeof l->curve, "%s", curve);
  bool pure = strcmp(number->unit, "1") == 0;
  snprintf(gg_cli_table_cell(l->table, row, 1), GG_TABLE_CELL, pure ? "%s" : "%s [%s]", number->name, number->unit);
  for (int k = 0; k < 2; k++) {
    there[k] = find(l->result[k], curve, number->name, &by[k]);
    if (!l->result[k]) continue;
    if (there[k]) gg_format_estimate(by[k].mean, by[k].error, gg_cli_table_cell(l->table, row, column), GG_TABLE_CELL);
    column++;
  }
  if (!there[0] || !there[1]) return;
  double error = hypot(by[0].error, by[1].error), z = (by[0].mean - by[1].mean) / error; /* a setting has no error */
  if (error > 0 && isfinite(z)) snprintf(gg_cli_table_cell(l->table, row, column), GG_TABLE_CELL, "%+.1f", z);
}

/* Of the first result; and of the second what the first has not. */
static void put_rows(listing *l, int which, bool all)
{
  const gg_result *r = l->result[which], *other = which ? l->result[0] : NULL;
  gg_curve_data c;
  gg_measurement p, elsewhere;
  for (size_t i = 0; r && gg_result_curve(r, i, &c, NULL) == GG_OK; i++)
    for (size_t k = 0; gg_result_curve_number(r, i, k, &p, NULL) == GG_OK; k++)
      if (isfinite(p.mean) && (all || !is_minor(p.name)) && !find(other, c.name, p.name, &elsewhere))
        put_row(l, c.name, &p);
}

void gg_cli_print_numbers(const gg_result *one, const gg_result *two, bool all)
{
  listing l = {.result = {one, two}, .table = gg_cli_table_new()};
  gg_result_info about;
  if (!l.table) return;
  gg_cli_table_column(l.table, "read off", false);
  gg_cli_table_column(l.table, "", false);
  for (int k = 0; k < 2; k++)
    if (gg_result_get_info(l.result[k], &about, NULL) == GG_OK) gg_cli_table_column(l.table, about.engine, true);
  if (one && two) gg_cli_table_column(l.table, "z", true);
  for (int k = 0; k < 2; k++) put_rows(&l, k, all);
  if (l.table->n_rows) {
    printf("\n");
    gg_cli_table_print(l.table, stdout, 2);
    if (l.table->n_rows == GG_TABLE_ROWS) printf("... and more than fit here: see the result file or --json\n");
  }
  free(l.table);
}
