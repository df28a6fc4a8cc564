/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/model_of_scene.h"

#include <math.h>
#include <string.h>

#include "common/engine.h"
#include "scene/ensemble_size.h"
#include "scene/fields.h"

static gg_status check_grains(const gg_model *m, const gg_scene *s, gg_error *err)
{
  for (int i = 0; m->n_species > 1 && i < m->n_species; i++)
    if (m->n_of[i] < 2)
      return GG_REFUSE(err,
                       "species: the fraction %g of species %d is %lld of %lld grains; each species needs two: give %s "
                       "a larger value",
                       s->species[i].fraction, i + 1, (long long)m->n_of[i], (long long)m->n,
                       m->ensemble ? "dsmc.particles" : "particles");
  return GG_OK;
}

/* Theories alone (not `counted`) have no grains. */
static void set_fractions(gg_model *m, const gg_scene *s, bool counted)
{
  double total = 0;
  for (int i = 0; i < m->n_species; i++) m->fraction[i] = s->species[i].fraction, total += m->fraction[i];
  if (counted) gg_common_species_deal(m->n, m->n_species, m->fraction, m->n_of);
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

/* Between walls, and across a wave, the gap of dsmc is that of `particles` grains in md, to the last bit; its area
 * grows with the ensemble. */
static void set_box(gg_model *m, const gg_scene *s)
{
  gg_model md = {.n = s->particles};
  gg_common_model_set_size(m, s->phi, s->aspect);
  if (!m->ensemble || m->homogeneous) return;
  set_composition(&md, s, true);
  gg_common_model_set_size(&md, s->phi, s->aspect);
  for (int a = 0; a < 3; a++) m->box[a] = md.box[a] * (a == 1 ? 1 : sqrt(m->volume / md.volume));
  m->length = md.length;
}

static void set_units(gg_model *m, const gg_scene *s)
{
  const gg_species *one = &s->species[0];
  m->unit = (gg_units){one->diameter, one->mass, 1 / gg_scene_clock_rate(s)};
  if (gg_flow_has_moving_walls(s->flow)) m->unit.time = m->box[1] * one->diameter / (2 * s->walls.speed);
}

void gg_scene_model_set_ratio(const gg_scene *s, gg_model *m)
{
  if (s->start.rotational_temperature != GG_AUTO && m->rule != GG_SMOOTH)
    m->ratio0 = gg_units_temperature(m->unit, s->start.rotational_temperature) / m->temperature0;
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
  return GG_REFUSE(err, "species: values of %s in a ratio of 1 : %g are not allowed; allowed: up to 1 : %g", key, ratio,
                   most);
}

static gg_status check_scales(const gg_scene *s, gg_error *err)
{
  if (s->phi > 0 && s->phi < LEAST_PHI)
    return GG_REFUSE(err,
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
  return GG_REFUSE(err,
                   "start.temperature: %g is %.3g mass x (diameter x shear_rate)^2; allowed in sheared flows: from %g "
                   "to %g of that, here %.3g to %.3g, or auto",
                   s->start.temperature, T, starts_within[0], starts_within[1], starts_within[0] * unit,
                   starts_within[1] * unit);
}

static void set_reference_speed(gg_model *m, const gg_scene *s)
{
  m->speed_unit = 1 / gg_units_velocity(m->unit, 1);
  if (s->collision.speed == GG_AUTO) return;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) m->law.scale[p] /= gg_units_velocity(m->unit, s->collision.speed);
}

/* The user-defined law, or that of collision.law: its units of speed are such that e is collision.e at collision.speed.
 */
static gg_status set_law(gg_model *m, const gg_scene *s, gg_error *err)
{
  m->law = gg_common_extension_law(s->extension);
  m->by_speed = s->collision.by_speed;
  m->n_species = s->n_species;
  if (m->law.e || s->collision.law == GG_LAW_CONSTANT) return gg_common_model_name_law(m), GG_OK;
  m->law.kind = s->collision.law;
  m->law.name = gg_common_law_name(m->law.kind);
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) {
    const double e = s->collision.e[p];
    if (e < GG_LAW_LEAST_E || (e > GG_LAW_MOST_E && e < 1))
      return GG_REFUSE(err, "key 'collision.e': %.10g with collision.law %s; allowed: from %g to %g, or 1", e,
                       m->law.name, GG_LAW_LEAST_E, GG_LAW_MOST_E);
    m->law.scale[p] = gg_common_law_speed_of(m->law.kind, 1 - e);
  }
  return GG_OK;
}

/* Drag and noise of species i, from the keys of a thermostat. A Gaussian thermostat of a given rate is a negative drag.
 */
static void set_gaussian(gg_bath *b, int i, const gg_model *m, const gg_scene *s)
{
  b->drag[i] = -s->gaussian_rate * m->unit.time / 2;
}

static void set_white_noise(gg_bath *b, int i, const gg_model *m, const gg_scene *s)
{
  b->noise[i] = gg_units_velocity(m->unit, gg_units_velocity(m->unit, s->noise_strength)) * m->unit.time;
}

static void set_fluid(gg_bath *b, int i, const gg_model *m, const gg_scene *s)
{
  const double T = gg_units_temperature(m->unit, s->bath.temperature);
  b->drag[i] = s->bath.drag * s->species[i].drag * m->unit.time;
  b->noise[i] = 2 * b->drag[i] * T / m->mass[i];
  if (m->rule == GG_SMOOTH) return;
  b->spin_drag[i] = s->bath.rotation * b->drag[i];
  b->spin_noise[i] = 2 * b->spin_drag[i] * T / (m->mass[i] * m->inertia[i]);
}

static void (*const set_species[GG_N_THERMOSTATS])(gg_bath *, int i, const gg_model *, const gg_scene *) = {
    [GG_GAUSSIAN] = set_gaussian, [GG_WHITE_NOISE] = set_white_noise, [GG_BATH] = set_fluid};

/* In a steady state of a gas at rest some energy comes in and some goes out. */
static gg_status set_bath(gg_model *m, const gg_scene *s, gg_error *err)
{
  double drag = 0, noise = 0;
  m->turns = gg_scene_has_torque(s), m->bath.on = gg_scene_is_driven(s) && !m->linear_response;
  for (int i = 0; i < m->n_species; i++) {
    const double turning = m->inertia[i] * m->mass[i] * gg_model_radius(m, i);
    if (m->turns) m->torque[i] = gg_units_temperature(m->unit, s->species[i].torque) / turning;
    if (m->bath.on) set_species[s->thermostat](&m->bath, i, m, s);
    drag += m->bath.drag[i], noise += m->bath.noise[i];
  }
  if (!m->bath.on || m->shear_rate != 0 || gg_model_is_injected(m)) return GG_OK;
  if (drag > 0 && noise == 0)
    return GG_REFUSE(err,
                     "bath.temperature: 0 without shear: the gas only cools; give a temperature above 0, or flow: %s",
                     gg_flow_of(GG_USF)->word);
  if (drag <= 0 && m->elastic)
    return GG_REFUSE(err, "key '%s': collisions of this scene lose no energy, so that it heats up for ever",
                     gg_scene_strength_of(s->thermostat)->key);
  return GG_OK;
}

static void set_pairs(gg_model *m, const gg_scene *s)
{
  for (int o = 0; o < gg_pairs_of(m->n_species); o++)
    m->e[o] = s->collision.e[o], m->beta[o] = s->collision.beta[o], m->mu[o] = s->collision.mu[o];
  for (int o = 0; o < gg_pairs_of(m->n_species); o++)
    for (int k = 0; k < GG_N_KICKS; k++) m->kick[k][o] = gg_units_velocity(m->unit, s->collision.kick[k][o]);
  m->contact_value = s->contact_value;
  gg_common_model_set_pairs(m);
}

static gg_status check_ridges(const gg_model *m, const gg_scene *s, gg_error *err)
{
  const double d = s->species[0].diameter, length = m->box[0] * d;
  if (s->walls.ridges == 0) return GG_OK;
  if ((gg_flow_has_moving_walls(s->flow) && s->walls.speed != 0) || s->walls.ridges < 0.1 * d)
    return GG_REFUSE(err, "walls.ridges: %g; allowed: 0 (flat), or on walls at rest at least a tenth of the diameter",
                     s->walls.ridges);
  if (s->walls.ridges > 2 * length)
    return GG_REFUSE(err,
                     "walls.ridges: %g in a box that is %.4g long along x; allowed: up to %.4g, of which one is made "
                     "that is as wide as the box",
                     s->walls.ridges, length, 2 * length);
  return GG_OK;
}

static double wall_temperature(const gg_model *m, double T)
{
  return T == GG_AUTO ? GG_AUTO : gg_units_temperature(m->unit, T);
}

/* The diameter of ridges is such that a whole number of them lies along x. */
static gg_status set_walls(gg_model *m, const gg_scene *s, gg_error *err)
{
  const double length = m->box[0] * s->species[0].diameter;
  const gg_walls walls = {
      .e = s->walls.e,
      .beta = s->walls.beta,
      .mu = s->walls.mu,
      .speed = gg_flow_has_moving_walls(s->flow) ? gg_units_velocity(m->unit, s->walls.speed) : 0,
      .temperature = {wall_temperature(m, s->walls.temperature[0]), wall_temperature(m, s->walls.temperature[1])},
      .accommodation = s->walls.accommodation,
      .ridges = s->walls.ridges == 0 ? 0 : fmax(1, round(length / s->walls.ridges)),
      .open_top = gg_flow_of(s->flow)->may_be_open && s->walls.top == GG_OPEN_TOP};
  if (gg_flow_is_walled(s->flow)) GG_TRY(check_ridges(m, s, err));
  return gg_common_model_set_walls(m, &walls, err);
}

/* Members that engines alone read. */
static void set_engine(gg_model *m, const gg_scene *s)
{
  m->contact_time = m->elastic                         ? 0
                    : s->md.contact_time != GG_AUTO    ? s->md.contact_time
                    : s->fixed.contact_time != GG_AUTO ? s->fixed.contact_time
                    : m->gravity[1] != 0               ? 1e-3
                                                       : 1e-5;
  m->time_step = s->dsmc.time_step;
  m->cuts_steps = gg_scene_is_followed(s);
  m->asked_error = gg_scene_ensemble_requested_error(s);
  if (!m->ensemble && !gg_flow_is_walled(s->flow)) m->frame = s->frame;
  m->frame_cells = (int)s->frame_cells;
  memcpy(m->local_density, s->local_densities, sizeof m->local_density);
  m->single = m->ensemble && s->dsmc.precision == GG_SINGLE;
}

static void set_start(gg_model *m, const gg_scene *s)
{
  const bool follows = s->fixed.clock_rate != GG_AUTO || !gg_scene_scales_with_start(s),
             given = s->start.temperature != GG_AUTO && follows;
  gg_common_model_set_start(m, given ? gg_units_temperature(m->unit, s->start.temperature) : GG_AUTO);
  gg_scene_model_set_ratio(s, m);
  m->a2_0 = s->start.a2;
  m->lattice = strcmp(s->start.positions, GG_LATTICE) == 0;
  if (s->start.spin != GG_AUTO) m->spin0 = s->start.spin * m->unit.time;
}

static gg_status make(const gg_scene *s, gg_engine_kind engine, bool counted, gg_model *m, gg_error *err)
{
  if (s->phi < 0) return GG_REFUSE(err, "phi is missing: give the solid fraction, e.g. phi: 0.3");
  GG_TRY(check_scales(s, err));
  *m = (gg_model){.flow = s->flow, .thermostat = s->thermostat, .extension = s->extension};
  GG_TRY(set_law(m, s, err));
  m->linear_response = gg_flow_of(s->flow)->linear_response;
  if (m->law.name && m->linear_response)
    return GG_REFUSE(err, "flow: %s needs a constant e: restitution law '%s' has a speed of its own",
                     gg_flow_of(s->flow)->word, m->law.name);
  m->ensemble = gg_common_engine_of((int)engine)->ensemble;
  m->wave = gg_scene_wave(s);
  m->homogeneous = m->ensemble && !gg_flow_is_walled(s->flow) && m->wave == 0;
  m->n = m->ensemble ? gg_scene_ensemble_size(s) : s->particles;
  set_composition(m, s, counted);
  if (counted) GG_TRY(check_grains(m, s, err));
  set_box(m, s);
  set_units(m, s);
  GG_TRY(check_start(m, s, err));
  set_pairs(m, s);
  m->shear_rate = gg_flow_is_sheared(s->flow) ? gg_scene_shear_rate(s, 0) / gg_scene_clock_rate(s) : 0;
  GG_TRY(set_walls(m, s, err));
  set_reference_speed(m, s);
  for (int a = 0; a < 3; a++) m->gravity[a] = gg_units_velocity(m->unit, s->gravity[a]) * m->unit.time;
  set_engine(m, s);
  GG_TRY(set_bath(m, s, err));
  set_start(m, s);
  return GG_OK;
}

gg_status gg_scene_model_make(const gg_scene *s, gg_engine_kind engine, gg_model *m, gg_error *err)
{
  return make(s, engine, true, m, err);
}

gg_status gg_scene_model_for_theories(const gg_scene *s, gg_model *m, gg_error *err)
{
  return make(s, GG_MD, false, m, err);
}
