/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/model.h"

#include <math.h>

#include "common/contact_value.h"
#include "common/portable_math.h"
#include "common/thermostat.h"

/* <d^p> over all grains. */
static double mean_power(const gg_model *m, int p)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += m->fraction[i] * gg_power(m->diameter[i], p);
  return sum;
}

void gg_common_model_set_size(gg_model *m, double phi, const double aspect[3])
{
  m->phi = phi;
  m->boltzmann = phi == 0;
  m->density = m->boltzmann ? 1 : 6 * phi / (M_PI * mean_power(m, 3));
  for (int i = 0; i < m->n_species; i++) m->number_density[i] = gg_model_part(m, m->density, i);
  m->volume = (double)m->n / m->density;
  double shape = aspect[0] * aspect[1] * aspect[2];
  for (int a = 0; a < 3; a++) m->box[a] = aspect[a] * gg_root(m->volume / shape, 3);
  m->length = cbrt(m->volume);
}

static double chi_of(const gg_model *m, int i, int j)
{
  if (m->boltzmann) return 1;
  if (m->n_species == 1) return gg_common_contact_value_of(m->contact_value, m->phi);
  double phi_hat = M_PI / 6 * m->density * mean_power(m, 2);
  double d_red = 2 * m->diameter[i] * m->diameter[j] / (m->diameter[i] + m->diameter[j]);
  return gg_common_contact_value_mixture(m->phi, phi_hat, d_red);
}

/* Central difference: its error is 1e-10 below random close packing. */
static double chi_slope_of(const gg_model *m)
{
  const double h = 1e-5;
  if (m->boltzmann || m->n_species > 1) return 0;
  return log(gg_common_contact_value_of(m->contact_value, m->phi * (1 + h)) /
             gg_common_contact_value_of(m->contact_value, m->phi * (1 - h))) /
         (2 * h);
}

static void set_kicks(const gg_model *m, int o, gg_contact *contact)
{
  double D[GG_N_KICKS];
  for (int k = 0; k < GG_N_KICKS; k++) D[k] = m->kick[k][o];
  if (m->kicks) gg_common_contact_set_kicks(contact, m->rule != GG_SMOOTH, D);
}

static void set_restitution(gg_model *m, int i, int j, double e)
{
  int o = gg_pair(i, j);
  gg_partner one = {m->mass[i], m->inertia[i]}, two = {m->mass[j], m->inertia[j]};
  m->contact[i][j] = gg_common_contact_make(one, two, e, m->beta[o], m->mu[o]);
  set_kicks(m, o, &m->contact[i][j]);
  m->e[o] = e;
}

void gg_common_model_name_law(gg_model *m)
{
  static const char *const names[GG_N_COEFFICIENTS] = {"e(v)", "beta(v)", "mu(v)"};
  for (int c = GG_N_COEFFICIENTS - 1; c >= 0; c--)
    if (gg_common_speed_laws_have(&m->by_speed, (gg_contact_coefficient)c, gg_pairs_of(m->n_species)))
      m->law.name = names[c];
}

/* Set the coefficients of a pair that depend on the speed. */
static void set_by_speed(gg_model *m, int i, int j, double speed)
{
  const int o = gg_pair(i, j);
  double *const coefficient[GG_N_COEFFICIENTS] = {&m->e[o], &m->beta[o], &m->mu[o]};
  gg_speed_law law;
  for (int c = 0; c < GG_N_COEFFICIENTS; c++) {
    const char *text = gg_speed_law_text(&m->by_speed, (gg_contact_coefficient)c, o);
    if (text && gg_common_speed_law_parse(&law, (gg_contact_coefficient)c, text, NULL) == GG_OK)
      *coefficient[c] = gg_common_speed_law_value(&law, m->speed_unit * speed, NULL);
  }
  /* Estimates and starts of theories divide by the friction, which is none at some speeds alone. */
  if (m->by_speed.at[GG_OF_BETA][o]) m->beta[o] = fmax(m->beta[o], -1 + 1e-6);
  if (m->by_speed.at[GG_OF_MU][o]) m->mu[o] = fmax(m->mu[o], 1e-6);
  set_restitution(m, i, j, m->e[o]);
}

void gg_common_model_at(gg_model *m, double T)
{
  for (int i = 0; m->law.name && i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      double speed = sqrt(M_PI / 2 * T * (1 / m->mass[i] + 1 / m->mass[j]));
      if (m->law.e || m->law.kind != GG_LAW_CONSTANT)
        set_restitution(m, i, j, gg_common_law_at(&m->law, speed, i, j, NULL));
      else
        set_by_speed(m, i, j, speed);
    }
}

/* True if some pair has a kick that singles out the z axis. */
static bool has_turning_kicks(const gg_model *m)
{
  bool turned = false;
  for (int k = 0; k < GG_N_KICKS; k++)
    for (int o = 0; o < gg_pairs_of(m->n_species); o++)
      turned |= gg_common_kick_turns((gg_kick_kind)k) && m->kick[k][o] != 0;
  return turned;
}

bool gg_common_model_is_turned(const gg_model *m)
{
  return m->turns || has_turning_kicks(m);
}

/* Spins of rough grains take up tangential kicks until friction cancels these, and no energy comes in; with Coulomb
 * friction they may grow for ever. Normal kicks or another source of energy keep the gas warm. */
static bool kicks_fade(const gg_model *m)
{
  bool fade = m->kicks && m->rule != GG_SMOOTH && m->shear_rate == 0 && !m->walled && !m->bath.on && !m->turns;
  for (int o = 0; o < gg_pairs_of(m->n_species); o++) fade &= m->kick[GG_NORMAL_KICK][o] == 0;
  return fade;
}

/* True if friction with other grains, or the bath, holds the spin of a species. */
static bool is_held(const gg_model *m, int i)
{
  bool held = m->bath.spin_drag[i] > 0;
  for (int j = 0; j < m->n_species; j++) held |= gg_model_pair_rule(m, gg_pair(i, j)) != GG_SMOOTH;
  return held;
}

/* True if some wall takes energy: one of a temperature, or whose contacts are not elastic. */
static bool walls_lose(const gg_model *m)
{
  bool lose = gg_model_has_thermal_walls(m);
  for (int w = 0; w < m->n_surfaces; w++) {
    const gg_contact *c = &m->surface[w].contact[0];
    const double normal = c->jn * gg_inverse_mr(c), tangential = c->jt * gg_inverse_mt(c); /* 1 + e, 1 + beta */
    lose |= normal < 2 - 1e-12 || (tangential > 0 && (tangential < 2 - 1e-12 || isfinite(c->mu)));
  }
  return lose;
}

bool gg_common_model_balances(const gg_model *m)
{
  bool loses = walls_lose(m) || m->bath.drag[0] > 0, held = true;
  for (int i = 0; i < m->n_species; i++) {
    held &= m->torque[i] == 0 || is_held(m, i);
    for (int j = 0; j < m->n_species; j++) loses |= gg_common_pair_loses(m, i, j);
  }
  return held && !kicks_fade(m) && (loses || !(gg_flow_is_sheared(m->flow) || gg_model_is_injected(m)));
}

static gg_rule later_rule(gg_rule a, gg_rule b)
{
  return a > b ? a : b;
}

double gg_common_treated_beta(const gg_model *m, int i, int j)
{
  double beta = m->beta[gg_pair(i, j)];
  return i == j || beta == 1 ? beta : -1;
}

bool gg_common_pair_loses(const gg_model *m, int i, int j)
{
  const int o = gg_pair(i, j);
  const gg_rule rule = gg_model_pair_rule(m, o);
  const bool loses = m->by_speed.at[GG_OF_E][o] ? m->by_speed.loses : m->e[o] != 1;
  return loses || m->law.e || rule == GG_FRICTIONAL ||
         (rule == GG_ROUGH && (m->by_speed.at[GG_OF_BETA][o] || m->beta[o] < 1));
}

void gg_common_model_set_pairs(gg_model *m)
{
  m->rule = GG_SMOOTH;
  m->elastic = true;
  m->kicks = false;
  for (int o = 0; o < gg_pairs_of(m->n_species); o++) {
    m->rule = later_rule(m->rule, gg_model_pair_rule(m, o));
    if (m->by_speed.at[GG_OF_E][o]) m->elastic = false;
    for (int k = 0; k < GG_N_KICKS; k++)
      if (m->kick[k][o] != 0) m->kicks = true, m->elastic = false;
  }
  m->chi_slope = chi_slope_of(m);
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int o = gg_pair(i, j);
      gg_partner one = {m->mass[i], m->inertia[i]}, two = {m->mass[j], m->inertia[j]};
      set_restitution(m, i, j, m->e[o]);
      m->treated[i][j] =
          gg_common_contact_make(one, two, 1, gg_common_treated_beta(m, i, j), i == j ? m->mu[o] : INFINITY);
      m->sigma[o] = (m->diameter[i] + m->diameter[j]) / 2;
      m->chi[o] = chi_of(m, i, j);
      set_kicks(m, o, &m->treated[i][j]);
      if (gg_common_pair_loses(m, i, j)) m->elastic = false;
    }
}

gg_status gg_common_model_set_walls(gg_model *m, const gg_walls *walls, gg_error *err)
{
  bool spinless = m->rule == GG_SMOOTH;
  m->elastic_grains = m->elastic;
  GG_TRY(gg_common_surfaces_make(m, walls, !spinless, err));
  m->walled = m->n_surfaces > 0;
  m->wall_rule = m->walled ? gg_common_rule_select(walls->beta, walls->mu) : GG_SMOOTH;
  bool lossy = m->wall_rule == GG_FRICTIONAL || (m->wall_rule == GG_ROUGH && walls->beta < 1);
  if (m->walled && m->surface[0].accommodation < 1 && (walls->e < 1 || lossy)) m->elastic = false;
  if (!spinless) m->rule = later_rule(m->rule, m->wall_rule);
  return GG_OK;
}

/* Steady temperature in units of (d rate)^2 from the balance of dilute viscous heating and dissipation, to start near.
 */
static double guess_sheared_temperature(const gg_model *m)
{
  double e = m->e[0], rough = m->rule == GG_SMOOTH ? 0 : (1 - m->beta[0] * m->beta[0]) * m->inertia[0];
  double loss = fmax(1 - e * e + 0.5 * rough, 0.01);
  double freq = m->density * m->chi[0]; /* n d^2 chi */
  double dilute = 0.4 / (loss * freq * freq), dense = 0.4 / loss;
  return (m->boltzmann ? dilute : dilute + dense) * (m->shear_rate != 0 ? m->shear_rate * m->shear_rate : 1);
}

/* Temperature of a gas that thermal walls alone warm and nothing cools: the geometric mean of theirs, at which free
 * flights from wall to wall bring as much energy as they take. 0 without such walls. */
static double temperature_of_walls(const gg_model *m)
{
  double product = 1;
  if (!gg_model_has_thermal_walls(m)) return 0;
  for (int w = 0; w < m->n_surfaces; w++) product *= m->surface[w].temperature;
  return m->n_surfaces > 1 ? sqrt(product) : product;
}

static double guess_unbathed_temperature(const gg_model *m)
{
  const double walls = temperature_of_walls(m);
  const double g = sqrt(m->gravity[0] * m->gravity[0] + m->gravity[1] * m->gravity[1] + m->gravity[2] * m->gravity[2]),
               fall = g / 2; /* of grains that fell by a diameter */
  if (gg_flow_is_timed_by_shear(m->flow)) return fmax(guess_sheared_temperature(m), walls);
  return walls > 0 ? walls : fall > 0 ? fall : 0.5;
}

/* theta/T where rotational energy neither grows nor decays (Gayen's thesis, eq. 5.13). */
static double guess_ratio(const gg_model *m)
{
  if (m->rule == GG_SMOOTH) return 0;
  double K = m->inertia[0], beta = m->rule == GG_FRICTIONAL ? fmin(m->beta[0], 0) : m->beta[0];
  return K * (1 + beta) / (1 + 2 * K - beta);
}

void gg_common_model_set_start(gg_model *m, double temperature)
{
  const bool sheared = gg_flow_is_sheared(m->flow);
  m->ratio0 = guess_ratio(m);
  /* With a restitution law, temperature and mean impact speed depend on each other. */
  for (int round = 0; round < (m->law.name ? 5 : 1); round++) {
    m->temperature0 = guess_unbathed_temperature(m);
    if (m->bath.on || ((m->kicks || m->turns) && !m->walled))
      m->temperature0 = gg_common_thermostat_balance(m, sheared ? m->temperature0 : 0);
    if (temperature != GG_AUTO) m->temperature0 = temperature;
    gg_common_model_at(m, m->temperature0);
  }
  m->spin0 = 2 * gg_model_rolling(m, 0);
  m->steady = !m->linear_response && gg_common_model_balances(m);
  m->stress_unit = m->boltzmann ? 1 : M_PI / 6;
}

const char *gg_common_model_contact_unit(const gg_model *m)
{
  return m->gravity[1] != 0 ? "sqrt(d/g), or mean free times where gravity is weak" : "mean free times";
}

double gg_common_model_widest(const gg_model *m)
{
  double widest = m->diameter[0];
  for (int i = 1; i < m->n_species; i++) widest = fmax(widest, m->diameter[i]);
  return widest;
}

double gg_common_model_narrowest(const gg_model *m)
{
  double narrowest = m->diameter[0];
  for (int i = 1; i < m->n_species; i++) narrowest = fmin(narrowest, m->diameter[i]);
  return narrowest;
}
