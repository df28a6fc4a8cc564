#include "reproduce/straight.h"

#include <math.h>

bool gg_reproduce_straight_fit(size_t n, const double *x, const double *y, const double *error, gg_straight *line)
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
