/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories between the points of a sweep: a sweep of theories over the same axis, for the lines of a picture. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sweep/sweep_table.h"

enum { LINE_POINTS = 25 };

double gg_sweep_axis_value(const gg_sweep *sweep, size_t point, const gg_picture_axis *a)
{
  const gg_varied *v = &sweep->varied[a->varied];
  const char *text = v->value[gg_sweep_row(sweep, point, a->varied) * v->n_keys + a->k];
  char *end;
  double x = strtod(text, &end);
  return *end || end == text || !isfinite(x) ? NAN : x;
}

/* Ends of the values of the axis, on a logarithmic axis of those above 0; false if there is nothing between them. */
static bool find_ends(const gg_sweep *s, const gg_picture_axis *a, double end[2])
{
  end[0] = INFINITY, end[1] = -INFINITY;
  for (size_t i = 0; i < s->n; i++) {
    const double x = gg_sweep_axis_value(s, i, a);
    if (a->log && !(x > 0)) continue;
    end[0] = fmin(end[0], x), end[1] = fmax(end[1], x);
  }
  return end[0] < end[1];
}

/* Values in even steps, on a logarithmic axis in equal ratios. Keys beside that of the axis have one value each. */
static bool fill_values(gg_varied *to, const gg_varied *from, const gg_picture_axis *a, const double end[2])
{
  char text[32];
  const double step = (a->log ? log(end[1] / end[0]) : end[1] - end[0]) / (LINE_POINTS - 1);
  bool whole = true;
  for (size_t i = 0; i < to->n; i++) {
    const double along = (double)i * step;
    snprintf(text, sizeof text, "%.9g", a->log ? end[0] * exp(along) : end[0] + along);
    for (size_t k = 0; k < to->n_keys; k++) {
      char **value = &to->value[i * to->n_keys + k];
      whole &= (*value = strdup(k == a->k ? text : from->value[k])) != NULL;
    }
  }
  return whole;
}

void gg_sweep_lines_free(gg_sweep *lines, const gg_picture_axis *a)
{
  if (!lines) return;
  gg_varied *v = &lines->varied[a->varied];
  for (size_t i = 0; v->value && i < v->n * v->n_keys; i++) free(v->value[i]);
  free(v->value);
  free(lines->point);
  free(lines);
}

/* No lines over a key of whole numbers: there are no values between them, and theories do not depend on such keys. */
gg_status gg_sweep_lines_make(const gg_sweep *sweep, const gg_picture_axis *a, gg_sweep **made, gg_error *err)
{
  double end[2];
  gg_error none;
  *made = NULL;
  if (!a->alone || sweep->settings.does == GG_DOES_RUN || !find_ends(sweep, a, end)) return GG_OK;
  gg_sweep *lines = gg_base_array_new(1, sizeof *lines, err);
  if (!lines) return GG_FAILED;
  memcpy(lines, sweep, sizeof *lines);
  gg_base_busy_init(&lines->busy, "sweep", NULL, lines);
  lines->settings.does = GG_DOES_THEORY;
  lines->n = 0, lines->point = NULL;
  gg_varied *v = &lines->varied[a->varied];
  v->n = LINE_POINTS;
  v->value = gg_base_array_new(v->n * v->n_keys, sizeof *v->value, err);
  const bool whole = v->value && fill_values(v, &sweep->varied[a->varied], a, end);
  if (whole && gg_sweep_check_points(lines, &none) == GG_OK) {
    *made = lines;
    return GG_OK;
  }
  gg_sweep_lines_free(lines, a);
  return whole ? GG_OK : gg_base_out_of_memory(err);
}
