/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/restitution.h"

#include <math.h>

#include "base/cancellation.h"

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
