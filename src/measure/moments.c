/* Sums in eight lanes whatever the processor's registers hold, so that every processor has the same bits. */
#include "measure/moments.h"

#include <string.h>

#include "common/clones.h"

enum { LANES = 8 };
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

static double sum_of(const lanes *v)
{
  const double *x = (const double *)v;
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

GG_CLONES static void translation(gg_moments *m, size_t n, const double *const c[3])
{
  lanes x1 = {0}, y1 = x1, z1 = x1, x2 = x1, y2 = x1, z2 = x1, xy = x1, x4 = x1, y4 = x1, z4 = x1, c4 = x1, speed = x1;
  for (size_t i = 0; i < n; i += LANES) {
    lanes x = {0}, y = x, z = x, root = x;
    load(&x, c[0] + i, n - i, 0), load(&y, c[1] + i, n - i, 0), load(&z, c[2] + i, n - i, 0);
    lanes xx = x * x, yy = y * y, zz = z * z, square = xx + yy + zz;
    for (int l = 0; l < LANES; l++) root[l] = __builtin_sqrt(square[l]);
    x1 += x, y1 += y, z1 += z;
    x2 += xx, y2 += yy, z2 += zz;
    xy += x * y;
    x4 += xx * xx, y4 += yy * yy, z4 += zz * zz;
    c4 += square * square;
    speed += root;
  }
  m->n += (double)n;
  m->c[0] += sum_of(&x1), m->c[1] += sum_of(&y1), m->c[2] += sum_of(&z1);
  m->cc[0] += sum_of(&x2), m->cc[1] += sum_of(&y2), m->cc[2] += sum_of(&z2);
  m->cxcy += sum_of(&xy);
  m->c4[0] += sum_of(&x4), m->c4[1] += sum_of(&y4), m->c4[2] += sum_of(&z4);
  m->cccc += sum_of(&c4);
  m->speed += sum_of(&speed);
}

GG_CLONES static void rotation(gg_moments *m, size_t n, const double *const c[3], const double *const s[3])
{
  const double *mean = m->mean_spin;
  const lanes none = {0}, third = none + 1.0 / 3;
  lanes x1 = none, y1 = none, z1 = none, x2 = none, y2 = none, z2 = none, x3 = none, y3 = none, z3 = none;
  lanes x4 = none, y4 = none, z4 = none, cos2 = none;
  for (size_t i = 0; i < n; i += LANES) {
    lanes u = none, v = none, w = none, x = none, y = none, z = none;
    load(&u, c[0] + i, n - i, 0), load(&v, c[1] + i, n - i, 0), load(&w, c[2] + i, n - i, 0);
    load(&x, s[0] + i, n - i, mean[0]), load(&y, s[1] + i, n - i, mean[1]), load(&z, s[2] + i, n - i, mean[2]);
    x -= mean[0], y -= mean[1], z -= mean[2];
    lanes xx = x * x, yy = y * y, zz = z * z, dot = u * x + v * y + w * z;
    lanes product = (u * u + v * v + w * w) * (xx + yy + zz);
    x1 += x, y1 += y, z1 += z;
    x2 += xx, y2 += yy, z2 += zz;
    x3 += xx * x, y3 += yy * y, z3 += zz * z;
    x4 += xx * xx, y4 += yy * yy, z4 += zz * zz;
    masks moves = (masks)(product > none); /* a grain at rest has no direction: no correlation */
    cos2 += (lanes)(((masks)(dot * dot / product) & moves) | ((masks)third & ~moves));
  }
  m->w[0] += sum_of(&x1), m->w[1] += sum_of(&y1), m->w[2] += sum_of(&z1);
  m->ww[0] += sum_of(&x2), m->ww[1] += sum_of(&y2), m->ww[2] += sum_of(&z2);
  m->w4[0] += sum_of(&x4), m->w4[1] += sum_of(&y4), m->w4[2] += sum_of(&z4);
  m->w3[0] += sum_of(&x3), m->w3[1] += sum_of(&y3), m->w3[2] += sum_of(&z3);
  m->cos2 += sum_of(&cos2) - (double)((LANES - n % LANES) % LANES) / 3; /* lanes beyond the last grain */
}

void gg_moments_translation(gg_moments *m, size_t n, const double *const c[3])
{
  translation(m, n, c);
}

void gg_moments_rotation(gg_moments *m, size_t n, const double *const c[3], const double *const s[3])
{
  rotation(m, n, c, s);
}

void gg_moments_settle(gg_moments *m)
{
  for (int a = 0; m->n > 0 && a < 3; a++) {
    double d = m->w[a] / m->n, dd = d * d;
    m->mean_spin[a] += d;
    m->w4[a] += -4 * d * m->w3[a] + 6 * dd * m->ww[a] - 3 * m->n * dd * dd;
    m->w3[a] += -3 * d * m->ww[a] + 2 * m->n * dd * d;
    m->ww[a] -= m->n * dd;
    m->w[a] = 0;
  }
}
