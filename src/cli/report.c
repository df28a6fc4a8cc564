/* One engine's result, and what is said of each engine below a table. */
#include "cli/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/number_format.h"
#include "cli/table.h"
#include "cli/wrap.h"

bool gg_cli_quantity_is_minor(const char *name)
{
  if (strcmp(name, "viscosity_reduced_kinetic") == 0) return false;
  static const char *const minor[] = {"_kinetic", "_collisional", "P_yx",       "kurtosis",
                                      "skewness", "knudsen",      "dissipation"};
  for (size_t i = 0; i < sizeof minor / sizeof *minor; i++)
    if (strstr(name, minor[i])) return true;
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

/* "md    1000 grains, 2.1 M collisions averaged over in 3.2 s (0.65 M/s); no trend over ..." */
void gg_cli_print_effort(const gg_result *r)
{
  char collisions[24], rate[24], seconds[24], pace[40] = "";
  gg_result_info a;
  if (gg_result_get_info(r, &a, NULL) != GG_OK) return;
  gg_cli_format_count((double)a.collisions, collisions, sizeof collisions);
  gg_cli_format_count((double)a.collisions / a.cpu_seconds, rate, sizeof rate);
  gg_cli_format_duration(a.cpu_seconds, seconds, sizeof seconds);
  if (a.cpu_seconds > 0) snprintf(pace, sizeof pace, " (%s/s)", rate);
  gg_cli_print_paragraph(stdout, 6,
                         "%-5s %ld grains%s%s; %s collisions averaged over in %s of processor time%s\n%s: %s", a.engine,
                         (long)a.grains, a.grains_chosen ? ", " : "", a.grains_chosen ? a.grains_chosen : "",
                         collisions, seconds, pace, a.steady ? "steady" : "not steady", a.verdict);
}

void gg_cli_print_warnings(const gg_result *r, const char *told)
{
  gg_result_info about;
  const char *warning;
  if (gg_result_get_info(r, &about, NULL) != GG_OK) return;
  fflush(stdout);
  for (size_t i = 0; (warning = gg_result_warning(r, i)); i++)
    if (!told || !strstr(told, warning)) fprintf(stderr, "warning: %s: %s\n", about.engine, warning);
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

void gg_cli_print_run(const gg_result *r, const char *told, bool all)
{
  gg_table *t = tabulate(r, all);
  if (!t) return;
  gg_cli_print_head(gg_result_scene(r));
  gg_cli_table_print(t, stdout, 1);
  free(t);
  gg_cli_print_numbers(r, NULL, all);
  printf("\n");
  gg_cli_print_effort(r);
  gg_cli_print_warnings(r, told);
}
