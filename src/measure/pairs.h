/* Every pair of grains closer than a reach, each once, under periodic or sheared periodic images. Cells are laid along
 * the edges of the sheared box, (L_x,0,0), (D,L_y,0), (0,0,L_z), in which its images form a plain lattice: no boundary
 * is special. */
#ifndef GG_PAIRS_H
#define GG_PAIRS_H

#include "measure/snapshot.h"

/* The box of a snapshot and its nearest images; D the displacement of the image above, brought to |D| <= L_x/2. */
typedef struct gg_images {
  double edge[3], inverse[3], offset;
} gg_images;

typedef struct gg_pairs {
  double reach;
  int cells[3]; /* fewer than 5 along some edge: all pairs are tried */
  size_t n;
  uint32_t *start; /* of each cell in `grain`, and the end */
  uint32_t *grain; /* sorted by cell */
  uint32_t *cell;  /* of each grain */
} gg_pairs;

/* Reach: at most half the shortest edge. */
double gg_pairs_longest_reach(const gg_model *model);
gg_status gg_pairs_init(gg_pairs *p, const gg_model *model, double reach, gg_error *err);
void gg_pairs_clear(gg_pairs *p);

gg_images gg_images_of(const gg_snapshot *s);
/* Put the grains into their cells. */
void gg_pairs_sort(gg_pairs *p, const gg_snapshot *s, const gg_images *box);

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

/* What is done with a pair: the separation from i to j, its length squared. */
typedef void gg_pair_visit(void *context, size_t i, size_t j, gg_vec separation, double square);

GG_INLINE void gg_pairs_try(const gg_snapshot *s, const gg_images *b, double reach2, size_t i, size_t j,
                            gg_pair_visit *visit, void *context)
{
  gg_vec d = {s->r[0][j] - s->r[0][i], s->r[1][j] - s->r[1][i], s->r[2][j] - s->r[2][i]};
  d = gg_nearest_separation(b, d);
  double square = gg_dot(d, d);
  if (square < reach2) visit(context, i, j, d, square);
}

/* The cell at an offset from another, round the box. */
GG_INLINE uint32_t gg_pairs_neighbour(const gg_pairs *p, int x, int y, int z)
{
  const int *n = p->cells;
  return (uint32_t)(((z + n[2]) % n[2] * n[1] + (y + n[1]) % n[1]) * n[0] + (x + n[0]) % n[0]);
}

GG_INLINE void gg_pairs_between(const gg_pairs *p, const gg_snapshot *s, const gg_images *b, uint32_t one, uint32_t two,
                                gg_pair_visit *visit, void *context)
{
  double reach2 = p->reach * p->reach;
  for (uint32_t k = p->start[one]; k < p->start[one + 1]; k++)
    for (uint32_t l = one == two ? k + 1 : p->start[two]; l < p->start[two + 1]; l++)
      gg_pairs_try(s, b, reach2, p->grain[k], p->grain[l], visit, context);
}

/* Visit every pair; inlined with a constant `visit`. Half of the 125 cells around each are searched. */
GG_INLINE void gg_pairs_each(gg_pairs *p, const gg_snapshot *s, gg_pair_visit *visit, void *context)
{
  gg_images b = gg_images_of(s);
  const int *n = p->cells;
  if (n[0] < 5 || n[1] < 5 || n[2] < 5) {
    for (size_t i = 0; i < s->n; i++)
      for (size_t j = i + 1; j < s->n; j++) gg_pairs_try(s, &b, p->reach * p->reach, i, j, visit, context);
    return;
  }
  gg_pairs_sort(p, s, &b);
  for (int z = 0; z < n[2]; z++)
    for (int y = 0; y < n[1]; y++)
      for (int x = 0; x < n[0]; x++) {
        uint32_t here = gg_pairs_neighbour(p, x, y, z);
        for (int k = 62; k < 125; k++) { /* 62: the cell itself */
          uint32_t there = gg_pairs_neighbour(p, x + k % 5 - 2, y + k / 5 % 5 - 2, z + k / 25 - 2);
          gg_pairs_between(p, s, &b, here, there, visit, context);
        }
      }
}

#endif
