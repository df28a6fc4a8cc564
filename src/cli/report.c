/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Report of a run, and the parts of reports that runs and comparisons share. */
#include "cli/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/definition.h"
#include "cli/print.h"

static bool has_part(const char *name, const char *const *parts)
{
  for (; *parts; parts++)
    if (strstr(name, *parts)) return true;
  return false;
}

void gg_cli_print_head(const gg_scene *scene)
{
  char title[240] = "";
  gg_scene_title(scene, title, sizeof title, NULL);
  printf("\n");
  gg_cli_print_paragraph(stdout, 2, "%s", title);
  printf("\n");
}

/* "; 2.1 M collisions averaged over in 3.2 s of processor time (0.65 M/s)"; empty if the run ended before averaging. */
static void describe_averaging(const gg_result_info *a, char *text, size_t size)
{
  char collisions[24], rate[24], seconds[24], pace[40] = "";
  *text = '\0';
  if (a->collisions == 0) return;
  gg_cli_format_count((double)a->collisions, collisions, sizeof collisions);
  gg_cli_format_count((double)a->collisions / a->cpu_seconds, rate, sizeof rate);
  gg_cli_format_duration(a->cpu_seconds, seconds, sizeof seconds);
  if (a->cpu_seconds > 0) snprintf(pace, sizeof pace, " (%s/s)", rate);
  snprintf(text, size, "; %s collisions averaged over in %s of processor time%s", collisions, seconds, pace);
}

bool gg_cli_is_followed(const gg_scene *scene)
{
  char duration[40] = "none";
  gg_scene_get(scene, "run.duration", duration, sizeof duration, NULL);
  return strcmp(duration, "none") != 0;
}

const char *gg_cli_steadiness(const gg_result *r)
{
  gg_result_info about;
  if (gg_cli_is_followed(gg_result_scene(r)) || gg_result_get_info(r, &about, NULL) != GG_OK) return "";
  return about.metastable ? "metastable: " : about.steady ? "steady: " : "not steady: ";
}

/* Print "md    1000 grains; 2.1 M collisions averaged over in ..." and the verdict. */
void gg_cli_print_effort(const gg_result *r)
{
  char averaged[160];
  gg_result_info a;
  if (gg_result_get_info(r, &a, NULL) != GG_OK) return;
  describe_averaging(&a, averaged, sizeof averaged);
  gg_cli_print_paragraph(stdout, 6, "%-5s %ld grains%s%s%s\n%s%s", a.engine, (long)a.grains,
                         a.grains_chosen ? ", " : "", a.grains_chosen ? a.grains_chosen : "", averaged,
                         gg_cli_steadiness(r), a.verdict);
}

void gg_cli_print_warnings(const gg_result *r, const char *reported)
{
  gg_result_info about;
  const char *warning;
  if (gg_result_get_info(r, &about, NULL) != GG_OK) return;
  fflush(stdout);
  for (size_t i = 0; (warning = gg_result_warning(r, i)); i++)
    if (!reported || !strstr(reported, warning)) fprintf(stderr, "warning: %s: %s\n", about.engine, warning);
}

/* Numbers that only --all prints: starts of fits, alternative estimates, numbers that are also quantities. */
static const char *const minor_numbers[] = {
    "fit_",  "_likelihood", "kurtosis",       "skewness",   "rate_unit", "_2_4.5",        "_3.3_5.5",       "knudsen",
    "cells", "_slabs",      "solid_fraction", "_corrected", "_box",      "second_moment", "long_time_tail", NULL};

typedef struct listing {
  const gg_result *result[2]; /* either may be NULL */
  gg_table *table;
  char curve[64]; /* name of the last printed curve */
} listing;

/* Find a number of a curve by both names. */
static bool find_number(const gg_result *r, const char *curve, const char *name, gg_measurement *found)
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
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    there[k] = find_number(l->result[k], curve, number->name, &by[k]);
    if (!l->result[k]) continue;
    if (there[k]) gg_format_estimate(by[k].mean, by[k].error, gg_cli_table_cell(l->table, row, column), GG_TABLE_CELL);
    column++;
  }
  if (!there[0] || !there[1]) return;
  double error = hypot(by[0].error, by[1].error), z = (by[0].mean - by[1].mean) / error; /* settings have no error */
  if (error > 0 && isfinite(z)) snprintf(gg_cli_table_cell(l->table, row, column), GG_TABLE_CELL, "%+.1f", z);
}

/* Add the rows of the first result, then the rows that only the second has. */
static void put_rows(listing *l, int which, bool all)
{
  const gg_result *r = l->result[which], *other = which ? l->result[0] : NULL;
  gg_curve_data c;
  gg_measurement p, elsewhere;
  for (size_t i = 0; r && gg_result_curve(r, i, &c, NULL) == GG_OK; i++)
    for (size_t k = 0; gg_result_curve_number(r, i, k, &p, NULL) == GG_OK; k++)
      if (isfinite(p.mean) && (all || !has_part(p.name, minor_numbers)) &&
          !find_number(other, c.name, p.name, &elsewhere))
        put_row(l, c.name, &p);
}

void gg_cli_print_numbers(const gg_result *one, const gg_result *two, bool all)
{
  listing l = {.result = {one, two}, .table = gg_cli_table_new()};
  gg_result_info about;
  if (!l.table) return;
  gg_cli_table_column(l.table, "read off", false);
  gg_cli_table_column(l.table, "", false);
  for (int k = 0; k < GG_CLI_ENGINES; k++)
    if (gg_result_get_info(l.result[k], &about, NULL) == GG_OK) gg_cli_table_column(l.table, about.engine, true);
  if (one && two) gg_cli_table_column(l.table, "z", true);
  for (int k = 0; k < GG_CLI_ENGINES; k++) put_rows(&l, k, all);
  if (l.table->n_rows) {
    printf("\n");
    gg_cli_table_print(l.table, stdout, 2);
    if (l.table->n_rows == GG_TABLE_ROWS) printf("... and more than fit here: see the result file or --json\n");
  }
  free(l.table);
}

static gg_table *tabulate(const gg_result *r, bool all)
{
  gg_result_info about;
  gg_measurement m;
  gg_table *t = gg_cli_table_new();
  if (!t || gg_result_get_info(r, &about, NULL) != GG_OK) return t;
  gg_cli_table_column(t, "quantity", false);
  gg_cli_table_column(t, about.engine, true);
  gg_cli_table_column(t, "unit", false);
  gg_cli_table_column(t, "samples", true);
  for (size_t i = 0; gg_result_at(r, i, &m, NULL) == GG_OK; i++) {
    if (isnan(m.mean) || (gg_cli_quantity_is_minor(m.name) && !all)) continue;
    int row = gg_cli_table_row(t);
    snprintf(gg_cli_table_cell(t, row, 0), GG_TABLE_CELL, "%s", m.name);
    gg_format_estimate(m.mean, m.error, gg_cli_table_cell(t, row, 1), GG_TABLE_CELL);
    snprintf(gg_cli_table_cell(t, row, 2), GG_TABLE_CELL, "%s", m.unit);
    snprintf(gg_cli_table_cell(t, row, 3), GG_TABLE_CELL, "%lu", (unsigned long)m.samples);
  }
  return t;
}

void gg_cli_print_run(const gg_result *r, const char *reported, bool all)
{
  gg_table *t = tabulate(r, all);
  if (!t) return;
  gg_cli_print_head(gg_result_scene(r));
  if (t->n_rows) {
    gg_cli_table_print(t, stdout, 1);
    gg_cli_print_headline(gg_result_scene(r));
  }
  free(t);
  gg_cli_print_numbers(r, NULL, all);
  printf("\n");
  gg_cli_print_effort(r);
  gg_cli_print_warnings(r, reported);
}
