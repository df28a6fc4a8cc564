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
#include "simd/clones.h"
#include "theory/contact_averages.h"

enum { AZIMUTH = 16, POLAR = 4, MORE_POLAR = 10, MOST_RAYS = 24, SUMS = 2 + 3 + 2 * 9 };

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

_Static_assert(sizeof(gg_local_sums) == SUMS * sizeof(double), "numbers alone");

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

/* Rays of one alpha, one a lane, so that the processor computes several at once; each has the operations of one alone.
 * Lanes beyond the last ray hold any finite numbers. */
typedef struct fan {
  double v[3][MOST_RAYS], w[MOST_RAYS];           /* direction; solid angle */
  double J[3][MOST_RAYS], along2[MOST_RAYS];      /* impulse over rho; loss over rho^2 */
  double A[MOST_RAYS], x0[MOST_RAYS];             /* of exp(-(A rho^2 - 2 B rho + C)/2); B/A */
  double exponent[MOST_RAYS], erfc_of[MOST_RAYS]; /* arguments of the functions in the integral of rho^0 */
  double I0[MOST_RAYS], end;                      /* that integral without its factor; exp(-C/2) */
  double add[SUMS][MOST_RAYS];                    /* what each ray adds to gg_local_sums */
} fan;

/* Impulses, and the Gaussian along each ray. */
GG_CLONES static void prepare(const gg_contact_pair *p, const local_gaussian *x, fan *f)
{
  const gg_contact *c = p->contact;
  const gg_tensor R = x->R;
  const double jn = c->jn, jt = c->jt, steepest = c->mu * jn, inverse_mt = gg_inverse_mt(c);
  for (int a = 0; a < MOST_RAYS; a++) {
    const double v0 = f->v[0][a], v1 = f->v[1][a], v2 = f->v[2][a];
    const double along = sqrt(v1 * v1 + v2 * v2), limit = steepest * v0, slides = limit / along;
    const bool sticks = jt * along <= limit;
    const double j = sticks ? jt : slides, slid = j * (1 - j * inverse_mt / 2), lost = sticks ? p->loss_t : slid;
    f->J[0][a] = jn * v0, f->J[1][a] = j * v1, f->J[2][a] = j * v2;
    f->along2[a] = p->loss_n * v0 * v0 + lost * along * along;
    const double y0 = v0 / R.at[0][0], y1 = (v1 - R.at[1][0] * y0) / R.at[1][1],
                 y2 = (v2 - R.at[2][0] * y0 - R.at[2][1] * y1) / R.at[2][2];
    const double A = y0 * y0 + y1 * y1 + y2 * y2, B = y0 * x->y[0] + y1 * x->y[1] + y2 * x->y[2];
    const double x0 = B / A, root = sqrt(A / 2);
    f->A[a] = A, f->x0[a] = x0;
    f->exponent[a] = (B * x0 - x->C) / 2, f->erfc_of[a] = -x0 * root;
    f->I0[a] = sqrt(M_PI) / (2 * root);
  }
}

/* int_0^inf rho^p exp(-(A rho^2 - 2 B rho + C)/2) drho, p = 0 .. 5, by recursion; then what the rays add. */
GG_CLONES static void integrate(fan *f)
{
  for (int a = 0; a < MOST_RAYS; a++) {
    const double A = f->A[a], x0 = f->x0[a], I0 = f->I0[a];
    const double I1 = x0 * I0 + f->end / A, I2 = x0 * I1 + I0 / A, I3 = x0 * I2 + 2 * I1 / A, I4 = x0 * I3 + 3 * I2 / A,
                 I5 = x0 * I4 + 4 * I3 / A;
    const double w = f->w[a] * f->v[0][a], w4 = w * I4, w5 = w * I5;
    f->add[0][a] = w * I3;
    f->add[1][a] = w5 * f->along2[a];
    for (int i = 0; i < 3; i++) {
      f->add[2 + i][a] = w4 * f->J[i][a];
      for (int l = 0; l < 3; l++) {
        f->add[5 + 3 * i + l][a] = w5 * f->J[i][a] * f->v[l][a];
        f->add[14 + 3 * i + l][a] = w5 * f->J[i][a] * f->J[l][a];
      }
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

/* Place rays of one alpha, from an angle psi to another, behind `n` others. Returns how many there are then. */
static int place(const local_gaussian *x, const double t[2], const polar_rule *rule, double from, double to, double w,
                 fan *f, int n)
{
  for (int a = 0; a < rule->n; a++, n++) {
    double psi, wa;
    gsl_integration_glfixed_point(from, to, (size_t)a, &psi, &wa, rule->table);
    f->v[0][n] = x->n * cos(psi), f->v[1][n] = sin(psi) * t[0], f->v[2][n] = sin(psi) * t[1];
    f->w[n] = w * wa * sin(psi);
  }
  return n;
}

/* The rays of one alpha: contacts stick up to the angle `edge`, and slide beyond. */
static void add_fan(const gg_contact_pair *p, const local_gaussian *x, const double t[2], const polar_rule *sticks,
                    const polar_rule *slides, double edge, double w, fan *f, double sums[SUMS])
{
  int n = place(x, t, sticks, 0, edge, w, f, 0);
  n = place(x, t, slides, edge, M_PI_2, w, f, n);
  prepare(p, x, f);
  for (int a = 0; a < n && x->C != 0; a++) f->I0[a] *= exp(f->exponent[a]) * erfc(f->erfc_of[a]);
  integrate(f);
  for (int q = 0; q < SUMS; q++)
    for (int a = 0; a < n; a++) sums[q] += f->add[q][a];
}

static void add_all(const gg_contact_pair *p, const local_gaussian *x, double sums[SUMS])
{
  fan f = {.end = exp(-x->C / 2)};
  for (int a = 0; a < MOST_RAYS; a++) f.v[0][a] = 1;
  const double *t = x->t, limit = p->contact->mu * p->contact->jn * x->n / p->contact->jt; /* of g_t at psi = 45 deg */
  const double middle = atan(limit / sqrt(t[0] * t[2]));
  if (!isfinite(middle)) return; /* no Gaussian */
  polar_rule sticks = rule_for(middle), slides = rule_for(M_PI_2 - middle);
  const int azimuths = AZIMUTH + (int)(5 * sqrt(x->C)); /* the faster the flow, the narrower the Gaussian in alpha */
  for (int b = 0; b < azimuths && sticks.table && slides.table; b++) {
    const double alpha = 2 * M_PI * (b + 0.5) / azimuths, w = x->density * x->n * t[0] * t[2] * 2 * M_PI / azimuths;
    const double along[2] = {t[0] * cos(alpha), t[1] * cos(alpha) + t[2] * sin(alpha)};
    const double edge = atan(limit / hypot(along[0], along[1]));
    add_fan(p, x, along, &sticks, &slides, edge, w, &f, sums);
  }
  if (!sticks.table || !slides.table) gg_base_memory_lacked(); /* the caller of the theory reports it */
  if (sticks.table) gsl_integration_glfixed_table_free(sticks.table);
  if (slides.table) gsl_integration_glfixed_table_free(slides.table);
}

/* k x v, in these axes. */
static const gg_tensor torque = {{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}};

/* <u+ J (g - m)^T> S^-1, in these axes. */
static gg_tensor regression(const local_gaussian *x, const gg_local_sums *f)
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
  double sums[SUMS] = {0};
  gg_local_sums f;
  if (p->law[GG_OF_E] || p->law[GG_OF_BETA] || p->law[GG_OF_MU]) {
    const gg_tensor S = gg_tensor_product(x.R, gg_tensor_transposed(x.R));
    gg_theory_contact_sums_by_speed(p, x.m, &S, &f);
  } else {
    add_all(p, &x, sums);
    memcpy(&f, sums, sizeof f);
  }
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
