/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums of velocity moments in registers of GG_LANES numbers, for a set of instructions (GG_TARGET). Included once for
 * each, with GG_OF(name) for the names. Vectors wider than a register would be kept in memory and copied
 * piece by piece. The eight sums of each moment are taken GG_LANES at a time. */

#define lanes GG_OF(lanes)
#define singles GG_OF(singles)
#define masks GG_OF(masks)
#define lane_sums GG_OF(lane_sums)

typedef double lanes __attribute__((vector_size(GG_LANES * sizeof(double))));
typedef float singles __attribute__((vector_size(GG_LANES * sizeof(float))));
typedef int64_t masks __attribute__((vector_size(GG_LANES * sizeof(int64_t))));

/* The members of gg_velocity_moment_sums, in the same order. */
typedef struct lane_sums {
  lanes cc[3], cxcy, c4[3], cccc, speed;
  lanes w[3], ww[3], w3[3], w4[3], cos2, ccww, cwcw, ccw[3], cwc[3], cxcz, cycz;
} lane_sums;

GG_INLINE lanes GG_OF(load)(const double *x)
{
  lanes v;
  memcpy(&v, x, sizeof v);
  return v;
}

GG_INLINE lanes GG_OF(in_double)(singles x)
{
  lanes d;
  for (int l = 0; l < GG_LANES; l++) d[l] = (double)x[l];
  return d;
}

/* Roots of doubles would take more time than all the sums; in single precision they take a quarter of it. */
GG_INLINE lanes GG_OF(root_of)(bool quick, lanes x)
{
  lanes root = {0};
  if (!quick) {
    for (int l = 0; l < GG_LANES; l++) root[l] = __builtin_sqrt(x[l]);
    return root;
  }
  singles s = __builtin_convertvector(x, singles);
  for (int l = 0; l < GG_LANES; l++) s[l] = __builtin_sqrtf(s[l]);
  return GG_OF(in_double)(s);
}

/* A grain in each lane; returns C.C. */
GG_INLINE lanes GG_OF(translation)(lane_sums *a, bool quick, const lanes c[3])
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
  a->speed += GG_OF(root_of)(quick, all);
  return all;
}

/* c2: C.C */
GG_INLINE void GG_OF(rotation)(lane_sums *a, const lanes c[3], lanes c2, const lanes w[3])
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

/* Lanes from index `at` of the view. */
GG_INLINE void GG_OF(add_group)(lane_sums *a, const double mean[3], bool quick, bool spins,
                                const gg_velocity_moment_view *v, size_t at)
{
  lanes c[3], w[3], c2;
  for (int k = 0; k < 3; k++) c[k] = GG_OF(load)(v->c[k] + at);
  c[0] -= v->strain * c[1];
  c2 = GG_OF(translation)(a, quick, c);
  if (!spins) return;
  for (int k = 0; k < 3; k++) w[k] = GG_OF(load)(v->s[k] + at) - mean[k];
  GG_OF(rotation)(a, c, c2, w);
}

/* All groups, and a group of the last grains (NULL: none). The sums stay in registers as far as possible. */
GG_INLINE void GG_OF(add)(gg_velocity_moments *m, bool quick, bool spins, const gg_velocity_moment_view *view,
                          const gg_velocity_moment_view *rest)
{
  const gg_velocity_moment_view v = *view;
  const double mean[3] = {m->mean_spin[0], m->mean_spin[1], m->mean_spin[2]};
  const int n = sizeof(lane_sums) / sizeof(lanes), n_used = spins ? n : 9;
  for (size_t at = 0; at < LANES; at += GG_LANES) {
    double *to = (double *)&m->sums + at;
    lane_sums a;
    for (int i = 0; i < n_used; i++) memcpy((lanes *)&a + i, to + i * LANES, sizeof(lanes));
    for (size_t g = 0; g < v.n / LANES; g++) GG_OF(add_group)(&a, mean, quick, spins, &v, g * v.stride + at);
    if (rest) GG_OF(add_group)(&a, mean, quick, spins, rest, at);
    for (int i = 0; i < n_used; i++) memcpy(to + i * LANES, (lanes *)&a + i, sizeof(lanes));
  }
}

#define INSTANCE(quick, spins)                                                                                         \
  GG_TARGET static void GG_OF(add_##quick##_##spins)(gg_velocity_moments * m, const gg_velocity_moment_view *v,        \
                                                     const gg_velocity_moment_view *rest)                              \
  {                                                                                                                    \
    GG_OF(add)(m, quick, spins, v, rest);                                                                              \
  }
INSTANCE(0, 0)
INSTANCE(0, 1)
INSTANCE(1, 0)
INSTANCE(1, 1)
static add_grains *const GG_OF(instances)[2][2] = {{GG_OF(add_0_0), GG_OF(add_0_1)}, {GG_OF(add_1_0), GG_OF(add_1_1)}};

#undef INSTANCE
#undef lanes
#undef singles
#undef masks
#undef lane_sums
#undef GG_LANES
#undef GG_OF
#undef GG_TARGET
