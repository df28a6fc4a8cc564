#include "run/result.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/ensemble_size.h"

void gg_result_warn(gg_result *result, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  if (vasprintf(&text, format, args) < 0) text = NULL;
  va_end(args);
  gg_text_list_take(&result->warnings, text);
}

void gg_result_tell_ensemble(gg_result *r)
{
  if (r->model.homogeneous) gg_ensemble_reason(&r->scene, r->ensemble_text, sizeof r->ensemble_text);
}

bool gg_counts_in_collisions(const gg_model *m)
{
  return !gg_model_keeps_temperature(m);
}

const char *gg_correlation_time_unit(const gg_model *m)
{
  return gg_counts_in_collisions(m) ? "collisions a grain" : gg_curve_unit(m, "time");
}

void gg_result_free(gg_result *result)
{
  if (!result) return;
  free(result->history.time);
  for (int k = 0; k < GG_N_HISTORY; k++) free(result->history.value[k]);
  gg_curves_clear(&result->curves);
  gg_frame_free(&result->final);
  gg_text_list_clear(&result->warnings);
  gg_extension_release(result->scene.extension);
  gg_extension_release(result->own);
  char *const texts[] = {result->origin.version, result->origin.command, result->origin.machine, result->origin.date,
                         result->origin.document};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) free(texts[i]);
  free(result);
}
