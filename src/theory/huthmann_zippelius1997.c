/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rough grains with two Maxwellians: M. Huthmann & A. Zippelius, Phys. Rev. E 56 (1997) R6275; with Coulomb friction O.
 * Herbst, M. Huthmann & A. Zippelius, Granular Matter 2 (2000) 211. The ratio theta/T of free cooling, and of states in
 * which translation is driven (heated, or sheared, where this is eq. (5.13) of Gayen's thesis generalised to friction);
 * the cooling rate zeta = -(nu/3) dE_tr, nu = 4 n d^2 chi sqrt(pi T). */
#include <math.h>

#include "common/thermostat.h"
#include "theory/range.h"
#include "theory/spin_escape.h"
#include "theory/theory_list.h"
#include "theory/two_maxwellian.h"

static const char name[] = "huthmann_zippelius1997";

static gg_status ratio_of(const gg_model *m, gg_grain grain, double mu, double *ratio, gg_error *err)
{
  *ratio = gg_flow_cools(m->flow) ? gg_theory_ratio_cooling(grain, mu) : gg_theory_ratio_driven(grain, mu);
  if (!isnan(*ratio)) return GG_OK;
  /* The limit r -> infinity, where all contacts slide: dE_tr = -4 eta_1 (1 - eta_1 - mu^2 eta_1), dE_rot/r -> 0. */
  if (mu * mu * grain.eta1 > 1 - grain.eta1)
    return gg_theory_reject(err, name, "finds no steady theta/T that numbers can hold for such contacts");
  return gg_theory_reject(
      err, name,
      "finds no steady theta/T: with so little friction rotation cools more slowly than translation "
      "for ever");
}

/* Translational energy that a collision takes, over m T. */
static double loss_of(const gg_model *m, gg_grain grain, double mu, double ratio)
{
  if (gg_flow_cools(m->flow)) return gg_theory_cooling_at(grain, mu, ratio);
  return -gg_theory_exchange_at(grain, mu, ratio).translation;
}

/* White noise is set to balance contacts of Maxwellians that all stick, at the initial ratio of a run
 * (thermostat.h). If some contacts slide, another energy is lost, at another ratio: for grains of mass 1, 3/2 xi^2 =
 * -(nu/2) dE_tr T, nu as sqrt(T). */
static double temperature_of(const gg_model *m, double lost)
{
  double T0 = m->temperature0, noise = gg_common_thermostat_kicks(m);
  double loss = lost * gg_common_model_collision_rate(m, T0) / 3 * T0;
  return noise > 0 && loss > 0 ? T0 * pow(noise / loss, 2. / 3) : T0;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  if (m->shear_rate != 0) GG_TRY(gg_theory_require_steady_shear(m, name, err));
  if (m->rule == GG_SMOOTH)
    return gg_theory_reject(err, name, "describes rough grains; grains of this scene are smooth");
  gg_grain grain = gg_theory_grain_of(m);
  double mu = m->rule == GG_FRICTIONAL ? m->mu[0] : INFINITY, ratio;
  GG_TRY(ratio_of(m, grain, mu, &ratio, err));
  GG_TRY(gg_theory_require_lasting(m, name, err));
  a->value[GG_Q_TEMPERATURE_RATIO] = ratio;
  if (m->shear_rate != 0) return GG_OK; /* for sheared states it has no other answers */
  double lost = loss_of(m, grain, mu, ratio), T = temperature_of(m, lost), p = m->density * T,
         pc = p * 4 * grain.eta1 * gg_theory_phi_chi(m);
  gg_theory_answer_temperature(m, T, ratio, a);
  gg_theory_answer_pressure(m, T, p, pc, a);
  gg_theory_answer_collisions_one(m, T, a);
  double zeta = a->value[GG_Q_COLLISION_RATE] / 3 * lost;
  a->value[GG_Q_COOLING_RATE] = zeta / gg_common_model_nu0(m, T);
  return GG_OK;
}

static const char *beyond(const gg_model *m)
{
  if (gg_theory_is_metastable(m)) return gg_theory_beyond_metastable(m);
  return m->shear_rate != 0 ? "made without shear, which its ratio of temperatures leaves out"
                            : gg_theory_beyond_gaussian(m);
}

const gg_theory gg_theory_huthmann_zippelius1997 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_USF),
    .title = "Rough grains with Maxwellian velocities and spins",
    .citation =
        "M. Huthmann and A. Zippelius, Phys. Rev. E 56 (1997) R6275; with friction O. Herbst, M. Huthmann and A. "
        "Zippelius, Granular Matter 2 (2000) 211",
    .answers = "temperature rotational_temperature temperature_ratio pressure compressibility_factor " GG_ANSWERS_RATES
               "cooling_rate",
    .assumptions = "Free cooling and driven translation of one species, constant beta or Coulomb friction, any "
                   "density. theta/T is 2-5 % high in free cooling at e = 0.8-0.9 and up to 15 % low under shear. "
                   "Molecular chaos; velocities and spins Maxwellian and independent.",
    .evaluate = evaluate,
    .beyond = beyond,
};
