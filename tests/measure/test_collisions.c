/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The callback for single collisions: its data add up to the engine's own sums, and it changes no trajectory.
 * Planted laws of free flights and angles are recovered. An elastic gas has the free times and paths of the kinetic
 * theory of gases, point by point; in sheared gases collisions are most frequent in the compressing quadrants,
 * equally in both engines. */
#include "curve_test.h"
#include "graingas.h"
#include "measure/free_flight.h"
#include "scene/model_of_scene.h"

typedef struct sums {
  gg_collision_sums by_hand;
  const gg_model *model;
  uint64_t flights;
  double flown; /* sum of `since` */
} sums;

static void add(void *context, const gg_collision_record *m)
{
  sums *s = context;
  int a = m->species[0], b = m->species[1], pair = gg_pair(a, b);
  double mr = 1 / (1 / s->model->mass[a] + 1 / s->model->mass[b]), gn = gg_dot(m->k, m->c12);
  const double k[3] = {m->k.x, m->k.y, m->k.z};
  assert_true(gn > 0 && fabs(gg_dot(m->k, m->k) - 1) < 1e-12);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      s->by_hand.stress[pair][i][j] += s->model->sigma[gg_pair(a, b)] * k[i] * k[j] * mr * 1.9 * gn;
  s->by_hand.loss[pair] += 0.5 * mr * (1 - 0.81) * gn * gn;
  s->by_hand.collisions[pair]++;
  for (int i = 0; i < 2; i++)
    if (m->since[i] < INFINITY) s->flights++, s->flown += m->since[i];
}

static gg_scene sheared(gg_engine_kind engine, int species, double phi)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine, s.phi = phi, s.n_species = species;
  s.particles = 500, s.dsmc.particles = 2000, s.md.contact_time = 0; /* a contact time would make some elastic */
  if (species == 2) s.species[0] = (gg_species){0.6, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.4, 1.5, 3, 0.4, 1, 0};
  return s;
}

static void whole_velocity(void *context, const gg_chunk *c)
{
  double *sum = context;
  for (size_t i = 0; i < c->n; i++) *sum += c->c[0][i] * (double)(i + 1) + c->c[1][i];
}

/* Smooth grains, e = 0.9: impulse and loss computed by hand from each collision equal the engine's sums; every
 * collision ends two flights; md moves to the last bit as without a callback. */
static void adds_up(void **state)
{
  (void)state;
  for (int kind = 0; kind < 4; kind++) {
    gg_engine_kind which = kind / 2 ? GG_DSMC : GG_MD;
    gg_scene s = sheared(which, 1 + kind % 2, 0.2);
    gg_model m;
    gg_engine *e[2];
    gg_collision_sums t;
    double gone, velocity[2] = {0, 0};
    assert_int_equal(gg_scene_model_make(&s, which, &m, NULL), GG_OK);
    sums shown = {.model = &m};
    const gg_engine_ops *ops = gg_common_engine_of(which);
    for (int k = 0; k < 2; k++) {
      assert_int_equal(ops->create(&m, 5, 0, &e[k], NULL), GG_OK);
      if (k) assert_int_equal(ops->set_callback(e[k], add, &shown, NULL), GG_OK);
      for (int i = 0; i < 7; i++) assert_int_equal(ops->advance(e[k], 1.0, UINT64_MAX, &gone, NULL), GG_OK);
      ops->take_sums(e[k], &t);
      ops->snapshot(e[k], false, whole_velocity, &velocity[k]);
    }
    if (which == GG_MD) assert_true(velocity[0] == velocity[1]);
    for (int p = 0; p < gg_pairs_of(m.n_species); p++) {
      const gg_collision_sums *h = &shown.by_hand;
      assert_int_equal(h->collisions[p], t.collisions[p]);
      assert_true(fabs(h->loss[p] / t.loss[p] - 1) < 1e-9);
      for (int a = 0; a < 9; a++) { /* components that vanish by symmetry of the flow are not summed */
        bool there = a / 3 == a % 3 || a == 1 || a == 3;
        double by_hand = there ? h->stress[p][a / 3][a % 3] : 0;
        assert_true(fabs(by_hand - t.stress[p][a / 3][a % 3]) < 1e-9 * t.stress[p][0][0]);
      }
    }
    uint64_t met = 0; /* every collision ends a flight of both grains, but for each grain's first */
    for (int p = 0; p < GG_PAIRS; p++) met += 2 * t.collisions[p];
    assert_int_equal(shown.flights, met - (uint64_t)m.n);
    assert_true(shown.flown > 0 && shown.flown < 7 * (double)m.n);
    for (int k = 0; k < 2; k++) ops->destroy(e[k]);
  }
}

/* Curves of the observable for planted collisions. */
static gg_curves fed(const gg_model *m, int samples, int per_sample, void (*make)(gg_collision_record *m, gg_rng *r))
{
  gg_bins bins;
  gg_rng r = gg_common_rng_seed(32, 0);
  void *self = gg_measure_collisions.create(m, NULL);
  assert_int_equal(gg_statistics_bins_init(&bins, gg_measure_collisions.curves->bins(self), NULL), GG_OK);
  for (int k = 0; k < samples; k++) {
    for (int i = 0; i < per_sample; i++) {
      gg_collision_record collision = {.height = {NAN, NAN}};
      make(&collision, &r);
      gg_measure_collisions.collisions->add(self, &collision);
    }
    gg_measure_collisions.curves->add_snapshot(self, NULL, gg_statistics_bins_sample(&bins));
    gg_statistics_bins_commit(&bins);
  }
  const gg_bins *list[] = {&bins};
  gg_curves curves = {.model = m};
  assert_int_equal(
      gg_measure_curves_estimate(list, 1, gg_measure_collisions.curves->of_bins, self, "collisions", 0, &curves, NULL),
      GG_OK);
  gg_statistics_bins_clear(&bins);
  gg_measure_collisions.destroy(self);
  return curves;
}

enum { RATE = 3 }; /* of flights; density of k in the plane 1 - sin(2 theta)/2; |C| = 2 without shear */
static void planted(gg_collision_record *m, gg_rng *r)
{
  double angle;
  do angle = M_PI * gg_rng_uniform(r);
  while (1.5 * gg_rng_uniform(r) > 1 - 0.5 * sin(2 * angle));
  if (gg_rng_uniform(r) < 0.5) angle += M_PI;
  m->k = (gg_vec){cos(angle), sin(angle), 0};
  m->c12 = gg_axpy(sqrt(1 / gg_rng_uniform(r) - 1), (gg_vec){0, 0, 1}, m->k); /* cos^2 uniform */
  for (int i = 0; i < 2; i++) {
    m->c[i] = gg_scale(2, gg_rng_direction(r));
    m->since[i] = -log(1 - gg_rng_uniform(r)) / RATE;
    m->height[i] = 2;
  }
}

static double exponential(double x, const void *context)
{
  double mean = *(const double *)context;
  return exp(-x / mean) / mean;
}
static double twice(double x, const void *context)
{
  (void)context;
  return 2 * x;
}
static double quadrants(double x, const void *context)
{
  (void)context;
  return 1 - 0.5 * sin(2 * M_PI * x) * sin(M_PI / 72) / (M_PI / 72);
}

static void flights_and_angles(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_EQUILIBRIUM, 0.1, -1, 1000, 1);
  gg_curves list = fed(&m, 64, 20000, planted);
  double time = 1.0 / RATE, path = 2 * time;
  gg_curve_number p = ct_number(ct_find(&list, "free_time"), "mean_free_time");
  ct_expect("mean free time", p.value, p.error, time, 0.01 * time);
  p = ct_number(ct_find(&list, "free_time"), "second_moment_over_mean_squared");
  ct_expect("dispersion", p.value, p.error, 2, 0.03);
  p = ct_number(ct_find(&list, "free_path"), "mean_free_path");
  ct_expect("mean free path", p.value, p.error, path, 0.01 * path);
  p = ct_number(ct_find(&list, "free_path"), "knudsen");
  ct_expect("Knudsen number", p.value, p.error, path / cbrt(m.volume), 0.01 * path / cbrt(m.volume));
  p = ct_number(ct_find(&list, "collision_angle"), "fabric_xy");
  ct_expect("fabric", p.value, p.error, -0.125, 0.003); /* int sin cos (1 - sin 2t/2)/pi */
  assert_true(ct_chi2(ct_find(&list, "free_time"), 40, 200, exponential, &time) < 1.5);
  assert_true(ct_chi2(ct_find(&list, "free_path"), 40, 200, exponential, &path) < 1.5);
  assert_true(ct_chi2(ct_find(&list, "impact_cos"), 0, 50, twice, NULL) < 2.2);
  assert_true(ct_chi2(ct_find(&list, "collision_angle"), 0, 72, quadrants, NULL) < 1.6);
  gg_measure_curves_clear(&list);
}

static void falling_behind(gg_collision_record *m, gg_rng *r)
{
  planted(m, r);
  for (int i = 0; i < 2; i++) m->c[i] = (gg_vec){0, 1.5, 0}, m->since[i] = 2;
}

/* Under shear, rate 0.7, of C = (0, 1.5, 0) at the collision: the peculiar path of 2 units of time is the integral of
 * 1.5 sqrt(1 + (0.7 s)^2), the laboratory's 2 sqrt(1.5^2 + (0.7 height)^2). */
static void sheared_paths(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.1, -1, 1000, 1);
  m.shear_rate = 0.7;
  gg_curves list = fed(&m, 16, 500, falling_behind);
  double end = 0.7 * 2, path = 1.5 / 0.7 * 0.5 * (end * sqrt(1 + end * end) + asinh(end));
  double found = ct_number(ct_find(&list, "free_path"), "mean_free_path").value;
  assert_true(fabs(found / path - 1) < 1e-5);
  found = ct_number(ct_find(&list, "free_path_laboratory"), "mean_free_path_laboratory").value;
  assert_true(fabs(found / (2 * hypot(1.5, 0.7 * 2)) - 1) < 1e-12);
  gg_measure_curves_clear(&list);
}

/* Collision rate of a grain of speed x sqrt(2T) among Maxwellian ones (Chapman & Cowling, 5.4), over n d^2 sqrt(2 pi
 * T). */
static double rate_at(double x)
{
  return x < 1e-6 ? 2 : exp(-x * x) + (2 * x + 1 / x) * 0.5 * sqrt(M_PI) * erf(x);
}

typedef struct gas {
  double scale; /* n d^2 chi sqrt(2 pi T) */
  double speed; /* sqrt(2T); 0: times */
} gas;

/* Times, or paths, between collisions: grains of speed v collide nu(v) f(v) times, after exp(-nu t). */
static double law(double at, const void *context)
{
  const gas *g = context;
  double unit = g->speed > 0 ? g->speed / g->scale : 1 / g->scale, step = 0.01, top = 0, all = 0;
  for (double x = step / 2; x < 6; x += step) {
    double f = x * x * exp(-x * x) * rate_at(x), fall = (g->speed > 0 ? rate_at(x) / x : rate_at(x)) / unit;
    all += f;
    top += f * fall * exp(-fall * at);
  }
  return top / all;
}

/* The laws of the curves are those above, for the mean that they are given; they are densities with that mean. */
static void laws_beside(void **state)
{
  (void)state;
  const gas times = {2.5, 0}, paths = {2.5, 0.7};
  double time = 1 / (2.5 * 2 * M_SQRT2), path = 0.7 / (2.5 * M_SQRT2 * sqrt(M_PI)), sum[2][2] = {{0}}, step = 0.001;
  gg_model like = ct_model(GG_EQUILIBRIUM, 0.1, -1, 1000, 1);
  double of_times[GG_FLIGHT_LAW], of_paths[GG_FLIGHT_LAW];
  gg_measure_free_flight_of(&like, 0, of_times), gg_measure_free_flight_of(&like, 0, of_paths);
  for (double x = step / 2; x < 40; x += step) {
    of_times[GG_FLIGHT_MEAN] = time, of_paths[GG_FLIGHT_MEAN] = path;
    double p[2] = {gg_measure_free_time_law(x * time, of_times), gg_measure_free_path_law(x * path, of_paths)};
    for (int k = 0; k < 2; k++)
      sum[k][0] += p[k] * (k ? path : time) * step, sum[k][1] += p[k] * x * (k ? path : time) * step;
    if (x > 0.3 && x < 0.3 + step) {
      assert_true(fabs(p[0] / law(x * time, &times) - 1) < 1e-9);
      assert_true(fabs(p[1] / law(x * path, &paths) - 1) < 1e-4);
    }
  }
  for (int k = 0; k < 4; k++) assert_true(fabs(sum[k / 2][k % 2] - 1) < 2e-4);
}

/* Collisions a grain of a Monte Carlo run: twenty bursts in which collisions are observed. */
enum { EPISODES = 40000 };

/* Error of the mean free time times the collision rate: md observes all collisions, and misses the flights at both
 * ends of the window; dsmc observes some collisions. */
static double error_of(int kind, gg_curve_number time, double product)
{
  return kind == GG_MD ? 0.0005 : time.error / time.value * product;
}

static void kinetic_theory(void **state)
{
  (void)state;
  for (int kind = GG_MD; kind <= GG_DSMC; kind++) {
    gg_scene s = sheared((gg_engine_kind)kind, 1, kind == GG_MD ? 0.005 : 0.1);
    s.flow = GG_EQUILIBRIUM, s.collision.e[0] = 1;
    s.run.collisions = kind == GG_MD ? 1000 : EPISODES, s.run.warmup = 20;
    s.measure |= GG_MEASURE_COLLISIONS;
    gg_result *r = ct_run(s);
    double T = 0.5, n = r->model.density * r->model.chi[0];
    const gas times = {n * sqrt(2 * M_PI * T), 0}, paths = {n * sqrt(2 * M_PI * T), sqrt(2 * T)};
    gg_curve_number p = ct_number(ct_find(&r->curves, "free_path"), "mean_free_path");
    /* a finite gas of fixed energy: (1 + 1/N) or so */
    double l = 1 / (M_SQRT2 * M_PI * n), slack = 2.0 / (double)r->model.n;
    ct_expect("mean free path", p.value, hypot(p.error, slack * l), l, 0.02 * l);
    p = ct_number(ct_find(&r->curves, "free_time"), "mean_free_time");
    double t = 1 / (4 * n * sqrt(M_PI * T));
    ct_expect("mean free time", p.value, hypot(p.error, slack * t), t, 0.02 * t);
    assert_true(ct_chi2(ct_find(&r->curves, "free_time"), 50, 210, law, &times) < 1.6);
    assert_true(ct_chi2(ct_find(&r->curves, "free_path"), 50, 210, law, &paths) < 1.6);
    assert_true(ct_chi2(ct_find(&r->curves, "impact_cos"), 0, 50, twice, NULL) < 2.2);
    gg_result_free(r);
  }
}

/* The law of a curve, at its points. */
static double beside(double x, const void *context)
{
  const gg_curve *c = context;
  size_t i = 0;
  while (i + 1 < c->n && c->x[i] < x) i++;
  return c->reference[i];
}

/* Large light grains, and a tenth of small heavy ones that collide a quarter as often: in equilibrium flights of
 * either are those of kinetic theory, with separate means and laws, also if collisions are observed in bursts. */
static void unlike_grains(void **state)
{
  (void)state;
  gg_scene s = sheared(GG_DSMC, 2, 0.05);
  s.species[0] = (gg_species){0.9, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.1, 0.2, 100, 0.4, 1, 0};
  s.flow = GG_EQUILIBRIUM, s.run.collisions = 12000, s.run.warmup = 100, s.measure |= GG_MEASURE_COLLISIONS;
  s.dsmc.time_step = 0.02; /* within a step pairs of species collide one after the other */
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
  gg_result *r = ct_run(s);
  for (int i = 0; i < 2; i++) {
    const gg_curve *time = ct_find(&r->curves, i ? "free_time_2" : "free_time_1");
    const gg_curve *path = ct_find(&r->curves, i ? "free_path_2" : "free_path_1");
    double t = 1 / gg_common_model_species_rate(&r->model, i, 0.5), l = t * sqrt(4 / M_PI / r->model.mass[i]);
    gg_curve_number p = ct_number(time, "mean_free_time");
    ct_expect("mean free time", p.value, hypot(p.error, 0.001 * t), t, 0.03 * t);
    p = ct_number(path, "mean_free_path");
    ct_expect("mean free path", p.value, hypot(p.error, 0.001 * l), l, 0.03 * l);
    assert_true(ct_chi2(time, 50, 210, beside, time) < 1.6);
    assert_true(ct_chi2(path, 50, 210, beside, path) < 1.6);
  }
  gg_result_free(r);
}

/* Sheared, phi = 0.01, e = 0.8: grains collide where the flow compresses the gas (k_x k_y < 0), equally often in
 * both engines, and mean free time times collision rate is one. */
static void sheared_engines(void **state)
{
  (void)state;
  gg_curve_number xy[2];
  for (int kind = GG_MD; kind <= GG_DSMC; kind++) {
    gg_scene s = sheared((gg_engine_kind)kind, 1, 0.01);
    s.collision.e[0] = 0.8, s.run.collisions = kind == GG_MD ? 600 : EPISODES, s.measure |= GG_MEASURE_COLLISIONS;
    gg_result *r = ct_run(s);
    xy[kind] = ct_number(ct_find(&r->curves, "collision_angle"), "fabric_xy");
    gg_curve_number t = ct_number(ct_find(&r->curves, "free_time"), "mean_free_time");
    double product = t.value * r->value[GG_Q_COLLISION_RATE].mean;
    ct_expect("mean free time x collision rate", product, error_of(kind, t, product), 1, 0.02);
    gg_result_free(r);
  }
  double error = hypot(xy[0].error, xy[1].error);
  ct_expect("fabric, md - dsmc", xy[0].value - xy[1].value, error, 0, 0.01);
  assert_true(xy[0].value < -0.03);
}

/* Sweeps of the shear rate rescale all velocities repeatedly: paths are still those of the gas. */
static void rescaled_velocities_keep_paths(void **state)
{
  (void)state;
  gg_scene s = sheared(GG_DSMC, 1, 0.1);
  s.flow = GG_SMALL_SHEAR, s.collision.e[0] = 0.8, s.run.collisions = 4000, s.measure |= GG_MEASURE_COLLISIONS;
  gg_result *r = ct_run(s);
  gg_curve_number p = ct_number(ct_find(&r->curves, "free_path"), "mean_free_path");
  double l = gg_common_model_collision_rate(&r->model, 0.5), maxwellian = sqrt(4 / M_PI) / l;
  ct_expect("mean free path, swept", p.value, hypot(p.error, 0.003 * maxwellian), maxwellian, 0.03 * maxwellian);
  p = ct_number(ct_find(&r->curves, "free_path"), "second_moment_over_mean_squared");
  ct_expect("second moment", p.value, p.error, 2.15, 0.1); /* of the cooling gas, whose speeds are more spread */
  gg_result_free(r);
}

/* Heated gases: times in both engines if kicks heat them (dsmc nightly); with the Gaussian thermostat, in dsmc alone.
 * No paths. */
static void heated_gases_have_times_but_no_paths(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++) {
    if (k == 1 && !getenv("NIGHTLY")) continue;
    gg_engine_kind kind = k % 2 ? GG_DSMC : GG_MD;
    gg_scene s = sheared(kind, 1, 0.05);
    s.flow = GG_HSS, s.thermostat = k / 2 ? GG_GAUSSIAN : GG_WHITE_NOISE;
    s.collision.e[0] = 0.8, s.run.collisions = kind == GG_MD ? 400 : EPISODES, s.measure |= GG_MEASURE_COLLISIONS;
    gg_result *r = ct_run(s);
    bool times = false;
    for (int c = 0; c < r->curves.n; c++) {
      assert_null(strstr(r->curves.curve[c].name, "free_path"));
      times |= strcmp(r->curves.curve[c].name, "free_time") == 0;
    }
    assert_true(times == (k != 2));
    if (times) {
      gg_curve_number t = ct_number(ct_find(&r->curves, "free_time"), "mean_free_time");
      double product = t.value * r->value[GG_Q_COLLISION_RATE].mean;
      ct_expect("mean free time x collision rate", product, error_of(kind, t, product), 1, 0.02);
    }
    gg_result_free(r);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(laws_beside),
      cmocka_unit_test(heated_gases_have_times_but_no_paths),
      cmocka_unit_test(adds_up),
      cmocka_unit_test(flights_and_angles),
      cmocka_unit_test(sheared_paths),
      cmocka_unit_test(kinetic_theory),
      cmocka_unit_test(sheared_engines),
      cmocka_unit_test(unlike_grains),
      cmocka_unit_test(rescaled_velocities_keep_paths),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
