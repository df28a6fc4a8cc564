/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An ensemble in segments, which collide in rounds, is the same gas as an ensemble in one piece. Every two segments
 * meet equally often; grains of one segment and of two collide at the same rate; segments of different temperatures mix
 * as fast as on the plain path; heated, sheared and mixed gases have the same averages. All runs here have one thread;
 * test_threads.c tests that more leave the same bits. */
#include "dsmc/dsmc.h"
#include "lab.h"

/* In a schedule each segment is paired with each other once, and is in one pair at a time. */
static void every_two_segments_meet_once(void **state)
{
  (void)state;
  for (int segments = 4; segments <= GG_DSMC_MAX_SEGMENTS; segments *= 2) {
    int met[GG_DSMC_MAX_SEGMENTS][GG_DSMC_MAX_SEGMENTS] = {{0}};
    for (int round = 0; round < segments; round++) {
      int busy[GG_DSMC_MAX_SEGMENTS] = {0};
      for (int k = 0; k < gg_dsmc_segment_pairs(segments, round); k++) {
        int a, b;
        gg_dsmc_segment_pair(segments, round, k, &a, &b);
        assert_true(a >= 0 && b >= 0 && a < segments && b < segments);
        met[a][b]++, busy[a]++;
        if (a != b) met[b][a]++, busy[b]++;
      }
      for (int s = 0; s < segments; s++) assert_int_equal(busy[s], 1);
    }
    for (int a = 0; a < segments; a++)
      for (int b = 0; b < segments; b++) assert_int_equal(met[a][b], 1);
  }
}

/* Each block is in exactly one segment, whatever their number; a schedule has each round once, in a new order. */
static void all_blocks_are_in_one_segment(void **state)
{
  (void)state;
  float bounds[1];
  for (size_t blocks = 1; blocks < 40000; blocks += 1 + blocks / 7)
    for (int segments = 1; segments <= GG_DSMC_MAX_SEGMENTS; segments += segments == 1 ? 1 : 2) {
      gg_dsmc_population p = {.n_blocks = blocks, .speed_bound = bounds};
      uint32_t next = 0;
      for (int s = 0; s < segments; s++) {
        gg_dsmc_range r = gg_dsmc_segment(&p, segments, s);
        assert_int_equal(r.first, next);
        assert_true(r.first % 16 == 0 && (double)r.n < (double)blocks / segments + 16);
        next += r.n;
      }
      assert_int_equal(next, blocks);
    }
  static gg_dsmc_schedule t;
  gg_dsmc_schedule_start(&t, 1, 0);
  int first[8] = {0};
  for (int i = 0; i < 8000; i++) {
    unsigned seen = 0;
    for (int k = 0; k < 8; k++) {
      int round = gg_dsmc_next_round(&t, 8);
      if (k == 0) first[round]++;
      seen |= 1u << round;
    }
    assert_int_equal(seen, 255);
  }
  for (int k = 0; k < 8; k++) assert_true(abs(first[k] - 1000) < 5 * 30);
}

/* A thread that takes one half of the pairs of a round and the parts that go with it stays with the same segments; the
 * halves change twice a schedule. */
static void halves_stay_with_their_segments(void **state)
{
  (void)state;
  for (int segments = 8; segments <= GG_DSMC_MAX_SEGMENTS; segments *= 2)
    for (int round = segments / 4; round < segments; round++) {
      unsigned met[2] = {0}, kept[2] = {0};
      for (int k = 0; k < segments / 2; k++) {
        int a, b;
        gg_dsmc_segment_pair(segments, round, k, &a, &b);
        met[k / (segments / 4)] |= 1u << a | 1u << b;
      }
      for (int part = 0; part < segments; part++)
        kept[part / (segments / 2)] |= 1u << gg_dsmc_segment_in(segments, round / (segments / 4), part);
      assert_int_equal(met[0], kept[0]);
      assert_int_equal(met[1], kept[1]);
    }
  static gg_dsmc_schedule t;
  gg_dsmc_schedule_start(&t, 1, 0);
  int changes = 0, grouping = 0;
  for (int i = 0; i < 8 * 1000; i++) {
    const int c = gg_dsmc_next_round(&t, 8) / 2;
    changes += c && c != grouping;
    if (c) grouping = c;
  }
  assert_int_equal(changes, 2 * 1000 + 1);
}

/* --- planted velocities: rates of collision between segments and within them --- */

enum { SEGMENTS = 8, PLANTED = 64000 };

/* Speeds along x, by segment and by whether the block is odd or even. */
typedef struct plan {
  const char *name;
  double x[SEGMENTS][2];
} plan;

/* Returns the sum of |difference| over all pairs of grains. */
static double plant(gg_dsmc *d, const plan *p)
{
  const gg_dsmc_population *one = &d->ensemble.of[0];
  gg_dsmc_block *c = one->c;
  double n[SEGMENTS][2] = {{0}}, sum = 0;
  for (int s = 0; s < SEGMENTS; s++) {
    gg_dsmc_range r = gg_dsmc_segment(one, SEGMENTS, s);
    for (uint32_t b = r.first; b < r.first + r.n; b++)
      for (int l = 0; l < GG_DSMC_LANES; l++) {
        c[b].x[l] = p->x[s][b % 2];
        c[b].y[l] = c[b].z[l] = 0;
        n[s][b % 2]++;
      }
  }
  for (int i = 0; i < 2 * SEGMENTS; i++)
    for (int k = 0; k < i; k++)
      sum += n[i / 2][i % 2] * n[k / 2][k % 2] * fabs(p->x[i / 2][i % 2] - p->x[k / 2][k % 2]);
  gg_vec none = {0, 0, 0};
  gg_dsmc_moments m = gg_dsmc_ensemble_synchronise(&d->ensemble, 0, 1, none, 1);
  d->now.fastest = m.fastest;
  d->now.temperature = m.temperature;
  gg_dsmc_start_majorants(d);
  return sum;
}

static void pairs_of_segments_collide_at_the_same_rate(void **state)
{
  (void)state;
  static const plan plans[] = {
      {"one against seven", {{1, 1}}},
      {"four against four", {{1, 1}, {1, 1}, {1, 1}, {1, 1}}},
      {"each its own", {{0, 0}, {1, 1}, {-1, -1}, {2, 2}, {-2, -2}, {3, 3}, {-3, -3}, {4, 4}}},
      {"odd against even blocks", {{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}}},
  };
  gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.1, 1, -1, PLANTED);
  gg_model m = lab_model(&s);
  for (size_t i = getenv("NIGHTLY") ? 0 : 2; i < sizeof plans / sizeof *plans; i++) { /* daily those with most pairs */
    gg_engine *g = lab_engine(&m, 100 + i);
    gg_dsmc *d = (gg_dsmc *)g;
    lab_mean ratio = {0};
    double pairs = plant(d, &plans[i]);
    /* A collision for every 4000 grains in an interval, and for every 500 in a pair if it has them all: few second
     * ones. */
    const double rate = M_PI * gg_dsmc_cross_section(d, 0, 0) * pairs, dt = PLANTED / 4000. / rate;
    for (int block = 0; block < 1100; block++) {
      uint64_t before = d->now.collisions;
      for (int k = 0; k < 3 * SEGMENTS; k++) { /* whole schedules, for any number of rounds in an interval */
        plant(d, &plans[i]);
        gg_dsmc_collide(d, dt, 0, 0, GG_DSMC_FORWARD);
      }
      lab_add(&ratio, (double)(d->now.collisions - before) / (3 * SEGMENTS * rate * dt));
    }
    lab_expect(plans[i].name, &ratio, 1, 0.002, 0.02);
    gg_dsmc_ops.destroy(g);
  }
}

/* --- two temperatures --- */

static void in_one_piece(gg_engine *g)
{
  gg_dsmc *d = (gg_dsmc *)g;
  d->ensemble.segments = 1;
  free(d->schedule);
  d->schedule = NULL;
}

/* Half of the segments begin nine times as hot as the others. The fourth cumulant and the collision rate show how far
 * they have mixed, which only collisions between segments do. */
static void mix(gg_dsmc_path path, int seed, lab_mean a2[3], lab_mean time[3])
{
  gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.1, 1, -1, PLANTED);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, (uint64_t)seed);
  gg_dsmc *d = (gg_dsmc *)g;
  const gg_dsmc_population *p = &d->ensemble.of[0];
  gg_dsmc_block *c = p->c;
  for (int k = 0; k < SEGMENTS; k++) {
    gg_dsmc_range r = gg_dsmc_segment(p, SEGMENTS, k);
    double factor = k % 2 ? sqrt(0.2) : sqrt(1.8);
    for (uint32_t b = r.first; b < r.first + r.n; b++)
      for (int l = 0; l < GG_DSMC_LANES; l++) c[b].x[l] *= factor, c[b].y[l] *= factor, c[b].z[l] *= factor;
  }
  gg_dsmc_synchronise(d);
  for (int q = 0; q < GG_PAIRS && path == GG_DSMC_PLAIN; q++) d->path[q] = path;
  gg_dsmc_start_majorants(d);
  if (path == GG_DSMC_PLAIN) in_one_piece(g);
  double gone = 0;
  for (int i = 0; i < 3; i++) {
    gone += lab_advance(g, INFINITY, PLANTED / 2);
    lab_view v = lab_snapshot(g);
    gg_engine_state now;
    gg_dsmc_ops.state(g, &now);
    double T = lab_temperature(&v);
    lab_add(&a2[i], v.c4 / v.n / (15 * T * T) - 1);
    lab_add(&time[i], gone / (double)now.collisions * PLANTED);
  }
  gg_dsmc_ops.destroy(g);
}

static void segments_mix_as_the_plain_path_does(void **state)
{
  (void)state;
  lab_mean a2[2][3] = {{{0}}}, time[2][3] = {{{0}}};
  for (int seed = 0; seed < 50; seed++) {
    mix(GG_DSMC_PLAIN, seed, a2[0], time[0]);
    mix(GG_DSMC_BLOCKS, seed + 100, a2[1], time[1]);
  }
  for (int i = 0; i < 3; i++) {
    printf("# after %d collisions a grain\n", i + 1);
    lab_expect("a2", &a2[1][i], lab_value(&a2[0][i]), lab_error(&a2[0][i]), 0.04);
    lab_expect("time a collision", &time[1][i], lab_value(&time[0][i]), lab_error(&time[0][i]), 0.01);
  }
}

/* --- the physics of large ensembles, in segments and in one piece --- */

static void agree(const char *what, const lab_mean *a, const lab_mean *b, double sight)
{
  lab_expect(what, b, lab_value(a), lab_error(a), sight);
}

static void no_bias_in(const char *name, const gg_scene *s, double length)
{
  gg_model m = lab_model(s);
  lab_flow f[2] = {{.T = {0}}, {.T = {0}}};
  for (int seed = 0; seed < 8; seed++)
    for (int cut = 0; cut < 2; cut++) {
      gg_engine *g = lab_engine(&m, (uint64_t)(10 * seed + cut));
      if (!cut) in_one_piece(g);
      lab_average(g, &m, 8, 1, length, &f[cut]);
      gg_dsmc_ops.destroy(g);
    }
  printf("# %s\n", name);
  agree("T", &f[0].T, &f[1].T, 0.02);
  agree("p", &f[0].p, &f[1].p, 0.02);
  agree("loss", &f[0].loss, &f[1].loss, 0.02);
  agree("collision rate", &f[0].rate, &f[1].rate, 0.01);
  if (m.shear_rate > 0) {
    agree("shear viscosity", &f[0].eta, &f[1].eta, 0.03);
    agree("N1", &f[0].N1, &f[1].N1, 0.2);
  } else {
    agree("a2", &f[0].a2, &f[1].a2, 0.3);
  }
  if (m.rule != GG_SMOOTH) agree("theta", &f[0].theta, &f[1].theta, 0.02);
}

static void segments_leave_no_bias(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0.3, 0.8, 0.3, PLANTED);
  no_bias_in("rough, dense, sheared", &s, 5);
  s.n_species = 2;
  s.species[0] = (gg_species){0.4, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.6, 0.7, 0.5, 0.3, 1, 0};
  no_bias_in("two rough species, dense, sheared", &s, 5);
  s = lab_scene(GG_HSS, 0.1, 0.5, -1, PLANTED);
  no_bias_in("Gaussian thermostat", &s, 10);
  s.thermostat = GG_WHITE_NOISE;
  no_bias_in("white noise", &s, 10);
}

/* A species with few grains in a large ensemble is not cut: no part of it would be large enough to represent it. */
static void a_small_species_is_not_cut(void **state)
{
  (void)state;
  for (int first = 0; first < 2; first++) {
    gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.1, 1, -1, 100000);
    const double few = 0.02;
    s.n_species = 2;
    s.species[0] = (gg_species){first ? few : 1 - few, 1, 1, 0.4, 1, 0};
    s.species[1] = (gg_species){first ? 1 - few : few, 1, 1, 0.4, 1, 0};
    gg_model m = lab_model(&s);
    gg_engine *g = lab_engine(&m, 3);
    const gg_dsmc *d = (const gg_dsmc *)g;
    assert_non_null(d->schedule);
    uint64_t next = d->schedule->next;
    lab_advance(g, INFINITY, 20000);
    assert_int_equal(d->schedule->next, next);
    gg_dsmc_ops.destroy(g);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_two_segments_meet_once),
                                     cmocka_unit_test(all_blocks_are_in_one_segment),
                                     cmocka_unit_test(halves_stay_with_their_segments),
                                     cmocka_unit_test(pairs_of_segments_collide_at_the_same_rate),
                                     cmocka_unit_test(segments_mix_as_the_plain_path_does),
                                     cmocka_unit_test(segments_leave_no_bias),
                                     cmocka_unit_test(a_small_species_is_not_cut)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
