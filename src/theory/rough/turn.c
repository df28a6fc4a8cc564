/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/turn.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/vec.h"
#include "simd/clones.h"

enum { PLANES = GG_ROUGH_PLANES, MOST = GG_ROUGH_MOST_TURNED };

/* In a plane of two axes: new_one = cos old_one - sin old_two, new_two = sin old_one + cos old_two. */
typedef struct plane {
  int one, two;
  double cos, sin;
} plane;

/* Plane rotations whose product, the first one last, is Y^T; their number. */
static int planes_of(const double Y[GG_ROUGH_AXES][GG_ROUGH_AXES], plane *p)
{
  double M[GG_ROUGH_AXES][GG_ROUGH_AXES];
  int n = 0;
  for (int i = 0; i < GG_ROUGH_AXES; i++)
    for (int j = 0; j < GG_ROUGH_AXES; j++) M[i][j] = fabs(Y[j][i]) < 1e-15 ? 0 : Y[j][i];
  for (int c = 0; c < GG_ROUGH_AXES - 1; c++)
    for (int r = c + 1; r < GG_ROUGH_AXES; r++) {
      const double length = hypot(M[c][c], M[r][c]);
      if (length == 0 || (M[r][c] == 0 && (M[c][c] > 0 || r + 1 < GG_ROUGH_AXES))) continue;
      p[n] = (plane){c, r, M[c][c] / length, M[r][c] / length};
      for (int j = 0; j < GG_ROUGH_AXES; j++) {
        const double one = M[c][j], two = M[r][j];
        M[c][j] = p[n].cos * one + p[n].sin * two;
        M[r][j] = p[n].cos * two - p[n].sin * one;
      }
      M[r][c] = 0;
      n++;
    }
  return n;
}

/* Functions of t quanta in the plane, m of them along the second axis. A rotation acts on them as on the polynomials
 * (cos a - sin b)^(t-m) (sin a + cos b)^m. */
static void make_turn(const plane *p, int t, double turn[MOST][MOST])
{
  for (int m = 0; m <= t; m++) {
    double poly[MOST] = {1}; /* by the power of b */
    for (int step = 0; step < t; step++) {
      const double a = step < m ? p->sin : p->cos, b = step < m ? p->cos : -p->sin;
      for (int k = step + 1; k > 0; k--) poly[k] = a * poly[k] + b * poly[k - 1];
      poly[0] *= a;
    }
    for (int k = 0; k <= t; k++)
      turn[m][k] = poly[k] * sqrt(tgamma(t - k + 1.) * tgamma(k + 1.) / (tgamma(t - m + 1.) * tgamma(m + 1.)));
  }
}

/* The rows that a plane mixes, group after group: t, and t + 1 rows of t quanta in the plane. Returns the end. */
static int *list_groups(const gg_rough_functions *f, const plane *p, int *to)
{
  for (int R = 0; R < f->n; R++) {
    const int t = f->function[R].r[p->one];
    if (f->function[R].r[p->two] != 0 || t == 0) continue; /* the first of each group */
    *to++ = t;
    for (int m = 0, S = R; m <= t; m++) {
      *to++ = S;
      if (m < t) S = f->up[f->down[S][p->one]][p->two];
    }
  }
  return to;
}

gg_status gg_rough_turn_make(gg_rough_turn *x, const gg_rough_functions *f, gg_error *err)
{
  *x = (gg_rough_turn){.f = f};
  x->turn = calloc((size_t)PLANES * (size_t)(f->degree + 1), sizeof *x->turn);
  x->group = malloc((size_t)PLANES * 2 * (size_t)f->n * sizeof *x->group);
  return x->turn && x->group ? GG_OK : gg_base_out_of_memory(err);
}

void gg_rough_turn_clear(gg_rough_turn *x)
{
  free(x->turn);
  free(x->group);
  *x = (gg_rough_turn){0};
}

void gg_rough_turn_set(gg_rough_turn *x, const double Y[GG_ROUGH_AXES][GG_ROUGH_AXES])
{
  plane p[PLANES];
  int *to = x->group;
  x->planes = planes_of(Y, p);
  for (int n = x->planes - 1, at = 0; n >= 0; n--, at++) {
    for (int t = 1; t <= x->f->degree; t++) make_turn(&p[n], t, x->turn[at * (x->f->degree + 1) + t]);
    to = list_groups(x->f, &p[n], to);
    x->end[at] = (int)(to - x->group);
  }
}

/* Vectors of 256 bits. Arrays of wider vectors stay in memory where registers are narrower. */
typedef double lanes __attribute__((vector_size(32), aligned(8), may_alias));
enum { LANES = 4 };

/* Rows become their combinations sum_c turn[r][c] row[c]. */
GG_INLINE void combine_n(double *const row[], int n, const double turn[MOST][MOST], int columns)
{
  int at = 0;
  for (; at + LANES <= columns; at += LANES) {
    lanes old[MOST];
    for (int c = 0; c < n; c++) old[c] = *(const lanes *)(row[c] + at);
    for (int r = 0; r < n; r++) {
      lanes sum = turn[r][0] * old[0];
      for (int c = 1; c < n; c++) sum += turn[r][c] * old[c];
      *(lanes *)(row[r] + at) = sum;
    }
  }
  for (; at < columns; at++) {
    double old[MOST];
    for (int c = 0; c < n; c++) old[c] = row[c][at];
    for (int r = 0; r < n; r++) {
      double sum = turn[r][0] * old[0];
      for (int c = 1; c < n; c++) sum += turn[r][c] * old[c];
      row[r][at] = sum;
    }
  }
}

/* The usual sizes as constants, so that their rows stay in registers. */
GG_CLONES static void combine(const int *group, const int *end, const double (*turn)[MOST][MOST], double *rows,
                              int columns)
{
  while (group < end) {
    const int t = *group++;
    double *row[MOST];
    for (int m = 0; m <= t; m++) row[m] = rows + (size_t)*group++ * (size_t)columns;
    switch (t) {
    case 1: combine_n(row, 2, turn[1], columns); break;
    case 2: combine_n(row, 3, turn[2], columns); break;
    case 3: combine_n(row, 4, turn[3], columns); break;
    default: combine_n(row, t + 1, turn[t], columns);
    }
  }
}

void gg_rough_turn_rows(const gg_rough_turn *x, double *rows, int columns)
{
  for (int at = 0, from = 0; at < x->planes; from = x->end[at++])
    combine(x->group + from, x->group + x->end[at], (const double(*)[MOST][MOST])x->turn + at * (x->f->degree + 1),
            rows, columns);
}
