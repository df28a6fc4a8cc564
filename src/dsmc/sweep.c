#include "dsmc/sweep.h"

#include "dsmc/lanes.h"

#define NAME_OF(instructions) gg_sweep_##instructions
#define NAME(instructions) NAME_OF(instructions)

void NAME(GG_INSTRUCTIONS)(gg_block *c, size_t n, double drift, double scale, gg_vec centre, gg_sums *sums)
{
  for (int at = 0; at < GG_LANES; at += GG_WIDTH) {
    gg_vd sx = gg_all(0), sy = sx, sz = sx, s2 = sx, fastest = sx;
    for (gg_block *b = c; b < c + n; b++) {
      gg_vd y = gg_load(b->y + at), x = scale * (gg_load(b->x + at) - drift * y) - centre.x;
      gg_vd z = scale * gg_load(b->z + at) - centre.z;
      y = scale * y - centre.y;
      gg_vd c2 = x * x + y * y + z * z;
      gg_store(b->x + at, x);
      gg_store(b->y + at, y);
      gg_store(b->z + at, z);
      sx += x;
      sy += y;
      sz += z;
      s2 += c2;
      fastest = gg_larger(fastest, c2);
    }
    for (int l = 0; l < GG_WIDTH; l++) {
      sums->c.x[at + l] += sx[l];
      sums->c.y[at + l] += sy[l];
      sums->c.z[at + l] += sz[l];
      sums->c2[at + l] += s2[l];
      if (fastest[l] > sums->fastest[at + l]) sums->fastest[at + l] = fastest[l];
    }
  }
}
