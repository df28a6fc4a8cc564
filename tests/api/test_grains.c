/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grains from outside: what is set is read back, a copy goes on with the same bits, and starts that no scene has
 * (crystal, cluster, two temperatures) do what physics says. Invalid grains are rejected and change nothing. */
#include "api_test.h"

enum { MOST = 4000 };
static double position[3 * MOST], velocity[3 * MOST], spin[3 * MOST];
static double position2[3 * MOST], velocity2[3 * MOST], spin2[3 * MOST];
static int species[MOST], species2[MOST];
static const gg_grains all = {position, velocity, spin, species}, again = {position2, velocity2, spin2, species2},
                       moving = {NULL, velocity, spin, species}, moving2 = {NULL, velocity2, spin2, species2};

static gg_simulation *simulation_of(const char *yaml)
{
  gg_error err;
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(yaml);
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  gg_scene_free(s);
  return m;
}

static gg_simulation *from_grains(const char *yaml, const gg_grains *grains, size_t n)
{
  gg_error err;
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(yaml);
  assert_ok(gg_simulation_from_grains(s, grains, n, NULL, &m, &err));
  gg_scene_free(s);
  return m;
}

static gg_simulation_state state_of(const gg_simulation *m)
{
  gg_error err;
  gg_simulation_state now;
  assert_ok(gg_simulation_get_state(m, &now, &err));
  return now;
}

static uint64_t hash_of(const gg_simulation *m)
{
  gg_error err;
  uint64_t hash;
  assert_ok(gg_simulation_hash(m, &hash, &err));
  return hash;
}

static void assert_near(const double *a, const double *b, size_t n, double most)
{
  for (size_t i = 0; i < n; i++)
    if (!(fabs(a[i] - b[i]) <= most)) fail_msg("%zu: %.17g, %.17g", i, a[i], b[i]);
}

static const struct {
  const char *yaml;
  int has_positions;
} gases[] = {
    {"{flow: usf, phi: 0.2, particles: 200, collision: {e: 0.9, beta: 0}}", 1},
    {"{flow: usf, phi: 0.02, particles: 3000, collision: {e: 0.9}}", 1}, /* in rows that move */
    {"{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.8, beta: 0.5}}", 1},
    {"{flow: hss, phi: 0.1, particles: 200, thermostat: gaussian}", 1},
    {"{flow: couette, phi: 0.1, particles: 300}", 1},
    {"{flow: chute, phi: 0.1, particles: 300}", 1},
    {"{flow: hcs, phi: 0.1, particles: 300, species: [{fraction: 0.5}, {fraction: 0.3, mass: 2}, {fraction: 0.2, "
     "diameter: 1.5}]}",
     1},
    {"{flow: usf, phi: 0.2, engine: dsmc, dsmc: {particles: 203}, collision: {e: 0.9, beta: 0}}", 0},
    {"{flow: hcs, phi: 0, engine: dsmc, dsmc: {particles: 400}, species: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]}",
     0}};
enum { GASES = sizeof gases / sizeof *gases };

/* The state of a run is set in the same simulation, in another and in a new one, which then return it. Under shear the
 * images of another simulation have another offset. */
static void grains_set_are_the_grains_read(void **state)
{
  (void)state;
  for (int k = 0; k < GASES; k++) {
    gg_error err;
    const char *yaml = gases[k].yaml;
    gg_simulation *m = simulation_of(yaml), *set[3] = {NULL, NULL, NULL};
    const size_t n = state_of(m).grains;
    const gg_grains *given = gases[k].has_positions ? &all : &moving, *found = given == &all ? &again : &moving2;
    const int sheared = strstr(yaml, "usf") && given == &all;
    assert_ok(gg_simulation_collide(m, 500, &err));
    assert_ok(gg_simulation_get_grains(m, given, &err));
    assert_ok(gg_simulation_copy(m, NULL, NULL, &set[0], &err));
    if (!sheared) set[1] = simulation_of(yaml), set[2] = from_grains(yaml, given, n);
    for (int i = 0; i < 3 && set[i]; i++) {
      const gg_simulation_state before = state_of(set[i]);
      if (i < 2) assert_ok(gg_simulation_set_grains(set[i], given, n, &err));
      assert_ok(gg_simulation_get_grains(set[i], found, &err));
      if (given == &all) assert_memory_equal(position, position2, 3 * n * sizeof(double));
      assert_near(velocity, velocity2, 3 * n, 1e-13);
      assert_near(spin, spin2, 3 * n, 1e-13);
      assert_memory_equal(species, species2, n * sizeof(int));
      const gg_simulation_state now = state_of(set[i]);
      assert_true(fabs(now.temperature / state_of(m).temperature - 1) < 1e-12);
      assert_true(now.time == before.time && now.collisions == before.collisions);
      assert_true(fabs(now.image_offset - before.image_offset) < 1e-12);
      assert_ok(gg_simulation_collide(set[i], 500, &err));
      assert_true(state_of(set[i]).time > before.time && state_of(set[i]).collisions >= before.collisions + 500);
      gg_simulation_free(set[i]);
    }
    gg_simulation_free(m);
  }
}

/* A copy in the middle of a run has the same state, sums and later bits; advancing one leaves the other. */
static void a_copy_has_the_same_later_bits(void **state)
{
  (void)state;
  for (int k = 0; k < GASES; k++) {
    gg_error err;
    gg_simulation *m = simulation_of(gases[k].yaml), *copy = NULL;
    gg_simulation_sums sums[2];
    assert_ok(gg_simulation_collide(m, 1777, &err));
    assert_ok(gg_simulation_copy(m, NULL, NULL, &copy, &err));
    const uint64_t there = hash_of(copy);
    assert_true(there == hash_of(m));
    assert_ok(gg_simulation_collide(m, 1500, &err));
    assert_true(hash_of(copy) == there && hash_of(m) != there);
    assert_ok(gg_simulation_collide(copy, 1500, &err));
    assert_true(hash_of(copy) == hash_of(m) && state_of(copy).time == state_of(m).time);
    assert_ok(gg_simulation_take_sums(m, &sums[0], &err));
    assert_ok(gg_simulation_take_sums(copy, &sums[1], &err));
    assert_memory_equal(&sums[0], &sums[1], sizeof sums[0]);
    gg_simulation_free(m);
    gg_simulation_free(copy);
  }
}

/* Setting grains does not reset the random stream: the same grains, set twice, evolve differently in dsmc. */
static void stream_goes_on(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of(gases[7].yaml);
  const size_t n = state_of(m).grains;
  assert_ok(gg_simulation_get_grains(m, &moving, &err));
  for (int k = 0; k < 2; k++) {
    assert_ok(gg_simulation_set_grains(m, &moving, n, &err));
    assert_ok(gg_simulation_collide(m, 1000, &err));
    assert_ok(gg_simulation_get_grains(m, &moving2, &err));
    if (k == 0) memcpy(position2, velocity2, sizeof position2);
  }
  assert_true(memcmp(position2, velocity2, 3 * n * sizeof(double)) != 0);
  gg_simulation_free(m);
}

/* Two species start at 1.8 and 0.2 of the mean temperature: elastic collisions equalise them and keep the energy. */
static void elastic_collisions_equalise_two_temperatures(void **state)
{
  (void)state;
  const char *const scenes[] = {
      "{flow: equilibrium, phi: 0.1, particles: 1000, species: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]}",
      "{flow: equilibrium, phi: 0.1, engine: dsmc, dsmc: {particles: 4000}, species: [{fraction: 0.5}, {fraction: 0.5, "
      "mass: 2}]}"};
  for (int k = 0; k < 2; k++) {
    gg_error err;
    gg_species_state one, two;
    gg_simulation *m = simulation_of(scenes[k]);
    const size_t n = state_of(m).grains;
    const double T = state_of(m).temperature;
    assert_ok(gg_simulation_get_grains(m, &moving, &err));
    for (size_t i = 0; i < 3 * n; i++) velocity[i] *= sqrt(species[i / 3] ? 0.2 : 1.8);
    assert_ok(gg_simulation_set_grains(m, &moving, n, &err));
    assert_ok(gg_simulation_get_species(m, 0, &one, &err));
    assert_ok(gg_simulation_get_species(m, 1, &two, &err));
    assert_true(fabs(one.temperature / T - 1.8) < 0.2 && fabs(two.temperature / T - 0.2) < 0.05);
    const double energy = state_of(m).temperature;
    assert_ok(gg_simulation_collide(m, 20 * n, &err));
    assert_ok(gg_simulation_get_species(m, 0, &one, &err));
    assert_ok(gg_simulation_get_species(m, 1, &two, &err));
    assert_true(fabs(state_of(m).temperature / energy - 1) < 1e-9);
    /* each by sqrt(2/(3 n/2)), and opposite: five standard deviations */
    const double most = 10 * sqrt(4 / (3 * (double)n));
    if (!(fabs(one.temperature / two.temperature - 1) < most)) fail_msg("%g, %g", one.temperature, two.temperature);
    gg_simulation_free(m);
  }
}

/* A compact cube in the middle of an empty box expands and keeps its energy; inner grains collide first. */
static void a_cluster_expands_with_its_energy(void **state)
{
  (void)state;
  gg_error err;
  const char *const scene = "{flow: equilibrium, phi: 0.005}";
  enum { SIDE = 6, N = SIDE * SIDE * SIDE };
  const double edge = cbrt(N * 3.14159265358979323846 / 6 / 0.005);
  gg_simulation *plain = simulation_of("{flow: equilibrium, phi: 0.005, particles: 216}");
  gg_grains only = {NULL, velocity, NULL, NULL};
  assert_ok(gg_simulation_get_grains(plain, &only, &err));
  assert_true(fabs(state_of(plain).box[0] - edge) < 1e-9);
  for (size_t i = 0; i < N; i++) {
    const size_t at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
    for (size_t a = 0; a < 3; a++) position[3 * i + a] = edge / 2 + 1.02 * ((double)at[a] - (SIDE - 1) / 2.0);
  }
  only.position = position;
  gg_simulation *m = from_grains(scene, &only, N);
  const double T = state_of(m).temperature;
  assert_true(fabs(T / state_of(plain).temperature - 1) < 1e-12);
  double size[2];
  for (int k = 0; k < 2; k++) {
    only.position = position2;
    assert_ok(gg_simulation_get_grains(m, &only, &err));
    size[k] = 0;
    for (size_t i = 0; i < 3 * N; i++) size[k] += pow(position2[i] - edge / 2, 2) / N;
    if (k == 0) assert_ok(gg_simulation_advance(m, 5, &err));
  }
  assert_true(fabs(size[0] - 3 * 1.02 * 1.02 * (SIDE * SIDE - 1) / 12.0) < 1e-9); /* of the lattice */
  assert_true(size[1] > size[0] + 20 && size[1] < 3 * edge * edge / 12);          /* free flight: 3 T t^2 more */
  assert_true(fabs(state_of(m).temperature / T - 1) < 1e-12);
  assert_true(state_of(m).collisions_per_grain > 2 * state_of(plain).collisions_per_grain);
  gg_simulation_free(m);
  gg_simulation_free(plain);
}

/* A face-centred crystal at phi = 0.6, near random close packing. */
static void a_crystal_near_close_packing_is_accepted(void **state)
{
  (void)state;
  gg_error err;
  enum { CUBES = 5, N = 4 * CUBES * CUBES * CUBES };
  const double edge = cbrt(N * 3.14159265358979323846 / 6 / 0.6), a = edge / CUBES;
  const double basis[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  for (size_t i = 0; i < N; i++) {
    const size_t cube = i / 4, at[3] = {cube % CUBES, cube / CUBES % CUBES, cube / CUBES / CUBES};
    for (size_t k = 0; k < 3; k++) position[3 * i + k] = a * ((double)at[k] + basis[i % 4][k] + 0.1);
  }
  const gg_grains only = {position, NULL, NULL, NULL}, found = {position2, NULL, NULL, NULL};
  gg_simulation *m = from_grains("{flow: equilibrium, phi: 0.6}", &only, N);
  assert_ok(gg_simulation_collide(m, 50 * N, &err));
  assert_ok(gg_simulation_get_grains(m, &found, &err));
  for (size_t i = 0; i < 3 * N; i++) /* nobody leaves the place */
    assert_true(fabs(remainder(position2[i] - position[i], edge)) < 0.5);
  gg_simulation_free(m);
}

/* A mean velocity is none of the gas's own where nothing holds it. */
static void mean_velocity(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    const char *yaml =
        k ? "{flow: hcs, phi: 0.1, engine: dsmc, dsmc: {particles: 500}}" : "{flow: hcs, phi: 0.1, particles: 500}";
    gg_simulation *m = simulation_of(yaml);
    const double T = state_of(m).temperature;
    const gg_grains only = {NULL, velocity, NULL, NULL};
    assert_ok(gg_simulation_get_grains(m, &only, &err));
    for (size_t i = 0; i < 1500; i++) velocity[i] += (double)(i % 3 + 1);
    assert_ok(gg_simulation_set_grains(m, &only, 500, &err));
    assert_true(fabs(state_of(m).temperature / T - 1) < 1e-9);
    gg_simulation_free(m);
  }
}

static void refused(gg_simulation *m, const gg_grains *grains, size_t n, const char *words)
{
  gg_error err;
  const uint64_t before = hash_of(m);
  assert_refused(gg_simulation_set_grains(m, grains, n, &err), words);
  assert_true(hash_of(m) == before);
}

static void invalid_grains_are_rejected(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of("{flow: hcs, phi: 0.001, particles: 50}");
  const double edge = state_of(m).box[0];
  assert_ok(gg_simulation_get_grains(m, &all, &err));
  refused(m, &all, 49, "49 grains; the scene has 50 (particles)");
  velocity[7] = NAN;
  refused(m, &all, 50, "velocity of grain 2: nan along y");
  velocity[7] = 1e80;
  refused(m, &all, 50, "velocity of grain 2: 1e+80");
  velocity[7] = 0;
  position[3 * 9 + 2] = -0.01;
  refused(m, &all, 50, "position of grain 9: -0.01 along z is outside the box");
  position[3 * 9 + 2] = INFINITY;
  refused(m, &all, 50, "position of grain 9: inf");
  spin[4] = 1;
  position[3 * 9 + 2] = 1;
  refused(m, &all, 50, "spin of grain 1: 1; smooth grains do not rotate");
  spin[4] = 0;
  species[3] = 1;
  refused(m, &all, 50, "species of grain 3: 1; allowed: 0 to 0");
  species[3] = 0;
  const double cut[] = {0, 0.5, edge - 0.3}; /* also across the edge of the box */
  for (int k = 0; k < 3; k++) {
    for (size_t a = 0; a < 3; a++) position[3 * 9 + a] = cut[k], position[3 * 31 + a] = fmod(cut[k] + 0.5, edge);
    refused(m, &all, 50, "grains 9 and 31 overlap: their centres are 0.866025404 d apart, 1 d is contact");
  }
  gg_simulation_free(m);

  m = simulation_of(gases[6].yaml);
  assert_ok(gg_simulation_get_grains(m, &all, &err));
  const int last = species[299];
  species[299] = (last + 1) % 3;
  refused(m, &all, 300, "the scene's fractions make it");
  gg_scene *s = scene_of(gases[6].yaml);
  gg_simulation *none = NULL;
  const gg_grains unnamed = {position, velocity, NULL, NULL};
  assert_refused(gg_simulation_from_grains(s, &unnamed, 300, NULL, &none, &err), "give the species");
  assert_refused(gg_simulation_from_grains(s, &moving, 300, NULL, &none, &err), "the scene's fractions");
  species[299] = last;
  assert_refused(gg_simulation_from_grains(s, &moving, 300, NULL, &none, &err), "need positions");
  assert_refused(gg_simulation_from_grains(s, &all, 299, NULL, &none, &err), "299 grains; the scene has 300");
  assert_null(none);
  gg_scene_free(s);
  gg_simulation_free(m);

  m = simulation_of("{flow: couette, phi: 0.01, particles: 100}");
  assert_ok(gg_simulation_get_grains(m, &all, &err));
  position[3 * 5 + 1] = 0.3;
  refused(m, &all, 100, "grain 5 overlaps the lower wall by 0.2 d");
  gg_simulation_free(m);

  m = simulation_of(gases[7].yaml);
  refused(m, &all, 203, "it takes no positions");
  refused(m, &all, 202, "202 grains; the scene has 203 (dsmc.particles)");
  memset(velocity, 0, sizeof velocity);
  assert_ok(gg_simulation_get_grains(m, &moving2, &err));
  const gg_grains rest = {NULL, velocity, NULL, NULL};
  refused(m, &rest, 203, "grains at rest");
  gg_simulation_free(m);
}

/* Under shear the images above are displaced by image_offset: two grains overlap there, or not. */
static void across_the_sheared_edge(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of("{flow: usf, phi: 0.0005, particles: 60, collision: {e: 0.9}}");
  assert_ok(gg_simulation_advance(m, 0.37, &err));
  const gg_simulation_state now = state_of(m);
  assert_true(now.image_offset > 2 && now.image_offset < now.box[0] - 2);
  assert_ok(gg_simulation_get_grains(m, &all, &err));
  const double upper[3] = {3, now.box[1] - 0.2, 5}, lower[3] = {3, 0.2, 5};
  memcpy(position, upper, sizeof upper);
  memcpy(position + 3, lower, sizeof lower);
  assert_ok(gg_simulation_set_grains(m, &all, 60, &err));
  assert_true(fabs(state_of(m).image_offset - now.image_offset) < 1e-9);
  position[3] = fmod(3 - now.image_offset + now.box[0], now.box[0]);
  refused(m, &all, 60, "grains 0 and 1 overlap: their centres are 0.4 d apart");
  gg_simulation_free(m);
}

static gg_collision_event seen[5000], recorded[5000];
static size_t n_seen;
static void keep(void *context, const gg_collision_event *event)
{
  (void)context;
  if (n_seen < 5000) seen[n_seen++] = *event;
}

/* The buffer holds what a callback is shown, up to its end; beside a callback, too. */
static void events_in_bulk(void **state)
{
  (void)state;
  for (int k = 0; k < 8; k += 7) { /* md, dsmc */
    gg_error err;
    gg_simulation *m = simulation_of(gases[k].yaml), *other = NULL;
    size_t n = 1;
    assert_ok(gg_simulation_copy(m, NULL, NULL, &other, &err));
    n_seen = 0;
    memset(seen, 0, sizeof seen);
    memset(recorded, 0, sizeof recorded);
    assert_ok(gg_simulation_on_collision(m, keep, NULL, &err));
    assert_ok(gg_simulation_record(other, recorded, 3000, &n, &err));
    assert_int_equal(n, 0);
    for (int i = 0; i < 2; i++) {
      assert_ok(gg_simulation_collide(m, 1000, &err));
      assert_ok(gg_simulation_collide(other, 1000, &err));
      assert_true(n == n_seen && n >= 1000);
    }
    assert_memory_equal(seen, recorded, n * sizeof *seen);
    assert_ok(gg_simulation_record(m, recorded, 3, &n, &err));
    n_seen = 0;
    assert_ok(gg_simulation_collide(m, 1000, &err));
    assert_true(n == 3 && n_seen >= 1000);
    assert_memory_equal(seen, recorded, 3 * sizeof *seen);
    assert_ok(gg_simulation_record(m, NULL, 0, NULL, &err));
    assert_refused(gg_simulation_record(m, recorded, 3, NULL, &err), "argument 'n' is missing");
    gg_simulation_free(m);
    gg_simulation_free(other);
  }
}

/* Elastic from now on: the energy stays; then it falls again. Keys of units, box and grains are rejected. */
static void changed_on_the_way(void **state)
{
  (void)state;
  const char *const engines[] = {"{flow: hcs, phi: 0.1, particles: 300, collision: {e: 0.8}}",
                                 "{flow: hcs, phi: 0.1, engine: dsmc, dsmc: {particles: 300}, collision: {e: 0.8}}"};
  for (int k = 0; k < 2; k++) {
    gg_error err;
    char text[40];
    gg_simulation *m = simulation_of(engines[k]);
    assert_ok(gg_simulation_collide(m, 1000, &err));
    const gg_simulation_state before = state_of(m);
    assert_true(before.temperature < 0.4);
    assert_ok(gg_simulation_set(m, "collision.e", "1", &err));
    assert_ok(gg_simulation_collide(m, 1000, &err));
    assert_true(fabs(state_of(m).temperature / before.temperature - 1) < 1e-9);
    assert_true(state_of(m).time > before.time && state_of(m).collisions >= 2000);
    assert_ok(gg_scene_get(gg_simulation_scene(m), "collision.e", text, sizeof text, &err));
    assert_string_equal(text, "1");
    assert_ok(gg_simulation_set(m, "collision.e", "0.7", &err));
    const uint64_t there = hash_of(m);
    assert_refused(gg_simulation_set(m, "collision.e", "1.5", &err), "1.5");
    assert_refused(gg_simulation_set(m, "collision.beta", "0.5", &err), "needs other grains");
    assert_refused(gg_simulation_set(m, "phi", "0.2", &err), "cannot be changed on the way");
    assert_true(hash_of(m) == there);
    gg_simulation *loaded = NULL;
    assert_ok(gg_simulation_save(m, "t_changed.h5", NULL, NULL, &err));
    assert_ok(gg_simulation_load("t_changed.h5", NULL, NULL, NULL, &loaded, &err));
    assert_ok(gg_simulation_collide(m, 1000, &err));
    assert_ok(gg_simulation_collide(loaded, 1000, &err));
    assert_true(hash_of(m) == hash_of(loaded));
    assert_true(state_of(m).temperature < 0.6 * before.temperature);
    gg_simulation_free(m);
    gg_simulation_free(loaded);
  }
}

/* A colder bath cools the gas, elastic grains to its temperature; T of 2000 grains has an error of 1.3 %. */
static void baths_on_the_way(void **state)
{
  (void)state;
  const char *const engines[] = {"{flow: hss, phi: 0.1, particles: 2000, collision: {e: 1}, thermostat: bath}",
                                 "{flow: hss, phi: 0.1, engine: dsmc, dsmc: {particles: 2000}, collision: {e: 1}, "
                                 "thermostat: bath}"};
  for (int k = 0; k < 2; k++) {
    gg_error err;
    gg_simulation *m = simulation_of(engines[k]);
    assert_true(fabs(state_of(m).temperature - 1) < 0.06);
    assert_ok(gg_simulation_set(m, "bath.temperature", "0.2", &err));
    assert_ok(gg_simulation_advance(m, 0.5, &err));
    assert_true(fabs(state_of(m).temperature / (0.2 + 0.8 * exp(-1)) - 1) < 0.06);
    assert_ok(gg_simulation_set(m, "bath.drag", "5", &err));
    assert_ok(gg_simulation_advance(m, 1, &err));
    assert_true(fabs(state_of(m).temperature / 0.2 - 1) < 0.06);
    gg_simulation_free(m);
  }
}

/* Monte Carlo between steps: an advance ends at its time, also with a given step that is longer. */
static void steps_end_in_time(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = simulation_of("{flow: hss, phi: 0.1, engine: dsmc, thermostat: bath, collision: {e: 0.9}, dsmc: "
                                   "{particles: 500, time_step: 1}}");
  for (int k = 1; k <= 10; k++) {
    assert_ok(gg_simulation_advance(m, 0.07, &err));
    assert_true(fabs(state_of(m).time - 0.07 * k) < 1e-12);
  }
  gg_simulation_free(m);
}

/* A sheared gas twice as fast: strain and time add up, units stay, and what is saved and loaded continues with its
 * bits.
 */
static void shear_rates_on_the_way(void **state)
{
  (void)state;
  const char *const engines[] = {"{flow: usf, phi: 0.1, particles: 300, shear_rate: 3, collision: {e: 0.8}}",
                                 "{flow: usf, phi: 0.1, engine: dsmc, dsmc: {particles: 300}, shear_rate: 3, "
                                 "collision: {e: 0.8}}"};
  for (int k = 0; k < 2; k++) {
    gg_error err;
    char text[40];
    gg_simulation *m = simulation_of(engines[k]), *loaded = NULL, *another = NULL;
    assert_ok(gg_simulation_advance(m, 4, &err));
    const gg_simulation_state before = state_of(m);
    assert_true(fabs(before.strain - before.time) < 1e-12);
    assert_ok(gg_simulation_set(m, "shear_rate", "6", &err));
    const gg_simulation_state changed = state_of(m);
    assert_true(changed.time == before.time && fabs(changed.strain - before.strain) < 1e-12);
    assert_true(fabs(changed.temperature / before.temperature - 1) < 1e-9); /* velocities about the flow stay */
    assert_true(fabs(changed.image_offset - before.image_offset) < 1e-9);
    assert_ok(gg_simulation_advance(m, 4, &err));
    assert_ok(gg_simulation_save(m, "t_sheared.h5", NULL, NULL, &err));
    assert_ok(gg_simulation_load("t_sheared.h5", NULL, NULL, NULL, &loaded, &err));
    assert_ok(gg_simulation_set(m, "shear_rate", "1.5", &err));
    assert_ok(gg_simulation_set(loaded, "shear_rate", "1.5", &err));
    assert_ok(gg_simulation_collide(m, 1000, &err));
    assert_ok(gg_simulation_collide(loaded, 1000, &err));
    assert_true(hash_of(m) == hash_of(loaded));
    const gg_simulation_state after = state_of(m), there = state_of(loaded);
    const double doubled = 2 * (after.time - before.time), halved = after.strain - before.strain;
    assert_true(halved < doubled && halved > 0.25 * doubled && fabs(after.strain - there.strain) < 1e-12);
    assert_ok(gg_scene_get(gg_simulation_scene(loaded), "shear_rate", text, sizeof text, &err));
    assert_string_equal(text, "1.5");
    assert_refused(gg_simulation_set(loaded, "shear_rate", "3001", &err), "from 0.003 to 3000");
    assert_ok(gg_simulation_new(gg_simulation_scene(m), NULL, &another, &err)); /* another one has units of its own */
    assert_ok(gg_simulation_advance(another, 1, &err));
    assert_true(fabs(state_of(another).strain - state_of(another).time) < 1e-12);
    gg_simulation_free(m);
    gg_simulation_free(loaded);
    gg_simulation_free(another);
  }
  gg_error err;
  gg_simulation *m = simulation_of("{flow: hcs, phi: 0.1, particles: 100}");
  assert_refused(gg_simulation_set(m, "shear_rate", "2", &err), "has no effect in flow: hcs; allowed in flow: usf");
  gg_simulation_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(baths_on_the_way),
      cmocka_unit_test(shear_rates_on_the_way),
      cmocka_unit_test(steps_end_in_time),
      cmocka_unit_test(grains_set_are_the_grains_read),
      cmocka_unit_test(a_copy_has_the_same_later_bits),
      cmocka_unit_test(stream_goes_on),
      cmocka_unit_test(elastic_collisions_equalise_two_temperatures),
      cmocka_unit_test(a_cluster_expands_with_its_energy),
      cmocka_unit_test(a_crystal_near_close_packing_is_accepted),
      cmocka_unit_test(mean_velocity),
      cmocka_unit_test(invalid_grains_are_rejected),
      cmocka_unit_test(events_in_bulk),
      cmocka_unit_test(changed_on_the_way),
      cmocka_unit_test(across_the_sheared_edge),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
