/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/turn.h"

#include <math.h>

#include "simd/matrix.h"

enum { PLANES = GG_ROUGH_AXES * (GG_ROUGH_AXES - 1) / 2 };

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
static void make_turn(const plane *p, int t, double turn[GG_MOST_TURNED][GG_MOST_TURNED])
{
  for (int m = 0; m <= t; m++) {
    double poly[GG_MOST_TURNED] = {1}; /* by the power of b */
    for (int step = 0; step < t; step++) {
      const double a = step < m ? p->sin : p->cos, b = step < m ? p->cos : -p->sin;
      for (int k = step + 1; k > 0; k--) poly[k] = a * poly[k] + b * poly[k - 1];
      poly[0] *= a;
    }
    for (int k = 0; k <= t; k++)
      turn[m][k] = poly[k] * sqrt(tgamma(t - k + 1.) * tgamma(k + 1.) / (tgamma(t - m + 1.) * tgamma(m + 1.)));
  }
}

static void turn_plane(const gg_rough_functions *f, const plane *p, double *rows, int columns)
{
  double turn[GG_ROUGH_MOST_DEGREE + 1][GG_MOST_TURNED][GG_MOST_TURNED], *row[GG_MOST_TURNED];
  for (int t = 1; t <= f->degree; t++) make_turn(p, t, turn[t]);
  for (int R = 0; R < f->n; R++) {
    const int t = f->function[R].r[p->one];
    if (f->function[R].r[p->two] != 0 || t == 0) continue; /* the first of each group */
    for (int m = 0, S = R; m <= t; m++) {
      row[m] = rows + (size_t)S * (size_t)columns;
      if (m < t) S = f->up[f->down[S][p->one]][p->two];
    }
    gg_simd_combine(row, t + 1, (const double(*)[GG_MOST_TURNED])turn[t], columns);
  }
}

void gg_rough_turn(const gg_rough_functions *f, const double Y[GG_ROUGH_AXES][GG_ROUGH_AXES], double *rows, int columns)
{
  plane p[PLANES];
  for (int n = planes_of(Y, p) - 1; n >= 0; n--) turn_plane(f, &p[n], rows, columns);
}
