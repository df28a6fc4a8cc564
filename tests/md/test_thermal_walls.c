/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, for gases between thermal walls: without collisions heat flux, pressure and shear stress are those of two
 * half-Maxwellians, which is exact at any accommodation; dense gases between walls of one temperature have that
 * temperature and no heat flux (smooth mixtures, and rough grains with their spins); the energy of grains changes by
 * what walls take and give; restored runs continue bit for bit. */
#include <stdio.h>
#include <stdlib.h>

#include "md_test.h"
#include "scene/scene.h"

enum { BLOCKS = 40, SKIPPED = 5 };

/* For the mean over blocks and its standard error. */
typedef struct series {
  double sum, squares;
} series;

static void add(series *s, double x)
{
  s->sum += x / BLOCKS, s->squares += x * x / BLOCKS;
}

/* Fails unless the mean is within four standard errors of `right`, and these are below 0.5 % of `scale`. */
static void expect(const char *what, series s, double right, double scale)
{
  const double error = sqrt((s.squares - s.sum * s.sum) / (BLOCKS - 1));
  print_message("# %-34s %.6g +- %.2g, expected %.6g (%+.2f sigma)\n", what, s.sum, error, right,
                (s.sum - right) / error);
  if (!(fabs(s.sum - right) < 4 * error)) fail_msg("%s: %g +- %g is not %g", what, s.sum, error, right);
  if (!(error < 0.005 * scale)) fail_msg("%s: an error of %g proves nothing", what, error);
}

/* Heat flux and stresses across the middle of the channel, and heat taken by both walls, per area and time. */
typedef struct block {
  double q, P_yy, P_yx, taken;
} block;

static block advance(gg_md *e, double dt)
{
  const gg_model *m = &e->model;
  gg_collision_sums t;
  double gone;
  assert_int_equal(gg_md_ops.advance(&e->base, dt, UINT64_MAX, &gone, NULL), GG_OK);
  gg_md_ops.take_sums(&e->base, &t);
  const double unit = 1 / (m->box[0] * m->box[2] * gone);
  const gg_surface_sums *low = &t.surface[0], *high = &t.surface[1];
  return (block){0.5 * unit * (high->loss - low->loss), 0.5 * unit * (high->impulse[1] - low->impulse[1]),
                 0.5 * unit * (high->impulse[0] - low->impulse[0]), unit * (high->loss + low->loss)};
}

/* Grains fly from wall to wall. A fraction 1/(2 - a) of the grains that leave a wall was last re-emitted by this wall
 * and the rest by the other one (a: accommodation). So equal numbers of both streams together come from either wall. */
static void free_flight(gg_flow flow, double below, double above, double share)
{
  gg_scene s = md_scene((md_case){flow, 400, 1e-9, 1, -1, INFINITY, {10, 1, 10}});
  s.walls.temperature[0] = below, s.walls.temperature[1] = above;
  s.walls.accommodation = share, s.walls.e = 1, s.walls.beta = -1;
  const gg_model m = md_model_of(&s);
  const double T[2] = {m.surface[0].temperature, m.surface[1].temperature}, free = m.box[1] - 1;
  const double jump = m.surface[0].velocity.x - m.surface[1].velocity.x;
  gg_md *e = md_create(&m, 5);
  series q = {0}, P_yy = {0}, P_yx = {0}, taken = {0};
  for (int b = -SKIPPED; b < BLOCKS; b++) {
    const block now = advance(e, 40 * free / sqrt(T[0] < T[1] ? T[0] : T[1]));
    if (b < 0) continue;
    add(&q, now.q), add(&P_yy, now.P_yy), add(&P_yx, now.P_yx), add(&taken, now.taken);
  }
  const double n = (double)m.n / (m.box[0] * m.box[2] * free), passes = share / (2 - share);
  const double J = n / (sqrt(M_PI / 2 / T[0]) + sqrt(M_PI / 2 / T[1])), sound = sqrt(T[0]) + sqrt(T[1]);
  print_message("# %s, T %g and %g, accommodation %g\n", flow == GG_COUETTE ? "couette" : "fourier", T[0], T[1], share);
  expect("heat flux", q, J * 2 * (T[0] - T[1]) * passes, J * 2 * sound * sound);
  expect("P_yy", P_yy, J * sqrt(M_PI / 2) * sound, J * sound);
  expect("P_yx", P_yx, J * jump * passes, J * (sound + fabs(jump)));
  expect("heat of both walls", taken, J * jump * jump * passes, J * (sound * sound + jump * jump));
  md_destroy(e);
}

static void free_flights_carry_heat_and_stress(void **state)
{
  (void)state;
  free_flight(GG_FOURIER, 1, 0.25, 1);
  free_flight(GG_FOURIER, 0.5, 1, 0.5);
  free_flight(GG_COUETTE, 0.5, 0.5, 1);
  free_flight(GG_COUETTE, 0.3, 0.3, 0.6);
}

static gg_scene dense_scene(int kind)
{
  gg_scene s = md_scene((md_case){GG_FOURIER, 400, 0.25, 1, kind ? 1 : -1, INFINITY, {0}});
  s.walls.temperature[0] = s.walls.temperature[1] = 0.7;
  if (kind == 1) s.walls.accommodation = 0.5, s.walls.e = 1, s.walls.beta = 1;
  if (kind == 2) return s;
  s.n_species = 2;
  s.species[0].fraction = s.species[1].fraction = 0.5;
  s.species[1].diameter = 1.4, s.species[1].mass = 3;
  return s;
}

/* m <v^2>/3 of each species, and K m <s^2>/3. */
static void temperatures(const gg_md *e, double *T, double *theta)
{
  for (uint32_t i = 0; i < e->n; i++) {
    const int k = gg_md_species_of(&e->grain[i]);
    const double share = e->model.mass[k] / (3 * (double)e->model.n_of[k]);
    T[k] += share * gg_dot(e->grain[i].v, e->grain[i].v);
    if (e->spin) *theta += share * e->model.inertia[k] * gg_dot(e->spin[i], e->spin[i]) / e->model.n_species;
  }
}

static void walls_of_one_temperature_keep_it(void **state)
{
  (void)state;
  enum { SAMPLES = 60 };
  for (int kind = getenv("NIGHTLY") ? 0 : 1; kind < 3; kind++) {
    const gg_scene s = dense_scene(kind);
    const gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 11);
    assert_true(m.temperature0 == 0.7 && m.contact_time == 0);
    series T[2] = {{0}}, theta = {0}, q = {0}, taken = {0};
    for (int b = -SKIPPED; b < BLOCKS; b++) {
      double now[2] = {0, 0}, spin = 0, flux = 0, heat = 0;
      for (int k = 0; k < SAMPLES; k++) {
        const block part = advance(e, 2);
        flux += part.q / SAMPLES, heat += part.taken / SAMPLES;
        temperatures(e, now, &spin);
      }
      if (b < 0) continue;
      for (int k = 0; k < 2; k++) add(&T[k], now[k] / SAMPLES);
      add(&theta, spin / SAMPLES), add(&q, flux), add(&taken, heat);
    }
    expect("T_1", T[0], 0.7, 0.7);
    if (m.n_species > 1) expect("T_2", T[1], 0.7, 0.7);
    if (e->spin) expect("theta", theta, 0.7, 0.7);
    const double scale = m.density * sqrt(0.7) * 0.7; /* n T sqrt(T): the flux from and to a wall is 0.8 of this */
    expect("heat flux", q, 0, scale);
    expect("heat of both walls", taken, 0, scale);
    md_destroy(e);
  }
}

static void energy_changes_by_what_walls_take(void **state)
{
  (void)state;
  for (int kind = 0; kind < 3; kind++) {
    gg_scene s = dense_scene(kind);
    s.walls.temperature[1] = 0.2, s.gravity[1] = -0.1;
    const gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 3);
    double before = md_energy(e), y = 0, taken = 0, most = 0;
    for (uint32_t i = 0; i < e->n; i++) y -= m.mass[gg_md_species_of(&e->grain[i])] * e->grain[i].r.y;
    for (int k = 0; k < 20; k++) {
      const block now = advance(e, 1);
      taken += now.taken * m.box[0] * m.box[2], most = fmax(most, fabs(now.q));
    }
    gg_md_next_epoch(e); /* all grains at the present time */
    for (uint32_t i = 0; i < e->n; i++) y += m.mass[gg_md_species_of(&e->grain[i])] * e->grain[i].r.y;
    const double grown = md_energy(e) - before - m.gravity[1] * y;
    print_message("# energy grown %.12g, taken %.12g\n", grown, taken);
    assert_true(most > 0 && fabs(taken) > 1);
    assert_true(fabs(grown + taken) < 1e-9 * before);
    md_destroy(e);
  }
}

static void restored_runs_continue_bit_for_bit(void **state)
{
  (void)state;
  const gg_scene s = dense_scene(1);
  const gg_model m = md_model_of(&s);
  gg_md *straight = md_create(&m, 2);
  gg_archive archive = {0};
  gg_engine *again;
  md_collide(straight, 3000);
  assert_int_equal(gg_md_ops.save(&straight->base, &archive, NULL), GG_OK);
  assert_int_equal(gg_md_ops.restore(&m, &archive, &again, NULL), GG_OK);
  md_collide(straight, 3000);
  md_collide((gg_md *)again, 3000);
  assert_true(md_hash(straight) == md_hash((gg_md *)again));
  gg_base_archive_clear(&archive);
  gg_md_ops.destroy(again);
  md_destroy(straight);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(free_flights_carry_heat_and_stress),
      cmocka_unit_test(walls_of_one_temperature_keep_it),
      cmocka_unit_test(energy_changes_by_what_walls_take),
      cmocka_unit_test(restored_runs_continue_bit_for_bit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
