/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, for every shape of wall:
 * - The contact time of a grain on a line or parabola is that of a search in small steps along its clearance.
 * - The normal is the gradient of the clearance, and gg_surface_put_outside leaves no overlap.
 * - A grain that has just bounced does not touch again at once.
 * - Walls of a channel are images of each other. Ridges that leave no room for grains are rejected.
 * - Thermal walls, with ridges, too, re-emit the given fraction of grains with the moments of the flux of a
 *   half-Maxwellian. Impulse and heat of the wall are those that grains lose. Other walls draw no random number. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "common/model.h"
#include "common/rng.h"
#include "common/surface/collide.h"
#include "common/surface/shapes.h"
#include "scene/model_of_scene.h"

static const gg_surface surfaces[] = {
    {.shape = GG_SHAPE_plane, .axis = 1, .side = -1, .place = 0},
    {.shape = GG_SHAPE_plane, .axis = 1, .side = 1, .place = 9},
    {.shape = GG_SHAPE_plane, .axis = 2, .side = 1, .place = 9},
    {.shape = GG_SHAPE_ridges, .axis = 1, .side = -1, .place = 0, .radius = 0.5},
    {.shape = GG_SHAPE_ridges, .axis = 1, .side = 1, .place = 9, .radius = 0.75},
};
enum { SURFACES = sizeof surfaces / sizeof *surfaces, FLIGHTS = 3000, STEPS = 4000 };
static const double edge = 9, cell = 1.5, horizon = 6;

static double within(gg_rng *r, double from, double to)
{
  return from + (to - from) * gg_rng_uniform(r);
}

static gg_vec at(const gg_flight *f, double t)
{
  return gg_axpy(0.5 * t * t, *f->g, gg_axpy(t, *f->v, *f->r));
}

static double clearance(const gg_surface *s, const gg_flight *f, double t)
{
  gg_vec r = at(f, t);
  return gg_surface_clearance(s, &r, f->radius);
}

/* The first step in which it falls below 0, halved until nothing is left; `from` says where it is above. */
static double search(const gg_surface *s, const gg_flight *f, double from, double to)
{
  for (int k = 1; k <= STEPS; k++) {
    double a = from + (to - from) * (k - 1) / STEPS, b = from + (to - from) * k / STEPS;
    if (!(clearance(s, f, b) < 0)) continue;
    for (int m = 0; m < 100; m++) {
      double middle = 0.5 * (a + b);
      if (clearance(s, f, middle) > 0)
        a = middle;
      else
        b = middle;
    }
    return b;
  }
  return INFINITY;
}

/* When the centre leaves the cell along x; STEPS are as fine as those of the search. */
static double leaves(const gg_flight *f, const gg_region *where)
{
  for (int k = 1; k <= STEPS; k++) {
    double t = horizon * k / STEPS, x = at(f, t).x;
    if (x < where->from[0] || x > where->to[0]) return horizon * (k - 1) / STEPS;
  }
  return horizon;
}

/* A grain in a random cell, clear of the surface, in flight; gravity in half of the cases, along any direction. */
static gg_region start(const gg_surface *s, gg_rng *r, gg_vec v[3], double radius)
{
  gg_region where;
  do {
    for (int a = 0; a < 3; a++) {
      where.from[a] = cell * gg_rng_below(r, 6);
      where.to[a] = where.from[a] + cell;
      *gg_component(&v[0], a) = within(r, where.from[a], where.to[a]);
    }
  } while (gg_surface_clearance(s, &v[0], radius) < 1e-3);
  v[1] = gg_common_rng_normal_vec(r);
  v[2] = gg_scale(gg_rng_below(r, 2) ? 0.7 : 0, gg_common_rng_normal_vec(r));
  return where;
}

/* Steps are 0.0015 long in time: two contacts in one of them, where it only just dips below 0, are missed by the
 * search.
 */
static void contacts_are_those_of_a_fine_search(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1, 2);
  for (int w = 0; w < SURFACES; w++) {
    const gg_surface *s = &surfaces[w];
    int met = 0, missed = 0;
    for (int k = 0; k < FLIGHTS; k++) {
      gg_vec v[3];
      double radius = within(&r, 0.2, 0.5);
      gg_region where = start(s, &r, v, radius);
      const gg_flight f = {&v[0], &v[1], &v[2], radius};
      double end = leaves(&f, &where), found = search(s, &f, 0, end), told = gg_surface_delay(s, &f, &where);
      met += found < end;
      if (told < found - 1e-3 && told < end && clearance(s, &f, told + 1e-6) < clearance(s, &f, told - 1e-6) &&
          fabs(clearance(s, &f, told)) < 1e-12) {
        missed++; /* it dips */
        continue;
      }
      if (!(found < end ? fabs(told - found) < 1e-9 : told >= end - 1e-9))
        fail_msg("surface %d, flight %d: searched %.15g, told %.15g, in the cell until %g", w, k, found, told, end);
    }
    print_message("# surface %d: %d contacts in %d flights, %d dips\n", w, met, (int)FLIGHTS, missed);
    assert_true(met > FLIGHTS / 50 && missed < FLIGHTS / 100);
  }
}

static void normals_are_gradients_of_the_distance(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1, 3);
  for (int k = 0; k < FLIGHTS; k++) {
    const gg_surface *s = &surfaces[k % SURFACES];
    gg_vec p = {within(&r, 0, edge), within(&r, 0, edge), within(&r, 0, edge)};
    double radius = within(&r, 0.2, 0.5), h = 1e-6;
    gg_surface_put_outside(s, radius, &p);
    assert_true(gg_surface_clearance(s, &p, radius) > -1e-14);
    double depth = s->side * (s->place - gg_along(&p, s->axis));
    if (gg_surface_clearance(s, &p, radius) < 1e-12) assert_true(depth < gg_surface_height(s) + radius + 1e-12);
    gg_vec normal = gg_surface_normal(s, &p);
    assert_true(fabs(gg_dot(normal, normal) - 1) < 1e-14);
    for (int a = 0; a < 3; a++) {
      gg_vec up = p, down = p;
      *gg_component(&up, a) += h, *gg_component(&down, a) -= h;
      double slope = (gg_surface_clearance(s, &up, radius) - gg_surface_clearance(s, &down, radius)) / (2 * h);
      assert_true(fabs(slope + gg_along(&normal, a)) < 1e-8);
    }
  }
}

/* A grain that has just bounced and falls back does not touch at once, but at the time that a search finds. */
static void a_grain_that_bounced_does_not_touch_at_once(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1, 4);
  for (int k = 0; k < FLIGHTS; k++) {
    const gg_surface *s = &surfaces[k % SURFACES];
    const gg_region everywhere = {{0, 0, 0}, {edge, edge, edge}};
    double radius = within(&r, 0.2, 0.5);
    gg_vec p = {within(&r, 3, 6), within(&r, 3, 6), within(&r, 3, 6)}, v = gg_scale(0.2, gg_common_rng_normal_vec(&r));
    *gg_component(&p, s->axis) = s->place;
    gg_surface_put_outside(s, radius, &p);
    gg_vec normal = gg_surface_normal(s, &p), g = gg_scale(0.5, normal);
    v = gg_axpy(-gg_dot(v, normal) - 0.3, normal, v);
    const gg_flight f = {&p, &v, &g, radius};
    double delay = gg_surface_delay(s, &f, &everywhere), early = 1e-4, found = search(s, &f, early, 2);
    assert_true(delay > 1e-9 && (delay == INFINITY || fabs(clearance(s, &f, delay)) < 1e-12));
    if (delay > early && found < 2 && fabs(delay - found) > 1e-9)
      fail_msg("surface %d: %g, not %g", k % SURFACES, delay, found);
    v = gg_axpy(1, normal, v); /* a grain that approaches touches at once */
    assert_true(gg_surface_delay(s, &f, &everywhere) < 1e-12);
  }
}

/* Both walls of a channel are images of each other, whatever their shape; a floor without a top has no image. */
static void walls_of_a_gap_are_images_of_each_other(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    gg_scene s = gg_scene_defaults();
    gg_model m;
    gg_error err;
    s.flow = GG_CHUTE, s.phi = 0.2, s.particles = 500;
    s.walls.top = k == 2 ? GG_OPEN_TOP : s.walls.top;
    s.walls.ridges = k == 1 ? 0.5 : 0;
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
    assert_int_equal(m.n_surfaces, k == 2 ? 1 : 2);
    for (int w = 0; w < m.n_surfaces; w++) assert_int_equal(gg_surface_image(&m, w), k == 2 ? -1 : 1 - w);
  }
}

/* Ridges have at least a tenth of a diameter; between those of both walls two diameters remain free. */
static void ridges_leave_room_for_grains(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  gg_model m;
  gg_error err;
  s.flow = GG_CHUTE, s.phi = 0.2, s.particles = 200;
  const double least[] = {0.0999, 0.1};
  for (int k = 0; k < 2; k++) {
    s.walls.ridges = least[k];
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), k ? GG_OK : GG_BAD_INPUT);
  }
  const double length = m.box[0], gap = m.box[1];
  int refused = 0;
  for (s.walls.ridges = 0.5; s.walls.ridges < length; s.walls.ridges += 0.05) {
    double height = 0.5 * length / round(length / s.walls.ridges);
    bool fits = gap - 2 * height >= 2;
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), fits ? GG_OK : GG_BAD_INPUT);
    refused += !fits;
  }
  assert_true(refused > 5);
  s.aspect[1] = 9, s.walls.ridges = 0; /* one ridge is as wide as the box, no less than half of what was asked for */
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
  s.walls.ridges = 1.99 * m.box[0];
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
  s.walls.ridges = 2.01 * m.box[0];
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
}

static gg_vec across(gg_vec v, gg_vec k)
{
  return gg_axpy(-gg_dot(v, k), k, v);
}

static void thermal_walls_emit_the_flux_distribution(void **state)
{
  (void)state;
  enum { HITS = 200000 };
  const double m = 3, K = 0.5, T = 1.7;
  const gg_contact contact = gg_common_contact_make((gg_partner){m, K}, (gg_partner){INFINITY, 1}, 1, 1, INFINITY);
  gg_rng r = gg_common_rng_seed(4, 4), before;
  gg_surface s = surfaces[4];
  s.velocity.x = 0.6, s.temperature = T, s.accommodation = 0.7;
  double sum[4] = {0}, taken_up = 0;
  for (int i = 0; i < HITS; i++) {
    const gg_vec at = {9.0 * i / HITS, 8, 0}, k = gg_surface_normal(&s, &at), came = {0.3, 1, -0.2},
                 turned = {1, 0.2, 0};
    gg_vec v = came, spin = turned;
    const gg_surface_hit hit = gg_surface_collide(GG_ROUGH, &s, &contact, &r, k, &v, &spin);
    const gg_vec u = gg_sub(v, s.velocity), w = gg_sub(came, s.velocity), J = gg_scale(m, gg_sub(came, v));
    const double lost = 0.5 * m * (gg_dot(w, w) - gg_dot(u, u) + K * (gg_dot(turned, turned) - gg_dot(spin, spin)));
    assert_true(fabs(gg_surface_heat(&contact, k, &hit) - lost) < 1e-12);
    for (int a = 0; a < 3; a++) assert_true(fabs(gg_along(&hit.J, a) - gg_along(&J, a)) < 1e-12);
    if (!hit.thermal) continue;
    assert_true(gg_dot(u, k) < 0);
    taken_up++;
    sum[0] -= gg_dot(u, k), sum[1] += gg_dot(u, k) * gg_dot(u, k);
    sum[2] += gg_dot(across(u, k), across(u, k)), sum[3] += gg_dot(spin, spin);
  }
  /* <v_n>, <v_n^2>, <v_t^2>, <s^2>: relative scatter 0.52, 1, 1, 0.82 */
  const double right[4] = {sqrt(M_PI * T / (2 * m)), 2 * T / m, 2 * T / m, 3 * T / (K * m)},
               scatter[] = {0.52, 1, 1, 0.82};
  for (int q = 0; q < 4; q++) {
    print_message("# %.5g, expected %.5g\n", sum[q] / taken_up, right[q]);
    assert_true(fabs(sum[q] / taken_up / right[q] - 1) < 4 * scatter[q] / sqrt(taken_up));
  }
  assert_true(fabs(taken_up / HITS - 0.7) < 4 * sqrt(0.21 / HITS));
  s.accommodation = 0, before = r;
  gg_vec v = {0, 1, 0}, spin = {0, 0, 0};
  const gg_vec at = {3, 8, 0};
  (void)gg_surface_collide(GG_ROUGH, &s, &contact, &r, gg_surface_normal(&s, &at), &v, &spin);
  assert_memory_equal(&r, &before, sizeof r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contacts_are_those_of_a_fine_search),
      cmocka_unit_test(normals_are_gradients_of_the_distance),
      cmocka_unit_test(a_grain_that_bounced_does_not_touch_at_once),
      cmocka_unit_test(walls_of_a_gap_are_images_of_each_other),
      cmocka_unit_test(ridges_leave_room_for_grains),
      cmocka_unit_test(thermal_walls_emit_the_flux_distribution),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
