/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/one_direction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/vec.h"
#include "theory/hermite/overlap.h"

enum { SIDE = GG_ROUGH_MOST_DEGREE + 1, MOST = 2 * SIDE, APPROACH = 48, CENTRE = 32 };

/* As in factors.c. */
static const double farthest = 12;

static int pairs_up_to(int degree)
{
  return gg_rough_two(0, degree) + 1;
}

/* Ho_n(x) exp(-decay x^2/2) */
static void values(int degree, double decay, double x, double *value)
{
  value[0] = exp(-decay * x * x / 2);
  for (int n = 0; n < degree; n++) value[n + 1] = (x * value[n] - (n ? sqrt(n) * value[n - 1] : 0)) / sqrt(n + 1);
}

static gg_status make_normal(gg_rough_direction *d, const gg_rough_gas *gas, double L, double decay, gg_error *err)
{
  double u[APPROACH], wu[APPROACH], v[CENTRE], wv[CENTRE], one[SIDE], two[SIDE], test[2][SIDE];
  const int n = d->trials + 1;
  GG_TRY(gg_hermite_legendre_rule(APPROACH, u, wu, err));
  GG_TRY(gg_hermite_rule(CENTRE, v, wv, err));
  for (int point = 0; point < APPROACH * CENTRE; point++) {
    const int i = point / CENTRE, j = point % CENTRE;
    const double x = farthest * u[i], g = M_SQRT2 * x, z = (v[j] + x) / M_SQRT2;
    const double w = 4 * M_PI * L * g * farthest * wu[i] * wv[j] * exp(-x * x / 2) / sqrt(2 * M_PI);
    values(d->trials, 0, z, one);
    values(d->trials, 0, z - g, two);
    values(d->tests, decay, z - gas->eta1 * g, test[0]);
    values(d->tests, decay, z, test[1]);
    for (int after = 0; after < 2; after++)
      for (int m = 0; m <= d->tests; m++)
        for (int p = 0; p < n; p++)
          for (int q = 0; q < n; q++) d->normal[after][(m * n + p) * n + q] += w * test[after][m] * one[p] * two[q];
  }
  return GG_OK;
}

/* Data for averages by parts, < F Ho_s(x) > = < d^s F/dx^s >/sqrt(s!): c' and o', the coordinates after a collision,
 * are linear in c_1, c_2, o_1, o_2, with the coefficients `map`. */
typedef struct tangent {
  double map[2][4];
  double (*poly[2])[SIDE + 1]; /* by grain and pair of indices: coefficients of powers of d/dc' in the derivative */
  double *mean;                /* < d^i psi_a(c')/dc'^i d^j psi_b(o')/do'^j >: [pair a, b][i][j] */
  int most;                    /* of i + j */
} tangent;

static void multiply(double *poly, int degree, double c, double o) /* by c X + o Y */
{
  poly[degree + 1] = 0;
  for (int k = degree + 1; k >= 0; k--) poly[k] = o * poly[k] + (k ? c * poly[k - 1] : 0);
}

static void make_polynomials(tangent *t, int trials)
{
  for (int grain = 0; grain < 2; grain++)
    for (int s = 0; s <= trials; s++)
      for (int r = 0; s + r <= trials; r++) {
        double *poly = t->poly[grain][gg_rough_two(s, r)];
        poly[0] = 1 / sqrt(tgamma(s + 1.) * tgamma(r + 1.));
        for (int k = 0; k < s + r; k++) {
          const int from = k < s ? grain : 2 + grain;
          multiply(poly, k, t->map[0][from], t->map[1][from]);
        }
      }
}

/* [i]: d^i psi_a/dx^i, a up to `tests`. */
static void derivatives(int tests, int most, double decay, double x, double (*d)[MOST + SIDE])
{
  values(tests + most, decay, x, d[0]);
  for (int i = 0; i < most; i++)
    for (int a = 0; a <= tests + most - i - 1; a++)
      d[i + 1][a] = (a ? sqrt(a) * (1 - decay) * d[i][a - 1] : 0) - decay * sqrt(a + 1) * d[i][a + 1];
}

/* A rule for c' and o' with the decays in their Gaussian: Sigma (1 + D Sigma)^-1. */
static gg_status make_means(tangent *t, int tests, const gg_rough_choice *decays, gg_error *err)
{
  enum { POINTS = 28 };
  double x[POINTS], w[POINTS], c[2][2] = {{0}}, (*d)[MOST][MOST + SIDE] = malloc(2 * sizeof *d);
  gg_status status = d ? gg_hermite_rule(POINTS, x, w, err) : gg_base_out_of_memory(err);
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 4; k++) c[k / 2][k % 2] += t->map[k / 2][i] * t->map[k % 2][i];
  const double a = decays->decay, b = decays->spin_decay, det = c[0][0] * c[1][1] - c[0][1] * c[0][1];
  const double norm = 1 + a * c[0][0] + b * c[1][1] + a * b * det;
  const double cc = (c[0][0] + b * det) / norm, oo = (c[1][1] + a * det) / norm, co = c[0][1] / norm;
  const double first = sqrt(cc), second = co / first, third = sqrt(fmax(oo - second * second, 0));
  const int n = t->most + 1;
  for (int point = 0; status == GG_OK && point < POINTS * POINTS; point++) {
    const double one = first * x[point / POINTS], two = second * x[point / POINTS] + third * x[point % POINTS];
    const double weight = w[point / POINTS] * w[point % POINTS] * exp((a * one * one + b * two * two) / 2) / sqrt(norm);
    derivatives(tests, t->most, a, one, d[0]);
    derivatives(tests, t->most, b, two, d[1]);
    for (int r = 0; r <= tests; r++)
      for (int s = 0; r + s <= tests; s++) {
        double *mean = t->mean + (size_t)gg_rough_two(r, s) * (size_t)(n * n);
        for (int i = 0; i < n; i++)
          for (int j = 0; i + j < n; j++) mean[i * n + j] += weight * d[0][i][r] * d[1][j][s];
      }
  }
  free(d);
  return status;
}

static gg_status combine(gg_rough_direction *d, const tangent *t, const gg_stop *stop, gg_error *err)
{
  const int tests = pairs_up_to(d->tests), trials = pairs_up_to(d->trials), n = t->most + 1;
  for (int s = 0, one = 0; one < trials; s++)
    for (int k = 0; k <= s; k++, one++) {
      GG_TRY(gg_stop_check(stop, err));
      for (int r = 0, two = 0; two < trials; r++)
        for (int l = 0; l <= r; l++, two++) {
          double product[MOST] = {0};
          for (int i = 0; i <= s; i++)
            for (int j = 0; j <= r; j++) product[i + j] += t->poly[0][one][i] * t->poly[1][two][j];
          for (int m = 0; m < tests; m++) {
            double sum = 0;
            for (int i = 0; i <= s + r; i++)
              sum += product[i] * t->mean[((size_t)m * (size_t)n + (size_t)i) * (size_t)n + (size_t)(s + r - i)];
            d->along[0][(m * trials + one) * trials + two] = d->along[1][(m * trials + two) * trials + one] = sum;
          }
        }
    }
  return GG_OK;
}

static gg_status make_along(gg_rough_direction *d, const gg_rough_gas *gas, double ratio, const gg_rough_choice *decays,
                            gg_error *err)
{
  const double h = gas->eta2, k = gas->K;
  tangent t = {.map = {{1 - h, h, -h * ratio, -h * ratio}, {-h / (k * ratio), h / (k * ratio), 1 - h / k, -h / k}},
               .most = 2 * d->trials};
  const size_t n = (size_t)t.most + 1;
  t.mean = calloc((size_t)pairs_up_to(d->tests) * n * n, sizeof *t.mean);
  for (int grain = 0; grain < 2; grain++)
    t.poly[grain] = malloc((size_t)pairs_up_to(d->trials) * sizeof *t.poly[grain]);
  gg_status status = t.mean && t.poly[0] && t.poly[1] ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) {
    make_polynomials(&t, d->trials);
    status = make_means(&t, d->tests, decays, err);
  }
  if (status == GG_OK) status = combine(d, &t, gas->stop, err);
  free(t.mean);
  free(t.poly[0]);
  free(t.poly[1]);
  return status;
}

static gg_status make_kept(gg_rough_direction *d, const gg_rough_choice *decays, gg_error *err)
{
  for (int k = 0; k < 2; k++) {
    gg_hermite_overlap o;
    gg_status status =
        gg_hermite_overlap_make(&o, d->tests + 1, d->trials + 1, k ? decays->spin_decay : decays->decay, err);
    if (status == GG_OK) gg_hermite_overlap_at(&o, 0, d->kept[k]);
    gg_hermite_overlap_clear(&o);
    GG_TRY(status);
  }
  return GG_OK;
}

gg_status gg_rough_direction_make(gg_rough_direction *d, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                  const gg_rough_choice *decays, int tests, int trials, gg_error *err)
{
  *d = (gg_rough_direction){.tests = tests, .trials = trials};
  const size_t m = (size_t)tests + 1, n = (size_t)trials + 1, pairs = (size_t)pairs_up_to(trials);
  const size_t all = (size_t)pairs_up_to(tests) * pairs * pairs;
  d->along[0] = malloc(2 * all * sizeof *d->along[0]);
  d->normal[0] = calloc(2 * m * n * n + 2 * m * n, sizeof *d->normal[0]);
  gg_status status = d->along[0] && d->normal[0] ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) {
    d->along[1] = d->along[0] + all;
    d->normal[1] = d->normal[0] + m * n * n;
    d->kept[0] = d->normal[1] + m * n * n, d->kept[1] = d->kept[0] + m * n;
    status = make_normal(d, gas, weight->L[0][0], decays->decay, err);
  }
  if (status == GG_OK) status = make_along(d, gas, weight->S[0][0] / weight->L[0][0], decays, err);
  if (status == GG_OK) status = make_kept(d, decays, err);
  if (status != GG_OK) gg_rough_direction_clear(d);
  return status;
}

void gg_rough_direction_clear(gg_rough_direction *d)
{
  free(d->along[0]);
  free(d->normal[0]);
  *d = (gg_rough_direction){0};
}

static double kept(const gg_rough_direction *d, int axis, const int *test, const int *one)
{
  return (test[axis] + one[axis]) % 2 ? 0 : d->kept[axis / 3][test[axis] * (d->trials + 1) + one[axis]];
}

/* A row of the tables along which a sum runs; the other indices are fixed. */
typedef struct row {
  const double *x, *y, *z;
  int stride; /* of z */
} row;

static row row_of(const gg_rough_direction *d, const int *test, const int *fixed, bool swapped)
{
  const size_t pairs = (size_t)pairs_up_to(d->trials);
  const int n = d->trials + 1;
  const size_t x = (size_t)gg_rough_two(test[0], test[4]), y = (size_t)gg_rough_two(test[1], test[3]);
  return (row){d->along[swapped] + (x * pairs + (size_t)gg_rough_two(fixed[0], fixed[4])) * pairs,
               d->along[swapped] + (y * pairs + (size_t)gg_rough_two(fixed[1], fixed[3])) * pairs,
               d->normal[0] + test[2] * n * n + fixed[2] * (swapped ? 1 : n), swapped ? n : 1};
}

/* The value before the collision, of grain 1, with a partner at rest but along z. */
static double before(const gg_rough_direction *d, const int *test, const int *one, const int *two)
{
  const int n = d->trials + 1;
  double value = d->normal[1][(test[2] * n + one[2]) * n + two[2]];
  for (int axis = 0; axis < 5; axis++)
    if (axis != 2) value *= kept(d, axis, test, one);
  return value;
}

static bool at_rest(const int *r)
{
  return r[0] + r[1] + r[3] + r[4] == 0;
}

/* `swapped` is constant: what depends on the fixed grain alone is computed once. */
GG_INLINE double sum_over(const gg_rough_direction *d, const int *test, const int *fixed, const bool swapped,
                          const gg_rough_term *terms, int n)
{
  static const double sign[2] = {1, -1}; /* as for the other pair, but for the sign of the spin */
  if (swapped ? fixed[5] != 0 : (test[5] + fixed[5]) % 2 != 0) return 0;
  const row at = row_of(d, test, fixed, swapped);
  const double *spin = d->kept[1] + test[5] * (d->trials + 1);
  const bool rest = at_rest(fixed);
  double sum = 0;
  for (int k = 0; k < n; k++) {
    const gg_rough_term *t = &terms[k];
    if (swapped ? (test[5] ^ t->r[5]) & 1 : t->r[5]) continue;
    double value = at.x[t->x] * at.y[t->y] * at.z[t->r[2] * at.stride] * sign[(test[3] ^ fixed[3] ^ t->r[3]) & 1];
    if (swapped ? rest : at_rest(t->r)) value -= before(d, test, swapped ? t->r : fixed, swapped ? fixed : t->r);
    sum += t->value * spin[swapped ? t->r[5] : fixed[5]] * value;
  }
  return sum;
}

double gg_rough_direction_sum(const gg_rough_direction *d, const int *test, const int *fixed, bool swapped,
                              const gg_rough_term *terms, int n)
{
  return swapped ? sum_over(d, test, fixed, true, terms, n) : sum_over(d, test, fixed, false, terms, n);
}

double gg_rough_direction_kept(const gg_rough_direction *d, const int *test, const int *one)
{
  double value = 1;
  for (int axis = 0; axis < GG_ROUGH_AXES && value != 0; axis++) value *= kept(d, axis, test, one);
  return value;
}
