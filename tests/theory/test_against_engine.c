/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories that solve the Enskog equation agree with the Monte Carlo engine: each within its stated accuracy, plus
 * four standard errors of the run. */
#include "theory_test.h"

#include "graingas.h"
#include "run/run.h"

static gg_result *run(gg_scene s)
{
  gg_result *result = NULL;
  gg_error err = {0};
  s.engine = GG_DSMC;
  s.dsmc.particles = 20000;
  s.run.relative_error = 0.003;
  s.run.seed = 11;
  if (gg_run_scene(&s, NULL, 1, NULL, &result, &err) != GG_OK) fail_msg("%s", err.message);
  return result;
}

static void compare(const gg_result *r, const gg_theory *theory, gg_quantity q, double relative, double absolute)
{
  double said = value_of(theory, &r->model, q), measured = r->value[q].mean, error = r->value[q].error;
  double bound = relative * fabs(measured) + absolute + 4 * error;
  if (!(fabs(said - measured) <= bound))
    fail_msg("%s: %s = %g, engine %g +- %g", theory->name, gg_common_quantity_name(q), said, measured, error);
}

/* Sheared grains: smooth and dilute, rough and dense. */
static void gaussian_closure(void **state)
{
  (void)state;
  const double phi[] = {0, 0.3}, beta[] = {-1, 1};
  for (int i = 0; i < 2; i++) {
    gg_result *r = run(scene_of(GG_USF, phi[i], 0.9, beta[i]));
    const gg_quantity close[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY, GG_Q_COLLISION_RATE};
    for (int q = 0; q < 4; q++) compare(r, &gg_theory_gaussian_closure, close[q], 0.007, 0);
    compare(r, &gg_theory_gaussian_closure, GG_Q_N1, 0.02, 0);
    compare(r, &gg_theory_gaussian_closure, GG_Q_N2, 0, 0.004);
    if (beta[i] > 0) compare(r, &gg_theory_gaussian_closure, GG_Q_TEMPERATURE_RATIO, 0.005, 0);
    gg_result_free(r);
  }
}

/* Enskog's equation solved twice: within four errors of the run, and the theory's own. Nightly two more dilute gases.
 */
static void noise_free(void **state)
{
  (void)state;
  gg_scene mixed = scene_of(GG_HSS, 0.1, 0.6, -1);
  mixed.n_species = 2;
  mixed.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  mixed.species[1] = (gg_species){0.5, 0.5, 0.5, 0.4, 1, 0};
  gg_scene sheared = mixed;
  sheared.flow = GG_USF, sheared.phi = 0.3;
  sheared.species[1] = (gg_species){0.5, 0.5, 0.1, 0.4, 1, 0};
  const gg_scene scene[] = {scene_of(GG_USF, 0.3, 0.7, -1),
                            scene_of(GG_USF, 0, 0.6, -1),
                            scene_of(GG_HCS, 0.1, 0.5, -1),
                            scene_of(GG_USF, 0, 0.8, 0),
                            scene_of(GG_USF, 0.3, 0.7, 0.5),
                            scene_of(GG_HCS, 0, 0.9, 0.5),
                            mixed,
                            sheared};
  enum { SCENES = sizeof scene / sizeof *scene };
  const gg_quantity same[] = {GG_Q_TEMPERATURE,
                              GG_Q_PRESSURE,
                              GG_Q_SHEAR_VISCOSITY,
                              GG_Q_COLLISION_RATE,
                              GG_Q_N1,
                              GG_Q_N2,
                              GG_Q_KURTOSIS_CX,
                              GG_Q_KURTOSIS_CY,
                              GG_Q_COOLING_RATE,
                              GG_Q_A2,
                              GG_Q_CUMULANT,
                              GG_Q_CUMULANT + 1,
                              GG_Q_PARTIAL_TEMPERATURE,
                              GG_Q_PARTIAL_TEMPERATURE + 1,
                              GG_Q_PARTIAL_TEMPERATURE_RATIO,
                              GG_Q_TEMPERATURE_RATIO,
                              GG_Q_SPIN_Z,
                              GG_Q_KURTOSIS_WX,
                              GG_Q_KURTOSIS_WZ,
                              GG_Q_SKEWNESS_WZ,
                              GG_Q_COS2_PSI,
                              GG_Q_A11,
                              GG_Q_ORIENTATION_B,
                              GG_Q_MEAN_FREE_PATH,
                              GG_Q_P_XY,
                              GG_Q_P_XX_COLLISIONAL};
  for (int i = 0; i < SCENES; i++) {
    if (!getenv("NIGHTLY") && (i == 1 || i == 5)) continue;
    gg_result *r = run(scene[i]);
    gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &r->model);
    int compared = 0;
    for (int k = 0; k < (int)(sizeof same / sizeof *same); k++) {
      double said = a.value[same[k]], measured = r->value[same[k]].mean;
      if (isnan(said) || isnan(measured)) continue;
      double bound = 4 * r->value[same[k]].error + a.error[same[k]];
      if (!(fabs(said - measured) <= bound))
        fail_msg("%d %s = %g, engine %g +- %g", i, gg_common_quantity_name(same[k]), said, measured, bound / 4);
      compared++;
    }
    assert_true(compared >= (scene[i].flow == GG_USF ? 9 : 4));
    gg_result_free(r);
  }
}

/* Free cooling: one species, and two that differ in mass. */
static void cooling_states_agree_with_the_engine(void **state)
{
  (void)state;
  gg_result *r = run(scene_of(GG_HCS, 0.2, 0.7, -1));
  compare(r, &gg_theory_garzo_dufty1999, GG_Q_COOLING_RATE, 0.002, 0);
  compare(r, &gg_theory_garzo_dufty1999, GG_Q_COMPRESSIBILITY, 0.002, 0);
  gg_result_free(r);
  gg_scene s = scene_of(GG_HCS, 0, 0.5, -1);
  s.n_species = 2;
  s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.5, 1, 0.5, 0.4, 1, 0};
  r = run(s);
  compare(r, &gg_theory_garzo_montanero2003, GG_Q_PARTIAL_TEMPERATURE_RATIO, 0.003, 0);
  compare(r, &gg_theory_garzo_montanero2003, GG_Q_COOLING_RATE, 0.003, 0);
  compare(r, &gg_theory_garzo_montanero2003, GG_Q_CUMULANT, 0.12, 0);
  compare(r, &gg_theory_garzo_montanero2003_ms, GG_Q_CUMULANT, 0.04, 0);
  gg_result_free(r);
}

/* Heated by white noise. */
static void heated_states_agree_with_the_engine(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_HSS, 0, 0.6, -1);
  s.thermostat = GG_WHITE_NOISE;
  gg_result *r = run(s);
  compare(r, &gg_theory_garzo_dufty1999, GG_Q_COOLING_RATE, 0.003, 0);
  compare(r, &gg_theory_garzo_dufty1999, GG_Q_A2, 0, 0.001);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaussian_closure),
      cmocka_unit_test(noise_free),
      cmocka_unit_test(cooling_states_agree_with_the_engine),
      cmocka_unit_test(heated_states_agree_with_the_engine),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
