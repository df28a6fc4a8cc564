/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision integrals over Gaussians contain those of the theories that linearise them: each closed form against
 * the quadrature, or against its slope. */
#include "theory_test.h"

#include "theory/gaussian_moments.h"
#include "theory/lun1991.h"
#include "theory/mixture.h"
#include "theory/two_maxwellian.h"

static gg_tensor isotropic(double a)
{
  return (gg_tensor){{{a, 0, 0}, {0, a, 0}, {0, 0, a}}};
}

static gg_gaussian_rates rates(const gg_model *m, const gg_gaussian *state)
{
  gg_gaussian_rates r;
  gg_theory_gaussian_rates_at(m, state, &r);
  return r;
}

static double chi_cs(double phi)
{
  return (1 - phi / 2) / pow(1 - phi, 3);
}

/* Isotropic Gaussians at rest: collision rate, mean speed, pressure, exchange of energy. */
static void isotropic_gas(void **state)
{
  (void)state;
  for (double e = 0.2; e <= 1; e += 0.4)
    for (double beta = -0.8; beta <= 1; beta += 0.6) {
      gg_model m = model_for(GG_HCS, 0.2, e, beta);
      double T = 0.7, ratio = 0.4, K = 0.4;
      gg_gaussian s[2] = {{isotropic(T), isotropic(ratio * T / K), 0}};
      gg_gaussian_rates r = rates(&m, s);
      double nu = 24 * 0.2 * chi_cs(0.2) * sqrt(T / M_PI);
      gg_exchange x = gg_theory_exchange_at(gg_theory_grain_of(&m), INFINITY, ratio);
      assert_close(r.frequency[0], nu, 1e-12);
      assert_close(r.speed[0], sqrt(8 * T / M_PI), 1e-12);
      assert_close(gg_tensor_trace(r.change[0].M) / 3, nu * x.translation * T / 3, 1e-11);
      assert_close(1 + K * gg_tensor_trace(r.change[0].Theta) / 3, 1 + nu * x.rotation * T / 3, 1e-11);
      assert_close(r.Pc.at[1][1], m.density * T * 2 * (1 + e) * 0.2 * chi_cs(0.2), 1e-12);
      assert_true(fabs(r.Pc.at[0][1]) < 1e-12 && fabs(r.change[0].spin) < 1e-12);
    }
}

/* All of Lun's functions, as linear response of a rough gas to shear, spin and shear stress. */
static void lun_functions(void **state)
{
  (void)state;
  const double h = 1e-4;
  for (double e = 0.5; e <= 1; e += 0.25)
    for (double beta = -1; beta <= 1; beta += 0.5) {
      double phi = 0.3, T = 1.3, K = 0.4, ratio = 0.6; /* any ratio: the functions hold for all */
      gg_model m = model_for(GG_USF, phi, e, beta);
      gg_grain g = gg_theory_grain_of(&m);
      double used = beta > -1 ? ratio : 0;
      gg_lun_functions f = gg_theory_lun_functions_at((gg_lun_state){m.density, phi, m.chi[0], g, used});
      double xy[2], Pxy[2], Pyx[2], driven[2], sheared[2], twist[2];
      gg_gaussian rest = {isotropic(T), isotropic(used * T / K), 0};
      for (int i = 0; i < 2; i++) {
        double step = i ? h : -h;
        gg_gaussian s = rest;
        m.shear_rate = 0;
        s.M.at[0][1] = s.M.at[1][0] = step; /* shear stress alone */
        gg_gaussian_rates r = rates(&m, &s);
        xy[i] = r.change[0].M.at[0][1], driven[i] = r.Pc.at[0][1];
        s = rest;
        m.shear_rate = step; /* shear alone, grains rolling with it: omega = -rate/2, s = -rate/4 */
        s.spin = -step / 4;
        r = rates(&m, &s);
        sheared[i] = r.change[0].M.at[0][1], Pxy[i] = r.Pc.at[0][1], Pyx[i] = r.Pc.at[1][0];
        s = rest;
        m.shear_rate = 0;
        s.spin = step / 2; /* omega = step */
        r = rates(&m, &s);
        twist[i] = r.Pc.at[0][1] - r.Pc.at[1][0];
      }
      double relaxation = -(xy[1] - xy[0]) / (2 * h), source = (sheared[1] - sheared[0]) / (2 * h);
      double kinetic = m.density * (T - source) / relaxation; /* eta_k */
      double carried = (driven[1] - driven[0]) / (2 * h) * kinetic / m.density, direct = -(Pxy[1] - Pxy[0]) / (2 * h);
      assert_close(kinetic, sqrt(T) * f.f2_kinetic, 1e-7);
      assert_close(kinetic + carried + direct, sqrt(T) * f.f2, 1e-7);
      assert_close(Pxy[1], Pyx[1], 1e-7);
      assert_close((twist[1] - twist[0]) / (2 * h), 4 * sqrt(T) * f.f2r, 1e-7);
      m.shear_rate = 0;
      gg_gaussian_rates r = rates(&m, &rest);
      assert_close(m.density * T + r.Pc.at[0][0], T * f.f1, 1e-11);
      assert_close(-m.density / 2 * gg_tensor_trace(r.change[0].M) + 1, pow(T, 1.5) * f.f5 + 1, 1e-11);
      assert_close(m.density * K / 2 * gg_tensor_trace(r.change[0].Theta), pow(T, 1.5) * f.f5r, 1e-10);
    }
}

/* Mixtures: cooling rates, relaxation of stress, and the shear source of the viscosity equations. */
static void mixture_rates(void **state)
{
  (void)state;
  const double h = 1e-5;
  for (double e = 0.5; e <= 1; e += 0.25) {
    gg_model m = mixture_for(GG_USF, 0.2, e, -1, 3, 1.5, 0.5);
    double a[2] = {0.6, 2.1}, A[2][2];
    gg_gaussian rest[2] = {{.M = isotropic(a[0])}, {.M = isotropic(a[1])}};
    gg_theory_stress_relaxation(&m, a, A);
    m.shear_rate = 0;
    gg_gaussian_rates r = rates(&m, rest);
    for (int i = 0; i < 2; i++) assert_close(gg_tensor_trace(r.change[i].M), gg_theory_rate_v2(&m, i, a).at0, 1e-11);
    for (int j = 0; j < 2; j++) {
      gg_gaussian_rates side[2];
      for (int k = 0; k < 2; k++) {
        gg_gaussian s[2] = {rest[0], rest[1]};
        s[j].M.at[0][1] = s[j].M.at[1][0] = k ? h : -h;
        side[k] = rates(&m, s);
      }
      for (int i = 0; i < 2; i++)
        assert_close(-(side[1].change[i].M.at[0][1] - side[0].change[i].M.at[0][1]) / (2 * h), A[i][j], 1e-7);
    }
    gg_gaussian_rates side[2];
    for (int k = 0; k < 2; k++) {
      m.shear_rate = k ? h : -h;
      side[k] = rates(&m, rest);
    }
    for (int i = 0; i < 2; i++) {
      double source = 0;
      for (int j = 0; j < 2; j++) {
        int o = gg_pair(i, j);
        double B = (1 + e) * m.mass[j] / (m.mass[i] + m.mass[j]), S2 = a[i] + a[j];
        double F = 4 * M_PI * m.density * gg_theory_fraction(&m, j) * m.chi[o] * pow(m.sigma[o], 3);
        source += 0.5 * F * (4 * a[i] * B / 15 - B * B * S2 / 5);
      }
      assert_close((side[1].change[i].M.at[0][1] - side[0].change[i].M.at[0][1]) / (2 * h), source, 1e-7);
    }
  }
}

/* A gas divided into two equal species has the rates of the undivided one. */
static void labels_do_not_matter(void **state)
{
  (void)state;
  gg_model one = model_for(GG_USF, 0.25, 0.8, 0.3), two = mixture_for(GG_USF, 0.25, 0.8, 0.3, 1, 1, 0.5);
  gg_gaussian s = {
      {{{0.9, -0.2, 0}, {-0.2, 0.6, 0}, {0, 0, 0.7}}}, {{{1.1, 0.1, 0}, {0.1, 0.8, 0}, {0, 0, 0.9}}}, -0.2};
  gg_gaussian both[2] = {s, s};
  gg_gaussian_rates a = rates(&one, &s), b = rates(&two, both);
  for (int i = 0; i < 2; i++) {
    assert_close(b.frequency[i], a.frequency[0], 1e-12);
    assert_close(b.change[i].spin, a.change[0].spin, 1e-12);
    for (int j = 0; j < 9; j++) {
      assert_close(b.change[i].M.at[j / 3][j % 3], a.change[0].M.at[j / 3][j % 3], 1e-11);
      assert_close(b.change[i].Theta.at[j / 3][j % 3], a.change[0].Theta.at[j / 3][j % 3], 1e-11);
      assert_close(b.Pc.at[j / 3][j % 3], a.Pc.at[j / 3][j % 3], 1e-11);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(isotropic_gas),
      cmocka_unit_test(lun_functions),
      cmocka_unit_test(mixture_rates),
      cmocka_unit_test(labels_do_not_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
