/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heated gases: what thermostats keep constant, and the viscosities that the literature has for heated gases. */
#include "lab.h"

#include "dsmc/dsmc.h"
#include "dsmc/dsmc_thermostat.h"

static gg_model heated(gg_flow flow, gg_thermostat thermostat, double phi, double e, double beta, int64_t n)
{
  gg_scene s = lab_scene(flow, phi, e, beta, n);
  s.thermostat = thermostat;
  return lab_model(&s);
}

/* The Gaussian thermostat keeps the temperature; otherwise the gas is the freely cooling one, with its cumulant and
 * cooling rate at e = 0.5. */
static void gaussian_thermostat_keeps_the_temperature(void **state)
{
  (void)state;
  gg_model m = heated(GG_HSS, GG_NO_THERMOSTAT, 0.2, 0.5, -1, 50000);
  gg_engine *g = lab_engine(&m, 1);
  lab_flow f = {0};
  lab_average(g, &m, 20, 40, 20, &f);
  lab_expect("temperature", &f.T, 0.5, 1e-4, 0.002);
  lab_expect("a2", &f.a2, 0.0474, 3e-4, 0.05);
  double zeta = lab_value(&f.loss) / (1.5 * m.density * 0.5) / gg_common_model_nu0(&m, 0.5);
  assert_true(fabs(zeta / (5. / 12 * m.chi[0] * 0.75 * (1 + 3. / 16 * 0.0474)) - 1) < 0.003);
  gg_dsmc_ops.destroy(g);
}

/* It keeps the temperature of rough grains, too, while their rotational temperature relaxes to its own steady value. */
static void gaussian_thermostat_keeps_that_of_rough_grains(void **state)
{
  (void)state;
  gg_model m = heated(GG_HSS, GG_NO_THERMOSTAT, 0.02, 0.7, 0.2, 20000);
  m.ratio0 = 0.6;
  gg_engine *g = lab_engine(&m, 1);
  lab_flow f = {0};
  lab_average(g, &m, 20, 40, 20, &f);
  lab_expect("temperature, rough", &f.T, 0.5, 1e-4, 0.002);
  gg_dsmc_ops.destroy(g);
}

/* Under white noise the steady temperature balances noise and collisions, and the cumulant is within 3 % of
 * a2 = 16 (1-e)(1-2e^2)/(241 - 177 e + 30 e^2 (1-e)) (van Noije & Ernst 1998, first Sonine order). */
static void white_noise_settles_at_balance(void **state)
{
  (void)state;
  gg_model m = heated(GG_HSS, GG_WHITE_NOISE, 0, 0.5, -1, 20000);
  gg_engine *g = lab_engine(&m, 2);
  lab_flow f = {0};
  lab_average(g, &m, 20, 15, 20, &f);
  lab_expect("a2, white noise", &f.a2, 4 / 156.25, 0.03 * 4 / 156.25, 0.2);
  lab_expect("temperature", &f.T, 0.5, 0.002, 0.03);
  gg_dsmc_ops.destroy(g);
}

/* Averages of -P_xy/rate over eta_0, and of its kinetic part, in slow shear at constant temperature. */
static void viscosity(const gg_model *model, double reduced_rate, int ensembles, lab_mean *total, lab_mean *kinetic)
{
  gg_model m = *model;
  double nu_over_speed = gg_common_model_nu0(&m, 1);
  m.temperature0 = 1 / (reduced_rate * reduced_rate * nu_over_speed * nu_over_speed);
  for (int i = 0; i < ensembles; i++) {
    gg_engine *g = lab_engine(&m, 100 + (uint64_t)i);
    lab_flow f = {0};
    lab_average(g, &m, 10, 1, 40, &f);
    double eta0 = 5. / 16 * sqrt(lab_value(&f.T) / M_PI);
    lab_add(total, lab_value(&f.eta) / eta0);
    lab_add(kinetic, -lab_value(&f.kinetic[0][1]) / eta0);
    gg_dsmc_ops.destroy(g);
  }
}

/* Shear with the Gaussian thermostat gives the viscosity of the heated state (Garzo & Montanero 2002 and an independent
 * Monte Carlo solution, e = 0.8, phi = 0.3), which is not that of the cooling state. */
static void heated_gas_has_its_viscosity(void **state)
{
  (void)state;
  gg_model m = heated(GG_SMALL_SHEAR, GG_GAUSSIAN, 0.3, 0.8, -1, 100000);
  lab_mean total = {0}, kinetic = {0};
  viscosity(&m, 0.04, 14, &total, &kinetic);
  lab_expect("eta/eta_0, phi .3, e .8", &total, 3.700, 0.012, 0.03);
  lab_expect("kinetic part", &kinetic, 0.8417, 0.004, 0.08);
  m = heated(GG_SMALL_SHEAR, GG_GAUSSIAN, 0, 0.7, -1, 100000);
  total = kinetic = (lab_mean){0};
  viscosity(&m, 0.04, 10, &total, &kinetic);
  double c = 2 * 16 * 0.3 * (1 - 0.98) / (81 - 17 * 0.7 + 30 * 0.49 * 0.3), zeta = 5. / 12 * 0.51 * (1 + 3. / 32 * c);
  double nu = (1 - 0.25 * 0.09) * (1 - c / 64);
  lab_expect("eta/eta_0, phi 0, e .7", &total, 1 / (nu - zeta), 0.008, 0.05);
}

/* Shear so slow that the gas cools freely while its reduced rate a* grows towards 0.06 gives the viscosity of the
 * cooling state, 1/(nu_eta - zeta/2) (Garzo & Dufty 1999), which is more than a tenth lower than that of the heated
 * state. It is the slope of -P_xy/p over a*, by least squares. */
static void cooling_gas_has_its_viscosity(void **state)
{
  (void)state;
  gg_model m = heated(GG_USF, GG_NO_THERMOSTAT, 0, 0.7, -1, 100000);
  double nu = gg_common_model_nu0(&m, 1);
  lab_mean eta = {0};
  m.temperature0 = pow(0.004 * nu, -2);
  for (uint64_t seed = 0; seed < 20; seed++) {
    gg_engine *g = lab_engine(&m, 300 + seed);
    double sum = 0, weight = 0, a = 0;
    while (a < 0.06) {
      lab_advance(g, INFINITY, (uint64_t)m.n / 4);
      lab_view v = lab_snapshot(g);
      double T = lab_temperature(&v);
      a = 1 / (nu * sqrt(T));
      if (a < 0.02) continue; /* remembers the start, and is mostly noise */
      sum += -v.cc[0][1] / v.n / T * a;
      weight += a * a;
    }
    lab_add(&eta, sum / weight);
    gg_dsmc_ops.destroy(g);
  }
  double c = 2 * 16 * 0.3 * (1 - 0.98) / (81 - 17 * 0.7 + 30 * 0.49 * 0.3), zeta = 5. / 12 * 0.51 * (1 + 3. / 32 * c);
  lab_expect("eta/eta_0, cooling, e .7", &eta, 1 / ((1 - 0.25 * 0.09) * (1 - c / 64) - 0.5 * zeta), 0.008, 0.06);
}

/* The viscosity of dilute, elastic, perfectly rough spheres. Pidduck's (1922), eta_0 6 (1+K)^2/(6 + 13 K), supposes
 * isotropic spins. Shear makes them anisotropic, which adds a factor 1/(1 - r_cs r_sc/(r_cc r_ss)) (Condiff, Lu &
 * Dahler, J. Chem. Phys. 42 (1965) 3445): 1.0535 at K = 0.4, from a Monte Carlo evaluation of the four relaxation rates
 * of C_x C_y and s_x s_y over the common collision rule. */
static void rough_gas_has_its_viscosity(void **state)
{
  (void)state;
  gg_model m = heated(GG_USF, GG_NO_THERMOSTAT, 0, 1, 1, 100000);
  lab_mean total = {0}, kinetic = {0};
  m.ratio0 = 1;
  viscosity(&m, 0.05, 12, &total, &kinetic);
  double K = m.inertia[0];
  lab_expect("eta/eta_0, Pidduck", &total, 1.0535 * 6 * (1 + K) * (1 + K) / (6 + 13 * K), 0.006, 0.04);
}

/* Ten thousand collisions a grain under a thermostat that amplifies any motion of the centre of mass: the momentum
 * stays at rounding, and nothing else drifts. */
static void the_centre_of_mass_stays_at_rest(void **state)
{
  (void)state;
  gg_model m = heated(GG_HSS, GG_GAUSSIAN, 0, 0.6, -1, 1000);
  gg_engine *g = lab_engine(&m, 3);
  lab_mean a2 = {0}, T = {0};
  for (int b = 0; b < 50; b++) {
    lab_view v = {0};
    for (int i = 0; i < 100; i++) {
      lab_advance(g, INFINITY, 1000);
      lab_view now = lab_snapshot(g);
      for (int a = 0; a < 3; a++) assert_true(fabs(now.momentum[a]) < 1e-12 * now.n);
      v.c4 += now.c4, v.n += now.n;
      for (int a = 0; a < 3; a++) v.cc[a][a] += now.cc[a][a];
    }
    double mean = lab_temperature(&v);
    if (b) lab_add(&T, mean), lab_add(&a2, v.c4 / v.n / (15 * mean * mean) - 1);
  }
  lab_expect("temperature", &T, 0.5, 5e-4, 0.01);
  lab_expect("a2", &a2, 0.021, 0.003, 0.8); /* Montanero & Santos 2000, less 1/N */
  gg_dsmc_ops.destroy(g);
}

/* After a kick of grains at rest each component of C is normal, has the variance asked for, and is independent of the
 * others, as far as moments up to the fourth show, in a strained ensemble. */
static void kicks_are_normal(void **state)
{
  (void)state;
  enum { GRAINS = 50000, ROUNDS = 10 };
  gg_model m = heated(GG_HSS, GG_WHITE_NOISE, 0, 0.5, -1, GRAINS);
  gg_engine *g = lab_engine(&m, 9);
  gg_dsmc *d = (gg_dsmc *)g;
  gg_dsmc_population *p = &d->ensemble.of[0];
  const double strain = 0.7, variance = 2, n = (double)GRAINS * ROUNDS;
  double second[3][3] = {{0}}, fourth[3] = {0};
  for (int k = 0; k < ROUNDS; k++) {
    for (uint32_t i = 0; i < GRAINS; i++) gg_dsmc_block_set(p, p->c, i, (gg_vec){0, 0, 0});
    gg_dsmc_thermostat_kick(&d->ensemble, strain, variance, d->schedule ? d->schedule->lanes : &d->now.lanes);
    for (uint32_t i = 0; i < GRAINS; i++) {
      gg_vec v = gg_dsmc_block_get(p, p->c, i);
      const double c[3] = {v.x - strain * v.y, v.y, v.z};
      for (int a = 0; a < 3; a++) {
        fourth[a] += pow(c[a], 4) / (variance * variance * n);
        for (int b = 0; b < 3; b++) second[a][b] += c[a] * c[b] / (variance * n);
      }
    }
  }
  for (int a = 0; a < 3; a++) {
    assert_true(fabs(fourth[a] - 3) < 4 * sqrt(96 / n));
    for (int b = 0; b < 3; b++) assert_true(fabs(second[a][b] - (a == b)) < 4 * sqrt((a == b ? 2 : 1) / n));
  }
  gg_dsmc_ops.destroy(g);
}

/* C^2 of a grain whose velocity is stored at this strain. */
static double square(const gg_dsmc_population *p, uint32_t a, double strain)
{
  gg_vec c = gg_dsmc_block_get(p, p->c, a);
  c.x -= strain * c.y;
  return gg_dot(c, c);
}

static double energy(const gg_dsmc_ensemble *e, double strain)
{
  double sum = 0;
  for (uint32_t a = 0; a < (uint32_t)e->of[0].n; a++) sum += 0.5 * e->of[0].mass * square(&e->of[0], a, strain);
  return sum;
}

/* In the middle of a step velocities are stored at the strain so far. The energy given back is that of peculiar
 * velocities, and after kicks the speed bounds hold for peculiar velocities. */
static void thermostats_heat_peculiar_velocities(void **state)
{
  (void)state;
  const double strain = 0.7;
  gg_model m = heated(GG_HSS, GG_WHITE_NOISE, 0, 0.5, -1, 4000);
  gg_engine *g = lab_engine(&m, 6);
  gg_dsmc *d = (gg_dsmc *)g;
  const gg_dsmc_population *p = &d->ensemble.of[0];
  double before = energy(&d->ensemble, strain);
  assert_true(gg_dsmc_thermostat_return(&d->ensemble, strain, 0, 0.1 * before, 0) == 0);
  assert_true(fabs(energy(&d->ensemble, strain) / (1.1 * before) - 1) < 1e-12);
  gg_dsmc_thermostat_kick(&d->ensemble, strain, 4, &d->now.lanes);
  for (uint32_t a = 0; a < (uint32_t)p->n; a++)
    assert_true((double)p->speed_bound[a / GG_DSMC_LANES] * d->ensemble.bound_scale >= square(p, a, strain));
  gg_dsmc_ops.destroy(g);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(gaussian_thermostat_keeps_the_temperature),
                                     cmocka_unit_test(gaussian_thermostat_keeps_that_of_rough_grains),
                                     cmocka_unit_test(white_noise_settles_at_balance),
                                     cmocka_unit_test(heated_gas_has_its_viscosity),
                                     cmocka_unit_test(cooling_gas_has_its_viscosity),
                                     cmocka_unit_test(rough_gas_has_its_viscosity),
                                     cmocka_unit_test(the_centre_of_mass_stays_at_rest),
                                     cmocka_unit_test(kicks_are_normal),
                                     cmocka_unit_test(thermostats_heat_peculiar_velocities)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
