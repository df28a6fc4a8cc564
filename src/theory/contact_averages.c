/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integrals over velocities, at fixed direction k, are those of a Gaussian vector z = (g, C_1, s_1) with mean m
 * and covariance S, weighted by the normal velocity u = k.g > 0, u ~ N(mu, v). With the regression on u, R = S
 * k_g/v, B = m - R mu, C = S - v R R^T, and I_p = int_0^inf u^p N(u; mu, v) du:
 *   <u+ z> = I_1 B + I_2 R,   <u+ z z^T> = I_1 (B B^T + C) + I_2 (B R^T + R B^T) + I_3 R R^T.
 *
 * With e(u) the impulse is J = jn(u) u k + jt (g - u k). Three more integrals hold jn:
 * D_p = int jn u^p N du, p = 2, 3, and E_3 = int jn^2 u^3 N du. */
#include "theory/contact_averages.h"

#include <math.h>
#include <stdbool.h>

/* Part of z, say a: <u+ a> and <u+ a b^T> follow from B_a, R_a and the covariance of a and b. */
typedef struct part {
  gg_vec B, R;
} part;

/* I_1 .. I_3 by recursion, I_p+1 = mu I_p + p v I_p-1. */
static void flux_integrals(double mu, double v, double I[4])
{
  I[0] = 0.5 * erfc(-mu / sqrt(2 * v));
  I[1] = mu * I[0] + sqrt(v / (2 * M_PI)) * exp(-mu * mu / (2 * v));
  I[2] = mu * I[1] + v * I[0];
  I[3] = mu * I[2] + 2 * v * I[1];
}

/* <u+ a b^T> */
static gg_tensor moment(const double I[4], double v, part a, part b, gg_tensor covariance)
{
  gg_tensor out = gg_tensor_scaled(I[1], gg_tensor_plus(gg_tensor_outer(a.B, b.B), 1, covariance));
  out = gg_tensor_plus(out, I[2], gg_tensor_plus(gg_tensor_outer(a.B, b.R), 1, gg_tensor_outer(a.R, b.B)));
  return gg_tensor_plus(out, I[3] - v * I[1], gg_tensor_outer(a.R, b.R));
}

/* D_2, D_3 and E_3 by Gauss's rule in panels, which end where e has a step. Normal speeds are below mu + 9 sqrt(v). */
typedef struct normal_integrals {
  double D2, D3, E3;
} normal_integrals;

static normal_integrals integrate_normal(const gg_contact_pair *p, double mu, double v)
{
  const double mr = 1 / gg_inverse_mr(p->contact);
  double end[GG_SPEED_PANELS + 1];
  normal_integrals sum = {0};
  const int n = gg_theory_speed_panels(p, fmax(mu + 9 * sqrt(v), sqrt(v)), 16, end);
  for (int k = 0; k < 6 * n; k++) {
    double u, w;
    gg_theory_panel_point(end[k / 6], end[k / 6 + 1], k % 6, &u, &w);
    const double jn = mr * (1 + gg_theory_coefficient_at(p, GG_OF_E, 0, u));
    w *= exp(-(u - mu) * (u - mu) / (2 * v)) / sqrt(2 * M_PI * v) * u * u;
    sum.D2 += w * jn, sum.D3 += w * jn * u, sum.E3 += w * jn * jn * u;
  }
  return sum;
}

/* Replace the parts of the averages that the normal impulse has: f is that of J = jt g alone; I, g and C are those of
 * constant_beta. */
static void add_normal(const gg_contact_pair *p, gg_vec k, double mu, double v, const double I[4], part g, part C,
                       gg_tensor ugg, gg_contact_average *f)
{
  static const gg_tensor one = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const double jt = p->contact->jt;
  const normal_integrals n = integrate_normal(p, mu, v);
  const gg_vec Bt = gg_axpy(-gg_dot(k, g.B), k, g.B), Rt = gg_axpy(-gg_dot(k, g.R), k, g.R);
  const gg_vec crossed = gg_scale(jt, gg_axpy(n.D3, Rt, gg_scale(n.D2, Bt)));
  const gg_vec normal_C = gg_axpy(n.D3, C.R, gg_scale(n.D2, C.B)),
               tangential_C = gg_axpy(I[3], C.R, gg_scale(I[2], C.B));
  f->J = gg_axpy(n.D2 - jt * I[2], k, f->J);
  f->JC = gg_tensor_plus(f->JC, 1, gg_tensor_outer(k, gg_axpy(-jt, tangential_C, normal_C)));
  const gg_tensor along = gg_tensor_outer(crossed, k), across = gg_tensor_plus(one, -1, gg_tensor_outer(k, k));
  f->JJ = gg_tensor_scaled(jt * jt, gg_tensor_product(gg_tensor_product(across, ugg), across));
  f->JJ = gg_tensor_plus(gg_tensor_plus(f->JJ, 1, along), 1, gg_tensor_transposed(along));
  f->JJ = gg_tensor_plus(f->JJ, n.E3, gg_tensor_outer(k, k));
  f->loss = n.D3 - 0.5 * gg_inverse_mr(p->contact) * n.E3;
}

/* J = L g, L = (jn - jt) k k^T + jt 1. */
static gg_contact_average constant_beta(const gg_contact_pair *p, gg_vec k)
{
  const double jn = p->contact->jn, jt = p->contact->jt;
  gg_tensor L = {{{jt, 0, 0}, {0, jt, 0}, {0, 0, jt}}}, X = gg_tensor_cross(k);
  if (!p->law[GG_OF_E]) L = gg_tensor_plus(L, jn - jt, gg_tensor_outer(k, k));
  /* Regression on u: spins do not contribute, and S_gC = M_1. */
  gg_vec mean = gg_theory_contact_velocity(p, k);
  gg_vec Sk = gg_tensor_times(gg_tensor_plus(p->one->M, 1, p->two->M), k);
  double v = gg_dot(k, Sk), mu = gg_dot(k, mean), I[4];
  flux_integrals(mu, v, I);
  part g = {.R = gg_scale(1 / v, Sk)}, C = {.R = gg_scale(1 / v, gg_tensor_times(p->one->M, k))};
  part s = {.B = {0, 0, p->one->spin}};
  g.B = gg_axpy(-mu, g.R, mean);
  C.B = gg_scale(-mu, C.R);
  gg_vec ug = gg_axpy(I[2], g.R, gg_scale(I[1], g.B));
  gg_tensor ugg = moment(I, v, g, g, gg_theory_contact_covariance(p, k));
  double normal = gg_dot(k, gg_tensor_times(ugg, k));
  gg_contact_average f = {.rate = I[1], .J = gg_tensor_times(L, ug), .loss = p->loss_n * normal};
  f.JC = gg_tensor_product(L, moment(I, v, g, C, p->one->M));
  f.JJ = gg_tensor_product(gg_tensor_product(L, ugg), L);
  if (p->law[GG_OF_E]) add_normal(p, k, mu, v, I, g, C, ugg, &f);
  if (jt == 0) return f;
  f.loss += p->loss_t * (gg_tensor_trace(ugg) - normal);
  gg_tensor Sgs = gg_tensor_product(X, gg_tensor_scaled(-1, p->one->Theta));
  f.kJ = gg_scale(jt, gg_cross(k, ug));
  f.kJs = gg_tensor_scaled(jt, gg_tensor_product(X, moment(I, v, g, s, Sgs)));
  f.kJkJ = gg_tensor_scaled(-jt * jt, gg_tensor_product(gg_tensor_product(X, ugg), X));
  return f;
}

gg_contact_average gg_theory_contact_average(const gg_contact_pair *p, gg_vec k)
{
  const bool slides = p->contact->jt > 0 && (isfinite(p->contact->mu) || p->law[GG_OF_MU]);
  return slides || p->law[GG_OF_BETA] ? gg_theory_contact_average_frictional(p, k) : constant_beta(p, k);
}
