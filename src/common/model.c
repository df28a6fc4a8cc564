/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/model.h"

#include <math.h>

#include "common/contact_value.h"
#include "common/ensemble_size.h"
#include "common/portable_math.h"
#include "common/thermostat.h"

/* Whole numbers of grains: the largest remainders go up, of equal ones the first. */
static void deal_grains(gg_model *m, const gg_scene *s)
{
  double total = 0, remainder[GG_MAX_SPECIES];
  for (int i = 0; i < m->n_species; i++) total += s->species[i].fraction;
  int64_t left = m->n;
  for (int i = 0; i < m->n_species; i++) {
    double share = (double)m->n * s->species[i].fraction / total;
    m->n_of[i] = (int64_t)floor(share * (1 + 1e-15));
    remainder[i] = share - (double)m->n_of[i];
    left -= m->n_of[i];
  }
  for (; left > 0; left--) {
    int next = 0;
    for (int i = 1; i < m->n_species; i++)
      if (remainder[i] > remainder[next]) next = i;
    m->n_of[next]++;
    remainder[next] = -1;
  }
}

static gg_status check_grains(const gg_model *m, const gg_scene *s, gg_error *err)
{
  for (int i = 0; m->n_species > 1 && i < m->n_species; i++)
    if (m->n_of[i] < 2)
      return gg_base_fail(
          err, GG_BAD_INPUT,
          "species: the fraction %g of species %d is %lld of %lld grains; each species needs two: give %s a "
          "larger value",
          s->species[i].fraction, i + 1, (long long)m->n_of[i], (long long)m->n,
          m->ensemble ? "dsmc.particles" : "particles");
  return GG_OK;
}

/* Theories alone (not `counted`) have no grains. */
static void set_fractions(gg_model *m, const gg_scene *s, bool counted)
{
  double total = 0;
  if (counted) deal_grains(m, s);
  for (int i = 0; i < m->n_species; i++) total += s->species[i].fraction;
  for (int i = 0; i < m->n_species; i++)
    m->fraction[i] = counted ? (double)m->n_of[i] / (double)m->n : s->species[i].fraction / total;
}

static void set_composition(gg_model *m, const gg_scene *s, bool counted)
{
  const gg_species *one = &s->species[0];
  m->n_species = s->n_species;
  set_fractions(m, s, counted);
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    const gg_species *sp = &s->species[i < s->n_species ? i : 0];
    m->diameter[i] = sp->diameter / one->diameter;
    m->mass[i] = sp->mass / one->mass;
    m->inertia[i] = sp->inertia;
  }
}

/* <d^p> over all grains. */
static double mean_power(const gg_model *m, int p)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += m->fraction[i] * gg_power(m->diameter[i], p);
  return sum;
}

static void set_size(gg_model *m, const gg_scene *s)
{
  m->phi = s->phi;
  m->boltzmann = s->phi == 0;
  m->density = m->boltzmann ? 1 : 6 * s->phi / (M_PI * mean_power(m, 3));
  for (int i = 0; i < m->n_species; i++) m->number_density[i] = gg_model_part(m, m->density, i);
  m->volume = (double)m->n / m->density;
  double shape = s->aspect[0] * s->aspect[1] * s->aspect[2];
  for (int a = 0; a < 3; a++) m->box[a] = s->aspect[a] * gg_root(m->volume / shape, 3);
  m->length = cbrt(m->volume);
}

/* Between walls Monte Carlo has the gap that `particles` grains have in md, to the last bit, and more area. */
static void set_box(gg_model *m, const gg_scene *s)
{
  gg_model md = {.n = s->particles};
  set_size(m, s);
  if (!m->ensemble || !gg_flow_is_walled(s->flow)) return;
  set_composition(&md, s, true);
  set_size(&md, s);
  for (int a = 0; a < 3; a++) m->box[a] = md.box[a] * (a == 1 ? 1 : sqrt(m->volume / md.volume));
  m->length = md.length;
}

static void set_units(gg_model *m, const gg_scene *s)
{
  const gg_species *one = &s->species[0];
  m->unit = (gg_units){one->diameter, one->mass, 1 / gg_scene_clock_rate(s)};
  if (gg_flow_has_moving_walls(s->flow)) m->unit.time = m->box[1] * one->diameter / (2 * s->walls.speed);
}

static double chi_of(const gg_model *m, const gg_scene *s, int i, int j)
{
  if (m->boltzmann) return 1;
  if (m->n_species == 1) return gg_common_contact_value_of(s->contact_value, m->phi);
  double phi_hat = M_PI / 6 * m->density * mean_power(m, 2);
  double d_red = 2 * m->diameter[i] * m->diameter[j] / (m->diameter[i] + m->diameter[j]);
  return gg_common_contact_value_mixture(m->phi, phi_hat, d_red);
}

/* Central difference: its error is 1e-10 below random close packing. */
static double chi_slope_of(const gg_model *m, const gg_scene *s)
{
  const double h = 1e-5;
  if (m->boltzmann || m->n_species > 1) return 0;
  return log(gg_common_contact_value_of(s->contact_value, m->phi * (1 + h)) /
             gg_common_contact_value_of(s->contact_value, m->phi * (1 - h))) /
         (2 * h);
}

static void set_restitution(gg_model *m, int i, int j, double e)
{
  int o = gg_pair(i, j);
  gg_partner one = {m->mass[i], m->inertia[i]}, two = {m->mass[j], m->inertia[j]};
  m->contact[i][j] = gg_common_contact_make(one, two, e, m->beta[o], m->mu[o]);
  m->e[o] = e;
}

void gg_common_model_at(gg_model *m, double T)
{
  for (int i = 0; m->law.name && i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      double speed = sqrt(M_PI / 2 * T * (1 / m->mass[i] + 1 / m->mass[j]));
      set_restitution(m, i, j, gg_common_law_at(&m->law, speed, i, j, NULL));
    }
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
  const gg_rule rule = gg_common_rule_select(m->beta[o], m->mu[o]);
  return m->e[o] < 1 || m->law.e || rule == GG_FRICTIONAL || (rule == GG_ROUGH && m->beta[o] < 1);
}

static void set_pairs(gg_model *m, const gg_scene *s)
{
  m->rule = GG_SMOOTH;
  m->elastic = true;
  m->chi_slope = chi_slope_of(m, s);
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int o = gg_pair(i, j);
      double e = s->collision.e[o], beta = s->collision.beta[o], mu = s->collision.mu[o];
      gg_partner one = {m->mass[i], m->inertia[i]}, two = {m->mass[j], m->inertia[j]};
      m->beta[o] = beta, m->mu[o] = mu;
      set_restitution(m, i, j, e);
      m->treated[i][j] = gg_common_contact_make(one, two, 1, gg_common_treated_beta(m, i, j), i == j ? mu : INFINITY);
      m->sigma[o] = (m->diameter[i] + m->diameter[j]) / 2;
      m->chi[o] = chi_of(m, s, i, j);
      m->rule = later_rule(m->rule, gg_common_rule_select(beta, mu));
      if (gg_common_pair_loses(m, i, j)) m->elastic = false;
    }
}

/* Smooth grains have no spin to take up what a rough wall gives: it acts on their centres (with beta_w = 0 the flat
 * wall of type A of Campbell, J. Fluid Mech. 247 (1993) 111). With spins that nothing else changes, the torques of both
 * walls would have to cancel in a steady state, and with them the shear stress. */
static gg_status set_walls(gg_model *m, const gg_scene *s, gg_error *err)
{
  bool spinless = m->rule == GG_SMOOTH;
  m->elastic_grains = m->elastic;
  GG_TRY(gg_common_surfaces_make(s, !spinless, m, err));
  m->walled = m->n_surfaces > 0;
  m->wall_rule = m->walled ? gg_common_rule_select(s->walls.beta, s->walls.mu) : GG_SMOOTH;
  bool lossy = m->wall_rule == GG_FRICTIONAL || (m->wall_rule == GG_ROUGH && s->walls.beta < 1);
  if (m->walled && m->surface[0].accommodation < 1 && (s->walls.e < 1 || lossy)) m->elastic = false;
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
  return (m->boltzmann ? dilute : dilute + dense) * (m->shear_rate > 0 ? m->shear_rate * m->shear_rate : 1);
}

/* Of a gas that thermal walls alone warm and nothing cools: their geometric mean, at which free flights from wall to
 * wall bring and take as much. 0 without such walls. */
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

/* With a restitution law, temperature and mean impact speed depend on each other. */
static void guess_temperature(gg_model *m, const gg_scene *s, bool sheared)
{
  const bool follows = s->clock_rate != GG_AUTO || !gg_scene_scales_with_start(s),
             given = s->start.temperature != GG_AUTO && follows;
  for (int round = 0; round < (m->law.name ? 5 : 1); round++) {
    m->temperature0 = guess_unbathed_temperature(m);
    if (m->bath.on) m->temperature0 = gg_common_thermostat_balance(m, sheared ? m->temperature0 : 0);
    if (given) m->temperature0 = gg_units_temperature(m->unit, s->start.temperature);
    gg_common_model_at(m, m->temperature0);
  }
}

/* theta/T where rotational energy neither grows nor decays (Gayen's thesis, eq. 5.13). */
static double guess_ratio(const gg_model *m)
{
  if (m->rule == GG_SMOOTH) return 0;
  double K = m->inertia[0], beta = m->rule == GG_FRICTIONAL ? fmin(m->beta[0], 0) : m->beta[0];
  return K * (1 + beta) / (1 + 2 * K - beta);
}

void gg_common_model_set_ratio(const gg_scene *s, gg_model *m)
{
  if (s->start.rotational_temperature != GG_AUTO && m->rule != GG_SMOOTH)
    m->ratio0 = gg_units_temperature(m->unit, s->start.rotational_temperature) / m->temperature0;
}

static int64_t grains_of(const gg_scene *s, gg_engine_kind engine)
{
  return engine == GG_MD ? s->particles : gg_common_ensemble_size(s);
}

/* Within these everything is far from where numbers end, in both engines; beyond them nothing is to be learnt. */
#define LEAST_PHI 1e-20
#define MOST_UNEQUAL_MASSES 1e12
#define MOST_UNEQUAL_DIAMETERS 1e6
static const double starts_within[2] = {1e-6, 1e30}; /* temperature of sheared flows, (d rate)^2 */

static gg_status check_unequal(const char *key, double least, double greatest, double most, gg_error *err)
{
  double ratio = greatest / least;
  if (ratio <= most) return GG_OK;
  return gg_base_fail(err, GG_BAD_INPUT,
                      "species: values of %s in a ratio of 1 : %g are not allowed; allowed: up to 1 : %g", key, ratio,
                      most);
}

static gg_status check_scales(const gg_scene *s, gg_error *err)
{
  if (s->phi > 0 && s->phi < LEAST_PHI)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "phi: %g is too small a solid fraction; allowed: from %g to 0.6, or 0 for the Boltzmann limit",
                        s->phi, LEAST_PHI);
  double mass[2] = {INFINITY, 0}, diameter[2] = {INFINITY, 0};
  for (int i = 0; i < s->n_species; i++) {
    const gg_species *one = &s->species[i];
    mass[0] = fmin(mass[0], one->mass), mass[1] = fmax(mass[1], one->mass);
    diameter[0] = fmin(diameter[0], one->diameter), diameter[1] = fmax(diameter[1], one->diameter);
  }
  GG_TRY(check_unequal("mass", mass[0], mass[1], MOST_UNEQUAL_MASSES, err));
  GG_TRY(check_unequal("diameter", diameter[0], diameter[1], MOST_UNEQUAL_DIAMETERS, err));
  return GG_OK;
}

static gg_status check_start(const gg_model *m, const gg_scene *s, gg_error *err)
{
  if (!gg_flow_is_sheared(s->flow) || s->start.temperature == GG_AUTO) return GG_OK;
  const double T = gg_units_temperature(m->unit, s->start.temperature), unit = s->start.temperature / T;
  if (T >= starts_within[0] && T <= starts_within[1]) return GG_OK;
  return gg_base_fail(err, GG_BAD_INPUT,
                      "start.temperature: %g is %.3g mass x (diameter x shear_rate)^2; allowed in sheared flows: from "
                      "%g to %g of that, here %.3g to %.3g, or auto",
                      s->start.temperature, T, starts_within[0], starts_within[1], starts_within[0] * unit,
                      starts_within[1] * unit);
}

static void set_reference_speed(gg_model *m, const gg_scene *s)
{
  if (s->collision.speed == GG_AUTO) return;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) m->law.scale[p] /= gg_units_velocity(m->unit, s->collision.speed);
}

/* The user-defined law, or that of collision.law: its units of speed are such that e is collision.e at collision.speed.
 */
static gg_status set_law(gg_model *m, const gg_scene *s, gg_error *err)
{
  m->law = gg_common_extension_law(s->extension);
  if (m->law.e || s->collision.law == GG_LAW_CONSTANT) return GG_OK;
  m->law.kind = s->collision.law;
  m->law.name = gg_common_law_name(m->law.kind);
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) {
    const double e = s->collision.e[p];
    if (e < GG_LAW_LEAST_E || (e > GG_LAW_MOST_E && e < 1))
      return gg_base_fail(err, GG_BAD_INPUT,
                          "key 'collision.e': %.10g with collision.law %s; allowed: from %g to %g, or 1", e,
                          m->law.name, GG_LAW_LEAST_E, GG_LAW_MOST_E);
    m->law.scale[p] = gg_common_law_speed_of(m->law.kind, 1 - e);
  }
  return GG_OK;
}

/* The bath of thermostat: bath; also white noise of a given strength, and a Gaussian thermostat of a given rate, which
 * is a negative drag. */
static gg_status set_bath(gg_model *m, const gg_scene *s, gg_error *err)
{
  gg_bath *b = &m->bath;
  const double time = m->unit.time, T = gg_units_temperature(m->unit, s->bath.temperature),
               noise_strength = gg_units_velocity(m->unit, gg_units_velocity(m->unit, s->noise_strength)) * time;
  const bool bath = s->thermostat == GG_BATH;
  const bool rate = s->thermostat == GG_GAUSSIAN && s->gaussian_rate != GG_AUTO && !m->linear_response;
  const bool noise = s->thermostat == GG_WHITE_NOISE && s->noise_strength != GG_AUTO;
  b->on = bath || rate || noise;
  for (int i = 0; i < m->n_species && b->on; i++) {
    b->drag[i] = bath ? s->bath.drag * s->species[i].drag * time : rate ? -s->gaussian_rate * time / 2 : 0;
    b->noise[i] = bath ? 2 * b->drag[i] * T / m->mass[i] : noise ? noise_strength : 0;
    if (!bath || m->rule == GG_SMOOTH) continue;
    b->spin_drag[i] = s->bath.rotation * b->drag[i];
    b->spin_noise[i] = 2 * b->spin_drag[i] * T / (m->mass[i] * m->inertia[i]);
  }
  if (bath && T == 0 && m->shear_rate == 0)
    return gg_base_fail(
        err, GG_BAD_INPUT,
        "bath.temperature: 0 without shear: the gas only cools; give a temperature above 0, or flow: %s",
        gg_flow_of(GG_USF)->word);
  if ((rate || noise) && m->elastic && m->shear_rate == 0)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "key '%s': collisions of this scene lose no energy, so that it heats up for ever",
                        rate ? "gaussian_rate" : "noise_strength");
  return GG_OK;
}

static gg_status make(const gg_scene *s, gg_engine_kind engine, bool counted, gg_model *m, gg_error *err)
{
  if (s->phi < 0) return gg_base_fail(err, GG_BAD_INPUT, "phi is missing: give the solid fraction, e.g. phi: 0.3");
  GG_TRY(check_scales(s, err));
  *m = (gg_model){.flow = s->flow, .thermostat = s->thermostat, .extension = s->extension};
  GG_TRY(set_law(m, s, err));
  m->linear_response = gg_flow_of(s->flow)->linear_response;
  if (m->law.name && m->linear_response)
    return gg_base_fail(err, GG_BAD_INPUT, "flow: %s needs a constant e: restitution law '%s' has a speed of its own",
                        gg_flow_of(s->flow)->word, m->law.name);
  bool sheared = gg_flow_is_sheared(s->flow);
  m->ensemble = engine == GG_DSMC;
  m->homogeneous = m->ensemble && !gg_flow_is_walled(s->flow);
  m->contact_value = s->contact_value;
  m->n = grains_of(s, engine);
  set_composition(m, s, counted);
  if (counted) GG_TRY(check_grains(m, s, err));
  set_box(m, s);
  set_units(m, s);
  GG_TRY(check_start(m, s, err));
  set_pairs(m, s);
  m->shear_rate = sheared ? s->shear_rate / gg_scene_clock_rate(s) : 0;
  GG_TRY(set_walls(m, s, err));
  set_reference_speed(m, s);
  for (int a = 0; a < 3; a++) m->gravity[a] = gg_units_velocity(m->unit, s->gravity[a]) * m->unit.time;
  m->contact_time = m->elastic                      ? 0
                    : s->md.contact_time != GG_AUTO ? s->md.contact_time
                    : s->md.raised != GG_AUTO       ? s->md.raised
                    : m->gravity[1] != 0            ? 1e-3
                                                    : 1e-5;
  m->time_step = s->dsmc.time_step;
  m->cuts_steps = gg_scene_is_followed(s);
  m->asked_error = gg_common_ensemble_requested_error(s);
  if (engine == GG_MD && !gg_flow_is_walled(s->flow)) m->frame = s->frame;
  m->frame_cells = (int)s->frame_cells;
  m->single = engine == GG_DSMC && s->dsmc.precision == GG_SINGLE;
  m->ratio0 = guess_ratio(m);
  GG_TRY(set_bath(m, s, err));
  guess_temperature(m, s, sheared);
  gg_common_model_set_ratio(s, m);
  m->a2_0 = s->start.a2;
  m->spin0 = s->start.spin == GG_AUTO ? 2 * gg_model_rolling(m, 0) : s->start.spin * m->unit.time;
  m->steady = !m->linear_response && !(m->elastic && sheared && !(m->bath.drag[0] > 0));
  m->stress_unit = m->boltzmann ? 1 : M_PI / 6;
  return GG_OK;
}

gg_status gg_common_model_make(const gg_scene *s, gg_engine_kind engine, gg_model *m, gg_error *err)
{
  return make(s, engine, true, m, err);
}

gg_status gg_common_model_for_theories(const gg_scene *s, gg_model *m, gg_error *err)
{
  return make(s, GG_MD, false, m, err);
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
