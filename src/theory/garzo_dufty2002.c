/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mass flux of a dilute smooth binary mixture that cools freely, first Sonine order: V. Garzo & J.W. Dufty, Phys.
 * Fluids 14 (2002) 1476. Along the gradients of x = x_1, p and T: j_1 = -(nT/nu_0) (D grad x + D_p grad p/p + D' grad
 * T/T) Momentum of species 1 decays at the rate nu, g = x T_1/T, rho the densities of mass, rates in nu_0: D_p = (g -
 * rho_1/rho)/(nu - 3/2 zeta + zeta^2/(2 nu)),   D' = -zeta/(2 nu) D_p D   = [dg/dx + (D_p + D') dzeta/dx]/(nu -
 * zeta/2),       nu = (4/3) sqrt(2 pi) sigma^2 (1 + e) rho S/(m_1 + m_2) with S^2 = T_1/m_1 + T_2/m_2. D is positive
 * and the same for both species; elastic, D_p and D' are what unlike masses make of a pressure gradient, and 0. */
#include <math.h>

#include "theory/garzo_montanero2003.h"
#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "garzo_dufty2002";

typedef struct mass_state {
  double share, zeta, S; /* x T_1/T, zeta and S at T = 1 */
} mass_state;

/* At another mole fraction, contact values and density as they are. */
static mass_state state_at(gg_model m, double x)
{
  m.n = INT64_C(1) << 50;
  m.n_of[0] = (int64_t)(x * (double)m.n), m.n_of[1] = m.n - m.n_of[0];
  const gg_mixture_state s = gg_theory_mixture_cooling(&m, GG_LINEAR, 1);
  return (mass_state){x * m.mass[0] * s.a[0], m.elastic ? 0 : s.zeta, sqrt(s.a[0] + s.a[1])};
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  if (m->n_species != 2)
    return gg_theory_reject(err, name, "describes binary mixtures; this scene has %d species", m->n_species);
  GG_TRY(gg_theory_require_smooth(m, name, err));
  GG_TRY(gg_theory_require_dilute(m, name, err));
  const double x = gg_theory_fraction(m, 0), h = 1e-3 * x * (1 - x), nu0 = gg_common_model_nu0(m, 1);
  const mass_state s = state_at(*m, x), less = state_at(*m, x - h), more = state_at(*m, x + h);
  if (isnan(s.zeta)) return gg_theory_reject(err, name, "finds no common cooling rate for this mixture");
  const double mass = x * m->mass[0] + (1 - x) * m->mass[1];
  const int unlike = gg_pair(0, 1);
  const double nu = 4. / 3 * sqrt(2 * M_PI) * m->chi[unlike] * pow(m->sigma[unlike], 2) * (1 + m->e[unlike]) *
                    m->density * mass * s.S / (m->mass[0] + m->mass[1]);
  const double pressure = (s.share - x * m->mass[0] / mass) / (nu - 1.5 * s.zeta + s.zeta * s.zeta / (2 * nu));
  const double thermal = -s.zeta / (2 * nu) * pressure;
  const double slope = (more.share - less.share) / (2 * h), faster = (more.zeta - less.zeta) / (2 * h);
  a->value[GG_Q_DIFFUSION_REDUCED] = nu0 * (slope + (pressure + thermal) * faster) / (nu - s.zeta / 2);
  a->value[GG_Q_PRESSURE_DIFFUSION_REDUCED] = nu0 * pressure;
  a->value[GG_Q_THERMAL_DIFFUSION_REDUCED] = nu0 * thermal;
  a->value[GG_Q_COOLING_RATE] = s.zeta / nu0;
  a->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = (1 - x) * s.share / (x * (1 - s.share));
  return GG_OK;
}

const gg_theory gg_theory_garzo_dufty2002 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS),
    .title = "Diffusion in smooth dilute mixtures",
    .citation = "V. Garzo and J.W. Dufty, Phys. Fluids 14 (2002) 1476",
    .answers = "partial_temperature_ratio cooling_rate diffusion_reduced pressure_diffusion_reduced "
               "thermal_diffusion_reduced",
    .assumptions = "Free cooling of a dilute binary mixture (Boltzmann's equation, phi up to 0.05) of smooth spheres. "
                   "Mass flux along gradients of composition, pressure and temperature. First Sonine order, "
                   "which has no thermal diffusion of elastic grains.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_first_sonine,
};
