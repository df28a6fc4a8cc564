/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients of contacts between grains that depend on the normal speed v, where a scene gives e, beta or mu as a
 * formula or a table of v instead of a number. They are kept as texts, by pair of species:
 *
 *   "1 - 0.2*v^0.2", "0.9 if v < 2 else 0.6"   a formula (common/expression.h)
 *   "table 0 0.9;1 0.8;1 0.7;5 0.6;"           speeds and values: straight lines between them, constant beyond the
 *                                              ends; a speed that is given twice is a step
 *
 * Allowed are e >= 0, -1 <= beta <= 1 and mu >= 0. A value beyond counts as the nearest one that is allowed, NaN as the
 * least one, and e and mu above 10^6 as 10^6. */
#ifndef GG_SPEED_LAWS_H
#define GG_SPEED_LAWS_H

#include <stddef.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "common/collision.h"
#include "common/expression.h"
#include "common/species.h"

typedef enum gg_contact_coefficient { GG_OF_E, GG_OF_BETA, GG_OF_MU, GG_N_COEFFICIENTS } gg_contact_coefficient;

enum { GG_LAWS_TEXT = 4096, GG_LAW_ROWS = 256, GG_LAW_STEPS = 16 };
#define GG_LAW_MOST 1e6

/* Texts of all pairs. Equal texts are kept once, in the order of coefficients and pairs, and unused characters are 0:
 * equal laws have equal bytes. */
typedef struct gg_speed_laws {
  uint8_t gains, loses;                     /* some e is above 1 at some speed; below 1 */
  uint16_t at[GG_N_COEFFICIENTS][GG_PAIRS]; /* place of the text, plus 1; 0: the coefficient is constant */
  char text[GG_LAWS_TEXT];
} gg_speed_laws;

/* Name of a coefficient: "e", "beta", "mu". */
const char *gg_common_coefficient_name(gg_contact_coefficient of);

/* The text of a pair; NULL: constant. */
static inline const char *gg_speed_law_text(const gg_speed_laws *laws, gg_contact_coefficient of, int pair)
{
  return laws->at[of][pair] ? laws->text + laws->at[of][pair] - 1 : NULL;
}

/* True if the coefficient of some of the first `pairs` pairs depends on the speed. */
bool gg_common_speed_laws_have(const gg_speed_laws *laws, gg_contact_coefficient of, int pairs);
static inline bool gg_speed_laws_any(const gg_speed_laws *laws, int pairs)
{
  return gg_common_speed_laws_have(laws, GG_OF_E, pairs) || gg_common_speed_laws_have(laws, GG_OF_BETA, pairs) ||
         gg_common_speed_laws_have(laws, GG_OF_MU, pairs);
}

/* Set the text of a pair, which is valid; NULL: constant. GG_BAD_INPUT: the texts are too long together. */
gg_status gg_common_speed_laws_set(gg_speed_laws *laws, gg_contact_coefficient of, int pair, const char *text,
                                   gg_error *err);

/* Find out whether some e is above or below 1, after texts were set. */
void gg_common_speed_laws_classify(gg_speed_laws *laws);

/* The simplest collision rule of a pair at all speeds, from its texts and its constants. */
gg_rule gg_common_speed_laws_rule(const gg_speed_laws *laws, int pair, double beta, double mu);

/* A law that is ready to be evaluated. */
typedef struct gg_speed_law {
  gg_contact_coefficient of;
  gg_expression formula; /* n = 0: a table */
  int n;
  double speed[GG_LAW_ROWS], value[GG_LAW_ROWS];
} gg_speed_law;

/* GG_BAD_INPUT says what is wrong, in a formula at which character. A table's values have to be allowed. */
gg_status gg_common_speed_law_parse(gg_speed_law *law, gg_contact_coefficient of, const char *text, gg_error *err);

/* The allowed value at a speed. *branch (NULL: nobody) is the same for two speeds without a step between them, unless
 * the law has two steps closer together than 1/256 of an octave; its last bit: the law itself has no allowed value. */
double gg_common_speed_law_value(const gg_speed_law *law, double speed, uint64_t *branch);

/* True if the value is the same at all speeds. */
bool gg_common_speed_law_is_constant(const gg_speed_law *law);

/* A speed at which the branch changes: to the value at `at` from that at the number below it. */
typedef struct gg_law_change {
  double at, height;
  bool valid; /* the law itself has allowed values from here on */
} gg_law_change;

/* The changes of branch in (from, to], found by bisection to the last bit. *n grows; GG_BAD_INPUT: more than
 * GG_LAW_STEPS of them. */
gg_status gg_common_speed_law_changes(const gg_speed_law *law, double from, double to,
                                      gg_law_change change[GG_LAW_STEPS], int *n, gg_error *err);

/* Check a law at speeds of all sizes, and whether its values are above 1 or below 1 somewhere. */
gg_status gg_common_speed_law_check(const gg_speed_law *law, bool *above, bool *below, gg_error *err);

#endif
