/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with Coulomb friction: J = jn g_n k + j g_t with j = jt where jt |g_t| <= mu jn g_n (the contact sticks),
 * else j = mu jn g_n/|g_t| (it slides).
 *
 * g is Gaussian with mean m and covariance S = R R^T in axes k, t1, t2, and J depends on g alone. So C_1 and s_1 enter
 * by their regression on g: <u+ J C_1^T> = <u+ J (g - m)^T> S^-1 cov(g, C_1), and likewise for s_1; what remains are
 * integrals over g. On a ray g = rho v, v = (s_n cos psi, sin psi t(alpha)), with an ellipse t(alpha) of the spreads of
 * g_t, j is constant and the Gaussian is exp(-(A rho^2 - 2 B rho + C)/2): closed integrals in rho, equal steps in
 * alpha, and Gauss-Legendre rules on either side of the psi at which contacts begin to slide. */
#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "theory/contact_averages.h"

enum { AZIMUTH = 16, POLAR = 4, MORE_POLAR = 10, MOST_POWER = 5 };

/* The Gaussian in axes k, t1, t2. */
typedef struct local_gaussian {
  gg_tensor axes; /* rows k, t1, t2 */
  gg_tensor R;    /* S = R R^T, lower triangular */
  double m[3];
  double n, t[3]; /* spread of g_n; of g_t = (t[0] cos alpha, t[1] cos alpha + t[2] sin alpha) */
  double y[3];    /* R^-1 m */
  double C;       /* its square */
  double density; /* 1 over the norm of the Gaussian */
} local_gaussian;

/* <u+ ...> in these axes. */
typedef struct local_sums {
  double rate, loss, J[3];
  gg_tensor Jg, JJ;
} local_sums;

static gg_tensor axes_of(gg_vec k)
{
  const gg_vec helper = fabs(k.z) < 0.9 ? (gg_vec){0, 0, 1} : (gg_vec){1, 0, 0};
  const gg_vec one = gg_cross(helper, k), t1 = gg_scale(1 / sqrt(gg_dot(one, one)), one), t2 = gg_cross(k, t1);
  return (gg_tensor){{{k.x, k.y, k.z}, {t1.x, t1.y, t1.z}, {t2.x, t2.y, t2.z}}};
}

/* x = R^-1 x, R lower triangular. */
static void divide(const gg_tensor *R, double x[3])
{
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < i; j++) x[i] -= R->at[i][j] * x[j];
    x[i] /= R->at[i][i];
  }
}

static gg_tensor factorise(gg_tensor S)
{
  gg_tensor R = {{{0}}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) {
      double sum = S.at[i][j];
      for (int l = 0; l < j; l++) sum -= R.at[i][l] * R.at[j][l];
      R.at[i][j] = i == j ? sqrt(sum) : sum / R.at[j][j];
    }
  return R;
}

static gg_vec turned(const local_gaussian *x, const double v[3])
{
  return gg_tensor_times(gg_tensor_transposed(x->axes), (gg_vec){v[0], v[1], v[2]});
}

/* Q^T A Q */
static gg_tensor turned_tensor(gg_tensor Q, gg_tensor A)
{
  return gg_tensor_product(gg_tensor_product(gg_tensor_transposed(Q), A), Q);
}

static local_gaussian local_of(const gg_contact_pair *p, gg_vec k)
{
  local_gaussian x = {.axes = axes_of(k)};
  const gg_vec m = gg_tensor_times(x.axes, gg_theory_contact_velocity(p, k));
  const gg_tensor S = turned_tensor(gg_tensor_transposed(x.axes), gg_theory_contact_covariance(p, k));
  x.R = factorise(S);
  x.n = sqrt(S.at[0][0]);
  x.t[0] = sqrt(S.at[1][1]), x.t[1] = S.at[1][2] / x.t[0], x.t[2] = sqrt(S.at[2][2] - x.t[1] * x.t[1]);
  for (int i = 0; i < 3; i++) x.m[i] = x.y[i] = gg_along(&m, i);
  divide(&x.R, x.y);
  x.C = x.y[0] * x.y[0] + x.y[1] * x.y[1] + x.y[2] * x.y[2];
  x.density = 1 / (pow(2 * M_PI, 1.5) * x.R.at[0][0] * x.R.at[1][1] * x.R.at[2][2]);
  return x;
}

/* int_0^inf rho^p exp(-(A rho^2 - 2 B rho + C)/2) drho, p = 0 .. 5, by recursion. */
static void ray_integrals(double A, double B, double C, double I[MOST_POWER + 1])
{
  const double x0 = B / A, root = sqrt(A / 2);
  I[0] = sqrt(M_PI) / (2 * root) * (C == 0 ? 1 : exp((B * x0 - C) / 2) * erfc(-x0 * root));
  I[1] = x0 * I[0] + exp(-C / 2) / A;
  for (int p = 2; p <= MOST_POWER; p++) I[p] = x0 * I[p - 1] + (p - 1) * I[p - 2] / A;
}

/* One ray, of solid angle w in psi and alpha. */
static void add_ray(const gg_contact_pair *p, const local_gaussian *x, const double v[3], double w, local_sums *f)
{
  const gg_contact *c = p->contact;
  const double along = sqrt(v[1] * v[1] + v[2] * v[2]), limit = c->mu * c->jn * v[0];
  const bool sticks = c->jt * along <= limit;
  const double j = sticks ? c->jt : limit / along, J[3] = {c->jn * v[0], j * v[1], j * v[2]};
  const double lost = sticks ? p->loss_t : j * (1 - j * gg_inverse_mt(c) / 2);
  double A = 0, B = 0, y[3] = {v[0], v[1], v[2]}, I[MOST_POWER + 1];
  divide(&x->R, y);
  for (int i = 0; i < 3; i++) A += y[i] * y[i], B += y[i] * x->y[i];
  ray_integrals(A, B, x->C, I);
  w *= v[0];
  f->rate += w * I[3];
  f->loss += w * I[5] * (p->loss_n * v[0] * v[0] + lost * along * along);
  for (int i = 0; i < 3; i++) {
    f->J[i] += w * I[4] * J[i];
    for (int l = 0; l < 3; l++) {
      f->Jg.at[i][l] += w * I[5] * J[i] * v[l];
      f->JJ.at[i][l] += w * I[5] * J[i] * J[l];
    }
  }
}

typedef struct polar_rule {
  int n;
  gsl_integration_glfixed_table *table;
} polar_rule;

/* Number of points by the part of the quarter circle. */
static polar_rule rule_for(double part)
{
  const int n = POLAR + (int)(MORE_POLAR * part / M_PI_2 + 0.5);
  return (polar_rule){n, gsl_integration_glfixed_table_alloc((size_t)n)};
}

/* Rays of one alpha, from an angle psi to another. */
static void add_fan(const gg_contact_pair *p, const local_gaussian *x, const double t[2], const polar_rule *rule,
                    double from, double to, double w, local_sums *f)
{
  for (int a = 0; a < rule->n; a++) {
    double psi, wa;
    gsl_integration_glfixed_point(from, to, (size_t)a, &psi, &wa, rule->table);
    const double v[3] = {x->n * cos(psi), sin(psi) * t[0], sin(psi) * t[1]};
    add_ray(p, x, v, w * wa * sin(psi), f);
  }
}

static void add_all(const gg_contact_pair *p, const local_gaussian *x, local_sums *f)
{
  const double *t = x->t, limit = p->contact->mu * p->contact->jn * x->n / p->contact->jt; /* of g_t at psi = 45 deg */
  const double middle = atan(limit / sqrt(t[0] * t[2]));
  if (!isfinite(middle)) return; /* no Gaussian */
  polar_rule sticks = rule_for(middle), slides = rule_for(M_PI_2 - middle);
  const int azimuths = AZIMUTH + (int)(5 * sqrt(x->C)); /* the faster the flow, the narrower the Gaussian in alpha */
  for (int b = 0; b < azimuths && sticks.table && slides.table; b++) {
    const double alpha = 2 * M_PI * (b + 0.5) / azimuths, w = x->density * x->n * t[0] * t[2] * 2 * M_PI / azimuths;
    const double along[2] = {t[0] * cos(alpha), t[1] * cos(alpha) + t[2] * sin(alpha)};
    const double edge = atan(limit / hypot(along[0], along[1]));
    add_fan(p, x, along, &sticks, 0, edge, w, f);
    add_fan(p, x, along, &slides, edge, M_PI_2, w, f);
  }
  if (!sticks.table || !slides.table) gg_base_memory_lacked(); /* the caller of the theory reports it */
  if (sticks.table) gsl_integration_glfixed_table_free(sticks.table);
  if (slides.table) gsl_integration_glfixed_table_free(slides.table);
}

/* k x v, in these axes. */
static const gg_tensor torque = {{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}};

/* <u+ J (g - m)^T> S^-1, in these axes. */
static gg_tensor regression(const local_gaussian *x, const local_sums *f)
{
  gg_tensor out;
  for (int i = 0; i < 3; i++) {
    double *P = out.at[i];
    for (int l = 0; l < 3; l++) P[l] = f->Jg.at[i][l] - f->J[i] * x->m[l];
    divide(&x->R, P);
    for (int l = 2; l >= 0; l--) { /* R^T from the right */
      for (int q = l + 1; q < 3; q++) P[l] -= x->R.at[q][l] * P[q];
      P[l] /= x->R.at[l][l];
    }
  }
  return out;
}

gg_contact_average gg_theory_contact_average_frictional(const gg_contact_pair *p, gg_vec k)
{
  const local_gaussian x = local_of(p, k);
  local_sums f = {.rate = 0};
  add_all(p, &x, &f);
  /* Torques before axes turn: rounding of the normal impulse, much the larger one for small mu, must not enter. */
  const gg_tensor P = regression(&x, &f), kP = turned_tensor(x.axes, gg_tensor_product(torque, P));
  const gg_tensor kJkJ = gg_tensor_product(gg_tensor_product(torque, f.JJ), torque), X = gg_tensor_cross(k);
  const double kJ[3] = {0, -f.J[2], f.J[1]};
  gg_contact_average a = {.rate = f.rate, .loss = f.loss, .J = turned(&x, f.J), .kJ = turned(&x, kJ)};
  a.JC = gg_tensor_product(turned_tensor(x.axes, P), p->one->M);
  a.JJ = turned_tensor(x.axes, f.JJ);
  a.kJs = gg_tensor_plus(gg_tensor_outer(a.kJ, (gg_vec){0, 0, p->one->spin}), -1,
                         gg_tensor_product(gg_tensor_product(kP, X), p->one->Theta)); /* cov(g, s_1) = -X Theta_1 */
  a.kJkJ = turned_tensor(x.axes, gg_tensor_scaled(-1, kJkJ));
  return a;
}
