/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rheology on planted grains: every quantity against its definition, smooth and rough, one species and two, sheared
 * and cooling. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "common/rng.h"
#include "measure/rheology.h"
#include "measure/velocity_moments.h"
#include "scene/model_of_scene.h"
#include "simd/levels.h"

enum { N = 500 };
static double cx[N], cy[N], cz[N], sx[N], sy[N], sz[N];
static uint8_t kind[N];

static void near(double a, double b)
{
  assert_true(fabs(a - b) <= 1e-11 * fmax(1, fabs(b)));
}

static void plant(uint64_t seed)
{
  gg_rng r = gg_common_rng_seed(seed, 0);
  for (int i = 0; i < N; i++) {
    cx[i] = 2 * gg_common_rng_normal(&r), cy[i] = gg_common_rng_normal(&r) - 0.3 * cx[i],
    cz[i] = gg_common_rng_normal(&r);
    sx[i] = gg_common_rng_normal(&r), sy[i] = 0.5 * gg_common_rng_normal(&r),
    sz[i] = gg_common_rng_normal(&r) - 0.25 + 0.2 * cz[i];
    kind[i] = i % 3 == 0;
  }
}

static gg_model model_of(gg_flow flow, double beta, int species)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow, s.phi = 0.2, s.particles = N, s.n_species = species;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.beta[p] = beta;
  if (species == 2) {
    s.species[0] = (gg_species){333.0 / N, 1, 1, 0.4, 1, 0};
    s.species[1] = (gg_species){167.0 / N, 1.5, 3, 0.5, 1, 0};
  }
  gg_model m;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  return m;
}

/* One row from the planted grains; `factor` scales all velocities (a cooling gas). */
static void take_row_of(const gg_observable *o, void *self, const gg_model *m, const gg_collision_sums *t,
                        double elapsed, double factor, double *row)
{
  static double scaled[6][GG_CHUNK];
  const double *from[6] = {cx, cy, cz, sx, sy, sz};
  o->rows->begin(self);
  for (int start = 0; start < N; start += 200) { /* unequal chunks: 200, 200, 100 */
    int n = start + 200 < N ? 200 : N - start;
    for (int k = 0; k < 6; k++)
      for (int i = 0; i < n; i++) scaled[k][i] = factor * from[k][start + i];
    gg_chunk c = {.n = (size_t)n, .c = {scaled[0], scaled[1], scaled[2]}};
    if (m->rule != GG_SMOOTH)
      for (int a = 0; a < 3; a++) c.s[a] = scaled[3 + a];
    if (m->n_species == 2) c.species = kind + start;
    o->rows->add_chunk(self, &c);
  }
  gg_interval in = {m, t, elapsed, 1};
  o->rows->finish(self, &in, row);
}

static void take_row(void *self, const gg_model *m, const gg_collision_sums *t, double elapsed, double factor,
                     double *row)
{
  take_row_of(&gg_measure_rheology, self, m, t, elapsed, factor, row);
}

static double value(gg_quantity q, const double *row, const gg_model *m)
{
  gg_function f;
  assert_true(gg_measure_derived_find(gg_measure_rheology.rows->derived, q, &f));
  return gg_function_value(f, row, m);
}

/* Sums of an interval: every entry different, so that a swapped component shows. */
static gg_collision_sums planted_transfer(int species)
{
  static const double collisions[] = {100, 20, 30}, loss[] = {7, 5, 3};
  gg_collision_sums t = {.surface = {{.loss = 0}}};
  for (int q = 0; q < 3; q++) {
    int into = species > 1 ? q : GG_11;
    t.collisions[into] += (uint64_t)collisions[q], t.loss[into] += loss[q];
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) t.stress[into][a][b] += 1 + q + 10 * a + 0.7 * b;
  }
  return t;
}

/* Rough grains in shear. */
static void sheared_rough(void **state)
{
  (void)state;
  plant(1);
  gg_model m = model_of(GG_USF, 0, 1);
  double row[64];
  gg_collision_sums t = planted_transfer(m.n_species);
  void *self = gg_measure_rheology.create(&m, NULL);
  take_row(self, &m, &t, 0, 1, row); /* the first sample, which makes no row */
  take_row(self, &m, &t, 0.5, 1, row);
  double T = 0, xx = 0, xy = 0, w = 0, mean[3] = {0}, cos2 = 0, w4 = 0, w2 = 0, w3 = 0, speed = 0;
  double ccww = 0, cwcw = 0;
  double rounded = 0; /* roots in single precision are rounded up or down */
  for (int i = 0; i < N; i++) {
    T += (cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i]) / (3.0 * N), xx += cx[i] * cx[i] / N, xy += cx[i] * cy[i] / N;
    mean[0] += sx[i] / N, mean[1] += sy[i] / N, mean[2] += sz[i] / N;
    speed += sqrt(cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i]) / N;
    rounded += (double)sqrtf((float)(cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i])) / N;
  }
  for (int i = 0; i < N; i++) { /* omega = s/a = 2 s with d = 1 */
    double x = 2 * (sx[i] - mean[0]), y = 2 * (sy[i] - mean[1]), z = 2 * (sz[i] - mean[2]);
    double W2 = x * x + y * y + z * z, C2 = cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i];
    w += W2 / N, cos2 += pow(cx[i] * x + cy[i] * y + cz[i] * z, 2) / (C2 * W2) / N;
    ccww += C2 * W2 / N, cwcw += pow(cx[i] * x + cy[i] * y + cz[i] * z, 2) / N;
    w2 += z * z / N, w3 += z * z * z / N, w4 += z * z * z * z / N;
  }
  double unit = M_PI / 6, V = m.volume, n = m.density, moment = 0.4 / 4; /* I = K m d^2/4 */
  near(value(GG_Q_TEMPERATURE, row, &m), T);
  near(value(GG_Q_ROTATIONAL_TEMPERATURE, row, &m), moment * w / 3);
  near(value(GG_Q_TEMPERATURE_RATIO, row, &m), moment * w / 3 / T);
  near(value(GG_Q_SPIN_Z, row, &m), 2 * mean[2]);
  near(value(GG_Q_P_XX_KINETIC, row, &m), unit * n * xx);
  near(value(GG_Q_P_XY_KINETIC, row, &m), unit * n * xy);
  double Pc_xx = unit * (1 + 2 + 3) / (V * 0.5), Pc_xy = unit * (1.7 + 2.7 + 3.7) / (V * 0.5);
  near(value(GG_Q_P_XX_COLLISIONAL, row, &m), Pc_xx);
  near(value(GG_Q_P_XY_COLLISIONAL, row, &m), Pc_xy);
  near(value(GG_Q_P_YX_COLLISIONAL, row, &m), unit * (11 + 12 + 13) / (V * 0.5));
  near(value(GG_Q_P_XY, row, &m), unit * n * xy + Pc_xy);
  near(value(GG_Q_SHEAR_VISCOSITY, row, &m), fabs(unit * n * xy + Pc_xy));
  double p = value(GG_Q_PRESSURE, row, &m);
  near(p, (value(GG_Q_P_XX, row, &m) + value(GG_Q_P_YY, row, &m) + value(GG_Q_P_ZZ, row, &m)) / 3);
  near(value(GG_Q_N1, row, &m), (value(GG_Q_P_XX, row, &m) - value(GG_Q_P_YY, row, &m)) / p);
  near(value(GG_Q_COLLISION_RATE, row, &m), 2 * 150.0 / (N * 0.5));
  near(value(GG_Q_MEAN_FREE_PATH, row, &m), rounded / (2 * 150.0 / (N * 0.5)));
  assert_true(fabs(rounded / speed - 1) < 1e-8);
  near(value(GG_Q_DISSIPATION, row, &m), unit * 15 / (V * 0.5));
  near(value(GG_Q_COS2_PSI, row, &m), cos2);
  near(value(GG_Q_A11, row, &m), ccww / (3 * T * w) - 1);
  near(value(GG_Q_ORIENTATION_B, row, &m), cwcw / (3 * T * w) - 1.0 / 3);
  near(value(GG_Q_KURTOSIS_WZ, row, &m), w4 / (w2 * w2));
  near(value(GG_Q_SKEWNESS_WZ, row, &m), w3 / pow(w2, 1.5));
  gg_measure_rheology.destroy(self);
}

/* Two species, smooth: partial temperatures and mass-weighted totals. */
static void mixture_has_partial_and_total_temperatures(void **state)
{
  (void)state;
  plant(2);
  gg_model m = model_of(GG_HSS, -1, 2);
  double row[64], T[2] = {0}, c4[2] = {0};
  gg_collision_sums t = planted_transfer(m.n_species);
  void *self = gg_measure_rheology.create(&m, NULL);
  take_row(self, &m, &t, 0.5, 1, row);
  for (int i = 0; i < N; i++) {
    double c2 = cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i];
    T[kind[i]] += c2 / 3 / (kind[i] ? 167 : 333), c4[kind[i]] += c2 * c2 / (kind[i] ? 167 : 333);
  }
  near(value(GG_Q_PARTIAL_TEMPERATURE, row, &m), T[0]);
  near(value(GG_Q_PARTIAL_TEMPERATURE + 1, row, &m), 3 * T[1]);
  near(value(GG_Q_PARTIAL_TEMPERATURE_RATIO, row, &m), T[0] / (3 * T[1]));
  near(value(GG_Q_TEMPERATURE, row, &m), (333 * T[0] + 167 * 3 * T[1]) / N);
  double finite = 1 + 2 / (3.0 * (N - 1));
  near(value(GG_Q_CUMULANT + 1, row, &m), 2 * (c4[1] / (15 * T[1] * T[1]) * finite - 1));
  gg_measure_rheology.destroy(self);
}

/* Two sizes, rough: moments of omega, not of surface velocities; about each species' own mean. */
static void two_sizes(void **state)
{
  (void)state;
  plant(6);
  gg_model m = model_of(GG_USF, 0, 2);
  double row[64], mean[2] = {0}, w2 = 0, w3 = 0, w4 = 0;
  gg_collision_sums t = planted_transfer(m.n_species);
  void *self = gg_measure_rheology.create(&m, NULL);
  take_row(self, &m, &t, 0, 1, row);
  take_row(self, &m, &t, 0.5, 1, row);
  for (int i = 0; i < N; i++) mean[kind[i]] += sz[i] / (kind[i] ? 167 : 333);
  for (int i = 0; i < N; i++) {
    double omega = 2 / m.diameter[kind[i]] * (sz[i] - mean[kind[i]]);
    w2 += pow(omega, 2) / N, w3 += pow(omega, 3) / N, w4 += pow(omega, 4) / N;
  }
  near(value(GG_Q_SPIN_Z, row, &m), 2 * (333 * mean[0] + 167 / 1.5 * mean[1]) / N);
  near(value(GG_Q_KURTOSIS_WZ, row, &m), w4 / (w2 * w2));
  near(value(GG_Q_SKEWNESS_WZ, row, &m), w3 / pow(w2, 1.5));
  gg_measure_rheology.destroy(self);
}

/* The cumulants are those of every instant, also if the temperature fluctuates between samples. */
static void cumulants_are_those_of_each_instant(void **state)
{
  (void)state;
  plant(5);
  for (int species = 1; species <= 2; species++) {
    gg_model m = model_of(GG_HSS, -1, species);
    gg_quantity q = species == 1 ? GG_Q_A2 : GG_Q_CUMULANT + 1;
    double row[2][64] = {{0}}, mean[64];
    gg_collision_sums t = planted_transfer(species);
    void *self = gg_measure_rheology.create(&m, NULL);
    take_row(self, &m, &t, 0.5, 1, row[0]);
    take_row(self, &m, &t, 0.5, 1.3, row[1]);
    for (size_t c = 0; c < 64; c++) mean[c] = 0.5 * (row[0][c] + row[1][c]);
    near(value(q, mean, &m), value(q, row[0], &m));
    gg_measure_rheology.destroy(self);
  }
}

/* Free cooling by Haff's law between two samples: zeta* and the rate in units of the present temperature are exact,
 * at any cooling rate. */
static void cooling_rate_follows_haffs_law(void **state)
{
  (void)state;
  plant(3);
  gg_model m = model_of(GG_HCS, -1, 1);
  double row[64];
  gg_collision_sums none = {0}, t = planted_transfer(m.n_species);
  void *self = gg_measure_rheology.create(&m, NULL);
  take_row(self, &m, &none, 0, 1, row);
  double T0 = 0;
  for (int i = 0; i < N; i++) T0 += (cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i]) / (3.0 * N);
  double zeta = 0.1, dt = 2, growth = zeta * gg_common_model_nu0(&m, 1) / 2, a1 = 1 / sqrt(T0) + growth * dt;
  take_row(self, &m, &t, dt, 1 / (a1 * sqrt(T0)), row);
  near(value(GG_Q_COOLING_RATE, row, &m), zeta);
  near(row[CH_RATE], 2 * 150.0 / (N * log(a1 * sqrt(T0)) / growth));
  near(exp(row[CH_LN_T]), 1 / (a1 * a1));
  near(row[CH_SPECIES + CH_C2X] + row[CH_SPECIES + CH_C2Y] + row[CH_SPECIES + CH_C2Z], 3);
  gg_measure_rheology.destroy(self);
}

/* A gas that cools within an interval while it is sheared slowly: the mean free path is the mean speed of the
 * interval over its rate, not the speed at its end. */
static void path_of_interval(void **state)
{
  (void)state;
  plant(7);
  gg_model m = model_of(GG_SMALL_SHEAR, -1, 1);
  gg_collision_sums none = {0}, t = planted_transfer(1);
  double row[64], speed = 0, dt = 0.5, rate = 2 * 150.0 / (N * dt);
  void *self = gg_measure_rheology.create(&m, NULL);
  take_row(self, &m, &none, 0, 1, row);
  take_row(self, &m, &t, dt, 0.8, row); /* T^(-1/2) from 1 to 1/0.8 */
  for (int i = 0; i < N; i++) speed += (double)sqrtf((float)(cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i])) / N;
  double expected = speed * log(1 / 0.8) / (1 / 0.8 - 1) / rate;
  assert_true(fabs(value(GG_Q_MEAN_FREE_PATH, row, &m) / expected - 1) < 1e-7);
  gg_measure_rheology.destroy(self);
}

/* Sums for least squares of y on a and a^3. */
typedef struct cubic {
  double a2, a4, a6, y1, y3;
} cubic;

static void add_point(cubic *c, double a, double y)
{
  c->a2 += a * a, c->a4 += pow(a, 4), c->a6 += pow(a, 6), c->y1 += y * a, c->y3 += y * a * a * a;
}

static double slope(const cubic *c)
{
  return (c->y1 * c->a6 - c->y3 * c->a4) / (c->a2 * c->a6 - c->a4 * c->a4);
}

/* A gas that cools while it is sheared slowly: from the samples in the range of a*, the slope at 0 of -P_xy/(n T),
 * whose collisional part belongs to the square of the mean of sqrt(T) between the samples. */
static void viscosity_at_no_shear(void **state)
{
  (void)state;
  plant(4);
  gg_model m = model_of(GG_SMALL_SHEAR, -1, 2);
  gg_collision_sums t = planted_transfer(m.n_species);
  double row[64], sum[64] = {0}, T0 = 0, xy = 0, last = 0, elapsed = 0.5;
  for (int i = 0; i < N; i++) {
    double mass = m.mass[kind[i]];
    T0 += mass * (cx[i] * cx[i] + cy[i] * cy[i] + cz[i] * cz[i]) / (3.0 * N), xy += mass * cx[i] * cy[i] / N;
  }
  double impulse = (1.7 + 2.7 + 3.7) / (m.volume * m.density * elapsed),
         first = m.shear_rate / gg_common_model_nu0(&m, T0);
  cubic moving = {0}, touching = {0};
  void *self = gg_measure_viscosity.create(&m, NULL);
  for (int k = 0; k < 40; k++) {
    double a = 0.02 + 0.0025 * k, factor = first / a, T = T0 * factor * factor; /* a* goes as T^(-1/2) */
    take_row_of(&gg_measure_viscosity, self, &m, &t, k ? elapsed : 0, factor, row);
    for (size_t c = 0; c < gg_measure_viscosity.rows->width(&m); c++) sum[c] += row[c];
    if (k && a >= 0.03) {
      double b0 = 1 / sqrt(last), b1 = 1 / sqrt(T), root = log(b1 / b0) / (b1 - b0);
      add_point(&moving, a, -xy / T0);
      add_point(&touching, m.shear_rate / gg_common_model_nu0(&m, root * root), -impulse / (root * root));
    }
    last = T;
  }
  gg_function f;
  assert_true(gg_measure_derived_find(gg_measure_viscosity.rows->derived, GG_Q_VISCOSITY_REDUCED_KINETIC, &f));
  near(gg_function_value(f, sum, &m), slope(&moving));
  assert_true(gg_measure_derived_find(gg_measure_viscosity.rows->derived, GG_Q_VISCOSITY_REDUCED, &f));
  near(gg_function_value(f, sum, &m) / (slope(&moving) + slope(&touching)), 1);
  gg_measure_viscosity.destroy(self);
}

/* Registers of every width leave the bits of the narrowest, also with a last group that is not full. */
static void moments_have_the_same_bits_in_all_sets(void **state)
{
  (void)state;
  const bool here[GG_INSTRUCTION_SETS] = {[GG_AVX2] = gg_has_avx2(), [GG_AVX512] = gg_has_avx512()};
  plant(7);
  for (size_t n = 0; n < 20; n++)
    for (int kind_of = 0; kind_of < 4; kind_of++) {
      const bool quick = kind_of & 1, spins = kind_of & 2;
      const gg_velocity_moment_view v = {n, GG_VELOCITY_MOMENT_LANES, 0.3, {cx, cy, cz}, {spins ? sx : NULL, sy, sz}};
      gg_velocity_moments plain = {.mean_spin = {0.1, -0.2, 0.3}}, none = plain;
      gg_measure_velocity_moments_add_in(GG_BASELINE, &plain, quick, &v);
      for (gg_instructions set = GG_AVX2; set < GG_INSTRUCTION_SETS; set++) {
        if (!here[set]) continue;
        gg_velocity_moments m = none;
        gg_measure_velocity_moments_add_in(set, &m, quick, &v);
        assert_memory_equal(&m, &plain, sizeof m);
      }
    }
}

/* Quantities that a scene does not have, and only those, have a reason. */
static void missing_quantities_have_reasons(void **state)
{
  (void)state;
  gg_model smooth = model_of(GG_USF, -1, 1), rough = model_of(GG_USF, 0, 1);
  assert_non_null(gg_common_quantity_missing(&smooth, GG_Q_TEMPERATURE_RATIO));
  assert_null(gg_common_quantity_missing(&rough, GG_Q_TEMPERATURE_RATIO));
  assert_null(gg_common_quantity_missing(&smooth, GG_Q_TEMPERATURE));
  assert_null(gg_common_quantity_missing(&smooth, GG_Q_N1));
  assert_non_null(gg_common_quantity_missing(&smooth, GG_Q_COOLING_RATE));
  assert_int_equal(gg_measure_rheology.rows->width(&smooth) + CH_ROUGH_WIDTH - CH_SMOOTH_WIDTH,
                   gg_measure_rheology.rows->width(&rough));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sheared_rough),
      cmocka_unit_test(mixture_has_partial_and_total_temperatures),
      cmocka_unit_test(cooling_rate_follows_haffs_law),
      cmocka_unit_test(cumulants_are_those_of_each_instant),
      cmocka_unit_test(two_sizes),
      cmocka_unit_test(path_of_interval),
      cmocka_unit_test(viscosity_at_no_shear),
      cmocka_unit_test(moments_have_the_same_bits_in_all_sets),
      cmocka_unit_test(missing_quantities_have_reasons),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
