/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/stopping_rule.h"

#include <math.h>

/* Windows that may be given up: averaging does not begin anew for ever. */
enum { MOST_RESTARTS = 6 };

/* The next length above `window` of those that grow by a quarter. */
static uint64_t next_quarter(const gg_stopping_criteria *criteria, uint64_t restarts, uint64_t window)
{
  uint64_t next = criteria->least << restarts;
  while (next <= window) next += next / 4 + (next < 4);
  return next;
}

/* A run that may be extended gives up windows at the lengths of next_quarter alone. A window that ends at another
 * length, set by a criterion, is not given up there: a run with other criteria would not test it at that length. */
bool gg_statistics_rule_restarts(const gg_stopping_criteria *criteria, uint64_t restarts, uint64_t window)
{
  const bool regular = !criteria->extends || next_quarter(criteria, restarts, window - 1) == window;
  return criteria->find_steady && restarts < MOST_RESTARTS && window >= criteria->least && regular;
}

bool gg_statistics_rule_ends(const gg_stopping_criteria *criteria, uint64_t restarts, uint64_t window)
{
  return (criteria->most && window >= criteria->most) ||
         (criteria->relative_error > 0 && window >= criteria->longest << restarts);
}

bool gg_statistics_rule_is_met(const gg_stopping_criteria *criteria, const gg_window_test *test, bool exact_before)
{
  if (criteria->extends) exact_before = test->ratio * test->ratio <= 1 / 1.5;
  return test->exact && (test->sure || exact_before);
}

uint64_t gg_statistics_rule_next_test(const gg_stopping_criteria *criteria, uint64_t restarts,
                                      const gg_window_test *last)
{
  uint64_t next = criteria->least << restarts;
  if (last && criteria->extends)
    next = next_quarter(criteria, restarts, last->window);
  else if (last && last->window >= next)
    next = last->exact ? last->window + last->window / 2
           : last->sure && last->ratio > 0
               ? (uint64_t)ceil(fmin(fmax(1.1 * last->ratio * last->ratio, 1.1), 2) * (double)last->window)
               : last->window + last->window / 4;
  return criteria->most && next > criteria->most ? criteria->most : next;
}

double gg_statistics_rule_margin(const gg_stopping_criteria *criteria, double correlation, double window)
{
  return criteria->relative_error > 0 && window > 0 ? 1 + 6 * correlation / window : 1;
}
