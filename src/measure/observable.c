/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/observable.h"

#define PLUG_IN(FLAG, word, description) &gg_measure_##word,
const gg_observable *const gg_measure_observables[] = {GG_OBSERVABLES(PLUG_IN) NULL};
_Static_assert(GG_N_OBSERVABLES <= 32, "a bit of `measure` for each");

bool gg_measure_observable_wants_collisions(const gg_observable *o, const gg_model *model)
{
  return o->collisions && gg_measure_observable_applies(o, model) &&
         (!o->collisions->wanted || o->collisions->wanted(model));
}

bool gg_measure_derived_find(const gg_derived *table, gg_quantity q, gg_function *f)
{
  gg_quantity family = gg_common_quantity_family(q);
  for (const gg_derived *d = table; d && d->quantity != GG_MOST_QUANTITIES; d++)
    if (d->quantity == family) return *f = (gg_function){d->of, d->each, (int)(q - family), d->unknown}, true;
  return false;
}
