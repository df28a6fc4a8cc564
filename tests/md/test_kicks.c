/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: in a slot of the kick schedule two grains of a species get opposite kicks, or none; every grain has one slot
 * in every interval, and neighbours in memory have slots far apart; second and fourth moments of the kicks in an
 * interval are those of white noise; after kicks no contact is missed; kicks are few; and the cumulant a2 is that of
 * Enskog's equation, while intervals four times as long fail. */
#include "md_test.h"

#include <stdlib.h>
#include <string.h>

#include "md/kicks.h"
#include "scene/model_of_scene.h"

static gg_scene heated(int64_t n, double phi, double e)
{
  gg_scene s = md_scene((md_case){GG_HSS, n, phi, e, -1, INFINITY, {0}});
  s.thermostat = GG_WHITE_NOISE;
  return s;
}

/* n[0] and n[1] grains of two species, of which the second has `mass` times the mass of the first. */
static gg_model mixture(double phi, double e, int64_t one, int64_t two, double mass)
{
  gg_scene s = heated(one + two, phi, e);
  gg_model m;
  gg_error err = {0};
  s.n_species = 2;
  s.species[0].fraction = (double)one / (double)(one + two), s.species[1].fraction = (double)two / (double)(one + two);
  s.species[1].mass = mass;
  if (gg_scene_model_make(&s, GG_MD, &m, &err) != GG_OK) fail_msg("%s", err.message);
  assert_int_equal(m.n_of[0], one);
  return m;
}

typedef struct slot_log {
  gg_vec *v;
  int64_t *last; /* slot of each grain's last kick; -1: none yet */
} slot_log;

/* Run one slot. Returns the number of kicked grains, at most two. */
static int run_slot(gg_md *e, slot_log *log, uint32_t kicked[2])
{
  int n = 0;
  for (uint32_t i = 0; i < e->n; i++) log->v[i] = e->grain[i].v;
  e->k.now = e->k.next_kick;
  gg_md_kick(e);
  for (uint32_t i = 0; i < e->n; i++)
    if (memcmp(&log->v[i], &e->grain[i].v, sizeof(gg_vec)) != 0) {
      assert_true(n < 2);
      kicked[n++] = i;
    }
  return n;
}

/* Over many rounds. With an even number of grains one half is paired with the other, shifted by one each round. */
static void every_grain_has_its_slot(void **state)
{
  (void)state;
  static const int64_t sizes[] = {2, 3, 4, 31, 60, 131};
  for (int k = 0; k < 6; k++) {
    gg_scene s = heated(sizes[k], 0.01, 0.9);
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 1);
    gg_md_kick_schedule *t = &e->kicks.schedule[0];
    if (k == 5) t->group = 32, t->step = 3; /* as with many grains: four groups, and three grains left over */
    slot_log log = {calloc(e->n, sizeof *log.v), malloc(e->n * sizeof *log.last)};
    const int64_t half = sizes[k] / 2, slots = 60 * sizes[k];
    int64_t kicks = 0;
    for (uint32_t i = 0; i < e->n; i++) log.last[i] = -1;
    for (int64_t slot = 0; slot < slots; slot++) {
      uint32_t pair[2];
      const int n = run_slot(e, &log, pair);
      assert_true(n == 0 || n == 2);
      kicks += n / 2;
      for (int j = 0; j < n; j++) {
        const int64_t before = log.last[pair[j]], rounds = (slot - before + half / 2) / half;
        if (before >= 0) assert_true(rounds >= 1 && llabs(slot - before - rounds * half) <= rounds);
        log.last[pair[j]] = slot;
      }
    }
    for (uint32_t i = 0; i < e->n; i++) assert_true(log.last[i] > slots - 20 * sizes[k]);
    const double chance = t->chance, error = sqrt(chance * (1 - chance) / (double)slots);
    assert_true(fabs((double)kicks / (double)slots - chance) < 4 * error);
    gg_vec p = md_momentum(e);
    assert_true(gg_dot(p, p) < 1e-24 * md_energy(e) * (double)e->n);
    free(log.v);
    free(log.last);
    md_destroy(e);
  }
}

/* Neighbours along the space-filling curve have slots far apart: a tenth of the slots of a round covers a tenth of
 * every tenth of the grains. */
static void slots_are_even_in_space(void **state)
{
  (void)state;
  gg_scene s = heated(2000, 0.05, 0.9);
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 1);
  const gg_md_kick_schedule *t = &e->kicks.schedule[0];
  for (uint64_t from = 0; from + 200 <= 2000; from += 100) {
    int in[10] = {0};
    for (uint64_t k = from; k < from + 200; k++) in[k * t->step % t->n / 200]++;
    for (int part = 0; part < 10; part++) assert_in_range(in[part], 17, 23);
  }
  md_destroy(e);
}

/* A kick has a fixed length l and comes with probability p: per interval t <l^2> = 3 xi^2 t, and <l^4> is below
 * 15 xi^4 t^2 by the fraction 1 - 2 g, at most 0.4 (kicks.c). g = 1/u - 1/(e^u - 1), where collisions reduce the excess
 * of a grain by e^-u: by 2/3 a collision, and by a quarter of the cooling rate. A slot brings a quarter of T unless
 * slots are far apart, or 12 %, or they are half a mean free time apart. */
static void kicks_have_the_moments_of_white_noise(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++) {
    gg_model m = mixture(0.1, (double[]){0.99, 0.9, 0.5, 0}[k], 600, 400, 3);
    gg_md *e = md_create(&m, 1);
    const double free_time = 1 / gg_common_model_collision_rate(&m, m.temperature0);
    const double cooling = (0.6 * m.mass[0] + 0.4 * m.mass[1]) * e->noise / m.temperature0;
    for (int s = 0; s < 2; s++) {
      const gg_md_kick_schedule *t = &e->kicks.schedule[s];
      const double interval = t->interval * t->n / 2, variance = e->noise * interval, l2 = t->size * t->size;
      const double share = m.mass[s] * variance / m.temperature0, w = interval / free_time;
      const double u = 2 * w / 3 + 0.25 * cooling * interval, fourth = 1 - fmin(0.4, 1 - 2 / u + 2 / expm1(u));
      assert_true(fabs(t->chance * l2 / (3 * variance) - 1) < 1e-12);
      assert_true(fabs(t->chance * l2 * l2 / (15 * variance * variance) - fourth) < 1e-9);
      assert_true(t->chance <= 1 + 1e-12);
      assert_true((share < 0.25 * (1 + 1e-12) && w < 3.5 * (1 + 1e-12)) || share < 0.12 * (1 + 1e-12) ||
                  fabs(w / 0.5 - 1) < 1e-12);
    }
    assert_true(e->kicks.schedule[0].interval * 600 >= e->kicks.schedule[1].interval * 400);
    md_destroy(e);
  }
}

/* The next collision is that of the plain event finder, with kicks in between or not; every grain is in its cell. */
static void no_contact_is_missed(gg_md *e)
{
  for (int k = 0; k < 40; k++) {
    const double horizon = 0.2 / gg_common_model_collision_rate(&e->model, e->model.temperature0) / e->n;
    md_prediction next = md_oracle(e, horizon);
    const double stop = e->k.next_kick - e->k.now, dt = fmin(horizon, 0.99 * stop);
    const uint64_t before = e->k.collisions;
    gg_error err;
    if (next.time < dt) {
      const double gone = md_collide(e, 1);
      assert_true(fabsl(gone - next.time) < 1e-10L * e->k.mean_free_time);
    } else {
      assert_int_equal(gg_md_ops.advance(&e->base, dt, UINT64_MAX, NULL, &err), GG_OK);
      assert_int_equal(e->k.collisions, before);
    }
    assert_int_equal(gg_md_ops.advance(&e->base, 3 * horizon, UINT64_MAX, NULL, &err), GG_OK);
  }
  assert_int_equal(md_misplaced(e), 0);
  assert_true(md_closest(e) > 1 - 1e-12L);
}

/* Cells, overlapping cells and lists; a few heavy or light grains among others. */
static void no_contact_is_missed_after_kicks(void **state)
{
  (void)state;
  static const double phi[] = {0.02, 0.2, 0.45};
  for (int k = 0; k < 3; k++) {
    gg_scene s = heated(600, phi[k], 0.5);
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 2);
    md_collide(e, 3000);
    no_contact_is_missed(e);
    md_destroy(e);
  }
  for (int k = 0; k < 2; k++) {
    gg_model m = mixture(0.1, 0.5, 200, 3, k ? 0.1 : 10);
    gg_md *e = md_create(&m, 2);
    md_collide(e, 3000);
    no_contact_is_missed(e);
    gg_vec p = md_momentum(e);
    assert_true(gg_dot(p, p) < 1e-20 * md_energy(e) * e->n);
    assert_true(e->k.kick[0].number > 0 && e->k.kick[1].number > 0);
    md_destroy(e);
  }
}

/* Kicked pairs per collision: each costs two predictions; a collision of an elastic gas costs some three. */
static void kicks_are_few(void **state)
{
  (void)state;
  static const double e_of[] = {0.99, 0.9, 0.5}, most[] = {0.06, 0.3, 0.8};
  for (int k = 0; k < 3; k++) {
    gg_scene s = heated(1000, 0.3, e_of[k]),
             plain = md_scene((md_case){GG_EQUILIBRIUM, 1000, 0.3, 1, -1, INFINITY, {0}});
    gg_model m = md_model_of(&s), mp = md_model_of(&plain);
    gg_md *e = md_create(&m, 1), *p = md_create(&mp, 1);
    md_collide(e, 20000);
    md_collide(p, 20000);
    const double kicks = e->kicks.schedule[0].chance * (double)e->k.kick[0].number / 20000;
    const double more = (double)(e->k.events - p->k.events) / 20000;
    print_message("# e = %g: %.3g kicks, %.3g more events per collision\n", e_of[k], kicks, more);
    assert_true(kicks < most[k] && more < most[k] + 0.2);
    md_destroy(e);
    md_destroy(p);
  }
}

/* a2 at e = 0.5 is that of Enskog's equation without random numbers (enskog_hermite, phi: 0), 0.025015, to 0.0032, four
 * standard errors; so are the means of T and of the collision rate. At four times the interval a2 is off by 0.0055. */
static void cumulant_is_that_of_enskogs_equation(void **state)
{
  (void)state;
  gg_scene s = heated(2000, 0.005, 0.5);
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 5);
  const int samples = 800;
  double c2 = 0, c4 = 0;
  md_collide(e, 20 * 1000);
  const double start = gg_md_time(e);
  for (int k = 0; k < samples; k++) {
    md_collide(e, 2000);
    for (int i = 0; i < 2000; i++) {
      const double v2 = gg_dot(e->grain[i].v, e->grain[i].v);
      c2 += v2 / 2000 / samples, c4 += v2 * v2 / 2000 / samples;
    }
  }
  const double a2 = 0.6 * c4 / (c2 * c2) - 1, T = c2 / 3 / m.temperature0;
  const double rate = 2.0 * samples / (gg_md_time(e) - start);
  const double maxwellian = gg_common_model_collision_rate(&m, T * m.temperature0); /* 1 - a2/16 of it */
  print_message("# a2 %.5f, T %.5f, rate %.5f\n", a2, T, rate / maxwellian);
  assert_true(fabs(a2 - 0.025015) < 0.0032);
  assert_true(fabs(T / 0.9969 - 1) < 0.006);
  assert_true(fabs(rate / maxwellian - (1 - 0.025 / 16)) < 0.005);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_grain_has_its_slot),
      cmocka_unit_test(slots_are_even_in_space),
      cmocka_unit_test(kicks_have_the_moments_of_white_noise),
      cmocka_unit_test(no_contact_is_missed_after_kicks),
      cmocka_unit_test(kicks_are_few),
      cmocka_unit_test(cumulant_is_that_of_enskogs_equation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
