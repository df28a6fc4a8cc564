/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Binary mixtures: exact results, and temperature ratios, cumulants and viscosity from the literature. */
#include "lab.h"

static gg_scene mixture(gg_flow flow, double phi, double e, double beta, gg_species one, gg_species two, int64_t n)
{
  gg_scene s = lab_scene(flow, phi, e, beta, n);
  s.n_species = 2;
  s.species[0] = one;
  s.species[1] = two;
  return s;
}

typedef struct ratios {
  lab_mean gamma, c1, c2;
} ratios;

static void average(const gg_model *m, uint64_t seed, int warmup, int blocks, ratios *r)
{
  gg_engine *g = lab_engine(m, seed);
  gg_error err = {0};
  for (int b = -warmup; b < blocks; b++) {
    lab_view v = lab_snapshot(g);
    double T[2], c[2], gamma = 0, c1 = 0, c2 = 0;
    const int samples = 10;
    for (int i = 0; i < samples; i++) {
      lab_advance(g, INFINITY, (uint64_t)m->n);
      v = lab_snapshot(g);
      for (int k = 0; k < 2; k++) {
        T[k] = m->mass[k] * v.cc_of[k] / v.n_of[k] / 3;
        c[k] = 2 * (m->mass[k] * m->mass[k] * v.c4_of[k] / v.n_of[k] / (15 * T[k] * T[k]) - 1);
      }
      gamma += T[0] / T[1] / samples;
      c1 += c[0] / samples;
      c2 += c[1] / samples;
      if (m->flow == GG_HCS && T[0] < 0x1p-20) assert_int_equal(gg_dsmc_ops.rescale(g, 10, &err), GG_OK);
    }
    if (b < 0) continue;
    lab_add(&r->gamma, gamma);
    lab_add(&r->c1, c1);
    lab_add(&r->c2, c2);
  }
  gg_dsmc_ops.destroy(g);
}

/* Elastic grains of any masses and sizes keep their energy to rounding and have equal partial temperatures. */
static void elastic_mixtures_are_in_equilibrium(void **state)
{
  (void)state;
  gg_scene s =
      mixture(GG_EQUILIBRIUM, 0.2, 1, -1, (gg_species){0.3, 1, 1, 0.4, 1, 0}, (gg_species){0.7, 0.5, 0.1, 0.4, 1, 0}, 20001);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 1);
  lab_view before = lab_snapshot(g);
  lab_advance(g, INFINITY, 50 * (uint64_t)m.n);
  lab_view v = lab_snapshot(g);
  double E0 = m.mass[0] * before.cc_of[0] + m.mass[1] * before.cc_of[1],
         E = m.mass[0] * v.cc_of[0] + m.mass[1] * v.cc_of[1];
  assert_true(fabs(E / E0 - 1) < 1e-13);
  gg_dsmc_ops.destroy(g);
  ratios r = {0};
  average(&m, 2, 2, 20, &r);
  lab_expect("T_1/T_2, elastic", &r.gamma, 1, 0, 0.01);
}

/* The pressure of elastic grains of unlike sizes and masses: p = n T [1 + (2 pi/3) n sum_ij x_i x_j sigma_ij^3 chi_ij];
 * each pair of species has its own term. */
static void each_pair_of_species_has_its_pressure(void **state)
{
  (void)state;
  gg_scene s =
      mixture(GG_EQUILIBRIUM, 0.3, 1, -1, (gg_species){0.4, 1, 1, 0.4, 1, 0}, (gg_species){0.6, 0.5, 0.2, 0.4, 1, 0}, 20000);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 8);
  lab_mean share[GG_PAIRS] = {0};
  gg_collision_sums t;
  lab_advance(g, INFINITY, 10 * (uint64_t)m.n);
  for (int b = 0; b < 40; b++) {
    gg_dsmc_ops.take_sums(g, &t);
    double time = lab_advance(g, INFINITY, 5 * (uint64_t)m.n);
    gg_dsmc_ops.take_sums(g, &t);
    for (int q = 0; q < 3; q++)
      lab_add(&share[q], (t.stress[q][0][0] + t.stress[q][1][1] + t.stress[q][2][2]) /
                             (3 * m.volume * time * m.density * m.temperature0));
  }
  for (int q = 0; q < 3; q++) {
    double one = (double)m.n_of[q == 2] / (double)m.n, two = (double)m.n_of[q > 0] / (double)m.n;
    double expected = 2 * M_PI / 3 * m.density * (q == 1 ? 2 : 1) * one * two * pow(m.sigma[q], 3) * m.chi[q];
    lab_expect(q == 0 ? "p_11" : q == 1 ? "p_12" : "p_22", &share[q], expected, 0, 0.01);
  }
  gg_dsmc_ops.destroy(g);
}

/* Rough grains in dense shear do the same as one species and as two species of equal grains. */
static void two_names_for_one_species_change_nothing(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0.2, 0.8, 0.2, 20000);
  gg_model one = lab_model(&s);
  s = mixture(GG_USF, 0.2, 0.8, 0.2, (gg_species){0.25, 1, 1, 0.4, 1, 0}, (gg_species){0.75, 1, 1, 0.4, 1, 0}, 20000);
  gg_model two = lab_model(&s);
  lab_flow a = {0}, b = {0};
  gg_engine *ga = lab_engine(&one, 3), *gb = lab_engine(&two, 4);
  lab_average(ga, &one, 30, 15, 15, &a);
  lab_average(gb, &two, 30, 15, 15, &b);
  const struct {
    const char *name;
    lab_mean *a, *b;
    double sight;
  } pairs[] = {{"T", &a.T, &b.T, 0.02},          {"theta", &a.theta, &b.theta, 0.02},
               {"p", &a.p, &b.p, 0.02},          {"eta", &a.eta, &b.eta, 0.02},
               {"rate", &a.rate, &b.rate, 0.01}, {"spin", &a.spin_z, &b.spin_z, 0.05},
               {"loss", &a.loss, &b.loss, 0.04}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    lab_expect(pairs[i].name, pairs[i].b, lab_value(pairs[i].a), lab_error(pairs[i].a), pairs[i].sight);
  gg_dsmc_ops.destroy(ga);
  gg_dsmc_ops.destroy(gb);
}

/* Temperature ratios are within 1 % of the first Sonine order (Garzo & Dufty 1999; figures 3-5 of Montanero's review),
 * cumulants those of an independent Monte Carlo solution, in free cooling and under the Gaussian thermostat alike. */
static void cooling_mixtures_have_their_ratio(void **state)
{
  (void)state;
  const struct {
    double phi, e, mass, size, number, gamma;
  } cases[] = {{0, 0.5, 2, 1, 1, 1.362},  {0, 0.9, 2, 1, 1, 1.056},      {0, 0.5, 10, 1, 2, 3.801},
               {0, 0.9, 10, 1, 2, 1.437}, {0.3, 0.6, 2, 2, 0.5, 0.8894}, {0.1, 0.8, 2, 2, 0.5, 0.9548}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    gg_species one = {cases[i].number, 1, 1, 0.4, 1, 0}, two = {1, 1 / cases[i].size, 1 / cases[i].mass, 0.4, 1, 0};
    gg_scene s = mixture(i % 2 ? GG_HSS : GG_HCS, cases[i].phi, cases[i].e, -1, one, two, 50000);
    gg_model m = lab_model(&s);
    ratios r = {0};
    average(&m, 5 + i, 4, 12, &r);
    char what[64];
    snprintf(what, sizeof what, "T_1/T_2 e %g m %g phi %g", cases[i].e, cases[i].mass, cases[i].phi);
    lab_expect(what, &r.gamma, cases[i].gamma, 0.0025 * cases[i].gamma, 0.02);
    if (i > 0) continue;
    lab_expect("c_1", &r.c1, 0.128, 0.001, 0.15);
    lab_expect("c_2", &r.c2, 0.064, 0.001, 0.3);
  }
}

/* An elastic equimolar mixture of masses 1 and 0.1, n = sqrt(2)/3, has Enskog's shear viscosity, 0.29379 at T = 1
 * (Erpenbeck 1989). */
static void viscosity_is_erpenbecks(void **state)
{
  (void)state;
  gg_species one = {0.5, 1, 1, 0.4, 1, 0}, two = {0.5, 1, 0.1, 0.4, 1, 0};
  gg_scene s = mixture(GG_USF, M_PI / 6 * sqrt(2) / 3, 1, -1, one, two, 100000);
  gg_model m = lab_model(&s);
  m.temperature0 = 15;
  lab_mean eta = {0};
  for (uint64_t seed = 1; seed <= 10; seed++) {
    gg_engine *g = lab_engine(&m, seed);
    double sum = 0;
    const int samples = 100;
    gg_collision_sums t;
    lab_advance(g, INFINITY, 20 * (uint64_t)m.n / 2);
    for (int i = 0; i < samples; i++) {
      gg_dsmc_ops.take_sums(g, &t);
      double time = lab_advance(g, INFINITY, (uint64_t)m.n / 4), P = 0, T = 0;
      lab_view k = {0};
      gg_dsmc_ops.snapshot(g, false, lab_add_chunk, &k);
      gg_dsmc_ops.take_sums(g, &t);
      for (int q = 0; q < GG_PAIRS; q++) P += t.stress[q][0][1] / (m.volume * time);
      for (int q = 0; q < 2; q++) T += m.mass[q] * k.cc_of[q] / (3 * k.n), P += m.mass[q] * k.xy_of[q] / m.volume;
      sum += -P / sqrt(T) / samples;
    }
    lab_add(&eta, sum);
    gg_dsmc_ops.destroy(g);
  }
  lab_expect("viscosity of a mixture", &eta, 0.29379, 0.0015, 0.05);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(elastic_mixtures_are_in_equilibrium), cmocka_unit_test(each_pair_of_species_has_its_pressure),
      cmocka_unit_test(two_names_for_one_species_change_nothing), cmocka_unit_test(cooling_mixtures_have_their_ratio),
      cmocka_unit_test(viscosity_is_erpenbecks)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
