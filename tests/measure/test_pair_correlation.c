/* Pairs in sheared boxes against a search through every image; sampled pairs against all of them; g = 1 for points
 * thrown anywhere; a planted g(r) is extrapolated to contact; hard spheres in equilibrium have the contact value of the
 * equation of state, by extrapolation and by the collision rate; of inelastic grains those that part are 1/e times as
 * dense as those that meet. */
#include <complex.h>

#include "curve_test.h"
#include "measure/contact_statistics.h"
#include "measure/pairs.h"

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
  const gg_pairs *p;                                         /* NULL: numbers of grains are what they are */
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

/* Every image within two boxes. */
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

/* Cells, also few in a small box, find what the plain search finds: offsets over the whole range, cubes and
 * long boxes. */
static void pairs_of_images(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(50, 0);
  for (int k = 0; k < 40; k++) {
    gg_scene scene = gg_scene_defaults();
    scene.phi = 0.2, scene.particles = 300;
    if (k % 2) scene.aspect[k % 3] = 1.7;
    gg_model m;
    assert_int_equal(gg_common_model_make(&scene, GG_MD, &m, NULL), GG_OK);
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

/* Within four errors, by the scatter of what was drawn. */
static void expect_mean(const char *what, double sum, double squares, double n, double expected, double sight)
{
  double mean = sum / n, error = sqrt((squares / n - mean * mean) / (n - 1));
  print_message("# %-10s %.6g +- %.2g, all pairs: %.6g\n", what, mean, error, expected);
  assert_true(fabs(mean - expected) <= 4 * error + 1e-9 * fabs(expected));
  assert_true(error < sight);
}

/* Pairs within a budget stand for all pairs, near and far, whatever their direction; the same snapshot draws the same
 * ones, another one others. Cubes and long boxes, the image above displaced. */
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
    assert_int_equal(gg_common_model_make(&scene, GG_MD, &m, NULL), GG_OK);
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

/* Points thrown anywhere: g_11 = g_12 = g_22 = 1 at every distance; and the rate planted with them. */
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
      gg_curve_number p = ct_number(c, "contact_value");
      ct_expect("contact value", p.value, p.error, 1, 0.5);
      if (species == 2) continue;
      p = ct_number(c, "contact_value_of_rate");
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
  ct_expect("g at contact", p.value, p.error, chi, 0.06);
  p = ct_number(c, "contact_value_of_rate");
  ct_expect("g of the collision rate", p.value, p.error, chi, 0.03);
  gg_result_free(r);
}

/* Percus and Yevick's g(r), d <= r <= 2d, d = 1 (Smith & Henderson, Mol. Phys. 19 (1970) 411): at contact it is
 * (1 + phi/2)/(1 - phi)^2. */
static double percus_yevick(double phi, double r)
{
  double a = (1 - phi) * (1 - phi), b = 6 * phi * (1 - phi), c = 18 * phi * phi, d = -12 * phi * (1 + 2 * phi);
  double sum = 0;
  for (int k = 0; k < 3; k++) { /* Newton's way to each root of the cubic */
    double complex t = k == 0 ? 10 : (k == 1 ? 30 : -30) * I - 30;
    for (int i = 0; i < 200; i++) t -= (((a * t + b) * t + c) * t + d) / ((3 * a * t + 2 * b) * t + c);
    sum += creal(t * ((1 + phi / 2) * t + 1 + 2 * phi) / ((3 * a * t + 2 * b) * t + c) * cexp(t * (r - 1)));
  }
  return sum / r;
}

/* How many are in a shell. */
static double shell(double phi, double from, double width)
{
  double sum = 0;
  for (int i = 0; i < 20; i++) {
    double r = 1 + from + (i + 0.5) * width / 20;
    sum += r * r * percus_yevick(phi, r) / 20;
  }
  return 4 * M_PI * sum * width;
}

/* Pairs that part from contact at the angle cos^-1 mu are at r^2 = (1 + y)^2 + y^2 (1/mu^2 - 1) after the way y along
 * the line of centres; in equilibrium as many are there as g says. Far ones are ideal. */
static double way(double phi, const gg_near *n, double y)
{
  double sum = 0;
  for (int i = 0; i < 2000; i++) {
    double mu = (i + 0.5) / 2000, r = sqrt((1 + y) * (1 + y) + y * y * (1 / (mu * mu) - 1));
    if (r < 1 + n->reach) sum += (r < 2 ? percus_yevick(phi, r) : 1) / 2000;
  }
  return 4 * M_PI * sum;
}

/* The extrapolation itself, without noise: within 4e-4 for pairs by their gap, and 1e-3 by the way since contact. A
 * parabola through the first quarter of a diameter is off by 4e-3 from phi = 0.4 on. */
static void extrapolation(void **state)
{
  (void)state;
  const double phis[] = {0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.45, 0.49};
  for (size_t i = 0; i < sizeof phis / sizeof *phis; i++) {
    gg_model m = ct_model(GG_EQUILIBRIUM, phis[i], -1, 4000, 1);
    gg_near n = gg_measure_contact_setup(&m, 1, gg_measure_pairs_longest_reach(&m));
    double bin[GG_NEAR_WIDTH], expected = (1 + phis[i] / 2) / ((1 - phis[i]) * (1 - phis[i]));
    assert_true(fabs(percus_yevick(phis[i], 1) / expected - 1) < 1e-9);
    for (int k = 0; k < GG_NEAR_BINS; k++) {
      bin[k] = bin[GG_NEAR_BINS + k] = 0.5e4 * shell(phis[i], k * n.gap / GG_NEAR_BINS, n.gap / GG_NEAR_BINS);
      bin[2 * GG_NEAR_BINS + k] = 0.9 * bin[k];
      bin[3 * GG_NEAR_BINS + k] = 0.5e4 * way(phis[i], &n, (k + 0.5) * n.way / GG_NEAR_BINS) * n.way / GG_NEAR_BINS;
    }
    gg_contact_density g = gg_measure_contact_estimate(&n, bin, 1e4, 10);
    print_message("# phi %.2f: all %+.1e, approaching %+.1e, parting %+.1e\n", phis[i], g.alike / expected - 1,
                  g.approaching / expected - 1, g.parting / expected - 1);
    assert_true(fabs(g.alike / expected - 1) < 4e-4 && fabs(g.approaching / expected - 1) < 4e-4);
    assert_true(fabs(g.parting / expected - 1) < 1e-3 && fabs(g.speed - 0.9) < 1e-9);
  }
}

/* Sheared inelastic grains: parting over approaching is 1/e, whatever their spins, and the rate with the measured speed
 * is that of approaching pairs. Grains about to collide are slower than Maxwellians of their temperature. */
static void inelastic(void **state)
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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pairs_of_images), cmocka_unit_test(sampled_pairs), cmocka_unit_test(ideal_gas),
      cmocka_unit_test(extrapolation),   cmocka_unit_test(hard_spheres),  cmocka_unit_test(inelastic),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
