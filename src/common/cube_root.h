/* The cube root, rounded as IEEE 754 rounds: C libraries differ in the last bits of theirs (by processor, too), and the
 * edges of a box are the first numbers of a trajectory. */
#ifndef GG_CUBE_ROOT_H
#define GG_CUBE_ROOT_H

#include <math.h>

/* x > 0. */
static inline double gg_cube_root(double x)
{
  /* One step of Newton from the library's, with what x - y^3 leaves: y^2 = square + rest, y^3 = cube + ... */
  double y = cbrt(x), square = y * y, rest = fma(y, y, -square);
  double cube = square * y, left = x - cube - fma(square, y, -cube) - rest * y;
  return y + left / (3 * square);
}

#endif
