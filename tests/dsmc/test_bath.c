/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gases in a bath. They are compared with closed forms where collisions are rare or change nothing, and with the
 * deterministic solution of Enskog's equation where bath and collisions both matter. */
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

/* Smooth elastic grains relax as T = T_b + (T_0 - T_b) e^(-2 gamma t), at any collision rate. Each T is the mean of
 * many ensembles, with an error below 1 %. */
static void elastic_grains_relax_to_the_bath(void **state)
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
      lab_expect("T(t)", &T[i], 1 + 2 * exp(-0.4 * (i + 1)), 1e-3, 0.04); /* 1e-3: order 1/N */
  }
}

/* Shear, drag and noise with hardly a collision, in steps as long as half the strain. Second moments of velocities
 * about the centre are M_yy = T_b, M_xy = -T_b/(2 gamma), M_xx = T_b (1 + 1/(2 gamma^2)), each less 1/N of itself;
 * theta = T_b, <omega_z> = -1/2. The centre of mass has at most twice its energy of equilibrium, T_b/N. */
static void check_sheared_noise(double gamma, int64_t n, int per_block)
{
  const double Tb = 0.4, about = Tb * (1 - 1 / (double)n);
  const int at[4][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}};
  gg_model m = bath(GG_USF, 1e-5, 0.9, 0.1, gamma, Tb, 0.7, n);
  m.temperature0 = 0.4;
  m.time_step = GG_AUTO;
  gg_engine *g = lab_engine(&m, 1);
  lab_mean M[4] = {{0}}, theta = {0}, spin = {0}, centre = {0};
  lab_advance(g, 10, UINT64_MAX);
  for (int i = 0; i < 60; i++) {
    double cc[4] = {0}, th = 0, sp = 0, p2 = 0;
    for (int j = 0; j < per_block; j++) {
      lab_advance(g, 3, UINT64_MAX);
      lab_view v = lab_snapshot(g);
      for (int k = 0; k < 4; k++)
        cc[k] += v.cc[at[k][0]][at[k][1]] / v.n - v.momentum[at[k][0]] * v.momentum[at[k][1]] / (v.n * v.n);
      for (int a = 0; a < 3; a++) p2 += v.momentum[a] * v.momentum[a] / (3 * v.n);
      th += theta_of(&m, &v), sp += 2 * v.s_mean[2] / v.n;
    }
    for (int k = 0; k < 4; k++) lab_add(&M[k], cc[k] / per_block);
    lab_add(&theta, th / per_block), lab_add(&spin, sp / per_block), lab_add(&centre, p2 / per_block);
  }
  lab_expect("M_xx", &M[0], about * (1 + 1 / (2 * gamma * gamma)), 0, 0.01);
  lab_expect("M_yy", &M[1], about, 0, 0.01);
  lab_expect("M_zz", &M[2], about, 0, 0.01);
  lab_expect("M_xy", &M[3], -about / (2 * gamma), 0, 0.04);
  lab_expect("theta", &theta, Tb * (1 - 1 / (double)n), 0, 0.01);
  lab_expect("spin", &spin, -0.5, 0, 0.03);
  printf("# centre %g of T_b\n", lab_value(&centre) / Tb);
  assert_true(lab_value(&centre) < 2 * Tb);
  gg_dsmc_ops.destroy(g);
}

static void sheared_noise_has_its_moments(void **state)
{
  (void)state;
  check_sheared_noise(1.5, 20000, 1);
  if (getenv("NIGHTLY")) check_sheared_noise(4, 100, 160); /* daily few grains are tested without shear */
}

/* Sums over the grains of a mixture. */
typedef struct about_centre {
  const gg_model *model;
  double n, mass, energy, spin, momentum[3];
} about_centre;

static void add_about_centre(void *context, const gg_chunk *k)
{
  about_centre *v = context;
  for (size_t i = 0; i < k->n; i++) {
    const int s = k->species ? k->species[i] : 0;
    const double mass = v->model->mass[s];
    v->n++, v->mass += mass;
    for (int a = 0; a < 3; a++) {
      v->energy += mass * k->c[a][i] * k->c[a][i];
      v->momentum[a] += mass * k->c[a][i];
      if (k->s[a]) v->spin += mass * v->model->inertia[s] * k->s[a][i] * k->s[a][i];
    }
  }
}

/* Elastic grains in equilibrium with their bath, whose drag on the last species is `drag` over the mean free time, and
 * a third of that on others. T about the centre of mass is T_b (1 - 1/N), theta T_b, and the centre has about T_b/N.
 * The errors are small enough to see 1/N. */
static void check_equilibrium(const gg_model *model, double drag, double time_step)
{
  gg_model m = *model;
  const double Tb = 0.5, n = (double)m.n, gamma = drag * gg_common_model_collision_rate(&m, Tb);
  const int last = m.n_species - 1;
  m.temperature0 = Tb, m.ratio0 = 1, m.time_step = time_step;
  for (int i = 0; i < m.n_species; i++) {
    const double own = i == last ? gamma : gamma / 3;
    m.bath.drag[i] = own, m.bath.noise[i] = 2 * own * Tb / m.mass[i];
    if (m.rule != GG_SMOOTH)
      m.bath.spin_drag[i] = own / 2, m.bath.spin_noise[i] = own * Tb / (m.mass[i] * m.inertia[i]);
  }
  lab_mean T = {0}, theta = {0}, centre = {0};
  gg_engine *g = lab_engine(&m, 3);
  lab_advance(g, 20 / gamma, UINT64_MAX);
  for (int b = 0; b < 40; b++) {
    double t = 0, c = 0, s = 0;
    for (int i = 0; i < 100; i++) {
      about_centre v = {.model = &m};
      lab_advance(g, fmin(1 / gamma, 5 * drag / gamma), UINT64_MAX);
      gg_dsmc_ops.snapshot(g, false, add_about_centre, &v);
      const double p2 = v.momentum[0] * v.momentum[0] + v.momentum[1] * v.momentum[1] + v.momentum[2] * v.momentum[2];
      t += (v.energy - p2 / v.mass) / (3 * v.n) / 100, c += p2 / v.mass / 300, s += v.spin / (300 * v.n);
    }
    lab_add(&T, t), lab_add(&centre, c), lab_add(&theta, s);
  }
  printf("# drag times free time %g, step %g: centre %.3f of T_b\n", drag, time_step, lab_value(&centre) / Tb);
  lab_expect("T about the centre", &T, Tb * (1 - 1 / n), 0, 1 / n);
  if (m.rule != GG_SMOOTH) lab_expect("theta", &theta, Tb, 0, 1 / n);
  assert_true(lab_value(&centre) < 2 * Tb);
  gg_dsmc_ops.destroy(g);
}

static void strong_drag_keeps_equilibrium(void **state)
{
  (void)state;
  enum { GRAINS = 50 };
  static const double drags[] = {0.3, 1, 3, 7, 20};
  gg_model smooth = bath(GG_HSS, 0.02, 1, -1, 1, 1, 0, GRAINS);
  gg_scene s = lab_scene(GG_HSS, 0.02, 1, 1, GRAINS);
  s.thermostat = GG_BATH, s.bath.drag = 1, s.bath.temperature = 1, s.bath.rotation = 1;
  s.n_species = 2;
  s.species[0] = (gg_species){0.6, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.4, 2, 3, 0.3, 3, 0};
  const gg_model mixture = lab_model(&s);
  for (size_t i = 0; i < sizeof drags / sizeof *drags; i++) {
    check_equilibrium(&smooth, drags[i], GG_AUTO);
    check_equilibrium(&mixture, drags[i], GG_AUTO);
  }
  check_equilibrium(&smooth, 7, 1);
  check_equilibrium(&mixture, 7, 1);
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
  lab_average(g, &m, 20, 20, 16, &f);
  const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_ROTATIONAL_TEMPERATURE};
  const lab_mean *mean[] = {&f.T, &f.theta};
  for (int k = 0; k < (m.rule == GG_ROUGH ? 2 : 1); k++) {
    const double error = isnan(a.error[q[k]]) ? 0 : a.error[q[k]];
    lab_expect("temperature", mean[k], a.value[q[k]], error, sight);
  }
  gg_dsmc_ops.destroy(g);
}

/* Both temperatures of steady states are those of theory: smooth and rough grains, sheared or not, in a bath, under
 * white noise and under a Gaussian thermostat of given strength; a mixture, too. The errors are small enough to see 1
 * to 2 %. */
static void steady_states_are_those_of_theory(void **state)
{
  (void)state;
  gg_model m = bath(GG_HSS, 0.2, 0.7, -1, 0.3, 1, 0, 20000);
  against_theory(&m, 0.01);
  m = bath(GG_HSS, 0, 0.8, -0.3, 1, 1, 0.5, 20000);
  if (getenv("NIGHTLY")) against_theory(&m, 0.01);
  m = bath(GG_USF, 0.3, 0.8, -1, 0.5, 2, 0, 20000);
  if (getenv("NIGHTLY")) against_theory(&m, 0.01);
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
  s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.5, 1.5, 1, 0.4, 0.25, 0};
  m = lab_model(&s);
  against_theory(&m, 0.02);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(elastic_grains_relax_to_the_bath), cmocka_unit_test(sheared_noise_has_its_moments),
      cmocka_unit_test(strong_drag_keeps_equilibrium), cmocka_unit_test(steady_states_are_those_of_theory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
