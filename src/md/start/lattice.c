/* Centres on a face-centred lattice stretched to the box, some sites left empty at random. */
#include <math.h>

#include "common/portable_math.h"
#include "md/start/place.h"

static const double basis[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};

/* Distance of the nearest sites with m[] cubes along the edges. */
static double spacing(const gg_md_box *box, const uint32_t m[3])
{
  double a[3], nearest = INFINITY;
  for (int k = 0; k < 3; k++) a[k] = box->edge[k] / m[k];
  for (int k = 0; k < 3; k++) {
    nearest = fmin(nearest, a[k]);
    nearest = fmin(nearest, 0.5 * sqrt(a[k] * a[k] + a[(k + 1) % 3] * a[(k + 1) % 3]));
  }
  return nearest;
}

/* The numbers of cubes that leave the sites farthest apart. */
static void choose_cubes(const gg_md_box *box, uint32_t n, uint32_t best[3])
{
  double widest = 0, edge = gg_root(4 * box->edge[0] * box->edge[1] * box->edge[2] / n, 3);
  uint32_t most[3];
  for (int k = 0; k < 3; k++) most[k] = 2 + (uint32_t)(2 * box->edge[k] / edge);
  for (uint32_t x = 1; x <= most[0]; x++)
    for (uint32_t y = 1; y <= most[1]; y++) {
      uint32_t m[3] = {x, y, (uint32_t)ceil(n / (4.0 * x * y))};
      double wide = spacing(box, m);
      if (wide > widest) widest = wide, best[0] = m[0], best[1] = m[1], best[2] = m[2];
    }
}

void gg_md_place_lattice(const gg_md_box *box, uint32_t n, gg_rng *rng, gg_vec *r)
{
  uint32_t m[3] = {1, 1, 1}, placed = 0, seen = 0;
  choose_cubes(box, n, m);
  uint32_t sites = 4 * m[0] * m[1] * m[2];
  for (uint32_t cube = 0; cube < sites / 4; cube++)
    for (int b = 0; b < 4; b++, seen++) {
      if (gg_rng_below(rng, sites - seen) >= n - placed) continue;
      uint32_t at[3] = {cube % m[0], cube / m[0] % m[1], cube / (m[0] * m[1])};
      for (int a = 0; a < 3; a++) *gg_component(&r[placed], a) = box->edge[a] * (at[a] + basis[b][a] + 0.25) / m[a];
      placed++;
    }
}
