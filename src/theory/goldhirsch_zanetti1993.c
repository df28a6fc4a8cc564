/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Critical length of a cooling gas: in longer boxes shear modes grow relative to the thermal speed, and the gas
 * breaks up into vortices and then clusters: I. Goldhirsch & G. Zanetti, Phys. Rev. Lett. 70 (1993) 1619; J.J. Brey,
 * J.W. Dufty, C.S. Kim & A. Santos, Phys. Rev. E 58 (1998) 4638:
 *   L_c = 2 pi sqrt(2 eta/(n m zeta)) = 2 pi 5/(16 sqrt(pi) n d^2) sqrt(2 H/Z),  H = eta/eta_0, Z = zeta/nu_0
 * In mixtures n m is the density of mass, zeta the common cooling rate of all temperatures: P.P. Mitrano, V. Garzo &
 * C.M. Hrenya, Phys. Rev. E 89 (2014) 020201(R). The Gaussian thermostat acts on flow velocities, too, and so
 * amplifies shear modes as cooling does. For smooth grains the thermostatted gas is the cooling gas in other units.
 * For rough grains, whose spins are not heated, theta/T is that of the heated state, and zeta the rate at which
 * translation loses energy there. */
#include "theory/goldhirsch_zanetti1993.h"

#include <math.h>
#include <stdio.h>

#include "common/thermostat.h"
#include "theory/answer.h"
#include "theory/garzo_montanero2003.h"
#include "theory/lun1991.h"
#include "theory/theory_list.h"

static const char name[] = "goldhirsch_zanetti1993";

static double viscous_length2_of_mixture(const gg_model *m)
{
  const gg_mixture_state s = gg_theory_mixture_cooling(m, GG_LINEAR, 1);
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += gg_theory_fraction(m, i) * m->mass[i];
  return gg_theory_mixture_viscosity_of(m, &s, 0.5).total / (m->density * mass) / s.zeta;
}

/* eta/(n m) over zeta in the cooling or heated state, from the theories that have both. */
static double viscous_length2(gg_model m)
{
  gg_theory_answer a;
  const bool heated = m.rule != GG_SMOOTH && gg_common_heat_of(&m) == GG_HEAT_SCALES;
  m.flow = heated ? GG_HSS : GG_HCS;
  m.thermostat = gg_flow_of(m.flow)->thermostat;
  m.linear_response = false;
  m.shear_rate = 0;
  m.temperature0 = 1;
  if (m.n_species > 1) return viscous_length2_of_mixture(&m);
  double unit = 1 / gg_common_model_nu0(&m, 1); /* eta_0/(n m) over nu_0 is unit^2 */
  if (m.rule == GG_SMOOTH) {
    if (gg_theory_evaluate(&gg_theory_garzo_dufty1999, &m, &a, NULL) != GG_OK) return NAN;
    return unit * unit * a.value[GG_Q_VISCOSITY_REDUCED] / a.value[GG_Q_COOLING_RATE];
  }
  if (gg_theory_evaluate(&gg_theory_huthmann_zippelius1997, &m, &a, NULL) != GG_OK) return NAN;
  gg_lun_state state = {m.density, m.phi, m.chi[0], gg_theory_grain_of(&m), a.value[GG_Q_TEMPERATURE_RATIO]};
  return gg_theory_lun_functions_at(state).f2 / m.density * unit / a.value[GG_Q_COOLING_RATE];
}

double gg_theory_clustering_length(const gg_model *m)
{
  if (m->elastic) return INFINITY;
  if (m->n_species > 2 || (m->n_species == 2 && m->rule != GG_SMOOTH) || m->rule == GG_FRICTIONAL) return NAN;
  return 2 * M_PI * sqrt(2 * viscous_length2(*m));
}

static double longest_edge(const gg_model *m)
{
  return fmax(m->box[0], fmax(m->box[1], m->box[2]));
}

double gg_theory_stable_grains(const gg_model *m)
{
  const gg_heat heat = gg_common_thermostats[m->thermostat].heat;
  const bool cools =
      gg_flow_cools(m->flow) || (gg_flow_is_heated(m->flow) && heat == GG_HEAT_SCALES) || m->linear_response;
  if (m->homogeneous || !cools) return NAN;
  return (double)m->n * pow(gg_theory_clustering_length(m) / longest_edge(m), 3);
}

bool gg_theory_stable_size(const gg_model *m, char *text, size_t size)
{
  const double grains = gg_theory_stable_grains(m), edge = longest_edge(m);
  if (!isfinite(grains)) return false;
  const double length = gg_theory_clustering_length(m), digits = pow(10, floor(log10(grains)) - 1);
  snprintf(text, size, "homogeneity: the box is %.3g d long and stays homogeneous up to %.3g d%s, about %.0f grains%s",
           edge, length, edge > length ? " only" : "", round(grains / digits) * digits,
           edge > length ? ": vortices and clusters will grow" : "");
  return true;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  if (m->n_species > 2)
    return gg_theory_reject(err, name, "needs the viscosity of one or two species; this scene has %d", m->n_species);
  if (m->n_species == 2) GG_TRY(gg_theory_require_smooth(m, name, err));
  GG_TRY(gg_theory_require_constant_beta(m, name, err));
  if (gg_common_heat_of(m) == GG_HEAT_KICKS)
    return gg_theory_reject(err, name,
                            "describes free cooling and the Gaussian thermostat; white noise feeds all modes");
  if (m->elastic)
    return gg_theory_reject(err, name, "describes gases that lose energy; collisions of this scene do not");
  double length = gg_theory_clustering_length(m);
  if (!isfinite(length)) return gg_theory_reject(err, name, "finds no viscosity and cooling rate to make a length of");
  a->value[GG_Q_CLUSTERING_LENGTH] = length;
  return GG_OK;
}

const gg_theory gg_theory_goldhirsch_zanetti1993 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_USF) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Size above which cooling gases form vortices and clusters",
    .citation =
        "I. Goldhirsch and G. Zanetti, Phys. Rev. Lett. 70 (1993) 1619; J.J. Brey et al., Phys. Rev. E 58 (1998) 4638",
    .answers = "clustering_length",
    .assumptions = "Linear stability of the shear mode in free cooling: a periodic box with an edge above "
                   "clustering_length does not stay homogeneous. In uniform shear it is a scale: boxes larger than "
                   "about three times this length cluster at moderate density.",
    .evaluate = evaluate,
};
