#include "dsmc/majorant.h"

/* Room above the largest value seen: enough that a new record rarely goes over, little enough to cost no candidates. */
static const double room = 1.05;

void gg_majorant_start(gg_majorant *m, double bound, double thermal)
{
  *m = (gg_majorant){.before = bound / thermal};
}

double gg_majorant_bound(const gg_majorant *m, double thermal)
{
  return room * (m->now > m->before ? m->now : m->before) * thermal;
}

void gg_majorant_learn(gg_majorant *m, double worst, double thermal, uint64_t candidates, uint64_t window)
{
  if (worst > m->now * thermal) m->now = worst / thermal;
  m->seen += candidates;
  if (m->seen < window || m->now == 0) return;
  *m = (gg_majorant){.before = m->now};
}
