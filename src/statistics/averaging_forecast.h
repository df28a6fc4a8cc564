/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When averaging will end: by the stopping rule, at a test of the window. The errors so far predict which test,
 * assuming that they fall as 1/sqrt(window). */
#ifndef GG_AVERAGING_FORECAST_H
#define GG_AVERAGING_FORECAST_H

#include "statistics/stopping_rule.h"

enum { GG_FORECAST_ERRORS = 32 };

typedef struct gg_averaging_forecast {
  int n_errors; /* of the present window; the latest of them */
  struct {
    double window, log_scale; /* samples; ln(error sqrt(window)) */
  } errors[GG_FORECAST_ERRORS];
  bool trending;     /* by the latest errors: the window would be given up for a trend */
  double trusted_at; /* samples that the window needs before its error can be trusted */
  double sure_at;    /* and before it is sure */
} gg_averaging_forecast;

/* Errors of the means of a window, as far as they are known. */
typedef struct gg_window_errors {
  double relative;  /* error of the worst, as in the criteria; NaN: not known */
  double untrusted; /* longest correlation time of those that are not trusted, in samples */
  double sure_at;   /* samples from which on they are sure */
  bool trusted;     /* all are */
  bool trending;
} gg_window_errors;

/* Averaging starts or restarts. */
void gg_statistics_forecast_open_window(gg_averaging_forecast *forecast);
void gg_statistics_forecast_record(gg_averaging_forecast *forecast, double window, const gg_window_errors *errors);

/* How far a run is, in samples of each replica. */
typedef struct gg_averaging_state {
  bool averaging, exact;                   /* not warming up; at the last test, errors were as small as requested */
  uint64_t due, window_at, goal, restarts; /* samples taken; where the window was opened, and is tested next; windows
                                              given up for a trend */
} gg_averaging_state;

/* When the run ends, in samples of each replica; a rough guess, or NaN, where that is not known yet: errors are not, or
 * the window may be given up for a trend. */
typedef struct gg_expected_end {
  double at;
  bool known;
} gg_expected_end;
gg_expected_end gg_statistics_forecast_end(const gg_averaging_forecast *forecast, const gg_stopping_criteria *criteria,
                                           const gg_averaging_state *state);

#endif
