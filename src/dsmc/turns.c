#include "dsmc/turns.h"

#include <math.h>

int gg_sweeps_of(const gg_time_step *step, gg_order_of_turns order, double dt)
{
  if (order != GG_TURNS_THERE_AND_BACK) return 1;
  const double times = ceil((1 - 1e-9) * dt / step->turns);
  return 2 * (int)fmax(1, fmin(times, GG_MOST_SWEEPS / 2));
}

int gg_sweeps_of_a_part(const gg_time_step *step, gg_order_of_turns order, double dt, int parts)
{
  const int both = order == GG_TURNS_THERE_AND_BACK ? 2 : 1, sweeps = gg_sweeps_of(step, order, dt);
  return both * ((sweeps + both * parts - 1) / (both * parts));
}

int gg_list_turns(int pairs, gg_order_of_turns order, int sweeps, gg_turn turn[GG_MOST_TURNS])
{
  int n = 0;
  for (int k = 0; k < sweeps; k++)
    for (int q = 0; q < pairs; q++) {
      const bool back = (order == GG_TURNS_BACK) != (k % 2 == 1);
      const int pair = back ? pairs - 1 - q : q;
      if (n > 0 && turn[n - 1].pair == pair)
        turn[n - 1].length++;
      else
        turn[n++] = (gg_turn){pair, k, 1};
    }
  return n;
}
