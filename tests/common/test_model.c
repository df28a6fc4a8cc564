/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From scene to model: units, composition, contact values, limits; archives. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/archive.h"
#include "common/contact_value.h"
#include "common/quantity.h"
#include "common/relaxation_times.h"
#include "common/rng.h"
#include "common/thermostat.h"
#include "scene/model_of_scene.h"
#include "theory/mixture.h"

static void near(double a, double b, double tolerance)
{
  assert_true(fabs(a - b) <= tolerance * fmax(1, fabs(b)));
}

static gg_model make(const gg_scene *s)
{
  gg_model m;
  gg_error err = {0};
  gg_status status = gg_scene_model_make(s, s->engine, &m, &err);
  if (status != GG_OK) fail_msg("%s", err.message);
  return m;
}

/* The same physics in other units of length, mass and time is the same model. */
static void units_drop_out(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.phi = 0.3;
  gg_model a = make(&s);
  s.species[0].diameter = 0.002, s.species[0].mass = 1e-5, s.shear.rate = 40;
  gg_model b = make(&s);
  near(a.box[0], b.box[0], 1e-14);
  near(a.contact[0][0].jn, b.contact[0][0].jn, 1e-14);
  near(a.volume, a.n / a.density, 1e-14);
  near(M_PI / 6 * a.density, 0.3, 1e-14);
}

/* A mixture: fractions counted in grains, phi met exactly by those, chi_ij reduces to Carnahan-Starling for equal
 * sizes. */
static void a_mixture_has_its_fractions_and_contact_values(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.phi = 0.2, s.n_species = 2, s.particles = 1001;
  s.species[0] = (gg_species){0.25, 2, 3, 0.4, 1, 0};
  s.species[1] = (gg_species){0.75, 1, 6, 0.4, 1, 0};
  gg_model m = make(&s);
  assert_int_equal(m.n_of[0] + m.n_of[1], 1001);
  assert_int_equal(m.n_of[0], 250);
  double solid = M_PI / 6 * (m.n_of[0] * pow(m.diameter[0], 3) + m.n_of[1] * pow(m.diameter[1], 3)) / m.volume;
  near(solid, 0.2, 1e-13);
  near(m.mass[1], 2, 1e-15);
  near(m.sigma[GG_12], 0.75, 1e-15);
  assert_true(m.chi[GG_11] > m.chi[GG_22]); /* large grains touch more */
  s.species[0].diameter = s.species[1].diameter = 1;
  m = make(&s);
  near(m.chi[GG_12], gg_common_contact_value_of(GG_CARNAHAN_STARLING, 0.2), 1e-13);
}

/* Theories alone have no grains: a fraction is that of the scene, also where it is half a grain of a run, and nothing
 * depends on the number of grains. */
static void theories_have_no_grains(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  gg_model m, many;
  gg_error err = {0};
  s.phi = 0.2, s.n_species = 3;
  s.species[0] = (gg_species){0.0005, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){1 / 3., 2, 3, 0.4, 1, 0};
  s.species[2] = (gg_species){1 - 0.0005 - 1 / 3., 1.5, 1, 0.4, 1, 0};
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
  assert_int_equal(gg_scene_model_for_theories(&s, &m, &err), GG_OK);
  double solid = 0;
  for (int i = 0; i < 3; i++) {
    near(m.fraction[i], s.species[i].fraction, 1e-15);
    solid += M_PI / 6 * m.number_density[i] * pow(m.diameter[i], 3);
  }
  near(solid, 0.2, 1e-14);
  s.particles = 77;
  assert_int_equal(gg_scene_model_for_theories(&s, &many, &err), GG_OK);
  near(gg_common_model_collision_rate(&many, 1), gg_common_model_collision_rate(&m, 1), 0);
  near(gg_common_model_relaxation(&many), gg_common_model_relaxation(&m), 0);
}

/* Between walls Monte Carlo's gap has the height of md's, and Kn the length, to the last bit, also where its grains
 * have other fractions; the box holds the solid fraction. */
static void gap_is_that_of_md(void **state)
{
  (void)state;
  const double phi[] = {0.01, 0.123, 0.3};
  gg_scene s = gg_scene_defaults();
  s.flow = GG_COUETTE, s.walls.speed = 1;
  s.species[0] = (gg_species){0.667, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.333, 1.5, 1, 0.4, 1, 0};
  for (int k = 0; k < 12; k++) {
    s.phi = phi[k % 3], s.particles = 300 + 100 * k, s.dsmc.particles = 5000 + k, s.n_species = 1 + k % 2;
    s.engine = GG_MD;
    const gg_model md = make(&s);
    s.engine = GG_DSMC;
    const gg_model dsmc = make(&s);
    assert_true(md.box[1] == dsmc.box[1]);
    assert_true(dsmc.length == md.length && md.length == cbrt(md.volume)); /* that Kn is measured by */
    near(dsmc.box[0] * dsmc.box[1] * dsmc.box[2], dsmc.volume, 1e-13);
    near(dsmc.box[0] / dsmc.box[2], s.aspect[0] / s.aspect[2], 1e-14);
  }
}

/* Equations of state: published numbers, and Carnahan-Starling's known distance from them. */
static void equations_of_state_have_published_numbers(void **state)
{
  (void)state;
  const double phi[] = {0.1, 0.2, 0.3, 0.4, 0.45}, Z[] = {1.521647, 2.409403, 3.983983, 6.945460, 9.404114};
  for (int i = 0; i < 5; i++) {
    near(gg_common_compressibility(GG_KOLAFA, phi[i]), Z[i], 3e-7);
    double cs = gg_common_compressibility(GG_CARNAHAN_STARLING, phi[i]);
    near(cs, (1 + phi[i] + pow(phi[i], 2) - pow(phi[i], 3)) / pow(1 - phi[i], 3), 1e-13);
    assert_true(cs < Z[i] && cs > Z[i] * 0.997);
  }
  near(gg_common_contact_value_of(GG_LUN_SAVAGE, 0), 1, 0);
}

/* Vescovi's weight as the paper writes it, a quotient of polynomials. */
static double vescovi_weight(double phi)
{
  const double most = 0.636;
  return (phi * phi - 0.8 * phi + most * (0.8 - most)) / (0.8 * most - most * most - 0.16);
}

/* Contact values of sheared dissipative spheres: Carnahan & Starling's below phi = 0.4 or at small phi, the divergence
 * at 0.636, values at phi = 0.5 by hand. All formulas grow with phi. A scene selects them by name. */
static void contact_values_of_sheared_grains(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.6; phi += 0.07) {
    const double cs = gg_common_contact_value_of(GG_CARNAHAN_STARLING, phi), f = phi < 0.4 ? 1 : vescovi_weight(phi);
    near(gg_common_contact_value_of(GG_VESCOVI, phi), f * cs + (1 - f) * 2 / (0.636 - phi), 1e-13);
    near(gg_common_contact_value_of(GG_CHIALVO_SUNDARESAN, phi), cs + 0.58 * phi * phi * pow(0.636 - phi, -1.5), 1e-13);
  }
  near(gg_common_contact_value_of(GG_VESCOVI, 0.5), 7.563107, 1e-6);
  near(gg_common_contact_value_of(GG_CHIALVO_SUNDARESAN, 0.5), 8.891077, 1e-6);
  near(gg_common_contact_value_of(GG_VESCOVI, 0.636 - 1e-9) * 1e-9, 2, 1e-6);
  near(gg_common_contact_value_of(GG_CHIALVO_SUNDARESAN, 0.636 - 1e-10) * 1e-15, 0.58 * 0.636 * 0.636, 1e-4);
  for (int kind = GG_CARNAHAN_STARLING; kind <= GG_CHIALVO_SUNDARESAN; kind++) /* each grows up to its limit */
    for (double phi = gg_common_contact_value_limit((gg_contact_value)kind); phi > 0.01; phi -= 0.01)
      assert_true(gg_common_contact_value_of((gg_contact_value)kind, phi) >
                  gg_common_contact_value_of((gg_contact_value)kind, phi - 0.01));
  gg_scene s = gg_scene_defaults();
  s.phi = 0.5, s.contact_value = GG_VESCOVI;
  near(make(&s).chi[0], 7.563107, 1e-6);
  s.contact_value = GG_CHIALVO_SUNDARESAN;
  near(make(&s).chi[0], 8.891077, 1e-6);
}

/* Elastic species of unlike masses share their energy slowly: equal grains, half of them called otherwise, in 3/2
 * collisions; half of them m times as heavy in (3 m/16) (1 + 1/sqrt(2)), for large m. */
static void sharing_of_energy(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_EQUILIBRIUM, s.phi = 0.1, s.n_species = 2, s.collision.e[0] = 1;
  s.species[0] = s.species[1] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  for (int o = 0; o < GG_PAIRS; o++) s.collision.e[o] = 1;
  gg_model m = make(&s);
  near(gg_common_model_relaxation(&m), 1.5, 1e-12);
  s.species[1].mass = 1e8;
  m = make(&s);
  near(gg_common_model_relaxation(&m) / 1e8, 3 / 16.0 * (1 + sqrt(0.5)), 1e-3);
  const double two = gg_common_model_relaxation(&m);
  s.n_species = 4; /* the same grains; like ones share quickly, and the two kinds as slowly as before */
  for (int k = 0; k < 4; k++) s.species[k] = (gg_species){0.25, 1, 1, 0.4, 1, 0};
  s.species[2].mass = s.species[3].mass = 1e8;
  m = make(&s);
  near(gg_common_model_relaxation(&m) / two, 1, 1e-6);
}

/* Like grains that lose nothing among themselves cool by what they lose to the others: half of the collisions. */
static void loss_to_others(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_USF, s.phi = 0.1, s.n_species = 2;
  s.species[0] = s.species[1] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  for (int o = 0; o < GG_PAIRS; o++) s.collision.e[o] = 1;
  s.collision.e[gg_pair(0, 1)] = 0.8;
  gg_model m = make(&s);
  near(gg_common_model_relaxation(&m), 2 * 0.75 / (0.9 * 0.1), 1e-12);
}

/* If the engine rescales T, T does not relax, so a smooth gas has the least relaxation time, 1. The temperatures of
 * equal species relax faster than elastic ones do. The cooling time, with which sweeps scale shear rates, is unchanged.
 */
static void scaled_temperature(void **state)
{
  (void)state;
  const double e = 0.9999, loss = 0.75 / ((1 - e * e) / 4);
  gg_scene s = gg_scene_defaults();
  s.phi = 0.1, s.collision.e[0] = e;
  s.flow = GG_HCS;
  gg_model m = make(&s);
  near(gg_common_model_relaxation(&m), 1, 0);
  near(gg_common_model_cooling(&m), loss, 1e-9);
  s.flow = GG_HSS, s.thermostat = GG_GAUSSIAN;
  m = make(&s);
  near(gg_common_model_relaxation(&m), 1, 0);
  s.thermostat = GG_WHITE_NOISE; /* T relaxes to the value that the noise sets */
  m = make(&s);
  near(gg_common_model_relaxation(&m), loss, 1e-9);
  s.flow = GG_HCS, s.thermostat = GG_NO_THERMOSTAT, s.n_species = 2;
  s.species[0] = s.species[1] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  for (int o = 0; o < GG_PAIRS; o++) s.collision.e[o] = e;
  m = make(&s);
  near(gg_common_model_relaxation(&m), 1 / (1 / 1.5 + 1 / loss), 1e-9);
}

/* Models know whether they are elastic and steady; relaxation slows down towards beta = -1 and e = 1. */
static void models_know_what_is_elastic_and_steady(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.phi = 0.1;
  assert_true(make(&s).steady && !make(&s).elastic);
  s.collision.e[0] = 1;
  gg_model m = make(&s);
  assert_true(m.elastic && !m.steady);
  s.collision.beta[0] = 1;
  m = make(&s);
  assert_true(m.elastic && !m.steady && m.rule == GG_ROUGH);
  s.collision.mu[0] = 0.1;
  m = make(&s);
  assert_true(!m.elastic && m.steady && m.rule == GG_FRICTIONAL);
  s.collision.mu[0] = INFINITY, s.collision.e[0] = 0.9, s.collision.beta[0] = -0.99;
  m = make(&s);
  double slow = gg_common_model_relaxation(&m);
  s.collision.beta[0] = 0;
  m = make(&s);
  assert_true(slow > 20 * gg_common_model_relaxation(&m));
  s.phi = -1;
  gg_error err;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "phi"));
}

/* Slowly moving thermal walls: a gas starts at their temperature, however little the shear would heat it; fast ones: at
 * the shear's. */
static void start_between_thermal_walls(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_COUETTE, s.phi = 0.1, s.walls.speed = 100;
  const double by_shear = make(&s).temperature0;
  s.walls.temperature[0] = 1, s.walls.temperature[1] = 4;
  near(make(&s).temperature0, by_shear, 0);
  s.walls.speed = 1e-4;
  gg_model m = make(&s);
  near(m.temperature0, sqrt(m.surface[0].temperature * m.surface[1].temperature), 1e-14);
  assert_true(m.temperature0 > 1e6 * by_shear);
}

/* A wall that takes up some grains bounces the others: its e and beta still lose energy. */
static void partly_thermal_walls(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_CHUTE, s.phi = 0.1, s.collision.e[0] = 1, s.walls.e = 0.5;
  s.walls.temperature[0] = s.walls.temperature[1] = 1;
  for (int k = 0; k < 3; k++) {
    s.walls.accommodation = (const double[]){0, 0.001, 1}[k];
    assert_true(make(&s).elastic == (k == 2));
  }
}

/* Rates: 4 n d^2 chi sqrt(pi T), and the unit strings of sheared, thermal and Boltzmann scenes. */
static void rates_and_units(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.phi = 0.3;
  gg_model m = make(&s);
  near(gg_common_model_collision_rate(&m, 2), 24 * 0.3 * m.chi[0] * sqrt(2 / M_PI), 1e-13);
  assert_string_equal(gg_common_quantity_unit(GG_Q_TEMPERATURE, &m), "d^2 gamma^2");
  s.flow = GG_HCS;
  m = make(&s);
  near(m.temperature0, 0.5, 0);
  assert_string_equal(gg_common_quantity_unit(GG_Q_PRESSURE, &m), "rho_p v_0^2");
  s.phi = 0, s.engine = GG_DSMC;
  m = make(&s);
  near(gg_common_model_collision_rate(&m, 1), 4 * sqrt(M_PI), 1e-14);
  assert_int_equal(gg_common_quantity_find("N1"), GG_Q_N1);
  assert_int_equal(gg_common_quantity_find("N3"), GG_N_QUANTITIES);
}

/* White noise replaces what Maxwellians lose by collisions: of mixtures sum_i x_i (3/2) T zeta_i, whose zeta_i the
 * theories state on their own; of rough grains (3/2) G T [(A - B r) + (C r - B)], r = theta/T, with the A, B, C, G of
 * Huthmann & Zippelius 1997. Shared out by mass. */
static void noise_replaces_losses(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_HSS, s.thermostat = GG_WHITE_NOISE, s.phi = 0.2, s.particles = 1000;
  s.n_species = 2;
  s.species[0] = (gg_species){0.3, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.7, 1.5, 4, 0.4, 1, 0};
  for (int o = 0; o < 3; o++) s.collision.e[o] = 0.7 + 0.1 * o;
  gg_model m = make(&s);
  double T = m.temperature0, a[2] = {T / m.mass[0], T / m.mass[1]}, loss = 0, mass = 0;
  for (int i = 0; i < 2; i++) {
    loss += gg_theory_fraction(&m, i) * 1.5 * T * gg_theory_zeta(&m, i, a).at0;
    mass += gg_theory_fraction(&m, i) * m.mass[i];
  }
  near(gg_common_thermostat_noise(&m), loss / (1.5 * mass), 1e-13);
  s.n_species = 1, s.collision.e[0] = 0.8, s.collision.beta[0] = 0.3;
  m = make(&s);
  double h1 = m.contact[0][0].jn, h2 = m.contact[0][0].jt, K = m.inertia[0], r = m.ratio0;
  double A = h1 * (1 - h1) + h2 * (1 - h2), B = h2 * h2 / K, C = h2 / K * (1 - h2 / K);
  double G = 4. / 3 * gg_common_model_collision_rate(&m, m.temperature0);
  assert_true(r > 0.1);
  near(gg_common_thermostat_noise(&m), G * m.temperature0 * (A - B * r + C * r - B), 1e-13);
}

/* nu_0, in which cooling rates are counted: (16/5) sqrt(pi) n d^2 sqrt(T), and of two species sqrt(pi) n sigma_12^2 v_0
 * with v_0^2 = 2 T (m_1 + m_2)/(m_1 m_2); of three the mean of that over unlike pairs of grains. */
static void units_of_rates(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_HCS, s.phi = 0.1, s.particles = 1000;
  gg_model m = make(&s);
  near(gg_common_model_nu0(&m, 3), 16 * sqrt(M_PI) / 5 * m.density * sqrt(3), 1e-14);
  s.n_species = 2;
  s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.5, 2, 4, 0.4, 1, 0};
  m = make(&s);
  const double unit = sqrt(M_PI);
  near(gg_common_model_nu0(&m, 3), unit * m.density * 2.25 * sqrt(2 * 3 * 1.25), 1e-14);
  s.n_species = 3;
  s.species[0].fraction = 0.2, s.species[1].fraction = 0.3, s.species[2] = (gg_species){0.5, 3, 9, 0.4, 1, 0};
  m = make(&s);
  double pair[] = {2.25 * sqrt(6 * 1.25), 4 * sqrt(6 * 10. / 9), 6.25 * sqrt(6 * 13. / 36)};
  double mean = (0.06 * pair[0] + 0.1 * pair[1] + 0.15 * pair[2]) / 0.31;
  near(gg_common_model_nu0(&m, 3), unit * m.density * mean, 1e-14);
}

/* Archives return what was stored; missing, misshapen and double items are rejected; nested names do not collide. */
static void archives_return_what_was_put_in(void **state)
{
  (void)state;
  gg_archive a = {0}, b = {0}, c = {0};
  gg_error err;
  double x[3] = {1, 2, 3}, y[3] = {0};
  assert_int_equal(gg_base_archive_put(&a, "x", GG_ITEM_F64, x, 3, &err), GG_OK);
  assert_int_equal(gg_base_archive_put(&a, "x", GG_ITEM_F64, x, 3, &err), GG_FAILED);
  assert_int_equal(gg_base_archive_get(&a, "x", GG_ITEM_F64, y, 2, &err), GG_BAD_FILE);
  assert_int_equal(gg_base_archive_get(&a, "z", GG_ITEM_F64, y, 3, &err), GG_BAD_FILE);
  assert_int_equal(gg_base_archive_nest(&b, "one", &a, &err), GG_OK);
  assert_int_equal(gg_base_archive_nest(&b, "two", &a, &err), GG_OK);
  assert_int_equal(b.n_items, 2);
  assert_int_equal(gg_base_archive_unnest(&c, "two", &b, &err), GG_OK);
  assert_int_equal(gg_base_archive_get(&c, "x", GG_ITEM_F64, y, 3, &err), GG_OK);
  assert_memory_equal(x, y, sizeof x);
  gg_base_archive_clear(&a), gg_base_archive_clear(&b), gg_base_archive_clear(&c);
}

static void refused(const gg_scene *s, const char *words)
{
  gg_model m;
  gg_error err = {0};
  assert_int_equal(gg_scene_model_make(s, GG_DSMC, &m, &err), GG_BAD_INPUT);
  if (!strstr(err.message, words)) fail_msg("'%s' lacks '%s'", err.message, words);
}

/* Units that would overflow a double are rejected with the allowed range; those just within give finite models. */
static void scales_beyond_doubles_are_rejected(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  gg_model m;
  gg_error err = {0};
  const double tiny[] = {9e-21, 1e-300, 1e-308, 5e-324};
  for (int k = 0; k < 4; k++) s.phi = tiny[k], refused(&s, "allowed: from 1e-20 to 0.6, or 0");
  s.phi = 1e-20;
  assert_int_equal(gg_scene_model_make(&s, GG_DSMC, &m, &err), GG_OK);
  assert_true(isfinite(m.temperature0) && isfinite(m.volume) && m.density > 0);
  s.phi = 0.1, s.shear.rate = 1e-3, s.start.temperature = 1e-13;
  refused(&s, "here 1e-12 to 1e+24");
  s.start.temperature = 1e25;
  refused(&s, "here 1e-12 to 1e+24");
  s.start.temperature = 1.01e-12;
  assert_int_equal(gg_scene_model_make(&s, GG_DSMC, &m, &err), GG_OK);
  s.start.temperature = GG_AUTO, s.n_species = 2;
  s.species[0] = s.species[1] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  s.species[1].mass = 2e12;
  refused(&s, "values of mass in a ratio of 1 : 2e+12");
  s.species[1].mass = 1, s.species[1].diameter = 1e-7;
  refused(&s, "values of diameter");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(units_drop_out),
      cmocka_unit_test(a_mixture_has_its_fractions_and_contact_values),
      cmocka_unit_test(theories_have_no_grains),
      cmocka_unit_test(gap_is_that_of_md),
      cmocka_unit_test(equations_of_state_have_published_numbers),
      cmocka_unit_test(contact_values_of_sheared_grains),
      cmocka_unit_test(models_know_what_is_elastic_and_steady),
      cmocka_unit_test(sharing_of_energy),
      cmocka_unit_test(loss_to_others),
      cmocka_unit_test(scaled_temperature),
      cmocka_unit_test(start_between_thermal_walls),
      cmocka_unit_test(partly_thermal_walls),
      cmocka_unit_test(rates_and_units),
      cmocka_unit_test(noise_replaces_losses),
      cmocka_unit_test(units_of_rates),
      cmocka_unit_test(archives_return_what_was_put_in),
      cmocka_unit_test(scales_beyond_doubles_are_rejected),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
