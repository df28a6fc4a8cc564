/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gases in a bath against closed forms, where collisions are rare or change nothing, and against Enskog's equation
 * without random numbers where both matter. */
#include "lab.h"

#include "theory/theory.h"

static gg_model bath(gg_flow flow, double phi, double e, double beta, double drag, double T, double rotation, int64_t n)
{
  gg_scene s = lab_scene(flow, phi, e, beta, n);
  s.thermostat = GG_BATH;
  s.bath.drag = drag, s.bath.temperature = T, s.bath.rotation = rotation;
  return lab_model(&s);
}

static double theta_of(const gg_model *m, const lab_view *v)
{
  double mean2 = 0;
  for (int a = 0; a < 3; a++) mean2 += v->s_mean[a] * v->s_mean[a] / (v->n * v->n);
  return m->inertia[0] * (v->ss / v->n - mean2) / 3;
}

/* Smooth elastic grains relax as T = T_b + (T_0 - T_b) e^(-2 gamma t), at any collision rate: each from many ensembles,
 * to four of its errors, which are below 1 %. */
static void relaxation(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    lab_mean T[3] = {{0}};
    gg_model m = bath(GG_HSS, 0.2, 1, -1, k ? 2 : 0.1, 1, 0, 2000);
    m.temperature0 = 3;
    for (uint64_t seed = 0; seed < 24; seed++) {
      gg_engine *g = lab_engine(&m, 10 + seed);
      for (int i = 0; i < 3; i++) {
        lab_advance(g, (k ? 0.1 : 2), UINT64_MAX);
        lab_view v = lab_snapshot(g);
        lab_add(&T[i], lab_temperature(&v));
      }
      gg_dsmc_ops.destroy(g);
    }
    for (int i = 0; i < 3; i++)
      lab_expect("T(t)", &T[i], 1 + 2 * exp(-0.4 * (i + 1)), 1e-3, 0.04); /* 1/N: the momentum, which is taken off */
  }
}

/* Hardly a collision: shear, drag and noise alone, steps as long as half the strain. Velocities and spins have
 * M_yy = T_b, M_xy = -T_b/(2 gamma), M_xx = T_b (1 + 1/(2 gamma^2)), theta = T_b, <omega_z> = -1/2. */
static void sheared_noise(void **state)
{
  (void)state;
  const double gamma = 1.5, Tb = 0.4;
  gg_model m = bath(GG_USF, 1e-5, 0.9, 0.1, gamma, Tb, 0.7, 20000);
  m.temperature0 = 0.4;
  m.time_step = GG_AUTO;
  gg_engine *g = lab_engine(&m, 1);
  lab_mean M[4] = {{0}}, theta = {0}, spin = {0};
  lab_advance(g, 10, UINT64_MAX);
  for (int i = 0; i < 60; i++) {
    lab_advance(g, 3, UINT64_MAX);
    lab_view v = lab_snapshot(g);
    const int at[4][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}};
    for (int k = 0; k < 4; k++) lab_add(&M[k], v.cc[at[k][0]][at[k][1]] / v.n);
    lab_add(&theta, theta_of(&m, &v));
    lab_add(&spin, 2 * v.s_mean[2] / v.n);
  }
  lab_expect("M_xx", &M[0], Tb * (1 + 1 / (2 * gamma * gamma)), 0, 0.01);
  lab_expect("M_yy", &M[1], Tb, 0, 0.01);
  lab_expect("M_zz", &M[2], Tb, 0, 0.01);
  lab_expect("M_xy", &M[3], -Tb / (2 * gamma), 0, 0.02);
  lab_expect("theta", &theta, Tb, 0, 0.01);
  lab_expect("spin", &spin, -0.5, 0, 0.02);
  gg_dsmc_ops.destroy(g);
}

static void against_theory(const gg_model *model, double sight)
{
  gg_model m = *model;
  gg_theory_answer a;
  gg_error err;
  if (gg_theory_evaluate(gg_theory_find("enskog_hermite"), &m, &a, &err) != GG_OK) fail_msg("%s", err.message);
  m.asked_error = 1e-3;
  m.temperature0 = a.value[GG_Q_TEMPERATURE];
  gg_engine *g = lab_engine(&m, 5);
  lab_flow f = {0};
  lab_average(g, &m, 20, 40, 20, &f);
  const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_ROTATIONAL_TEMPERATURE};
  const lab_mean *mean[] = {&f.T, &f.theta};
  for (int k = 0; k < (m.rule == GG_ROUGH ? 2 : 1); k++) {
    const double error = isnan(a.error[q[k]]) ? 0 : a.error[q[k]];
    lab_expect("temperature", mean[k], a.value[q[k]], error, sight);
  }
  gg_dsmc_ops.destroy(g);
}

/* Both temperatures, of smooth and rough grains with shear and without, and under white noise of a given strength, to
 * four errors; these are small enough to see 1 %. */
static void steady(void **state)
{
  (void)state;
  gg_model m = bath(GG_HSS, 0.2, 0.7, -1, 0.3, 1, 0, 20000);
  against_theory(&m, 0.01);
  m = bath(GG_HSS, 0, 0.8, -0.3, 1, 1, 0.5, 20000);
  if (getenv("NIGHTLY")) against_theory(&m, 0.01);
  m = bath(GG_USF, 0.3, 0.8, -1, 0.5, 2, 0, 20000);
  against_theory(&m, 0.01);
  m = bath(GG_USF, 0.2, 0.9, 0.2, 0.2, 2, 10. / 3, 20000);
  against_theory(&m, 0.01);
  gg_scene s = lab_scene(GG_HSS, 0.2, 0.7, -1, 20000);
  s.thermostat = GG_WHITE_NOISE, s.noise_strength = 0.8;
  m = lab_model(&s);
  against_theory(&m, 0.01);
  s.thermostat = GG_GAUSSIAN, s.gaussian_rate = 0.4;
  m = lab_model(&s);
  against_theory(&m, 0.015);
  s = lab_scene(GG_USF, 0.2, 0.9, -1, 20000);
  s.thermostat = GG_BATH, s.bath.temperature = 3, s.bath.drag = 0.5;
  s.n_species = 2;
  s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1};
  s.species[1] = (gg_species){0.5, 1.5, 1, 0.4, 0.25};
  m = lab_model(&s);
  against_theory(&m, 0.02);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(relaxation), cmocka_unit_test(sheared_noise),
                                     cmocka_unit_test(steady)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
