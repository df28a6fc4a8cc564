/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Self-diffusion: grains that keep a known fraction of their velocity from step to step have known correlations and
 * displacements, under shear and through the boundaries of small boxes, two species apart, at lags up to the
 * longest; so have those whose C_y becomes C_x, and grains that cool; both engines have the theory's tensor under
 * shear; a planted long-time tail is found; an elastic dilute gas has the coefficient of Chapman and Enskog, also
 * in a box far shorter than its free paths, a dense one the published coefficient. */
#include <stdio.h>

#include "curve_test.h"
#include "graingas.h"
#include "measure/long_time_tail.h"
#include "scene/model_of_scene.h"

#define STEP 0.2
static const double keep[2] = {0.9, 0.8};
static double tilt; /* the part of C_y that is taken from C_x in a step */

/* Each step: everything moves by C dt (and with the flow), then C = keep C + noise; the image of the box above is
 * displaced further. */
static void walk(gg_snapshot *s, gg_rng *r, int sample)
{
  const double *L = s->model->box, rate = s->model->shear_rate;
  s->elapsed = STEP;
  if (sample == 0) s->offset = rate != 0 ? 0.3 * L[0] : 0;
  if (sample) s->offset += rate * L[1] * STEP, s->offset -= L[0] * floor(s->offset / L[0]);
  for (size_t i = 0; i < s->n; i++) {
    double share = keep[gg_snapshot_species(s, i)], step[3] = {0, 0, 0}, layers;
    for (int a = 0; a < 3; a++) {
      if (sample == 0) s->r[a][i] = L[a] * gg_rng_uniform(r), s->c[a][i] = gg_common_rng_normal(r);
      if (sample) step[a] = s->c[a][i] * STEP;
    }
    if (sample) step[0] += rate * (s->r[1][i] + step[1] / 2 - L[1] / 2) * STEP;
    for (int a = 0; a < 3; a++) s->r[a][i] += step[a];
    layers = floor(s->r[1][i] / L[1]);
    s->r[0][i] -= layers * s->offset;
    const double taken = sample ? tilt * s->c[1][i] : 0;
    for (int a = 0; a < 3; a++) {
      s->r[a][i] -= L[a] * floor(s->r[a][i] / L[a]);
      if (sample) s->c[a][i] = share * s->c[a][i] + sqrt(1 - share * share) * gg_common_rng_normal(r);
    }
    s->c[0][i] -= taken;
  }
}

static double memory(double t, const void *context)
{
  return pow(*(const double *)context, round(t / STEP));
}
static double squared(double t, const void *context)
{
  double share = *(const double *)context, k = round(t / STEP), sum = k;
  for (double j = 1; j < k; j++) sum += 2 * (k - j) * pow(share, j);
  return sum * STEP * STEP;
}

static void walkers_have_their_known_correlations(void **state)
{
  (void)state;
  for (int species = 1; species <= 2; species++) {
    gg_model m = ct_model(GG_USF, 0.2, -1, 1000, species);
    m.shear_rate = 0.7;
    gg_curves list = ct_curves(&gg_measure_diffusion, &m, 4000, walk, 96);
    for (int k = 0; k < species; k++)
      for (int a = 0; a < 3; a++) {
        char name[64], tail[8] = "";
        if (species == 2) snprintf(tail, sizeof tail, "_%d", k + 1);
        snprintf(name, sizeof name, "velocity_autocorrelation_C%c%s", "xyz"[a], tail);
        const gg_curve *c = ct_find(&list, name);
        snprintf(name, sizeof name, "displacement_squared_%c%s", "xyz"[a], tail);
        const gg_curve *r = ct_find(&list, name);
        assert_true(fabs(c->x[10] - 10 * STEP) < 1e-9);
        /* neighbouring lags have common noise: chi^2 scatters more than for independent points */
        assert_true(ct_chi2(c, 0, 28, memory, &keep[k]) < 3.5);
        assert_true(ct_chi2(r, 1, 34, squared, &keep[k]) < 3.5); /* up to a tenth of the run */
        assert_true(fabs(c->x[51] - 15 * 64 * STEP) < 1e-9);
        double D = STEP * (0.5 + keep[k] / (1 - keep[k]));
        gg_curve_number p = ct_number(c, "diffusion_green_kubo");
        ct_expect("Green and Kubo", p.value, p.error, D, 0.4 * D);
        p = ct_number(r, "diffusion_einstein");
        ct_expect("Einstein", p.value, p.error, D, 0.4 * D);
      }
    gg_measure_curves_clear(&list);
  }
}

/* C_x loses a part of C_y at each step: <C_x(t)C_y(0)> = k^j p - tilt j k^(j-1) after j steps, <C_y(t)C_x(0)> = k^j p,
 * with p = -tilt k/(1 - k^2); sums of both, the first term by half, are the mixed coefficients. */
static void shear_makes_mixed_components(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.2, -1, 1000, 1);
  m.shear_rate = 0.7;
  tilt = 0.05;
  gg_curves list = ct_curves(&gg_measure_diffusion, &m, 4000, walk, 97);
  const double k = keep[0], p = -tilt * k / (1 - k * k), later = STEP * (p * (0.5 + k / (1 - k)));
  const double expected[2] = {later - STEP * tilt / ((1 - k) * (1 - k)), later};
  static const char *const names[2] = {"velocity_autocorrelation_Cx_Cy", "velocity_autocorrelation_Cy_Cx"};
  tilt = 0;
  for (int i = 0; i < 2; i++) {
    gg_curve_number D = ct_number(ct_find(&list, names[i]), "diffusion_green_kubo");
    ct_expect(names[i], D.value, D.error, expected[i], 0.3);
  }
  gg_curve_number D = ct_number(ct_find(&list, "displacement_product_xy"), "diffusion_einstein");
  ct_expect("displacement_product_xy", D.value, D.error, (expected[0] + expected[1]) / 2, 0.3);
  gg_measure_curves_clear(&list);
}

/* Velocities in units of v_0 keep a fraction in a step of int v_0 dt = STEP, while v_0 falls to FALL of itself. Every
 * sixteen steps all velocities are made larger, and times shorter. */
#define FALL 0.97
static double v_0 = 1, scaled = 1;
static void walk_in_cooling_gas(gg_snapshot *s, gg_rng *r, int sample)
{
  if (sample == 0) v_0 = scaled = 1;
  walk(s, r, sample); /* velocities in units of v_0, of variance 1 */
  v_0 *= sample ? FALL : 1;
  s->elapsed = STEP * (1 - FALL) / log(1 / FALL) / v_0; /* path = time v v' ln(v/v')/(v - v') */
}

static void a_cooling_gas_is_stationary_in_its_own_time(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.2, -1, 1000, 1);
  assert_null(gg_measure_diffusion.refuses(&m));
  gg_bins bins;
  gg_snapshot s, seen;
  gg_rng r = gg_common_rng_seed(98, 0);
  const gg_observable *o = &gg_measure_diffusion;
  void *self = o->create(&m, NULL);
  assert_int_equal(gg_measure_snapshot_init(&s, &m, true, NULL), GG_OK);
  assert_int_equal(gg_measure_snapshot_init(&seen, &m, true, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_init(&bins, o->curves->bins(self), NULL), GG_OK);
  for (size_t i = 0; i < s.n; i++) s.id[i] = seen.id[i] = (int64_t)i;
  o->restart(self);
  for (int k = 0; k < 4000; k++) {
    if (k % 16 == 15) o->rescaled(self, 2), scaled *= 2;
    walk_in_cooling_gas(&s, &r, k);
    seen.elapsed = s.elapsed / scaled;
    for (size_t i = 0; i < s.n; i++)
      for (int a = 0; a < 3; a++)
        seen.r[a][i] = s.r[a][i], seen.c[a][i] = s.c[a][i] * v_0 * scaled * sqrt(m.temperature0);
    o->curves->add_snapshot(self, &seen, gg_statistics_bins_sample(&bins));
    gg_statistics_bins_commit(&bins);
  }
  const gg_bins *of_run[] = {&bins};
  gg_curves list = {.model = &m};
  assert_int_equal(gg_measure_curves_estimate(of_run, 1, o->curves->of_bins, self, o->name, 0, &list, NULL), GG_OK);
  const gg_curve *d = ct_find(&list, "displacement_squared_y");
  assert_true(fabs(d->x[10] - 10 * STEP) < 0.05 * STEP); /* T scatters by 3 % */
  assert_true(ct_chi2(d, 1, 34, squared, &keep[0]) < 3.5);
  for (int a = 0; a < 3; a++) {
    char name[64];
    snprintf(name, sizeof name, "velocity_autocorrelation_C%c", "xyz"[a]);
    const gg_curve *c = ct_find(&list, name);
    gg_curve_number D = ct_number(c, "diffusion_green_kubo");
    const double expected = STEP * (0.5 + keep[0] / (1 - keep[0])) * sqrt(m.temperature0);
    ct_expect(name, D.value, D.error, expected, 0.4 * expected);
    snprintf(name, sizeof name, "displacement_squared_%c", "xyz"[a]);
    D = ct_number(ct_find(&list, name), "diffusion_einstein");
    ct_expect(name, D.value, D.error, STEP * (0.5 + keep[0] / (1 - keep[0])), 0.2);
  }
  gg_measure_curves_clear(&list);
  gg_statistics_bins_clear(&bins);
  gg_measure_snapshot_clear(&s);
  gg_measure_snapshot_clear(&seen);
  o->destroy(self);
}

/* The tail beyond t is the sum over the modes of the box. If it is planted on D(t) without noise, the fit finds D
 * and its amplitude, whatever the expected value; if all is noise, the result is the expected value, with its
 * uncertainty. */
static void planted_tail(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    gg_scene s = gg_scene_defaults();
    s.flow = GG_EQUILIBRIUM, s.phi = 0.26, s.particles = 500, s.aspect[1] = k == 2 ? 2 : 1;
    for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
    gg_model m;
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
    gg_long_time_tail tail = k ? gg_measure_long_time_tail_of(&m, 0.5) : gg_measure_long_time_tail_driven(0.01, 3);
    gg_running at[10];
    double sum = 0, beyond = gg_measure_long_time_tail_beyond(&tail, 3);
    for (int x = -12; x <= 12 && k; x++)
      for (int y = -12; y <= 12; y++)
        for (int z = -12; z <= 12; z++) {
          double rate = x * x * tail.rate[0] + y * y * tail.rate[1] + z * z * tail.rate[2];
          if (rate > 0) sum += tail.strength * exp(-3 * rate) / rate;
        }
    if (k) assert_true(fabs(beyond / sum - 1) < 1e-4);
    for (int noisy = 0; noisy < 2; noisy++) {
      for (int i = 0; i < 10; i++) {
        double t = 3 * pow(1.3, i);
        at[i] = (gg_running){t, 0.2 - 1.7 * gg_measure_long_time_tail_beyond(&tail, t), noisy ? 1e6 : 1e-12};
      }
      gg_coefficient D = gg_measure_long_time_tail_coefficient(&tail, at, 10);
      double expected = noisy ? at[0].D + tail.amplitude * beyond : 0.2;
      assert_true(fabs(D.D - expected) < 1e-6 && fabs(D.tail - (expected - at[0].D)) < 1e-6);
      assert_true(noisy ? fabs(D.unsure / (beyond * tail.tolerance) - 1) < 1e-3 : D.unsure < 1e-6);
    }
  }
}

/* Finite-size correction: 2.837297 T/(6 pi eta L) for a cube, eta of elastic grains by Enskog (Chapman & Cowling,
 * 16.41 and the 1.016 of the higher approximations); for another box the sum over its modes, here by brute force. */
static void lacking_of_boxes(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    gg_scene s = gg_scene_defaults();
    gg_model m;
    const double T = 0.7;
    s.flow = GG_EQUILIBRIUM, s.phi = 0.3, s.particles = 300, s.aspect[1] = k == 1 ? 2 : 1, s.aspect[2] = k == 2 ? 3 : 1;
    for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
    const double n = m.density, chi = m.chi[0], b = 1.6 * m.phi * chi, is = gg_measure_long_time_tail_lacking(&m, T);
    const double eta =
        1.016 * 5 / 16. * sqrt(T / M_PI) * ((1 + b) * (1 + b) / chi + 768 / (25 * M_PI) * m.phi * m.phi * chi);
    double expected = 2.837297 * T / (6 * M_PI * eta * m.box[0]);
    if (k) { /* (2/3) T/eta (integral - sum over k /= 0)/k^2, both with a Gaussian cut at wave vectors 1/width */
      const double width = 0.12 * m.box[0];
      enum { MOST = 40 };
      double sum = 0, whole = 1 / (4 * pow(M_PI, 1.5) * width);
      for (int x = -MOST; x <= MOST; x++)
        for (int y = -MOST; y <= MOST; y++)
          for (int z = -MOST; z <= MOST; z++) {
            const double k2 =
                pow(2 * M_PI * x / m.box[0], 2) + pow(2 * M_PI * y / m.box[1], 2) + pow(2 * M_PI * z / m.box[2], 2);
            if (k2 > 0) sum += exp(-k2 * width * width) / k2;
          }
      /* the cut removes width^2 for the missing mode k = 0 */
      expected = 2 / 3. * T / eta * (whole - sum / m.volume + width * width / m.volume);
    }
    assert_true(fabs(n * m.volume - 300) < 1e-9 && fabs(is / expected - 1) < (k ? 1e-5 : 1e-6));
  }
}

static void diffuse(double phi, int64_t n, double collisions, double T_and_D[7])
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = phi, s.particles = n;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
  s.run.collisions = collisions;
  s.measure |= GG_MEASURE_DIFFUSION;
  gg_result *r = ct_run(s);
  static const char *const numbers[] = {"diffusion_green_kubo", "diffusion_einstein", "diffusion_infinite_system"};
  double mean[3] = {0, 0, 0}, variance[3] = {0, 0, 0};
  for (int a = 0; a < 3; a++)
    for (int k = 0; k < 3; k++) {
      char name[64];
      snprintf(name, sizeof name, k == 1 ? "displacement_squared_%c" : "velocity_autocorrelation_C%c", "xyz"[a]);
      gg_curve_number p = ct_number(ct_find(&r->curves, name), numbers[k]);
      mean[k] += p.value / 3, variance[k] += p.error * p.error / 9;
    }
  T_and_D[0] = r->value[GG_Q_TEMPERATURE].mean;
  for (int k = 0; k < 3; k++) T_and_D[1 + 2 * k] = mean[k], T_and_D[2 + 2 * k] = sqrt(variance[k]);
  gg_result_free(r);
}

/* phi = 0.02, e = 1: D = 1.01896 x 3/(8 n d^2 chi) sqrt(T/pi) (Chapman & Cowling; Enskog's chi), valid to a few per
 * mille in molecular dynamics at this density. */
static void dilute_gas(void **state)
{
  (void)state;
  double is[7];
  diffuse(0.02, 1000, 1500, is);
  double n = 0.02 * 6 / M_PI, chi = 0.99 / pow(0.98, 3), expected = 1.01896 * 3 / (8 * n * chi) * sqrt(is[0] / M_PI);
  ct_expect("D, Green and Kubo", is[1], hypot(is[2], 0.004 * expected), expected, 0.1 * expected);
  ct_expect("D, Einstein", is[3], hypot(is[4], 0.004 * expected), expected, 0.1 * expected);
}

/* n d^3 = 0.5, 500 grains: the published values, D = (3/8 n) sqrt(T/pi) (1 - n/1.09)(1 + n^2 (0.4 - 0.83 n^2))
 * (Speedy, Mol. Phys. 62 (1987) 509), a few hundred grains each, to 1 %. With a cut at 16 collisions a grain both
 * estimates would be 3 to 6 % low, and differ by three per cent. */
static void dense_gas(void **state)
{
  (void)state;
  double is[7], n = 0.5;
  diffuse(M_PI / 12, 500, 8000, is);
  double expected = 3 / (8 * n) * sqrt(is[0] / M_PI) * (1 - n / 1.09) * (1 + n * n * (0.4 - 0.83 * n * n));
  ct_expect("D, Green and Kubo", is[1], hypot(is[2], 0.01 * expected), expected, 0.05 * expected);
  ct_expect("D, Einstein", is[3], hypot(is[4], 0.01 * expected), expected, 0.05 * expected);
  ct_expect("D, both", is[1], hypot(is[2], is[4]), is[3], 0.03 * expected);
}

/* D of 250 grains is 7 % below that of 2000, because of their boxes; the extrapolations to the infinite system
 * agree. */
static void boxes_of_two_sizes(void **state)
{
  (void)state;
  double small[7], large[7];
  diffuse(M_PI / 12, 250, 12000, small);
  diffuse(M_PI / 12, 2000, 1500, large);
  assert_true(large[1] - small[1] > 5 * hypot(large[2], small[2]));
  ct_expect("D of the infinite system", small[5], hypot(small[6], large[6]), large[5], 0.04 * large[5]);
}

/* Free paths longer than the box: the larger of two kinds of grains collides several times between two snapshots.
 * The first approximation of Chapman & Cowling, D_i = T/(sum_j (8/3) n_j sigma_ij^2 sqrt(2 pi m_ij T)), m_ij the
 * reduced mass, is right to some per cent; with images selected by the velocities at snapshots alone D is half as
 * much again. */
static void box_shorter_than_free_paths(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = 1e-3, s.particles = 200;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
  s.n_species = 2;
  s.species[0] = (gg_species){0.95, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.05, 10, 1, 0.4, 1, 0};
  s.run.collisions = 1500;
  s.measure |= GG_MEASURE_DIFFUSION;
  gg_model m;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  gg_result *r = ct_run(s);
  double T = r->value[GG_Q_TEMPERATURE].mean;
  for (int i = 0; i < 2; i++) {
    double friction = 0, mean = 0, variance = 0;
    for (int j = 0; j < 2; j++) {
      double sigma = m.sigma[gg_pair(i, j)], reduced = m.mass[i] * m.mass[j] / (m.mass[i] + m.mass[j]);
      friction += 8.0 / 3 * m.density * (double)m.n_of[j] / (double)m.n * sigma * sigma * sqrt(2 * M_PI * reduced * T);
    }
    for (int a = 0; a < 3; a++) {
      char name[64];
      snprintf(name, sizeof name, "displacement_squared_%c_%d", "xyz"[a], i + 1);
      gg_curve_number D = ct_number(ct_find(&r->curves, name), "diffusion_einstein");
      mean += D.value / 3, variance += D.error * D.error / 9;
    }
    ct_expect("D", mean, hypot(sqrt(variance), 0.02 * T / friction), T / friction, 0.25 * T / friction);
  }
  gg_result_free(r);
}

/* Under shear Monte Carlo has the tensor that follows from the measured stress, D_xy and D_yx apart, to the per cent or
 * three by which second Sonine approximations differ from first ones; half the slope of <dx dy> is the mean of both. */
static void sheared_monte_carlo_has_the_tensor_of_theory(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC, s.flow = GG_USF, s.phi = 0.05, s.dsmc.particles = 4000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.8;
  s.run.collisions = 1000;
  s.measure |= GG_MEASURE_DIFFUSION;
  gg_result *r = ct_run(s);
  static const char *const names[] = {"Cx", "Cy", "Cz", "Cx_Cy", "Cy_Cx"};
  static const double sight[] = {0.12, 0.12, 0.12, 0.2, 0.4};
  gg_curve_number D[5];
  for (int a = 0; a < 5; a++) {
    char name[64];
    snprintf(name, sizeof name, "velocity_autocorrelation_%s", names[a]);
    const gg_curve *c = ct_find(&r->curves, name);
    D[a] = ct_number(c, "diffusion_green_kubo");
    const double expected = ct_number(c, "diffusion_first_sonine").value;
    ct_expect(names[a], D[a].value, hypot(D[a].error, 0.01 * expected), expected, sight[a] * fabs(expected));
  }
  assert_true(D[4].value - D[3].value > 20 * hypot(D[3].error, D[4].error)); /* no symmetry */
  gg_curve_number xy = ct_number(ct_find(&r->curves, "displacement_product_xy"), "diffusion_einstein");
  ct_expect("half the slope of <dx dy>", xy.value, hypot(xy.error, hypot(D[3].error, D[4].error) / 2),
            (D[3].value + D[4].value) / 2, 0.2 * fabs(xy.value));
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walkers_have_their_known_correlations),
      cmocka_unit_test(shear_makes_mixed_components),
      cmocka_unit_test(a_cooling_gas_is_stationary_in_its_own_time),
      cmocka_unit_test(sheared_monte_carlo_has_the_tensor_of_theory),
      cmocka_unit_test(planted_tail),
      cmocka_unit_test(lacking_of_boxes),
      cmocka_unit_test(dilute_gas),
      cmocka_unit_test(dense_gas),
      cmocka_unit_test(boxes_of_two_sizes),
      cmocka_unit_test(box_shorter_than_free_paths),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
