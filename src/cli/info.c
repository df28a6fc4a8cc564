/* graingas info: every key of a scene and what it switches on and off, or what a result file holds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/report.h"
#include "cli/table.h"
#include "common/engine.h"
#include "io/h5/result_reader.h"
#include "io/scene/json.h"
#include "io/text.h"

static void print_line(void *context, const char *text)
{
  (void)context;
  printf("  %s\n", text);
}

static void print_engine(const gg_scene *scene, gg_engine_kind kind)
{
  gg_model model;
  gg_error err = {0};
  const gg_engine_ops *ops = gg_engine_ops_of(kind);
  printf("\n%s, %s:\n", ops->name, ops->doc);
  if (gg_model_make(scene, kind, &model, &err) != GG_OK || ops->accepts(&model, &err) != GG_OK)
    print_line(NULL, err.message);
  else
    ops->describe(&model, print_line, NULL);
}

static void print_fields(const gg_scene_draft *draft)
{
  for (int i = 0; gg_scene_fields[i].key; i++) {
    const gg_field *f = &gg_scene_fields[i];
    json_t *value = gg_field_json(f, &draft->scene, &draft->scene);
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out) {
      gg_print_flow_style(out, value);
      fclose(out);
    }
    json_decref(value);
    printf("%-24s %-22s %-7s  %s%s%s%s\n", f->key, text ? text : "?", draft->given[i] ? "given" : "default", f->doc,
           f->unit ? " (" : "", f->unit ? f->unit : "", f->unit ? ")" : "");
    free(text);
  }
}

static int inform_scene(const gg_options *o)
{
  gg_error err;
  gg_scene_draft draft;
  if (gg_options_scene(o, &draft, &err) != GG_OK) return gg_cli_report(&err);
  if (o->json) {
    gg_cli_print_document(gg_scene_json(&draft.scene));
    return GG_OK;
  }
  print_fields(&draft);
  print_engine(&draft.scene, GG_MD);
  print_engine(&draft.scene, GG_DSMC);
  return GG_OK;
}

static void put_estimate(gg_table *t, int row, int column, const json_t *estimate)
{
  json_t *mean = json_object_get(estimate, "mean"), *error = json_object_get(estimate, "stderr");
  if (json_is_number(mean))
    gg_format_estimate(json_number_value(mean), json_is_number(error) ? json_number_value(error) : NAN,
                       gg_table_cell(t, row, column), GG_TABLE_CELL);
}

/* The means of both engines side by side; what cannot be had is left out. */
static void print_means(const gg_stored_result *stored)
{
  int column[2] = {-1, -1};
  gg_table *t = gg_table_new();
  if (!t) return;
  gg_table_column(t, "quantity", false);
  for (int k = 0; k < 2; k++)
    if (stored->engine[k].name) column[k] = gg_table_column(t, stored->engine[k].name, true);
  int unit = gg_table_column(t, "unit", false);
  for (int q = 0; q < GG_N_QUANTITIES; q++) {
    int row = -1;
    for (int k = 0; k < 2; k++) {
      const json_t *results = column[k] < 0 ? NULL : json_object_get(stored->engine[k].document, "results");
      const json_t *estimate = json_object_get(results, gg_quantity_name((gg_quantity)q));
      if (!json_is_number(json_object_get(estimate, "mean"))) continue;
      if (row < 0) row = gg_table_row(t);
      put_estimate(t, row, column[k], estimate);
      snprintf(gg_table_cell(t, row, 0), GG_TABLE_CELL, "%s", gg_quantity_name((gg_quantity)q));
      snprintf(gg_table_cell(t, row, unit), GG_TABLE_CELL, "%s", json_string_value(json_object_get(estimate, "unit")));
    }
  }
  printf("\n");
  gg_table_print(t, stdout, 1000, 1);
  free(t);
}

static void print_verdict(const gg_stored_engine *e)
{
  const char *verdict = json_string_value(json_object_get(e->document, "verdict"));
  json_t *warning;
  size_t i;
  bool steady = json_is_true(json_object_get(e->document, "steady"));
  printf("\n%s: %s: %s\n", e->name, steady ? "steady" : "not steady", verdict ? verdict : "");
  json_array_foreach(json_object_get(e->document, "warnings"), i, warning) printf("  %s\n", json_string_value(warning));
}

/* Series, frames and theories: what there is to plot or to read with other tools. */
static void print_contents(const gg_stored_result *stored)
{
  const char *name;
  json_t *theory;
  printf("\nalso in the file:\n");
  for (int k = 0; k < 2; k++) {
    const gg_stored_engine *e = &stored->engine[k];
    if (e->n_series)
      printf("  %s series of %zu samples, averaged from %g to %g:", e->name, e->series[0].n, e->window[0],
             e->window[1]);
    for (int i = 0; i < e->n_series; i++) printf(" %s", e->series[i].name);
    if (e->n_series) printf("\n");
  }
  if (stored->n_frames)
    printf("  %zu frame%s of %zu grains (/particles/grains)\n", stored->n_frames, stored->n_frames > 1 ? "s" : "",
           stored->n_grains);
  int n = 0;
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
      printf("%s%s", n++ ? ", " : "  theories: ", name);
  if (n) printf("\n");
}

static int inform_result(const gg_options *o)
{
  gg_error err;
  gg_stored_result stored;
  if (gg_stored_result_read(&stored, o->input, &err) != GG_OK) return gg_cli_report(&err);
  if (o->json) {
    gg_cli_print_document(json_incref(stored.document));
  } else {
    printf("%s: %s by graingas %s\ncommand: %s\ndate:    %s\nmachine: %s\n\nscene:\n%s", o->input,
           stored.comparison ? "a comparison" : "a run", stored.version, stored.command, stored.date, stored.machine,
           stored.scene);
    print_means(&stored);
    for (int k = 0; k < 2; k++)
      if (stored.engine[k].name) print_verdict(&stored.engine[k]);
    print_contents(&stored);
  }
  gg_stored_result_clear(&stored);
  return GG_OK;
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
