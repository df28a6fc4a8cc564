/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/majorant.h"

/* Factor above the largest value so far: larger values rarely exceed it, and it costs few candidates. */
static const double room = 1.05;

void gg_dsmc_majorant_start(gg_dsmc_majorant *m, double sure, double thermal)
{
  *m = (gg_dsmc_majorant){.before = sure / thermal};
}

double gg_dsmc_majorant_at(const gg_dsmc_majorant *m, double thermal)
{
  return room * (m->now > m->before ? m->now : m->before) * thermal;
}

void gg_dsmc_majorant_learn(gg_dsmc_majorant *m, double largest, double thermal, uint64_t candidates, uint64_t window)
{
  if (largest > m->now * thermal) m->now = largest / thermal;
  m->seen += candidates;
  if (m->seen < window || m->now == 0) return;
  *m = (gg_dsmc_majorant){.before = m->now};
}
