/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas info: keys of a scene and their effects; content of a result file or a checkpoint. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/definition.h"
#include "cli/options.h"
#include "cli/print.h"
#include "cli/report.h"

static void print_line(void *context, const char *text)
{
  (void)context;
  gg_cli_print_paragraph(stdout, 4, "  %s", text);
}

static void print_inert(void *context, const char *text)
{
  bool *any = context;
  if (!*any) printf("\nwithout effect:\n");
  *any = true;
  print_line(NULL, text);
}

/* Describe the run on each engine; returns the exit code. */
static int print_engines(const gg_scene *scene)
{
  gg_entry engine;
  gg_error err;
  bool any = false, runs = false;
  gg_scene_warnings(scene, "theory", print_inert, &any, NULL);
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_ENGINES, i, scene, &engine, NULL) == GG_OK; i++) {
    printf("\n%s, %s:\n", engine.name, engine.doc);
    if (gg_scene_describe(scene, engine.name, print_line, NULL, &err) == GG_OK)
      runs = true;
    else
      print_line(NULL, err.message);
  }
  return runs ? GG_OK : gg_cli_report(&err);
}

/* Print a key on one line if it fits, otherwise its meaning below. Without a scene (no origin) also the allowed values.
 */
static void print_field(const gg_entry *f, const char *origin)
{
  char lead[80], meaning[800];
  const int columns = snprintf(lead, sizeof lead, "%-24s %-17s %-7s  ", f->name, f->value, origin);
  snprintf(meaning, sizeof meaning, "%s%s%s%s%s%s", f->doc, f->unit ? " (" : "", f->unit ? f->unit : "",
           f->unit ? ")" : "", *origin ? "" : "; ", *origin ? "" : f->allowed);
  if (strlen(f->value) <= 17 && gg_cli_terminal_width() >= 100 && columns < (int)sizeof lead) {
    gg_cli_print_wrapped(stdout, lead, meaning);
    return;
  }
  snprintf(lead, sizeof lead, "%-24s ", f->name);
  gg_cli_print_paragraph(stdout, 4, "%s%s%s%s\n%s", lead, f->value, *origin ? "  " : "", origin, meaning);
}

/* Print all keys, without a scene with their defaults. */
static void print_fields(const gg_scene *scene)
{
  gg_entry f;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, scene, &f, NULL) == GG_OK; i++)
    print_field(&f, f.given ? "given" : scene ? "default" : "");
}

static int inform_scene(const gg_options *o)
{
  gg_error err;
  char *text = NULL;
  gg_scene *scene = NULL;
  gg_status status = gg_cli_options_scene(o, &scene, &err);
  int code = status == GG_OK ? GG_OK : gg_cli_report(&err);
  if (code == GG_OK && gg_scene_check(scene, &err) != GG_OK) code = gg_cli_report_of(gg_cli_options_name(o), &err);
  if (code == GG_OK && o->json) {
    if (gg_scene_to_json(scene, &text, &err) != GG_OK) code = gg_cli_report(&err);
    gg_cli_print_text(text);
  } else if (code == GG_OK) {
    print_fields(scene);
    printf("\n");
    gg_cli_print_headline(scene);
    code = print_engines(scene);
  }
  gg_scene_free(scene);
  return code;
}

/* Print the means of both engines side by side, without quantities that have none. */
static void print_means(const gg_comparison *c)
{
  int column[2] = {-1, -1};
  gg_measurement q, m;
  const gg_result *md = gg_comparison_result(c, "md"), *one = md ? md : gg_comparison_result(c, "dsmc");
  GG_CLI_FREED gg_table *t = gg_cli_table_new();
  if (!t) return;
  gg_cli_table_column(t, "quantity", false);
  for (int k = 0; k < GG_CLI_ENGINES; k++)
    if (gg_comparison_result(c, gg_cli_engines[k])) column[k] = gg_cli_table_column(t, gg_cli_engines[k], true);
  int unit = gg_cli_table_column(t, "unit", false);
  for (size_t i = 0; gg_result_at(one, i, &q, NULL) == GG_OK; i++) {
    int row = -1;
    for (int k = 0; k < GG_CLI_ENGINES; k++) {
      if (gg_result_find(gg_comparison_result(c, gg_cli_engines[k]), q.name, &m, NULL) != GG_OK || isnan(m.mean))
        continue;
      if (row < 0) row = gg_cli_table_row(t);
      gg_format_estimate(m.mean, m.error, gg_cli_table_cell(t, row, column[k]), GG_TABLE_CELL);
      snprintf(gg_cli_table_cell(t, row, 0), GG_TABLE_CELL, "%s", m.name);
      snprintf(gg_cli_table_cell(t, row, unit), GG_TABLE_CELL, "%s", m.unit);
    }
  }
  printf("\n");
  gg_cli_table_print(t, stdout, 1);
}

static void print_verdict(const gg_result *r)
{
  gg_result_info about;
  const char *warning;
  if (gg_result_get_info(r, &about, NULL) != GG_OK) return;
  printf("\n");
  gg_cli_print_paragraph(stdout, 2, "%s: %s%s", about.engine, gg_cli_steadiness(r), about.verdict);
  for (size_t i = 0; (warning = gg_result_warning(r, i)); i++) print_line(NULL, warning);
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
  const double *value;
  char text[4000] = "";
  size_t n;
  if (gg_result_get_info(r, &about, NULL) != GG_OK) return;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, NULL, &q, NULL) == GG_OK; i++) {
    if (gg_result_history(r, q.name, &n, NULL, &value, NULL) != GG_OK || !has_numbers(value, n)) continue;
    if (!*text)
      gg_cli_append(text, sizeof text, "%s series of %zu samples, averaged from %g to %g:", about.engine, n,
                    about.window[0], about.window[1]);
    gg_cli_append(text, sizeof text, " %s", q.name);
  }
  if (*text) print_line(NULL, text);
}

/* List time series, frames, curves and theories, for plots or other tools. */
static void print_contents(const gg_comparison *c, const gg_result_info *about)
{
  gg_theory_info theory;
  char text[4000] = "";
  printf("\nalso in the file:\n");
  for (int k = 0; k < GG_CLI_ENGINES; k++) print_series(gg_comparison_result(c, gg_cli_engines[k]));
  if (about->frames)
    printf("  %zu frame%s of %ld grains (/particles/grains)\n", about->frames, about->frames > 1 ? "s" : "",
           (long)about->grains);
  for (size_t i = 0; gg_comparison_theory(c, i, &theory, NULL) == GG_OK; i++)
    if (!theory.reason) gg_cli_append(text, sizeof text, "%s%s", *text ? ", " : "theories: ", theory.name);
  if (*text) print_line(NULL, text);
}

static void print_file(const gg_options *o, const gg_comparison *c)
{
  const gg_result *md = gg_comparison_result(c, "md"), *dsmc = gg_comparison_result(c, "dsmc");
  gg_theory_info theory;
  gg_result_info about;
  GG_CLI_FREED char *scene = NULL;
  bool comparison = gg_comparison_theory(c, 0, &theory, NULL) == GG_OK;
  if (gg_result_get_info(md ? md : dsmc, &about, NULL) != GG_OK) { /* a point of a sweep over theories */
    gg_cli_print_theories(c, true);
    return;
  }
  gg_scene_to_yaml(gg_comparison_scene(c), &scene, NULL);
  gg_cli_print_name(stdout, "", o->input, ": ");
  printf("%s by graingas %s\ncommand: %s\ndate:    %s\nmachine: %s\n\nscene:\n%s",
         comparison ? "a comparison" : "a run", about.version, about.command, about.date, about.machine,
         scene ? scene : "");
  print_means(c);
  print_verdict(md);
  print_verdict(dsmc);
  print_contents(c, &about);
}

/* Print the content of a checkpoint; false if the file is not a checkpoint. */
static bool print_checkpoint(const gg_options *o)
{
  gg_checkpoint_info about;
  gg_scene *scene = NULL;
  GG_CLI_FREED char *yaml = NULL;
  if (gg_checkpoint_about(o->input, &about, &scene, NULL) != GG_OK) return false;
  const char *what = strcmp(about.kind, "simulation") == 0 ? "a saved" : "a checkpoint of a";
  gg_cli_print_name(stdout, "", o->input, about.older ? ".1: " : ": ");
  printf("%s %s\n\n", what, about.kind);
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    const gg_checkpoint_part *p = &about.part[k];
    if (!p->engine) continue;
    printf("  %s: %s, after %.0f collisions a grain", p->engine, p->phase, p->collisions_per_grain);
    if (p->averaged > 0) printf(", %.0f of them averaged over", p->averaged);
    if (p->seconds > 0) printf(", %.3g s", p->seconds);
    printf("\n");
  }
  if (about.frames) printf("  %llu frames of its trajectory beside it\n", (unsigned long long)about.frames);
  gg_scene_to_yaml(scene, &yaml, NULL);
  printf("\nscene:\n%s", yaml ? yaml : "");
  gg_scene_free(scene);
  return true;
}

static int inform_result(const gg_options *o)
{
  gg_error err;
  char *text = NULL;
  gg_comparison *c = NULL;
  gg_status status = gg_comparison_read(o->input, &c, &err);
  if (status != GG_OK && !o->json && print_checkpoint(o)) return GG_OK;
  if (status == GG_OK) gg_cli_print_notice(o->input);
  if (status == GG_OK && o->json) status = gg_comparison_to_json(c, &text, &err);
  if (status == GG_OK && o->json) gg_cli_print_text(text);
  if (status == GG_OK && !o->json) print_file(o, c);
  gg_comparison_free(c);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

/* Whether a file is HDF5, by its first bytes or, if these are damaged, by its name. */
static bool is_hdf5(const char *path)
{
  if (gg_cli_has_ending(path, ".h5")) return true;
  char start[8] = "";
  struct stat about;
  if (stat(path, &about) != 0 || !S_ISREG(about.st_mode)) return false; /* a pipe can be read once */
  FILE *in = fopen(path, "rb");
  bool yes = in && fread(start, 1, 8, in) == 8 && memcmp(start, "\x89HDF\r\n\x1a\n", 8) == 0;
  if (in) fclose(in);
  return yes;
}

static int print_schema(const gg_options *o)
{
  gg_error err;
  char *text = NULL;
  if (o->input || o->n_overrides) return gg_cli_fail(GG_BAD_INPUT, "info --schema takes neither a FILE nor --set");
  if (gg_schema_to_json(&text, &err) != GG_OK) return gg_cli_report(&err);
  gg_cli_print_text(text);
  return GG_OK;
}

int gg_cli_info_main(const gg_options *o)
{
  struct stat about;
  const bool is_word = o->input && gg_cli_is_word(o->input) && stat(o->input, &about) != 0;
  if (o->all && !is_word) return gg_cli_fail(GG_BAD_INPUT, "info takes --all only with a WORD");
  if (o->schema) return print_schema(o);
  if (o->input && is_hdf5(o->input)) {
    if (!o->n_overrides) return inform_result(o);
    return gg_cli_fail(GG_BAD_INPUT, "%s: is a result, which --set does not change", o->input);
  }
  if (is_word) {
    if (!o->json && !o->n_overrides) return gg_cli_define(o->input, o->all);
    return gg_cli_fail(GG_BAD_INPUT, "info WORD takes neither --set nor --json; '%s' is no file", o->input);
  }
  if (o->input) return inform_scene(o);
  if (o->json || o->n_overrides) return gg_cli_fail(GG_BAD_INPUT, "info needs a FILE with --set and --json");
  print_fields(NULL);
  return GG_OK;
}
