/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations step by step: what they show agrees with itself and with the conservation laws; cut, saved and loaded
 * they go on bit for bit. */
#include "api_test.h"

#define ROUGH "{flow: usf, phi: 0.2, particles: 200, collision: {e: 0.9, beta: 0}}"

static gg_simulation *simulation_of(const char *yaml)
{
  gg_error err;
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(yaml);
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  gg_scene_free(s); /* a simulation has its own copy */
  return m;
}

static gg_simulation_state state_of(const gg_simulation *m)
{
  gg_error err;
  gg_simulation_state now;
  assert_ok(gg_simulation_get_state(m, &now, &err));
  return now;
}

enum { MOST = 1000 };
static double position[3 * MOST], velocity[3 * MOST], spin[3 * MOST];
static int species[MOST];

static void take_grains(const gg_simulation *m, int positions)
{
  gg_error err;
  gg_grains into = {positions ? position : NULL, velocity, spin, species};
  assert_ok(gg_simulation_get_grains(m, &into, &err));
}

/* Time, strain and image offset of a sheared gas; the temperature is that of the velocities handed out. */
static void state_and_grains(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of(ROUGH);
  assert_ok(gg_simulation_advance(m, 1.75, &err));
  gg_simulation_state now = state_of(m);
  assert_true(fabs(now.time - 1.75) < 1e-12 && fabs(now.strain - 1.75) < 1e-12);
  double slid = fmod(1.75 * now.box[1], now.box[0]);
  assert_true(fabs(remainder(now.image_offset - slid, now.box[0])) < 1e-9);
  assert_true(fabs(now.box[0] * now.box[1] * now.box[2] - 200 * 3.14159265358979 / 6 / 0.2) < 1e-6);
  assert_true(now.grains == 200 && fabs(now.collisions_per_grain - (double)now.collisions / 100) < 1e-12);
  take_grains(m, 1);
  double T = 0, Pxy = 0, w[3] = {0}, theta = 0;
  for (size_t i = 0; i < 200; i++) {
    for (size_t a = 0; a < 3; a++) {
      T += velocity[3 * i + a] * velocity[3 * i + a] / 600;
      w[a] += spin[3 * i + a] / 200;
      assert_true(position[3 * i + a] >= 0 && position[3 * i + a] < now.box[a]);
    }
    Pxy += velocity[3 * i] * velocity[3 * i + 1] / 200;
    assert_int_equal(species[i], 0);
  }
  for (size_t i = 0; i < 600; i++) theta += 0.1 * pow(spin[i] - w[i % 3], 2) / 600; /* I = 0.1 m d^2 */
  assert_true(fabs(T / now.temperature - 1) < 1e-12 && fabs(theta / now.rotational_temperature - 1) < 1e-12);
  assert_true(fabs(0.2 * Pxy - now.kinetic_stress[0][1]) < 1e-12); /* phi <C_x C_y> in rho_p d^2 gamma^2 */
  gg_simulation_free(m);
}

static uint64_t hash_of(const gg_simulation *m)
{
  gg_error err;
  uint64_t hash;
  assert_ok(gg_simulation_hash(m, &hash, &err));
  return hash;
}

/* The hash differs with the seed, the engine and by one collision; equal states have equal hashes. */
static void equal_states_have_equal_hashes(void **state)
{
  (void)state;
  gg_error err;
  const char *const scenes[] = {ROUGH,
                                "{flow: usf, phi: 0.2, particles: 200, collision: {e: 0.9, beta: 0}, run: {seed: 2}}",
                                "{flow: usf, phi: 0.2, engine: dsmc, dsmc: {particles: 200}, collision: {e: 0.9}}"};
  uint64_t found[4];
  for (int i = 0; i < 3; i++) {
    gg_simulation *m = simulation_of(scenes[i]), *again = simulation_of(scenes[i]);
    assert_ok(gg_simulation_collide(m, 1000, &err));
    assert_ok(gg_simulation_collide(again, 1000, &err));
    found[i] = hash_of(m);
    assert_true(hash_of(again) == found[i]);
    if (i == 0) {
      assert_ok(gg_simulation_collide(again, 1, &err));
      found[3] = hash_of(again);
    }
    gg_simulation_free(m);
    gg_simulation_free(again);
  }
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < i; j++) assert_true(found[i] != found[j]);
}

/* Just so many collisions in md; cutting an advance into pieces changes nothing. */
static void cut_into_steps(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *one = simulation_of(ROUGH), *two = simulation_of(ROUGH);
  assert_ok(gg_simulation_collide(one, 12345, &err));
  for (int i = 0; i < 5; i++) assert_ok(gg_simulation_collide(two, 2469, &err));
  gg_simulation_state a = state_of(one), b = state_of(two);
  assert_true(hash_of(one) == hash_of(two));
  assert_int_equal(a.collisions, 12345);
  assert_int_equal(b.collisions, 12345);
  assert_true(fabs(a.time - b.time) < 1e-9);
  static double first[3 * MOST];
  take_grains(one, 1);
  memcpy(first, velocity, sizeof first);
  take_grains(two, 1);
  for (size_t i = 0; i < 600; i++) assert_true(fabs(first[i] - velocity[i]) < 1e-9);
  gg_simulation_free(one);
  gg_simulation_free(two);
}

typedef struct collision_sums {
  uint64_t n;
  double stress[3][3], loss, worst;
  size_t last[2];
} collision_sums;

static void add_collision(void *context, const gg_collision_event *e)
{
  collision_sums *s = context;
  double dot = 0, Jn = 0, unit = 0;
  for (int a = 0; a < 3; a++) {
    dot += e->k[a] * e->velocity[a], Jn += e->k[a] * e->impulse[a], unit += e->k[a] * e->k[a];
    for (int b = 0; b < 3; b++) s->stress[a][b] += e->k[a] * e->impulse[b];
  }
  s->n++;
  s->worst = fmax(s->worst, fmax(fabs(unit - 1), fabs(dot - e->normal_speed)));
  s->worst = fmax(s->worst, fabs(Jn - 0.95 * e->normal_speed)); /* m_r (1 + e) g_n */
  assert_true(e->normal_speed > 0 && e->grain[0] != e->grain[1] && e->grain[0] < 200 && e->grain[1] < 200);
  memcpy(s->last, e->grain, sizeof s->last);
}

/* Every collision is shown with the rule's normal impulse, and their sum is the collisional stress; energy goes where
 * the shear work and the dissipation say. */
static void collisions_and_sums(const char *yaml, double volume)
{
  gg_error err;
  gg_simulation *m = simulation_of(yaml);
  collision_sums s = {0};
  gg_simulation_sums sums;
  assert_ok(gg_simulation_advance(m, 0.5, &err));
  assert_ok(gg_simulation_take_sums(m, &sums, &err));
  assert_true(fabs(sums.time - 0.5) < 0.05 && sums.dissipation > 0);
  assert_ok(gg_simulation_on_collision(m, add_collision, &s, &err));
  double start = state_of(m).time;
  assert_ok(gg_simulation_collide(m, 5000, &err));
  assert_ok(gg_simulation_take_sums(m, &sums, &err));
  assert_true(s.n == sums.collisions && s.n >= 5000 && s.worst < 1e-12);
  assert_true(fabs(sums.time - (state_of(m).time - start)) < 1e-12);
  double unit = 3.14159265358979323846 / 6 / (volume * sums.time);
  assert_true(fabs(s.stress[0][1] * unit - sums.collisional_stress[0][1]) < 1e-9 * fabs(sums.collisional_stress[0][1]));
  assert_true(fabs(s.stress[2][2] * unit - sums.collisional_stress[2][2]) < 1e-9 * fabs(sums.collisional_stress[2][2]));
  assert_ok(gg_simulation_on_collision(m, NULL, NULL, &err));
  uint64_t before = s.n;
  assert_ok(gg_simulation_collide(m, 100, &err));
  assert_true(s.n == before);
  gg_simulation_free(m);
}

static void note_time(void *context, const gg_collision_event *e)
{
  double *last = context;
  assert_true(e->time >= *last);
  *last = e->time;
}

/* Times of collisions do not decrease, and the last is the time of the state: in free cooling, where the engine changes
 * its unit of time, and with thermostats, too. */
static void times_of_collisions(void **state)
{
  (void)state;
  const char *const scenes[] = {ROUGH, "{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.5}}",
                                "{flow: hss, phi: 0.1, particles: 200, thermostat: gaussian}",
                                "{flow: hss, phi: 0.1, particles: 200, thermostat: white_noise}"};
  for (int i = 0; i < 4; i++) {
    gg_error err;
    double last = 0;
    gg_simulation *m = simulation_of(scenes[i]);
    assert_ok(gg_simulation_on_collision(m, note_time, &last, &err));
    for (uint64_t step = 1; step < 20000; step *= 3) {
      assert_ok(gg_simulation_collide(m, step, &err));
      if (fabs(last / state_of(m).time - 1) > 1e-12) fail_msg("scene %d: %g, %g", i, last, state_of(m).time);
    }
    gg_simulation_free(m);
  }
}

static void collisions_of_md(void **state)
{
  (void)state;
  collisions_and_sums(ROUGH, 200 * 3.14159265358979323846 / 6 / 0.2);
}

static void collisions_of_dsmc(void **state)
{
  (void)state;
  collisions_and_sums("{flow: usf, phi: 0.2, engine: dsmc, dsmc: {particles: 200}, collision: {e: 0.9, beta: 0}}",
                      200 * 3.14159265358979323846 / 6 / 0.2);
}

/* Without shear and thermostat the energy decreases by the dissipation in the collision sums. */
static void energy_balance(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.8}}");
  gg_simulation_sums sums;
  double before = state_of(m).temperature;
  assert_true(fabs(before - 0.5) < 1e-12); /* T_0 = 1/2 in units of v_0^2 */
  assert_ok(gg_simulation_advance(m, 30, &err));
  assert_ok(gg_simulation_take_sums(m, &sums, &err));
  double lost = 1.5 * 0.1 * (before - state_of(m).temperature); /* (3/2) n T in rho_p v_0^2 */
  assert_true(fabs(sums.dissipation * sums.time / lost - 1) < 1e-9);
  gg_simulation_free(m);
}

/* The energy changes by what kicks at contact give less what collisions destroy. */
static void kicks_are_counted(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    gg_simulation_sums sums;
    gg_simulation *m =
        simulation_of(k ? "{flow: hss, engine: md, phi: 0.1, particles: 200, collision: {e: 0.8, normal_kick: 0.2}}"
                        : "{flow: hss, engine: dsmc, phi: 0.1, particles: 200, collision: {e: 0.8, normal_kick: 0.2}}");
    assert_ok(gg_simulation_take_sums(m, &sums, &err));
    const double before = state_of(m).temperature;
    assert_ok(gg_simulation_advance(m, 10, &err));
    assert_ok(gg_simulation_take_sums(m, &sums, &err));
    const double more = 1.5 * 0.1 * (state_of(m).temperature - before);
    assert_true(sums.injection * sums.time > 0.05 * before);
    assert_true(fabs((sums.injection - sums.dissipation) * sums.time - more) < 1e-9 * sums.injection * sums.time);
    gg_simulation_free(m);
  }
}

/* Free cooling over many decades stays in the units of the start: T falls as Haff's law has it, and time goes on. */
static void cooling_over_decades(void **state)
{
  (void)state;
  gg_error err;
  const char *const engines[] = {"{flow: hcs, phi: 0.01, particles: 200, collision: {e: 0.7}}",
                                 "{flow: hcs, phi: 0.01, engine: dsmc, dsmc: {particles: 1000}, collision: {e: 0.7}}"};
  for (int k = 0; k < 2; k++) {
    gg_simulation *m = simulation_of(engines[k]);
    gg_simulation_state half, whole;
    assert_ok(gg_simulation_advance(m, 5e6, &err));
    half = state_of(m);
    assert_ok(gg_simulation_advance(m, 5e6, &err));
    whole = state_of(m);
    assert_true(fabs(whole.time / 1e7 - 1) < 1e-3 && half.temperature < 1e-8);
    double allowed = k == 0 ? 1.2 : 0.4; /* 200 grains in a box are not quite homogeneous */
    assert_true(fabs(half.temperature / whole.temperature - 4) < allowed); /* T goes as 1/t^2 */
    gg_simulation_free(m);
  }
}

/* Saved and loaded, a simulation goes on bit for bit; another scene, or a file that is none, is refused. */
static void saved_and_loaded(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of(ROUGH), *again = NULL;
  assert_ok(gg_simulation_collide(m, 3000, &err));
  assert_ok(gg_simulation_save(m, "t_saved.h5", NULL, NULL, &err));
  assert_ok(gg_simulation_load("t_saved.h5", NULL, NULL, NULL, &again, &err));
  gg_simulation *both[] = {m, again};
  static double first[3 * MOST];
  gg_simulation_state now[2];
  gg_simulation_sums sums[2];
  for (int k = 0; k < 2; k++) {
    assert_ok(gg_simulation_advance(both[k], 1.5, &err));
    assert_ok(gg_simulation_take_sums(both[k], &sums[k], &err));
    now[k] = state_of(both[k]);
    take_grains(both[k], 1);
    if (k == 0) memcpy(first, velocity, sizeof first);
  }
  assert_memory_equal(first, velocity, sizeof first);
  assert_memory_equal(&now[0], &now[1], sizeof now[0]);
  assert_memory_equal(&sums[0], &sums[1], sizeof sums[0]);
  gg_simulation_free(again);
  again = NULL;
  gg_scene *other = scene_of(ROUGH);
  assert_ok(gg_scene_set(other, "collision.e", "0.8", &err));
  assert_refused(gg_simulation_load("t_saved.h5", other, NULL, NULL, &again, &err), "collision.e differs");
  assert_ok(gg_scene_set(other, "collision.e", "0.9", &err));
  const char *const words[][3] = {{"engine", "dsmc", "engine differs (there md, here dsmc)"},
                                  {"flow", "hcs", "flow differs (there usf, here hcs)"},
                                  {"contact_value", "kolafa", "(there carnahan_starling, here kolafa)"},
                                  {"temperature", "2", "temperature differs (there auto, here 2)"},
                                  {"dsmc.precision", "single", "(there double, here single)"},
                                  {"measure", "[rheology, cells]", "(there rheology, here rheology, cells)"}};
  for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
    gg_scene *changed = scene_of(ROUGH);
    assert_ok(gg_scene_set(changed, words[k][0], words[k][1], &err));
    assert_refused(gg_simulation_load("t_saved.h5", changed, NULL, NULL, &again, &err), words[k][2]);
    gg_scene_free(changed);
  }
  gg_checkpoint_info about;
  gg_scene *stored = NULL;
  char phi[40];
  assert_ok(gg_checkpoint_about("t_saved.h5", &about, &stored, &err));
  assert_true(strcmp(about.kind, "simulation") == 0 && strcmp(about.part[0].engine, "md") == 0);
  assert_true(about.part[0].collisions_per_grain > 0 && !about.part[1].engine && !about.older);
  assert_ok(gg_scene_get(stored, "phi", phi, sizeof phi, &err));
  assert_true(strtod(phi, NULL) > 0);
  gg_scene_free(stored);
  assert_int_equal(gg_checkpoint_about("t_nowhere.h5", &about, NULL, &err), GG_BAD_FILE);
  assert_ok(gg_simulation_load("t_saved.h5", other, NULL, NULL, &again, &err));
  gg_simulation_free(again);
  assert_int_equal(gg_simulation_load("t_nowhere.h5", NULL, NULL, NULL, &again, &err), GG_BAD_FILE);
  gg_scene_free(other);
  gg_simulation_free(m);
}

/* Streams of one seed differ; a scene that an engine cannot run is rejected with the reason. */
static void streams_of_one_seed_differ(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.2, engine: dsmc, dsmc: {particles: 200}}");
  gg_simulation *m[2];
  double x[2];
  for (int k = 0; k < 2; k++) {
    assert_ok(gg_simulation_new(s, &(gg_start_options){.size = sizeof(gg_start_options), .stream = (uint64_t)k}, &m[k],
                                &err));
    take_grains(m[k], 0);
    x[k] = velocity[0];
  }
  assert_true(x[0] != x[1]);
  gg_grains into = {position, NULL, NULL, NULL};
  assert_refused(gg_simulation_get_grains(m[0], &into, &err), "it has no positions");
  assert_refused(gg_simulation_advance(m[0], -1, &err), "cannot advance by -1");
  assert_refused(gg_simulation_advance(m[0], NAN, &err), "cannot advance");
  for (int k = 0; k < 2; k++) gg_simulation_free(m[k]);
  assert_ok(gg_scene_set(s, "phi", "0", &err));
  assert_ok(gg_scene_set(s, "engine", "md", &err));
  assert_refused(gg_simulation_new(s, NULL, &m[0], &err), "phi");
  gg_scene_free(s);
}

typedef struct start_facts {
  double temperature, e;
} start_facts;

static const char *note_facts(void *context, const gg_facts *facts, double *values)
{
  (void)values;
  *(start_facts *)context = (start_facts){facts->temperature, facts->pairs[0].e};
  return NULL;
}

static double slowly_falling(void *context, double speed, int one, int two)
{
  (void)context, (void)one, (void)two;
  return 1 / (1 + 0.1 * pow(speed, 0.2));
}

/* The facts that theories are shown are those that simulations start from. */
static void facts_of_the_start(void **state)
{
  (void)state;
  const char *const scenes[] = {"{flow: usf, phi: 0.1, particles: 400}",
                                "{flow: usf, phi: 0.1, particles: 400, temperature: 3}",
                                "{flow: usf, phi: 0.1, particles: 400, collision: {e: 0.7, beta: 0.2}}",
                                "{flow: usf, engine: dsmc, phi: 0, dsmc: {particles: 20000}}",
                                "{flow: equilibrium, phi: 0.1, particles: 400}",
                                "{flow: hcs, phi: 0.1, particles: 400}",
                                "{flow: hss, phi: 0.1, particles: 400}",
                                "{flow: poiseuille, phi: 0.1, particles: 400, gravity: [0.01, 0, 0]}",
                                "{flow: chute, phi: 0.1, particles: 400, gravity: [0.01, -0.02, 0]}",
                                "{flow: couette, phi: 0.1, particles: 400, walls: {speed: 1}}"};
  for (size_t k = 0; k < 2 * sizeof scenes / sizeof *scenes; k++) {
    gg_error err;
    start_facts facts = {NAN, NAN};
    const char *const answers[] = {"temperature"};
    const gg_theory_definition theory = {
        .name = "noting", .n_quantities = 1, .quantities = answers, .evaluate = note_facts, .context = &facts};
    gg_scene *s = scene_of(scenes[k / 2]);
    if (k % 2) assert_ok(gg_scene_set_restitution(s, "falling", slowly_falling, NULL, &err));
    assert_ok(gg_scene_add_theory(s, &theory, &err));
    gg_comparison *c = NULL;
    gg_simulation *m = NULL;
    assert_ok(gg_theories_evaluate(s, "noting", NULL, NULL, &c, &err));
    assert_ok(gg_simulation_new(s, NULL, &m, &err));
    gg_simulation_state now = state_of(m);
    double T = now.temperature;
    if (strstr(scenes[k / 2], "couette")) { /* less the laminar profile, of rate 1 */
      take_grains(m, 1);
      T = 0;
      for (size_t i = 0; i < now.grains; i++) {
        velocity[3 * i] -= position[3 * i + 1] - now.box[1] / 2;
        for (size_t a = 0; a < 3; a++) T += velocity[3 * i + a] * velocity[3 * i + a] / (3 * (double)now.grains);
      }
    }
    if (!(fabs(facts.temperature / T - 1) < 4 * sqrt(2 / (3 * (double)now.grains))))
      fail_msg("%s: facts say %g, the simulation has %g", scenes[k / 2], facts.temperature, T);
    if (k % 2) {
      double e = slowly_falling(NULL, sqrt(3.14159265358979 * facts.temperature), 0, 0);
      assert_true(fabs(facts.e - e) < 2e-3);
    }
    gg_simulation_free(m);
    gg_comparison_free(c);
    gg_scene_free(s);
  }
}

static int after_some(void *context)
{
  return --*(int *)context == 0;
}

/* Stopped within a call, a simulation stands where it has come to, says so, and goes on: in md on the same trajectory.
 */
static void a_stopped_simulation_continues_its_trajectory(void **state)
{
  (void)state;
  gg_error err;
  const char *const scenes[] = {"{flow: hcs, phi: 1e-4, particles: 300, collision: {e: 0.9}}",
                                "{flow: usf, phi: 0.1, engine: dsmc, dsmc: {particles: 300, time_step: 1e-4}}"};
  for (int k = 0; k < 2; k++) {
    gg_scene *s = scene_of(scenes[k]);
    gg_simulation *whole = NULL, *cut = NULL;
    gg_simulation_state one, two = {0};
    assert_ok(gg_simulation_new(s, NULL, &whole, &err));
    assert_ok(gg_simulation_new(s, NULL, &cut, &err));
    int left = 3, stops = 0;
    double reached = 0;
    assert_ok(gg_simulation_on_stop(cut, after_some, &left, &err));
    for (; two.collisions < 3000; left = 3) {
      gg_status status = gg_simulation_collide(cut, 3000 - two.collisions, &err);
      assert_ok(gg_simulation_get_state(cut, &two, &err));
      assert_true(status == GG_OK || status == GG_INTERRUPTED);
      assert_true(two.time > reached);
      reached = two.time;
      stops += status == GG_INTERRUPTED;
    }
    assert_true(stops > 2);
    assert_ok(gg_simulation_collide(whole, 3000, &err));
    assert_ok(gg_simulation_get_state(whole, &one, &err));
    if (k == 0) assert_true(one.temperature == two.temperature && fabs(one.time - two.time) < 1e-9 * one.time);
    assert_ok(gg_simulation_on_stop(cut, NULL, NULL, &err));
    assert_ok(gg_simulation_collide(cut, 3000, &err));
    gg_simulation_free(whole);
    gg_simulation_free(cut);
    gg_scene_free(s);
  }
}

/* Each of three species has a temperature; together they have that of the gas. */
static void species_one_by_one(void **state)
{
  (void)state;
  gg_simulation *m =
      simulation_of("{flow: usf, phi: 0.1, particles: 100, collision: {beta: 0, e: {33: 0.8, other: 0.9}}, species: "
                    "[{fraction: 0.5}, {fraction: 0.3, mass: 2}, {fraction: 0.2, diameter: 1.5}]}");
  gg_error err;
  gg_simulation_state now;
  gg_species_state one;
  double energy = 0, rotation = 0;
  assert_int_equal(gg_simulation_collide(m, 500, &err), GG_OK);
  assert_int_equal(gg_simulation_get_state(m, &now, &err), GG_OK);
  assert_int_equal(gg_simulation_species(m), 3);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(gg_simulation_get_species(m, i, &one, &err), GG_OK);
    energy += one.temperature * (double)one.grains / 100;
    rotation += one.rotational_temperature * (double)one.grains / 100;
  }
  assert_true(one.grains == 20 && one.diameter == 1.5 && one.mass == 1 && one.inertia == 0.4);
  assert_true(fabs(energy / now.temperature - 1) < 1e-12);
  assert_true(fabs(rotation / now.rotational_temperature - 1) < 1e-12);
  assert_int_equal(gg_simulation_get_species(m, 3, &one, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "there is no species 3"));
  assert_int_equal(gg_simulation_species(NULL), 0);
  gg_simulation_free(m);
}

/* Walls by the names that quantities carry; where there is none, or no simulation, there is no name. */
static void walls_have_names(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: couette, engine: md, phi: 0.05, particles: 100}");
  gg_simulation *m = NULL;
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_string_equal(gg_simulation_wall(m, 0), "lower");
  assert_string_equal(gg_simulation_wall(m, 1), "upper");
  assert_null(gg_simulation_wall(m, 2));
  assert_null(gg_simulation_wall(m, -1));
  assert_null(gg_simulation_wall(NULL, 0));
  gg_simulation_free(m);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(species_one_by_one),
      cmocka_unit_test(state_and_grains),
      cmocka_unit_test(equal_states_have_equal_hashes),
      cmocka_unit_test(cut_into_steps),
      cmocka_unit_test(times_of_collisions),
      cmocka_unit_test(collisions_of_md),
      cmocka_unit_test(collisions_of_dsmc),
      cmocka_unit_test(energy_balance),
      cmocka_unit_test(kicks_are_counted),
      cmocka_unit_test(cooling_over_decades),
      cmocka_unit_test(saved_and_loaded),
      cmocka_unit_test(streams_of_one_seed_differ),
      cmocka_unit_test(facts_of_the_start),
      cmocka_unit_test(a_stopped_simulation_continues_its_trajectory),
      cmocka_unit_test(walls_have_names),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
