/* Points of a sweep that differ in the rows of one varied group alone, that of a picture's axis. */
#ifndef GG_SWEEP_COMBINATION_H
#define GG_SWEEP_COMBINATION_H

#include "sweep/sweep.h"

/* Bytes of a name as enhanced text; what it shows has at most some 70 letters, the width of a picture. */
enum { GG_COMBINATION_NAME = 320 };

/* The first point of those that point i differs from in `varied` alone: one number for each combination of the others'
 * rows. */
size_t gg_sweep_line_group_of(const gg_sweep *sweep, size_t i, size_t varied);
/* "β = 0.5, φ = 0.1", enhanced text: its values, long ones by what they differ in. One that is cut differs from the
 * others by its number. */
void gg_sweep_line_group_name(const gg_sweep *sweep, size_t combination, size_t varied, char text[GG_COMBINATION_NAME]);

#endif
