/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles of stress and heat flux. Conservation: at every height the divergence of the transfer equals the momentum
 * and energy that collisions and walls give to the grains, minus the loss, to rounding: for real collisions with a
 * floor under gravity, smooth and rough, one species and two. Planted grains have the stress and heat flux of their
 * distribution about a flow with a gradient. Runs: pressure and heat flux of a dense elastic gas are those of the
 * walls at every height, the balance of energy closes for inelastic grains, and the parts average to the quantities
 * of the run. */
#include "curve_test.h"

#include "graingas.h"
#include "measure/gap_slabs.h"
#include "scene/model_of_scene.h"

/* ---- Conservation */

typedef struct planted {
  const gg_observable *o;
  void *self;
  const gg_model *m;
  int slabs, collisions, contacts;
  double given[GG_MOST_GAP_SLABS]; /* energy given to grains, with a hat about the face above the slab */
} planted;

static double hat(const planted *p, int face, double height)
{
  const double y = (height / p->m->box[1] + 0.5) * p->slabs;
  return fmax(0, 1 - fabs(y - face - 1));
}

static void show(void *context, const gg_collision_record *c)
{
  planted *p = context;
  p->o->collisions->add(p->self, c);
  *(c->wall ? &p->contacts : &p->collisions) += 1;
  for (int i = 0; i < (c->wall ? 1 : 2); i++) {
    const double m = p->m->mass[c->species[i]], I = m * p->m->inertia[c->species[i]];
    const gg_vec v = gg_axpy((i ? 1 : -1) / m, c->J, c->c[i]), s = gg_add(c->s[i], c->turn[i]);
    const double gained =
        0.5 * m * (gg_dot(v, v) - gg_dot(c->c[i], c->c[i])) + 0.5 * I * (gg_dot(s, s) - gg_dot(c->s[i], c->s[i]));
    for (int k = 0; k < p->slabs - 1; k++) p->given[k] += hat(p, k, c->height[i]) * gained;
  }
}

/* Grains at rest have no kinetic fluxes: the balance contains collisions alone. */
static void stand_still(gg_snapshot *s, gg_engine *engine)
{
  gg_measure_snapshot_take(s, engine);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      s->c[a][i] = 0;
      if (s->s[0]) s->s[a][i] = 0;
    }
}

/* The loss of elastic grains is 0, not rounding. */
static void check_conservation(const gg_scene *scene)
{
  gg_model m;
  gg_engine *engine;
  gg_snapshot s;
  double gone;
  assert_int_equal(gg_scene_model_make(scene, GG_MD, &m, NULL), GG_OK);
  assert_int_equal(gg_md_ops.create(&m, 1, 1, &engine, NULL), GG_OK);
  planted p = {.o = &gg_measure_fluxes, .m = &m, .slabs = gg_measure_gap_slabs(&m)};
  p.self = p.o->create(&m, NULL);
  double *bins = calloc(p.o->curves->bins(p.self), sizeof *bins);
  assert_true(p.self && bins);
  assert_int_equal(gg_measure_snapshot_init(&s, &m, true, NULL), GG_OK);
  assert_int_equal(gg_md_ops.set_callback(engine, show, &p, NULL), GG_OK);
  stand_still(&s, engine);
  p.o->curves->add_snapshot(p.self, &s, bins);
  for (int k = 0; k < 3; k++) {
    assert_int_equal(gg_md_ops.advance(engine, 1, UINT64_MAX, &gone, NULL), GG_OK);
    stand_still(&s, engine);
    p.o->curves->add_snapshot(p.self, &s, bins);
  }
  gg_curves list = {.model = &m, .samples = 4};
  p.o->curves->of_bins(p.self, bins, &list);
  const gg_curve *left = ct_find(&list, "profile_energy_residual"), *loss = ct_find(&list, "profile_loss");
  assert_int_equal(left->n, p.slabs - 1);
  double worst = 0, most = 0, lost = 0;
  for (size_t i = 0; i < left->n; i++) {
    const double right = -p.given[i] * m.stress_unit / (m.volume / p.slabs * 3);
    worst = fmax(worst, fabs(left->value[i] - right)), most = fmax(most, fabs(right)), lost += loss->value[i];
  }
  print_message("# %d collisions, %d contacts: %.3g of %.3g\n", p.collisions, p.contacts, worst, most);
  assert_true(p.collisions > 300 && p.contacts > 30 && most > 0);
  assert_true(scene->collision.e[0] < 1 ? lost > 0 : lost == 0);
  assert_true(worst < 1e-10 * most);
  gg_measure_curves_clear(&list);
  gg_measure_snapshot_clear(&s);
  free(bins);
  p.o->destroy(p.self);
  gg_md_ops.destroy(engine);
}

static void balances_are_exact(void **state)
{
  (void)state;
  for (int k = 0; k < 10; k++) {
    gg_scene s = gg_scene_defaults();
    s.flow = GG_CHUTE, s.phi = 0.15, s.particles = 300;
    s.gravity[0] = 0.1, s.gravity[1] = -0.2;
    for (int q = 0; q < GG_PAIRS; q++)
      s.collision.e[q] = k < 8 ? 0.8 : 1, s.collision.beta[q] = k % 2 == 0 ? -1 : k < 8 ? 0.3 : 1;
    if (k & 2)
      s.n_species = 2, s.species[0] = (gg_species){0.6, 1, 1, 0.4, 1, 0},
      s.species[1] = (gg_species){0.4, 1.5, 3, 0.5, 1, 0};
    if (k & 4) s.walls.temperature[0] = s.walls.temperature[1] = 0.8, s.walls.accommodation = 0.7;
    check_conservation(&s);
  }
}

/* ---- Grains */

/* A gas with a flow 0.4 y, temperature 1, and the heat flux of C_y (C^2 - 5) a/5: q = a n/2, by acceptance-rejection
 * (|a C_y (C^2 - 5)/5| < 1 but for rare grains); both halves of the gap are alike. */
static const double tilt = 0.05;
static void fill(gg_snapshot *s, gg_rng *r, int sample)
{
  const gg_model *m = s->model;
  s->time = sample;
  for (size_t i = 0; i < s->n; i++) {
    gg_vec c;
    double weight;
    do {
      c = gg_common_rng_normal_vec(r);
      weight = 0.5 * (1 + tilt * c.y * (gg_dot(c, c) - 5) / 5);
    } while (gg_rng_uniform(r) > weight);
    for (int a = 0; a < 3; a++) s->r[a][i] = gg_rng_uniform(r) * m->box[a];
    s->c[0][i] = c.x + 0.4 * (s->r[1][i] - 3), s->c[1][i] = c.y, s->c[2][i] = c.z;
  }
}

static double level(double x, const void *value)
{
  (void)x;
  return *(const double *)value;
}

static void planted_grains_have_their_kinetic_fluxes(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_CHUTE, 0.2, -1, 4000, 1);
  m.gravity[1] = -1; /* else profiles would be folded */
  gg_curves list = ct_curves(&gg_measure_fluxes, &m, 400, fill, 3);
  const double n = m.density * m.stress_unit, q = n * tilt, none = 0;
  /* <C_y (C^2) C_y (C^2 - 5)>/5 = (<C_y^2 C^4> - 5 <C_y^2 C^2>)/5 = (35 - 25)/5 */
  assert_true(ct_chi2(ct_find(&list, "profile_q_y_kinetic"), 0, 1000, level, &q) < 2);
  assert_true(ct_chi2(ct_find(&list, "profile_P_xx_kinetic"), 0, 1000, level, &n) < 2);
  assert_true(ct_chi2(ct_find(&list, "profile_P_zz_kinetic"), 0, 1000, level, &n) < 2);
  assert_true(ct_chi2(ct_find(&list, "profile_P_yx_kinetic"), 0, 1000, level, &none) < 2);
  const gg_curve *heat = ct_find(&list, "profile_q_y_kinetic");
  double mean = 0, variance = 0;
  for (size_t i = 0; i < heat->n; i++) mean += heat->value[i] / (double)heat->n, variance += pow(heat->error[i], 2);
  ct_expect("heat flux", mean, sqrt(variance) / (double)heat->n, q, 0.12 * q);
  gg_measure_curves_clear(&list);
}

/* ---- Runs */

static gg_result *run_of(gg_engine_kind engine, gg_flow flow, double phi, double e, double beta, double T,
                         double torque)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine, s.flow = flow, s.phi = phi, s.particles = 500;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = e, s.collision.beta[q] = beta;
  s.walls.temperature[0] = T, s.walls.temperature[1] = flow == GG_FOURIER ? 0.5 * T : T;
  s.species[0].torque = torque;
  s.run.collisions = engine == GG_MD ? 8000 : phi > 0 ? 4000 : 6000, s.run.warmup = engine == GG_MD ? 1000 : 500;
  s.measure |= GG_MEASURE_PROFILES | GG_MEASURE_FLUXES;
  return ct_run(s);
}

static void constant_fluxes(void **state)
{
  (void)state;
  gg_result *r = run_of(GG_MD, GG_FOURIER, 0.3, 1, -1, 1, 0);
  const gg_curve *p = ct_find(&r->curves, "profile_P_yy"), *q = ct_find(&r->curves, "profile_q_y");
  const gg_curve *u = ct_find(&r->curves, "profile_velocity");
  const gg_curve_number p_low = ct_number(u, "wall_P_yy_lower"), q_low = ct_number(q, "wall_q_y_lower"),
                        q_up = ct_number(q, "wall_q_y_upper");
  const double heat = 0.5 * (q_low.value + q_up.value), none = 0;
  ct_expect("wall_q_y_lower", q_low.value, q_low.error, heat, 0.15 * heat);
  ct_expect("wall_heat_flux", r->value[GG_Q_WALL_HEAT_FLUX].mean, r->value[GG_Q_WALL_HEAT_FLUX].error, heat,
            0.15 * heat);
  assert_true(ct_chi2(p, 0, p->n, level, &p_low.value) < 2);
  assert_true(ct_chi2(q, 0, q->n, level, &heat) < 2);
  assert_true(ct_chi2(ct_find(&r->curves, "profile_energy_residual"), 0, 1000, level, &none) < 2);
  const gg_curve *T = ct_find(&r->curves, "profile_temperature");
  const gg_curve_number hot = ct_number(T, "temperature_jump_lower"), cold = ct_number(T, "temperature_jump_upper");
  print_message("# jumps %.4f +- %.4f, %.4f +- %.4f\n", hot.value, hot.error, cold.value, cold.error);
  assert_true(hot.value > 4 * hot.error && cold.value < -4 * cold.error);
  for (int k = 0; k < 2; k++) { /* half a slab further the gas is a little closer to the middle */
    const double next = T->value[k ? T->n - 2 : 1], of_gas = k ? 0.5 - cold.value : 1 - hot.value;
    assert_true(fabs(of_gas - next) < 0.03);
  }
  double mean = 0, variance = 0;
  for (size_t i = 0; i < p->n; i++) {
    if (!(p->error[i] < 0.02 * p_low.value)) fail_msg("P_yy at %g: error %g", p->x[i], p->error[i]);
    mean += q->value[i] / (double)q->n, variance += pow(q->error[i], 2);
  }
  ct_expect("mean of q_y", mean, hypot(sqrt(variance) / (double)q->n, q_low.error), heat, 0.2 * heat);
  gg_result_free(r);
}

static double sum_of(const gg_curve *c)
{
  double sum = 0;
  for (size_t i = 0; i < c->n; i++) sum += c->value[i];
  return sum;
}

/* Shear between thermal walls heats rough grains, collisions cool them: the balance needs every term. */
static void energy_balance_closes(void **state)
{
  (void)state;
  gg_result *r = run_of(GG_MD, GG_COUETTE, 0.2, 0.9, 0.2, 0.02, 0);
  const gg_curve *left = ct_find(&r->curves, "profile_energy_residual"), *loss = ct_find(&r->curves, "profile_loss"),
                 *work = ct_find(&r->curves, "profile_stress_work"),
                 *heat = ct_find(&r->curves, "profile_heat_divergence");
  const double none = 0;
  assert_true(ct_chi2(left, 0, left->n, level, &none) < 2);
  double variance = 0;
  for (size_t i = 0; i < left->n; i++) variance += pow(left->error[i], 2);
  ct_expect("sum of the residual", sum_of(left), sqrt(variance), 0, 0.1 * sum_of(loss));
  print_message("# loss %.4g, work %.4g, divergence %.4g\n", sum_of(loss), sum_of(work), sum_of(heat));
  assert_true(sum_of(work) > 0.3 * sum_of(loss));
  const double share = sum_of(loss) / ((double)loss->n + 1); /* of all slabs, of which the outermost have no centres */
  const gg_estimate *D = &r->value[GG_Q_DISSIPATION];
  ct_expect("loss", share, 4e-3 * D->mean, D->mean, 0.02 * D->mean);
  static const struct {
    const char *curve;
    gg_quantity q;
  } same[] = {{"profile_P_xx_collisional", GG_Q_P_XX_COLLISIONAL},
              {"profile_P_zz_collisional", GG_Q_P_ZZ_COLLISIONAL},
              {"profile_P_xy_collisional", GG_Q_P_XY_COLLISIONAL}};
  for (int k = 0; k < 3; k++) {
    const gg_curve *c = ct_find(&r->curves, same[k].curve);
    const double mean = sum_of(c) / (double)c->n, right = r->value[same[k].q].mean;
    print_message("# %s: mean %.6g, of the run %.6g\n", same[k].curve, mean, right);
    assert_true(fabs(mean - right) < 2e-3 * fabs(right));
  }
  const gg_curve *P = ct_find(&r->curves, "profile_P_yx"), *u = ct_find(&r->curves, "profile_velocity");
  const gg_curve_number wall = ct_number(u, "wall_P_yx_lower");
  assert_true(ct_chi2(P, 0, P->n, level, &wall.value) < 2);
  gg_result_free(r);
}

/* A torque on every grain gives energy at all heights: as much as collisions and walls take. Grains that spin push the
 * gas along the walls by P_xy - P_yx; P_yx and P_yy are those of the wall at every height, in both engines. */
static void torques_enter_the_balance(void **state)
{
  (void)state;
  double T[2];
  for (int engine = GG_MD; engine <= GG_DSMC; engine++) {
    gg_result *r = run_of((gg_engine_kind)engine, GG_COUETTE, 0.2, 0.9, 0.2, 0.02, 0.02);
    const gg_curve *left = ct_find(&r->curves, "profile_energy_residual"), *P = ct_find(&r->curves, "profile_P_yx"),
                   *p = ct_find(&r->curves, "profile_P_yy"), *u = ct_find(&r->curves, "profile_velocity");
    const gg_curve_number wall = ct_number(u, "wall_P_yx_lower"), yy = ct_number(u, "wall_P_yy_lower");
    const double none = 0, lost = sum_of(ct_find(&r->curves, "profile_loss"));
    assert_true(ct_chi2(left, 0, left->n, level, &none) < 2);
    assert_true(ct_chi2(P, 0, P->n, level, &wall.value) < 2);
    assert_true(ct_chi2(p, 0, p->n, level, &yy.value) < 2);
    double variance = 0;
    for (size_t i = 0; i < left->n; i++) variance += pow(left->error[i], 2);
    ct_expect("sum of the residual", sum_of(left), sqrt(variance), 0, 0.1 * lost);
    const gg_estimate *balance = &r->value[GG_Q_ENERGY_BALANCE];
    ct_expect("energy balance", balance->mean, fmax(balance->error, 2e-3), 1, 0.02);
    T[engine] = r->value[GG_Q_TEMPERATURE].mean;
    print_message("# T %.5f, loss %.4g, wall %.4g\n", T[engine], lost, wall.value);
    gg_result_free(r);
  }
  assert_true(fabs(T[0] / T[1] - 1) < 0.03);
}

/* Nightly. Momentum and energy are conserved in Monte Carlo without torques, dense and dilute. */
static void monte_carlo(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_result *r = run_of(GG_DSMC, GG_COUETTE, k ? 0 : 0.2, 0.9, 0.2, 0.02, 0);
    const gg_curve *left = ct_find(&r->curves, "profile_energy_residual"), *P = ct_find(&r->curves, "profile_P_yx"),
                   *p = ct_find(&r->curves, "profile_P_yy"), *u = ct_find(&r->curves, "profile_velocity");
    const gg_curve_number yx = ct_number(u, "wall_P_yx_lower"), yy = ct_number(u, "wall_P_yy_lower");
    const double none = 0;
    assert_true(ct_chi2(left, 0, left->n, level, &none) < 2);
    assert_true(ct_chi2(P, 0, P->n, level, &yx.value) < 2);
    assert_true(ct_chi2(p, 0, p->n, level, &yy.value) < 2);
    double variance = 0;
    for (size_t i = 0; i < left->n; i++) variance += pow(left->error[i], 2);
    const double lost = sum_of(ct_find(&r->curves, "profile_loss"));
    ct_expect("sum of the residual", sum_of(left), sqrt(variance), 0, 0.1 * lost);
    gg_result_free(r);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(balances_are_exact),
                                     cmocka_unit_test(planted_grains_have_their_kinetic_fluxes),
                                     cmocka_unit_test(constant_fluxes), cmocka_unit_test(energy_balance_closes),
                                     cmocka_unit_test(torques_enter_the_balance)},
                          nightly[] = {cmocka_unit_test(monte_carlo)};
  return getenv("NIGHTLY") ? cmocka_run_group_tests(nightly, NULL, NULL) : cmocka_run_group_tests(tests, NULL, NULL);
}
