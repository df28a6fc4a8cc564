/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trajectories read back, a frame at a time; what theories say of gases that cool. */
#include "api_test.h"

#define PI 3.14159265358979323846
#define MIXTURE                                                                                                        \
  "{flow: usf, phi: 0.2, particles: 200, collision: {e: 0.9, beta: 0.3}, species: [{fraction: 0.6}, {fraction: 0.4, "  \
  "diameter: 1.5, mass: 2}], output: {trajectory_every: 2}, run: {collisions: 12, warmup: 4}}"
#define COOLING "{flow: hcs, phi: 0.1, particles: 2000, collision: {e: 0.9}}"

enum { N = 200 };

static void run_to(const char *yaml, const char *file)
{
  gg_error err;
  gg_scene *s = scene_of(yaml);
  gg_result *r = NULL;
  /* The run misses its error criterion, but its result is written. */
  gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = file}, &r, &err);
  assert_non_null(r);
  gg_result_free(r);
  gg_scene_free(s);
}

/* Temperatures are those of the grains handed out, the box that of the scene, and it slides with time. */
static void frames_and_grains(void **state)
{
  (void)state;
  gg_error err;
  double position[3 * N], velocity[3 * N], spin[3 * N], other[3 * N], before = -1;
  int species[N];
  const gg_grains into = {position, velocity, spin, species};
  gg_trajectory *t = NULL;
  gg_simulation_state now;
  gg_species_state kind[2];
  run_to(MIXTURE, "t_mixture.h5");
  assert_ok(gg_trajectory_open("t_mixture.h5", &t, &err));
  assert_refused(gg_trajectory_get_species(t, 0, &kind[0], &err), "read a frame of the trajectory first");
  const size_t frames = gg_trajectory_frames(t);
  assert_true(frames >= 5 && frames < 20);
  for (size_t k = 0; k < frames; k++) {
    assert_ok(gg_trajectory_frame(t, k, &now, &into, &err));
    assert_true(now.time > before && now.grains == N && fabs(now.strain - now.time) < 1e-12);
    before = now.time;
    const double slid = fmod(now.time * now.box[1], now.box[0]);
    assert_true(fabs(remainder(now.image_offset - slid, now.box[0])) < 1e-9 && now.image_offset >= 0);
    double T = 0, T_of[2] = {0}, xy = 0;
    size_t n[2] = {0};
    for (int i = 0; i < 2; i++) assert_ok(gg_trajectory_get_species(t, i, &kind[i], &err));
    for (size_t i = 0; i < N; i++) {
      n[species[i]]++;
      const double mass = kind[species[i]].mass, *c = velocity + 3 * i;
      for (size_t a = 0; a < 3; a++) {
        T += mass * c[a] * c[a] / (3 * N);
        T_of[species[i]] += mass * c[a] * c[a] / (3 * (double)kind[species[i]].grains);
        assert_true(position[3 * i + a] >= 0 && position[3 * i + a] <= now.box[a]);
      }
      xy += mass * c[0] * c[1] / N;
    }
    assert_true(fabs(T / now.temperature - 1) < 1e-12 && now.rotational_temperature > 0);
    assert_true(xy * now.kinetic_stress[0][1] > 0);
    for (int i = 0; i < 2; i++) assert_true(n[i] == kind[i].grains && fabs(T_of[i] / kind[i].temperature - 1) < 1e-12);
  }
  assert_true(kind[0].diameter == 1 && fabs(kind[1].diameter - 1.5) < 1e-12 && fabs(kind[1].mass - 2) < 1e-12);
  assert_true(fabs(now.collisions_per_grain - (double)now.collisions / (N / 2)) < 1e-9);
  /* any order, any part */
  assert_ok(gg_trajectory_frame(t, 1, NULL, NULL, &err));
  assert_ok(gg_trajectory_frame(t, frames - 1, NULL, &(gg_grains){.velocity = other}, &err));
  assert_memory_equal(other, velocity, sizeof other);
  gg_result *r = NULL;
  assert_ok(gg_result_read("t_mixture.h5", &r, &err));
  assert_ok(gg_result_grains(r, &(gg_grains){.spin = other}, &err));
  assert_memory_equal(other, spin, sizeof other);
  char text[64];
  assert_ok(gg_scene_get(gg_trajectory_scene(t), "particles", text, sizeof text, &err));
  assert_string_equal(text, "200");
  assert_refused(gg_trajectory_frame(t, frames, &now, NULL, &err), "there is no frame");
  assert_refused(gg_trajectory_get_species(t, 2, &kind[0], &err), "there is no species 2");
  gg_result_free(r);
  gg_trajectory_free(t);
}

static void spins_of_smooth_grains(void **state)
{
  (void)state;
  gg_error err;
  double spin[3 * N];
  gg_trajectory *t = NULL;
  gg_simulation_state now;
  run_to("{flow: couette, phi: 0.2, particles: 200, collision: {e: 0.9}, run: {collisions: 4, warmup: 1}}", "t_one.h5");
  assert_ok(gg_trajectory_open("t_one.h5", &t, &err));
  assert_int_equal(gg_trajectory_frames(t), 1); /* the last state alone */
  spin[7] = 1;
  assert_ok(gg_trajectory_frame(t, 0, &now, &(gg_grains){.spin = spin}, &err));
  for (int i = 0; i < 3 * N; i++) assert_true(spin[i] == 0);
  assert_true(now.rotational_temperature == 0 && now.strain == 0 && now.image_offset == 0);
  gg_trajectory_free(t);
}

static void assert_no_trajectory(const char *file, gg_status wanted, const char *words)
{
  gg_error err;
  gg_trajectory *t = NULL;
  assert_int_equal(gg_trajectory_open(file, &t, &err), wanted);
  assert_null(t);
  if (!strstr(err.message, words) || !strstr(err.message, file)) fail_msg("'%s' lacks '%s'", err.message, words);
}

static void results_without_trajectory_are_rejected(void **state)
{
  (void)state;
  gg_error err;
  gg_trajectory *t = NULL;
  run_to("{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 200}, run: {collisions: 4, warmup: 1}}", "t_dsmc.h5");
  assert_no_trajectory("t_dsmc.h5", GG_FAILED, "it holds no positions of grains");
  assert_no_trajectory("t_none.h5", GG_BAD_FILE, "No such file");
  FILE *f = fopen("t_text.h5", "w");
  fputs("these are no grains", f);
  fclose(f);
  assert_no_trajectory("t_text.h5", GG_BAD_FILE, "it is not an HDF5 file");
  run_to(MIXTURE, "t_damaged.h5");
  f = fopen("t_damaged.h5", "r+");
  fseek(f, 20000, SEEK_SET);
  fputs("damage", f);
  fclose(f);
  assert_no_trajectory("t_damaged.h5", GG_BAD_FILE, "its checksum does not match");
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(COOLING);
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_ok(gg_simulation_save(m, "t_checkpoint.h5", NULL, NULL, &err));
  assert_no_trajectory("t_checkpoint.h5", GG_BAD_FILE, "it is a checkpoint");
  gg_simulation_free(m);
  gg_scene_free(s);
  assert_refused(gg_trajectory_open(NULL, &t, &err), "is missing (NULL)");
  assert_refused(gg_trajectory_open("x", NULL, &err), "is missing (NULL)");
  assert_refused(gg_trajectory_frame(NULL, 0, NULL, NULL, &err), "is missing (NULL)");
  assert_refused(gg_trajectory_get_species(NULL, 0, NULL, &err), "is missing (NULL)");
  assert_null(gg_trajectory_scene(NULL));
  assert_int_equal(gg_trajectory_frames(NULL), 0);
  gg_trajectory_free(NULL);
}

static gg_comparison *theories_of(const char *yaml)
{
  gg_error err;
  gg_comparison *c = NULL;
  gg_scene *s = scene_of(yaml);
  assert_ok(gg_theories_evaluate(s, NULL, NULL, NULL, &c, &err));
  gg_scene_free(s);
  return c;
}

/* It begins at the theory's temperature, falls at its rate (counted in 16/5 sqrt(pi) n d^2 sqrt(T)), in the end as
 * t^-2; and grains follow it: T of 2000 fluctuates by 1.8 % at most here (a standard error of 0.9 % at T's chi^2 of
 * 6000 numbers, twice), and a cooling gas keeps what it starts with. */
static void a_played_cooling_gas_follows_haff(void **state)
{
  (void)state;
  gg_error err;
  double T0, T, rate, start;
  gg_comparison *c = theories_of(COOLING);
  assert_ok(gg_comparison_theory_value(c, "haff1983", "temperature", &start, NULL, &err));
  assert_ok(gg_comparison_theory_value(c, "haff1983", "cooling_rate", &rate, NULL, &err));
  assert_ok(gg_comparison_theory_cooling(c, "haff1983", 0, &T0, &err));
  assert_true(fabs(T0 / start - 1) < 1e-12);
  const double zeta = rate * 16 / 5 * sqrt(PI) * 0.1 * 6 / PI * sqrt(T0);
  assert_ok(gg_comparison_theory_cooling(c, "haff1983", 1e-5, &T, &err));
  assert_true(fabs((1 - T / T0) / (1e-5 * zeta) - 1) < 1e-4);
  assert_ok(gg_comparison_theory_cooling(c, "haff1983", 1e9, &T, &err));
  assert_true(fabs(T / T0 * pow(zeta * 1e9 / 2, 2) - 1) < 1e-6);
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(COOLING);
  gg_simulation_state now;
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_ok(gg_simulation_advance(m, 6 / zeta, &err)); /* to T_0/16 */
  assert_ok(gg_simulation_get_state(m, &now, &err));
  assert_ok(gg_comparison_theory_cooling(c, "garzo_dufty1999", now.time, &T, &err));
  if (fabs(now.temperature / T - 1) > 0.08) fail_msg("T of the grains: %g, of the theory: %g", now.temperature, T);
  gg_simulation_free(m);
  gg_scene_free(s);
  assert_refused(gg_comparison_theory_cooling(c, "grade", 1, &T, &err), "there is no theory called 'grade' here");
  assert_refused(gg_comparison_theory_cooling(c, "haff1983", -1, &T, &err), "before the start");
  assert_refused(gg_comparison_theory_cooling(c, "goldhirsch_zanetti1993", 1, &T, &err),
                 "gives no cooling rate for this scene");
  assert_refused(gg_comparison_theory_cooling(NULL, "haff1983", 1, &T, &err), "is missing (NULL)");
  assert_refused(gg_comparison_theory_cooling(c, NULL, 1, &T, &err), "is missing (NULL)");
  assert_refused(gg_comparison_theory_cooling(c, "haff1983", 1, NULL, &err), "is missing (NULL)");
  gg_comparison_free(c);
  const char *const others[] = {"{flow: usf, phi: 0.1}", "{flow: hcs, phi: 0.1, collision: {beta: 0}}",
                                "{flow: hcs, phi: 0.1, collision: {law: viscoelastic}}"};
  for (int i = 0; i < 3; i++) {
    c = theories_of(others[i]);
    assert_refused(gg_comparison_theory_cooling(c, "enskog", 1, &T, &err), "Haff's law holds for equal smooth grains");
    gg_comparison_free(c);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(frames_and_grains),
      cmocka_unit_test(spins_of_smooth_grains),
      cmocka_unit_test(results_without_trajectory_are_rejected),
      cmocka_unit_test(a_played_cooling_gas_follows_haff),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
