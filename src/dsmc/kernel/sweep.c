#include "dsmc/kernel/sweep.h"

#include "dsmc/kernel/lanes.h"

#ifdef GG_SINGLE_LANES
#define NAME_OF(instructions) gg_sweep_single_##instructions
enum { RUN = 16 }; /* blocks summed in single precision before they go into double sums */
#else
#define NAME_OF(instructions) gg_sweep_##instructions
#define RUN SIZE_MAX
#endif
#define NAME(instructions) NAME_OF(instructions)

/* The map, in the lanes' precision. */
typedef struct gg_map {
  gg_real drift, scale, x, y, z, per_unit;
} gg_map;

/* The top of a block, part by part. */
GG_INLINE void note_top(float *top, int at, gg_vd c2, gg_real per_unit)
{
  float peak = (float)(gg_peaks(c2, c2)[0] * per_unit);
  *top = at && *top > peak ? *top : peak;
}

/* Lanes from `at` on of n blocks. */
GG_INLINE void sweep(gg_real_block *c, float *top, size_t n, int at, gg_map m, gg_sums *sums)
{
  gg_vd sx = gg_all(0), sy = sx, sz = sx, s2 = sx, fastest = sx;
  for (gg_real_block *b = c; b < c + n; b++) {
    gg_vd y = gg_load(b->y + at), x = m.scale * (gg_load(b->x + at) - m.drift * y) - m.x;
    gg_vd z = m.scale * gg_load(b->z + at) - m.z;
    y = m.scale * y - m.y;
    gg_vd c2 = x * x + y * y + z * z;
    gg_store(b->x + at, x);
    gg_store(b->y + at, y);
    gg_store(b->z + at, z);
    sx += x;
    sy += y;
    sz += z;
    s2 += c2;
    fastest = gg_larger(fastest, c2);
    note_top(&top[b - c], at, c2, m.per_unit);
  }
  for (int l = 0; l < GG_WIDTH; l++) {
    sums->c.x[at + l] += sx[l];
    sums->c.y[at + l] += sy[l];
    sums->c.z[at + l] += sz[l];
    sums->c2[at + l] += s2[l];
    if (fastest[l] > sums->fastest[at + l]) sums->fastest[at + l] = fastest[l];
  }
}

void NAME(GG_INSTRUCTIONS)(void *blocks, float *top, size_t n, double drift, double scale, gg_vec centre, double unit,
                           gg_sums *sums)
{
  gg_real_block *c = blocks;
  const gg_map m = {(gg_real)drift,    (gg_real)scale,    (gg_real)centre.x,
                    (gg_real)centre.y, (gg_real)centre.z, (gg_real)gg_per_top(unit)};
  for (int at = 0; at < GG_LANES; at += GG_WIDTH)
    for (size_t first = 0; first < n; first += RUN) {
      sweep(c + first, top + first, n - first < RUN ? n - first : RUN, at, m, sums);
      if (n - first <= RUN) break;
    }
}
