/* What doubles from 1 when a store of fixed size is full. */
#ifndef GG_DOUBLING_H
#define GG_DOUBLING_H

#include <stdbool.h>
#include <stdint.h>

/* Can a number from a file be one, with so many samples of the next entry pending? Far from running over, too. */
static inline bool gg_is_doubling(uint64_t per, uint64_t pending)
{
  return per > 0 && per < UINT64_C(1) << 48 && (per & (per - 1)) == 0 && pending < per;
}

#endif
