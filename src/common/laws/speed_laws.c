/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/laws/speed_laws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
  const char *name;
  double least, most;
} coefficients[GG_N_COEFFICIENTS] = {
    [GG_OF_E] = {"e", 0, GG_LAW_MOST}, [GG_OF_BETA] = {"beta", -1, 1}, [GG_OF_MU] = {"mu", 0, GG_LAW_MOST}};

static const char table_word[] = "table ";

const char *gg_common_coefficient_name(gg_contact_coefficient of)
{
  return coefficients[of].name;
}

bool gg_common_speed_laws_have(const gg_speed_laws *laws, gg_contact_coefficient of, int pairs)
{
  bool any = false;
  for (int p = 0; p < pairs; p++) any |= laws->at[of][p] > 0;
  return any;
}

/* Place of a text among those that are kept, behind which `used` is free; 0: no room. */
static unsigned place_of(gg_speed_laws *laws, size_t *used, const char *text)
{
  const size_t bytes = strlen(text) + 1;
  for (size_t at = 0; at < *used; at += strlen(laws->text + at) + 1)
    if (strcmp(laws->text + at, text) == 0) return (unsigned)at + 1;
  if (*used + bytes > GG_LAWS_TEXT) return 0;
  memcpy(laws->text + *used, text, bytes);
  *used += bytes;
  return (unsigned)(*used - bytes) + 1;
}

void gg_common_speed_laws_classify(gg_speed_laws *laws)
{
  gg_speed_law law;
  const char *last = NULL;
  laws->gains = laws->loses = false;
  for (int p = 0; p < GG_PAIRS; p++) {
    const char *text = gg_speed_law_text(laws, GG_OF_E, p);
    bool above = false, below = false;
    if (!text || text == last || gg_common_speed_law_parse(&law, GG_OF_E, text, NULL) != GG_OK) continue;
    (void)gg_common_speed_law_check(&law, &above, &below, NULL);
    laws->gains |= above, laws->loses |= below, last = text;
  }
}

gg_status gg_common_speed_laws_set(gg_speed_laws *laws, gg_contact_coefficient of, int pair, const char *text,
                                   gg_error *err)
{
  const gg_speed_laws before = *laws;
  size_t used = 0;
  if (!text && !before.at[of][pair]) return GG_OK;
  memset(laws, 0, sizeof *laws);
  for (int c = 0; c < GG_N_COEFFICIENTS; c++)
    for (int p = 0; p < GG_PAIRS; p++) {
      const bool new = c == (int)of &&p == pair;
      const char *kept = new ? text : gg_speed_law_text(&before, (gg_contact_coefficient)c, p);
      const unsigned at = kept ? place_of(laws, &used, kept) : 0;
      if (kept && !at) {
        *laws = before;
        return gg_base_fail(err, GG_BAD_INPUT, "all formulas and tables of the speed have more than %d characters",
                            GG_LAWS_TEXT);
      }
      laws->at[c][p] = (uint16_t)at;
    }
  return GG_OK;
}

gg_rule gg_common_speed_laws_rule(const gg_speed_laws *laws, int pair, double beta, double mu)
{
  const bool changes = laws->at[GG_OF_BETA][pair], limited = laws->at[GG_OF_MU][pair];
  return gg_common_rule_select(changes ? 0 : beta, limited ? 1 : mu);
}

/* "0 0.9;1 0.8;" */
static gg_status parse_rows(gg_speed_law *law, const char *at, gg_error *err)
{
  const double least = coefficients[law->of].least, most = coefficients[law->of].most;
  for (law->n = 0; *at; law->n++) {
    char *end;
    if (law->n == GG_LAW_ROWS) return gg_base_fail(err, GG_BAD_INPUT, "a table has at most %d rows", GG_LAW_ROWS);
    double *v = &law->speed[law->n], *x = &law->value[law->n];
    *v = strtod(at, &end), *x = strtod(end, &end);
    at = end + (*end == ';');
    if (!(*v >= 0 && isfinite(*v)) || (law->n > 0 && !(*v >= v[-1])))
      return gg_base_fail(err, GG_BAD_INPUT, "row %d: the speed %g; speeds ascend from 0 on", law->n + 1, *v);
    if (law->n > 1 && *v == v[-2])
      return gg_base_fail(err, GG_BAD_INPUT, "row %d: the speed %g a third time; a step has it twice", law->n + 1, *v);
    if (!(*x >= least && *x <= most))
      return gg_base_fail(err, GG_BAD_INPUT, "row %d: %s = %g; allowed: from %g to %g", law->n + 1,
                          coefficients[law->of].name, *x, least, most);
  }
  return law->n > 0 ? GG_OK : gg_base_fail(err, GG_BAD_INPUT, "the table has no row");
}

gg_status gg_common_speed_law_parse(gg_speed_law *law, gg_contact_coefficient of, const char *text, gg_error *err)
{
  static const char *const variables[] = {"v", NULL};
  law->of = of;
  law->n = law->formula.n = 0;
  if (strncmp(text, table_word, strlen(table_word)) == 0) return parse_rows(law, text + strlen(table_word), err);
  return gg_common_expression_parse(&law->formula, text, variables, err);
}

static double value_in_table(const gg_speed_law *law, double v, uint64_t *branch)
{
  int above = 0;
  while (above < law->n && law->speed[above] <= v) above++;
  for (int k = 1; k < above; k++) *branch += law->speed[k] == law->speed[k - 1];
  if (above == 0) return law->value[0];
  const double *speed = law->speed + above, *value = law->value + above;
  if (above == law->n) return value[-1];
  return value[-1] + (v - speed[-1]) / (speed[0] - speed[-1]) * (value[0] - value[-1]);
}

double gg_common_speed_law_value(const gg_speed_law *law, double v, uint64_t *branch)
{
  const double least = coefficients[law->of].least, most = coefficients[law->of].most;
  uint64_t taken = 0;
  double x = law->formula.n ? gg_common_expression_branch(&law->formula, &v, &taken) : value_in_table(law, v, &taken);
  const bool valid = x >= least && (x <= most || law->of != GG_OF_BETA);
  if (branch) *branch = taken << 1 | !valid;
  return x >= least ? x <= most ? x : most : least;
}

bool gg_common_speed_law_is_constant(const gg_speed_law *law)
{
  bool constant = true;
  for (int k = 0; k < law->formula.n; k++) constant &= law->formula.step[k].code != 'p';
  for (int k = 1; k < law->n; k++) constant &= law->value[k] == law->value[0];
  return constant;
}

gg_status gg_common_speed_law_changes(const gg_speed_law *law, double from, double to,
                                      gg_law_change change[GG_LAW_STEPS], int *n, gg_error *err)
{
  uint64_t end, before, here;
  gg_common_speed_law_value(law, to, &end);
  for (;;) {
    double low = from, high = to;
    gg_common_speed_law_value(law, from, &before);
    if (before == end) return GG_OK;
    for (;;) {
      const double middle = low + (high - low) / 2;
      if (middle <= low || middle >= high) break;
      gg_common_speed_law_value(law, middle, &here);
      *(here == before ? &low : &high) = middle;
    }
    if (*n == GG_LAW_STEPS)
      return gg_base_fail(err, GG_BAD_INPUT, "%s has more than %d steps", coefficients[law->of].name, GG_LAW_STEPS);
    const double height = gg_common_speed_law_value(law, high, &here) - gg_common_speed_law_value(law, low, NULL);
    change[(*n)++] = (gg_law_change){high, height, !(here & 1)};
    from = high;
  }
}

/* Eight speeds an octave, from 10^-19 to 10^19: enough to see what a law is like. */
gg_status gg_common_speed_law_check(const gg_speed_law *law, bool *above, bool *below, gg_error *err)
{
  gg_law_change change[GG_LAW_STEPS];
  double last = 0x1p-64;
  int n = 0;
  for (int k = 0; k <= 128 * 8; k++) {
    const double v = ldexp(1 + k % 8 / 8., k / 8 - 64), x = gg_common_speed_law_value(law, v, NULL);
    *above |= x > 1, *below |= x < 1;
    GG_TRY(gg_common_speed_law_changes(law, last, v, change, &n, err));
    last = v;
  }
  return GG_OK;
}
