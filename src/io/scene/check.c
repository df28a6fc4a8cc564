/* What concerns several keys of a scene: defaults that follow the flow, and combinations that make no sense anywhere.
 * What an engine cannot run is the engine's to say (gg_engine_ops.accepts). */
#include <math.h>

#include "io/scene/draft.h"

static bool given(const gg_scene_draft *d, const char *key)
{
  return d->given[gg_scene_field_find(key)];
}

/* A gas in equilibrium loses no energy; a heated one needs a heater. */
static void follow_flow(gg_scene_draft *d)
{
  gg_scene *s = &d->scene;
  if (!given(d, "collision.e")) {
    double e = s->flow == GG_EQUILIBRIUM ? 1 : gg_scene_defaults().collision.e[0];
    for (int p = 0; p < GG_PAIRS; p++) s->collision.e[p] = e;
  }
  if (!given(d, "thermostat")) s->thermostat = s->flow == GG_HSS ? GG_GAUSSIAN : GG_NO_THERMOSTAT;
  if (!given(d, "small_shear")) s->small_shear = s->flow == GG_USF && s->thermostat == GG_GAUSSIAN ? GG_ON : GG_OFF;
  if (s->small_shear == GG_ON) s->measure |= GG_MEASURE_VISCOSITY;
}

static bool loses_energy(const gg_scene *s)
{
  for (int i = 0; i < s->n_species; i++)
    for (int j = i; j < s->n_species; j++) {
      int p = gg_pair_index(i, j);
      double beta = s->collision.beta[p], mu = s->collision.mu[p];
      bool smooth = beta == -1 || mu == 0, rough = beta == 1 && mu == INFINITY;
      if (s->collision.e[p] < 1 || !(smooth || rough)) return true;
    }
  return false;
}

static gg_status check_flow(const gg_scene *s, const char *name, gg_error *err)
{
  if (s->flow == GG_EQUILIBRIUM && loses_energy(s))
    return gg_fail(err, GG_BAD_INPUT,
                   "%s: flow: equilibrium needs collisions that lose no energy: collision.e 1, and collision.beta -1 "
                   "(or 1 with mu inf); for a cooling gas use flow: hcs",
                   name);
  if (s->flow == GG_HSS && s->thermostat == GG_NO_THERMOSTAT)
    return gg_fail(err, GG_BAD_INPUT, "%s: flow: hss needs a thermostat: gaussian or white_noise", name);
  if ((s->flow == GG_HCS || s->flow == GG_EQUILIBRIUM) && s->thermostat != GG_NO_THERMOSTAT)
    return gg_fail(err, GG_BAD_INPUT, "%s: a thermostat does not go with flow: %s; use flow: hss", name,
                   s->flow == GG_HCS ? "hcs" : "equilibrium");
  if (s->small_shear == GG_ON && (s->flow != GG_USF || s->thermostat == GG_WHITE_NOISE))
    return gg_fail(err, GG_BAD_INPUT, "%s: small_shear: on needs flow: usf, and thermostat: none or gaussian", name);
  double g = fabs(s->gravity[0]) + fabs(s->gravity[1]) + fabs(s->gravity[2]);
  if (g > 0 && !gg_flow_is_walled(s->flow))
    return gg_fail(err, GG_BAD_INPUT, "%s: gravity needs a flow with walls: couette, poiseuille or chute", name);
  if (g == 0 && (s->flow == GG_POISEUILLE || s->flow == GG_CHUTE))
    return gg_fail(err, GG_BAD_INPUT, "%s: flow: %s needs gravity, e.g. gravity: [0.01, 0, 0]", name,
                   s->flow == GG_CHUTE ? "chute" : "poiseuille");
  return GG_OK;
}

gg_status gg_scene_draft_finish(gg_scene_draft *d, const char *name, gg_error *err)
{
  gg_scene *s = &d->scene;
  if (!given(d, "flow")) return gg_fail(err, GG_BAD_INPUT, "%s: flow is missing, e.g. flow: usf", name);
  if (!given(d, "phi"))
    return gg_fail(err, GG_BAD_INPUT, "%s: phi is missing: give the solid fraction, e.g. phi: 0.3", name);
  double total = 0;
  for (int i = 0; i < s->n_species; i++) total += s->species[i].fraction;
  if (fabs(total - 1) > 1e-9)
    return gg_fail(err, GG_BAD_INPUT, "%s: key 'species': the fractions sum to %.10g; they must sum to 1 (within 1e-9)",
                   name, total);
  follow_flow(d);
  return check_flow(s, name, err);
}
