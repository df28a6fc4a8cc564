/* The long waves across the gap between walls: what wanders slowly there, and what no mean over all grains shows. A run
 * keeps them as a series, from which it knows for how long it has to average (run/slow_modes.c). They come from the
 * slabs of the local frame, which every sample takes anyway. */
#ifndef GG_WALL_MODES_H
#define GG_WALL_MODES_H

#include "measure/local_frame.h"

enum { GG_WALL_CENTRE, GG_MOST_WALL_MODES = 9 }; /* the first: the centre of mass */

/* How many this model has; 0 without walls. */
int gg_measure_wall_modes(const gg_model *model);
/* Their values of this instant. */
void gg_measure_wall_modes_take(const gg_model *model, const gg_slabs *slabs, double *row);
/* "the centre of mass across the gap" */
const char *gg_measure_wall_mode_name(int mode);
/* Does it change its sign under the symmetry of the flow, so that its true mean is 0? */
bool gg_measure_wall_mode_is_odd(const gg_model *model, int mode);

#endif
