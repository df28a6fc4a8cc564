/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/velocity_moments.h"

#include <string.h>

#include "simd/levels.h"

enum { LANES = GG_VELOCITY_MOMENT_LANES };

/* Add the groups of a view, and one of the last grains (NULL: none). */
typedef void add_grains(gg_velocity_moments *m, const gg_velocity_moment_view *v, const gg_velocity_moment_view *rest);

#define GG_LANES 2
#define GG_OF(name) two_##name
#define GG_TARGET
#include "measure/velocity_moments_of.h"
#if defined(GG_X86_64)
#define GG_LANES 4
#define GG_OF(name) four_##name
#define GG_TARGET __attribute__((target("avx2")))
#include "measure/velocity_moments_of.h"
#define GG_LANES 8
#define GG_OF(name) eight_##name
#define GG_TARGET __attribute__((target("avx512f")))
#include "measure/velocity_moments_of.h"
#endif

static gg_instructions best_here(void)
{
  return gg_has_avx512() ? GG_AVX512 : gg_has_avx2() ? GG_AVX2 : GG_BASELINE;
}

static add_grains *instance(gg_instructions set, bool quick, bool spins)
{
#if defined(GG_X86_64)
  if (set == GG_AVX512) return eight_instances[quick][spins];
  if (set == GG_AVX2) return four_instances[quick][spins];
#endif
  (void)set;
  return two_instances[quick][spins];
}

static double sum_of(const double x[LANES])
{
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

void gg_measure_velocity_moments_add(gg_velocity_moments *m, bool quick, const gg_velocity_moment_view *v)
{
  gg_measure_velocity_moments_add_in(best_here(), m, quick, v);
}

void gg_measure_velocity_moments_add_in(gg_instructions set, gg_velocity_moments *m, bool quick,
                                        const gg_velocity_moment_view *v)
{
  const bool spins = v->s[0] != NULL;
  double c[3][LANES] = {{0}}, s[3][LANES];
  const size_t at = v->n / LANES * v->stride, n = v->n % LANES;
  const gg_velocity_moment_view rest = {LANES, 0, v->strain, {c[0], c[1], c[2]}, {s[0], s[1], s[2]}};
  for (size_t k = 0; k < 3 && n; k++)
    for (size_t l = 0; l < LANES; l++) { /* lanes beyond the last grain are at rest */
      if (l < n) c[k][l] = v->c[k][at + l];
      if (spins) s[k][l] = l < n ? v->s[k][at + l] : m->mean_spin[k];
    }
  instance(set, quick, spins)(m, v, n ? &rest : NULL);
  m->n += (double)v->n;
  if (spins) m->cos2 -= (double)((LANES - n) % LANES) / 3; /* lanes beyond the last grain */
}

void gg_measure_velocity_moments_centre(gg_velocity_moments *m)
{
  const gg_velocity_moment_sums *s = &m->sums;
  m->cxcy = sum_of(s->cxcy), m->cccc = sum_of(s->cccc), m->speed = sum_of(s->speed);
  m->cos2 += sum_of(s->cos2);
  m->ccww = sum_of(s->ccww), m->cwcw = sum_of(s->cwcw);
  double dd_all = 0, cdcd = 0, shift[3] = {0};
  for (int a = 0; m->n > 0 && a < 3; a++) {
    m->cc[a] = sum_of(s->cc[a]), m->c4[a] = sum_of(s->c4[a]);
    double ww = sum_of(s->ww[a]), w3 = sum_of(s->w3[a]), d = sum_of(s->w[a]) / m->n, dd = d * d;
    m->mean_spin[a] += d;
    m->w4[a] = sum_of(s->w4[a]) - 4 * d * w3 + 6 * dd * ww - 3 * m->n * dd * dd;
    m->w3[a] = w3 - 3 * d * ww + 2 * m->n * dd * d;
    m->ww[a] = ww - m->n * dd;
    m->ccww -= 2 * d * sum_of(s->ccw[a]), m->cwcw -= 2 * d * sum_of(s->cwc[a]);
    dd_all += dd, cdcd += dd * m->cc[a], shift[a] = d;
  }
  cdcd += 2 * (shift[0] * shift[1] * m->cxcy + shift[0] * shift[2] * sum_of(s->cxcz) +
               shift[1] * shift[2] * sum_of(s->cycz));
  m->ccww += dd_all * (m->cc[0] + m->cc[1] + m->cc[2]), m->cwcw += cdcd;
}
