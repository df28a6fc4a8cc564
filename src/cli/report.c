/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Report of a run, and the parts of reports that runs and comparisons share. */
#include "cli/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/definition.h"
#include "cli/print.h"

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
  GG_CLI_FREED gg_table *t = tabulate(r, all);
  if (!t) return;
  gg_cli_print_head(gg_result_scene(r));
  if (t->n_rows) {
    gg_cli_table_print(t, stdout, 1);
    gg_cli_print_headline(gg_result_scene(r));
  }
  gg_cli_print_curves(r, NULL, all);
  printf("\n");
  gg_cli_print_effort(r);
  gg_cli_print_warnings(r, reported);
}
