#include "files/export/csv_tables.h"

#include <string.h>

#include "common/engine.h"
#include "files/curve_table.h"

static void put_words(gg_csv *csv, const char *const *words, size_t n)
{
  for (size_t i = 0; i < n; i++) gg_base_csv_text(csv, words[i]);
}

static void put_members(gg_csv *csv, const json_t *object, const char *const *keys, size_t n)
{
  for (size_t i = 0; i < n; i++) gg_base_csv_json(csv, json_object_get(object, keys[i]));
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

void gg_files_csv_results(gg_text_out *out, const gg_stored_result *stored)
{
  static const char *const keys[] = {"mean", "stderr", "unit", "samples", "correlation_time", "correlation_time_unit"};
  gg_csv csv = {.out = out};
  const char *name;
  json_t *one;
  gg_base_csv_text(&csv, "quantity");
  put_words(&csv, keys, COUNT(keys));
  put_words(&csv, (const char *const[]){"steady", "reason"}, 2);
  gg_base_csv_end_row(&csv);
  json_object_foreach(json_object_get(stored->document, "results"), name, one)
  {
    gg_base_csv_text(&csv, name);
    put_members(&csv, one, keys, COUNT(keys));
    gg_base_csv_json(&csv, json_object_get(stored->document, "steady"));
    gg_base_csv_json(&csv, json_object_get(one, "reason"));
    gg_base_csv_end_row(&csv);
  }
}

/* Of an engine in a comparison. */
static const char *const told[] = {"mean", "stderr", "samples", "correlation_time"};

static void put_engine_head(gg_csv *csv, const char *engine)
{
  char text[64];
  for (size_t i = 0; i < COUNT(told); i++) {
    snprintf(text, sizeof text, "%s_%s", engine, told[i]);
    gg_base_csv_text(csv, text);
  }
  snprintf(text, sizeof text, "%s_steady", engine);
  gg_base_csv_text(csv, text);
}

/* Does the theory give an error with any of its numbers? */
static bool has_errors(json_t *theory)
{
  const char *name;
  json_t *one;
  json_object_foreach(theory, name, one) if (json_object_get(one, "error")) return true;
  return false;
}

static void put_comparison_head(gg_csv *csv, const gg_stored_result *stored)
{
  const char *name;
  json_t *theory;
  char text[96];
  put_words(csv, (const char *const[]){"quantity", "unit"}, 2);
  for (int k = 0; k < 2; k++) put_engine_head(csv, gg_run_engine_ops_of((gg_engine_kind)k)->name);
  put_words(csv, (const char *const[]){"correlation_time_unit", "md_dsmc_z", "beyond_expected"}, 3);
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
  {
    gg_base_csv_text(csv, name);
    snprintf(text, sizeof text, "%s_error", name);
    if (has_errors(theory)) gg_base_csv_text(csv, text);
  }
  gg_base_csv_end_row(csv);
}

static const json_t *result_of(const gg_stored_engine *e, const char *quantity)
{
  return e->name ? json_object_get(json_object_get(e->document, "results"), quantity) : NULL;
}

static void put_comparison_row(gg_csv *csv, const gg_stored_result *stored, const json_t *row)
{
  const char *quantity = json_string_value(json_object_get(row, "quantity")), *name;
  const json_t *unit = NULL;
  json_t *theory;
  if (!quantity) return;
  gg_base_csv_text(csv, quantity);
  gg_base_csv_json(csv, json_object_get(row, "unit"));
  for (int k = 0; k < 2; k++) {
    const json_t *one = result_of(&stored->engine[k], quantity);
    put_members(csv, one, told, COUNT(told));
    gg_base_csv_json(csv, one ? json_object_get(stored->engine[k].document, "steady") : NULL);
    if (one) unit = json_object_get(one, "correlation_time_unit");
  }
  gg_base_csv_json(csv, unit);
  put_members(csv, row, (const char *const[]){"md_dsmc_z", "beyond_expected"}, 2);
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
  {
    const json_t *said = json_object_get(theory, quantity);
    gg_base_csv_json(csv, json_object_get(said, "mean"));
    if (has_errors(theory)) gg_base_csv_json(csv, json_object_get(said, "error"));
  }
  gg_base_csv_end_row(csv);
}

void gg_files_csv_comparison(gg_text_out *out, const gg_stored_result *stored)
{
  gg_csv csv = {.out = out};
  size_t i;
  json_t *row;
  put_comparison_head(&csv, stored);
  json_array_foreach(json_object_get(stored->document, "comparison"), i, row) put_comparison_row(&csv, stored, row);
}

static const char *text_of(const json_t *object, const char *key)
{
  const char *text = json_string_value(json_object_get(object, key));
  return text ? text : "";
}

void gg_files_csv_curve(gg_text_out *out, const json_t *curve)
{
  gg_csv csv = {.out = out};
  const json_t *law = json_object_get(curve, "reference");
  const char *unit = text_of(curve, "unit");
  gg_base_csv_head(&csv, text_of(curve, "x_name"), text_of(curve, "x_unit"));
  gg_base_csv_head(&csv, text_of(curve, "y_name"), unit);
  gg_base_csv_head(&csv, "stderr", unit);
  if (law) gg_base_csv_head(&csv, text_of(law, "label"), unit);
  gg_base_csv_end_row(&csv);
  for (size_t i = 0; i < json_array_size(json_object_get(curve, "x")); i++) {
    gg_base_csv_json(&csv, json_array_get(json_object_get(curve, "x"), i));
    gg_base_csv_json(&csv, json_array_get(json_object_get(curve, "value"), i));
    gg_base_csv_json(&csv, json_array_get(json_object_get(curve, "stderr"), i));
    if (law) gg_base_csv_json(&csv, json_array_get(json_object_get(law, "value"), i));
    gg_base_csv_end_row(&csv);
  }
}

static bool put_numbers_of(gg_csv *csv, const char *whose, json_t *curves)
{
  static const char *const keys[] = {"mean", "stderr", "unit"};
  const char *curve, *number;
  json_t *of, *one;
  bool any = false;
  json_object_foreach(curves, curve, of)
  {
    json_object_foreach(json_object_get(of, "numbers"), number, one)
    {
      any = true;
      if (!csv->out) return true;
      put_words(csv, (const char *const[]){whose, text_of(of, "group"), curve, number}, 4);
      put_members(csv, one, keys, COUNT(keys));
      gg_base_csv_end_row(csv);
    }
  }
  return any;
}

bool gg_files_csv_numbers(gg_text_out *out, const gg_stored_result *stored)
{
  static const char *const head[] = {"engine", "observable", "curve", "number", "mean", "stderr", "unit"};
  gg_csv csv = {.out = out};
  const char *theory;
  json_t *curves;
  bool any = false;
  if (out) {
    put_words(&csv, head, COUNT(head));
    gg_base_csv_end_row(&csv);
  }
  for (int k = 0; k < 2; k++)
    if (stored->engine[k].name)
      any |= put_numbers_of(&csv, stored->engine[k].name, json_object_get(stored->engine[k].document, "curves"));
  json_object_foreach(json_object_get(stored->document, GG_THEORY_CURVES), theory, curves) any |=
      put_numbers_of(&csv, theory, curves);
  return any;
}
