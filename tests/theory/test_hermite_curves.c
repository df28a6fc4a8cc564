/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distributions of enskog_hermite: a component of an expansion has the moments of the expansion; the curves'
 * moments are the theory's numbers; bin by bin they agree with grains in long Monte Carlo runs, and a Gaussian does
 * not; and they end where the series does not converge. */
#include "theory_test.h"

#include <stdlib.h>

#include "graingas.h"
#include "measure/histogram.h"
#include "run/run.h"
#include "theory/hermite/component.h"

static double square_y(const double C[3])
{
  return C[1] * C[1];
}

static double fourth_y(const double C[3])
{
  return C[1] * C[1] * C[1] * C[1];
}

/* Any expansion about any Gaussian. */
static void components_have_its_moments(void **state)
{
  (void)state;
  gg_error err;
  gg_hermite_basis b;
  assert_int_equal(gg_hermite_basis_make(&b, 6, &err), GG_OK);
  gg_hermite_state s = {.L = {{1.3, 0, 0}, {-0.4, 0.8, 0}, {0, 0, 1.1}}, .width = 1, .a = calloc((size_t)b.n, 8)};
  for (int r = 1; r < b.n; r++) s.a[r] = 0.05 * sin(7.0 * r);
  s.a[0] = 1;
  gg_hermite_component c = gg_hermite_component_of(&b, &s, 1);
  double unit = s.L[1][0] * s.L[1][0] + s.L[1][1] * s.L[1][1], bin[GG_HISTOGRAM], sum = 0, squares = 0;
  assert_close(unit * gg_hermite_component_moment(&c, 2), gg_hermite_mean(&b, &s, square_y), 1e-12);
  assert_close(unit * unit * gg_hermite_component_moment(&c, 4), gg_hermite_mean(&b, &s, fourth_y), 1e-12);
  gg_hermite_component_histogram(&c, bin);
  for (int k = 0; k < GG_HISTOGRAM_BINS; k++) {
    double x = (k - GG_HISTOGRAM_HALF) * GG_HISTOGRAM_WIDTH;
    sum += bin[k], squares += bin[k] * x * x;
  }
  assert_close(sum, 1.0, 1e-9);
  assert_close(squares - GG_HISTOGRAM_WIDTH * GG_HISTOGRAM_WIDTH / 12, 1.0, 1e-4);
  free(s.a);
  gg_hermite_basis_clear(&b);
}

/* The standard Gaussian, and its speeds. */
static void of_a_gaussian(void **state)
{
  (void)state;
  gg_hermite_component c = {.degree = 4, .t = {1}};
  gg_sonine_sums s;
  gg_hermite_component_speeds(&c, &s);
  double below = 0;
  for (int i = 0; i < GG_SONINE_BINS; i++) {
    double x = (i + 1) * GG_SONINE_WIDTH, before = below;
    below = erf(x) - M_2_SQRTPI * x * exp(-x * x);
    assert_close(s.share[i], below - before, 1e-9);
  }
  assert_close(s.fourth, 15. / 4, 1e-14);
  assert_close(s.sixth, 105. / 8, 1e-14);
}

static gg_scene measured(gg_scene s, unsigned measure)
{
  s.measure = GG_MEASURE_RHEOLOGY | measure;
  return s;
}

static const gg_curve *find(const gg_curves *list, const char *name)
{
  for (int k = 0; k < list->n; k++)
    if (strcmp(list->curve[k].name, name) == 0) return &list->curve[k];
  fail_msg("no curve %s", name);
  return NULL;
}

static double number(const gg_curve *c, const char *name, double *error)
{
  for (int i = 0; i < c->n_numbers; i++)
    if (strcmp(c->number[i].name, name) == 0) {
      if (error) *error = c->number[i].error;
      return c->number[i].value;
    }
  fail_msg("%s: no %s", c->name, name);
  return NAN;
}

static gg_curves curves_of(const gg_model *m, unsigned measure)
{
  gg_curves list;
  gg_error err;
  if (gg_theory_curves(&gg_theory_enskog_hermite, m, measure, &list, &err) != GG_OK) fail_msg("%s", err.message);
  return list;
}

static void moments_are_the_numbers(void **state)
{
  (void)state;
  gg_theory_answer a;
  gg_model m = model_for(GG_USF, 0.3, 0.7, -1);
  gg_curves list = curves_of(&m, GG_MEASURE_VELOCITY_DISTRIBUTIONS);
  assert_int_equal(gg_theory_evaluate(&gg_theory_enskog_hermite, &m, &a, NULL), GG_OK);
  for (int axis = 0; axis < 3; axis++) {
    char name[48];
    double zero = 0, two = 0, four = 0, error = NAN;
    snprintf(name, sizeof name, "velocity_distribution_C%c", "xyz"[axis]);
    const gg_curve *c = find(&list, name);
    double said = a.value[GG_Q_KURTOSIS_CX + axis];
    assert_true(fabs(number(c, "kurtosis", &error) - said) <= 1e-9 + error && error < 1e-3);
    for (size_t i = 0; i < c->n; i++) {
      double xx = c->x[i] * c->x[i], f = isnan(c->value[i]) ? 0 : c->value[i];
      zero += f, two += f * xx, four += f * xx * xx;
    }
    double w = GG_HISTOGRAM_WIDTH * GG_HISTOGRAM_WIDTH, square = two / zero - w / 12;
    assert_close((four / zero - w / 2 * square - w * w / 80) / (square * square), said, 1e-3);
  }
  gg_measure_curves_clear(&list);
  m = model_for(GG_HCS, 0.1, 0.5, -1);
  list = curves_of(&m, GG_MEASURE_SONINE);
  assert_int_equal(gg_theory_evaluate(&gg_theory_enskog_hermite, &m, &a, NULL), GG_OK);
  assert_close(number(find(&list, "sonine_excess"), "c", NULL), 2 * a.value[GG_Q_A2], 1e-6);
  gg_measure_curves_clear(&list);
}

/* Without a request, or without an answer, there is no curve; a law of restitution is rejected as for the numbers. */
static void no_curves(void **state)
{
  (void)state;
  gg_curves list;
  gg_model m = model_for(GG_USF, 0.3, 0.7, -1);
  list = curves_of(&m, GG_MEASURE_RHEOLOGY | GG_MEASURE_STRUCTURE);
  assert_int_equal(list.n, 0);
  assert_int_equal(gg_theory_curves(&gg_theory_lun1991, &m, ~0u, &list, NULL), GG_OK);
  assert_int_equal(list.n, 0);
  m = model_for(GG_EQUILIBRIUM, 0.3, 1, -1);
  assert_int_equal(gg_theory_curves(&gg_theory_enskog_hermite, &m, ~0u, &list, NULL), GG_BAD_INPUT);
  assert_int_equal(list.n, 0);
}

/* Dilute and dissipative: the tail does not converge, and is omitted; errors grow towards it. */
static void ends_where_the_series_does(void **state)
{
  (void)state;
  gg_model m = model_for(GG_HCS, 0, 0.3, -1);
  gg_curves list = curves_of(&m, GG_MEASURE_VELOCITY_DISTRIBUTIONS);
  const gg_curve *c = find(&list, "velocity_distribution_Cx");
  double from = number(c, "known_from", NULL), to = number(c, "known_to", NULL);
  assert_true(to > 3 && to < 7.5 && fabs(from + to) < 1e-9);
  for (size_t i = 0; i < c->n; i++) {
    bool inside = c->x[i] > from - 1e-9 && c->x[i] < to + 1e-9;
    assert_true(inside ? c->value[i] > 0 && c->error[i] <= 0.25 * c->value[i] : isnan(c->value[i]));
  }
  gg_measure_curves_clear(&list);
}

static gg_result *run(gg_scene s)
{
  gg_result *result = NULL;
  gg_error err = {0};
  s.engine = GG_DSMC;
  s.dsmc.particles = 20000;
  s.run.relative_error = 0.5, s.run.collisions = 2000;
  s.run.seed = 17;
  if (gg_run_scene(&s, NULL, 1, NULL, &result, &err) != GG_OK) fail_msg("%s", err.message);
  return result;
}

/* Mean of z^2 over bins within `reach`, against the theory or (NULL) against no deviation from a Gaussian. Errors of
 * the theory count where they are no longer small, for rough grains. */
static double mean_square(const gg_curve *c, const gg_curve *theory, double reach, double *worst)
{
  double sum = 0;
  int n = 0;
  for (size_t i = 0; i < c->n; i++) {
    if (fabs(c->x[i]) > reach || !(c->error[i] > 0)) continue;
    if (theory && isnan(theory->value[i])) continue;              /* beyond what the series knows */
    if (theory) assert_true(fabs(c->x[i] - theory->x[i]) < 0.01); /* of mixtures in units of their temperatures */
    double z = (c->value[i] - (theory ? theory->value[i] : 0)) / hypot(c->error[i], theory ? theory->error[i] : 0);
    if (worst) *worst = fmax(*worst, fabs(z));
    sum += z * z, n++;
  }
  return sum / n;
}

/* Neighbouring bins have common errors of P(0) and sigma: the mean square of 41 bins scatters by up to .5 about 1. The
 * dense smooth gas runs nightly: Gaussians are further off in the dilute one. */
static void those_of_the_engine(void **state)
{
  (void)state;
  gg_scene mixed = scene_of(GG_HCS, 0, 0.4, -1);
  mixed.n_species = 2;
  mixed.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  mixed.species[1] = (gg_species){0.5, 1, 3, 0.4, 1, 0};
  gg_scene sliding = scene_of(GG_HSS, 0, 0.8, 0), rough = scene_of(GG_HCS, 0.1, 0.9, 0.5);
  for (int p = 0; p < GG_PAIRS; p++) sliding.collision.mu[p] = 0.1;
  const unsigned components = GG_MEASURE_VELOCITY_DISTRIBUTIONS, speeds = GG_MEASURE_SONINE;
  const struct {
    gg_scene scene;
    const char *name[3];
    double reach, gaussian; /* the mean square there is above this */
  } cases[] = {
      {measured(scene_of(GG_USF, 0.3, 0.7, -1), components), {"velocity_deviation_Cx", "velocity_deviation_Cz"}, 2, 3},
      {measured(scene_of(GG_USF, 0, 0.8, -1), components), {"velocity_deviation_Cx", "velocity_deviation_Cy"}, 2, 20},
      {measured(scene_of(GG_HSS, 0.1, 0.5, -1), components | speeds), {"sonine_excess", "velocity_deviation_Cx"}, 2, 3},
      {measured(mixed, speeds), {"sonine_excess_1", "sonine_excess_2"}, 1.5, 3},
      {measured(rough, components), {"velocity_deviation_Wx", "velocity_deviation_Wz"}, 2, 3},
      {measured(sliding, components), {"velocity_deviation_Wx", "velocity_deviation_Wy"}, 2, 3}};
  for (size_t i = getenv("NIGHTLY") ? 0 : 1; i < sizeof cases / sizeof *cases; i++) {
    gg_result *r = run(cases[i].scene);
    gg_curves theory = curves_of(&r->model, cases[i].scene.measure);
    for (int k = 0; k < 3 && cases[i].name[k]; k++) {
      const gg_curve *c = find(&r->curves, cases[i].name[k]);
      double worst = 0, chi2 = mean_square(c, find(&theory, c->name), cases[i].reach, &worst);
      double gaussian = mean_square(c, NULL, cases[i].reach, NULL);
      printf("# %s: %.2f, worst %.1f, Gaussian %.1f\n", c->name, chi2, worst, gaussian);
      if (!(chi2 > 0.3 && chi2 < 2.2 && worst < 5)) fail_msg("%s: mean z^2 %g, worst z %g", c->name, chi2, worst);
      if (!(gaussian > cases[i].gaussian)) fail_msg("%s: a Gaussian has mean z^2 %g", c->name, gaussian);
    }
    gg_measure_curves_clear(&theory);
    gg_result_free(r);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(components_have_its_moments), cmocka_unit_test(of_a_gaussian),
      cmocka_unit_test(moments_are_the_numbers),     cmocka_unit_test(no_curves),
      cmocka_unit_test(ends_where_the_series_does),  cmocka_unit_test(those_of_the_engine),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
