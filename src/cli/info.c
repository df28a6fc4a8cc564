/* graingas info: every key of a scene and what it switches on and off, or what a result file holds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/table.h"

static void print_line(void *context, const char *text)
{
  (void)context;
  printf("  %s\n", text);
}

static void print_engines(const gg_scene *scene)
{
  gg_entry engine;
  gg_error err;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_ENGINES, i, scene, &engine, NULL) == GG_OK; i++) {
    printf("\n%s, %s:\n", engine.name, engine.doc);
    if (gg_scene_describe(scene, engine.name, print_line, NULL, &err) != GG_OK) print_line(NULL, err.message);
  }
}

static void print_fields(const gg_scene *scene)
{
  gg_entry f;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, scene, &f, NULL) == GG_OK; i++)
    printf("%-24s %-22s %-7s  %s%s%s%s\n", f.name, f.value, f.given ? "given" : "default", f.doc, f.unit ? " (" : "",
           f.unit ? f.unit : "", f.unit ? ")" : "");
}

static int inform_scene(const gg_options *o)
{
  gg_error err;
  char *text = NULL;
  gg_scene *scene = NULL;
  gg_status status = gg_options_scene(o, &scene, &err);
  int code = status == GG_OK ? GG_OK : gg_cli_report(&err);
  if (code == GG_OK && gg_scene_check(scene, &err) != GG_OK) code = gg_cli_report_of(o->input, &err);
  if (code == GG_OK && o->json) {
    if (gg_scene_to_json(scene, &text, &err) != GG_OK) code = gg_cli_report(&err);
    gg_cli_print_text(text);
  } else if (code == GG_OK) {
    print_fields(scene);
    print_engines(scene);
  }
  gg_scene_free(scene);
  return code;
}

static const char *const engines[] = {"md", "dsmc"};

/* The means of both engines side by side; what cannot be had is left out. */
static void print_means(const gg_comparison *c)
{
  int column[2] = {-1, -1};
  gg_measurement q, m;
  const gg_result *md = gg_comparison_result(c, "md"), *one = md ? md : gg_comparison_result(c, "dsmc");
  gg_table *t = gg_table_new();
  if (!t) return;
  gg_table_column(t, "quantity", false);
  for (int k = 0; k < 2; k++)
    if (gg_comparison_result(c, engines[k])) column[k] = gg_table_column(t, engines[k], true);
  int unit = gg_table_column(t, "unit", false);
  for (size_t i = 0; gg_result_at(one, i, &q, NULL) == GG_OK; i++) {
    int row = -1;
    for (int k = 0; k < 2; k++) {
      if (gg_result_find(gg_comparison_result(c, engines[k]), q.name, &m, NULL) != GG_OK || isnan(m.mean)) continue;
      if (row < 0) row = gg_table_row(t);
      gg_format_estimate(m.mean, m.error, gg_table_cell(t, row, column[k]), GG_TABLE_CELL);
      snprintf(gg_table_cell(t, row, 0), GG_TABLE_CELL, "%s", m.name);
      snprintf(gg_table_cell(t, row, unit), GG_TABLE_CELL, "%s", m.unit);
    }
  }
  printf("\n");
  gg_table_print(t, stdout, 1000, 1);
  free(t);
}

static void print_verdict(const gg_result *r)
{
  gg_result_info about;
  const char *warning;
  if (gg_result_about(r, &about, NULL) != GG_OK) return;
  printf("\n%s: %s: %s\n", about.engine, about.steady ? "steady" : "not steady", about.verdict);
  for (size_t i = 0; (warning = gg_result_warning(r, i)); i++) printf("  %s\n", warning);
}

static bool has_numbers(const double *x, size_t n)
{
  for (size_t i = 0; i < n; i++)
    if (!isnan(x[i])) return true;
  return false;
}

static void print_series(const gg_result *r)
{
  gg_result_info about;
  gg_entry q;
  bool any = false;
  const double *value;
  size_t n;
  if (gg_result_about(r, &about, NULL) != GG_OK) return;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, NULL, &q, NULL) == GG_OK; i++) {
    if (gg_result_history(r, q.name, &n, NULL, &value, NULL) != GG_OK || !has_numbers(value, n)) continue;
    if (!any)
      printf("  %s series of %zu samples, averaged from %g to %g:", about.engine, n, about.window[0], about.window[1]);
    any = true;
    printf(" %s", q.name);
  }
  if (any) printf("\n");
}

/* Series, frames and theories: what there is to plot or to read with other tools. */
static void print_contents(const gg_comparison *c, const gg_result_info *about)
{
  gg_theory_info theory;
  int n = 0;
  printf("\nalso in the file:\n");
  for (int k = 0; k < 2; k++) print_series(gg_comparison_result(c, engines[k]));
  if (about->frames)
    printf("  %zu frame%s of %ld grains (/particles/grains)\n", about->frames, about->frames > 1 ? "s" : "",
           (long)about->grains);
  for (size_t i = 0; gg_comparison_theory(c, i, &theory, NULL) == GG_OK; i++)
    if (!theory.reason) printf("%s%s", n++ ? ", " : "  theories: ", theory.name);
  if (n) printf("\n");
}

static void print_file(const gg_options *o, const gg_comparison *c)
{
  const gg_result *md = gg_comparison_result(c, "md"), *dsmc = gg_comparison_result(c, "dsmc");
  gg_theory_info theory;
  gg_result_info about;
  char *scene = NULL;
  bool comparison = gg_comparison_theory(c, 0, &theory, NULL) == GG_OK;
  if (gg_result_about(md ? md : dsmc, &about, NULL) != GG_OK) return;
  gg_scene_to_yaml(gg_comparison_scene(c), &scene, NULL);
  printf("%s: %s by graingas %s\ncommand: %s\ndate:    %s\nmachine: %s\n\nscene:\n%s", o->input,
         comparison ? "a comparison" : "a run", about.version, about.command, about.date, about.machine,
         scene ? scene : "");
  free(scene);
  print_means(c);
  print_verdict(md);
  print_verdict(dsmc);
  print_contents(c, &about);
}

static int inform_result(const gg_options *o)
{
  gg_error err;
  char *text = NULL;
  gg_comparison *c = NULL;
  gg_status status = gg_comparison_read(o->input, &c, &err);
  if (status == GG_OK && o->json) status = gg_comparison_to_json(c, &text, &err);
  if (status == GG_OK && o->json) gg_cli_print_text(text);
  if (status == GG_OK && !o->json) print_file(o, c);
  gg_comparison_free(c);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

/* HDF5 files begin with these bytes. */
static bool is_hdf5(const char *path)
{
  char start[8] = "";
  FILE *in = fopen(path, "rb");
  bool yes = in && fread(start, 1, 8, in) == 8 && memcmp(start, "\x89HDF\r\n\x1a\n", 8) == 0;
  if (in) fclose(in);
  return yes;
}

int gg_cli_info_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  int code = gg_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON) code = is_hdf5(o.input) ? inform_result(&o) : inform_scene(&o);
  gg_options_clear(&o);
  return code;
}
