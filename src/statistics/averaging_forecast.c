/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/averaging_forecast.h"

#include <math.h>
#include <string.h>

#include "statistics/estimator.h"

/* Relative uncertainty (`doubt`) of an error estimated from the shortest window that is tested; it falls as
 * 1/sqrt(window). The expected end is a weighted mean over estimates that are `off` of these uncertainties too small or
 * too large. If the ends scatter by more than the fraction `vague`, the end counts as unknown. */
static const double doubt = 0.2, off[] = {-1.4, -0.7, 0, 0.7, 1.4}, weight[] = {0.12, 0.22, 0.32, 0.22, 0.12};
static const double vague = 0.5;

void gg_statistics_forecast_open_window(gg_averaging_forecast *o)
{
  *o = (gg_averaging_forecast){0};
}

void gg_statistics_forecast_record(gg_averaging_forecast *o, double window, const gg_window_errors *e)
{
  o->trending = e->trending;
  o->trusted_at = e->trusted ? 0 : fmax(5 * GG_MIN_BLOCKS * e->untrusted, 1.25 * window);
  o->sure_at = e->sure_at;
  if (!(e->relative > 0 && isfinite(e->relative))) return;
  if (o->n_errors == GG_FORECAST_ERRORS) memmove(o->errors, o->errors + 1, --o->n_errors * sizeof *o->errors);
  o->errors[o->n_errors].window = window;
  o->errors[o->n_errors++].log_scale = log(e->relative * sqrt(window));
}

/* ln(error sqrt(window)), averaged over the latest estimates, since errors jump when the limits of blocks move. */
static double log_scale(const gg_averaging_forecast *o)
{
  double sum = 0, weights = 0, now = o->errors[o->n_errors - 1].window;
  for (int i = o->n_errors - 1; i >= 0 && o->errors[i].window >= 0.8 * now; i--)
    sum += o->errors[i].window * o->errors[i].log_scale, weights += o->errors[i].window;
  return sum / weights;
}

/* Predict the outcome of a test: the error falls as 1/sqrt(window), with a margin. */
static gg_window_test test_at(const gg_averaging_forecast *o, const gg_stopping_criteria *criteria, uint64_t window,
                              double doubts)
{
  const double length = (double)window;
  gg_window_test t = {.window = window, .ratio = NAN};
  if (!o->n_errors || !(criteria->relative_error > 0)) return t;
  double ahead = fmax(1 / o->errors[o->n_errors - 1].window - 1 / length, 0);
  double change = doubts * doubt * sqrt((double)criteria->least * ahead);
  t.ratio = exp(log_scale(o) + change) / (criteria->relative_error * sqrt(length));
  bool trusted = length >= o->trusted_at;
  t.exact = trusted && length >= (double)criteria->least && t.ratio <= 1;
  t.sure = trusted && length >= o->sure_at;
  return t;
}

/* Length at which a window ends whose next test is at `window`. */
static double last_test(const gg_averaging_forecast *o, const gg_stopping_criteria *criteria, uint64_t restarts,
                        bool exact, uint64_t window, double doubts)
{
  while (!gg_statistics_rule_ends(criteria, restarts, window)) {
    gg_window_test t = test_at(o, criteria, window, doubts);
    if (gg_statistics_rule_is_met(&t, exact)) break;
    exact = t.exact;
    window = gg_statistics_rule_next_test(criteria, restarts, &t);
  }
  return (double)window;
}

/* Expected number of samples until the window ends; it has `had`. */
static gg_expected_end mean_last_test(const gg_averaging_forecast *o, const gg_stopping_criteria *criteria,
                                      uint64_t restarts, bool exact, uint64_t window, double had)
{
  double mean = 0, square = 0;
  if (!(criteria->relative_error > 0))
    return (gg_expected_end){last_test(o, criteria, restarts, exact, window, 0) - had, true};
  if (!o->n_errors) return (gg_expected_end){NAN, false};
  for (int i = 0; i < 5; i++) {
    double left = last_test(o, criteria, restarts, exact, window, off[i]) - had;
    mean += weight[i] * left, square += weight[i] * left * left;
  }
  return (gg_expected_end){mean, square <= (1 + vague * vague) * mean * mean};
}

gg_expected_end gg_statistics_forecast_end(const gg_averaging_forecast *o, const gg_stopping_criteria *criteria,
                                           const gg_averaging_state *s)
{
  uint64_t restarts = s->restarts, window = s->goal - s->window_at;
  bool anew = s->averaging && o->trending && gg_statistics_rule_restarts(criteria, restarts);
  double begins = (double)(anew ? s->goal : criteria->warmup);
  if (s->averaging && !anew) {
    gg_expected_end end = mean_last_test(o, criteria, restarts, s->exact, window, (double)(s->due - s->window_at));
    return (gg_expected_end){(double)s->due + end.at, end.known};
  }
  window = gg_statistics_rule_next_test(criteria, restarts + anew, NULL);
  gg_expected_end end = mean_last_test(o, criteria, restarts + anew, false, window, 0);
  return (gg_expected_end){begins + end.at, end.known && !anew};
}
