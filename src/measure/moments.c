#include "measure/moments.h"

void gg_moments_translation(gg_moments *m, size_t n, const double *const c[3])
{
  const double *cx = c[0], *cy = c[1], *cz = c[2];
  double x1 = 0, y1 = 0, z1 = 0, x2 = 0, y2 = 0, z2 = 0, xy = 0, x4 = 0, y4 = 0, z4 = 0, c4 = 0, speed = 0;
#pragma omp simd reduction(+ : x1, y1, z1, x2, y2, z2, xy, x4, y4, z4, c4, speed)
  for (size_t i = 0; i < n; i++) {
    double x = cx[i], y = cy[i], z = cz[i], xx = x * x, yy = y * y, zz = z * z, square = xx + yy + zz;
    x1 += x, y1 += y, z1 += z;
    x2 += xx, y2 += yy, z2 += zz;
    xy += x * y;
    x4 += xx * xx, y4 += yy * yy, z4 += zz * zz;
    c4 += square * square;
    speed += __builtin_sqrt(square);
  }
  m->n += (double)n;
  m->c[0] += x1, m->c[1] += y1, m->c[2] += z1;
  m->cc[0] += x2, m->cc[1] += y2, m->cc[2] += z2;
  m->cxcy += xy;
  m->c4[0] += x4, m->c4[1] += y4, m->c4[2] += z4;
  m->cccc += c4;
  m->speed += speed;
}

void gg_moments_mean_spin(gg_moments *m, size_t n, const double *const s[3])
{
  for (int a = 0; a < 3; a++) {
    const double *from = s[a];
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < n; i++) sum += from[i];
    m->s[a] += sum;
  }
}

void gg_moments_rotation(gg_moments *m, size_t n, const double *const c[3], const double *const s[3])
{
  const double *cx = c[0], *cy = c[1], *cz = c[2], *sx = s[0], *sy = s[1], *sz = s[2];
  double mx = m->mean_spin[0], my = m->mean_spin[1], mz = m->mean_spin[2];
  double x2 = 0, y2 = 0, z2 = 0, x4 = 0, y4 = 0, z4 = 0, z3 = 0, cos2 = 0;
#pragma omp simd reduction(+ : x2, y2, z2, x4, y4, z4, z3, cos2)
  for (size_t i = 0; i < n; i++) {
    double x = sx[i] - mx, y = sy[i] - my, z = sz[i] - mz, xx = x * x, yy = y * y, zz = z * z;
    double dot = cx[i] * x + cy[i] * y + cz[i] * z;
    double product = (cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i]) * (xx + yy + zz);
    x2 += xx, y2 += yy, z2 += zz;
    x4 += xx * xx, y4 += yy * yy, z4 += zz * zz;
    z3 += zz * z;
    cos2 += product > 0 ? dot * dot / product : 1.0 / 3; /* a grain at rest has no direction: no correlation */
  }
  m->ww[0] += x2, m->ww[1] += y2, m->ww[2] += z2;
  m->w4[0] += x4, m->w4[1] += y4, m->w4[2] += z4;
  m->w3z += z3;
  m->cos2 += cos2;
}
