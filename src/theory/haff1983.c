/* Haff's law of free cooling, P.K. Haff, J. Fluid Mech. 134 (1983) 401: since zeta grows as sqrt(T),
 *   T(t) = T_0/(1 + zeta_0 t/2)^2,   collisions per grain = (2 nu_0/zeta_0) ln(1 + zeta_0 t/2)
 * and the length from which on shear modes outgrow the thermal speed, I. Goldhirsch & G. Zanetti, Phys. Rev. Lett. 70
 * (1993) 1619; J.J. Brey, J.W. Dufty, C.S. Kim & A. Santos, Phys. Rev. E 58 (1998) 4638:
 *   L_c = 2 pi sqrt(2 eta/(n m zeta)) = 2 pi 5/(16 sqrt(pi) n d^2) sqrt(2 H/Z),  H = eta/eta_0, Z = zeta/nu_0 */
#include "theory/haff1983.h"

#include <math.h>

#include "theory/answer.h"
#include "theory/lun1991.h"
#include "theory/theory_list.h"

static const char name[] = "haff1983";

double gg_haff_temperature(double T0, double zeta0, double t)
{
  double slower = 1 + zeta0 * t / 2;
  return T0 / (slower * slower);
}

double gg_haff_collisions(double nu0, double zeta0, double t)
{
  return zeta0 > 0 ? 2 * nu0 / zeta0 * log1p(zeta0 * t / 2) : nu0 * t;
}

/* eta/(n m) over zeta in the cooling state, from the theories that know them. */
static double viscous_length2(gg_model m)
{
  gg_theory_answer a;
  m.flow = GG_HCS;
  m.thermostat = GG_NO_THERMOSTAT;
  m.shear_rate = 0;
  m.temperature0 = 1;
  double unit = 1 / gg_model_nu0(&m, 1); /* eta_0/(n m) over nu_0 is unit^2 */
  if (m.rule == GG_SMOOTH) {
    if (gg_theory_evaluate(&gg_garzo_dufty1999, &m, &a, NULL) != GG_OK) return NAN;
    return unit * unit * a.value[GG_Q_VISCOSITY_REDUCED] / a.value[GG_Q_COOLING_RATE];
  }
  if (gg_theory_evaluate(&gg_huthmann_zippelius1997, &m, &a, NULL) != GG_OK) return NAN;
  gg_lun_state state = {m.density, m.phi, m.chi[0], gg_grain_of(&m), a.value[GG_Q_TEMPERATURE_RATIO]};
  return gg_lun_functions_at(state).f2 / m.density * unit / a.value[GG_Q_COOLING_RATE];
}

double gg_clustering_length(const gg_model *m)
{
  if (m->elastic) return INFINITY;
  if (m->n_species > 1 || m->rule == GG_FRICTIONAL) return NAN;
  return 2 * M_PI * sqrt(2 * viscous_length2(*m));
}

/* zeta = (nu/3)(1-e^2) of a Maxwellian. */
static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_require_one_species(m, name, err));
  GG_TRY(gg_require_smooth(m, name, err));
  GG_TRY(gg_require_flow(m, GG_HCS, name, err));
  double T = m->temperature0;
  gg_answer_temperature(m, T, NAN, a);
  gg_answer_collisions_one(m, T, a);
  double zeta = a->value[GG_Q_COLLISION_RATE] / 3 * (1 - m->e[0] * m->e[0]);
  a->value[GG_Q_COOLING_RATE] = zeta / gg_model_nu0(m, T);
  return GG_OK;
}

const gg_theory gg_haff1983 = {
    .name = name,
    .title = "Haff's law of free cooling",
    .citation = "P.K. Haff, J. Fluid Mech. 134 (1983) 401",
    .assumptions =
        "Homogeneous free cooling of smooth grains of one species, Maxwellian velocities: T = T_0/(1 + zeta t/2)^2 "
        "in boxes too small for clusters; the cooling rate is within 2 % down to e = 0.5.",
    .evaluate = evaluate,
};
