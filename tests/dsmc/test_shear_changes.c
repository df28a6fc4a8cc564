/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: while the shear rate changes, stops and is reversed on the way, grains that fly freely move by the strain;
 * momentum stays 0 and the balance of energy closes; shear backwards is the mirror image of shear forwards; and a run
 * that is saved on the way continues with the same bits. */
#include "lab.h"

static const double rates[] = {-1, 0, 0.4, -2, 0, 3, -0.05};
enum { RATES = sizeof rates / sizeof *rates, MOST = 2000 };

static void shear(gg_engine *g, double rate)
{
  gg_error err = {0};
  if (gg_dsmc_ops.shear(g, rate, &err) != GG_OK) fail_msg("%s", err.message);
}

static gg_model model(double phi, double e, double beta, int64_t n)
{
  gg_scene s = lab_scene(GG_USF, phi, e, beta, n);
  gg_model m = lab_model(&s);
  m.cuts_steps = true;
  return m;
}

typedef struct velocities {
  int n;
  double c[MOST][3];
} velocities;

static void note(void *context, const gg_chunk *k)
{
  velocities *v = context;
  for (size_t i = 0; i < k->n; i++, v->n++)
    for (int a = 0; a < 3; a++) v->c[v->n][a] = k->c[a][i];
}

/* A gas so thin that nothing collides. */
static void free_flight_is_exact(void **state)
{
  (void)state;
  gg_model m = model(1e-9, 0.9, -1, MOST);
  m.temperature0 = 1;
  gg_engine *g = lab_engine(&m, 1);
  static velocities start, end;
  double strain = 0, most = 0, fastest = 0;
  start.n = end.n = 0;
  gg_dsmc_ops.snapshot(g, false, note, &start);
  const uint64_t before = gg_engine_state_of(g).collisions;
  for (int k = 0; k < 20; k++) {
    shear(g, rates[k % RATES]);
    strain += rates[k % RATES] * lab_advance(g, 0.1 * (1 + 0.3 * k), UINT64_MAX);
  }
  assert_int_equal(gg_engine_state_of(g).collisions, before);
  gg_dsmc_ops.snapshot(g, false, note, &end);
  for (int i = 0; i < MOST; i++) {
    const double *c = start.c[i], *now = end.c[i];
    fastest = fmax(fastest, fabs(c[0]) + fabs(c[1]));
    most = fmax(most, fabs(now[0] - (c[0] - strain * c[1])) + fabs(now[1] - c[1]) + fabs(now[2] - c[2]));
  }
  /* Every change removes the rounding of the mean velocity. */
  if (!(fabs(strain) > 1 && most < 1e-12 * fastest)) fail_msg("strain %g: off by %g of %g", strain, most, fastest);
  gg_dsmc_ops.destroy(g);
}

/* Energy per grain, and the work per grain of shear since the sums were taken, minus what collisions lost. */
static double energy(gg_engine *g, const gg_model *m)
{
  const lab_view v = lab_snapshot(g);
  return 0.5 * (v.cc[0][0] + v.cc[1][1] + v.cc[2][2] + m->inertia[0] * v.ss) / v.n;
}

static double gain_of_collisions(gg_engine *g, const gg_model *m, double *stress_yx)
{
  gg_collision_sums sums;
  gg_dsmc_ops.take_sums(g, &sums);
  *stress_yx = sums.stress[0][1][0] / (double)m->n;
  return -sums.loss[0] / (double)m->n;
}

/* dE = -rate (int C_x C_y dt + sum of collisional transfer) - loss, in every stretch of constant rate: the kinetic part
 * by the trapezium rule over short advances. */
static void work_and_heat_balance(void **state)
{
  (void)state;
  for (int dense = 0; dense < 2; dense++) {
    const gg_model m = model(dense ? 0.3 : 0.02, 0.9, 0.5, 5000);
    gg_engine *g = lab_engine(&m, 3);
    double unused;
    lab_advance(g, 2, UINT64_MAX);
    for (int k = 0; k < RATES; k++) {
      shear(g, rates[k]);
      gain_of_collisions(g, &m, &unused);
      enum { PARTS = 100 };
      const double before = energy(g, &m), dt = 0.3 / PARTS;
      double work = 0, exchanged = 0, stress;
      for (int i = 0; i < PARTS; i++) {
        const lab_view a = lab_snapshot(g);
        lab_advance(g, dt, UINT64_MAX);
        const lab_view b = lab_snapshot(g);
        exchanged += gain_of_collisions(g, &m, &stress);
        work -= rates[k] * (0.5 * dt * (a.cc[0][1] + b.cc[0][1]) / a.n + stress);
        const double p = fabs(b.momentum[0]) + fabs(b.momentum[1]) + fabs(b.momentum[2]);
        assert_true(p < 1e-10 * b.n * sqrt(2 * before));
      }
      const double change = energy(g, &m) - before, size = fabs(work) + fabs(exchanged);
      if (!(fabs(change - work - exchanged) < 0.01 * size && size > 0.01 * before))
        fail_msg("phi %g, rate %g: energy changes by %g, work %g and collisions %g", m.phi, rates[k], change, work,
                 exchanged);
    }
    gg_dsmc_ops.destroy(g);
  }
}

/* Temperature, and P_xy/P_yx, of steady shear with another sign. Two independent runs of each. */
static void backwards_is_the_mirror_image(void **state)
{
  (void)state;
  for (int beta = -1; beta < 1; beta++) {
    gg_model m = model(0.2, 0.8, beta, 4000);
    lab_flow f[2];
    memset(f, 0, sizeof f);
    for (int back = 0; back < 2; back++) {
      gg_engine *g = lab_engine(&m, 5);
      lab_advance(g, 5, UINT64_MAX);
      if (back) shear(g, -1);
      m.shear_rate = back ? -1 : 1;
      lab_average(g, &m, 40, 40, 5, &f[back]);
      gg_dsmc_ops.destroy(g);
    }
    const lab_mean *T[] = {&f[0].T, &f[1].T}, *xy[] = {&f[0].P[0][1], &f[1].P[0][1]};
    const double dT = hypot(lab_error(T[0]), lab_error(T[1])), dxy = hypot(lab_error(xy[0]), lab_error(xy[1]));
    assert_true(dT < 0.01 * lab_value(T[0]) && dxy < 0.015 * fabs(lab_value(xy[0])));
    if (!(fabs(lab_value(T[0]) - lab_value(T[1])) < 4 * dT && fabs(lab_value(xy[0]) + lab_value(xy[1])) < 4 * dxy &&
          lab_value(xy[0]) < 0))
      fail_msg("beta %d: T %g and %g (error %g), P_xy %g and %g (%g)", beta, lab_value(T[0]), lab_value(T[1]), dT,
               lab_value(xy[0]), lab_value(xy[1]), dxy);
  }
}

static double sum_of(gg_engine *g, int from)
{
  static velocities v;
  double sum = 0;
  for (int k = from; k < RATES; k++) shear(g, rates[k]), lab_advance(g, 0.2, UINT64_MAX);
  v.n = 0;
  gg_dsmc_ops.snapshot(g, false, note, &v);
  for (int i = 0; i < v.n; i++) sum += (i + 1) * v.c[i][0] + v.c[i][1];
  return sum;
}

static void a_saved_run_continues(void **state)
{
  (void)state;
  gg_model m = model(0.2, 0.8, 0, MOST);
  gg_engine *g = lab_engine(&m, 7), *again;
  gg_archive archive = {0};
  gg_error err = {0};
  for (int k = 0; k < 4; k++) shear(g, rates[k]), lab_advance(g, 0.3, UINT64_MAX);
  if (gg_dsmc_ops.save(g, &archive, &err) != GG_OK) fail_msg("%s", err.message);
  m.shear_rate = rates[3];
  if (gg_dsmc_ops.restore(&m, &archive, &again, &err) != GG_OK) fail_msg("%s", err.message);
  lab_advance(g, 0.1, UINT64_MAX), lab_advance(again, 0.1, UINT64_MAX);
  assert_true(sum_of(g, 4) == sum_of(again, 4));
  gg_base_archive_clear(&archive);
  gg_dsmc_ops.destroy(g);
  gg_dsmc_ops.destroy(again);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(free_flight_is_exact), cmocka_unit_test(work_and_heat_balance),
                                     cmocka_unit_test(backwards_is_the_mirror_image),
                                     cmocka_unit_test(a_saved_run_continues)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
