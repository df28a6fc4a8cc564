/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mass flux of a smooth binary mixture that cools freely, first Sonine order: V. Garzo, J.W. Dufty & C.M. Hrenya, Phys.
 * Rev. E 76 (2007) 031303, V. Garzo, C.M. Hrenya & J.W. Dufty, Phys. Rev. E 76 (2007) 031304; dilute V. Garzo & J.W.
 * Dufty, Phys. Fluids 14 (2002) 1476. Along X_T = grad ln T and X_k = grad ln n_k
 *   j_1 = -a_T X_T - a_1 X_1 - a_2 X_2,   a_T = S_T/(nu - zeta),   a_k = (S_k + zeta zeta_k a_T)/(nu - zeta/2),
 * zeta_k = d ln zeta/d ln n_k, where momentum of species 1 decays at the rate nu and the gradients drive it,
 *   S.X = grad n_1 T_1 - (rho_1/rho) grad p - F,   nu = (4/3) sqrt(2 pi) chi sigma^2 (1+e) rho S/(m_1 + m_2) of 1 and
 * 2, S^2 = a_1 + a_2, a_i = T_i/m_i. F is the force of grains 2 a distance away on grains 1 (and of 1 on each other):
 *   F_1 = -(2 pi/3) sum_l m_1l (1+e_1l) sigma_1l^3 chi_1l n_1 n_l [(a_1 + a_l)(X_l + (1/2) sum_k (d ln chi_1l/d ln n_k
 *         + I_1lk) X_k) + grad a_l].
 * The pair distribution of unlike grains at contact is not that of the density half way between them: I_12k = -I_21k is
 * what makes F the gradient of a chemical potential in elastic gases, T grad n_1 - F = n_1 grad mu_1 (H. van Beijeren
 * and M.H. Ernst, Physica 68 (1973) 437), with mu of the contact values of mixtures (G.A. Mansoori et al., J. Chem.
 * Phys. 54 (1971) 1523). Results along grad x_1, p and T: j_1 = -(nT/nu_0)(D grad x_1 + D_p grad ln p + D' grad ln T).
 * Dilute: F = 0, chi as it is. */
#include <math.h>

#include "common/contact_value.h"
#include "theory/garzo_montanero2003.h"
#include "theory/range.h"
#include "theory/theory_list.h"

/* Indices of the derivatives of a state at T = 1. */
enum { PRESSURE_1, PRESSURE, ZETA, SPREAD, LN_CHI = SPREAD + GG_BINARY, VALUES = LN_CHI + 3 };

/* p_c = (pi/3) sum n_i n_j sigma_ij^3 chi_ij m_ij (1+e_ij)(a_i + a_j): the weight of a pair, 2 n_i n_j (a_i + a_j) off.
 */
static double weight(const gg_model *m, int i, int j)
{
  const int q = gg_pair(i, j);
  const double reduced = m->mass[i] * m->mass[j] / (m->mass[i] + m->mass[j]);
  return 2 * M_PI / 3 * reduced * (1 + m->e[q]) * pow(m->sigma[q], 3) * m->chi[q];
}

/* The model at other densities, with its contact values if `dense`. */
static gg_model model_at(const gg_model *base, bool dense, const double n[GG_BINARY])
{
  gg_model m = *base;
  m.density = n[0] + n[1];
  for (int i = 0; i < GG_BINARY; i++) m.number_density[i] = n[i], m.fraction[i] = n[i] / m.density;
  if (!dense) return m;
  double xi[4] = {0};
  for (int i = 0; i < GG_BINARY; i++)
    for (int k = 0; k < 4; k++) xi[k] += M_PI / 6 * n[i] * pow(m.diameter[i], k);
  m.phi = xi[3];
  for (int i = 0; i < GG_BINARY; i++)
    for (int j = 0; j < GG_BINARY; j++)
      m.chi[gg_pair(i, j)] = gg_common_contact_value_mixture(
          xi[3], xi[2], 2 * m.diameter[i] * m.diameter[j] / (m.diameter[i] + m.diameter[j]));
  return m;
}

static void evaluate_at(const gg_model *base, bool dense, const double n[GG_BINARY], double *value)
{
  const gg_model m = model_at(base, dense, n);
  const gg_mixture_state s = gg_theory_mixture_cooling(&m, GG_LINEAR, 1);
  value[PRESSURE_1] = n[0] * m.mass[0] * s.a[0];
  value[PRESSURE] = value[PRESSURE_1] + n[1] * m.mass[1] * s.a[1];
  value[ZETA] = m.elastic ? 0 : s.zeta;
  for (int i = 0; i < GG_BINARY; i++) {
    value[SPREAD + i] = s.a[i];
    for (int j = 0; j < GG_BINARY; j++) {
      value[LN_CHI + gg_pair(i, j)] = log(m.chi[gg_pair(i, j)]);
      if (dense) value[PRESSURE] += n[i] * n[j] / 2 * weight(&m, i, j) * (s.a[i] + s.a[j]);
    }
  }
}

/* n_k d/dn_k, by differences of fourth order. */
static void slopes(const gg_model *m, bool dense, const double n[GG_BINARY], int k, double *slope)
{
  static const double steps[] = {-2, -1, 1, 2}, weights[] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, h = 1e-3;
  for (int v = 0; v < VALUES; v++) slope[v] = 0;
  for (int s = 0; s < 4; s++) {
    double at[GG_BINARY] = {n[0], n[1]}, value[VALUES];
    at[k] *= 1 + h * steps[s];
    evaluate_at(m, dense, at, value);
    for (int v = 0; v < VALUES; v++) slope[v] += weights[s] / h * value[v];
  }
}

/* G = ln(1 - x)/x^2 + 1/(x (1-x)^2) = sum_k x^k [k + 2 - 1/(k + 2)], and two derivatives. */
static void series(double x, double G[3])
{
  double power = 1; /* x^(k - 2) from k = 2 on */
  G[0] = 1.5 + 8. / 3 * x, G[1] = 8. / 3, G[2] = 0;
  for (int k = 2; k < 400; k++, power *= x) {
    const double c = (k + 2 - 1. / (k + 2)) * power;
    G[0] += c * x * x, G[1] += k * c * x, G[2] += k * (k - 1) * c;
  }
}

/* d(mu_1 - T ln n_1)/dn_k/T: second derivatives of the excess free energy pi V/6T = xi_2^3 G - xi_0 ln(1 - xi_3)
 * + 3 xi_1 xi_2/(1 - xi_3), xi_k = (pi/6) sum n_i d_i^k. */
static double chemical_slope(const gg_model *m, const double n[GG_BINARY], int k)
{
  double xi[4] = {0}, G[3], H[4][4] = {{0}}, sum = 0;
  for (int i = 0; i < GG_BINARY; i++)
    for (int p = 0; p < 4; p++) xi[p] += M_PI / 6 * n[i] * pow(m->diameter[i], p);
  const double u = 1 - xi[3], x2 = xi[2];
  series(xi[3], G);
  H[0][3] = 1 / u;
  H[1][2] = 3 / u, H[1][3] = 3 * x2 / (u * u);
  H[2][2] = 6 * x2 * G[0], H[2][3] = 3 * x2 * x2 * G[1] + 3 * xi[1] / (u * u);
  H[3][3] = x2 * x2 * x2 * G[2] + xi[0] / (u * u) + 6 * xi[1] * x2 / (u * u * u);
  for (int p = 0; p < 4; p++)
    for (int q = 0; q < 4; q++) sum += (p < q ? H[p][q] : H[q][p]) * pow(m->diameter[0], p) * pow(m->diameter[k], q);
  return M_PI / 6 * sum;
}

/* I_12k */
static double asymmetry(const gg_model *m, const double n[GG_BINARY], int k, const double *slope)
{
  double rest = n[k] * chemical_slope(m, n, k), unlike = 0;
  for (int l = 0; l < GG_BINARY; l++) {
    const int q = gg_pair(0, l);
    const double pairs = 4 * M_PI / 3 * n[l] * pow(m->sigma[q], 3) * m->chi[q];
    rest -= pairs * ((k == l) + slope[LN_CHI + q] / 2);
    if (l == 1) unlike = pairs / 2;
  }
  return rest / unlike;
}

/* The force on species 1 by grad ln n_k. */
static double force(const gg_model *m, const double n[GG_BINARY], const double *value, int k, const double *slope)
{
  double sum = 0;
  for (int l = 0; l < GG_BINARY; l++) {
    const double bent = slope[LN_CHI + gg_pair(0, l)] + (l == 1 ? asymmetry(m, n, k, slope) : 0);
    const double spread = value[SPREAD] + value[SPREAD + l];
    sum -= weight(m, 0, l) * n[0] * n[l] * (spread * ((k == l) + bent / 2) + slope[SPREAD + l]);
  }
  return sum;
}

static double force_by_temperature(const gg_model *m, const double n[GG_BINARY], const double *value)
{
  double sum = 0;
  for (int l = 0; l < GG_BINARY; l++) sum -= weight(m, 0, l) * n[0] * n[l] * value[SPREAD + l];
  return sum;
}

/* False where the flux decays no faster than the gas cools: then no solution of this order follows the gradients. */
static bool diffuse(const gg_model *m, bool dense, gg_theory_answer *a)
{
  const double x = gg_theory_fraction(m, 0), n[GG_BINARY] = {x * m->density, (1 - x) * m->density};
  const double rho_1 = n[0] * m->mass[0], rho = rho_1 + n[1] * m->mass[1], nu0 = gg_common_model_nu0(m, 1);
  const int unlike = gg_pair(0, 1);
  double value[VALUES], along[GG_BINARY], pressed[GG_BINARY];
  evaluate_at(m, dense, n, value);
  const double zeta = value[ZETA], p = value[PRESSURE];
  const double nu = 4. / 3 * sqrt(2 * M_PI) * m->chi[unlike] * pow(m->sigma[unlike], 2) * (1 + m->e[unlike]) * rho *
                    sqrt(value[SPREAD] + value[SPREAD + 1]) / (m->mass[0] + m->mass[1]);
  if (!(nu > zeta)) return false;
  double thermal = value[PRESSURE_1] - rho_1 / rho * p;
  if (dense) thermal -= force_by_temperature(m, n, value);
  thermal /= nu - zeta;
  for (int k = 0; k < GG_BINARY; k++) {
    double slope[VALUES];
    slopes(m, dense, n, k, slope);
    along[k] = slope[PRESSURE_1] - rho_1 / rho * slope[PRESSURE];
    if (dense) along[k] -= force(m, n, value, k, slope);
    along[k] = (along[k] + slope[ZETA] * thermal) / (nu - zeta / 2);
    pressed[k] = slope[PRESSURE] / p;
  }
  const double stiff = pressed[0] + pressed[1], pressure = (along[0] + along[1]) / stiff, unit = nu0 / m->density;
  a->value[GG_Q_DIFFUSION_REDUCED] = unit * (along[0] * pressed[1] - along[1] * pressed[0]) / (stiff * x * (1 - x));
  a->value[GG_Q_PRESSURE_DIFFUSION_REDUCED] = unit * pressure;
  a->value[GG_Q_THERMAL_DIFFUSION_REDUCED] = unit * (thermal - pressure);
  a->value[GG_Q_COOLING_RATE] = zeta / nu0;
  a->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = m->mass[0] * value[SPREAD] / (m->mass[1] * value[SPREAD + 1]);
  return true;
}

static gg_status answer_in(const gg_model *m, const char *theory, bool dense, gg_theory_answer *a, gg_error *err)
{
  if (m->n_species != 2)
    return gg_theory_reject(err, theory, "describes binary mixtures; this scene has %d species", m->n_species);
  GG_TRY(gg_theory_require_smooth(m, theory, err));
  if (!dense) GG_TRY(gg_theory_require_dilute(m, theory, err));
  if (isnan(gg_theory_mixture_cooling(m, GG_LINEAR, 1).zeta))
    return gg_theory_reject(err, theory, "finds no common cooling rate for this mixture");
  if (!diffuse(m, dense && !m->boltzmann, a))
    return gg_theory_reject(err, theory, "has no diffusion here: the mass flux decays more slowly than the gas cools");
  return GG_OK;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_in(m, "garzo_dufty_hrenya2007", true, a, err);
}

#define ANSWERS                                                                                                        \
  "partial_temperature_ratio cooling_rate diffusion_reduced pressure_diffusion_reduced thermal_diffusion_reduced"

const gg_theory gg_theory_garzo_dufty_hrenya2007 = {
    .name = "garzo_dufty_hrenya2007",
    .flows = GG_FLOW_BIT(GG_HCS),
    .title = "Diffusion in smooth mixtures of any density",
    .citation = "V. Garzo, J.W. Dufty and C.M. Hrenya, Phys. Rev. E 76 (2007) 031303",
    .answers = ANSWERS,
    .assumptions = "Free cooling of a binary mixture of smooth spheres, any density with molecular chaos. Mass flux "
                   "along gradients of composition, pressure and temperature at first Sonine order. Without its heat "
                   "flux; the viscosity is that of garzo_montanero2003.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_first_sonine,
};

static gg_status evaluate_dilute(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_in(m, "garzo_dufty2002", false, a, err);
}

const gg_theory gg_theory_garzo_dufty2002 = {
    .name = "garzo_dufty2002",
    .flows = GG_FLOW_BIT(GG_HCS),
    .title = "Diffusion in smooth dilute mixtures",
    .citation = "V. Garzo and J.W. Dufty, Phys. Fluids 14 (2002) 1476",
    .answers = ANSWERS,
    .assumptions = "Free cooling of a dilute binary mixture (Boltzmann's equation, phi up to 0.05) of smooth spheres. "
                   "Mass flux along gradients of composition, pressure and temperature. First Sonine order, "
                   "which has no thermal diffusion of elastic grains.",
    .evaluate = evaluate_dilute,
    .beyond = gg_theory_beyond_first_sonine,
};
