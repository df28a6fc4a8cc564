/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, in walled, driven and mixed systems: energy and momentum are balanced over walls, gravity, collisions and
 * grains; in walled shear the stress on walls is that of the bulk; an elastic mixture comes to equal temperatures; the
 * Gaussian thermostat is free cooling in another time, and changes no spin; white noise keeps a gas near its steady
 * temperature; restarts are bit for bit. */
#include <string.h>

#include "md_test.h"
#include "scene/scene.h"

static gg_scene scene(gg_flow flow, int64_t n, double phi, double e, double beta)
{
  return md_scene((md_case){flow, n, phi, e, beta, INFINITY, {0}});
}

static gg_scene mixture(gg_flow flow, int64_t n, double phi, double e, double beta)
{
  gg_scene s = scene(flow, n, phi, e, beta);
  s.n_species = 2;
  s.species[0].fraction = s.species[1].fraction = 0.5;
  s.species[1].diameter = 0.7;
  s.species[1].mass = 0.3;
  return s;
}

static double potential(const gg_md *e, double t)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++)
    sum -=
        e->model.mass[gg_md_species_of(&e->grain[i])] * e->gravity.y * gg_md_position(e, e->falls, &e->grain[i], t).y;
  return sum;
}

static double kinetic(const gg_md *e)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    int k = gg_md_species_of(&e->grain[i]);
    gg_vec v = gg_md_velocity(e, e->falls, &e->grain[i], e->k.now);
    sum += 0.5 * e->model.mass[k] * gg_dot(v, v);
    if (e->spin) sum += 0.5 * e->model.inertia[k] * e->model.mass[k] * gg_dot(e->spin[i], e->spin[i]);
  }
  return sum;
}

static gg_vec total_momentum(const gg_md *e)
{
  gg_vec sum = {0, 0, 0};
  for (uint32_t i = 0; i < e->n; i++)
    sum = gg_axpy(e->model.mass[gg_md_species_of(&e->grain[i])], gg_md_velocity(e, e->falls, &e->grain[i], e->k.now),
                  sum);
  return sum;
}

static double total_mass(const gg_md *e)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++) sum += e->model.mass[gg_md_species_of(&e->grain[i])];
  return sum;
}

/* Work of gravity along x and z. Displacements since the last sample must be shorter than half a box. */
typedef struct work {
  gg_vec last[300]; /* by number of the grain */
  double done;
} work;

static void follow_work(const gg_md *e, work *w)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec r = gg_md_position(e, e->falls, &e->grain[i], e->k.now), dr = gg_sub(r, w->last[e->id[i]]);
    double m = e->model.mass[gg_md_species_of(&e->grain[i])];
    dr.x -= e->box.edge[0] * gg_nearest(dr.x / e->box.edge[0]);
    dr.z -= e->box.edge[2] * gg_nearest(dr.z / e->box.edge[2]);
    w->done += m * (e->gravity.x * dr.x + e->gravity.z * dr.z);
    w->last[e->id[i]] = r;
  }
}

/* The change of momentum is that by gravity and walls; the change of energy is the work of both less the loss. */
static void budgets_close(gg_scene s, uint64_t collisions)
{
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 3);
  gg_collision_sums t;
  work w = {.done = 0};
  gg_vec p0 = total_momentum(e);
  double E0 = kinetic(e) + potential(e, e->k.now), time = 0;
  follow_work(e, &w);
  w.done = 0;
  while (e->k.collisions < collisions) {
    double gone;
    assert_int_equal(gg_md_ops.advance(&e->base, 0.05, collisions - e->k.collisions, &gone, NULL), GG_OK);
    time += gone;
    follow_work(e, &w);
  }
  gg_md_ops.take_sums(&e->base, &t);
  gg_vec p = total_momentum(e);
  double M = total_mass(e), scale = 0;
  const gg_surface_sums walls = gg_sums_of_surfaces(&t);
  for (int k = 0; k < m.n_surfaces; k++)
    for (int a = 0; a < 3; a++) scale += fabs(t.surface[k].impulse[a]) + 1;
  for (int a = 0; a < 3; a++) {
    double gained = gg_along(&p, a) - gg_along(&p0, a), wall = walls.impulse[a];
    double given = M * gg_along(&e->gravity, a) * time;
    if (!(fabs(gained + wall - given) < 1e-10 * (scale + fabs(given))))
      fail_msg("flow %d axis %d: gained %g, walls %g, gravity %g", (int)m.flow, a, gained, wall, given);
  }
  double pushed = w.done;
  for (int k = 0; k < m.n_surfaces; k++) pushed -= m.surface[k].velocity.x * t.surface[k].impulse[0];
  double lost = walls.loss + t.loss[0] + t.loss[1] + t.loss[2], E = kinetic(e) + potential(e, e->k.now);
  if (!(fabs(E - E0 - pushed + lost) < 1e-9 * (lost + E0)))
    fail_msg("flow %d rule %d: energy gained %g, work %g, lost %g", (int)m.flow, (int)m.rule, E - E0, pushed, lost);
  if (!(walls.collisions > 100 && e->k.worst_overlap < 1e-11))
    fail_msg("flow %d rule %d: %g wall contacts, overlap %g", (int)m.flow, (int)m.rule, (double)walls.collisions,
             e->k.worst_overlap);
  md_destroy(e);
}

/* Budgets of Couette flow, Poiseuille flow, chute flow under a lid and with an open top, and Poiseuille flow between
 * ridges, with each rule, one species and two. */
static void budgets_close_in_every_flow(void **state)
{
  (void)state;
  static const gg_flow flows[] = {GG_COUETTE, GG_POISEUILLE, GG_CHUTE, GG_CHUTE, GG_POISEUILLE};
  static const double betas[] = {-1, 0.5, 0.4}, mus[] = {INFINITY, INFINITY, 0.2};
  for (int two = 0; two < 2; two++)
    for (int k = 0; k < 15; k++) {
      int flow = k / 3, rule = k % 3;
      gg_scene s = (two ? mixture : scene)(flows[flow], 200, 0.2, 0.9, betas[rule]);
      for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mus[rule];
      s.walls.beta = 0.3,
      s.walls.mu =
          rule == 2 && flow != 1 ? 0.3 : INFINITY; /* walls on which grains slide would let the whole gas accelerate */
      if (flow > 0) s.gravity[0] = 0.1;
      if (flow == 4) s.walls.ridges = 1.2;
      if (flow == 2 || flow == 3)
        s.gravity[1] = -0.1, s.md.contact_time = 0.01; /* a thin layer slides down, with mostly wall contacts */
      if (flow == 3) s.walls.top = GG_OPEN_TOP;
      budgets_close(s, 20000);
    }
}

/* sum m v_x y and sum m v_y y. Their change is the difference of wall and bulk stress while the flow is not steady. */
static void moments(const gg_md *e, double *xy, double *yy)
{
  *xy = *yy = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    double y = gg_md_position(e, false, &e->grain[i], e->k.now).y - 0.5 * e->box.edge[1];
    *xy += e->grain[i].v.x * y;
    *yy += e->grain[i].v.y * y;
  }
}

/* In walled shear the walls take the momentum that the bulk stress carries across every plane:
 * d/dt sum m v_x y = (kinetic + collisional) - (L_y/2 - d/2)(impulse on the upper - on the lower wall). */
static void check_wall_stress(double beta, double mu)
{
  gg_scene s = scene(GG_COUETTE, 400, 0.3, 0.95, beta);
  s.collision.mu[0] = mu;
  s.walls.e = 0.95, s.walls.beta = 0.5, s.walls.mu = INFINITY;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 3);
  gg_collision_sums t;
  md_collide(e, 400 * 300);
  gg_md_ops.take_sums(&e->base, &t);
  double time = 0, xy = 0, yy = 0, dt, first[2], last[2], arm = 0.5 * m.box[1] - 0.5;
  enum { SAMPLES = 6000 };
  moments(e, &first[0], &first[1]);
  for (int k = 0; k < SAMPLES; k++) {
    assert_int_equal(gg_md_ops.advance(&e->base, 0.02, UINT64_MAX, &dt, NULL), GG_OK);
    time += dt;
    for (uint32_t i = 0; i < e->n; i++) {
      xy += e->grain[i].v.x * e->grain[i].v.y / SAMPLES;
      yy += e->grain[i].v.y * e->grain[i].v.y / SAMPLES;
    }
  }
  gg_md_ops.take_sums(&e->base, &t);
  moments(e, &last[0], &last[1]);
  double wall[2] = {arm * (t.surface[1].impulse[0] - t.surface[0].impulse[0]) / time,
                    arm * (t.surface[1].impulse[1] - t.surface[0].impulse[1]) / time};
  double bulk[2] = {xy + (t.stress[0][1][0] - last[0] + first[0]) / time,
                    yy + (t.stress[0][1][1] - last[1] + first[1]) / time};
  if (!(fabs(wall[0] / bulk[0] - 1) < 0.02) || !(fabs(wall[1] / bulk[1] - 1) < 0.005))
    fail_msg("beta %g: walls: xy %g, yy %g; bulk %g, %g", beta, wall[0], wall[1], bulk[0], bulk[1]);
  if (!(wall[0] < -0.1 * wall[1])) fail_msg("beta %g: no shear: xy %g, yy %g", beta, wall[0], wall[1]);
  md_destroy(e);
}

/* The pressure of an elastic gas at rest on every surface is that of its density in the middle, far from walls
 * (Carnahan & Starling, exact to 10^-4 in so dilute a gas). The temperature is exact, because the energy is kept. */
static void check_pressure(gg_scene s)
{
  enum { BLOCKS = 40, SAMPLES = 200 };
  s.walls.e = 1, s.walls.beta = -1;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 4);
  double area = m.box[0] * m.box[2], sum[GG_MOST_SURFACES] = {0}, squares[GG_MOST_SURFACES] = {0}, mean = 0;
  for (int b = -2; b < BLOCKS; b++) { /* blocks -2 and -1: until it is in equilibrium */
    gg_collision_sums t;
    double middle = 0, time = 0, gone;
    for (int k = 0; k < SAMPLES; k++) {
      assert_int_equal(gg_md_ops.advance(&e->base, 0.7, UINT64_MAX, &gone, NULL), GG_OK);
      time += gone;
      for (uint32_t i = 0; i < e->n; i++)
        middle += fabs(gg_md_position(e, e->falls, &e->grain[i], e->k.now).y / m.box[1] - 0.5) < 0.25;
    }
    gg_md_ops.take_sums(&e->base, &t);
    double n = middle / SAMPLES / (m.volume / 2), phi = M_PI / 6 * n, free = 1 - phi;
    double p = n * m.temperature0 * (1 + phi + phi * phi - phi * phi * phi) / (free * free * free);
    for (int w = 0; b >= 0 && w < m.n_surfaces; w++) {
      double d = m.surface[w].side * t.surface[w].impulse[1] / (area * time) - p;
      sum[w] += d / BLOCKS, squares[w] += d * d / BLOCKS, mean += p / (BLOCKS * m.n_surfaces);
    }
  }
  for (int w = 0; w < m.n_surfaces; w++) {
    double error = sqrt((squares[w] - sum[w] * sum[w]) / (BLOCKS - 1));
    print_message("# %s: %.5f of the pressure too much, error %.5f\n", m.surface[w].title, sum[w] / mean, error / mean);
    assert_true(fabs(sum[w]) < 4 * error && error < 0.01 * mean);
  }
  md_destroy(e);
}

static void walls_feel_the_pressure(void **state)
{
  (void)state;
  gg_scene s = scene(GG_POISEUILLE, 500, 0.05, 1, -1);
  check_pressure(s);
  s.walls.ridges = 2;
  check_pressure(s);
}

/* Grains keep off ridges that are several cells high. */
static void grains_keep_off_high_ridges(void **state)
{
  (void)state;
  gg_scene s = scene(GG_POISEUILLE, 3000, 0.1, 0.9, -1);
  s.walls.ridges = 6;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 9);
  assert_true(e->cells.width[1] < 2);
  for (int k = 0; k < 10; k++) {
    md_collide(e, 2000);
    assert_int_equal(md_misplaced(e), 0);
  }
  md_destroy(e);
}

/* Smooth grains are also driven: rough walls act on their centres. */
static void wall_stress_is_bulk_stress(void **state)
{
  (void)state;
  check_wall_stress(-1, INFINITY);
  check_wall_stress(0, INFINITY);
  check_wall_stress(0.4, 0.2);
}

static double partial_temperature(const gg_md *e, int species)
{
  double sum = 0, n = 0;
  for (uint32_t i = 0; i < e->n; i++)
    if (gg_md_species_of(&e->grain[i]) == species) {
      sum += e->model.mass[species] * gg_dot(e->grain[i].v, e->grain[i].v) / 3;
      n++;
    }
  return sum / n;
}

static void elastic_mixtures_come_to_one_temperature(void **state)
{
  (void)state;
  gg_scene s = mixture(GG_EQUILIBRIUM, 1000, 0.3, 1, -1);
  s.species[0].fraction = 0.3, s.species[1].fraction = 0.7;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 8);
  for (uint32_t i = 0; i < e->n; i++) /* begins far from equal temperatures */
    if (gg_md_species_of(&e->grain[i]) == 0) assert_true(e->model.mass[0] == 1);
  double ratio = 0;
  md_collide(e, 20000);
  for (int k = 0; k < 400; k++) {
    md_collide(e, 1000);
    ratio += partial_temperature(e, 0) / partial_temperature(e, 1) / 400;
  }
  assert_true(fabs(ratio - 1) < 0.02);
  assert_true(fabs(md_energy(e) / (1.5 * (double)m.n * m.temperature0) - 1) < 1e-11);
  md_destroy(e);
}

/* After the same number of collisions the places are those of free cooling, and velocities differ by one factor; in the
 * thermostat's own time the temperature is constant. */
static void gaussian_is_free_cooling(void **state)
{
  (void)state;
  gg_scene free = scene(GG_HCS, 200, 0.2, 0.8, -1), kept = scene(GG_HSS, 200, 0.2, 0.8, -1);
  free.md.contact_time = kept.md.contact_time = 0;
  gg_model mf = md_model_of(&free), mk = md_model_of(&kept);
  gg_md *f = md_create(&mf, 4), *k = md_create(&mk, 4);
  md_collide(f, 600), md_collide(k, 600);
  double factor = k->k.scale * k->grain[0].v.x / f->grain[0].v.x;
  for (uint32_t i = 0; i < f->n; i++) {
    gg_vec a = gg_md_position(f, false, &f->grain[i], f->k.now), b = gg_md_position(k, false, &k->grain[i], k->k.now);
    gg_vec dr = gg_sub(a, b), dv = gg_axpy(-k->k.scale / factor, k->grain[i].v, f->grain[i].v);
    assert_true(gg_dot(dr, dr) < 1e-12 && gg_dot(dv, dv) < 1e-12);
  }
  for (int part = 0; part < 10; part++) {
    gg_error err;
    double gone;
    md_collide(k, 5000);
    assert_int_equal(gg_md_ops.advance(&k->base, 0.37, UINT64_MAX, &gone, &err), GG_OK);
    assert_true(gone == 0.37);
    double T = 2 * md_energy(k) * k->k.scale * k->k.scale / (3 * 200);
    assert_true(fabs(T / mk.temperature0 - 1) < 1e-9);
  }
  md_destroy(f);
  md_destroy(k);
}

typedef struct shown_spins {
  gg_vec s[300];
} shown_spins;

static void show_spins(void *context, const gg_chunk *chunk)
{
  shown_spins *to = context;
  for (size_t k = 0; k < chunk->n; k++) to->s[chunk->id[k]] = (gg_vec){chunk->s[0][k], chunk->s[1][k], chunk->s[2][k]};
}

/* The Gaussian thermostat acts on velocities and not on spins: in its own time a collision changes two spins and no
 * other. The rotational temperature is that of Enskog's equation without a torque (enskog_hermite: 0.293 T). If spins
 * were heated like velocities, it would be that of free cooling, 1.1 T. */
static void gaussian_leaves_spins_alone(void **state)
{
  (void)state;
  gg_scene s = scene(GG_HSS, 300, 0.02, 0.7, 0.2);
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 4);
  shown_spins before, after;
  double ratio = 0;
  md_collide(e, 20000);
  for (int k = 0; k < 300; k++) {
    int changed = 0;
    gg_md_ops.snapshot(&e->base, true, show_spins, &before);
    md_collide(e, 1);
    gg_md_ops.snapshot(&e->base, true, show_spins, &after);
    for (int i = 0; i < 300; i++) changed += memcmp(&before.s[i], &after.s[i], sizeof after.s[i]) != 0;
    assert_true(changed <= 2);
    for (int i = 0; i < 300; i++)
      ratio += m.inertia[0] * gg_dot(after.s[i], after.s[i]) / (3 * 300 * m.temperature0) / 300;
    md_collide(e, 500);
  }
  assert_true(fabs(ratio / 0.293 - 1) < 0.03);
  md_destroy(e);
}

static void white_noise_keeps_warm(void **state)
{
  (void)state;
  gg_scene s = scene(GG_HSS, 1000, 0.05, 0.9, -1);
  s.thermostat = GG_WHITE_NOISE;
  gg_model m = md_model_of(&s);
  gg_md *e = md_create(&m, 4);
  md_collide(e, 20000);
  double T = 0;
  for (int k = 0; k < 100; k++) {
    md_collide(e, 500);
    T += 2 * md_energy(e) / (3 * 1000) / 100;
  }
  gg_vec p = total_momentum(e);
  assert_true(fabs(T / m.temperature0 - 1) < 0.05 && gg_dot(p, p) < 1e-20 * 1000);
  md_destroy(e);
}

/* Whatever the unit of gravity, few grains are in the current bucket of the event queue, which is searched linearly. */
static void buckets_are_small_in_any_unit_of_gravity(void **state)
{
  (void)state;
  for (double g = 1; g < 1e13; g *= 1e4) {
    gg_scene s = scene(GG_CHUTE, 2000, 0.2, 0.7, -1);
    s.gravity[0] = 0.5 * g, s.gravity[1] = -g;
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 1);
    uint32_t most = 0;
    for (int k = 0; k < 50; k++) {
      md_collide(e, 1000);
      most = e->queue.n_due > most ? e->queue.n_due : most;
    }
    if (most > 100) fail_msg("gravity %g: %u grains in a bucket", g, most);
    md_destroy(e);
  }
}

static void restarts_are_bit_for_bit(void **state)
{
  (void)state;
  gg_scene scenes[] = {mixture(GG_USF, 150, 0.2, 0.9, 0),   mixture(GG_COUETTE, 150, 0.2, 0.9, 0),
                       scene(GG_CHUTE, 150, 0.1, 0.9, 0.5), scene(GG_HSS, 150, 0.1, 0.9, -1),
                       scene(GG_HSS, 150, 0.1, 0.9, -1),    scene(GG_CHUTE, 150, 0.1, 0.9, 0.5)};
  scenes[2].gravity[1] = -0.1, scenes[2].walls.top = GG_OPEN_TOP;
  scenes[4].thermostat = GG_WHITE_NOISE;
  scenes[5].gravity[0] = 0.05, scenes[5].gravity[1] = -0.1, scenes[5].walls.ridges = 1;
  for (int k = 0; k < 6; k++) {
    gg_model m = md_model_of(&scenes[k]);
    gg_md *e = md_create(&m, 1), *cut = md_create(&m, 1);
    gg_engine *back = NULL;
    gg_archive a = {0};
    gg_error err;
    md_collide(e, 5000);
    while (cut->k.collisions < 5000) {
      uint64_t left = 5000 - cut->k.collisions;
      assert_int_equal(gg_md_ops.advance(&cut->base, 0.01, left, NULL, &err), GG_OK);
    }
    if (md_hash(e) != md_hash(cut)) fail_msg("scene %d: cutting changes the run", k);
    assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
    assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_OK);
    gg_base_archive_clear(&a);
    md_collide(e, 10000);
    md_collide((gg_md *)back, 10000);
    if (md_hash(e) != md_hash((gg_md *)back)) fail_msg("scene %d: not the same after a restart", k);
    md_destroy(e);
    md_destroy(cut);
    md_destroy((gg_md *)back);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(budgets_close_in_every_flow),
      cmocka_unit_test(wall_stress_is_bulk_stress),
      cmocka_unit_test(walls_feel_the_pressure),
      cmocka_unit_test(grains_keep_off_high_ridges),
      cmocka_unit_test(elastic_mixtures_come_to_one_temperature),
      cmocka_unit_test(gaussian_is_free_cooling),
      cmocka_unit_test(gaussian_leaves_spins_alone),
      cmocka_unit_test(white_noise_keeps_warm),
      cmocka_unit_test(buckets_are_small_in_any_unit_of_gravity),
      cmocka_unit_test(restarts_are_bit_for_bit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
