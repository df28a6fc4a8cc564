/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision integrals against the collision rule itself: pairs of grains drawn from the distributions, collided
 * by the code that both engines use. Bounds are 4.5 standard errors of the sample; about 300 numbers are tested. */
#include "theory_test.h"

#include "common/rng.h"
#include "theory/gaussian_moments.h"
#include "theory/mixture.h"
#include "theory/two_maxwellian.h"

enum { SAMPLES = 2000000 };

typedef struct tally {
  double sum, sum2;
} tally;

static inline void add(tally *t, double x)
{
  t->sum += x, t->sum2 += x * x;
}

static void check_as(const char *what, const tally *t, double scale, double expected)
{
  double mean = t->sum / SAMPLES, error = sqrt((t->sum2 / SAMPLES - mean * mean) / SAMPLES);
  if (!(fabs(scale * mean - expected) <= 4.5 * fabs(scale) * error + 1e-12))
    fail_msg("%s: sampled %g +- %g, theory %g", what, scale * mean, fabs(scale) * error, expected);
}

/* A vector of covariance M (xy the only off-diagonal part). */
static gg_vec draw(gg_rng *r, gg_tensor M)
{
  gg_vec n = gg_common_rng_normal_vec(r);
  double lx = sqrt(M.at[0][0]), off = M.at[0][1] / lx, ly = sqrt(M.at[1][1] - off * off);
  return (gg_vec){lx * n.x, off * n.x + ly * n.y, sqrt(M.at[2][2]) * n.z};
}

/* Sheared, anisotropic, spinning: every moment of one species that collides with one other. */
static void check_pair(const gg_model *m, const gg_gaussian state[], int i, int j, const gg_gaussian_rates *expected,
                       uint64_t seed)
{
  int o = gg_pair(i, j);
  gg_rng rng = gg_common_rng_seed(seed, 0);
  tally M[9] = {{0}}, Theta[9] = {{0}}, P[9] = {{0}}, spin = {0}, flux = {0};
  double sigma = m->sigma[o], weight = 4 * M_PI * m->density * gg_theory_fraction(m, j) * m->chi[o] * sigma * sigma;
  for (int n = 0; n < SAMPLES; n++) {
    gg_vec k = gg_rng_direction(&rng), c1 = draw(&rng, state[i].M), c2 = draw(&rng, state[j].M);
    gg_vec s1 = draw(&rng, state[i].Theta), s2 = draw(&rng, state[j].Theta);
    s1.z += state[i].spin, s2.z += state[j].spin;
    gg_vec c12 = gg_sub(c1, c2), C = c1, s = s1;
    c12.x -= m->shear_rate * sigma * k.y;
    gg_vec g = gg_contact_velocity(m->rule, k, c12, s1, s2);
    double u = fmax(gg_dot(k, g), 0);
    gg_vec J = gg_impulse(m->rule, &m->contact[i][j], k, g, u);
    gg_kick(m->rule, &m->contact[i][j], k, J, &C, &s, &c2, &s2);
    add(&flux, u);
    add(&spin, u * (s.z - s1.z));
    const double after[2][3] = {{C.x, C.y, C.z}, {s.x, s.y, s.z - state[i].spin}},
                 before[2][3] = {{c1.x, c1.y, c1.z}, {s1.x, s1.y, s1.z - state[i].spin}}, along[3] = {k.x, k.y, k.z},
                 push[3] = {J.x, J.y, J.z};
    for (int x = 0; x < 3; x++)
      for (int y = 0; y < 3; y++) {
        if (y <= x) { /* symmetric */
          add(&M[3 * x + y], u * (after[0][x] * after[0][y] - before[0][x] * before[0][y]));
          add(&Theta[3 * x + y], u * (after[1][x] * after[1][y] - before[1][x] * before[1][y]));
        }
        add(&P[3 * x + y], u * along[x] * push[y]);
      }
  }
  check_as("frequency", &flux, weight, expected->frequency[i]);
  check_as("spin", &spin, weight, expected->change[i].spin);
  for (int a = 0; a < 9; a++) {
    const int low = 3 * (a / 3 > a % 3 ? a / 3 : a % 3) + (a / 3 > a % 3 ? a % 3 : a / 3);
    check_as("M", &M[low], weight, expected->change[i].M.at[a / 3][a % 3]);
    check_as("Theta", &Theta[low], weight, expected->change[i].Theta.at[a / 3][a % 3]);
    check_as("Pc", &P[a], (i == j ? 0.5 : 1) * weight * sigma * m->density * gg_theory_fraction(m, i),
             expected->Pc.at[a / 3][a % 3]);
  }
}

/* A model without all pairs but i,j: their density is 0. */
static gg_model only_pair(const gg_model *m, int i, int j)
{
  gg_model one = *m;
  for (int o = 0; o < gg_pairs_of(m->n_species); o++)
    if (o != gg_pair(i, j)) one.chi[o] = 0;
  return one;
}

static void gaussian_moments(void **state)
{
  (void)state;
  const gg_gaussian gas[2] = {
      {{{{1.2, -0.3, 0}, {-0.3, 0.7, 0}, {0, 0, 0.8}}}, {{{0.5, 0.1, 0}, {0.1, 0.9, 0}, {0, 0, 0.6}}}, -0.3},
      {{{{0.5, -0.2, 0}, {-0.2, 0.4, 0}, {0, 0, 0.3}}}, {{{0.2, -0.1, 0}, {-0.1, 0.3, 0}, {0, 0, 0.4}}}, -0.1}};
  const double e[] = {0.9, 0.6, 0.8}, beta[] = {0.3, -0.7, 0.2}, mu[] = {INFINITY, INFINITY, 0.25};
  for (int set = 0; set < 3; set++) {
    gg_model m = mixture_for(GG_USF, 0.3, e[set], beta[set], 3, 1.5, 0.5);
    for (int p = 0; p < GG_PAIRS; p++) m.mu[p] = mu[set];
    gg_common_model_set_pairs(&m);
    for (int i = 0; i < 2; i++)
      for (int j = 0; j < 2; j++) {
        gg_model pair = only_pair(&m, i, j);
        gg_gaussian_rates r;
        gg_theory_gaussian_rates_at(&pair, gas, &r);
        check_pair(&pair, gas, i, j, &r, (uint64_t)(100 + 10 * set + 2 * i + j));
      }
  }
}

/* First Sonine polynomial of the squared speed in units of 2a. */
static double sonine(double v2, double a)
{
  double x2 = v2 / (2 * a);
  return x2 * x2 / 2 - 5 * x2 / 2 + 15. / 8;
}

/* d<v^2>/dt and d<v^4>/dt of smooth mixtures, and their slopes in the cumulants. */
static void sonine_rates(void **state)
{
  (void)state;
  for (double e = 0.5; e < 1; e += 0.4)
    for (int j = 0; j < 2; j++) {
      gg_model m = mixture_for(GG_HCS, 0.2, e, -1, 3, 1.5, 0.5), pair = only_pair(&m, 0, j);
      double a[2] = {0.8, 1.9}, sigma = m.sigma[j];
      double weight = 4 * M_PI * m.density * gg_theory_fraction(&m, j) * m.chi[j] * sigma * sigma;
      gg_rng rng = gg_common_rng_seed(7, (uint64_t)j);
      tally moment[2][3] = {{{0}}};
      for (int n = 0; n < SAMPLES; n++) {
        gg_vec k = gg_rng_direction(&rng), v1 = gg_scale(sqrt(a[0]), gg_common_rng_normal_vec(&rng));
        gg_vec v2 = gg_scale(sqrt(a[j]), gg_common_rng_normal_vec(&rng)), c1 = v1, c2 = v2, none = {0, 0, 0},
               g = gg_sub(v1, v2);
        double u = fmax(gg_dot(k, g), 0);
        gg_vec J = gg_impulse(GG_SMOOTH, &m.contact[0][j], k, g, u);
        gg_kick(GG_SMOOTH, &m.contact[0][j], k, J, &c1, &none, &c2, &none);
        double before = gg_dot(v1, v1), after = gg_dot(c1, c1);
        double by1 = sonine(before, a[0]) / 2, by2 = sonine(gg_dot(v2, v2), a[j]) / 2;
        const double weights[3] = {1, j == 0 ? by1 + by2 : by1, j == 0 ? 0 : by2};
        for (int w = 0; w < 3; w++) {
          add(&moment[0][w], u * weights[w] * (after - before));
          add(&moment[1][w], u * weights[w] * (after * after - before * before));
        }
      }
      gg_linear rate[2] = {gg_theory_rate_v2(&pair, 0, a), gg_theory_rate_v4(&pair, 0, a)};
      for (int p = 0; p < 2; p++) {
        check_as("rate", &moment[p][0], weight, rate[p].at0);
        check_as("slope in c_1", &moment[p][1], weight, rate[p].slope[0]);
        if (j == 1) check_as("slope in c_2", &moment[p][2], weight, rate[p].slope[1]);
      }
    }
}

/* Energy exchanged in collisions of frictional grains, and the fraction that slides. */
static void friction_integrals_agree_with_samples(void **state)
{
  (void)state;
  const double mu[] = {0.05, 0.2, 1}, ratio[] = {0.3, 1, 3};
  for (int set = 0; set < 9; set++) {
    gg_scene s = scene_of(GG_HCS, 0.2, 0.85, 0.4);
    for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mu[set / 3];
    gg_model m = model_of(&s);
    gg_grain grain = gg_theory_grain_of(&m);
    double r = ratio[set % 3], K = grain.K;
    gg_rng rng = gg_common_rng_seed(11, (uint64_t)set);
    tally tr = {0}, rot = {0}, slides = {0};
    for (int n = 0; n < SAMPLES; n++) {
      gg_vec k = gg_rng_direction(&rng), c1 = gg_common_rng_normal_vec(&rng), c2 = gg_common_rng_normal_vec(&rng);
      gg_vec s1 = gg_scale(sqrt(r / K), gg_common_rng_normal_vec(&rng)),
             s2 = gg_scale(sqrt(r / K), gg_common_rng_normal_vec(&rng));
      double before_tr = gg_dot(c1, c1) + gg_dot(c2, c2), before_rot = gg_dot(s1, s1) + gg_dot(s2, s2);
      gg_vec g = gg_contact_velocity(GG_FRICTIONAL, k, gg_sub(c1, c2), s1, s2);
      /* The normal velocity of a collision: its flux-weighted distribution is g exp(-g^2/4)/2. */
      double u = gg_dot(k, g), flux = sqrt(-4 * log(1 - gg_rng_uniform(&rng)));
      gg_vec shift = gg_scale((flux - u) / 2, k);
      before_tr += 2 * gg_dot(c1, shift) - 2 * gg_dot(c2, shift) + 2 * gg_dot(shift, shift);
      c1 = gg_add(c1, shift), c2 = gg_sub(c2, shift);
      g = gg_axpy(flux - u, k, g);
      gg_vec J = gg_impulse(GG_FRICTIONAL, &m.contact[0][0], k, g, flux), Jt = gg_axpy(-gg_dot(k, J), k, J);
      gg_kick(GG_FRICTIONAL, &m.contact[0][0], k, J, &c1, &s1, &c2, &s2);
      add(&tr, (gg_dot(c1, c1) + gg_dot(c2, c2) - before_tr) / 2);
      add(&rot, K * (gg_dot(s1, s1) + gg_dot(s2, s2) - before_rot) / 2);
      gg_vec gt = gg_axpy(-flux, k, g);
      add(&slides, gg_dot(Jt, Jt) < 0.999999 * m.contact[0][0].jt * m.contact[0][0].jt * gg_dot(gt, gt));
    }
    gg_exchange x = gg_theory_exchange_at(grain, mu[set / 3], r);
    check_as("translation", &tr, 1, x.translation);
    check_as("rotation", &rot, 1, x.rotation);
    check_as("sliding", &slides, 1, gg_theory_sliding_fraction(grain, mu[set / 3], r));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaussian_moments),
      cmocka_unit_test(sonine_rates),
      cmocka_unit_test(friction_integrals_agree_with_samples),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
