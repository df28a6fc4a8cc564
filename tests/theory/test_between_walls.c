/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hydrodynamics between walls: means over grains that arrive at a wall in
 * closed form, the equations' own limits (gas at rest, its weight, free conduction, slip and jump), balances of mass,
 * momentum and energy to 1e-8; and of moments the limit of uniform shear, and the table that they are taken from. */
#include "theory_test.h"
#include "walls_test.h"

#include "graingas.h"

#include "common/contact_value.h"
#include "theory/walls/gaussian_table.h"
#include "theory/walls/half_range.h"
#include "theory/walls/knudsen_layer.h"
#include "theory/walls/noise_free_gas.h"
#include "theory/walls/wall_condition.h"

/* Coulomb friction at a wall: no drift, in closed form with cot psi = alpha sqrt(V)/(mu (1+e) sqrt(T_n)); large
 * friction, constant beta; little friction or a fast drift, everything slides. */
static void friction_at_walls(void **state)
{
  (void)state;
  const gg_partner grain = {1, INFINITY}, wall = {INFINITY, 1};
  for (double V = 0.5; V < 2; V += 0.6) {
    const double e = 0.9, alpha = 1, mu = 0.4, Tn = 1.1, top = mu * (1 + e), G = 1.3;
    gg_contact c = gg_common_contact_make(grain, wall, e, alpha - 1, mu);
    const double psi = atan(top * sqrt(Tn) / (alpha * sqrt(V))), s = sin(psi), k = cos(psi);
    gg_half_range mean = gg_theory_half_range(&c, Tn, V, 0);
    assert_close(mean.impulse, alpha * s * s + 0.5 * top * sqrt(Tn / V) * (M_PI / 2 - psi - s * k), 1e-6);
    assert_close(mean.loss,
                 (1 - e * e) * Tn + (2 * alpha - alpha * alpha) * V * pow(s, 4) +
                     top * sqrt(Tn * V) * (M_PI / 2 - psi + 0.25 * sin(4 * psi)) - top * top * Tn * pow(k, 4),
                 1e-6);
    mean = gg_theory_half_range(&c, Tn, V, 20 * sqrt(V));
    assert_close(mean.impulse * 20 * sqrt(V), top * sqrt(M_PI * Tn / 2) * (1 - 1. / 800),
                 1e-5); /* <cos> of the drift */
    c = gg_common_contact_make(grain, wall, e, alpha - 1, 1e5);
    mean = gg_theory_half_range(&c, Tn, V, G);
    assert_close(mean.impulse, alpha, 1e-4);
    assert_close(mean.loss, (1 - e * e) * Tn + (alpha - alpha * alpha / 2) * (2 * V + G * G), 1e-4);
  }
}

/* A = 0.024, 0.084, 0.166, 0.263 at phi = 0.1 to 0.4 (from the derivative of the surface tension by differences). */
static double tension(double x)
{
  return 9 * x * x * (1 + 44. / 35 * x - 0.8 * x * x) / (2 * M_PI * pow(1 - x, 3));
}

static void adsorption_follows_from_the_wall_tension(void **state)
{
  (void)state;
  for (double x = 0.05; x < 0.5; x += 0.1) {
    const double h = 1e-5, slope = (tension(x + h) - tension(x - h)) / (2 * h);
    const double change = (1 + 4 * x + 4 * x * x - 4 * x * x * x + x * x * x * x) / pow(1 - x, 4);
    assert_close(gg_theory_wall_layer(x), x * slope / change, 1e-8);
  }
  assert_close(gg_theory_wall_layer(0.3), 0.166, 3e-3);
}

typedef struct gap {
  gg_flow flow;
  double phi, e, width;     /* width: of the box */
  double U, temperature[2]; /* 0: no thermal walls */
  double e_wall, beta_wall, g[2];
} gap;

static gg_model model_between(gap x)
{
  gg_scene s = scene_of(x.flow, x.phi, x.e, -1);
  gg_model m = model_of(&s);
  m.box[1] = x.width;
  memcpy(m.gravity, x.g, sizeof x.g);
  for (int w = 0; w < 2; w++) {
    gg_surface *wall = &m.surface[w];
    wall->velocity.x = wall->side * x.U;
    wall->temperature = x.temperature[w], wall->accommodation = x.temperature[w] > 0;
    wall->contact[0] =
        gg_common_contact_make((gg_partner){1, INFINITY}, (gg_partner){INFINITY, 1}, x.e_wall, x.beta_wall, INFINITY);
  }
  return m;
}

static const gg_theory *const ns = &gg_theory_navier_stokes, *const moments = &gg_theory_moments,
                              *const noise_free = &gg_theory_navier_stokes_hermite;

/* An elastic gas between walls of its temperature is at rest, with the pressure of Carnahan & Starling; layers at the
 * walls leave its core thinner: in 14 d, phi = 0.3, the core has 0.3091. */
static void rest_of(const gg_theory *theory, double tolerance)
{
  const gg_model m = model_between((gap){GG_FOURIER, 0.3, 1, 14, 0, {1.7, 1.7}, 1, -1, {0, 0}});
  gg_curves list = curves_of(theory, &m);
  const gg_curve *phi = find(&list, "profile_solid_fraction"), *T = find(&list, "profile_temperature");
  const double x = phi->value[phi->n / 2], Z = (1 + x + x * x - x * x * x) / pow(1 - x, 3);
  assert_close(x, 0.3091, 2e-4);
  assert_close(number_of(&list, "profile_velocity", "wall_P_yy_lower"), x * 1.7 * Z, tolerance);
  for (size_t i = 1; i + 1 < T->n; i++) assert_close(T->value[i], 1.7, tolerance);
  const double wall = gg_theory_wall_layer(x);
  assert_close((13 * x * 6 / M_PI + 2 * wall) / (m.density * 14), 1, 1e-10);
  assert_true(value_of(theory, &m, GG_Q_WALL_FRICTION) == 0);
  gg_measure_curves_clear(&list);
}

static void at_rest(void **state)
{
  (void)state;
  rest_of(ns, 1e-10), rest_of(moments, 1e-6); /* the precision of its table */
}

/* Elastic grains under gravity: T stays uniform, and the lower wall carries the weight of all. */
static void the_lower_wall_carries_the_weight(void **state)
{
  (void)state;
  const gg_model m = model_between((gap){GG_CHUTE, 0.1, 1, 28, 0, {1, 1}, 1, -0.5, {0, -0.05}});
  gg_curves list = curves_of(ns, &m);
  const gg_curve *T = find(&list, "profile_temperature"), *n = find(&list, "profile_solid_fraction");
  for (size_t i = 1; i + 1 < T->n; i++) assert_close(T->value[i], 1, 1e-9);
  const double below = number_of(&list, "profile_velocity", "wall_P_yy_lower"),
               above = number_of(&list, "profile_velocity", "wall_P_yy_upper");
  assert_close((below - above) / m.stress_unit, 0.05 * m.density * 28, 1e-9);
  assert_true(n->value[1] > 1.5 * n->value[n->n - 2]);
  gg_measure_curves_clear(&list);
}

/* Heat conduction of a dilute elastic gas: T^(3/2) is a straight line, q uniform and by Fourier's law; the jump is
 * 2.4001 sqrt(pi)/2 mean free paths over 1.0252, the ratio of the conductivity to its first approximation. */
static void conduction_of(const gg_theory *theory, double ratio, double straight, double fourier)
{
  const double width = 400, path = 1 / (sqrt(2) * M_PI);
  const gg_model m = model_between((gap){GG_FOURIER, 0, 1, width, 0, {1.1, 1}, 1, -1, {0, 0}});
  gg_curves list = curves_of(theory, &m);
  const gg_curve *T = find(&list, "profile_temperature"), *q = find(&list, "profile_q_y"),
                 *n = find(&list, "profile_solid_fraction");
  const size_t last = T->n - 1;
  const double slope = (pow(T->value[last], 1.5) - pow(T->value[0], 1.5)) / (T->x[last] - T->x[0]);
  for (size_t i = 0; i <= last; i++) {
    assert_close(pow(T->value[i], 1.5), pow(T->value[0], 1.5) + slope * (T->x[i] - T->x[0]), straight);
    assert_close(q->value[i], -75 / (64 * sqrt(M_PI)) * ratio * slope / 1.5, fourier);
  }
  const double jump = number_of(&list, "profile_temperature", "temperature_jump_upper"), gas = 1 - jump;
  const double local = path / n->value[last], gradient = slope / (1.5 * sqrt(gas));
  assert_close(jump / (gradient * sqrt(M_PI) / 2 * local), 2.4001 * ratio / 1.0252, 1e-3);
  gg_measure_curves_clear(&list);
}

static void free_conduction(void **state)
{
  (void)state;
  conduction_of(noise_free, 1.0252, 1e-9, 3e-5);
  conduction_of(ns, 1, 1e-9, 1e-8), conduction_of(moments, 1, 1e-5, 1e-4); /* the precision of its table */
}

/* Slow shear of a dilute elastic gas: slip 1.2540 sqrt(pi)/2 mean free paths, over 1.0161 likewise. */
static void slip_of(const gg_theory *theory, double ratio)
{
  const double width = 400, path = 1 / (sqrt(2) * M_PI);
  const gg_model m = model_between((gap){GG_COUETTE, 0, 1, width, 0.01, {1, 1}, 1, -1, {0, 0}});
  gg_curves list = curves_of(theory, &m);
  const gg_curve *u = find(&list, "profile_velocity");
  const double slope = (u->value[u->n - 1] - u->value[0]) / (u->x[u->n - 1] - u->x[0]);
  assert_close(number_of(&list, "profile_velocity", "slip_upper") / (slope * sqrt(M_PI) / 2 * path),
               1.2540 * ratio / 1.0161, 5e-4);
  gg_measure_curves_clear(&list);
}

static void elastic_slip_is_that_of_kinetic_theory(void **state)
{
  (void)state;
  slip_of(ns, 1), slip_of(moments, 1), slip_of(noise_free, 1.0161);
}

/* Coefficients of all densities from four solutions: those of a fifth, by its own solution. */
static void coefficients_of_four_densities_give_those_of_a_fifth(void **state)
{
  (void)state;
  const gg_quantity all[] = {GG_Q_COOLING_RATE,
                             GG_Q_VISCOSITY_REDUCED,
                             GG_Q_VISCOSITY_REDUCED_KINETIC,
                             GG_Q_THERMAL_CONDUCTIVITY_REDUCED,
                             GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC,
                             GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED};
  for (int k = 0; k < 2; k++) {
    const gg_model m = model_for(GG_HCS, k ? 0.25 : 0, 0.8, -1);
    const gg_theory_answer exact = answer_of(&gg_theory_enskog_hermite, &m);
    gg_theory_answer a;
    gg_noise_free_gas gas;
    gg_error err;
    if (gg_theory_noise_free_gas_make(&m, &gas, &err) != GG_OK) fail_msg("%s", err.message);
    gg_theory_noise_free_gas_at(&gas, &m, &a);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) assert_close(a.value[all[i]], exact.value[all[i]], 1e-6);
  }
}

/* Grains that arrive at a wall at rest carry 1/(1+e_w) of the pressure: a balance on which no condition is put. With
 * the third moment 2 q_n of normal velocities they carry 1/2 + 2/3 q_n/(sqrt(2 pi) P sqrt(T_n)) of it. This is up to
 * 0.6 if the heat flux has normal and tangential energy as 3:2. */
static void normal_momentum(void **state)
{
  (void)state;
  const gg_gap_local gas = {.n = 1, .loss = 0, .Txx = 1, .Tyy = 1, .Tzz = 1, .path = 1};
  for (double e = 0.8; e < 1.05; e += 0.1)
    for (double heat = 0.2; heat < 0.7; heat += 0.2) {
      gg_surface wall = {.side = 1};
      wall.contact[0] = gg_common_contact_make((gg_partner){1, INFINITY}, (gg_partner){INFINITY, 1}, e, 0, INFINITY);
      const gg_arrival in = {.gas = &gas, .P = 1, .T = 1, .heat = heat};
      const gg_knudsen_layer layer = gg_theory_knudsen_layer(&wall, &in, 0.5);
      const double arrives = 0.5 + 2. / 3 * layer.heat / sqrt(2 * M_PI * layer.normal);
      assert_close(arrives, 1 / (1 + e), 0.02);
      assert_close(3 * (layer.normal - 1) + 2 * (layer.tangential - 1), 0, 1e-12);
    }
}

/* Flow that is alike at both walls: slips, stresses and heat are, in moments, too, where heat flows along x. Shear
 * heats the middle; walls that heat a gas which loses energy leave it coldest. */
static void like_walls_have_like_slips_stresses_and_heat(void **state)
{
  (void)state;
  const gap driven = {GG_COUETTE, 0.1, 0.9, 17.36, 8.68, {0, 0}, 0.9, 0, {0, 0}},
            heated = {GG_FOURIER, 0.1, 0.95, 28, 0, {1, 1}, 1, -1, {0, 0}},
            pushed = {GG_POISEUILLE, 0.2, 0.9, 13.78, 0, {0, 0}, 0.9, 0.5, {1, 0}};
  const gap elastic = {GG_COUETTE, 0.1, 1, 28, 1, {1, 1}, 1, -1, {0, 0}}, all[] = {driven, heated, pushed, elastic};
  for (size_t k = 0; k < 4; k++) {
    const gg_model m = model_between(all[k]);
    gg_curves list = curves_of(moments, &m);
    const gg_curve *T = find(&list, "profile_temperature"), *tau = find(&list, "profile_P_yx");
    const size_t last = T->n - 2;
    const double sign = k == 2 ? 1 : -1, middle = T->value[T->n / 2];
    const double below = number_of(&list, "profile_velocity", "slip_lower"),
                 above = number_of(&list, "profile_velocity", "slip_upper");
    assert_true(fabs(above - sign * below) < 1e-6 * sqrt(middle));
    assert_close(number_of(&list, "profile_q_y", "wall_q_y_upper"), -number_of(&list, "profile_q_y", "wall_q_y_lower"),
                 1e-6);
    assert_close(T->value[last], T->value[1], 1e-6);
    assert_true(k == 1 || k == 2 ? middle < T->value[1] : middle > T->value[1]);
    if (k == 2) assert_close(tau->value[last], -tau->value[1], 1e-6);
    if (k == 3)
      assert_close(number_of(&list, "profile_q_y", "wall_q_y_upper"),
                   -number_of(&list, "profile_velocity", "wall_P_yx_upper"), 1e-5);
    gg_measure_curves_clear(&list);
  }
}

/* Diffuse walls at T = 1 whose speed leaves the gas uniform in T and u', at phi = 0, e = 0.9 and Kn = 0.05: the
 * stress is that of uniform shear. The speed is within 4 % of that of Monte Carlo, 5.19. */
static void uniform_temperature(void **state)
{
  (void)state;
  double U[2] = {5, 5.4}, q[2], ratio = 0;
  for (int i = 0; i < 5; i++) { /* secants */
    const gg_model m = model_between((gap){GG_COUETTE, 0, 0.9, 20 / (sqrt(2) * M_PI), U[i > 0], {1, 1}, 1, -1, {0, 0}});
    gg_curves list = curves_of(moments, &m);
    q[i > 0] = find(&list, "profile_q_y")->value[0];
    ratio = number_of(&list, "profile_velocity", "wall_P_yx_upper") /
            number_of(&list, "profile_velocity", "wall_P_yy_upper");
    gg_measure_curves_clear(&list);
    if (i == 0) continue;
    const double next = U[1] - q[1] * (U[1] - U[0]) / (q[1] - q[0]);
    U[0] = U[1], q[0] = q[1], U[1] = next;
  }
  assert_close(-ratio, 0.3618, 1e-3);
  assert_close(U[1], 5.19, 0.04);
}

static const gap flows[] = {
    {GG_COUETTE, 0.1, 0.9, 17.36, 8.68, {0, 0}, 0.9, 0, {0, 0}},
    {GG_COUETTE, 0.01, 0.7, 174, 87, {0, 0}, 0.9, 0, {0, 0}},
    {GG_COUETTE, 0.3, 0.7, 12.04, 6.02, {0, 0}, 0.9, 0, {0, 0}},
    {GG_COUETTE, 0.3, 0.9, 12.04, 6.02, {0, 0}, 0.9, 1, {0, 0}},
    {GG_FOURIER, 0.1, 0.95, 28, 0, {1, 0.5}, 1, -1, {0, 0}},
    {GG_POISEUILLE, 0.2, 0.9, 13.78, 0, {0, 0}, 0.9, 0.5, {1, 0}},
    {GG_CHUTE, 0.2, 0.9, 13.78, 0, {0, 0}, 0.9, 0, {0.1, -0.05}},
};

/* Energy (by an integral that is not the collocation's), momentum along x and across, mass: 1e-8. */
static void balances_of(const gg_theory *theory)
{
  for (size_t k = theory == noise_free ? 6 : 0; k < sizeof flows / sizeof *flows; k++) {
    const gg_model m = model_between(flows[k]);
    const double weight = m.density * m.box[1] * m.stress_unit;
    gg_curves list;
    gg_theory_answer a;
    gg_error err;
    if (gg_theory_evaluate_gap(theory, &m, GG_MEASURE_PROFILES, &a, &list, &err) != GG_OK) fail_msg("%s", err.message);
    const double P = number_of(&list, "profile_velocity", "wall_P_yy_upper");
    assert_close(a.value[GG_Q_ENERGY_BALANCE], 1, 1e-8);
    for (int axis = 0; axis < 2; axis++) {
      const char *const names[2][2] = {{"wall_P_yx_lower", "wall_P_yx_upper"}, {"wall_P_yy_lower", "wall_P_yy_upper"}};
      const double low = number_of(&list, "profile_velocity", names[axis][0]),
                   high = number_of(&list, "profile_velocity", names[axis][1]);
      assert_true(fabs(high - low - weight * m.gravity[axis]) < 1e-8 * P);
    }
    gg_measure_curves_clear(&list);
  }
}

static void mass_momentum_and_energy_balance(void **state)
{
  (void)state;
  balances_of(ns), balances_of(noise_free), balances_of(moments);
}

/* The table about a density. */
static gg_gaussian_table *table_of(double phi, double e)
{
  const gg_model m = model_for(GG_USF, phi, e, -1);
  const double n = phi > 0 ? 6 * phi / M_PI : 1;
  gg_gaussian_table *t = calloc(1, sizeof *t);
  gg_error err;
  assert_non_null(t);
  if (gg_theory_gaussian_table_make(&m, phi > 0 ? 0.4 * n : 1, phi > 0 ? 1.7 * n : 1, 1, t, &err) != GG_OK)
    fail_msg("%s", err.message);
  return t;
}

/* Shear stress over P_yy of the gas that shear heats as much as collisions cool it (S = 0): the uniform shear flow of
 * gaussian_closure, 0.2528, 0.3618, 0.6592 at phi = 0; N1 is 0.2395 at e = 0.9 (F. Vega Reyes, A. Santos & V. Garzo,
 * Phys. Rev. Lett. 104 (2010) 028001, have such flows between walls). */
static void uniform_shear(void **state)
{
  (void)state;
  const struct {
    double phi, e, ratio;
  } known[] = {{0, 0.95, 0.2528}, {0, 0.9, 0.3618}, {0, 0.7, 0.6592}, {0.1, 0.9, 0.3000}, {0.3, 0.9, 0.2796}};
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    gg_gaussian_table *t = table_of(known[k].phi, known[k].e);
    const double n = known[k].phi > 0 ? 6 * known[k].phi / M_PI : 1;
    double low = 0, high = 0, f[GG_TABLE_FUNCTIONS] = {0};
    do {
      low = high, high += 0.1 * n;
      assert_true(gg_theory_gaussian_state(t, n, high, f) < 1e-10);
    } while (f[GG_TABLE_SOURCE] < 0);
    for (int i = 0; i < 50; i++) {
      const double a = 0.5 * (low + high);
      assert_true(gg_theory_gaussian_state(t, n, a, f) < 1e-10);
      *(f[GG_TABLE_SOURCE] < 0 ? &low : &high) = a;
    }
    assert_close(low * exp(f[GG_TABLE_VISCOSITY] - f[GG_TABLE_PRESSURE]), known[k].ratio, 4e-4);
    if (k == 1) assert_close(f[GG_TABLE_XX], 0.2395, 1e-3);
    const gg_model m = model_for(GG_USF, known[k].phi, known[k].e, -1);
    const gg_theory_answer a = answer_of(&gg_theory_gaussian_closure, &m);
    assert_close(low * exp(f[GG_TABLE_VISCOSITY] - f[GG_TABLE_PRESSURE]), -a.value[GG_Q_P_YX] / a.value[GG_Q_P_YY],
                 1e-7);
    free(t);
  }
}

/* The table gives back the state from its stress: density and shear rate to 1e-5. */
static void table_of_moments(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_gaussian_table *t = table_of(k ? 0.2 : 0, 0.8);
    for (double x = 0.05; x < 1.2; x += 0.23) {
      const double n = k ? 1.3 * 1.2 / M_PI : 1, a = x * n, T = 2.3;
      double f[GG_TABLE_FUNCTIONS];
      gg_gap_local at;
      assert_true(gg_theory_gaussian_state(t, n, a, f) < 1e-10);
      const double P = n * T * exp(f[GG_TABLE_PRESSURE]), tau = n * T * a * exp(f[GG_TABLE_VISCOSITY]);
      assert_true(gg_theory_gaussian_table_local(t, P, tau, T, &at));
      assert_close(at.n, n, 1e-5);
      assert_close(at.shear, -a * sqrt(T), 1e-5);
      assert_close(-tau * at.shear - at.loss, n * n * T * sqrt(T) * f[GG_TABLE_SOURCE], 1e-4);
      assert_close(at.Tyy, T * f[GG_TABLE_MYY], 1e-5);
    }
    free(t);
  }
}

/* A scene outside of what the theory describes gives the reason. */
static void scenes_beyond_the_theory_get_the_reason(void **state)
{
  (void)state;
  const gap couette = flows[0];
  gap x = couette;
  gg_model m;
  x.beta_wall = -1, m = model_between(x), assert_refused(ns, &m, "take no momentum");
  x = couette, x.phi = 0.02, x.width = 10, m = model_between(x);
  assert_refused(ns, &m, "Kn = ");
  m = model_between(couette), m.n_surfaces = 1, assert_refused(ns, &m, "open top");
  m = model_between(couette), m.gravity[2] = 1, assert_refused(ns, &m, "gravity along z");
  m = mixture_for(GG_COUETTE, 0.1, 0.9, -1, 2, 1, 1), assert_refused(ns, &m, "one species");
  m = model_for(GG_COUETTE, 0.1, 0.9, 0.5), m.rule = GG_FRICTIONAL, assert_refused(ns, &m, "constant beta");
  m = model_for(GG_USF, 0.1, 0.9, -1), assert_refused(ns, &m, "shear between walls");
  x = couette, x.e = 1, x.e_wall = 1, x.beta_wall = 1, m = model_between(x);
  assert_refused(ns, &m, "nothing takes the heat");
  x = couette, x.U = 0, m = model_between(x), assert_refused(ns, &m, "nothing keeps the grains");
}

static void remark_of(const gg_theory *theory, const gg_model *m, char remark[GG_THEORY_REMARK])
{
  gg_theory_answer a;
  gg_error err;
  if (gg_theory_evaluate(theory, m, &a, &err) != GG_OK) fail_msg("%s", err.message);
  memcpy(remark, a.remark, GG_THEORY_REMARK);
}

/* Each remark is made where its cause is there, and only there: an elastic gas that is sheared slowly has none. */
static void a_remark_is_made_where_its_cause_is(void **state)
{
  (void)state;
  const gap calm = {GG_COUETTE, 0.3, 1, 20, 0.3, {1, 1}, 1, -1, {0, 0}};
  const gap shear = {GG_COUETTE, 0.1, 0.9, 20, 8, {0, 0}, 0.9, 1, {0, 0}};
  const gap heated = {GG_FOURIER, 0.1, 0.95, 20, 0, {1, 1.5}, 1, -1, {0, 0}};
  gap narrow = calm, lossy = shear, slippery = shear, hot = shear;
  narrow.width = 6, narrow.phi = 0.1, lossy.e = 0.65, slippery.beta_wall = -0.9, hot.beta_wall = 0;
  static const char *const causes[] = {"Kn = ",           "normal stress differences", "far from Gaussian",
                                       "thermal speeds:", "walls heat a gas",          "a wall takes heat"};
  const struct {
    gap x;
    bool of_ns[6], of_moments[6];
  } cases[] = {{calm, {0}, {0}},
               {narrow, {1}, {1}},
               {shear, {0, 1}, {0}},
               {lossy, {0, 1, 1}, {0, 0, 1}},
               {slippery, {0, 1, 0, 1, 0, 1}, {0, 0, 0, 1, 0, 1}},
               {hot, {0, 1, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 1}},
               {heated, {0, 0, 0, 0, 1}, {0, 0, 0, 0, 1}}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    const gg_model m = model_between(cases[k].x);
    char of_ns[GG_THEORY_REMARK], of_moments[GG_THEORY_REMARK];
    remark_of(ns, &m, of_ns), remark_of(moments, &m, of_moments);
    for (int c = 0; c < 6; c++) {
      if (!strstr(of_ns, causes[c]) == cases[k].of_ns[c]) fail_msg("%zu: navier_stokes: '%s': %s", k, of_ns, causes[c]);
      if (!strstr(of_moments, causes[c]) == cases[k].of_moments[c])
        fail_msg("%zu: moments: '%s': %s", k, of_moments, causes[c]);
    }
  }
}

/* Numbers of profiles against a reading of their own: the middle quarter of the slabs, and the heights without layers
 * at walls, 2.5 mean free paths at the wall or 2 diameters. */
static void middle_and_core(void **state)
{
  (void)state;
  for (int dense = 0; dense < 2; dense++) {
    const gg_model m = model_between((gap){GG_COUETTE, dense ? 0.3 : 0.05, 0.9, 40, 8, {0, 0}, 0.9, 1, {0, 0}});
    gg_curves list = curves_of(ns, &m);
    const gg_curve *phi = find(&list, "profile_solid_fraction"), *u = find(&list, "profile_velocity");
    const size_t n = u->n, from = 3 * n / 8, to = 5 * n / 8;
    double mean = 0;
    assert_int_equal(n, 80);
    for (size_t i = from; i < to; i++) mean += phi->value[i] / (double)(to - from);
    assert_close(number_of(&list, phi->name, "middle"), mean, 1e-12);
    assert_close(number_of(&list, u->name, "slope_middle"),
                 (u->value[n / 2] - u->value[n / 2 - 1]) / (u->x[1] - u->x[0]), 2e-2);
    const double x = phi->value[1], chi = (1 - x / 2) / pow(1 - x, 3), path = 1 / (6 * sqrt(2) * x * chi);
    const double layer = number_of(&list, u->name, "core_from") - 0.5;
    assert_close(layer, dense ? 2 : 2.5 * path, 2e-2);
    assert_close(number_of(&list, u->name, "core_to"), 40 - 0.5 - layer, 1e-6);
    gg_measure_curves_clear(&list);
  }
}

/* Derivative of a profile at slab i, by differences of fourth order. */
static double slope_at(const gg_curve *c, size_t i)
{
  const double *v = c->value;
  return (8 * (v[i + 1] - v[i - 1]) - v[i + 2] + v[i - 2]) / (12 * (c->x[1] - c->x[0]));
}

/* Closures at states that are read off the theory's own profiles give back its stress and heat flux; a state without
 * numbers, or beyond the contact value, has none; theories of other kinds refuse. */
static void fluxes_at_states(void **state)
{
  (void)state;
  const gg_theory *const theories[] = {ns, moments};
  for (int k = 0; k < 4; k++) {
    const gg_theory *theory = theories[k % 2];
    const bool heated = k > 1;
    const gap sheared = {GG_COUETTE, 0.1, 0.9, 20, 8, {0, 0}, 0.9, 1, {0, 0}};
    const gap hot = {GG_FOURIER, 0.3, 0.95, 20, 0, {1, 1.5}, 1, -1, {0, 0}};
    const gg_model m = model_between(heated ? hot : sheared);
    gg_curves list = curves_of(theory, &m);
    const gg_curve *phi = find(&list, "profile_solid_fraction"), *u = find(&list, "profile_velocity");
    const gg_curve *T = find(&list, "profile_temperature"), *q = find(&list, "profile_q_y");
    enum { FROM = 4, N = 32 };
    gg_local_state at[N + 2] = {{0}};
    gg_local_fluxes f[N + 2];
    for (size_t i = 0; i < N; i++) {
      const size_t s = FROM + i;
      at[i] = (gg_local_state){phi->value[s], T->value[s], slope_at(u, s), slope_at(phi, s), slope_at(T, s)};
    }
    at[N] = at[0], at[N].temperature = NAN, at[N + 1] = at[0], at[N + 1].solid_fraction = 0.9;
    gg_error err;
    if (gg_theory_fluxes(theory, &m, N + 2, at, f, &err) != GG_OK) fail_msg("%s", err.message);
    const double q_size = fabs(q->value[FROM]), P = find(&list, "profile_P_yy")->value[FROM];
    for (size_t i = 0; i < N; i++) {
      const size_t s = FROM + i;
      assert_close(f[i].P_yy, find(&list, "profile_P_yy")->value[s], 1e-4);
      assert_close(f[i].P_xx, find(&list, "profile_P_xx")->value[s], 1e-4);
      assert_close(f[i].P_zz, find(&list, "profile_P_zz")->value[s], 1e-4);
      assert_close(f[i].P_yx - P, find(&list, "profile_P_yx")->value[s] - P, 1e-4);
      assert_close(f[i].q_y + 2 * q_size, q->value[s] + 2 * q_size, 1e-3);
      assert_close(f[i].loss, -f[i].P_yx * at[i].shear_rate - slope_at(q, s), 2e-3);
    }
    assert_true(isnan(f[N].P_yy) && isnan(f[N].q_y) && isnan(f[N + 1].P_yy));
    assert_int_equal(gg_theory_fluxes(&gg_theory_lun1991, &m, N, at, f, &err), GG_BAD_INPUT);
    assert_non_null(strstr(err.message, "navier_stokes_hermite and moments"));
    gg_measure_curves_clear(&list);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(friction_at_walls),
                                     cmocka_unit_test(adsorption_follows_from_the_wall_tension),
                                     cmocka_unit_test(at_rest),
                                     cmocka_unit_test(the_lower_wall_carries_the_weight),
                                     cmocka_unit_test(free_conduction),
                                     cmocka_unit_test(elastic_slip_is_that_of_kinetic_theory),
                                     cmocka_unit_test(mass_momentum_and_energy_balance),
                                     cmocka_unit_test(coefficients_of_four_densities_give_those_of_a_fifth),
                                     cmocka_unit_test(normal_momentum),
                                     cmocka_unit_test(like_walls_have_like_slips_stresses_and_heat),
                                     cmocka_unit_test(uniform_temperature),
                                     cmocka_unit_test(uniform_shear),
                                     cmocka_unit_test(table_of_moments),
                                     cmocka_unit_test(scenes_beyond_the_theory_get_the_reason),
                                     cmocka_unit_test(a_remark_is_made_where_its_cause_is),
                                     cmocka_unit_test(middle_and_core),
                                     cmocka_unit_test(fluxes_at_states)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
