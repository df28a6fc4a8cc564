#include "run/result.h"

int gg_run_headline_quantities(const gg_model *m, gg_quantity list[GG_N_QUANTITIES])
{
  int n = 0;
  for (const int *q = gg_flow_of(m->flow)->headline; *q != GG_N_QUANTITIES; q++)
    if (!gg_common_quantity_missing(m, (gg_quantity)*q)) list[n++] = (gg_quantity)*q;
  return n;
}
