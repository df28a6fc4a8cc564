/* The numbers read off curves (exponents, contact values, coefficients), printed with their errors. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/report.h"
#include "cli/table.h"
#include "io/text.h"

/* Left to --all: where a fit began, second ways to the same number, what stands among the quantities already. */
static bool is_minor(const char *name)
{
  static const char *const minor[] = {"fit_",       "_likelihood", "kurtosis", "skewness",
                                      "rate_unit",  "knudsen",     "cells",    "solid_fraction",
                                      "_corrected", "_slabs",      "_box",     "second_moment"};
  for (size_t i = 0; i < sizeof minor / sizeof *minor; i++)
    if (strstr(name, minor[i])) return true;
  return false;
}

static const gg_curve_number *find(const gg_result *r, const char *curve, const char *number)
{
  for (int k = 0; r && k < r->curves.n; k++) {
    const gg_curve *c = &r->curves.curve[k];
    if (strcmp(c->name, curve) != 0) continue;
    for (int i = 0; i < c->n_numbers; i++)
      if (strcmp(c->number[i].name, number) == 0) return &c->number[i];
  }
  return NULL;
}

typedef struct listing {
  const gg_result *result[2]; /* either may be missing */
  gg_table *table;
  const char *curve; /* named last */
} listing;

static void put_row(listing *l, const gg_curve *c, const gg_curve_number *number)
{
  const gg_curve_number *by[2];
  if (l->table->n_rows == GG_TABLE_ROWS) return;
  int row = gg_table_row(l->table), column = 2;
  if (l->curve != c->name) snprintf(gg_table_cell(l->table, row, 0), GG_TABLE_CELL, "%s", c->name);
  l->curve = c->name;
  bool pure = strcmp(number->unit, "1") == 0;
  snprintf(gg_table_cell(l->table, row, 1), GG_TABLE_CELL, pure ? "%s" : "%s [%s]", number->name, number->unit);
  for (int k = 0; k < 2; k++) {
    by[k] = find(l->result[k], c->name, number->name);
    if (!l->result[k]) continue;
    if (by[k]) gg_format_estimate(by[k]->value, by[k]->error, gg_table_cell(l->table, row, column), GG_TABLE_CELL);
    column++;
  }
  if (l->result[0] && l->result[1]) {
    bool both = by[0] && by[1] && !number->setting;
    double z = both ? (by[0]->value - by[1]->value) / hypot(by[0]->error, by[1]->error) : NAN;
    if (isfinite(z)) snprintf(gg_table_cell(l->table, row, column), GG_TABLE_CELL, "%+.1f", z);
  }
}

/* Of the first result; and of the second what the first has not. */
static void put_rows(listing *l, int which, bool all)
{
  const gg_result *r = l->result[which], *other = which ? l->result[0] : NULL;
  for (int k = 0; r && k < r->curves.n; k++) {
    const gg_curve *c = &r->curves.curve[k];
    for (int i = 0; i < c->n_numbers; i++) {
      const gg_curve_number *p = &c->number[i];
      if (!isfinite(p->value) || (is_minor(p->name) && !all) || find(other, c->name, p->name)) continue;
      put_row(l, c, p);
    }
  }
}

void gg_print_numbers(const gg_result *one, const gg_result *two, bool all)
{
  listing l = {.result = {one, two}, .table = gg_table_new()};
  if (!l.table) return;
  gg_table_column(l.table, "read off", false);
  gg_table_column(l.table, "", false);
  for (int k = 0; k < 2; k++)
    if (l.result[k]) gg_table_column(l.table, l.result[k]->engine, true);
  if (one && two) gg_table_column(l.table, "z", true);
  for (int k = 0; k < 2; k++) put_rows(&l, k, all);
  if (l.table->n_rows) {
    printf("\n");
    gg_table_print(l.table, stdout, gg_terminal_width(), 2);
    if (l.table->n_rows == GG_TABLE_ROWS) printf("... and more than fit here: see the result file or --json\n");
  }
  free(l.table);
}
