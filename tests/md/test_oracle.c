/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: from the engine's own state after each event, a plain search over all images of all pairs and all walls finds
 * the same next collision (the same pair, and the same time to 10^-10 of a mean free time), and no two grains overlap.
 * Hundreds of random small systems: periodic, sheared, between walls, under gravity; each rule; one species and two;
 * dilute and dense; cubic and not; 10^4 events in a row; and after a long time. Daily a third of them. */
#include <stdlib.h>
#include <string.h>

#include "md_test.h"

#include "md/row_motion.h"
#include "scene/scene.h"

enum { MOST = 160 };

/* Number of systems, or of events: all nightly, a third daily. */
static int share(int all)
{
  return getenv("NIGHTLY") ? all : (all + 2) / 3;
}

typedef struct collided {
  uint32_t counter[MOST];
  int64_t changed[3]; /* grains that have collided since, or -1 */
} collided;

static void note_counters(collided *w, const gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) w->counter[i] = e->grain[i].counter;
}

static void find_changed(collided *w, const gg_md *e)
{
  int n = 0;
  w->changed[0] = w->changed[1] = w->changed[2] = -1;
  for (uint32_t i = 0; i < e->n && n < 3; i++)
    if (e->grain[i].counter != w->counter[i]) w->changed[n++] = i;
}

static void advance(gg_md *e, double dt)
{
  gg_error err = {0};
  if (gg_md_ops.advance(&e->base, dt, UINT64_MAX, NULL, &err) != GG_OK) fail_msg("%s", err.message);
}

/* Compares one prediction of the plain search with what the engine does around that time. */
static void check_next(gg_md *e, uint64_t seed)
{
  double tolerance = 1e-10 * e->k.mean_free_time, horizon = 30 * e->k.mean_free_time / e->n;
  md_prediction f = md_oracle(e, horizon), wall = md_oracle_walls(e, horizon);
  if (wall.time < f.time) f = wall;
  collided w;
  note_counters(&w, e);
  if (!(f.time < horizon)) {
    advance(e, horizon);
    find_changed(&w, e);
    assert_true(w.changed[0] < 0);
    return;
  }
  if (f.time > tolerance) advance(e, (double)f.time - tolerance);
  find_changed(&w, e);
  int64_t early = w.changed[0];
  advance(e, 2 * tolerance);
  find_changed(&w, e);
  bool by_wall = GG_MD_NO_GRAIN(f.pair[1]);
  bool same = w.changed[0] == f.pair[0] && w.changed[1] == (by_wall ? -1 : (int64_t)f.pair[1]) && w.changed[2] == -1;
  if (early >= 0 || !same)
    fail_msg("n %u phi %g flow %d seed %d: plain search (%u, %u) after %.17Lg; engine (%d, %d, %d), %s", e->n,
             e->model.phi, (int)e->model.flow, (int)seed, f.pair[0], f.pair[1], f.time, (int)w.changed[0],
             (int)w.changed[1], (int)w.changed[2], early >= 0 ? "early" : "then");
}

/* Runs for so many collisions, or as long as they should take: grains that lie apart on a floor collide no more. */
static void warm_up(gg_md *e, uint64_t collisions)
{
  double time = 20 * (double)collisions * e->k.mean_free_time / e->n;
  assert_int_equal(gg_md_ops.advance(&e->base, time, collisions, NULL, NULL), GG_OK);
}

/* Checks `stretches` times so many events, each time after `warm` collisions that are not checked. */
static void follow_stretches(const gg_scene *s, uint64_t seed, int warm, int events, int stretches)
{
  gg_model m = md_model_of(s);
  assert_true(m.n <= MOST);
  gg_md *e = md_create(&m, seed);
  for (int k = 0; k < stretches * events; k++) {
    if (k % events == 0) warm_up(e, (uint64_t)warm);
    check_next(e, seed);
  }
  if (!(md_closest(e) > 1 - 1e-12L && e->k.worst_overlap < 1e-12))
    fail_msg("flow %d seed %d: closest 1 - %Lg, worst overlap %g", (int)m.flow, (int)seed, 1 - md_closest(e),
             e->k.worst_overlap);
  md_destroy(e);
}

static void follow(const gg_scene *s, uint64_t seed, int warm, int events)
{
  follow_stretches(s, seed, warm, events, 1);
}

static void random_contact(gg_scene *s, gg_rng *rng)
{
  static const double betas[] = {-1, 0, 0.5, 1}, mus[] = {INFINITY, INFINITY, 0.1, 0.5};
  for (int p = 0; p < GG_PAIRS; p++) {
    s->collision.e[p] = 0.6 + 0.1 * gg_rng_below(rng, 5);
    s->collision.beta[p] = betas[gg_rng_below(rng, 4)];
    s->collision.mu[p] = mus[gg_rng_below(rng, 4)];
  }
  s->walls.e = 0.6 + 0.1 * gg_rng_below(rng, 5);
  s->walls.beta = betas[gg_rng_below(rng, 4)];
  s->walls.mu = mus[gg_rng_below(rng, 4)];
  s->walls.speed = 3;
}

/* Returns false if the scene drawn cannot run: its box may be too small for the number of grains. */
static bool random_scene(gg_scene *s, gg_rng *rng, gg_flow flow, bool mixture)
{
  *s = gg_scene_defaults();
  s->flow = flow;
  s->md.contact_time = 1e-3; /* the time between bounces of grains at rest on a floor */
  s->phi = pow(10, -2 + (gg_flow_is_walled(flow) || mixture ? 1.4 : 1.74) * gg_rng_uniform(rng));
  for (int a = 0; a < 3; a++) s->aspect[a] = 1 + 0.6 * gg_rng_uniform(rng);
  random_contact(s, rng);
  if (mixture) {
    s->n_species = 2 + (int)gg_rng_below(rng, 2);
    for (int i = 0; i < s->n_species; i++) s->species[i].fraction = 1.0 / s->n_species;
    for (int i = 1; i < s->n_species; i++) {
      s->species[i].diameter = 0.6 + 0.8 * gg_rng_uniform(rng);
      s->species[i].mass = 0.2 + 3 * gg_rng_uniform(rng);
    }
  }
  double fewest = 10 * s->phi / (M_PI / 6);
  s->particles = (mixture ? 2 * s->n_species : 3) + (int64_t)fewest + gg_rng_below(rng, 30);
  if (flow == GG_POISEUILLE)
    s->gravity[0] = 0.5, s->walls.beta = 0.5, s->walls.mu = INFINITY; /* walls brake the flow */
  if (flow == GG_CHUTE) {
    s->gravity[0] = 0.2, s->gravity[1] = -0.5;
    s->walls.top = gg_rng_below(rng, 2) ? GG_OPEN_TOP : GG_CLOSED_TOP;
  }
  gg_model m = md_model_of(s);
  return s->particles <= 64 && gg_md_ops.accepts(&m, NULL) == GG_OK;
}

static void many(gg_flow flow, bool mixture, int systems, uint64_t seed)
{
  gg_rng rng = gg_common_rng_seed(seed, 7);
  gg_scene s;
  for (int k = 0; k < share(systems);)
    if (random_scene(&s, &rng, flow, mixture)) follow(&s, seed + (uint64_t)k++, 60, 40);
}

static void periodic_events_are_found(void **state)
{
  (void)state, many(GG_HCS, false, 90, 100);
}
static void sheared_events_are_found(void **state)
{
  (void)state, many(GG_USF, false, 90, 300);
}
static void events_of_mixtures_are_found(void **state)
{
  (void)state;
  many(GG_HCS, true, 30, 500);
  many(GG_USF, true, 40, 600);
  many(GG_COUETTE, true, 20, 700);
}
static void events_between_walls_are_found(void **state)
{
  (void)state, many(GG_COUETTE, false, 60, 800);
}
static void events_under_gravity_are_found(void **state)
{
  (void)state;
  many(GG_POISEUILLE, false, 40, 900);
  many(GG_CHUTE, false, 60, 1000);
  many(GG_CHUTE, true, 20, 1100);
}

/* Ridges, with grains that fly on parabolas, and with grains that lie between two of them. */
static void events_at_ridges_are_found(void **state)
{
  (void)state;
  static const double ridges[] = {0.5, 1, 1.7}, betas[] = {-1, 0.5, 0.4}, mus[] = {INFINITY, INFINITY, 0.3};
  for (int k = 0; k < 24; k += getenv("NIGHTLY") ? 1 : 5) {
    gg_scene s = md_scene((md_case){k % 2 ? GG_CHUTE : GG_POISEUILLE, 40, 0.1, 0.8, betas[k % 3], mus[k % 3], {0}});
    s.md.contact_time = 1e-3;
    s.walls.ridges = ridges[k / 2 % 3], s.walls.beta = 0.5;
    s.gravity[0] = 0.3, s.gravity[1] = k % 2 ? -0.5 : 0;
    if (k % 4 == 3) s.walls.top = GG_OPEN_TOP;
    if (k >= 12) {
      s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5;
      s.species[1].diameter = 0.6, s.species[1].mass = 0.4;
    }
    follow(&s, 1300 + (uint64_t)k, 60, 60);
  }
}

static void one(md_case c, uint64_t seed, int warm, int events)
{
  gg_scene s = md_scene(c);
  follow(&s, seed, warm, events);
}

/* Boxes so wide that cells are searched with vector kernels. */
static void events_in_wide_cells_are_found(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 3; seed++) {
    one((md_case){GG_HCS, 150, 0.1, 0.9, 0, INFINITY, {0}}, seed, 900, 30);
    one((md_case){GG_USF, 150, 0.1, 0.9, 0, INFINITY, {3, 1, 1}}, seed, 900, 30);
    one((md_case){GG_USF, 150, 0.03, 0.8, -1, INFINITY, {4, 1, 1}}, seed, 900, 30);
    one((md_case){GG_USF, 160, 0.2, 0.8, 0.5, 0.3, {4, 1.2, 1}}, seed, 900, 30);
  }
}

/* Sheared boxes wide enough for co-moving rows of cells, until rows have shifted several times. */
static void events_in_comoving_rows_are_found(void **state)
{
  (void)state;
  md_case dilute = {GG_USF, 150, 0.06, 0.9, -1, INFINITY, {2, 1, 1}},
          dense = {GG_USF, 150, 0.3, 0.8, 0, INFINITY, {1.25, 0.8, 0.8}};
  md_case fewest = {GG_USF, 140, 0.2, 0.8, 0.5, 0.3, {1.4, 0.9, 0.9}},
          wide = {GG_USF, 160, 0.1, 0.7, 1, INFINITY, {3, 1, 1.1}};
  const md_case all[] = {dilute, dense, fewest, wide};
  for (int k = 0; k < 4; k++) {
    gg_model m = md_model(all[k]);
    gg_md *e = md_create(&m, 1);
    assert_int_equal(e->search.kind, GG_MD_COMOVING_ROWS);
    if (k == 2) assert_int_equal(e->cells.n[0], GG_MD_FEWEST_COMOVING);
    md_destroy(e);
    gg_scene s = md_scene(all[k]);
    for (uint64_t seed = 1; seed <= (uint64_t)share(4); seed++)
      follow_stretches(&s, seed, 60, 20, seed == 1 ? share(24) : 6);
    s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5, s.species[1].diameter = 0.8;
    follow_stretches(&s, 5, 60, 20, 6);
  }
}

/* Dilute gases in boxes wide enough for overlapping cells. */
static void events_in_overlapping_cells_are_found(void **state)
{
  (void)state;
  md_case still = {GG_HCS, 150, 0.01, 0.9, 0, INFINITY, {0}},
          sheared = {GG_USF, 150, 0.004, 0.8, 0, INFINITY, {3, 1, 1}};
  md_case wider = {GG_USF, 160, 0.004, 0.9, -1, INFINITY, {3, 1.1, 1.05}};
  md_case fewest = {GG_USF, 150, 0.004, 0.9, 0, INFINITY, {0}}; /* fewest cells along x */
  const md_case all[] = {still, sheared, wider, fewest};
  for (int k = 0; k < 4; k++) {
    gg_model m = md_model(all[k]);
    gg_md *e = md_create(&m, 1);
    assert_true(gg_md_search_overlaps(e->search.kind));
    if (k == 3) assert_int_equal(e->cells.n[0], 6);
    md_destroy(e);
  }
  for (uint64_t seed = 1; seed <= (uint64_t)share(4); seed++) {
    one(still, seed, 900, 40);
    one(sheared, seed, 900, 40);
    one(wider, seed, 900, 40);
    one(fewest, seed, 900, 40);
    gg_scene s = md_scene(sheared);
    s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5, s.species[1].diameter = 0.8;
    follow(&s, seed, 900, 40);
  }
}

/* Boxes so wide that there are neighbour lists. */
static void events_by_lists_are_found(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 3; seed++) {
    one((md_case){GG_HCS, 140, 0.42, 0.9, 0, INFINITY, {0}}, seed, 900, 30);
    one((md_case){GG_USF, 140, 0.42, 0.9, 0, INFINITY, {1, 1.1, 1}}, seed, 900, 30);
    one((md_case){GG_USF, 150, 0.5, 0.8, 0.5, 0.3, {0}}, seed, 1200, 30);
    one((md_case){GG_USF, 150, 0.55, 0.9, -1, INFINITY, {1.2, 1, 1}}, seed, 1200, 30);
    gg_scene s = md_scene((md_case){GG_USF, 150, 0.45, 0.9, 0, INFINITY, {0}});
    s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5, s.species[1].diameter = 0.8;
    follow(&s, seed, 1200, 30);
  }
}

/* The same between walls and on parabolas, only until grains lie still on a floor: for those that hardly move the
 * contact time is ill-conditioned. */
static void searches_between_walls_find_events(void **state)
{
  (void)state;
  static const gg_flow flows[] = {GG_COUETTE, GG_FOURIER, GG_POISEUILLE, GG_CHUTE};
  for (int k = 0; k < 32; k += getenv("NIGHTLY") ? 1 : 3) {     /* each flow, with lists and without */
    const bool lists = k % 2 && flows[k / 2 % 4] != GG_COUETTE; /* not in a flow along walls */
    gg_scene s =
        md_scene((md_case){flows[k / 2 % 4], 150, lists ? 0.42 : 0.01, 0.9, k % 3 ? 0 : -1, INFINITY, {1, 1.1, 1}});
    s.md.contact_time = 1e-3;
    s.walls.beta = 0.5, s.walls.e = 0.8;
    s.gravity[0] = 0;
    if (s.flow == GG_POISEUILLE && !lists) s.gravity[0] = 0.5;
    if (s.flow == GG_CHUTE) s.gravity[0] = lists ? 0 : 0.2, s.gravity[1] = k < 16 ? -0.1 : -0.5;
    if (k >= 16 && k % 4 < 2) {
      s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5;
      s.species[1].diameter = lists ? 0.85 : 0.6;
    }
    if (s.n_species > 1) s.phi = lists ? 0.46 : 0.006;
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 1);
    const gg_md_search_kind dilute = m.gravity[1] != 0 ? GG_MD_PLAIN_CELLS : GG_MD_OVERLAPPING_CELLS;
    assert_int_equal(e->search.kind, lists ? GG_MD_NEIGHBOUR_LISTS : dilute);
    md_destroy(e);
    follow(&s, (uint64_t)k, 300, 60);
  }
}

static void dense_events_are_found(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 4; seed++) {
    one((md_case){GG_EQUILIBRIUM, 40, 0.55, 1, -1, INFINITY, {0}}, seed, 400, 50);
    one((md_case){GG_USF, 40, 0.52, 0.8, 0, INFINITY, {0}}, seed, 400, 50);
  }
}

/* Two to four grains, which collide with images beyond the nearest. */
static void events_of_few_grains_are_found(void **state)
{
  (void)state;
  for (int64_t n = 2; n <= 4; n++)
    for (uint64_t seed = 1; seed <= 3; seed++) {
      one((md_case){GG_HCS, n, 0.02 * (double)n, 0.9, 0, INFINITY, {0}}, seed, 3, 60);
      one((md_case){GG_USF, n, 0.06, 0.9, 0, INFINITY, {0}}, seed, 3, 60);
    }
}

/* 10^4 events in a row (daily a third), in small systems of every kind. */
static void ten_thousand_events_in_a_row_are_found(void **state)
{
  (void)state;
  static const gg_flow flows[] = {GG_EQUILIBRIUM, GG_USF, GG_COUETTE, GG_POISEUILLE, GG_CHUTE};
  for (int k = 0; k < 10; k++) {
    gg_scene s = md_scene((md_case){flows[k / 2], 8, 0.1, k < 2 ? 1 : 0.9, k % 2 && k > 1 ? 0 : -1, INFINITY, {0}});
    s.md.contact_time = 1e-3;
    s.phi = k % 2 ? 0.2 : 0.05;
    if (s.flow == GG_POISEUILLE) s.gravity[0] = 0.1;
    if (s.flow == GG_CHUTE) s.gravity[0] = 0.2, s.gravity[1] = -0.3;
    if (k % 2) {
      s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5;
      s.species[1].diameter = 0.8, s.species[1].mass = 0.4;
    }
    follow(&s, 40 + (uint64_t)k, 40, share(10000));
  }
}

/* The same after a long time, which two grains reach in a second; sheared images have then passed 2 x 10^5 times
 * (daily a third). */
static void late_events_are_found(void **state)
{
  (void)state;
  for (int sheared = 0; sheared < 2; sheared++) {
    gg_scene s = md_scene(
        (md_case){sheared ? GG_USF : GG_EQUILIBRIUM, 2, sheared ? 0.1 : 0.01, sheared ? 0.8 : 1, -1, INFINITY, {0}});
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 1);
    double time = share(sheared ? 200000 : 1000000);
    advance(e, time);
    assert_true(fabs(e->k.epoch_start + e->k.now - time) < 1e-6);
    for (int k = 0; k < 200; k++) check_next(e, 1);
    assert_true(e->k.worst_overlap < 1e-12);
    md_destroy(e);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic_events_are_found),
      cmocka_unit_test(sheared_events_are_found),
      cmocka_unit_test(events_of_mixtures_are_found),
      cmocka_unit_test(events_between_walls_are_found),
      cmocka_unit_test(events_under_gravity_are_found),
      cmocka_unit_test(events_at_ridges_are_found),
      cmocka_unit_test(dense_events_are_found),
      cmocka_unit_test(events_of_few_grains_are_found),
      cmocka_unit_test(events_by_lists_are_found),
      cmocka_unit_test(events_in_wide_cells_are_found),
      cmocka_unit_test(events_in_comoving_rows_are_found),
      cmocka_unit_test(events_in_overlapping_cells_are_found),
      cmocka_unit_test(searches_between_walls_find_events),
      cmocka_unit_test(ten_thousand_events_in_a_row_are_found),
      cmocka_unit_test(late_events_are_found),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
