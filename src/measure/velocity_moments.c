/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/velocity_moments.h"

#include <string.h>

#include "simd/clones.h"

enum { LANES = GG_VELOCITY_MOMENT_LANES };
typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));
typedef float singles __attribute__((vector_size(LANES * sizeof(float))));
typedef int64_t masks __attribute__((vector_size(LANES * sizeof(int64_t))));

GG_INLINE lanes in_double(singles x)
{
  lanes d;
  for (int l = 0; l < LANES; l++) d[l] = (double)x[l];
  return d;
}

/* Roots of doubles would take more time than all the sums; in single precision they take a quarter of it. */
GG_INLINE lanes root_of(bool quick, lanes x)
{
  lanes root;
  if (!quick) {
    for (int l = 0; l < LANES; l++) root[l] = __builtin_sqrt(x[l]);
    return root;
  }
  singles s = __builtin_convertvector(x, singles);
  for (int l = 0; l < LANES; l++) s[l] = __builtin_sqrtf(s[l]);
  return in_double(s);
}

static double sum_of(const gg_velocity_moment_lanes *v)
{
  const double *x = (const double *)v;
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/* Eight grains; returns C.C. */
GG_INLINE lanes translation(gg_velocity_moment_sums *a, bool quick, const lanes c[3])
{
  lanes square[3], all;
  for (int k = 0; k < 3; k++) square[k] = c[k] * c[k];
  all = square[0] + square[1] + square[2];
  for (int k = 0; k < 3; k++) {
    a->cc[k] += square[k];
    a->c4[k] += square[k] * square[k];
  }
  a->cxcy += c[0] * c[1];
  a->cccc += all * all;
  a->speed += root_of(quick, all);
  return all;
}

/* c2: C.C */
GG_INLINE void rotation(gg_velocity_moment_sums *a, const lanes c[3], lanes c2, const lanes w[3])
{
  const lanes none = {0}, third = none + 1.0 / 3;
  lanes square[3], dot = c[0] * w[0] + c[1] * w[1] + c[2] * w[2];
  for (int k = 0; k < 3; k++) {
    square[k] = w[k] * w[k];
    a->w[k] += w[k];
    a->ww[k] += square[k];
    a->w3[k] += square[k] * w[k];
    a->w4[k] += square[k] * square[k];
    a->ccw[k] += c2 * w[k];
    a->cwc[k] += dot * c[k];
  }
  lanes product = c2 * (square[0] + square[1] + square[2]);
  a->cxcz += c[0] * c[2], a->cycz += c[1] * c[2];
  a->ccww += product;
  a->cwcw += dot * dot;
  masks moves = (masks)(product > none); /* a grain at rest has no direction: no correlation */
  a->cos2 += (lanes)(((masks)(dot * dot / product) & moves) | ((masks)third & ~moves));
}

/* Eight grains, from index `at` of the view. */
GG_INLINE void add_group(gg_velocity_moment_sums *a, const double mean[3], bool quick, bool spins,
                         const gg_velocity_moment_view *v, size_t at)
{
  lanes c[3], w[3], c2;
  for (int k = 0; k < 3; k++) memcpy(&c[k], v->c[k] + at, sizeof c[k]);
  c[0] -= v->strain * c[1];
  c2 = translation(a, quick, c);
  if (!spins) return;
  for (int k = 0; k < 3; k++) memcpy(&w[k], v->s[k] + at, sizeof w[k]), w[k] -= mean[k];
  rotation(a, c, c2, w);
}

/* The last grains, fewer than eight: the remaining lanes are at rest. */
GG_INLINE void add_rest(gg_velocity_moment_sums *a, const double mean[3], bool quick, bool spins,
                        const gg_velocity_moment_view *v)
{
  double c[3][LANES] = {{0}}, s[3][LANES];
  const size_t at = v->n / LANES * v->stride, n = v->n % LANES;
  for (size_t k = 0; k < 3; k++)
    for (size_t l = 0; l < LANES; l++) {
      if (l < n) c[k][l] = v->c[k][at + l];
      if (spins) s[k][l] = l < n ? v->s[k][at + l] : mean[k];
    }
  const gg_velocity_moment_view rest = {n, 0, v->strain, {c[0], c[1], c[2]}, {s[0], s[1], s[2]}};
  add_group(a, mean, quick, spins, &rest, 0);
}

/* All sums in one pass; they stay in registers as far as possible. */
GG_INLINE void add(gg_velocity_moments *m, bool quick, bool spins, const gg_velocity_moment_view *view)
{
  gg_velocity_moment_sums a = m->sums;
  const gg_velocity_moment_view v = *view;
  const double mean[3] = {m->mean_spin[0], m->mean_spin[1], m->mean_spin[2]};
  for (size_t g = 0; g < v.n / LANES; g++) add_group(&a, mean, quick, spins, &v, g * v.stride);
  if (v.n % LANES) add_rest(&a, mean, quick, spins, &v);
  m->n += (double)v.n;
  m->sums = a;
  if (spins) m->cos2 -= (double)((LANES - v.n % LANES) % LANES) / 3; /* lanes beyond the last grain */
}

#define INSTANCE(name, quick, spins)                                                                                   \
  GG_CLONES static void name(gg_velocity_moments *m, const gg_velocity_moment_view *v)                                 \
  {                                                                                                                    \
    add(m, quick, spins, v);                                                                                           \
  }
INSTANCE(add_smooth, false, false)
INSTANCE(add_rough, false, true)
INSTANCE(quick_smooth, true, false)
INSTANCE(quick_rough, true, true)

void gg_measure_velocity_moments_add(gg_velocity_moments *m, bool quick, const gg_velocity_moment_view *v)
{
  static void (*const instance[2][2])(gg_velocity_moments *, const gg_velocity_moment_view *) = {
      {add_smooth, add_rough}, {quick_smooth, quick_rough}};
  instance[quick][v->s[0] != NULL](m, v);
}

void gg_measure_velocity_moments_centre(gg_velocity_moments *m)
{
  const gg_velocity_moment_sums *s = &m->sums;
  m->cxcy = sum_of(&s->cxcy), m->cccc = sum_of(&s->cccc), m->speed = sum_of(&s->speed);
  m->cos2 += sum_of(&s->cos2);
  m->ccww = sum_of(&s->ccww), m->cwcw = sum_of(&s->cwcw);
  double dd_all = 0, cdcd = 0, shift[3] = {0};
  for (int a = 0; m->n > 0 && a < 3; a++) {
    m->cc[a] = sum_of(&s->cc[a]), m->c4[a] = sum_of(&s->c4[a]);
    double ww = sum_of(&s->ww[a]), w3 = sum_of(&s->w3[a]), d = sum_of(&s->w[a]) / m->n, dd = d * d;
    m->mean_spin[a] += d;
    m->w4[a] = sum_of(&s->w4[a]) - 4 * d * w3 + 6 * dd * ww - 3 * m->n * dd * dd;
    m->w3[a] = w3 - 3 * d * ww + 2 * m->n * dd * d;
    m->ww[a] = ww - m->n * dd;
    m->ccww -= 2 * d * sum_of(&s->ccw[a]), m->cwcw -= 2 * d * sum_of(&s->cwc[a]);
    dd_all += dd, cdcd += dd * m->cc[a], shift[a] = d;
  }
  cdcd += 2 * (shift[0] * shift[1] * m->cxcy + shift[0] * shift[2] * sum_of(&s->cxcz) +
               shift[1] * shift[2] * sum_of(&s->cycz));
  m->ccww += dd_all * (m->cc[0] + m->cc[1] + m->cc[2]), m->cwcw += cdcd;
}
