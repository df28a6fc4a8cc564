/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: while the shear rate changes, stops and is reversed on the way, the next collision is that of a plain search
 * in every neighbour search; a gas sheared backwards is the mirror image of one sheared forwards; momentum stays 0; an
 * elastic run whose velocities and rates are reversed returns to its start; grains that fly freely move by the strain;
 * and a run that is saved on the way continues with the same bits. */
#include <stdio.h>
#include <string.h>

#include "md/row_motion.h"
#include "md_test.h"

enum { MOST = 300 };

static void advance(gg_md *e, double dt)
{
  gg_error err = {0};
  if (gg_md_ops.advance(&e->base, dt, UINT64_MAX, NULL, &err) != GG_OK) fail_msg("%s", err.message);
}

static void shear(gg_md *e, double rate)
{
  gg_error err = {0};
  if (gg_md_ops.shear(&e->base, rate, &err) != GG_OK) fail_msg("%s", err.message);
}

static const char *search_of(const gg_md *e)
{
  static const char *const names[] = {[GG_MD_PLAIN_CELLS] = "plain cells",
                                      [GG_MD_COMOVING_ROWS] = "co-moving rows",
                                      [GG_MD_OVERLAPPING_CELLS] = "overlapping cells",
                                      [GG_MD_OVERLAPPING_ROWS] = "overlapping rows",
                                      [GG_MD_NEIGHBOUR_LISTS] = "lists"};
  return names[e->search.kind];
}

/* Density and number such that each of the searches under shear is chosen. */
static const md_case cases[] = {{GG_USF, 30, 0.2, 0.8, -1, INFINITY, {0}},   /* plain cells */
                                {GG_USF, 210, 0.3, 0.9, 0.3, INFINITY, {0}}, /* co-moving rows */
                                {GG_USF, 150, 0.01, 0.8, -1, INFINITY, {0}}, /* overlapping rows */
                                {GG_USF, 120, 0.45, 0.9, 0, 0.4, {0}}};      /* lists */
static const gg_md_search_kind kinds[] = {GG_MD_PLAIN_CELLS, GG_MD_COMOVING_ROWS, GG_MD_OVERLAPPING_ROWS,
                                          GG_MD_NEIGHBOUR_LISTS};
enum { CASES = sizeof cases / sizeof *cases };

static const double rates[] = {-1, 0, 0.4, -2, 0, 3, -0.05};
enum { RATES = sizeof rates / sizeof *rates };

/* The engine makes the collision that the plain search predicts: none before it, and this one then. */
static void check_next(gg_md *e)
{
  const double tolerance = 1e-10 * e->k.mean_free_time, horizon = 30 * e->k.mean_free_time / e->n;
  const md_prediction next = md_oracle(e, horizon);
  const uint64_t before = e->k.collisions;
  advance(e, next.time < horizon ? fmax((double)next.time - tolerance, 0) : horizon);
  const uint64_t early = e->k.collisions - before;
  if (!(next.time < horizon)) {
    assert_int_equal(early, 0);
    return;
  }
  const uint32_t one = e->grain[next.pair[0]].counter, two = e->grain[next.pair[1]].counter;
  advance(e, 2 * tolerance);
  const bool same = e->grain[next.pair[0]].counter != one && e->grain[next.pair[1]].counter != two;
  if ((early > 0 && next.time > tolerance) || !same || e->k.collisions != before + 1)
    fail_msg("%s, rate %g: plain search (%u, %u) after %.17Lg; the engine made %d collisions, %d of them early",
             search_of(e), e->model.shear_rate, next.pair[0], next.pair[1], next.time, (int)(e->k.collisions - before),
             (int)early);
}

static void every_search_finds_the_next_collision(void **state)
{
  (void)state;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = md_model(cases[c]);
    gg_md *e = md_create(&m, 3);
    if (e->search.kind != kinds[c]) fail_msg("case %d has %s", c, search_of(e));
    md_collide(e, 500);
    for (int k = 0; k < RATES; k++) {
      const gg_vec momentum = md_momentum(e);
      shear(e, rates[k]);
      const gg_vec now = md_momentum(e);
      assert_true(fabs(now.x - momentum.x) < 1e-10 && fabs(now.x) < 1e-9 && fabs(now.y) < 1e-9 && fabs(now.z) < 1e-9);
      for (int i = 0; i < 15; i++) check_next(e);
      /* Long enough for images and rows to move by many cells, then once more. */
      md_collide(e, 10 * e->n);
      assert_int_equal(md_misplaced(e), 0);
      for (int i = 0; i < 8; i++) check_next(e);
    }
    if (!(md_closest(e) > 1 - 1e-12L)) fail_msg("%s: closest 1 - %Lg", search_of(e), 1 - md_closest(e));
    md_destroy(e);
  }
}

/* Reflection at x = L_x/2; spins are axial vectors. */
static void reflect(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->r.x = e->box.edge[0] - g->r.x;
    g->v.x = -g->v.x;
    if (e->spin) e->spin[i].y = -e->spin[i].y, e->spin[i].z = -e->spin[i].z;
  }
  e->box.offset0 = gg_wrap(-e->box.offset0, e->box.edge[0], e->box.inverse[0]);
}

static void backwards_is_the_mirror_image(void **state)
{
  (void)state;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = md_model(cases[c]);
    gg_md *forward = md_create(&m, 5), *back = md_create(&m, 5);
    md_collide(forward, 200), md_collide(back, 200);
    shear(forward, 0.5), shear(back, 0.5);
    reflect(back);
    back->model.shear_rate = -0.5; /* the laboratory velocities are reflected with the flow */
    back->box.image_velocity = -0.5 * back->box.edge[1];
    shear(back, -0.5);
    for (uint32_t k = 0; k < forward->n; k++) {
      uint32_t counter[MOST];
      for (uint32_t i = 0; i < forward->n; i++) counter[i] = forward->grain[i].counter;
      const double one = md_collide(forward, 1), two = md_collide(back, 1);
      if (!(fabs(one - two) < 1e-8 * forward->k.mean_free_time))
        fail_msg("%s: collision %u after %.17g and %.17g", search_of(forward), k, one, two);
      for (uint32_t i = 0; i < forward->n; i++)
        if (forward->grain[i].counter != counter[i]) assert_true(back->grain[i].counter == forward->grain[i].counter);
    }
    md_destroy(forward);
    md_destroy(back);
  }
}

static gg_vec place(const gg_md *e, uint32_t i)
{
  return gg_md_position(e, e->falls, &e->grain[i], e->k.now);
}

/* Reverse peculiar velocities and spins, and with them the rate. */
static void turn_back(gg_md *e, double rate)
{
  gg_error err;
  shear(e, -rate);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    const double flow = -rate * (g->r.y - 0.5 * e->box.edge[1]);
    g->v.x = flow - (g->v.x - flow);
    g->v.y = -g->v.y, g->v.z = -g->v.z;
    if (e->spin) e->spin[i] = gg_scale(-1, e->spin[i]);
  }
  assert_int_equal(gg_md_predict_anew(e, &err), GG_OK);
}

/* Smooth, and perfectly rough grains. */
static void a_reversed_elastic_run_returns(void **state)
{
  (void)state;
  static const double rate[] = {1, 0.3, 0, -0.8, -1.5};
  enum { STEPS = sizeof rate / sizeof *rate };
  for (int c = 0; c < CASES; c++)
    for (int rough = 0; rough < 2; rough++) {
      md_case elastic = cases[c];
      elastic.e = 1, elastic.beta = rough ? 1 : -1, elastic.mu = INFINITY;
      gg_model m = md_model(elastic);
      m.temperature0 = 1;
      gg_md *e = md_create(&m, 7);
      gg_vec start[MOST], c0[MOST], spin[MOST] = {{0, 0, 0}};
      md_collide(e, 100);
      advance(e, 0.01 * e->k.mean_free_time); /* from the collision that ended the advance */
      shear(e, rate[0]);
      for (uint32_t i = 0; i < e->n; i++) {
        start[i] = place(e, i), c0[i] = e->grain[i].v;
        if (rough) spin[i] = e->spin[i];
      }
      const double part = 0.2 * e->k.mean_free_time; /* longer runs diverge from rounding */
      const uint64_t before = e->k.collisions;
      for (int k = 0; k < STEPS; k++) shear(e, rate[k]), advance(e, part);
      assert_true(e->k.collisions - before > e->n / 4); /* most grains have collided, or several times */
      turn_back(e, rate[STEPS - 1]);
      for (int k = STEPS - 1; k >= 0; k--) shear(e, -rate[k]), advance(e, part);
      double most = 0, fastest = 0;
      for (uint32_t i = 0; i < e->n; i++) {
        gg_vec dr = gg_sub(place(e, i), start[i]), dv = {0, 0, 0}, v = e->grain[i].v;
        gg_md_minimum_image(&e->box, true, e->k.now, &dr, &dv);
        most = fmax(most, sqrt(gg_dot(dr, dr)));
        /* The image of a grain that crossed the boundary moves with it. */
        const double flow = e->model.shear_rate * (place(e, i).y - 0.5 * e->box.edge[1]),
                     flow0 = rate[0] * (start[i].y - 0.5 * e->box.edge[1]);
        dv = (gg_vec){v.x - flow + c0[i].x - flow0, v.y + c0[i].y, v.z + c0[i].z};
        fastest = fmax(fastest, sqrt(gg_dot(dv, dv)));
        if (rough) dv = gg_add(e->spin[i], spin[i]), fastest = fmax(fastest, sqrt(gg_dot(dv, dv)));
      }
      if (!(most < 1e-4 && fastest < 1e-4))
        fail_msg("%s, %s: places return to %.3g diameters, velocities to %.3g", search_of(e),
                 rough ? "rough" : "smooth", most, fastest);
      md_destroy(e);
    }
}

/* C_x falls by the strain times C_y, whatever the rates were. */
static void free_flight_is_exact(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_USF, 60, 1e-9, 0.9, -1, INFINITY, {0}});
  m.temperature0 = 1;
  gg_md *e = md_create(&m, 1);
  gg_vec c[MOST];
  double strain = 0, most = 0, fastest = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    c[i] = e->grain[i].v;
    c[i].x -= e->model.shear_rate * (place(e, i).y - 0.5 * e->box.edge[1]);
    fastest = fmax(fastest, sqrt(gg_dot(c[i], c[i])));
  }
  const uint64_t before = e->k.collisions;
  for (int k = 0; k < 20; k++) {
    const double dt = 0.1 + 0.03 * k;
    shear(e, rates[k % RATES]);
    advance(e, dt);
    strain += rates[k % RATES] * dt;
  }
  assert_int_equal(e->k.collisions, before);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec now = e->grain[i].v;
    now.x -= e->model.shear_rate * (place(e, i).y - 0.5 * e->box.edge[1]);
    const gg_vec off = {now.x - (c[i].x - strain * c[i].y), now.y - c[i].y, now.z - c[i].z};
    most = fmax(most, sqrt(gg_dot(off, off)));
  }
  if (!(fabs(strain) > 1 && most < 1e-10 * fastest))
    fail_msg("strain %g: velocities off by %g of %g", strain, most, fastest);
  md_destroy(e);
}

static uint64_t steps(gg_md *e, int from)
{
  for (int k = from; k < RATES; k++) shear(e, rates[k]), md_collide(e, 2 * e->n), advance(e, 0.01);
  return md_hash_all(e);
}

static void a_saved_run_continues(void **state)
{
  (void)state;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = md_model(cases[c]);
    gg_md *e = md_create(&m, 9);
    gg_engine *again;
    gg_archive archive = {0};
    gg_error err = {0};
    md_collide(e, 300);
    for (int k = 0; k < 2; k++) shear(e, rates[k]), md_collide(e, 3 * e->n);
    if (gg_md_ops.save(&e->base, &archive, &err) != GG_OK) fail_msg("%s", err.message);
    gg_model then = m;
    then.shear_rate = rates[1];
    if (gg_md_ops.restore(&then, &archive, &again, &err) != GG_OK) fail_msg("%s: %s", search_of(e), err.message);
    md_collide(e, e->n), md_collide((gg_md *)again, e->n); /* at the rate 0 that was saved */
    assert_int_equal(md_hash(e), md_hash((gg_md *)again));
    assert_int_equal(steps(e, 2), steps((gg_md *)again, 2));
    gg_base_archive_clear(&archive);
    md_destroy(e);
    md_destroy((gg_md *)again);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_search_finds_the_next_collision),
                                     cmocka_unit_test(backwards_is_the_mirror_image),
                                     cmocka_unit_test(a_reversed_elastic_run_returns),
                                     cmocka_unit_test(free_flight_is_exact), cmocka_unit_test(a_saved_run_continues)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
