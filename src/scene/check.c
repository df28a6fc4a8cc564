/* What concerns several keys of a scene: defaults that follow the flow, and combinations that make no sense anywhere.
 * What an engine cannot run is the engine's to say (gg_engine_ops.accepts). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/ineffective_keys.h"
#include "scene/scene_reader.h"

/* What depends on the flow: its row says. */
void gg_scene_fill_in(gg_scene *s)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  if (!gg_scene_is_given(s, "collision.e")) {
    double e = flow->conserves ? 1 : gg_common_scene_defaults().collision.e[0];
    for (int p = 0; p < GG_PAIRS; p++) s->collision.e[p] = e;
  }
  /* With a law a cooling gas has no state whose cooling rate an error could be asked of: it is followed for a while. */
  if (s->collision.law != GG_LAW_CONSTANT && gg_flow_cools(s->flow) && s->run.collisions == GG_AUTO)
    s->run.collisions = GG_COLLISIONS_FOLLOWED;
  if (!gg_scene_is_given(s, "thermostat")) s->thermostat = flow->thermostat;
  if (!gg_scene_is_given(s, "gravity")) memcpy(s->gravity, flow->gravity, sizeof s->gravity);
  s->measure |= flow->measure;
}

static bool takes_gaussian(gg_flow flow)
{
  return gg_flow_takes(flow, GG_GAUSSIAN);
}
static bool takes_white_noise(gg_flow flow)
{
  return gg_flow_takes(flow, GG_WHITE_NOISE);
}

/* Flows that take the thermostat of the scene, for messages. */
static void flows_with(gg_thermostat thermostat, char *text, size_t size)
{
  gg_common_flow_list(thermostat == GG_GAUSSIAN ? takes_gaussian : takes_white_noise, text, size);
}

static gg_status check_thermostat(const gg_scene *s, gg_error *err)
{
  const gg_field *field = &gg_scene_fields[gg_scene_field_find("thermostat")];
  const char *flow = gg_flow_of(s->flow)->word;
  char text[160] = "";
  if (gg_flow_takes(s->flow, s->thermostat)) return GG_OK;
  if (s->thermostat != GG_NO_THERMOSTAT) {
    flows_with(s->thermostat, text, sizeof text);
    return gg_base_fail(err, GG_BAD_INPUT, "thermostat: %s does not go with flow: %s; use flow: %s",
                        gg_scene_field_word_for(field, (int)s->thermostat).name, flow, text);
  }
  size_t used = 0;
  for (int t = GG_NO_THERMOSTAT + 1; t < GG_N_THERMOSTATS && used < sizeof text; t++)
    if (gg_flow_takes(s->flow, (gg_thermostat)t))
      used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", used ? " or " : "",
                               gg_scene_field_word_for(field, t).name);
  return gg_base_fail(err, GG_BAD_INPUT, "flow: %s needs a thermostat: %s", flow, text);
}

static gg_status check_gravity(const gg_scene *s, gg_error *err)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  bool falls = s->gravity[0] != 0 || s->gravity[1] != 0 || s->gravity[2] != 0;
  char walled[160];
  if (falls && flow->falling == GG_NEVER_FALLS) {
    gg_common_flow_list(gg_flow_is_walled, walled, sizeof walled);
    return gg_base_fail(err, GG_BAD_INPUT, "gravity needs a flow with walls: %s", walled);
  }
  if (!falls && flow->falling == GG_ALWAYS_FALLS)
    return gg_base_fail(err, GG_BAD_INPUT, "flow: %s needs gravity, e.g. gravity: [%g, %g, %g]", flow->word,
                        flow->gravity[0], flow->gravity[1], flow->gravity[2]);
  return GG_OK;
}

static gg_status check_flow(const gg_scene *s, gg_error *err)
{
  const gg_flow_row *flow = gg_flow_of(s->flow);
  char cooling[160];
  if (flow->conserves && gg_scene_loses_energy(s)) {
    gg_common_flow_list(gg_flow_cools, cooling, sizeof cooling);
    return gg_base_fail(
        err, GG_BAD_INPUT,
        "flow: %s needs collisions that lose no energy: collision.e 1, and collision.beta -1 (or 1 with mu "
        "inf); for a cooling gas use flow: %s",
        flow->word, cooling);
  }
  GG_TRY(check_thermostat(s, err));
  return check_gravity(s, err);
}

/* With beta -1, the default, there is no tangential impulse that friction could limit. */
static gg_status check_friction(const gg_scene *s, gg_error *err)
{
  if (gg_scene_is_given(s, "collision.beta")) return GG_OK;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++)
    if (s->collision.mu[p] > 0 && s->collision.mu[p] < INFINITY)
      return gg_base_fail(
          err, GG_BAD_INPUT,
          "key 'collision.mu': has no effect without collision.beta, whose default -1 is smooth grains; give "
          "the beta of sticking contacts, e.g. collision: {beta: 0, mu: %g}",
          s->collision.mu[p]);
  return GG_OK;
}

gg_status gg_scene_finish(gg_scene *s, gg_error *err)
{
  if (!gg_scene_is_given(s, "flow")) return gg_base_fail(err, GG_BAD_INPUT, "flow is missing, e.g. flow: usf");
  if (!gg_scene_is_given(s, "phi"))
    return gg_base_fail(err, GG_BAD_INPUT, "phi is missing: give the solid fraction, e.g. phi: 0.3");
  double total = 0;
  for (int i = 0; i < s->n_species; i++) total += s->species[i].fraction;
  if (fabs(total - 1) > 1e-9)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "key 'species': the fractions sum to %.10g; they must sum to 1 (within 1e-9)", total);
  gg_scene_fill_in(s);
  GG_TRY(check_friction(s, err));
  return check_flow(s, err);
}
