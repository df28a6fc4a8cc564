/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/laws/loss_table.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/restitution.h"

gg_status gg_common_loss_table_new(gg_law_kind kind, gg_loss_table **table, gg_error *err)
{
  *table = NULL;
  if (kind == GG_LAW_CONSTANT) return GG_OK;
  gg_loss_table *t = gg_base_array_new(1, sizeof *t, err);
  if (!t) return GG_FAILED;
  for (int k = 0; k < GG_LOSS_NODES; k++) {
    const int octave = k >> GG_LOSS_BITS, part = k & ((1 << GG_LOSS_BITS) - 1);
    const double u = ldexp(1 + ldexp(part, -GG_LOSS_BITS), GG_LOSS_FIRST + octave);
    t->loss[k] = k > 0 ? gg_common_law_loss(kind, u) : 0; /* where pairs of e = 1 are, whose scale is 0 */
    t->single[k] = (float)t->loss[k];
  }
  *table = t;
  return GG_OK;
}

/* 1 - e, 1 + beta, mu. */
static double entry_of(gg_contact_coefficient of, double x)
{
  return of == GG_OF_E ? 1 - x : of == GG_OF_BETA ? 1 + x : x;
}

/* Add the steps of a law between two nodes to its table, in the units of the table; changes of slope are no steps. */
static gg_status add_steps(const gg_speed_law *law, double from, double to, gg_loss_table *t, double *jumped,
                           gg_error *err)
{
  gg_law_change change[GG_LAW_STEPS];
  int n = 0;
  GG_TRY(gg_common_speed_law_changes(law, from, to, change, &n, err));
  for (int k = 0; k < n; k++) {
    const double at = ldexp(change[k].at, -GG_LAW_OCTAVES), height = change[k].height;
    const bool invalid = t->n_invalid > 0 && isinf(t->to[t->n_invalid - 1]);
    const bool jumps = fabs(height) > 1e-12;
    if (t->n_steps + jumps > GG_LAW_STEPS || t->n_invalid > GG_LAW_STEPS)
      return gg_base_fail(err, GG_BAD_INPUT, "%s has more than %d steps", gg_common_coefficient_name(law->of),
                          GG_LAW_STEPS);
    if (jumps) {
      t->at[t->n_steps] = at;
      t->height[t->n_steps] = law->of == GG_OF_E ? -height : height;
      *jumped += t->height[t->n_steps++];
    }
    if (change[k].valid && invalid) t->to[t->n_invalid - 1] = at;
    if (!change[k].valid && !invalid) t->from[t->n_invalid] = at, t->to[t->n_invalid++] = INFINITY;
  }
  return GG_OK;
}

static gg_status fill(const gg_speed_law *law, gg_loss_table *t, gg_error *err)
{
  double last = ldexp(GG_LOSS_LOWEST, GG_LAW_OCTAVES), jumped = 0;
  uint64_t branch;
  gg_common_speed_law_value(law, last, &branch);
  if (branch & 1) t->from[0] = 0, t->to[0] = INFINITY, t->n_invalid = 1;
  for (int k = 0; k < GG_LOSS_NODES; k++) {
    const int octave = k >> GG_LOSS_BITS, part = k & ((1 << GG_LOSS_BITS) - 1);
    const double v = ldexp(1 + ldexp(part, -GG_LOSS_BITS), GG_LOSS_FIRST + octave + GG_LAW_OCTAVES);
    GG_TRY(add_steps(law, last, v, t, &jumped, err));
    t->loss[k] = entry_of(law->of, gg_common_speed_law_value(law, v, NULL)) - jumped;
    t->single[k] = (float)t->loss[k];
    last = v;
  }
  return GG_OK;
}

gg_status gg_common_law_table_new(gg_contact_coefficient of, const char *text, gg_loss_table **table, gg_error *err)
{
  gg_speed_law law;
  *table = NULL;
  GG_TRY(gg_common_speed_law_parse(&law, of, text, err));
  gg_loss_table *t = gg_base_array_new(1, sizeof *t, err);
  if (!t) return GG_FAILED;
  const gg_status status = fill(&law, t, err);
  if (status == GG_OK)
    *table = t;
  else
    free(t);
  return status;
}
