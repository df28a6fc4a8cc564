#include "run/result.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/ensemble_size.h"

void gg_run_result_warn(gg_result *result, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  if (vasprintf(&text, format, args) < 0) text = NULL;
  va_end(args);
  gg_base_string_list_take(&result->warnings, text);
}

void gg_run_result_report_ensemble(gg_result *r)
{
  if (r->model.homogeneous) gg_common_ensemble_size_reason(&r->scene, r->ensemble_text, sizeof r->ensemble_text);
}

bool gg_run_quantity_counts_in_collisions(const gg_model *m)
{
  return !gg_model_keeps_temperature(m);
}

const char *gg_run_correlation_time_unit(const gg_model *m)
{
  return gg_run_quantity_counts_in_collisions(m) ? "collisions a grain" : gg_measure_curve_unit(m, "time");
}

void gg_result_free(gg_result *result)
{
  if (!result) return;
  free(result->history.time);
  for (int k = 0; k < GG_N_HISTORY; k++) free(result->history.value[k]);
  gg_measure_curves_clear(&result->curves);
  gg_run_frame_free(&result->final);
  gg_base_string_list_clear(&result->warnings);
  gg_common_extension_release(result->scene.extension);
  gg_common_extension_release(result->own);
  char *const texts[] = {result->origin.version, result->origin.command, result->origin.machine, result->origin.date,
                         result->origin.document};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) free(texts[i]);
  free(result);
}
