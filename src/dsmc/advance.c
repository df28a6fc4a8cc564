/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/advance.h"

enum { WORK_PER_POLL = 1 << 16 }; /* some milliseconds */

void gg_dsmc_advance_begin(gg_dsmc_advance *a, double dt, uint64_t max_collisions, uint64_t collisions)
{
  a->asked = dt;
  a->gone = 0;
  a->last_collision = max_collisions < UINT64_MAX - collisions ? collisions + max_collisions : UINT64_MAX;
}

bool gg_dsmc_advance_is_over(const gg_dsmc_advance *a, uint64_t collisions)
{
  return !(a->gone < a->asked && collisions < a->last_collision);
}

bool gg_dsmc_advance_is_stopped(const gg_model *model, uint64_t *work, uint64_t of_step)
{
  *work += of_step;
  if (*work < WORK_PER_POLL) return false;
  *work = 0;
  return gg_stop_asked(model->stop);
}

gg_status gg_dsmc_check_temperature(const gg_model *model, double T, double least, double most, uint64_t collisions,
                                    gg_error *err)
{
  if (T > least && T < most) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "the temperature left the range of double precision (%g) after %.3g collisions per grain", T,
                      2 * (double)collisions / (double)model->n);
}
