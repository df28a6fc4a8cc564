/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks across keys of a scene: defaults that follow the flow, combinations that are invalid anywhere, and keys that
 * have no effect beside the others. Engines reject what they cannot run (gg_engine_ops.accepts). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/collision.h"
#include "common/contact_value.h"
#include "common/portable_math.h"
#include "common/thermostat.h"
#include "scene/fields.h"

/* Properties of the scene's collisions that keys depend on. */
typedef struct traits {
  bool lossy, rough, beta, friction; /* some pair of its species loses energy; spins; has beta above -1; mu above 0 */
} traits;

static bool loses_energy(gg_rule rule, double e, double beta)
{
  return e < 1 || rule == GG_FRICTIONAL || (rule == GG_ROUGH && beta < 1);
}

static traits traits_of(const gg_scene *s)
{
  traits t = {0};
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) {
    const double e = s->collision.e[p], beta = s->collision.beta[p], mu = s->collision.mu[p];
    const gg_rule rule = gg_scene_pair_rule(s, p);
    t.lossy |= loses_energy(rule, e, beta);
    t.rough |= rule != GG_SMOOTH;
    t.beta |= beta != -1 || s->collision.by_speed.at[GG_OF_BETA][p];
    t.friction |= mu != 0 || s->collision.by_speed.at[GG_OF_MU][p];
  }
  t.lossy |= gg_speed_laws_any(&s->collision.by_speed, gg_pairs_of(s->n_species));
  t.lossy |= gg_scene_has_kicks(s);
  return t;
}

/* True if a wall acts otherwise than by its temperature; if it acts by that at all. */
static bool walls_have_rule(const gg_scene *s)
{
  return s->walls.temperature[0] == GG_AUTO || s->walls.accommodation < 1;
}
static bool walls_are_thermal(const gg_scene *s)
{
  return s->walls.temperature[0] != GG_AUTO && s->walls.accommodation > 0;
}

/* Mole fractions from weights. A sum of 1 within rounding stays: what was normalised is read back to the last bit. */
static void normalise_fractions(gg_scene *s)
{
  double total = 0;
  for (int i = 0; i < s->n_species; i++) total += s->species[i].fraction;
  if (fabs(total - 1) <= 1e-14) return;
  for (int i = 0; i < s->n_species; i++) s->species[i].fraction /= total;
  s->weights = total;
}

/* The box of a wave has so many mean free paths and diameters along y, or is a cube that has more: its decay is then
 * within 0.5 % of that of an infinite wave (measure/shear_wave.c). */
enum { PATHS_OF_WAVE = 45, DIAMETERS_OF_WAVE = 12 };

static void lengthen_box(gg_scene *s)
{
  const double n = s->phi > 0 ? 6 * s->phi / M_PI : 1,
               chi = s->phi > 0 ? gg_common_contact_value_of(s->contact_value, s->phi) : 1;
  const double length = fmax(PATHS_OF_WAVE / (M_SQRT2 * M_PI * n * chi), s->phi > 0 ? DIAMETERS_OF_WAVE : 0),
               edges = length / gg_root((double)s->particles / n, 3);
  s->aspect[1] = fmin(fmax(edges * sqrt(edges), 1), 100);
}

/* Defaults that depend on the flow come from its row. */
void gg_scene_fill_in(gg_scene *s)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  normalise_fractions(s);
  if (!gg_scene_is_given(s, "collision.e")) {
    double e = flow->conserves ? 1 : gg_scene_defaults().collision.e[0];
    for (int p = 0; p < GG_PAIRS; p++) s->collision.e[p] = e;
  }
  /* With a law a cooling gas has no steady cooling rate, whose error could end the run: its length is a number of
   * collisions. */
  if (gg_scene_has_law(s) && gg_flow_cools(s->flow) && s->run.collisions == GG_AUTO)
    s->run.collisions = GG_COLLISIONS_FOLLOWED;
  if (!gg_scene_is_given(s, "thermostat"))
    s->thermostat = gg_scene_is_injected(s) && gg_flow_takes(s->flow, GG_INJECTION) ? GG_INJECTION : flow->thermostat;
  if (!gg_scene_is_given(s, "gravity")) memcpy(s->gravity, flow->gravity, sizeof s->gravity);
  if (flow->wall_temperature[0] > 0 && !gg_scene_is_given(s, "walls.temperature"))
    memcpy(s->walls.temperature, flow->wall_temperature, sizeof s->walls.temperature);
  s->measure |= flow->measure;
  if (gg_scene_wave(s) > 0) s->measure |= GG_MEASURE_SHEAR_WAVE;
  if (gg_scene_wave(s) > 0 && !gg_scene_is_given(s, "aspect")) lengthen_box(s);
  /* Errors of a gas that is followed in time come from its replicas. */
  if (s->run.duration != GG_AUTO && !gg_scene_is_given(s, "run.replicas")) s->run.replicas = GG_REPLICAS_FOLLOWED;
}

static gg_status check_thermostat(const gg_scene *s, gg_error *err)
{
  const char *flow = gg_flow_of(s->flow)->word;
  char text[160] = "";
  if (gg_flow_takes(s->flow, s->thermostat)) return GG_OK;
  if (s->thermostat != GG_NO_THERMOSTAT) {
    gg_common_flows_taking(s->thermostat, text, sizeof text);
    return GG_REFUSE(err, "thermostat: %s does not go with flow: %s; use flow: %s",
                     gg_common_thermostats[s->thermostat].word, flow, text);
  }
  for (int t = GG_NO_THERMOSTAT + 1; t < GG_N_THERMOSTATS; t++)
    if (gg_flow_takes(s->flow, (gg_thermostat)t))
      gg_base_text_append(text, sizeof text, "%s%s", *text ? " or " : "", gg_common_thermostats[t].word);
  return GG_REFUSE(err, "flow: %s needs a thermostat: %s", flow, text);
}

/* Kicks and torques give energy: no gas cools freely with them, nor conserves energy, nor responds at a temperature of
 * any size. A torque acts together with the drag and noise of a bath, of which other thermostats have none. */
static gg_status check_injection(const gg_scene *s, gg_error *err)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  const bool torque = gg_scene_has_torque(s), injected = gg_scene_is_injected(s);
  const char *key = torque                  ? "species.torque"
                    : gg_scene_has_kicks(s) ? "collision.normal_kick or tangential_kick"
                                            : "key 'collision.e': above 1 at some speed";
  const gg_heat heat = gg_scene_is_driven(s) ? GG_HEAT_BATHES : gg_common_thermostats[s->thermostat].heat;
  if (s->thermostat == GG_INJECTION && !injected)
    return GG_REFUSE(err, "thermostat: injection needs collision.normal_kick, collision.tangential_kick, a torque on "
                          "rough grains, or a formula of collision.e above 1");
  if (injected && (flow->conserves || flow->linear_response || gg_flow_cools(s->flow)))
    return GG_REFUSE(err, "%s: flow: %s takes no energy from %s; use flow: %s", key, flow->word,
                     torque || gg_scene_has_kicks(s) ? "kicks and torques" : "contacts", gg_flow_of(GG_HSS)->word);
  if (injected && (heat == GG_HEAT_SCALES || heat == GG_HEAT_KICKS))
    return GG_REFUSE(
        err, "%s: does not go with a thermostat that balances the losses; give %s a value, or use thermostat: bath",
        key, gg_scene_strength_of(s->thermostat)->key);
  return GG_OK;
}

static gg_status check_gravity(const gg_scene *s, gg_error *err)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  bool falls = s->gravity[0] != 0 || s->gravity[1] != 0 || s->gravity[2] != 0;
  char walled[160];
  if (falls && flow->falling == GG_NEVER_FALLS) {
    gg_common_flow_list(gg_flow_is_walled, walled, sizeof walled);
    return GG_REFUSE(err, "gravity needs a flow with walls: %s", walled);
  }
  if (!falls && flow->falling == GG_ALWAYS_FALLS)
    return GG_REFUSE(err, "flow: %s needs gravity, e.g. gravity: [%g, %g, %g]", flow->word, flow->gravity[0],
                     flow->gravity[1], flow->gravity[2]);
  return GG_OK;
}

/* Velocities of one or two grains about their mean are nearly zero. */
enum { LEAST_OF_CELL = 4 };
static gg_status check_cells(const gg_scene *s, gg_error *err)
{
  const bool slabs = gg_frame_has_slabs(s->frame);
  const long long n = (long long)s->frame_cells, across = slabs ? 1 : n, cells = n * across * across;
  if (s->frame == GG_FRAME_IMPOSED || gg_flow_is_walled(s->flow) || LEAST_OF_CELL * cells <= s->particles) return GG_OK;
  return GG_REFUSE(
      err, "key 'frame_cells': %lld x %lld x %lld %s of %lld grains hold %.2g each; at least %d are needed", across, n,
      across, slabs ? "slabs" : "cells", (long long)s->particles, (double)s->particles / (double)cells, LEAST_OF_CELL);
}

static gg_status check_flow(const gg_scene *s, gg_error *err)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  char cooling[160];
  if (flow->conserves && traits_of(s).lossy) {
    gg_common_flow_list(gg_flow_cools, cooling, sizeof cooling);
    return GG_REFUSE(err,
                     "flow: %s needs collisions that lose no energy: collision.e 1, and collision.beta -1 (or 1 with "
                     "mu inf); for a cooling gas use flow: %s",
                     flow->word, cooling);
  }
  if (flow->wall_temperature[0] > 0 && !walls_are_thermal(s))
    return GG_REFUSE(err, "flow: %s needs walls.temperature, e.g. [%g, %g], and walls.accommodation above 0",
                     flow->word, flow->wall_temperature[0], flow->wall_temperature[1]);
  GG_TRY(check_thermostat(s, err));
  GG_TRY(check_injection(s, err));
  return check_gravity(s, err);
}

/* With beta -1, the default, there is no tangential impulse that friction could limit. */
static gg_status check_friction(const gg_scene *s, gg_error *err)
{
  if (gg_scene_is_given(s, "collision.beta")) return GG_OK;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++)
    if ((s->collision.mu[p] > 0 && s->collision.mu[p] < INFINITY) || s->collision.by_speed.at[GG_OF_MU][p])
      return GG_REFUSE(err,
                       "key 'collision.mu': has no effect without collision.beta, whose default -1 is smooth grains; "
                       "give the beta of sticking contacts, e.g. collision: {beta: 0, mu: %g}",
                       s->collision.mu[p]);
  return GG_OK;
}

static gg_status check_contact_value(const gg_scene *s, gg_error *err)
{
  const double most = gg_common_contact_value_limit(s->contact_value);
  if (s->n_species > 1 || s->phi <= most) return GG_OK;
  return GG_REFUSE(err,
                   "key 'contact_value': the formula holds up to phi = %g; this scene has %g; use carnahan_starling",
                   most, s->phi);
}

/* True if the gas starts as the scene says: between walls and in sweeps of the shear rate the flow decides. */
static bool takes_start(gg_flow flow)
{
  return !gg_flow_is_walled(flow) && !gg_flow_of(flow)->linear_response;
}

static bool takes_wave(gg_flow flow)
{
  return takes_start(flow) && !gg_flow_is_sheared(flow);
}

static gg_status check_start(const gg_scene *s, gg_error *err)
{
  const gg_scene defaults = gg_scene_defaults();
  char flows[160];
  gg_common_flow_list(takes_start, flows, sizeof flows);
  for (const gg_field *f = gg_scene_fields; f->key && !takes_start(s->flow); f++) {
    const char *here = (const char *)s + f->offset, *usual = (const char *)&defaults + f->offset;
    if ((f->when & GG_BIT(GG_IF_STARTED)) && memcmp(here, usual, sizeof(double)) != 0)
      return GG_REFUSE(err, "key '%s': flow: %s has a start of its own; allowed in flow: %s", f->key,
                       gg_flow_of(s->flow)->word, flows);
  }
  gg_common_flow_list(takes_wave, flows, sizeof flows);
  if (s->start.wave > 0 && !takes_wave(s->flow))
    return GG_REFUSE(err, "key 'start.wave': not in flow: %s; allowed in flow: %s", gg_flow_of(s->flow)->word, flows);
  return GG_OK;
}

/* A rate of 0 or below is one of a gas that is followed. */
static gg_status check_rate(const gg_scene *s, gg_error *err)
{
  const bool formula = *s->shear.formula;
  if (!gg_flow_is_sheared(s->flow)) return GG_OK;
  if (formula) {
    for (int i = 0; i < gg_scene_protocol_count(s, INFINITY); i++)
      if (strcmp(s->protocol[i].key, "shear_rate") == 0)
        return GG_REFUSE(err, "key 'protocol': shear_rate is a formula; give its changes there");
    return GG_OK;
  }
  if (s->shear.rate > 0 || (s->flow == GG_USF && gg_scene_is_followed(s) && gg_scene_unit_rate(s) > 0)) return GG_OK;
  return GG_REFUSE(err,
                   "key 'shear_rate': %g is not allowed here; allowed: above 0, and in flow: %s with run.duration "
                   "below 0, or 0 at the start of a protocol that changes it",
                   s->shear.rate, gg_flow_of(GG_USF)->word);
}

/* Each change has to leave a valid scene. */
static gg_status check_protocol(const gg_scene *s, gg_error *err)
{
  const int n = gg_scene_protocol_count(s, INFINITY);
  gg_scene changed;
  GG_TRY(check_rate(s, err));
  if (!n) return GG_OK;
  if (!gg_scene_is_followed(s))
    return GG_REFUSE(err, "protocol needs run.duration, the time for which the gas is followed");
  if (s->protocol[n - 1].at >= s->run.duration)
    return GG_REFUSE(err, "key 'protocol': at: %g is not allowed; allowed: below run.duration, %g",
                     s->protocol[n - 1].at, s->run.duration);
  for (int k = 1; k <= n; k++) {
    gg_status status = gg_scene_protocol_apply(s, k, &changed, err);
    if (status == GG_OK) status = check_flow(&changed, err);
    if (status == GG_OK) status = gg_scene_check_shear_rate(&changed, err);
    if (status != GG_OK) return gg_base_error_prefix(err, status, "key 'protocol': at: %g", s->protocol[k - 1].at);
  }
  return GG_OK;
}

static gg_status check_duration(const gg_scene *s, gg_error *err)
{
  char flows[160];
  if (!gg_scene_is_followed(s) || takes_start(s->flow)) return check_protocol(s, err);
  gg_common_flow_list(takes_start, flows, sizeof flows);
  return GG_REFUSE(err, "run.duration does not go with flow: %s; use flow: %s", gg_flow_of(s->flow)->word, flows);
}

/* Formulas and tables replace collision.law, and a law of the program. */
static gg_status check_laws(const gg_scene *s, gg_error *err)
{
  const bool named = s->collision.law != GG_LAW_CONSTANT,
             user_defined = gg_common_extension_law(s->extension).e != NULL;
  for (int c = 0; (named || user_defined) && c < GG_N_COEFFICIENTS; c++)
    if (gg_common_speed_laws_have(&s->collision.by_speed, (gg_contact_coefficient)c, gg_pairs_of(s->n_species)))
      return GG_REFUSE(
          err, "%s does not go with key 'collision.%s' as a formula or table of the speed; leave one of them out",
          named ? "key 'collision.law'" : "a restitution law of the calling program",
          gg_common_coefficient_name((gg_contact_coefficient)c));
  return GG_OK;
}

gg_status gg_scene_finish(gg_scene *s, gg_error *err)
{
  if (!gg_scene_is_given(s, "flow")) return GG_REFUSE(err, "flow is missing, e.g. flow: usf");
  if (!gg_scene_is_given(s, "phi")) return GG_REFUSE(err, "phi is missing: give the solid fraction, e.g. phi: 0.3");
  if (!(s->output.fields & GG_FIELDS_VELOCITY))
    return GG_REFUSE(err, "key 'output.fields': velocity is missing, which frames always hold; add it to the list");
  gg_scene_fill_in(s);
  GG_TRY(check_laws(s, err));
  GG_TRY(check_friction(s, err));
  GG_TRY(check_contact_value(s, err));
  GG_TRY(check_start(s, err));
  GG_TRY(check_cells(s, err));
  GG_TRY(check_flow(s, err));
  if (gg_flow_is_sheared(s->flow) && *s->shear.formula) GG_TRY(gg_scene_shear_finish(s, err));
  return check_duration(s, err);
}

/* With theories alone the keys of both engines count as used: theories do not depend on engines. */
static bool uses_md(const gg_scene *s, unsigned uses)
{
  return uses == GG_USE_THEORY || ((uses & GG_USE_MD) && s->phi > 0 && gg_flow_runs_in(s->flow, GG_MD));
}

static bool uses_dsmc(const gg_scene *s, unsigned uses)
{
  return uses == GG_USE_THEORY || ((uses & GG_USE_DSMC) && gg_flow_runs_in(s->flow, GG_DSMC));
}

static bool has_box(const gg_scene *s, unsigned uses)
{
  return uses_md(s, uses) || gg_flow_is_walled(s->flow) || gg_scene_wave(s) > 0;
}

/* In md, too, the strength of white noise goes with the key: it balances the losses at Enskog's collision rate. */
static bool uses_contact_value(const gg_scene *s, unsigned uses)
{
  const gg_heat heat = gg_common_thermostats[gg_flow_thermostat(s->flow, s->thermostat)].heat;
  return s->n_species == 1 && s->phi > 0 && ((uses & (GG_USE_DSMC | GG_USE_THEORY)) || heat == GG_HEAT_KICKS);
}

/* True if there is a mean whose error can be reduced: not in a gas that heats up for ever, nor in one that cools with a
 * law of restitution and is never the same again; and without losses there is no rate of loss. */
static bool has_error(const gg_scene *s, unsigned uses)
{
  const traits t = traits_of(s);
  const bool user_defined = gg_common_extension_law(s->extension).e != NULL, lossy = user_defined || t.lossy;
  if (uses == GG_USE_THEORY || lossy) return !(gg_flow_cools(s->flow) && (user_defined || gg_scene_has_law(s)));
  if (gg_common_thermostats[s->thermostat].heat == GG_HEAT_BATHES) return true;
  if (gg_flow_is_sheared(s->flow)) return gg_flow_of(s->flow)->linear_response;
  const bool shares = s->n_species > 1 || t.rough; /* temperatures, whose ratio is known */
  return shares || !(gg_flow_cools(s->flow) || gg_flow_is_heated(s->flow));
}

static bool may_be_open(gg_flow flow)
{
  return gg_flow_of(flow)->may_be_open;
}

static bool has_losses(const gg_scene *s)
{
  return gg_common_extension_law(s->extension).e || traits_of(s).lossy ||
         (gg_flow_is_walled(s->flow) && walls_have_rule(s) &&
          loses_energy(gg_common_rule_select(s->walls.beta, s->walls.mu), s->walls.e, s->walls.beta));
}

#define OF_FLOW(NAME, otherwise, after, flow) {otherwise, after, flow, NULL},
#define OF_SCENE(NAME, otherwise, when, holds) {otherwise, "", NULL, when},
static const struct {
  const char *otherwise, *after;
  bool (*flow)(gg_flow flow); /* NULL: a condition of the scene, which is `when` in words */
  const char *when;
} conditions[] = {GG_CONDITIONS(OF_FLOW, OF_SCENE)};

void gg_scene_field_when(const gg_field *f, char *text, size_t size)
{
  *text = '\0';
  uint64_t when = f->when;
  if (f->thermostat) gg_base_text_append(text, size, "thermostat %s", gg_common_thermostats[f->thermostat].word);
  if (when & (GG_BIT(GG_IF_MOVING_WALLS) | GG_BIT(GG_IF_OPENABLE)))
    when &= ~GG_BIT(GG_IF_WALLED); /* follows from the flow */
  for (int i = 0; i < GG_N_CONDITIONS; i++) {
    char flows[160];
    if (!(when & GG_BIT(i))) continue;
    gg_base_text_append(text, size, "%s", *text ? "; " : "");
    if (conditions[i].flow) gg_common_flow_list(conditions[i].flow, flows, sizeof flows);
    gg_base_text_append(text, size, "%s%s", conditions[i].flow ? "flow " : "",
                        conditions[i].flow ? flows : conditions[i].when);
  }
}

bool gg_scene_field_is_of(const gg_field *f, gg_flow flow)
{
  for (int i = 0; i < GG_N_CONDITIONS; i++)
    if ((f->when & GG_BIT(i)) && conditions[i].flow && !conditions[i].flow(flow)) return false;
  if (f->thermostat && !gg_flow_takes(flow, f->thermostat)) return false;
  return !(f->when & GG_BIT(GG_IF_UNWALLED)) || !gg_flow_is_walled(flow);
}

/* The conditions that hold, a bit of each. */
#define FLOW_BIT(NAME, otherwise, after, flow_is) | (flow_is(s->flow) ? GG_BIT(GG_IF_##NAME) : 0)
#define SCENE_BIT(NAME, otherwise, when, holds) | ((holds) ? GG_BIT(GG_IF_##NAME) : 0)
static uint64_t conditions_of(const gg_scene *s, unsigned uses)
{
  return 0 GG_CONDITIONS(FLOW_BIT, SCENE_BIT);
}

/* Keys that have no effect, by the reason. Two more are of parts of keys; the last group has no keys. */
enum { REASONS = GG_N_CONDITIONS + 2 };
typedef struct group {
  char reason[160], keys[600];
  int n;
} group;

static void add_key(group *groups, const char *reason, const char *key)
{
  group *g = groups;
  while (g->n && strcmp(g->reason, reason) != 0) g++;
  if (!g->n++) snprintf(g->reason, sizeof g->reason, "%s", reason);
  gg_base_text_append(g->keys, sizeof g->keys, "%s%s", *g->keys ? ", " : "", key);
}

/* True if the member has another value than by default. */
static bool differs(const gg_field *f, const void *base, const gg_scene *scene, const void *default_base,
                    const gg_scene *defaults)
{
  json_auto_t *value = gg_scene_field_json(f, base, scene);
  json_auto_t *usual = gg_scene_field_json(f, default_base, defaults);
  return !json_equal(value, usual);
}

/* The reason in `text`, if the key has no effect. */
static bool is_ineffective(const gg_field *f, const gg_scene *scene, unsigned uses, char *text, size_t size)
{
  if (f->thermostat && f->thermostat != scene->thermostat)
    return snprintf(text, size, "but with thermostat: %s", gg_common_thermostats[f->thermostat].word), true;
  const uint64_t lacks = f->when & ~conditions_of(scene, uses);
  for (int i = 0; i < GG_N_CONDITIONS; i++) {
    char flows[160] = "";
    if (!(lacks & GG_BIT(i))) continue;
    if (conditions[i].flow) gg_common_flow_list(conditions[i].flow, flows, sizeof flows);
    return snprintf(text, size, "%s%s%s", conditions[i].otherwise, flows, conditions[i].after), true;
  }
  return false;
}

/* The same of a key that the scene (change -1) or a change of its protocol gives: at no time until the next change of
 * it. Changes of one time are one. */
static bool never_matters(const gg_field *f, const gg_scene *s, int change, unsigned uses, char *text, size_t size)
{
  const int n = gg_scene_protocol_count(s, INFINITY);
  const char *key = change < 0 ? f->key : s->protocol[change].key;
  for (int k = change + 1; k <= n; k++) {
    gg_scene now;
    if (k > change + 1 && strcmp(s->protocol[k - 1].key, key) == 0) break;
    if (k > 0 && k < n && s->protocol[k].at == s->protocol[k - 1].at) continue;
    if (gg_scene_protocol_apply(s, k, &now, NULL) != GG_OK || !is_ineffective(f, &now, uses, text, size)) return false;
  }
  return true;
}

static void add_changes(group *groups, const gg_scene *s, unsigned uses)
{
  char reason[160], key[2 * GG_CHANGE_TEXT];
  gg_field f;
  for (int i = 0; i < gg_scene_protocol_count(s, INFINITY); i++) {
    snprintf(key, sizeof key, "%s (protocol, at: %g)", s->protocol[i].key, s->protocol[i].at);
    if (gg_scene_key_find(s->protocol[i].key, GG_MAX_SPECIES, &f) >= 0 &&
        never_matters(&f, s, i, uses, reason, sizeof reason))
      add_key(groups, reason, key);
  }
}

/* Pairs of species that there are not: values given to them alone, unlike those of the rest. */
static void add_pairs(group *groups, const gg_field *f, const gg_scene *scene)
{
  const double *value = (const double *)(const void *)((const char *)scene + f->offset);
  char key[48], name[GG_PAIR_NAME];
  for (int p = gg_pairs_of(scene->n_species); p < GG_PAIRS; p++) {
    if (value[p] == value[GG_11] || value[p] == value[GG_PAIRS - 1]) continue;
    snprintf(key, sizeof key, "%s.%s", f->key, gg_common_pair_name(p, name));
    add_key(groups, scene->n_species == 1 ? "with one species" : "with so few species", key);
  }
}

static void add_species(group *groups, const gg_scene *scene, unsigned uses, const gg_scene *defaults)
{
  char reason[160], key[48];
  for (int i = 0; i < scene->n_species; i++)
    for (const gg_field *f = gg_scene_species_fields; f->key; f++) {
      snprintf(key, sizeof key, "species.%d.%s", i + 1, f->key);
      if (is_ineffective(f, scene, uses, reason, sizeof reason) &&
          differs(f, &scene->species[i], scene, &defaults->species[0], defaults))
        add_key(groups, reason, key);
    }
}

/* Fractions below 1 whose sum is far from 1 may be mole fractions of which one was forgotten: state what they become.
 * Weights such as 1 and 2, and decimals such as .333, pass. */
static void add_weights(const gg_scene *s, gg_string_list *lines)
{
  enum { ROUNDING_PERCENT = 5 };
  char list[400] = "";
  if (s->weights == 0 || fabs(s->weights - 1) <= ROUNDING_PERCENT / 100.) return;
  for (int i = 0; i < s->n_species; i++) {
    if (s->species[i].fraction * s->weights >= 1) return;
    gg_base_text_append(list, sizeof list, "%s%.4g", i ? ", " : "", s->species[i].fraction);
  }
  gg_base_string_list_add(lines, "species: the fractions sum to %.4g and count as weights: the mole fractions are %s",
                          s->weights, list);
}

void gg_scene_ineffective_keys(const gg_scene *scene, unsigned uses, gg_string_list *lines)
{
  const gg_scene defaults = gg_scene_defaults();
  group groups[REASONS + 1] = {0};
  char reason[160];
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    if (!gg_scene_is_given(scene, f->key)) continue;
    if (f->type == GG_FIELD_SPECIES)
      add_species(groups, scene, uses, &defaults);
    else if (never_matters(f, scene, -1, uses, reason, sizeof reason) && differs(f, scene, scene, &defaults, &defaults))
      add_key(groups, reason, f->key);
    else if (f->type == GG_FIELD_PAIRS)
      add_pairs(groups, f, scene);
  }
  if (gg_scene_is_followed(scene)) add_changes(groups, scene, uses);
  if (may_be_open(scene->flow) && scene->walls.top == GG_OPEN_TOP && walls_are_thermal(scene) &&
      scene->walls.temperature[0] != scene->walls.temperature[1])
    add_key(groups, "under an open top", "walls.temperature of the upper wall");
  for (const group *g = groups; g->n; g++)
    gg_base_string_list_add(lines, "%s %s no effect %s", g->keys, g->n > 1 ? "have" : "has", g->reason);
  add_weights(scene, lines);
}
