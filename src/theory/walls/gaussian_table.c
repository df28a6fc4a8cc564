/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/gaussian_table.h"

#include <math.h>
#include <string.h>

#include "theory/answer.h"
#include "theory/garzo_dufty1999.h"
#include "theory/gaussian_moments.h"

enum { UNKNOWNS = 4, XX = 0, YY, XY, STEPS = 20 };

static double c0(void)
{
  return 5 / (16 * sqrt(M_PI));
}

double gg_theory_heat_rate(const gg_model *m)
{
  const double e = m->e[0], c = 2 * gg_theory_a2_van_noije_ernst(e);
  return (1 + e) / 3 * m->chi[0] * (1 + 33. / 16 * (1 - e) + (19 - 3 * e) / 1024 * c) * m->density / c0();
}

/* Fourth moments of a Gaussian at T = 1: 5/2 and 0 in equilibrium. */
static void fourth(const double M[3], double *yy, double *xy)
{
  *yy = (3 * M[YY] + 2 * (M[YY] * M[YY] + M[XY] * M[XY])) / 2, *xy = M[XY] * (3 + 2 * (M[XX] + M[YY])) / 2;
}

double gg_theory_heat_ratio(const double M[3], double W)
{
  double yy, xy;
  fourth(M, &yy, &xy);
  return xy * (1 - 0.56 * W * W) / (yy - 0.4 * W * xy) - 1.4 * W;
}

/* Left sides of the equations of M and S/n; and what collisions add, unless NULL. */
static void equations(gg_gaussian_table *t, const double x[UNKNOWNS], double left[UNKNOWNS], gg_gaussian_rates *rates)
{
  gg_model *m = &t->gas.model;
  gg_gaussian_rates own, *r = rates ? rates : &own;
  gg_gaussian state = {.spin = 0};
  const double a = m->shear_rate, S = x[3], xi = gg_theory_heat_ratio(x, a / gg_theory_heat_rate(m));
  state.M = (gg_tensor){{{x[XX], x[XY], 0}, {x[XY], x[YY], 0}, {0, 0, 3 - x[XX] - x[YY]}}};
  gg_theory_gaussian_rates_at(m, &state, r);
  const gg_tensor *C = &r->change[0].M;
  left[0] = -2 * a * x[XY] + C->at[0][0] - 0.4 * S, left[1] = C->at[1][1] - 1.2 * S;
  left[2] = C->at[2][2] - 0.4 * S, left[3] = -a * x[YY] + C->at[0][1] - 0.4 * xi * S;
}

/* Gauss elimination of a small system; b becomes the solution. */
static void solve_small(double A[UNKNOWNS][UNKNOWNS], double b[UNKNOWNS])
{
  for (int k = 0; k < UNKNOWNS; k++) {
    int p = k;
    for (int i = k + 1; i < UNKNOWNS; i++)
      if (fabs(A[i][k]) > fabs(A[p][k])) p = i;
    for (int j = 0; j < UNKNOWNS; j++) {
      const double keep = A[k][j];
      A[k][j] = A[p][j], A[p][j] = keep;
    }
    const double keep = b[k];
    b[k] = b[p], b[p] = keep;
    for (int i = k + 1; i < UNKNOWNS; i++) {
      const double f = A[i][k] / A[k][k];
      for (int j = k; j < UNKNOWNS; j++) A[i][j] -= f * A[k][j];
      b[i] -= f * b[k];
    }
  }
  for (int k = UNKNOWNS - 1; k >= 0; k--) {
    for (int j = k + 1; j < UNKNOWNS; j++) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
}

static double norm(const gg_gaussian_table *t, const double left[UNKNOWNS])
{
  double most = 0;
  for (int i = 0; i < UNKNOWNS; i++) most = fmax(most, fabs(left[i]));
  return most * c0() / (t->gas.model.density * t->gas.model.chi[0]);
}

/* Newton's method from x; returns the remaining residual, per mean free time. */
static double improve(gg_gaussian_table *t, double x[UNKNOWNS])
{
  double left[UNKNOWNS], J[UNKNOWNS][UNKNOWNS];
  for (int step = 0; step < STEPS; step++) {
    equations(t, x, left, NULL);
    const double size = norm(t, left);
    if (size < 1e-12 || !isfinite(size)) return size;
    for (int k = 0; k < UNKNOWNS; k++) {
      const double d = 1e-6 * (k == 3 ? t->gas.model.density : 1), keep = x[k];
      double moved[UNKNOWNS];
      x[k] += d, equations(t, x, moved, NULL), x[k] = keep;
      for (int i = 0; i < UNKNOWNS; i++) J[i][k] = (moved[i] - left[i]) / d;
    }
    solve_small(J, left);
    for (int k = 0; k < UNKNOWNS; k++) x[k] -= left[k];
  }
  equations(t, x, left, NULL);
  return norm(t, left);
}

static void set_state(gg_gaussian_table *t, double n, double a)
{
  gg_theory_newtonian_gas_at(&t->gas, n);
  gg_model *m = &t->gas.model;
  if (m->boltzmann) m->density = m->number_density[0] = n;
  m->shear_rate = a;
}

/* Newtonian stress and loss: the start of a row of shear rates. */
static void start(gg_gaussian_table *t, double x[UNKNOWNS])
{
  const gg_model *m = &t->gas.model;
  const double *v = t->gas.answer.value;
  x[XX] = x[YY] = 1, x[XY] = -c0() * v[GG_Q_VISCOSITY_REDUCED_KINETIC] * m->shear_rate / m->density;
  x[3] = -1.5 * m->density * v[GG_Q_COOLING_RATE] / c0();
}

static void put(gg_gaussian_table *t, const double x[UNKNOWNS], double value[GG_TABLE_FUNCTIONS])
{
  const gg_model *m = &t->gas.model;
  double left[UNKNOWNS];
  gg_gaussian_rates r;
  equations(t, x, left, &r);
  const double n = m->density, a = m->shear_rate, yy = x[YY] + r.Pc.at[1][1] / n;
  value[GG_TABLE_PRESSURE] = log(yy);
  value[GG_TABLE_VISCOSITY] = log(-(x[XY] + r.Pc.at[1][0] / n) / a);
  value[GG_TABLE_SOURCE] = x[3] / n;
  value[GG_TABLE_MXX] = x[XX], value[GG_TABLE_MYY] = x[YY], value[GG_TABLE_MXY] = x[XY] / a;
  value[GG_TABLE_XX] = x[XX] + r.Pc.at[0][0] / n - yy;
  value[GG_TABLE_ZZ] = 3 - x[XX] - x[YY] + r.Pc.at[2][2] / n - yy;
}

double gg_theory_gaussian_state(gg_gaussian_table *t, double n, double a, double value[GG_TABLE_FUNCTIONS])
{
  double x[UNKNOWNS];
  set_state(t, n, a);
  start(t, x);
  const double left = improve(t, x);
  put(t, x, value);
  return left;
}

/* Node k of n, in (-1, 1), from the lowest. */
static double node(int k, int n)
{
  return -cos(M_PI * (k + 0.5) / n);
}

/* Density at x of -1 to 1: equal steps of its root. */
static double density_at(const gg_gaussian_table *t, double x)
{
  const double root = 0.5 * (sqrt(t->low) * (1 - x) + sqrt(t->high) * (1 + x));
  return root * root;
}

/* Largest shear rate of a density: twice that of uniform shear by Navier-Stokes, and at least half a collision time
 * over eta*, times `reach`. */
static double most_rate(const gg_gaussian_table *t, double reach)
{
  const double *v = t->gas.answer.value, n = t->gas.model.density, eta = v[GG_Q_VISCOSITY_REDUCED];
  return 1.3 * reach * n / c0() * sqrt(4 * 1.5 * v[GG_Q_COOLING_RATE] / eta + 0.25 / (eta * eta));
}

/* Series of Chebyshev polynomials from values at the nodes, in place along one index. */
static void to_series(double *value, int n, int stride)
{
  double c[GG_TABLE_DENSITIES > GG_TABLE_RATES ? GG_TABLE_DENSITIES : GG_TABLE_RATES];
  for (int j = 0; j < n; j++) {
    c[j] = 0;
    for (int k = 0; k < n; k++) c[j] += (j ? 2. : 1.) / n * value[k * stride] * cos(j * acos(node(k, n)));
  }
  for (int j = 0; j < n; j++) value[j * stride] = c[j];
}

gg_status gg_theory_gaussian_table_make(const gg_model *m, double low, double high, double reach, gg_gaussian_table *t,
                                        gg_error *err)
{
  gg_theory_newtonian_gas_make(m, &t->gas);
  t->low = low, t->high = high, t->densities = m->boltzmann ? 1 : GG_TABLE_DENSITIES;
  for (int i = 0; i < t->densities; i++) {
    const double n = m->boltzmann ? 1 : density_at(t, node(i, t->densities));
    double x[UNKNOWNS];
    set_state(t, n, 0);
    const double most = most_rate(t, reach);
    t->most[i] = log(most);
    for (int k = 0; k < GG_TABLE_RATES; k++) {
      GG_TRY(gg_stop_check(m->stop, err));
      double value[GG_TABLE_FUNCTIONS];
      set_state(t, n, most * sqrt(0.5 * (1 + node(k, GG_TABLE_RATES))));
      if (k == 0) start(t, x);
      if (!(improve(t, x) < 1e-9))
        return gg_theory_reject(err, "moments", "finds no state of the sheared gas at phi = %.3g", m->phi);
      put(t, x, value);
      for (int f = 0; f < GG_TABLE_FUNCTIONS; f++) t->series[f][i][k] = value[f];
    }
  }
  to_series(t->most, t->densities, 1);
  for (int f = 0; f < GG_TABLE_FUNCTIONS; f++) {
    for (int i = 0; i < t->densities; i++) to_series(t->series[f][i], GG_TABLE_RATES, 1);
    for (int k = 0; k < GG_TABLE_RATES; k++) to_series(&t->series[f][0][k], t->densities, GG_TABLE_RATES);
  }
  t->n = m->boltzmann ? 1 : density_at(t, 0), t->a = 0;
  return GG_OK;
}

/* Chebyshev polynomials and their derivatives at x. */
static void polynomials(double x, int n, double *T, double *D)
{
  T[0] = 1, D[0] = 0;
  if (n > 1) T[1] = x, D[1] = 1;
  for (int k = 2; k < n; k++) T[k] = 2 * x * T[k - 1] - T[k - 2], D[k] = 2 * T[k - 1] + 2 * x * D[k - 1] - D[k - 2];
}

/* A place in the table: polynomials of density (x) and of the squared rate (z). */
typedef struct place {
  double X[GG_TABLE_DENSITIES], DX[GG_TABLE_DENSITIES], Z[GG_TABLE_RATES], DZ[GG_TABLE_RATES];
  double x_n, z_n, z_a; /* derivatives */
  bool within;
} place;

static place place_of(const gg_gaussian_table *t, double n, double a)
{
  place p = {.within = true};
  double x = 0, log_most = 0, slope = 0;
  if (t->densities > 1) {
    const double width = sqrt(t->high) - sqrt(t->low);
    x = 2 * (sqrt(n) - sqrt(t->low)) / width - 1, p.x_n = 1 / (sqrt(n) * width);
    if (fabs(x) > 1) x = x > 0 ? 1 : -1, p.x_n = 0, p.within = false;
  }
  polynomials(x, t->densities, p.X, p.DX);
  for (int i = 0; i < t->densities; i++) log_most += t->most[i] * p.X[i], slope += t->most[i] * p.DX[i] * p.x_n;
  const double most = exp(log_most), w = a * a / (most * most);
  p.z_a = 4 * a / (most * most), p.z_n = -4 * w * slope;
  if (w > 1) p.z_a = p.z_n = 0, p.within = false;
  polynomials(w > 1 ? 1 : 2 * w - 1, GG_TABLE_RATES, p.Z, p.DZ);
  return p;
}

typedef struct with_slopes {
  double value, n, a;
} with_slopes;

static with_slopes function_at(const gg_gaussian_table *t, int f, const place *p)
{
  double value = 0, x = 0, z = 0;
  for (int i = 0; i < t->densities; i++) {
    double row = 0, change = 0;
    for (int k = 0; k < GG_TABLE_RATES; k++)
      row += t->series[f][i][k] * p->Z[k], change += t->series[f][i][k] * p->DZ[k];
    value += row * p->X[i], x += row * p->DX[i], z += change * p->X[i];
  }
  return (with_slopes){value, x * p->x_n + z * p->z_n, z * p->z_a};
}

typedef struct density_slopes {
  double x, r; /* dn/d(P/T) at constant |tau|/P, and dn/d(|tau|/P) at constant P/T */
} density_slopes;

/* Density and shear rate at which P/T = n exp(pressure) and |tau|/P = a exp(viscosity - pressure). At
 * phi = 0 n = 1 is a unit, and a alone is found. Returns the derivatives of the density. */
static density_slopes invert(gg_gaussian_table *t, double x, double r)
{
  const bool dilute = t->densities == 1;
  double n = t->n, a = t->a;
  density_slopes slope = {0};
  for (int step = 0; step < 60; step++) {
    const place p = place_of(t, n, a);
    const with_slopes lp = function_at(t, GG_TABLE_PRESSURE, &p), le = function_at(t, GG_TABLE_VISCOSITY, &p);
    const double over = exp(le.value - lp.value), weight = exp(lp.value);
    const double f = dilute ? 0 : n * weight - x, g = a * over - r;
    const double f_n = dilute ? 1 : weight * (1 + n * lp.n), f_a = dilute ? 0 : n * weight * lp.a;
    const double g_n = a * over * (le.n - lp.n), g_a = over * (1 + a * (le.a - lp.a)), det = f_n * g_a - f_a * g_n;
    slope = (density_slopes){dilute ? 1 / weight : g_a / det, dilute ? -x / weight * lp.a / g_a : -f_a / det};
    const double dn = (f * g_a - g * f_a) / det, da = (g * f_n - f * g_n) / det;
    n = fmax(n - dn, 0.3 * n), a = fmax(a - da, 0);
    if (fabs(dn) <= 1e-13 * n && fabs(da) <= 1e-13 * (a + 1e-3 * n)) break;
  }
  t->n = n, t->a = a;
  return slope;
}

/* Factor of the kinetic conductivity. F: heat flux of the anisotropic gas. The other one is of Burnett order: fourth
 * moments have terms q_y T' and q_y', which divide it by 1 + 8.8 s (H. Struchtrup & M. Torrilhon, Phys. Fluids 15
 * (2003) 2668). h^2 in s, and 4.4 where walls heat the gas, are choices by comparison with Monte Carlo. */
static double conductivity_factor(const gg_gaussian_table *t, const double M[3], double W, double S, double h)
{
  const double eta = t->gas.answer.value[GG_Q_VISCOSITY_REDUCED_KINETIC];
  double yy, xy;
  fourth(M, &yy, &xy);
  const double F = (yy - 0.4 * W * xy) / (2.5 * (1 - 0.56 * W * W)), s = h * h * S * c0() * eta;
  return F * (s > 0 ? 1 / (1 + 8.8 * s) : 1 - 4.4 * fmax(s, -0.05));
}

bool gg_theory_gaussian_table_local(void *self, double P, double tau, double T, gg_gap_local *at)
{
  gg_gaussian_table *t = self;
  const gg_model *m = &t->gas.model;
  const double *v = t->gas.answer.value, root = sqrt(T), sign = tau > 0 ? -1 : 1;
  const density_slopes slope = invert(t, P / T, fabs(tau) / P);
  const place p = place_of(t, t->n, t->a);
  double f[GG_TABLE_FUNCTIONS];
  for (int k = 0; k < GG_TABLE_FUNCTIONS; k++) f[k] = function_at(t, k, &p).value;
  const bool dilute = m->boltzmann;
  set_state(t, fmin(fmax(t->n, t->low), t->high), 0);
  const double n = dilute ? P / T / exp(f[GG_TABLE_PRESSURE]) : t->n, unit = dilute ? n : 1; /* of a */
  const double M[3] = {f[GG_TABLE_MXX], f[GG_TABLE_MYY], f[GG_TABLE_MXY] * t->a};
  const double W = t->a / gg_theory_heat_rate(m);
  const double kinetic = v[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC], kappa = v[GG_Q_THERMAL_CONDUCTIVITY_REDUCED];
  const double y = gg_theory_phi_chi(m), e = m->e[0], h = kinetic / kappa, moving = kinetic * (1 + 1.2 * (1 + e) * y);
  const double factor = conductivity_factor(t, M, W, f[GG_TABLE_SOURCE], h), c = 3.75 * c0() * root;
  at->n = n, at->phi = n * M_PI / 6 * !dilute, at->shear = sign * t->a * unit * root;
  at->n_P = slope.x / T, at->n_T = -P / (T * T) * slope.x, at->n_tau = -sign * slope.r / P;
  at->kappa = c * (kappa - moving + moving * factor), at->mu = c * T * v[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] / n;
  at->loss = -tau * at->shear - n * n * T * root * f[GG_TABLE_SOURCE];
  at->Txx = T * M[XX], at->Tyy = T * M[YY], at->Tzz = T * (3 - M[XX] - M[YY]);
  at->xx = n * T * f[GG_TABLE_XX], at->zz = n * T * f[GG_TABLE_ZZ];
  at->carried_x = sign * gg_theory_heat_ratio(M, W) * h;
  at->path = sqrt(1.2) * c0() * v[GG_Q_VISCOSITY_REDUCED_KINETIC] / n;
  return p.within;
}
