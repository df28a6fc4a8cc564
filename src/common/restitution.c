/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/restitution.h"

#include <math.h>
#include <stdlib.h>

#include "base/cancellation.h"
#include "base/memory.h"
#include "common/laws/loss_table.h"

#define WORD(NAME, name, description) [GG_LAW_##NAME] = #name,
static const char *const names[GG_N_LAWS] = {[GG_LAW_CONSTANT] = "constant", GG_LAWS(WORD)};
#undef WORD
#define LOSS(NAME, name, description) [GG_LAW_##NAME] = gg_common_loss_##name,
static gg_loss *const losses[GG_N_LAWS] = {[GG_LAW_CONSTANT] = NULL, GG_LAWS(LOSS)};
#undef LOSS

const char *gg_common_law_name(gg_law_kind kind)
{
  return names[kind];
}

double gg_common_law_loss(gg_law_kind kind, double u)
{
  return u > 0 ? losses[kind](u) : 0;
}

double gg_common_law_speed_of(gg_law_kind kind, double loss)
{
  if (loss <= 0) return 0;
  double low = 0x1p-1000, high = 0x1p1000; /* halved by square roots, which are rounded alike everywhere */
  for (int k = 0; k < 100; k++) {
    const double middle = sqrt(low * high);
    if (losses[kind](middle) < loss)
      low = middle;
    else
      high = middle;
  }
  return sqrt(low * high);
}

double gg_common_law_at(const gg_restitution_law *law, double speed, int species_1, int species_2, uint64_t *clamped)
{
  if (!law->e) return 1 - gg_common_law_loss(law->kind, law->scale[gg_pair(species_1, species_2)] * speed);
  double e = law->e(law->context, speed, species_1, species_2);
  if (e >= 0 && e <= 1) return e;
  if (clamped) ++*clamped;
  return e > 1 ? 1 : 0;
}

double gg_common_law_from_table(void *context, double speed, int species_1, int species_2)
{
  const gg_law_table *t = context;
  (void)species_1, (void)species_2;
  if (!(speed > t->speed[0])) return t->e[0];
  if (speed >= t->speed[t->n - 1]) return t->e[t->n - 1];
  size_t below = 0, above = t->n - 1;
  while (above - below > 1) {
    size_t middle = (below + above) / 2;
    if (t->speed[middle] <= speed)
      below = middle;
    else
      above = middle;
  }
  double share = (speed - t->speed[below]) / (t->speed[above] - t->speed[below]);
  return t->e[below] + share * (t->e[above] - t->e[below]);
}

gg_status gg_common_law_check(const gg_restitution_law *law, int n_species, gg_error *err)
{
  for (int i = 0; i < n_species; i++)
    for (int j = 0; j < n_species; j++)
      for (int k = -36; k <= 36; k++) {
        double speed = pow(10, 0.25 * k), e = law->e(law->context, speed, i, j);
        GG_TRY(gg_base_callback_settle(GG_OK, err));
        if (!(e >= 0 && e <= 1))
          return gg_base_fail(
              err, GG_BAD_INPUT,
              "restitution law '%s': e = %g at normal speed %g (species %d and %d); it must be from 0 to 1", law->name,
              e, speed, i + 1, j + 1);
      }
  return GG_OK;
}

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
