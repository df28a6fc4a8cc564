/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision rule: conservation laws, energy, coefficients recovered from the velocities, friction cone, limits and
 * time reversal, on a million random pairs of unequal grains (and a wall), grazing and head-on ones among them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

#include "common/collision.h"
#include "common/rng.h"

enum { PAIRS = 1000000 };

typedef struct pair {
  gg_partner one, two;
  double e, beta, mu, a1, a2;
  gg_contact contact;
  gg_vec k, c1, c2, s1, s2; /* before */
  gg_vec d1, d2, t1, t2;    /* after */
  gg_vec g, J;
  double gn;
} pair;

static double between(gg_rng *r, double low, double high)
{
  return low + (high - low) * gg_rng_uniform(r);
}
static double norm(gg_vec a)
{
  return sqrt(gg_dot(a, a));
}

/* A random approaching pair; every 100th grazing (g_n = 1e-9 of g_t), every 101st head-on (g_t = 0 but for spins). */
static pair random_pair(gg_rng *r, int i, bool wall)
{
  pair p = {.one = {between(r, 0.1, 10), between(r, 0.05, 0.7)}, .two = {between(r, 0.1, 10), between(r, 0.05, 0.7)}};
  if (wall) p.two.mass = INFINITY;
  p.e = between(r, 0, 1), p.beta = between(r, -1, 1), p.mu = between(r, 0.01, 2);
  p.a1 = between(r, 0.2, 2), p.a2 = between(r, 0.2, 2);
  p.k = gg_rng_direction(r);
  p.c1 = gg_common_rng_normal_vec(r);
  p.c2 = wall ? (gg_vec){0, 0, 0} : gg_common_rng_normal_vec(r); /* in the wall's frame it does no work */
  p.s1 = gg_common_rng_normal_vec(r), p.s2 = wall ? (gg_vec){0, 0, 0} : gg_common_rng_normal_vec(r);
  gg_vec c12 = gg_sub(p.c1, p.c2);
  double gn = gg_dot(p.k, c12), wanted = i % 100 == 0 ? 1e-9 : fabs(gn);
  p.c1 = gg_axpy(wanted - gn, p.k, p.c1);
  if (i % 101 == 0) p.c1 = gg_axpy(wanted, p.k, p.c2);
  return p;
}

static void collide(pair *p, gg_rule rule)
{
  bool frictional = rule == GG_FRICTIONAL;
  p->contact =
      gg_common_contact_make(p->one, p->two, p->e, rule == GG_SMOOTH ? -1 : p->beta, frictional ? p->mu : INFINITY);
  gg_vec c12 = gg_sub(p->c1, p->c2);
  p->gn = gg_dot(p->k, c12);
  p->g = gg_contact_velocity(rule, p->k, c12, p->s1, p->s2);
  p->J = gg_impulse(rule, &p->contact, p->k, p->g, p->gn);
  p->d1 = p->c1, p->d2 = p->c2, p->t1 = p->s1, p->t2 = p->s2;
  gg_kick(rule, &p->contact, p->k, p->J, &p->d1, &p->t1, &p->d2, &p->t2);
}

static double energy(const pair *p, gg_vec c1, gg_vec c2, gg_vec s1, gg_vec s2)
{
  double e = 0.5 * p->one.mass * (gg_dot(c1, c1) + p->one.inertia * gg_dot(s1, s1)); /* I omega^2 = K m s^2 */
  if (isinf(p->two.mass)) return e;
  return e + 0.5 * p->two.mass * (gg_dot(c2, c2) + p->two.inertia * gg_dot(s2, s2));
}

/* Effective beta of what happened: -(g_t' . g_t)/g_t^2. */
static double effective_beta(const pair *p)
{
  gg_vec after = gg_contact_velocity(GG_ROUGH, p->k, gg_sub(p->d1, p->d2), p->t1, p->t2);
  gg_vec gt = gg_axpy(-p->gn, p->k, p->g), gt_after = gg_axpy(-gg_dot(p->k, after), p->k, after);
  return -gg_dot(gt_after, gt) / gg_dot(gt, gt);
}

static void check_momentum(const pair *p)
{
  gg_vec before = gg_add(gg_scale(p->one.mass, p->c1), gg_scale(p->two.mass, p->c2));
  gg_vec after = gg_add(gg_scale(p->one.mass, p->d1), gg_scale(p->two.mass, p->d2));
  double size = p->one.mass * norm(p->c1) + p->two.mass * norm(p->c2) + norm(p->J);
  assert_true(norm(gg_sub(after, before)) <= 4e-15 * size);
}

/* I omega + a m k x (-+ c) about the contact point is conserved for each grain by itself: with I omega = K m a s,
 * divided by a m, K s -+ k x c. */
static void check_angular(double K, gg_vec k, double sign, gg_vec c, gg_vec s, gg_vec d, gg_vec t)
{
  gg_vec before = gg_axpy(K, s, gg_scale(sign, gg_cross(k, c))), after = gg_axpy(K, t, gg_scale(sign, gg_cross(k, d)));
  assert_true(norm(gg_sub(after, before)) <= 1e-14 * (norm(c) + norm(d) + K * (norm(s) + norm(t))));
}

static void check_pair(const pair *p, gg_rule rule)
{
  bool wall = isinf(p->two.mass);
  if (!wall) check_momentum(p);
  check_angular(p->one.inertia, p->k, -1, p->c1, p->s1, p->d1, p->t1);
  if (!wall) check_angular(p->two.inertia, p->k, 1, p->c2, p->s2, p->d2, p->t2);

  /* e from the velocities */
  double after = gg_dot(p->k, gg_sub(p->d1, p->d2)), speed = norm(p->g) + norm(p->d1) + norm(p->d2);
  assert_true(fabs(after + p->e * p->gn) <= 2e-14 * speed);

  /* energy: what is lost, the closed form, and the difference of energies agree */
  gg_vec gt = gg_axpy(-p->gn, p->k, p->g);
  double gt2 = gg_dot(gt, gt), beta = rule == GG_SMOOTH || gt2 == 0 ? -1 : effective_beta(p);
  double closed = 0.5 * (1 - p->e * p->e) * p->gn * p->gn / gg_inverse_mr(&p->contact) +
                  0.5 * (1 - beta * beta) * gt2 / gg_inverse_mt(&p->contact);
  if (rule == GG_SMOOTH) closed = 0.5 * (1 - p->e * p->e) * p->gn * p->gn / gg_inverse_mr(&p->contact);
  double loss = gg_energy_loss(&p->contact, p->k, p->g, p->J);
  double E0 = energy(p, p->c1, p->c2, p->s1, p->s2), E1 = energy(p, p->d1, p->d2, p->t1, p->t2);
  double scale = E0 + E1 + gg_dot(p->g, p->g) / gg_inverse_mr(&p->contact);
  assert_true(fabs(loss - closed) <= 1e-13 * scale);
  assert_true(fabs(loss - (E0 - E1)) <= 1e-13 * scale);
  assert_true(loss >= -1e-14 * scale);
}

static void check_many(gg_rule rule, bool wall, uint64_t stream)
{
  gg_rng r = gg_common_rng_seed(1991, stream);
  for (int i = 0; i < PAIRS; i++) {
    pair p = random_pair(&r, i, wall);
    collide(&p, rule);
    check_pair(&p, rule);
    if (rule == GG_ROUGH && i % 100 && i % 101) assert_true(fabs(effective_beta(&p) - p.beta) <= 1e-9);
  }
}

/* Momentum, angular momentum about the contact point, energy loss, e and beta recovered: every rule. */
static void smooth_pairs(void **state)
{
  (void)state, check_many(GG_SMOOTH, false, 1);
}
static void rough_pairs(void **state)
{
  (void)state, check_many(GG_ROUGH, false, 2);
}
static void frictional_pairs(void **state)
{
  (void)state, check_many(GG_FRICTIONAL, false, 3);
}
static void smooth_wall(void **state)
{
  (void)state, check_many(GG_SMOOTH, true, 4);
}
static void rough_wall(void **state)
{
  (void)state, check_many(GG_ROUGH, true, 5);
}
static void frictional_wall(void **state)
{
  (void)state, check_many(GG_FRICTIONAL, true, 6);
}

/* Coulomb: |J_t| <= mu |J_n| to rounding; equality while sliding; sticking collisions have beta = beta_0; the switch is
 * exactly where both agree, tan(psi) = mu (1+e) m_r/((1+beta_0) m_t). */
static void friction_cone(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1991, 7);
  int slid = 0;
  for (int i = 0; i < PAIRS; i++) {
    pair p = random_pair(&r, i, false);
    collide(&p, GG_FRICTIONAL);
    double Jn = gg_dot(p.k, p.J), Jt = norm(gg_axpy(-Jn, p.k, p.J));
    assert_true(Jt <= p.mu * Jn * (1 + 1e-12) + 1e-15 * norm(p.J));
    gg_vec gt = gg_axpy(-p.gn, p.k, p.g);
    double critical = p.mu * p.contact.jn / p.contact.jt, tangent = norm(gt) / p.gn;
    if (tangent > critical * (1 + 1e-12)) {
      slid++;
      assert_true(fabs(Jt - p.mu * Jn) <= 1e-12 * p.mu * Jn + 1e-15 * norm(p.J));
    } else if (tangent < critical * (1 - 1e-12) && i % 100 && i % 101) {
      assert_true(fabs(effective_beta(&p) - p.beta) <= 1e-9);
    }
  }
  assert_in_range(slid, PAIRS / 10, 9 * PAIRS / 10); /* both branches were there */
}

/* The critical angle itself: a hair below sticks, a hair above slides, and J is continuous there. */
static void critical_angle(void **state)
{
  (void)state;
  gg_contact c = gg_common_contact_make((gg_partner){1, 0.4}, (gg_partner){1, 0.4}, 0.9, 0.4, 0.123);
  gg_vec k = {1, 0, 0};
  double critical = c.mu * c.jn / c.jt;
  for (int side = -1; side <= 1; side += 2) {
    gg_vec g = {1, critical * (1 + side * 1e-10), 0};
    gg_vec J = gg_impulse(GG_FRICTIONAL, &c, k, g, 1);
    double expected = side < 0 ? c.jt * g.y : c.mu * c.jn;
    assert_true(fabs(J.y - expected) <= 1e-16 * 4);
    assert_true(fabs(J.y - c.mu * c.jn) <= 2e-10);
  }
}

static void same_bits(const pair *a, const pair *b, double tolerance)
{
  assert_true(norm(gg_sub(a->d1, b->d1)) <= tolerance && norm(gg_sub(a->d2, b->d2)) <= tolerance);
  assert_true(norm(gg_sub(a->t1, b->t1)) <= tolerance && norm(gg_sub(a->t2, b->t2)) <= tolerance);
}

/* mu -> infinity is the rough rule, bit for bit; beta -> -1 the smooth one. */
static void limits_of_mu_and_beta_are_the_simpler_rules(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1991, 8);
  for (int i = 0; i < PAIRS / 10; i++) {
    pair rough = random_pair(&r, i, false), sliding = rough, smooth = rough, nearly = rough;
    sliding.mu = 1e300;
    collide(&rough, GG_ROUGH);
    collide(&sliding, GG_FRICTIONAL);
    if (i % 100) same_bits(&rough, &sliding, 0);
    nearly.beta = -1 + 1e-14;
    collide(&smooth, GG_SMOOTH);
    collide(&nearly, GG_ROUGH);
    same_bits(&smooth, &nearly, 1e-11);
  }
  assert_int_equal(gg_common_rule_select(-1, INFINITY), GG_SMOOTH);
  assert_int_equal(gg_common_rule_select(0.5, 0), GG_SMOOTH);
  assert_int_equal(gg_common_rule_select(0.5, INFINITY), GG_ROUGH);
  assert_int_equal(gg_common_rule_select(-0.999, 0.1), GG_FRICTIONAL);
}

/* e = 1 and beta = +-1: reversing all velocities and spins after the collision leads back. */
static void time_reversal(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1991, 9);
  for (int i = 0; i < PAIRS; i++) {
    pair p = random_pair(&r, i, i & 1);
    gg_rule rule = i & 2 ? GG_ROUGH : GG_SMOOTH;
    p.e = 1, p.beta = 1;
    collide(&p, rule);
    pair back = p;
    back.c1 = gg_scale(-1, p.d1), back.c2 = gg_scale(-1, p.d2);
    back.s1 = gg_scale(-1, p.t1), back.s2 = gg_scale(-1, p.t2);
    collide(&back, rule);
    double size = norm(p.c1) + norm(p.c2) + norm(p.s1) + norm(p.s2) + norm(p.d1) + norm(p.d2);
    assert_true(norm(gg_add(back.d1, p.c1)) <= 1e-13 * size && norm(gg_add(back.d2, p.c2)) <= 1e-13 * size);
    if (rule == GG_ROUGH) assert_true(norm(gg_add(back.t1, p.s1)) <= 1e-13 * size * 20);
  }
}

/* Equal spheres: J = m eta_2 g + m (eta_1 - eta_2) k g_n with eta_2 = (1+beta)K/(2(1+K)) (thesis 2.6, corrected). */
static void equal_spheres(void **state)
{
  (void)state;
  double e = 0.8, beta = 0.3, K = 0.4, eta1 = (1 + e) / 2, eta2 = (1 + beta) * K / (2 * (1 + K));
  gg_contact c = gg_common_contact_make((gg_partner){1, K}, (gg_partner){1, K}, e, beta, INFINITY);
  gg_vec k = {0.6, 0, 0.8}, g = {1, -2, 0.5};
  double gn = gg_dot(k, g);
  gg_vec J = gg_impulse(GG_ROUGH, &c, k, g, gn), expected = gg_axpy((eta1 - eta2) * gn, k, gg_scale(eta2, g));
  assert_true(norm(gg_sub(J, expected)) < 1e-15);
}

/* Kicks conserve momentum and angular momentum about the contact point. The relative normal velocity after contact is
 * -(e g_n + 2 D), that of the surfaces along k x z has 2 D_t more. Energy is lost and given as counted: kicks give what
 * the impulse with them has beyond the one without. */
static void check_kicked(pair *p, gg_rule rule, double D, double Dt)
{
  collide(p, rule);
  gg_contact c = p->contact;
  gg_common_contact_set_kicks(&c, rule != GG_SMOOTH, (const double[]){D, Dt});
  if (rule == GG_SMOOTH) p->s1 = p->s2 = (gg_vec){0, 0, 0};
  const gg_vec J = gg_kicked_impulse(rule, &c, p->k, p->g, p->gn), z = {0, 0, 1};
  const gg_vec kick = gg_axpy(-c.kick[GG_TANGENTIAL_KICK], gg_cross(p->k, z), gg_scale(c.kick[GG_NORMAL_KICK], p->k)),
               rest = gg_sub(J, kick);
  pair without = *p;
  for (int kicked = 0; kicked < 2; kicked++) {
    pair *q = kicked ? p : &without;
    q->contact = c, q->J = kicked ? J : rest;
    q->d1 = q->c1, q->d2 = q->c2, q->t1 = q->s1, q->t2 = q->s2;
    gg_kick(rule, &c, q->k, q->J, &q->d1, &q->t1, &q->d2, &q->t2);
  }
  check_momentum(p);
  if (rule != GG_SMOOTH) {
    check_angular(p->one.inertia, p->k, -1, p->c1, p->s1, p->d1, p->t1);
    check_angular(p->two.inertia, p->k, 1, p->c2, p->s2, p->d2, p->t2);
  }
  const double size = norm(p->g) + norm(p->d1) + norm(p->d2);
  const gg_vec after = gg_contact_velocity(rule, p->k, gg_sub(p->d1, p->d2), p->t1, p->t2);
  const gg_vec before = gg_contact_velocity(rule, p->k, gg_sub(without.d1, without.d2), without.t1, without.t2);
  assert_true(fabs(gg_dot(p->k, after) + p->e * p->gn + 2 * D) <= 4e-14 * size);
  const gg_vec more = gg_axpy(-2 * Dt, gg_cross(p->k, z), gg_axpy(2 * D, p->k, gg_sub(after, before)));
  assert_true(norm(more) <= 1e-13 * (size + norm(p->t1) + norm(p->t2)));
  const gg_kicked_loss counted = gg_kicked_energy_loss(&c, p->k, p->g, J);
  const double E0 = energy(p, p->c1, p->c2, p->s1, p->s2), E1 = energy(p, p->d1, p->d2, p->t1, p->t2);
  const double E2 = energy(p, without.d1, without.d2, without.t1, without.t2),
               scale = E0 + E1 + E2 + fabs(counted.loss);
  assert_true(fabs(counted.given - (E1 - E2)) <= 1e-13 * scale);
  assert_true(fabs(counted.loss - (E0 - E2)) <= 1e-13 * scale);
}

static void kicks_conserve_momentum_and_give_their_energy(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1991, 10);
  for (int i = 0; i < PAIRS / 2; i++) {
    pair p = random_pair(&r, i, false);
    const gg_rule rule = (gg_rule)(i % 3);
    const double D = between(&r, 0, 2), Dt = between(&r, -2, 2);
    if (rule == GG_SMOOTH) p.s1 = p.s2 = (gg_vec){0, 0, 0};
    check_kicked(&p, rule, D, Dt);
  }
}

/* Kicks by the right hand: grain 2 right of grain 1 is pushed up. Coulomb's limit has the kick of the normal part. */
static void sides_of_kicks(void **state)
{
  (void)state;
  gg_contact c = gg_common_contact_make((gg_partner){1, 0.4}, (gg_partner){1, 0.4}, 0.9, 0.4, 0.1);
  gg_common_contact_set_kicks(&c, false, (const double[]){0, 1});
  const gg_vec k = {1, 0, 0};
  assert_true(gg_kicked_impulse(GG_SMOOTH, &c, k, (gg_vec){1, 0, 0}, 1).y > 0);
  gg_common_contact_set_kicks(&c, true, (const double[]){3, 0});
  const gg_vec J = gg_kicked_impulse(GG_FRICTIONAL, &c, k, (gg_vec){1, 100, 0}, 1);
  assert_true(fabs(J.x - (0.5 * 1.9 + 3)) < 1e-15 && fabs(J.y - 0.1 * J.x) < 1e-15);
}

/* No kick: the same bits. */
static void kicks_of_nothing(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(1991, 11);
  for (int i = 0; i < PAIRS / 10; i++) {
    pair p = random_pair(&r, i, i & 1);
    const gg_rule rule = (gg_rule)(i % 3);
    collide(&p, rule);
    const gg_vec J = gg_kicked_impulse(rule, &p.contact, p.k, p.g, p.gn);
    assert_true(J.x == p.J.x && J.y == p.J.y && J.z == p.J.z);
    assert_true(gg_kicked_energy_loss(&p.contact, p.k, p.g, J).given == 0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(smooth_pairs),
      cmocka_unit_test(rough_pairs),
      cmocka_unit_test(frictional_pairs),
      cmocka_unit_test(smooth_wall),
      cmocka_unit_test(rough_wall),
      cmocka_unit_test(frictional_wall),
      cmocka_unit_test(friction_cone),
      cmocka_unit_test(critical_angle),
      cmocka_unit_test(limits_of_mu_and_beta_are_the_simpler_rules),
      cmocka_unit_test(time_reversal),
      cmocka_unit_test(equal_spheres),
      cmocka_unit_test(kicks_conserve_momentum_and_give_their_energy),
      cmocka_unit_test(sides_of_kicks),
      cmocka_unit_test(kicks_of_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
