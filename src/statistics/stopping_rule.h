/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When averaging ends: the window is tested at lengths that grow, until its errors are as small as requested. */
#ifndef GG_STOPPING_RULE_H
#define GG_STOPPING_RULE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct gg_stopping_criteria { /* stopping criteria, chosen before the run; in samples of each replica */
  uint64_t warmup, least, most; /* warm-up; shortest window that can be tested; requested length, 0: until the error */
  uint64_t least_steady;        /* a shorter window is not called steady */
  uint64_t longest;             /* window after which the requested error counts as out of reach */
  double relative_error;        /* 0: none; the smallest where quantities have their own */
  double time_limit;            /* seconds, 0: none */
  bool find_steady;             /* give up windows that show a trend */
} gg_stopping_criteria;

/* True if a window with a trend is given up, after `restarts` earlier ones. */
bool gg_statistics_rule_restarts(const gg_stopping_criteria *criteria, uint64_t restarts);
/* True if a window of this length ends the run, whatever its errors. */
bool gg_statistics_rule_ends(const gg_stopping_criteria *criteria, uint64_t restarts, uint64_t window);

/* Result of a test of the window. A window with 64 long blocks knows its error to 9 %: it is sure. Shorter ones, with
 * 16 of them, do not know it to better than a fifth. */
typedef struct gg_window_test {
  uint64_t window;
  double ratio;     /* error over the requested one; NaN: not known */
  bool exact, sure; /* as small as requested, and to be trusted */
} gg_window_test;
/* True if the test ends the run. A run that tests repeatedly and stops at the first small error estimate stops where
 * the estimate is too low. So a window that is not `sure` is extended by half its length after the first passed test,
 * and the estimate at its end counts. A sure window is not extended: its tests are few, since each is at the end
 * predicted by the last, and its estimate scatters little. (Simulated with independent blocks, without the error of the
 * error: the mean square of deviations over claimed errors is 1.07 without extension, 1.05 with it, 1.03 for windows of
 * fixed length; with 16 blocks 1.3, 1.16 and 1.15.) */
bool gg_statistics_rule_is_met(const gg_window_test *test, bool exact_before);
/* Length at which the window is tested next, after that test; NULL: first. It grows by a quarter a time; of one that is
 * sure, to where its error should be a twentieth smaller than requested. */
uint64_t gg_statistics_rule_next_test(const gg_stopping_criteria *criteria, uint64_t restarts,
                                      const gg_window_test *last);

/* Factor that enlarges errors by which a run stops, since it stops where their estimate is low; 1 for other errors. In
 * independent runs of autoregressive series (tests/run/test_stopping_rule.c) the mean square of deviations over errors
 * is 1.0 to 1.1 then, and 1.1 to 1.2 without; 1 % from 600 correlation times on. `correlation` and `window` in one
 * unit, over all replicas. */
double gg_statistics_rule_margin(const gg_stopping_criteria *criteria, double correlation, double window);

#endif
