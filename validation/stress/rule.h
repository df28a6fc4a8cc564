/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each collision beside the rule, stated here a second time: what it does to velocities and spins. */
#ifndef STRESS_RULE_H
#define STRESS_RULE_H

#include "sample.h"

typedef struct rule_watch {
  const gg_model *model;
  gg_collision_event event; /* the last one */
  int seen;
  double worst; /* of all departures */
} rule_watch;

gg_on_collision rule_note;
/* Between two samples there was one collision, at the time of the second. */
void rule_check(rule_watch *w, const sample *before, const sample *after);

#endif
