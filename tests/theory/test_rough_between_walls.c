/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hydrodynamics of rough grains between walls: means over arriving grains against draws of the engines' own rule; the
 * decay of the couple stress likewise; production by contacts against its integrals and two Maxwellians; limits
 * (equilibrium with equipartition, smooth elastic grains, spins that roll far from walls); balances to 1e-8. */
#include "theory_test.h"
#include "walls_test.h"

#include "common/rng.h"
#include "common/surface/collide.h"
#include "theory/walls/rough_gap.h"
#include "theory/walls/rough_moments.h"
#include "theory/walls/rough_wall.h"

static const gg_theory *const ns = &gg_theory_navier_stokes, *const moments = &gg_theory_moments;

typedef struct gap {
  gg_flow flow;
  double phi, e, beta, width; /* width: of the box */
  double U, temperature[2];   /* 0: no thermal walls */
  double e_wall, beta_wall, g[2];
} gap;

static void make_wall(gg_surface *wall, double inertia, const gap *x, int w)
{
  wall->velocity.x = wall->side * x->U;
  wall->temperature = x->temperature[w], wall->accommodation = x->temperature[w] > 0;
  wall->contact[0] =
      gg_common_contact_make((gg_partner){1, inertia}, (gg_partner){INFINITY, 1}, x->e_wall, x->beta_wall, INFINITY);
}

static gg_model model_between(gap x)
{
  gg_scene s = scene_of(x.flow, x.phi, x.e, x.beta);
  gg_model m = model_of(&s);
  m.box[1] = x.width;
  memcpy(m.gravity, x.g, sizeof x.g);
  for (int w = 0; w < 2; w++) make_wall(&m.surface[w], m.inertia[0], &x, w);
  return m;
}

typedef struct mean {
  double n, sum, square;
} mean;

static void count(mean *m, double x)
{
  m->n++, m->sum += x, m->square += x * x;
}

static void assert_mean(const mean *m, double factor, double value)
{
  const double mu = m->sum / m->n, error = sqrt((m->square / m->n - mu * mu) / m->n);
  if (!(fabs(factor * mu - value) < 4.5 * factor * error))
    fail_msg("%g is not %g within 4.5 x %g", factor * mu, value, factor * error);
}

/* Grains that arrive from a gas without stress and heat flux, as many as have v_n > 0. */
static void wall_rule(void **state)
{
  (void)state;
  const double T = 1.3, theta = 0.7, omega = 1.1, K = 0.4, slip = -0.9, P = 1;
  const gg_gap_local gas = {.Txx = T, .Tyy = T, .Tzz = T};
  for (int w = 0; w < 4; w++) {
    const gap x = {.e_wall = 0.8, .beta_wall = 0.3, .temperature = {w / 2 * 0.6, w / 2 * 0.6}};
    gg_surface wall = {.side = w % 2 ? 1 : -1, .axis = 1};
    make_wall(&wall, K, &x, w % 2);
    const gg_rough_arrival in = {
        .centres = {.gas = &gas, .P = P, .T = T, .slip = slip}, .K = K, .theta = theta, .omega = omega};
    const gg_rough_takes takes = gg_theory_rough_wall_takes(&wall, &in);
    const double J = P / sqrt(2 * M_PI * T);
    mean momentum = {0}, couple = {0}, translation = {0}, rotation = {0};
    gg_rng rng = gg_common_rng_seed(7 + (uint64_t)w, 0);
    for (int i = 0; i < 200000; i++) {
      const gg_vec k = {0, wall.side, 0}, r = gg_common_rng_normal_vec(&rng);
      const double other = gg_common_rng_normal(&rng), normal = sqrt(T * (r.y * r.y + other * other));
      gg_vec v = {slip + sqrt(T) * r.x, wall.side * normal, sqrt(T) * r.z};
      gg_vec s = gg_scale(sqrt(theta / K), gg_common_rng_normal_vec(&rng));
      s.z += omega / 2;
      const gg_vec v0 = v, s0 = s;
      gg_surface_collide(GG_ROUGH, &wall, &wall.contact[0], &rng, k, &v, &s);
      count(&momentum, v0.x - v.x), count(&couple, K / 2 * (s0.z - s.z));
      count(&translation, 0.5 * (gg_dot(v0, v0) - gg_dot(v, v)));
      count(&rotation, 0.5 * K * (gg_dot(s0, s0) - gg_dot(s, s)));
    }
    assert_mean(&momentum, J, takes.momentum), assert_mean(&couple, J, takes.couple);
    assert_mean(&translation, J, takes.translation), assert_mean(&rotation, J, takes.rotation);
  }
}

/* d<C_y s_z>/dt = -nu_s <C_y s_z>, nu_s = 4/3 sqrt(pi T) n chi (2 + e + beta), at any theta. */
static void couple_decay(void **state)
{
  (void)state;
  const double K = 0.4, T = 1.7, part = 0.3;
  for (int c = 0; c < 3; c++) {
    const double e = c == 1 ? 0.6 : 0.9, beta = c == 2 ? 0.8 : 0, theta = c == 1 ? 0.2 : 1.1;
    const gg_contact contact = gg_common_contact_make((gg_partner){1, K}, (gg_partner){1, K}, e, beta, INFINITY);
    mean change = {0};
    gg_rng rng = gg_common_rng_seed(11 + (uint64_t)c, 0);
    for (int i = 0; i < 200000; i++) {
      gg_vec v[2], s[2], k = gg_common_rng_normal_vec(&rng);
      k = gg_scale(1 / sqrt(gg_dot(k, k)), k);
      for (int j = 0; j < 2; j++) {
        v[j] = gg_scale(sqrt(T), gg_common_rng_normal_vec(&rng));
        s[j] = gg_scale(sqrt(theta / K), gg_common_rng_normal_vec(&rng));
        s[j].z += part * v[j].y;
      }
      const double before = v[0].y * s[0].z, u = gg_dot(k, gg_sub(v[0], v[1])), rate = fmax(u, 0);
      const gg_vec g = gg_contact_velocity(GG_ROUGH, k, gg_sub(v[0], v[1]), s[0], s[1]);
      gg_kick(GG_ROUGH, &contact, k, gg_impulse(GG_ROUGH, &contact, k, g, gg_dot(k, g)), &v[0], &s[0], &v[1], &s[1]);
      count(&change, -rate * (v[0].y * s[0].z - before));
    }
    gg_rough_fluid gas;
    const gg_model m = model_for(GG_USF, 0.1, e, beta);
    gg_theory_rough_fluid_make(&m, &gas);
    const double chi = gas.density.model.chi[0], n = m.density;
    const double rate = 0.25 * K * n * T / gg_theory_rough_fluid_turning(&gas, T, T) / (n * chi);
    assert_mean(&change, 4 * M_PI / (part * T), rate);
    assert_close(rate, 4. / 3 * sqrt(M_PI * T) * (2 + e + beta), 1e-12);
  }
}

/* The fitted series against the integrals; and, at rest, two Maxwellians. */
static void fitted_contacts_are_the_integrals(void **state)
{
  (void)state;
  const gg_contact_point at[] = {
      {0, 0, 0, 0}, {0.2, -0.1, -0.3, 0.8}, {0.1, -0.1, -0.2, 1.6}, {0.4, -0.25, -0.45, 0.5}};
  for (int c = 0; c < 3; c++) {
    const double e = c ? 0.9 : 0.7, beta = c == 1 ? -0.4 : 0.8, r = 0.6;
    const gg_model m = model_for(GG_USF, 0.2, e, beta);
    gg_model one;
    gg_theory_rough_contacts_model(&m, &one);
    gg_rough_contacts *f = calloc(1, sizeof *f);
    gg_contact_series series;
    double value[GG_CONTACT_FUNCTIONS], exact[GG_CONTACT_FUNCTIONS];
    assert_int_equal(gg_theory_rough_contacts_make(&m, f, NULL), GG_OK);
    gg_theory_rough_contacts_at(f, r, series);
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
      gg_theory_rough_contacts_value((const double(*)[GG_CONTACT_MONOMIALS])series, at[k], value);
      gg_theory_rough_contacts_integral(&one, at[k], r, exact);
      for (int q = 0; q < GG_CONTACT_FUNCTIONS; q++) assert_true(fabs(value[q] - exact[q]) < 0.01);
    }
    const gg_lun_functions lun = gg_theory_lun_functions_at((gg_lun_state){1, 0.2, 1, gg_theory_grain_of(&m), r});
    gg_theory_rough_contacts_integral(&one, at[0], r, exact);
    assert_close(-0.5 * (exact[GG_CONTACT_XX] + exact[GG_CONTACT_YY] + exact[GG_CONTACT_ZZ]), lun.f5, 1e-10);
    assert_close(exact[GG_CONTACT_LOSS], lun.f5 - lun.f5r, 1e-10);
    free(f);
  }
}

/* Elastic, perfectly rough grains between walls of their temperature: equipartition, Carnahan & Starling's pressure. */
static void elastic_rough_gases_have_equipartition(void **state)
{
  (void)state;
  const gg_theory *const theory[] = {ns, moments};
  const gg_model m = model_between((gap){GG_FOURIER, 0.2, 1, 1, 16, 0, {1.7, 1.7}, 1, -1, {0, 0}});
  for (int k = 0; k < 2; k++) {
    const double tolerance = k ? 3e-3 : 1e-9; /* the precision of the fitted series */
    gg_curves list = curves_of(theory[k], &m);
    const gg_curve *T = find(&list, "profile_temperature"), *theta = find(&list, "profile_rotational_temperature"),
                   *spin = find(&list, "profile_spin_z"), *phi = find(&list, "profile_solid_fraction");
    for (size_t i = 1; i + 1 < T->n; i++) {
      const double x = phi->value[i], Z = (1 + x + x * x - x * x * x) / pow(1 - x, 3);
      assert_close(T->value[i], 1.7, tolerance);
      assert_close(theta->value[i], 1.7, tolerance);
      assert_true(fabs(spin->value[i]) < 1e-9);
      assert_close(number_of(&list, "profile_velocity", "wall_P_yy_upper"), x * 1.7 * Z, tolerance);
    }
    assert_close(value_of(theory[k], &m, GG_Q_TEMPERATURE_RATIO), 1, tolerance);
    gg_measure_curves_clear(&list);
  }
}

/* Grains that are hardly rough, elastic as smooth: the smooth gap. */
static void smooth_limit(void **state)
{
  (void)state;
  gap x = {GG_COUETTE, 0.1, 1, -1 + 1e-8, 20, 8, {1, 1}, 1, -1, {0, 0}};
  const gg_model rough = model_between(x);
  x.beta = -1;
  const gg_model smooth = model_between(x);
  assert_int_equal(rough.rule, GG_ROUGH);
  assert_int_equal(smooth.rule, GG_SMOOTH);
  const gg_quantity same[] = {GG_Q_TEMPERATURE, GG_Q_P_YY, GG_Q_P_YX, GG_Q_WALL_DISSIPATION};
  for (int k = 0; k < 4; k++) assert_close(value_of(ns, &rough, same[k]), value_of(ns, &smooth, same[k]), 1e-6);
}

/* Far from walls spins roll with the flow. Both walls act alike. */
static void spins_roll_with_the_flow_far_from_walls(void **state)
{
  (void)state;
  const gg_model m = model_between((gap){GG_COUETTE, 0.2, 0.95, 0.5, 30, 15, {0, 0}, 0.9, 0.2, {0, 0}});
  const gg_theory *const theory[] = {ns, moments};
  for (int k = 0; k < 2; k++) {
    gg_curves list = curves_of(theory[k], &m);
    const gg_curve *u = find(&list, "profile_velocity"), *spin = find(&list, "profile_spin_z");
    const size_t i = u->n / 2;
    const double shear = (u->value[i] - u->value[i - 1]) / (u->x[i] - u->x[i - 1]);
    const double middle = 0.5 * (spin->value[i] + spin->value[i - 1]);
    assert_close(middle, -0.5 * shear, k ? 0.03 : 3e-3); /* slabs; anisotropic grains turn a little otherwise */
    assert_close(number_of(&list, "profile_velocity", "slip_upper"),
                 -number_of(&list, "profile_velocity", "slip_lower"), 1e-7);
    gg_measure_curves_clear(&list);
  }
}

/* The integral of the torque over the gap, by Gauss's formula of three points in each interval. */
static double torque(const gg_gap_flow *flow)
{
  const double place[] = {-0.774596669241483377, 0, 0.774596669241483377}, weight[] = {5. / 18, 4. / 9, 5. / 18};
  const gg_boundary_solution *s = &flow->solution;
  double sum = 0;
  for (int i = 0; i + 1 < s->points; i++)
    for (int k = 0; k < 3; k++) {
      const double h = s->y[i + 1] - s->y[i];
      const gg_rough_height at = gg_theory_rough_gap_at(flow, s->y[i] + 0.5 * h * (1 + place[k]));
      sum += h * weight[k] * (at.state.tau - at.P_xy);
    }
  return sum;
}

/* The torque on grains in layers at a wall, as on those of the gas there. */
static double layer_couple(const gg_gap_flow *flow, int w)
{
  const gg_rough_height at = gg_theory_rough_gap_at(flow, w ? flow->gap.high : flow->gap.low);
  return gg_theory_wall_layer(at.local.gas.phi) / at.local.gas.n * at.local.torque;
}

static const gap flows[] = {
    {GG_COUETTE, 0.1, 0.95, 0.8, 17.36, 8.68, {0, 0}, 0.9, 1, {0, 0}},
    {GG_COUETTE, 0.3, 0.9, 0, 12.04, 6.02, {0, 0}, 0.9, 1, {0, 0}},
    {GG_COUETTE, 0.01, 0.9, 0, 174, 87, {0, 0}, 0.9, 0, {0, 0}},
    {GG_COUETTE, 0.1, 0.95, 0, 17.36, 8.68, {2, 2}, 1, -1, {0, 0}},
    {GG_FOURIER, 0.1, 0.95, 0.8, 28, 0, {1, 0.5}, 1, -1, {0, 0}},
    {GG_FOURIER, 0.1, 1, 1, 28, 0, {1, 0.5}, 1, -1, {0, 0}},          /* elastic: no loss, whatever the fit */
    {GG_POISEUILLE, 0.2, 0.9, 0, 13.78, 0, {0, 0}, 0.9, 0.5, {1, 0}}, /* navier_stokes alone */
};

/* Energy, momentum along x and across, and angular momentum of spins: 1e-8. Rough walls: M = -s P_yx/2. */
static void energy_momentum_and_spin_balance(void **state)
{
  (void)state;
  const size_t all = sizeof flows / sizeof *flows;
  gg_rough_moments *gas = calloc(1, sizeof *gas);
  gg_gap_flow *flow = calloc(1, sizeof *flow);
  for (size_t k = 0; k < all; k++)
    for (int theory = 0; theory < (k + 1 < all ? 2 : 1); theory++) {
      const gg_model m = model_between(flows[k]);
      gg_error err;
      if (theory)
        assert_int_equal(gg_theory_rough_moments_make(&m, gas, &err), GG_OK);
      else
        memset(flow, 0, sizeof *flow), gg_theory_rough_fluid_make(&m, &gas->gas);
      if (gg_theory_rough_gap_solve(&m, &gas->gas, "test", flow, &err) != GG_OK) fail_msg("%s", err.message);
      const gg_gap_wall *w = flow->wall;
      const double weight = m.density * m.box[1], unit = fmax(flow->loss, fmax(fabs(flow->work), fabs(w[1].heat)));
      assert_true(fabs(flow->work - flow->loss - w[0].heat - w[1].heat) < 1e-8 * unit);
      assert_true(fabs(w[1].tau - w[0].tau - weight * m.gravity[0]) < 1e-8 * w[0].P);
      assert_close(w[1].P, w[0].P, 1e-8);
      const double *low = flow->solution.v[0], *high = flow->solution.v[flow->solution.points - 1];
      const double M[2] = {low[GG_ROUGH_M], high[GG_ROUGH_M]};
      assert_true(fabs(M[1] - M[0] - torque(flow)) < 1e-8 * w[0].P);
      if (flows[k].temperature[0] > 0) continue;
      assert_true(fabs(M[1] + layer_couple(flow, 1) + 0.5 * high[GG_GAP_TAU]) < 1e-9 * w[0].P);
      assert_true(fabs(M[0] - layer_couple(flow, 0) - 0.5 * low[GG_GAP_TAU]) < 1e-9 * w[0].P);
    }
  free(gas), free(flow);
}

static void scenes_beyond_the_theory_get_the_reason(void **state)
{
  (void)state;
  gg_model m = model_between(flows[0]);
  m.surface[1].contact[0].mu = 0.3, assert_refused(ns, &m, "walls have friction");
  m = model_between(flows[0]), m.rule = GG_FRICTIONAL, assert_refused(moments, &m, "constant beta");
  gap x = flows[0];
  x.beta_wall = -1, m = model_between(x), assert_refused(ns, &m, "take no momentum");
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(wall_rule),
                                     cmocka_unit_test(couple_decay),
                                     cmocka_unit_test(fitted_contacts_are_the_integrals),
                                     cmocka_unit_test(elastic_rough_gases_have_equipartition),
                                     cmocka_unit_test(smooth_limit),
                                     cmocka_unit_test(spins_roll_with_the_flow_far_from_walls),
                                     cmocka_unit_test(energy_momentum_and_spin_balance),
                                     cmocka_unit_test(scenes_beyond_the_theory_get_the_reason)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
