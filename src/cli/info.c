/* graingas info: every key of a scene and what it switches on and off, or what a result file holds. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/report.h"
#include "common/engine.h"
#include "io/result_reader.h"
#include "io/scene_json.h"
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

static double number(const json_t *object, const char *key)
{
  return json_number_value(json_object_get(object, key));
}

static void print_results(const gg_stored_engine *e)
{
  const char *name, *verdict = json_string_value(json_object_get(e->document, "verdict"));
  json_t *estimate, *warning;
  size_t i;
  printf("\n%s: %s\n", e->name, verdict ? verdict : "");
  json_object_foreach(json_object_get(e->document, "results"), name, estimate)
  {
    char text[64] = "cannot be had";
    json_t *mean = json_object_get(estimate, "mean");
    if (json_is_number(mean))
      gg_format_estimate(json_number_value(mean), number(estimate, "stderr"), text, sizeof text);
    printf("  %-26s %-22s %s\n", name, text, json_string_value(json_object_get(estimate, "unit")));
  }
  json_array_foreach(json_object_get(e->document, "warnings"), i, warning)
      printf("  warning: %s\n", json_string_value(warning));
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
    for (int k = 0; k < 2; k++)
      if (stored.engine[k].name) print_results(&stored.engine[k]);
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
