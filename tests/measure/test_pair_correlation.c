/* Pairs in sheared boxes against a search through every image; g = 1 for points thrown anywhere; hard spheres in
 * equilibrium have the contact value of the equation of state, by extrapolation and by the collision rate. */
#include "curve_test.h"
#include "measure/pairs.h"

static void thrown(gg_snapshot *s, gg_rng *r, int sample)
{
  s->offset = s->model->box[0] * gg_rng_uniform(r);
  s->time = sample, s->collisions = (uint64_t)(1000 * sample);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      s->r[a][i] = s->model->box[a] * gg_rng_uniform(r);
      s->c[a][i] = gg_rng_normal(r);
    }
}

typedef struct tally {
  double pairs, squares, checks;
} tally;

static void add(void *context, size_t i, size_t j, gg_vec d, double square)
{
  tally *t = context;
  t->pairs++, t->squares += square, t->checks += square * (double)(i * j) + 0 * d.x;
}

/* Every image within two boxes. */
static tally plain(const gg_snapshot *s, double reach)
{
  tally t = {0, 0, 0};
  const double *L = s->model->box;
  for (size_t i = 0; i < s->n; i++)
    for (size_t j = i + 1; j < s->n; j++)
      for (int x = -2; x <= 2; x++)
        for (int y = -1; y <= 1; y++)
          for (int z = -1; z <= 1; z++) {
            gg_vec d = {s->r[0][j] - s->r[0][i] + x * L[0] + y * s->offset, s->r[1][j] - s->r[1][i] + y * L[1],
                        s->r[2][j] - s->r[2][i] + z * L[2]};
            if (gg_dot(d, d) < reach * reach) add(&t, i, j, d, gg_dot(d, d));
          }
  return t;
}

/* Cells, and all pairs tried in a small box, find what the plain search finds: offsets over the whole range, cubes and
 * long boxes. */
static void pairs_of_images(void **state)
{
  (void)state;
  gg_rng r = gg_rng_seed(50, 0);
  for (int k = 0; k < 40; k++) {
    gg_scene scene = gg_scene_defaults();
    scene.phi = 0.2, scene.particles = 300;
    if (k % 2) scene.aspect[k % 3] = 1.7;
    gg_model m;
    assert_int_equal(gg_model_make(&scene, GG_MD, &m, NULL), GG_OK);
    double reach = (k % 4 < 2 ? 0.35 : 1) * gg_pairs_longest_reach(&m);
    gg_snapshot s;
    gg_pairs p;
    assert_int_equal(gg_snapshot_init(&s, &m, true, NULL), GG_OK);
    assert_int_equal(gg_pairs_init(&p, &m, reach, NULL), GG_OK);
    assert_true((k % 4 < 2) == (p.cells[0] >= 5 && p.cells[1] >= 5 && p.cells[2] >= 5));
    thrown(&s, &r, k);
    tally fast = {0, 0, 0}, slow = plain(&s, reach);
    gg_pairs_each(&p, &s, add, &fast);
    assert_true(slow.pairs > 100 && fast.pairs == slow.pairs);
    assert_true(fabs(fast.squares / slow.squares - 1) < 1e-9 && fabs(fast.checks / slow.checks - 1) < 1e-9);
    gg_pairs_clear(&p);
    gg_snapshot_clear(&s);
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
    gg_curves list = ct_curves(&gg_pair_correlation, &m, 64, thrown, 51);
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
    gg_curves_clear(&list);
  }
}

/* Hard spheres at phi = 0.3: (Z - 1)/(4 phi) with Z of Pieprzyk et al., Phys. Chem. Chem. Phys. 21 (2019) 6886. */
static void hard_spheres(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_EQUILIBRIUM, s.phi = 0.3, s.particles = 2000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 1;
  s.run.collisions = 1000;
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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pairs_of_images),
      cmocka_unit_test(ideal_gas),
      cmocka_unit_test(hard_spheres),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
