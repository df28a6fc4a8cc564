#include "common/laws/loss_table.h"

#include <math.h>

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
    t->loss[k] = gg_common_law_loss(kind, u);
    t->single[k] = (float)t->loss[k];
  }
  *table = t;
  return GG_OK;
}
