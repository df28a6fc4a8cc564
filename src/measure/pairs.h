/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs of grains closer than a reach, under periodic or sheared periodic images. Cells are laid along the edges of
 * the sheared box, (L_x,0,0), (D,L_y,0), (0,0,L_z), in which its images form a plain lattice: no boundary is
 * special.
 *
 * The number of partners of a grain grows with distance, while the few near ones give most information. So a pair of
 * cells within the radius `whole` is always taken, and one at a distance R beyond with the probability
 * (whole/R)^fall (one power less along the edges, where pairs are few again); its pairs then have a weight of one
 * over that probability, so that sums over pairs keep their expectation. With fall 2 every shell has about as many
 * pairs. Cells are taken at equal steps from a random start. The radius follows from a budget: the cost of a
 * snapshot grows with the number of grains, at any box and density. */
#ifndef GG_PAIRS_H
#define GG_PAIRS_H

#include "common/rng.h"
#include "measure/grain_snapshot.h"

/* The box of a snapshot and its minimum images; D the displacement of the image above, reduced to |D| <= L_x/2. */
typedef struct gg_images {
  double edge[3], inverse[3], offset;
} gg_images;

typedef struct gg_pairs {
  double reach, whole, fall;
  int cells[3];
  size_t n;
  uint32_t *start; /* of each cell in `grain`, and the end */
  uint32_t *grain; /* sorted by cell */
  uint32_t *cell;  /* of each grain */
  gg_vec *at;      /* positions of the grains, sorted */
} gg_pairs;

/* Longest reach: half the shortest edge. */
double gg_measure_pairs_longest_reach(const gg_model *model);
/* `tries`: pairs a grain that a snapshot may test; INFINITY: all pairs. `fall`: as above. */
gg_status gg_measure_pairs_init(gg_pairs *p, const gg_model *model, double reach, double tries, double fall,
                                gg_error *err);
void gg_measure_pairs_clear(gg_pairs *p);

gg_images gg_measure_pairs_images(const gg_snapshot *s);
/* Sort the grains into cells. */
void gg_measure_pairs_sort(gg_pairs *p, const gg_snapshot *s, const gg_images *box);
/* A random stream for this snapshot alone: a resumed run draws the numbers of the uninterrupted one. */
gg_rng gg_measure_pairs_stream(const gg_snapshot *s);

/* Cells at an offset from others, periodic in the box: 0 <= offset < cells. An offset and its inverse are the same
 * pairs. */
typedef struct gg_pairs_offset {
  int by[3];
  double share;  /* fraction of such pairs of cells that are taken; 0: out of reach, or found from the other side */
  double weight; /* weight of their pairs */
} gg_pairs_offset;
gg_pairs_offset gg_measure_pairs_offset_of(const gg_pairs *p, const gg_images *b, size_t index);
static inline size_t gg_pairs_cells(const gg_pairs *p)
{
  return (size_t)p->cells[0] * (size_t)p->cells[1] * (size_t)p->cells[2];
}

/* Nearest integer, ties to even, |x| < 2^51. */
GG_INLINE double gg_round_half(double x)
{
  return (x + 0x1.8p52) - 0x1.8p52;
}

GG_INLINE gg_vec gg_nearest_separation(const gg_images *b, gg_vec d)
{
  double layers = gg_round_half(d.y * b->inverse[1]);
  d.y -= b->edge[1] * layers;
  d.x -= b->offset * layers;
  d.x -= b->edge[0] * gg_round_half(d.x * b->inverse[0]);
  d.z -= b->edge[2] * gg_round_half(d.z * b->inverse[2]);
  return d;
}

/* Function called for a pair: places of both in the order of p->grain, the separation from one to two, its length
 * squared, and its weight. */
typedef void gg_pair_visit(void *context, uint32_t one, uint32_t two, gg_vec separation, double square, double weight);

/* All pairs between two cells. */
GG_INLINE void gg_pairs_between(const gg_pairs *p, const gg_images *b, size_t one, size_t two, double weight,
                                gg_pair_visit *visit, void *context)
{
  double reach2 = p->reach * p->reach;
  for (uint32_t k = p->start[one]; k < p->start[one + 1]; k++)
    for (uint32_t l = one == two ? k + 1 : p->start[two]; l < p->start[two + 1]; l++) {
      gg_vec d = gg_nearest_separation(b, gg_sub(p->at[l], p->at[k]));
      double square = gg_dot(d, d);
      if (square < reach2) visit(context, k, l, d, square, weight);
    }
}

GG_INLINE int gg_pairs_wrap(int x, int n)
{
  return x < n ? x : x - n;
}

/* Visit the pairs of a snapshot that has been sorted; inlined with a constant `visit`. */
GG_INLINE void gg_pairs_each(const gg_pairs *p, const gg_snapshot *s, const gg_images *b, gg_pair_visit *visit,
                             void *context)
{
  gg_rng rng = gg_measure_pairs_stream(s);
  const int *n = p->cells;
  const size_t cells = gg_pairs_cells(p);
  for (size_t index = 0; index < cells; index++) {
    const gg_pairs_offset o = gg_measure_pairs_offset_of(p, b, index);
    if (o.share == 0) continue;
    const double step = 1 / o.share;
    for (double at = o.share < 1 ? step * gg_rng_uniform(&rng) : 0; at < (double)cells; at += step) {
      const size_t one = (size_t)at;
      const int x = (int)(one % (size_t)n[0]), row = (int)(one / (size_t)n[0]), y = row % n[1], z = row / n[1];
      const int there = (gg_pairs_wrap(z + o.by[2], n[2]) * n[1] + gg_pairs_wrap(y + o.by[1], n[1])) * n[0] +
                        gg_pairs_wrap(x + o.by[0], n[0]);
      gg_pairs_between(p, b, one, (size_t)there, o.weight, visit, context);
    }
  }
}

#endif
