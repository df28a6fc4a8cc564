/* What concerns several keys of a scene: defaults that follow the flow, and combinations that make no sense anywhere.
 * What an engine cannot run is the engine's to say (gg_engine_ops.accepts). */
#include <math.h>

#include "io/scene/inert.h"
#include "io/scene/reader.h"

/* A gas in equilibrium loses no energy; a heated one needs a heater. */
void gg_scene_fill_in(gg_scene *s)
{
  if (!gg_scene_is_given(s, "collision.e")) {
    double e = s->flow == GG_EQUILIBRIUM ? 1 : gg_scene_defaults().collision.e[0];
    for (int p = 0; p < GG_PAIRS; p++) s->collision.e[p] = e;
  }
  if (!gg_scene_is_given(s, "thermostat")) s->thermostat = s->flow == GG_HSS ? GG_GAUSSIAN : GG_NO_THERMOSTAT;
  if (!gg_scene_is_given(s, "small_shear"))
    s->small_shear = s->flow == GG_USF && s->thermostat == GG_GAUSSIAN ? GG_ON : GG_OFF;
  if (s->small_shear == GG_ON) s->measure |= GG_MEASURE_VISCOSITY;
}

static gg_status check_flow(const gg_scene *s, gg_error *err)
{
  if (s->flow == GG_EQUILIBRIUM && gg_scene_loses_energy(s))
    return gg_fail(err, GG_BAD_INPUT,
                   "flow: equilibrium needs collisions that lose no energy: collision.e 1, and collision.beta -1 "
                   "(or 1 with mu inf); for a cooling gas use flow: hcs");
  if (s->flow == GG_HSS && s->thermostat == GG_NO_THERMOSTAT)
    return gg_fail(err, GG_BAD_INPUT, "flow: hss needs a thermostat: gaussian or white_noise");
  if ((s->flow == GG_HCS || s->flow == GG_EQUILIBRIUM) && s->thermostat != GG_NO_THERMOSTAT)
    return gg_fail(err, GG_BAD_INPUT, "a thermostat does not go with flow: %s; use flow: hss",
                   s->flow == GG_HCS ? "hcs" : "equilibrium");
  if (s->small_shear == GG_ON && (s->flow != GG_USF || s->thermostat == GG_WHITE_NOISE))
    return gg_fail(err, GG_BAD_INPUT, "small_shear: on needs flow: usf, and thermostat: none or gaussian");
  double g = fabs(s->gravity[0]) + fabs(s->gravity[1]) + fabs(s->gravity[2]);
  if (g > 0 && !gg_flow_is_walled(s->flow))
    return gg_fail(err, GG_BAD_INPUT, "gravity needs a flow with walls: couette, poiseuille or chute");
  if (g == 0 && (s->flow == GG_POISEUILLE || s->flow == GG_CHUTE))
    return gg_fail(err, GG_BAD_INPUT, "flow: %s needs gravity, e.g. gravity: [0.01, 0, 0]",
                   s->flow == GG_CHUTE ? "chute" : "poiseuille");
  return GG_OK;
}

/* With beta -1, the default, there is no tangential impulse that friction could limit. */
static gg_status check_friction(const gg_scene *s, gg_error *err)
{
  if (gg_scene_is_given(s, "collision.beta")) return GG_OK;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++)
    if (s->collision.mu[p] > 0 && s->collision.mu[p] < INFINITY)
      return gg_fail(
          err, GG_BAD_INPUT,
          "key 'collision.mu': has no effect without collision.beta, whose default -1 is smooth grains; give "
          "the beta of sticking contacts, e.g. collision: {beta: 0, mu: %g}",
          s->collision.mu[p]);
  return GG_OK;
}

gg_status gg_scene_finish(gg_scene *s, gg_error *err)
{
  if (!gg_scene_is_given(s, "flow")) return gg_fail(err, GG_BAD_INPUT, "flow is missing, e.g. flow: usf");
  if (!gg_scene_is_given(s, "phi"))
    return gg_fail(err, GG_BAD_INPUT, "phi is missing: give the solid fraction, e.g. phi: 0.3");
  double total = 0;
  for (int i = 0; i < s->n_species; i++) total += s->species[i].fraction;
  if (fabs(total - 1) > 1e-9)
    return gg_fail(err, GG_BAD_INPUT, "key 'species': the fractions sum to %.10g; they must sum to 1 (within 1e-9)",
                   total);
  gg_scene_fill_in(s);
  GG_TRY(check_friction(s, err));
  return check_flow(s, err);
}
