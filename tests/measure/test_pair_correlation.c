/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs in sheared boxes against a search through every image; sampled pairs against all of them; g = 1 for randomly
 * placed points; planted collisions have the density at contact from which they were drawn, also in a cooling gas.
 * Hard spheres in equilibrium have the contact value of the equation of state: from collisions, next to contact, and
 * from the rate. For inelastic grains the density of separating pairs is 1/e times that of approaching ones, in
 * space, too. */
#include "curve_test.h"
#include "measure/pairs.h"
#include "scene/model_of_scene.h"
#include "graingas.h"

static void thrown(gg_snapshot *s, gg_rng *r, int sample)
{
  s->offset = s->model->box[0] * gg_rng_uniform(r);
  s->time = sample, s->collisions = (uint64_t)(1000 * sample);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      s->r[a][i] = s->model->box[a] * gg_rng_uniform(r);
      s->c[a][i] = gg_common_rng_normal(r);
    }
}

enum { SHELLS = 6 };
typedef struct tally {
  const gg_pairs *p;                                         /* NULL: grains are not renumbered */
  double pairs, squares, checks, tried, shell[SHELLS], bent; /* bent: sum of d_x d_y over |d|^2 */
  double reach;
} tally;

static void add_grains(tally *t, size_t i, size_t j, gg_vec d, double square, double weight)
{
  t->tried++, t->pairs += weight, t->squares += weight * square, t->checks += weight * square * (double)(i * j);
  t->shell[(int)(SHELLS * sqrt(square) / t->reach)] += weight;
  t->bent += weight * d.x * d.y / square;
}

static void add(void *context, uint32_t one, uint32_t two, gg_vec d, double square, double weight)
{
  tally *t = context;
  add_grains(t, t->p->grain[one], t->p->grain[two], d, square, weight);
}

static tally searched(gg_pairs *p, const gg_snapshot *s)
{
  tally t = {.p = p, .reach = p->reach};
  gg_images box = gg_measure_pairs_images(s);
  gg_measure_pairs_sort(p, s, &box);
  gg_pairs_each(p, s, &box, add, &t);
  return t;
}

/* Search through every image within two boxes. */
static tally plain(const gg_snapshot *s, double reach)
{
  tally t = {.reach = reach};
  const double *L = s->model->box;
  for (size_t i = 0; i < s->n; i++)
    for (size_t j = i + 1; j < s->n; j++)
      for (int x = -2; x <= 2; x++)
        for (int y = -1; y <= 1; y++)
          for (int z = -1; z <= 1; z++) {
            gg_vec d = {s->r[0][j] - s->r[0][i] + x * L[0] + y * s->offset, s->r[1][j] - s->r[1][i] + y * L[1],
                        s->r[2][j] - s->r[2][i] + z * L[2]};
            if (gg_dot(d, d) < reach * reach) add_grains(&t, i, j, d, gg_dot(d, d), 1);
          }
  return t;
}

/* Cells, also few in a small box, find the pairs of the plain search: offsets over the whole range, cubes and long
 * boxes. */
static void pairs_of_images(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(50, 0);
  for (int k = 0; k < 40; k++) {
    gg_scene scene = gg_scene_defaults();
    scene.phi = 0.2, scene.particles = 300;
    if (k % 2) scene.aspect[k % 3] = 1.7;
    gg_model m;
    assert_int_equal(gg_scene_model_make(&scene, GG_MD, &m, NULL), GG_OK);
    double reach = (k % 4 < 2 ? 0.35 : 1) * gg_measure_pairs_longest_reach(&m);
    gg_snapshot s;
    gg_pairs p;
    assert_int_equal(gg_measure_snapshot_init(&s, &m, true, NULL), GG_OK);
    assert_int_equal(gg_measure_pairs_init(&p, &m, reach, INFINITY, 2, NULL), GG_OK);
    thrown(&s, &r, k);
    tally fast = searched(&p, &s), slow = plain(&s, reach);
    assert_true(slow.pairs > 100 && fast.pairs == slow.pairs);
    assert_true(fabs(fast.squares / slow.squares - 1) < 1e-9 && fabs(fast.checks / slow.checks - 1) < 1e-9);
    gg_measure_pairs_clear(&p);
    gg_measure_snapshot_clear(&s);
  }
}

/* The mean is right within four errors, by the scatter of the samples. */
static void expect_mean(const char *what, double sum, double squares, double n, double expected, double sight)
{
  double mean = sum / n, error = sqrt((squares / n - mean * mean) / (n - 1));
  print_message("# %-10s %.6g +- %.2g, all pairs: %.6g\n", what, mean, error, expected);
  assert_true(fabs(mean - expected) <= 4 * error + 1e-9 * fabs(expected));
  assert_true(error < sight);
}

/* Pairs within a budget represent all pairs, near and far, in all directions; the same snapshot draws the same ones,
 * another one others. Cubes and long boxes, the image above displaced. */
static void sampled_pairs(void **state)
{
  (void)state;
  enum { DRAWS = 200, BUDGET = 60 };
  gg_rng r = gg_common_rng_seed(54, 0);
  for (int k = 0; k < 4; k++) {
    gg_scene scene = gg_scene_defaults();
    scene.phi = 0.2, scene.particles = 1500;
    if (k) scene.aspect[k - 1] = 1.7;
    gg_model m;
    assert_int_equal(gg_scene_model_make(&scene, GG_MD, &m, NULL), GG_OK);
    double reach = gg_measure_pairs_longest_reach(&m), sum[SHELLS + 1] = {0}, squares[SHELLS + 1] = {0};
    gg_snapshot s;
    gg_pairs p;
    assert_int_equal(gg_measure_snapshot_init(&s, &m, true, NULL), GG_OK);
    assert_int_equal(gg_measure_pairs_init(&p, &m, reach, BUDGET, 2 + k % 3, NULL), GG_OK);
    thrown(&s, &r, k);
    tally all = plain(&s, reach), again = searched(&p, &s);
    assert_true(again.pairs == searched(&p, &s).pairs);
    for (int i = 0; i < DRAWS; i++) {
      s.time = i + 0.5;
      tally t = searched(&p, &s);
      assert_true(t.tried <= 1.1 * BUDGET * (double)s.n && t.tried < 0.5 * all.pairs);
      for (int j = 0; j < SHELLS; j++) sum[j] += t.shell[j], squares[j] += t.shell[j] * t.shell[j];
      sum[SHELLS] += t.bent, squares[SHELLS] += t.bent * t.bent;
      assert_true(t.pairs != again.pairs);
    }
    for (int j = 0; j < SHELLS; j++)
      expect_mean("shell", sum[j], squares[j], DRAWS, all.shell[j], 0.005 * all.shell[j]);
    expect_mean("direction", sum[SHELLS], squares[SHELLS], DRAWS, all.bent, 0.001 * all.pairs);
    gg_measure_pairs_clear(&p);
    gg_measure_snapshot_clear(&s);
  }
}

static double one(double x, const void *context)
{
  (void)x, (void)context;
  return 1;
}

/* Few points: no grain is its own partner. */
static void few_points(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.02, -1, 12, 1);
  gg_curves list = ct_curves(&gg_measure_pair_correlation, &m, 30000, thrown, 52);
  double sum = 0, weight = 0;
  for (size_t k = 0; k < list.curve->n; k++) {
    const double shell = list.curve->x[k] * list.curve->x[k];
    sum += shell * list.curve->value[k], weight += shell;
  }
  print_message("# %zu bins, mean %g\n", list.curve->n, sum / weight);
  assert_true(fabs(sum / weight - 1) < 0.02); /* 1/12 off by a pair with itself */
  gg_measure_curves_clear(&list);
}

/* Randomly placed points: g_11 = g_12 = g_22 = 1 at every distance; and the rate planted with them. */
static void ideal_gas(void **state)
{
  (void)state;
  for (int species = 1; species <= 2; species++) {
    gg_model m = ct_model(GG_USF, 0.1, -1, 2000, species);
    gg_curves list = ct_curves(&gg_measure_pair_correlation, &m, 64, thrown, 51);
    assert_int_equal(list.n, species == 1 ? 1 : 3);
    for (int k = 0; k < list.n; k++) {
      const gg_curve *c = &list.curve[k];
      double chi2 = ct_chi2(c, 0, c->n, one, NULL);
      assert_true(chi2 > 0.6 && chi2 < 1.7);
      assert_true(c->error[c->n - 1] < 0.05);
      if (species == 2) continue;
      gg_curve_number p = ct_number(c, "contact_value_of_rate");
      ct_expect("contact value of the rate", p.value, p.error, 1.0 / (4 * m.density * sqrt(M_PI)), 0.01);
    }
    gg_measure_curves_clear(&list);
  }
}

/* Hard spheres at phi = 0.3: (Z - 1)/(4 phi) with Z of Pieprzyk et al., Phys. Chem. Chem. Phys. 21 (2019) 6886. */
static void hard_spheres(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = 0.3, s.particles = 2000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
  s.run.collisions = 3000;
  s.measure |= GG_MEASURE_PAIR_CORRELATION;
  gg_result *r = ct_run(s);
  const gg_curve *c = ct_find(&r->curves, "pair_correlation");
  double chi = (3.983983 - 1) / (4 * 0.3);
  gg_curve_number p = ct_number(c, "contact_value");
  ct_expect("g at contact", p.value, p.error, chi, 0.03);
  double slope = (c->value[1] - c->value[0]) / (c->x[1] - c->x[0]), nearest = c->value[0] + slope * (1 - c->x[0]);
  print_message("# by the nearest two bins %.4f\n", nearest);
  assert_true(fabs(nearest - chi) < 0.04);
  p = ct_number(c, "contact_value_of_rate");
  ct_expect("g of the collision rate", p.value, p.error, chi, 0.03);
  gg_result_free(r);
}

/* Collisions of Maxwellians: g_n is drawn by g_n exp(-g_n^2/(2 s^2)), s^2 = 2 T, at the rate 4 pi n chi s/sqrt(2 pi)
 * of a pair; velocities fall as 1/(1 + t) in a cooling gas, and are rescaled in between as in a run. */
enum { INTERVALS = 4000, EVERY = 5, PER_INTERVAL = 400 };
static const double planted_chi = 1.7, planted_e = 0.6;

static gg_collision_record planted(double speed, gg_rng *r)
{
  double g = speed * sqrt(-2 * log(1 - gg_rng_uniform(r)));
  gg_collision_record c = {.k = gg_rng_direction(r)};
  c.c12 = gg_scale(g, c.k);
  c.J = gg_scale(0.5 * (1 + planted_e) * g, c.k);
  return c;
}

static void all_at(gg_snapshot *s, double T)
{
  for (int a = 0; a < 3; a++)
    for (size_t i = 0; i < s->n; i++) s->c[a][i] = sqrt(T) * (i % 2 ? 1 : -1);
}

/* T = v^2; the interval takes PER_INTERVAL collisions on average; `fall`: decrease of the speed. */
static double show_interval(void *self, const gg_model *m, double v, double fall, gg_rng *r)
{
  const gg_observable *o = &gg_measure_pair_correlation;
  double pairs = 0.5 * (double)m->n * (double)(m->n - 1) / m->volume;
  double rate = pairs * 4 * M_PI * planted_chi * v * sqrt(2 / (2 * M_PI)), ends = (1 / fall - 1) / rate * PER_INTERVAL;
  double elapsed = fall < 1 ? ends / log(1 / fall) : PER_INTERVAL / rate;
  for (int i = 0; i < PER_INTERVAL; i++) {
    gg_collision_record c = planted(M_SQRT2 * v * pow(fall, (i + gg_rng_uniform(r)) / PER_INTERVAL), r);
    o->collisions->add(self, &c);
  }
  return elapsed;
}

static gg_curves planted_curves(const gg_model *m, double fall)
{
  const gg_observable *o = &gg_measure_pair_correlation;
  gg_snapshot s;
  gg_bins bins;
  gg_rng r = gg_common_rng_seed(52, 0);
  void *self = o->create(m, NULL);
  double v = 1;
  assert_int_equal(gg_measure_snapshot_init(&s, m, true, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_init(&bins, o->curves->bins(self), NULL), GG_OK);
  thrown(&s, &r, 1);
  o->restart(self);
  for (int k = 0; k < INTERVALS; k++) {
    gg_interval in = {.model = m, .elapsed = show_interval(self, m, v, fall, &r)};
    v *= fall;
    if (k % EVERY == 0) {
      all_at(&s, v * v);
      o->curves->add_snapshot(self, &s, gg_statistics_bins_sample(&bins));
      gg_statistics_bins_commit(&bins);
    }
    o->curves->add_interval(self, &in);
    if (v < 0.25) v *= 4, o->rescaled(self, 4);
  }
  const gg_bins *list[] = {&bins};
  gg_curves curves = {.model = m};
  assert_int_equal(gg_measure_curves_estimate(list, 1, o->curves->of_bins, self, o->name, 0, &curves, NULL), GG_OK);
  gg_statistics_bins_clear(&bins);
  gg_measure_snapshot_clear(&s);
  o->destroy(self);
  return curves;
}

static void planted_collisions(void **state)
{
  (void)state;
  for (int cools = 0; cools < 2; cools++) {
    gg_model m = ct_model(GG_USF, 0.1, -1, 100, 1);
    gg_curves list = planted_curves(&m, cools ? 0.9 : 1);
    const gg_curve *c = ct_find(&list, "pair_correlation");
    gg_curve_number before = ct_number(c, "contact_value_before"), after = ct_number(c, "contact_value_after");
    gg_curve_number speed = ct_number(c, "approach_speed");
    ct_expect("approaching", before.value, before.error, planted_chi, 0.02);
    ct_expect("separating", after.value, after.error, planted_chi / planted_e, 0.03);
    ct_expect("approach speed", speed.value, speed.error, 1, 0.01);
    gg_measure_curves_clear(&list);
  }
}

/* Sheared inelastic grains: separating over approaching is 1/e, at any spins, and the rate with the measured speed
 * is that of approaching pairs. Colliding grains are slower than Maxwellians of their temperature. */
static void separating_pairs_are_denser_by_1_over_e(void **state)
{
  (void)state;
  for (int rough = 0; rough < 2; rough++) {
    gg_scene s = gg_scene_defaults();
    s.engine = GG_MD, s.flow = GG_USF, s.phi = rough ? 0.1 : 0.03, s.particles = 1000;
    double e = rough ? 0.8 : 0.6, value[5], error[5];
    for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = e, s.collision.beta[q] = rough ? 0 : -1;
    s.run.collisions = 4000, s.run.seed = 7 + (uint64_t)rough;
    s.measure |= GG_MEASURE_PAIR_CORRELATION;
    gg_result *r = ct_run(s);
    const gg_curve *c = ct_find(&r->curves, "pair_correlation");
    const char *const names[] = {"contact_value_before", "contact_value_after", "contact_value",
                                 "contact_value_of_flux", "approach_speed"};
    for (int k = 0; k < 5; k++) value[k] = ct_number(c, names[k]).value, error[k] = ct_number(c, names[k]).error;
    ct_expect("parting", value[1], hypot(error[1], error[0] / e), value[0] / e, 0.3);
    ct_expect("all", value[2], hypot(error[2], error[3] * (1 + 1 / e) / 2), value[3] * (1 + 1 / e) / 2, 0.2);
    ct_expect("approaching", value[0], hypot(error[0], error[3]), value[3], 0.2);
    assert_true(value[4] < 1 - 2 * error[4]);
    gg_result_free(r);
  }
}

/* Pairs about to collide, from positions and velocities: those whose straight path leads to contact within one step
 * of time, and within the next one, weighted by the inverse of their normal speed there. So weighted, both steps
 * have the same number, but for third grains. */
typedef struct about_to_collide {
  const gg_model *m;
  double step, slow, sum[2], squares[2], frames; /* slow speeds are averaged over: their sum of 1/g fluctuates */
  int seen;
} about_to_collide;
enum { WARM = 60 };

/* Time until |d + g t| = 1, INFINITY if they miss; *speed: the normal speed there. */
static double time_to_contact(gg_vec d, gg_vec g, double *speed)
{
  double along = gg_dot(d, g), outside = gg_dot(d, d) - 1, discriminant = along * along - gg_dot(g, g) * outside;
  if (along >= 0 || discriminant < 0) return INFINITY;
  *speed = sqrt(discriminant);
  return outside / (*speed - along);
}

static gg_status count_near(void *context, const gg_frame *f, gg_error *err)
{
  (void)err;
  about_to_collide *s = context;
  const double *L = s->m->box, *r = f->position, *c = f->velocity;
  double sum[2] = {0}, speed = 1;
  if (s->seen++ < WARM) return GG_OK;
  for (size_t i = 0; i < 3 * f->n; i += 3)
    for (size_t j = i + 3; j < 3 * f->n; j += 3) {
      double d[3];
      for (int a = 0; a < 3; a++) {
        d[a] = r[j + (size_t)a] - r[i + (size_t)a];
        d[a] -= d[a] > L[a] / 2 ? L[a] : d[a] < -L[a] / 2 ? -L[a] : 0;
      }
      if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > 4) continue;
      gg_vec g = {c[j] - c[i], c[j + 1] - c[i + 1], c[j + 2] - c[i + 2]};
      double at = time_to_contact((gg_vec){d[0], d[1], d[2]}, g, &speed) / s->step;
      if (at < 2) sum[at >= 1] += (speed < s->slow ? 6 / s->slow * (1 - speed / s->slow) : 1 / speed) / s->step;
    }
  for (int k = 0; k < 2; k++) s->sum[k] += sum[k], s->squares[k] += sum[k] * sum[k];
  s->frames++;
  return GG_OK;
}

/* Nightly. Heated grains, so dense and inelastic that extrapolated densities of separating pairs were 5 % low: the
 * density of approaching pairs at contact is that in space, and that of separating ones 1/e times as large. */
static void contact_density_is_that_in_space(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_HSS, s.thermostat = GG_WHITE_NOISE, s.phi = 0.45, s.particles = 1000,
  s.run.collisions = 3000, s.run.seed = 9;
  s.output.trajectory_every = 2;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.8;
  s.measure |= GG_MEASURE_PAIR_CORRELATION;
  gg_model m;
  gg_result *r = NULL;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  about_to_collide near = {
      .m = &m, .step = 0.1 / gg_common_model_collision_rate(&m, m.temperature0), .slow = 0.2 * sqrt(m.temperature0)};
  const gg_run_callbacks callbacks = {.context = &near, .frame = count_near};
  assert_int_equal(gg_run_scene(&s, NULL, 1, &callbacks, &r, NULL), GG_OK);
  const gg_curve *c = ct_find(&r->curves, "pair_correlation");
  gg_curve_number before = ct_number(c, "contact_value_before"), after = ct_number(c, "contact_value_after");
  gg_curve_number flux = ct_number(c, "contact_value_of_flux");
  double one = 4 * M_PI * 0.25 * (double)(m.n * (m.n - 1)) / m.volume, mean[2], error[2];
  for (int k = 0; k < 2; k++) {
    mean[k] = near.sum[k] / near.frames;
    error[k] = sqrt((near.squares[k] / near.frames - mean[k] * mean[k]) / near.frames);
  }
  double at_contact = (1.5 * mean[0] - 0.5 * mean[1]) / one;
  ct_expect("in space", at_contact, hypot(hypot(1.5 * error[0], 0.5 * error[1]) / one, before.error), before.value,
            0.3);
  assert_true(fabs(before.value / flux.value - 1) < 0.005);
  assert_true(fabs(0.8 * after.value / before.value - 1) < 1e-4); /* a few within the contact time are elastic */
  assert_true(after.error < 0.005 * after.value);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(pairs_of_images),
                                     cmocka_unit_test(sampled_pairs),
                                     cmocka_unit_test(few_points),
                                     cmocka_unit_test(ideal_gas),
                                     cmocka_unit_test(planted_collisions),
                                     cmocka_unit_test(hard_spheres),
                                     cmocka_unit_test(separating_pairs_are_denser_by_1_over_e)},
                          nightly[] = {cmocka_unit_test(contact_density_is_that_in_space)};
  return getenv("NIGHTLY") ? cmocka_run_group_tests(nightly, NULL, NULL) : cmocka_run_group_tests(tests, NULL, NULL);
}
