/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells: the numbers of randomly placed grains in cells are binomial; temperatures about cell, slab and box means
 * agree exactly with and without the 1/n_c fraction; a planted extra shear is found in the local shear rate and in
 * the box temperature. */
#include "curve_test.h"
#include "graingas.h"

#define EXTRA 0.02

static void thrown(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  const double *L = s->model->box;
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    for (int a = 0; a < 3; a++) {
      s->r[a][i] = L[a] * gg_rng_uniform(r);
      s->c[a][i] = gg_common_rng_normal(r) / sqrt(s->model->mass[k]);
      if (s->s[a])
        s->s[a][i] = 0.5 * gg_common_rng_normal(r) / sqrt(s->model->mass[k] * s->model->inertia[k]) - 1 * (a == 2);
    }
    s->c[0][i] += EXTRA * (s->r[1][i] - L[1] / 2);
  }
}

typedef struct binomial {
  double unit, n, p;
} binomial;

static double law(double phi, const void *context)
{
  const binomial *b = context;
  double k = round(phi / b->unit);
  double log_p = lgamma(b->n + 1) - lgamma(k + 1) - lgamma(b->n - k + 1) + k * log(b->p) + (b->n - k) * log1p(-b->p);
  return exp(log_p) / b->unit;
}

static void expect_number(const gg_curve *c, const char *name, double expected, double sight)
{
  gg_curve_number p = ct_number(c, name);
  ct_expect(name, p.value, p.error, expected, sight * fabs(expected));
}

static void planted_cells_have_exact_temperatures(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.1, 0, 4000, 1);
  gg_curves list = ct_curves(&gg_measure_cells, &m, 96, thrown, 81);
  const gg_curve *density = ct_find(&list, "cell_density"), *T = ct_find(&list, "cell_temperature");
  double cells = ct_number(density, "cells").value, n = 4000, slabs = round(cbrt(cells));
  assert_true(cells == 512);
  binomial b = {m.phi * cells / n, n, 1 / cells};
  double chi2 = ct_chi2(density, 0, 18, law, &b);
  assert_true(chi2 > 0.3 && chi2 < 2.3);
  expect_number(density, "count_variance_over_mean", 1 - 1 / cells, 0.05);
  /* the extra shear adds rate^2 h^2/36 within a slab or cell of height h (variance h^2/12 of y, of one component) */
  double h = m.box[1] / slabs, within = pow(EXTRA * h, 2) / 36, whole = pow(EXTRA * m.box[1], 2) / 36;
  double occupied = cells * (1 - pow(1 - 1 / cells, n));
  expect_number(T, "temperature_box", (1 + whole) * (1 - 1 / n), 0.02);
  expect_number(T, "temperature_slabs", (1 + within) * (1 - slabs / n), 0.02);
  expect_number(T, "temperature_slabs_corrected", 1 + within, 0.02);
  expect_number(T, "temperature_cells", (1 + within) * (1 - occupied / n), 0.02);
  expect_number(T, "temperature_cells_corrected", 1 + within, 0.02);
  const gg_curve *W = ct_find(&list, "cell_rotational_temperature");
  expect_number(W, "rotational_temperature_cells_corrected", 0.25, 0.02);
  expect_number(W, "rotational_temperature_cells", 0.25 * (1 - occupied / n), 0.02);
  gg_curve_number p = ct_number(ct_find(&list, "cell_shear_rate"), "mean_shear_rate");
  ct_expect("mean local shear rate", p.value, p.error, 1 + EXTRA, 0.01);
  gg_measure_curves_clear(&list);
}

/* Unequal masses: the fraction 1/n_c is that of grains, not of mass. */
static void unlike_masses_share_by_number(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_EQUILIBRIUM, 0.1, 0, 4000, 2);
  gg_curves list = ct_curves(&gg_measure_cells, &m, 96, thrown, 82);
  const gg_curve *T = ct_find(&list, "cell_temperature");
  double raw = ct_number(T, "temperature_cells").value;
  assert_true(raw < 0.9);
  gg_curve_number p = ct_number(T, "temperature_cells_corrected");
  assert_true(fabs(p.value - 1) < 4 * p.error + 0.005 && p.error < 0.004); /* 0.005: the extra shear of heavy grains */
  gg_measure_curves_clear(&list);
}

/* Grains of two sizes that all rotate at one mean rate, with equal fluctuations of all components of I^(1/2) omega. */
static void turning(gg_snapshot *s, gg_rng *r, int sample)
{
  thrown(s, r, sample);
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    double d = s->model->diameter[k], I = s->model->inertia[k] * s->model->mass[k] * d * d / 4;
    for (int a = 0; a < 3; a++) s->s[a][i] = d / 2 * (0.5 * gg_common_rng_normal(r) / sqrt(I) - 4 * (a == 2));
  }
}

/* Their mean is one of omega, not of surface velocities; local spins are over the rms of omega. */
static void two_sizes(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_EQUILIBRIUM, 0.1, 0, 4000, 2);
  gg_curves list = ct_curves(&gg_measure_cells, &m, 96, turning, 83);
  const gg_curve *W = ct_find(&list, "cell_rotational_temperature"), *c = ct_find(&list, "cell_spin");
  expect_number(W, "rotational_temperature_box", 0.25, 0.01);
  expect_number(W, "rotational_temperature_cells_corrected", 0.25, 0.02);
  double mean = 0, width = c->x[1] - c->x[0], squares = 16.0 / 3;
  for (size_t i = 0; i < c->n; i++) mean += c->value[i] * c->x[i] * width;
  for (int k = 0; k < 2; k++)
    squares += (k ? 0.4 : 0.6) * 0.25 / (m.inertia[k] * m.mass[k] * pow(m.diameter[k], 2) / 4);
  print_message("# mean local spin over rms %.4f, expected %.4f\n", mean, -4 / sqrt(squares));
  assert_true(fabs(mean * sqrt(squares) / -4 - 1) < 0.01);
  gg_measure_curves_clear(&list);
}

/* Masses 1 and 3, the heavy grains five times as hot: the energy that subtracting a cell's mean, mostly theirs,
 * takes from either species is restored. */
static void unlike(gg_snapshot *s, gg_rng *r, int sample)
{
  turning(s, r, sample);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      int k = gg_snapshot_species(s, i);
      double d = s->model->diameter[k], mean = a == 2 ? -4 : 0;
      s->c[a][i] = sqrt(k ? 5 : 1) * gg_common_rng_normal(r) / sqrt(s->model->mass[k]);
      if (k) s->s[a][i] = d / 2 * (mean + sqrt(5) * (s->s[a][i] * 2 / d - mean));
    }
}

static void two_temperatures(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_EQUILIBRIUM, 0.1, 0, 4000, 2);
  gg_curves list = ct_curves(&gg_measure_cells, &m, 96, unlike, 84);
  const gg_curve *T = ct_find(&list, "cell_temperature"), *W = ct_find(&list, "cell_rotational_temperature");
  double box[2], x[2] = {0.6, 0.4}, hot[2] = {1 / 2.6, 5 / 2.6}; /* the mean over the box reduces it, too */
  for (int spins = 0; spins < 2; spins++) {
    double all = 0, share = 0;
    for (int k = 0; k < 2; k++) {
      double weight = spins ? m.inertia[k] * m.mass[k] * m.diameter[k] * m.diameter[k] / 4 : m.mass[k];
      all += x[k] * weight, share += x[k] * weight * hot[k];
    }
    box[spins] = 1 / (1 - share / all / (double)m.n);
  }
  expect_number(T, "temperature_slabs_over_box", box[0], 0.002);
  expect_number(T, "temperature_cells_over_box", box[0], 0.01);
  expect_number(W, "rotational_temperature_cells_over_box", box[1], 0.01);
  assert_null(ct_find(&list, "cell_density")->reference); /* sizes differ */
  gg_measure_curves_clear(&list);
}

/* Every distribution integrates to one, and an elastic engine's cells have the temperature of the box. */
static void cells_of_an_engine_have_the_temperature_of_the_box(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = 0.1, s.particles = 1000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1, s.collision.beta[q] = 1;
  s.run.collisions = 1500;
  s.measure |= GG_MEASURE_CELLS;
  gg_result *r = ct_run(s);
  for (int k = 0; k < r->curves.n; k++) {
    const gg_curve *c = &r->curves.curve[k];
    double sum = 0;
    for (size_t i = 0; i < c->n; i++) sum += c->value[i] * (c->x[1] - c->x[0]);
    print_message("# %s: %.5f\n", c->name, sum);
    assert_true(fabs(sum - 1) < 0.002);
  }
  const gg_curve *T = ct_find(&r->curves, "cell_temperature");
  gg_curve_number p = ct_number(T, "temperature_cells_corrected"), box = ct_number(T, "temperature_box");
  ct_expect("temperature of cells", p.value, p.error, box.value * 1000 / 999, 0.02 * p.value);
  gg_curve_number over = ct_number(T, "temperature_cells_over_box");
  ct_expect("over that of the box", over.value, over.error, 1000.0 / 999, 0.004);
  assert_true(fabs(over.value * box.value / p.value - 1) < 1e-12 && over.error < 0.6 * p.error / p.value);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_cells_have_exact_temperatures),
      cmocka_unit_test(unlike_masses_share_by_number),
      cmocka_unit_test(two_sizes),
      cmocka_unit_test(two_temperatures),
      cmocka_unit_test(cells_of_an_engine_have_the_temperature_of_the_box),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
