#include "dsmc/sweep.h"

#include "dsmc/normal.h"

#define NAME_OF(name, instructions) name##_##instructions
#define NAME(name, instructions) NAME_OF(name, instructions)

/* The top of a block, part by part. */
GG_INLINE void note_top(float *top, int at, gg_vd c2, double per_unit)
{
  float peak = (float)(gg_peaks(c2, c2)[0] * per_unit);
  *top = at && *top > peak ? *top : peak;
}

void NAME(gg_sweep, GG_INSTRUCTIONS)(gg_block *c, float *top, size_t n, double drift, double scale, gg_vec centre,
                                     double unit, gg_sums *sums)
{
  const double per_unit = gg_per_top(unit);
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
      note_top(&top[b - c], at, c2, per_unit);
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

void NAME(gg_kicks, GG_INSTRUCTIONS)(gg_block *c, float *top, size_t n, double drift, double size, double unit,
                                     gg_rng_lanes *lanes)
{
  const double per_unit = gg_per_top(unit);
  gg_lane_rng rng;
  gg_lane_rng_load(&rng, lanes);
  for (gg_block *b = c; b < c + n; b++)
    for (int part = 0; part < GG_PARTS; part++) {
      const int at = part * GG_WIDTH;
      gg_vd x, y, z, spare;
      gg_lane_normal(&rng, part, &x, &y);
      gg_lane_normal(&rng, part, &z, &spare);
      x = gg_load(b->x + at) + size * (x + drift * y);
      y = gg_load(b->y + at) + size * y;
      z = gg_load(b->z + at) + size * z;
      gg_store(b->x + at, x);
      gg_store(b->y + at, y);
      gg_store(b->z + at, z);
      x -= drift * y;
      note_top(&top[b - c], at, x * x + y * y + z * z, per_unit);
    }
  gg_lane_rng_save(&rng, lanes);
}
