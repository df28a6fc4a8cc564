#include "reproduce/tail.h"

#include <math.h>

bool gg_straight_fit(size_t n, const double *x, const double *y, const double *error, gg_straight *line)
{
  double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  size_t used = 0;
  for (size_t i = 0; i < n; i++) {
    double w = 1 / (error[i] * error[i]);
    if (!isfinite(x[i]) || !isfinite(y[i]) || !isfinite(w)) continue;
    s += w, sx += w * x[i], sy += w * y[i], sxx += w * x[i] * x[i], sxy += w * x[i] * y[i];
    used++;
  }
  double d = s * sxx - sx * sx;
  if (used < 2 || !(d > 0)) return false;
  line->b = (s * sxy - sx * sy) / d;
  line->a = (sy - line->b * sx) / s;
  line->a_error = sqrt(sxx / d);
  line->b_error = sqrt(s / d);
  return true;
}

static double item(const json_t *curve, const char *key, size_t i)
{
  const json_t *x = json_array_get(json_object_get(curve, key), i);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

enum { MOST_BINS = 512 };

gg_told gg_tail_fit(const json_t *curve, const double range[2], bool alpha)
{
  double x[MOST_BINS], y[MOST_BINS], e[MOST_BINS];
  size_t n = 0, bins = json_array_size(json_object_get(curve, "x"));
  for (size_t i = 0; i < bins && n < MOST_BINS; i++) {
    double at = fabs(item(curve, "x", i)), p = item(curve, "value", i), error = item(curve, "stderr", i);
    if (at < range[0] || at > range[1] || !(p > 0 && p < 1) || !(error > 0 && error < p)) continue;
    x[n] = log(at), y[n] = log(-log(p)), e[n++] = error / (p * -log(p));
  }
  gg_straight line;
  if (n < 3 || !gg_straight_fit(n, x, y, e, &line)) return GG_NO_VALUE;
  if (alpha) return (gg_told){line.b, line.b_error, "1"};
  return (gg_told){exp(line.a), exp(line.a) * line.a_error, "1"};
}
