/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why md differs from Enskog's equation by more than expected (theory/md_causes.h), in a comparison. */
#ifndef GG_CAUSES_H
#define GG_CAUSES_H

#include "common/model.h"
#include "run/result.h"
#include "theory/md_causes.h"

struct gg_comparison;

enum { GG_MOST_CAUSES = 8 };
typedef struct gg_causes { /* a sentence each */
  int n;
  char text[GG_MOST_CAUSES][GG_CAUSE_TEXT];
} gg_causes;

/* Causes of one quantity. A marked quantity (gg_run_results_disagree) has at least one sentence, if only that no cause
 * is known; others have none. */
void gg_run_causes_of(const struct gg_comparison *comparison, gg_quantity q, gg_causes *causes);

/* Causes of all marked quantities, each sentence once; the last sentence names quantities without a known cause.
 * */
void gg_run_causes_find(const struct gg_comparison *comparison, gg_causes *causes);

/* "the grains have clustered: ..."; false where the gas is homogeneous, or it is unknown. */
bool gg_run_structure(const gg_result *result, char *text, size_t size);

#endif
