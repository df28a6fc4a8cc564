/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spatial velocity correlations: a planted wave of velocity and spin gives its sine integral, radially and along
 * each axis; sampled pairs agree with all pairs, about cells, too; an elastic gas in equilibrium has only the
 * correlation of momentum conservation, -1/(N-1), and keeps its energy. */
#include <string.h>

#include "curve_test.h"
#include "measure/cell_frame.h"
#include "measure/pairs.h"
#include "graingas.h"

/* C_x = 2 cos(kz + phase) + noise, Omega_z = -cos(kz + phase) + noise/2, everything else noise. */
static void wave(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  double k = 2 * M_PI / s->model->box[2], phase = 2 * M_PI * gg_rng_uniform(r);
  s->offset = s->model->box[0] * gg_rng_uniform(r);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      s->r[a][i] = s->model->box[a] * gg_rng_uniform(r);
      s->c[a][i] = gg_common_rng_normal(r);
      s->s[a][i] = 0.5 * gg_common_rng_normal(r) + 7;
    }
  for (size_t i = 0; i < s->n; i++) {
    double w = cos(k * s->r[2][i] + phase);
    s->c[0][i] += 2 * w, s->s[2][i] -= w;
  }
}

typedef struct wave_form {
  double amplitude, k;
  bool along_z;
} wave_form;

static double radial(double r, const void *context)
{
  const wave_form *w = context;
  return w->amplitude * sin(w->k * r) / (w->k * r);
}
static double axial(double r, const void *context)
{
  const wave_form *w = context;
  return w->amplitude * (w->along_z ? cos(w->k * r) : 1);
}

static void planted_wave(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.05, 0, 1500, 1);
  gg_curves list = ct_curves(&gg_measure_velocity_correlations, &m, 80, wave, 61);
  double k = 2 * M_PI / m.box[2];
  /* <C_x^2> = 2 + 1, <Omega_z^2> = 1/2 + 1/4 */
  const struct {
    const char *name;
    wave_form form;
    double (*f)(double, const void *);
  } cases[] = {
      {"velocity_correlation_Cx", {2.0 / 3, k, false}, radial},
      {"velocity_correlation_Cy", {0, k, false}, radial},
      {"velocity_correlation_Wx", {0, k, false}, radial},
      {"velocity_correlation_Wz", {2.0 / 3, k, false}, radial},
      {"velocity_correlation_CxWz", {-1 / sqrt(3 * 0.75), k, false}, radial},
      {"velocity_correlation_Cx_along_x", {2.0 / 3, k, false}, axial},
      {"velocity_correlation_Cx_along_z", {2.0 / 3, k, true}, axial},
      {"velocity_correlation_Wz_along_y", {2.0 / 3, k, false}, axial},
      {"velocity_correlation_CxWz_along_z", {-1 / sqrt(3 * 0.75), k, true}, axial},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    double chi2 = ct_chi2(ct_find(&list, cases[i].name), 0, 100, cases[i].f, &cases[i].form);
    assert_true(chi2 < 2.3);
  }
  const gg_curve *c = ct_find(&list, "velocity_correlation_Cx");
  assert_true(c->error[20] < 0.02);
  gg_measure_curves_clear(&list);
}

/* The same grains at other times, so that only the drawn pairs differ. */
static void held_wave(gg_snapshot *s, gg_rng *r, int sample)
{
  if (sample == 0) wave(s, r, sample);
  s->time = sample;
}

enum { PLAIN_BINS = 60 };
typedef struct plain_sums {
  double count[PLAIN_BINS], cc[PLAIN_BINS], cw[PLAIN_BINS], square[2];
} plain_sums;

/* Subtract the mean of a grain's cell, computed by a loop over all grains. */
static void about_cells(gg_snapshot *s, double *value)
{
  gg_cell_grid grid = gg_measure_cell_grid_of(s->model);
  double *before = malloc(s->n * sizeof *before);
  memcpy(before, value, s->n * sizeof *before);
  for (size_t i = 0; i < s->n; i++) {
    double sum = 0, n = 0;
    for (size_t j = 0; j < s->n; j++)
      if (gg_measure_cell_grid_cell(&grid, s, i) == gg_measure_cell_grid_cell(&grid, s, j)) sum += before[j], n++;
    value[i] -= sum / n;
  }
  free(before);
}

/* Every pair of the grains of `held_wave`, from the definition. */
static plain_sums plain(const gg_model *m, uint64_t seed, bool local)
{
  plain_sums p = {.square = {0, 0}};
  gg_snapshot s;
  gg_rng r = gg_common_rng_seed(seed, 0);
  assert_int_equal(gg_measure_snapshot_init(&s, m, true, NULL), GG_OK);
  held_wave(&s, &r, 0);
  if (local) about_cells(&s, s.c[0]), about_cells(&s, s.s[2]);
  gg_images b = gg_measure_pairs_images(&s);
  double spin = 0, n = (double)s.n;
  for (size_t i = 0; i < s.n; i++) spin += s.s[2][i] / n;
  for (size_t i = 0; i < s.n; i++) {
    double wi = s.s[2][i] - spin;
    p.square[0] += s.c[0][i] * s.c[0][i] / n, p.square[1] += wi * wi / n;
    for (size_t j = i + 1; j < s.n; j++) {
      gg_vec d = {s.r[0][j] - s.r[0][i], s.r[1][j] - s.r[1][i], s.r[2][j] - s.r[2][i]};
      d = gg_nearest_separation(&b, d);
      size_t k = (size_t)(sqrt(gg_dot(d, d)) / 0.25);
      if (k >= PLAIN_BINS) continue;
      double wj = s.s[2][j] - spin;
      p.count[k]++, p.cc[k] += s.c[0][i] * s.c[0][j], p.cw[k] += 0.5 * (s.c[0][i] * wj + s.c[0][j] * wi);
    }
  }
  gg_measure_snapshot_clear(&s);
  return p;
}

static double plain_cc(double r, const void *context)
{
  const plain_sums *p = context;
  size_t k = (size_t)(r / 0.25);
  return p->cc[k] / p->count[k] / p->square[0];
}
static double plain_cw(double r, const void *context)
{
  const plain_sums *p = context;
  size_t k = (size_t)(r / 0.25);
  return p->cw[k] / p->count[k] / sqrt(p->square[0] * p->square[1]);
}

/* Dense and large enough that far pairs are sampled: each point within five errors of that of all pairs (34 points,
 * errors from 32 blocks), chi^2 about 1, and the errors far smaller than the values. */
static void compare_pairs(const gg_observable *observable, bool local)
{
  gg_model m = ct_model(GG_USF, 0.3, 0, 3000, 1);
  gg_curves list = ct_curves(observable, &m, 512, held_wave, 67);
  plain_sums all = plain(&m, 67, local);
  const struct {
    const char *name;
    double (*f)(double, const void *);
  } cases[] = {{"local_velocity_correlation_Cx", plain_cc}, {"local_velocity_correlation_CxWz", plain_cw}};
  for (int k = 0; k < 2; k++) {
    const gg_curve *c = ct_find(&list, cases[k].name + (local ? 0 : strlen("local_")));
    double chi2 = ct_chi2(c, 0, c->n, cases[k].f, &all), worst = 0;
    for (size_t i = 0; i < c->n; i++)
      worst = fmax(worst, fabs(c->value[i] - cases[k].f(c->x[i], &all)) / (c->error[i] + 1e-9));
    print_message("# largest deviation %.2f errors; last error %.4f\n", worst, c->error[c->n - 1]);
    assert_true(chi2 < 2.3 && worst < 5);
    assert_true(c->error[c->n - 1] > 1e-6 && c->error[c->n - 1] < 0.002); /* it is sampled, and has information */
  }
  gg_measure_curves_clear(&list);
}

static void sampled_pairs(void **state)
{
  (void)state;
  compare_pairs(&gg_measure_velocity_correlations, false);
}
static void sampled_pairs_about_cells(void **state)
{
  (void)state;
  compare_pairs(&gg_measure_local_velocity_correlations, true);
}

static double conserved(double x, const void *context)
{
  (void)x;
  return -1 / (*(const double *)context - 1);
}

static void momentum_conservation_leaves_its_correlation(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = 0.2, s.particles = 500;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1, s.collision.beta[q] = 1;
  s.run.collisions = 2000;
  s.measure |= GG_MEASURE_VELOCITY_CORRELATIONS;
  gg_result *r = ct_run(s);
  const char *names[] = {"velocity_correlation_Cx", "velocity_correlation_Cz"};
  double n = 500, mean = 0, error = 0;
  for (int k = 0; k < 2; k++) {
    const gg_curve *c = ct_find(&r->curves, names[k]);
    double chi2 = ct_chi2(c, 0, c->n, conserved, &n);
    assert_true(chi2 < 2.3);
    for (size_t i = 4; i < c->n; i++) mean += c->value[i] / (double)(2 * (c->n - 4));
    error += c->error[c->n - 1] / 2;
  }
  double energy = r->value[GG_Q_TEMPERATURE].mean + r->value[GG_Q_ROTATIONAL_TEMPERATURE].mean;
  energy /= (1 + r->model.ratio0) * r->model.temperature0;
  print_message("# energy %.6f of what it was\n", energy);
  assert_true(fabs(energy - 1) < 2 / n); /* of random spins, but for 1/N */
  print_message("# mean beyond two diameters %.5f, one bin's error %.5f\n", mean, error);
  assert_true(fabs(mean + 1 / (n - 1)) < error && error < 0.01);
  gg_result_free(r);
}

/* The correlation of momentum conservation in a mixture: the mean of <C_i C_j> = -T/M over all pairs, over that of
 * <C_i^2> = T (1/m_i - 1/M), by a plain sum over the grains. */
static void level_of_a_mixture(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_EQUILIBRIUM, 0.2, 1, 500, 2);
  gg_curves list = ct_curves(&gg_measure_velocity_correlations, &m, 20, wave, 5);
  double mass = 0, square = 0;
  for (int64_t i = 0; i < m.n; i++) mass += m.mass[i >= m.n_of[0]];
  for (int64_t i = 0; i < m.n; i++) square += (1 / m.mass[i >= m.n_of[0]] - 1 / mass) / (double)m.n;
  const gg_curve *c = ct_find(&list, "velocity_correlation_Cx");
  if (!(fabs(c->reference[0] / (-1 / mass / square) - 1) < 1e-12))
    fail_msg("%g, not %g", c->reference[0], -1 / mass / square);
  gg_measure_curves_clear(&list);
}

/* Inelastic shear: neighbours move together. */
static void sheared_neighbours_move_together(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.phi = 0.3, s.particles = 500;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.7;
  s.run.collisions = 600;
  s.measure |= GG_MEASURE_VELOCITY_CORRELATIONS;
  gg_result *r = ct_run(s);
  const gg_curve *c = ct_find(&r->curves, "velocity_correlation_Cx");
  print_message("# G_CC^xx next to contact: %.4f +- %.4f\n", c->value[0], c->error[0]);
  assert_true(c->value[0] > 0.05 && c->value[0] > 4 * c->error[0]);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_wave),
      cmocka_unit_test(sampled_pairs),
      cmocka_unit_test(sampled_pairs_about_cells),
      cmocka_unit_test(momentum_conservation_leaves_its_correlation),
      cmocka_unit_test(level_of_a_mixture),
      cmocka_unit_test(sheared_neighbours_move_together),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
