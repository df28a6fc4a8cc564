/* Self-diffusion: grains that remember their velocity from step to step by a known share have known correlations and
 * displacements, under shear and through the boundaries of small boxes, two species apart; an elastic dilute gas
 * diffuses as Chapman and Enskog say. */
#include <stdio.h>

#include "curve_test.h"

#define STEP 0.2
static const double keep[2] = {0.9, 0.8};

/* Each step: everything moves by C dt (and with the flow), then C = keep C + noise; the box's image above slides on. */
static void walk(gg_snapshot *s, gg_rng *r, int sample)
{
  const double *L = s->model->box, rate = s->model->shear_rate;
  s->elapsed = STEP;
  if (sample == 0) s->offset = 0.3 * L[0];
  if (sample) s->offset += rate * L[1] * STEP, s->offset -= L[0] * floor(s->offset / L[0]);
  for (size_t i = 0; i < s->n; i++) {
    double share = keep[gg_snapshot_species(s, i)], step[3] = {0, 0, 0}, layers;
    for (int a = 0; a < 3; a++) {
      if (sample == 0) s->r[a][i] = L[a] * gg_rng_uniform(r), s->c[a][i] = gg_rng_normal(r);
      if (sample) step[a] = s->c[a][i] * STEP;
    }
    if (sample) step[0] += rate * (s->r[1][i] + step[1] / 2 - L[1] / 2) * STEP;
    for (int a = 0; a < 3; a++) s->r[a][i] += step[a];
    layers = floor(s->r[1][i] / L[1]);
    s->r[0][i] -= layers * s->offset;
    for (int a = 0; a < 3; a++) {
      s->r[a][i] -= L[a] * floor(s->r[a][i] / L[a]);
      if (sample) s->c[a][i] = share * s->c[a][i] + sqrt(1 - share * share) * gg_rng_normal(r);
    }
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

static void walkers(void **state)
{
  (void)state;
  for (int species = 1; species <= 2; species++) {
    gg_model m = ct_model(GG_USF, 0.2, -1, 1000, species);
    m.shear_rate = 0.7;
    gg_curves list = ct_curves(&gg_diffusion, &m, 1600, walk, 95);
    for (int k = 0; k < species; k++)
      for (int a = 0; a < 3; a++) {
        char name[64], tail[8] = "";
        if (species == 2) snprintf(tail, sizeof tail, "_%d", k + 1);
        snprintf(name, sizeof name, "velocity_autocorrelation_C%c%s", "xyz"[a], tail);
        const gg_curve *c = ct_find(&list, name);
        snprintf(name, sizeof name, "displacement_squared_%c%s", "xyz"[a], tail);
        const gg_curve *r = ct_find(&list, name);
        assert_true(fabs(c->x[10] - 10 * STEP) < 1e-9);
        /* neighbouring lags share their noise: chi^2 scatters more than for independent points */
        assert_true(ct_chi2(c, 0, 60, memory, &keep[k]) < 3.5);
        assert_true(ct_chi2(r, 1, 128, squared, &keep[k]) < 3.5);
        double sum = 0.5 + 0.5 * pow(keep[k], 127);
        for (int j = 1; j < 127; j++) sum += pow(keep[k], j);
        gg_curve_number p = ct_number(c, "diffusion_green_kubo");
        ct_expect("Green and Kubo", p.value, p.error, sum * STEP, 0.25 * sum * STEP);
        p = ct_number(r, "diffusion_einstein");
        double slope = (squared(127 * STEP, &keep[k]) - squared(64 * STEP, &keep[k])) / (2 * 63 * STEP);
        ct_expect("Einstein", p.value, p.error, slope, 0.25 * slope);
      }
    gg_curves_clear(&list);
  }
}

/* phi = 0.02, e = 1: D = 1.01896 x 3/(8 n d^2 chi) sqrt(T/pi) (Chapman & Cowling; Enskog's chi), to a few per mille of
 * which molecular dynamics holds at this density. */
static void dilute_gas(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = 0.02, s.particles = 1000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
  s.run.collisions = 1000;
  s.measure |= GG_MEASURE_DIFFUSION;
  gg_result *r = ct_run(s);
  const gg_model *m = &r->model;
  double T = r->value[GG_Q_TEMPERATURE].mean, mean[2] = {0, 0}, variance[2] = {0, 0};
  double expected = 1.01896 * 3 / (8 * m->density * m->chi[0]) * sqrt(T / M_PI);
  for (int a = 0; a < 3; a++)
    for (int k = 0; k < 2; k++) {
      char name[64];
      snprintf(name, sizeof name, k ? "displacement_squared_%c" : "velocity_autocorrelation_C%c", "xyz"[a]);
      gg_curve_number p = ct_number(ct_find(&r->curves, name), k ? "diffusion_einstein" : "diffusion_green_kubo");
      mean[k] += p.value / 3, variance[k] += p.error * p.error / 9;
    }
  ct_expect("D, Green and Kubo", mean[0], hypot(sqrt(variance[0]), 0.004 * expected), expected, 0.1 * expected);
  ct_expect("D, Einstein", mean[1], hypot(sqrt(variance[1]), 0.004 * expected), expected, 0.1 * expected);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walkers),
      cmocka_unit_test(dilute_gas),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
