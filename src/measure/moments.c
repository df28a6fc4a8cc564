#include "measure/moments.h"

#include <string.h>

#include "common/clones.h"

enum { LANES = GG_MOMENT_LANES };
typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

typedef int64_t masks __attribute__((vector_size(LANES * sizeof(int64_t))));

/* The first `n` of eight; `fill` in the others. */
GG_INLINE void load(lanes *to, const double *from, size_t n, double fill)
{
  if (n >= LANES) {
    memcpy(to, from, sizeof *to);
    return;
  }
  double part[LANES];
  for (size_t l = 0; l < LANES; l++) part[l] = l < n ? from[l] : fill;
  memcpy(to, part, sizeof *to);
}

static double sum_of(const gg_moment_lanes *v)
{
  const double *x = (const double *)v;
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/* Eight grains; returns C.C. */
GG_INLINE lanes translation(gg_moment_sums *a, const lanes c[3])
{
  lanes square[3], root, all;
  for (int k = 0; k < 3; k++) square[k] = c[k] * c[k];
  all = square[0] + square[1] + square[2];
  for (int l = 0; l < LANES; l++) root[l] = __builtin_sqrt(all[l]);
  for (int k = 0; k < 3; k++) {
    a->cc[k] += square[k];
    a->c4[k] += square[k] * square[k];
  }
  a->cxcy += c[0] * c[1];
  a->cccc += all * all;
  a->speed += root;
  return all;
}

/* c2: C.C */
GG_INLINE void rotation(gg_moment_sums *a, const lanes c[3], lanes c2, const lanes w[3])
{
  const lanes none = {0}, third = none + 1.0 / 3;
  lanes square[3], dot = c[0] * w[0] + c[1] * w[1] + c[2] * w[2];
  for (int k = 0; k < 3; k++) {
    square[k] = w[k] * w[k];
    a->w[k] += w[k];
    a->ww[k] += square[k];
    a->w3[k] += square[k] * w[k];
    a->w4[k] += square[k] * square[k];
  }
  lanes product = c2 * (square[0] + square[1] + square[2]);
  masks moves = (masks)(product > none); /* a grain at rest has no direction: no correlation */
  a->cos2 += (lanes)(((masks)(dot * dot / product) & moves) | ((masks)third & ~moves));
}

/* One pass for everything; the sums stay in registers as far as these go. */
GG_INLINE void add(gg_moments *m, size_t n, const double *const c[3], const double *const s[3], bool spins)
{
  gg_moment_sums a = m->sums;
  const double mean[3] = {m->mean_spin[0], m->mean_spin[1], m->mean_spin[2]};
  for (size_t i = 0; i < n; i += LANES) {
    lanes v[3], w[3], c2;
    for (int k = 0; k < 3; k++) load(&v[k], c[k] + i, n - i, 0);
    c2 = translation(&a, v);
    if (!spins) continue;
    for (int k = 0; k < 3; k++) load(&w[k], s[k] + i, n - i, mean[k]), w[k] -= mean[k];
    rotation(&a, v, c2, w);
  }
  m->n += (double)n;
  m->sums = a;
  if (spins) m->cos2 -= (double)((LANES - n % LANES) % LANES) / 3; /* lanes beyond the last grain */
}

GG_CLONES static void add_smooth(gg_moments *m, size_t n, const double *const c[3])
{
  add(m, n, c, c, false);
}

GG_CLONES static void add_rough(gg_moments *m, size_t n, const double *const c[3], const double *const s[3])
{
  add(m, n, c, s, true);
}

void gg_moments_add(gg_moments *m, size_t n, const double *const c[3], const double *const s[3])
{
  if (s[0])
    add_rough(m, n, c, s);
  else
    add_smooth(m, n, c);
}

void gg_moments_settle(gg_moments *m)
{
  const gg_moment_sums *s = &m->sums;
  m->cxcy = sum_of(&s->cxcy), m->cccc = sum_of(&s->cccc), m->speed = sum_of(&s->speed);
  m->cos2 += sum_of(&s->cos2);
  for (int a = 0; m->n > 0 && a < 3; a++) {
    m->cc[a] = sum_of(&s->cc[a]), m->c4[a] = sum_of(&s->c4[a]);
    double ww = sum_of(&s->ww[a]), w3 = sum_of(&s->w3[a]), d = sum_of(&s->w[a]) / m->n, dd = d * d;
    m->mean_spin[a] += d;
    m->w4[a] = sum_of(&s->w4[a]) - 4 * d * w3 + 6 * dd * ww - 3 * m->n * dd * dd;
    m->w3[a] = w3 - 3 * d * ww + 2 * m->n * dd * d;
    m->ww[a] = ww - m->n * dd;
  }
}
