/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts whose e, beta and mu depend on the normal speed u: at a given u, g_t is Gaussian with the mean m_t + r (u -
 * m_n), r = S_tn/S_nn, and the covariance S_tt - S_nn r r^T. J_n = jn u, and J_t = j g_t with j = jt where |g_t| is at
 * most L = mu jn u/jt (the contact sticks), else mu jn u/|g_t|. On a ray g_t = rho (cos alpha, sin alpha) the Gaussian
 * is exp(-(a rho^2 - 2 b rho + c)/2): closed integrals in rho up to L and beyond, equal steps in alpha, and Gauss's
 * rule in panels of u that end at the steps of the laws. */
#include <math.h>
#include <string.h>

#include "theory/contact_averages.h"

enum { ANGLES = 20, SPEEDS = 10 };

void gg_theory_panel_point(double from, double to, int a, double *u, double *weight)
{
  static const double node[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521},
                      w[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double half = (to - from) / 2;
  *u = from + half * (1 + (a % 2 ? node[a / 2] : -node[a / 2]));
  *weight = half * w[a / 2];
}

int gg_theory_speed_panels(const gg_contact_pair *p, double to, int panels, double end[GG_SPEED_PANELS + 1])
{
  const double width = to / panels, unit = p->speed_unit;
  int n = 0;
  end[0] = 0;
  for (int k = 0; k < panels; k++) {
    const int first = n + 1;
    const double from = fmax(k * width, 1e-9 * width), last = (k + 1) * width;
    for (int c = 0; c < GG_N_COEFFICIENTS; c++) {
      gg_law_change step[GG_LAW_STEPS];
      int steps = 0;
      if (p->law[c]) (void)gg_common_speed_law_changes(p->law[c], unit * from, unit * last, step, &steps, NULL);
      for (int s = 0; s < steps && n < GG_SPEED_PANELS - panels; s++) {
        int at = ++n;
        for (; at > first && end[at - 1] > step[s].at / unit; at--) end[at] = end[at - 1];
        end[at] = step[s].at / unit;
      }
    }
    end[++n] = last;
  }
  return n;
}

/* int rho^q exp(-(a rho^2 - 2 b rho + c)/2) drho, q = 1 .. 3, from `low` to `high`, which may be infinite. */
static void radial(double a, double b, double c, double low, double high, double I[4])
{
  const double x = b / a, root = sqrt(a / 2),
               end[2] = {exp(-(a * low * low - 2 * b * low + c) / 2),
                         high < INFINITY ? exp(-(a * high * high - 2 * b * high + c) / 2) : 0};
  const double top = high < INFINITY ? high : 0;
  const double tails =
      low > x ? erfc((low - x) * root) - erfc((high - x) * root) : erf((high - x) * root) - erf((low - x) * root);
  I[0] = sqrt(M_PI) / (2 * root) * exp((b * x - c) / 2) * tails;
  I[1] = x * I[0] + (end[0] - end[1]) / a;
  I[2] = x * I[1] + (I[0] + low * end[0] - top * end[1]) / a;
  I[3] = x * I[2] + (2 * I[1] + low * low * end[0] - top * top * end[1]) / a;
}

/* g_t at one normal speed: its mean, the inverse of its covariance, and the norm of the Gaussian. */
typedef struct tangential {
  double m[2], P[2][2], norm;
} tangential;

/* Means of J_t, J_t g_t^T and J_t J_t^T at one normal speed. */
typedef struct friction_means {
  double J[2], Jg[2][2], JJ[2][2];
} friction_means;

static friction_means means_at(const tangential *t, double jt, double limit)
{
  friction_means f = {0};
  const double L = jt > 0 ? limit / jt : INFINITY, sliding = L < INFINITY ? limit : 0;
  for (int k = 0; k < ANGLES; k++) {
    const double alpha = 2 * M_PI * (k + 0.5) / ANGLES, w = t->norm * 2 * M_PI / ANGLES;
    const double d[2] = {cos(alpha), sin(alpha)};
    const double Pd[2] = {t->P[0][0] * d[0] + t->P[0][1] * d[1], t->P[1][0] * d[0] + t->P[1][1] * d[1]};
    const double a = d[0] * Pd[0] + d[1] * Pd[1], b = t->m[0] * Pd[0] + t->m[1] * Pd[1];
    const double c = t->m[0] * (t->P[0][0] * t->m[0] + t->P[0][1] * t->m[1]) +
                     t->m[1] * (t->P[1][0] * t->m[0] + t->P[1][1] * t->m[1]);
    double stick[4] = {0}, slide[4] = {0};
    if (L > 0) radial(a, b, c, 0, L, stick);
    if (L < INFINITY) radial(a, b, c, L, INFINITY, slide);
    const double J = w * (jt * stick[2] + sliding * slide[1]), Jg = w * (jt * stick[3] + sliding * slide[2]),
                 JJ = w * (jt * jt * stick[3] + sliding * sliding * slide[1]);
    for (int i = 0; i < 2; i++) {
      f.J[i] += J * d[i];
      for (int l = 0; l < 2; l++) f.Jg[i][l] += Jg * d[i] * d[l], f.JJ[i][l] += JJ * d[i] * d[l];
    }
  }
  return f;
}

/* Add the contacts of one normal speed; w: the density of u there, times u, times the width that it represents. */
static void add_speed(const gg_contact_pair *p, double u, double w, const tangential *t, gg_local_sums *s)
{
  const gg_contact *c = p->contact;
  const double imr = gg_inverse_mr(c), imt = gg_inverse_mt(c);
  const double jn = (1 + gg_theory_coefficient_at(p, GG_OF_E, c->jn * imr - 1, u)) / imr,
               jt = (1 + gg_theory_coefficient_at(p, GG_OF_BETA, c->jt * imt - 1, u)) / imt;
  const double Jn = jn * u, limit = gg_theory_coefficient_at(p, GG_OF_MU, c->mu, u) * Jn;
  const friction_means f = means_at(t, jt, limit);
  s->rate += w;
  s->J[0] += w * Jn;
  s->Jg.at[0][0] += w * Jn * u;
  s->JJ.at[0][0] += w * Jn * Jn;
  double tangential_loss = 0;
  for (int i = 0; i < 2; i++) {
    s->J[1 + i] += w * f.J[i];
    s->Jg.at[0][1 + i] += w * Jn * t->m[i];
    s->Jg.at[1 + i][0] += w * f.J[i] * u;
    s->JJ.at[0][1 + i] += w * Jn * f.J[i];
    s->JJ.at[1 + i][0] += w * Jn * f.J[i];
    tangential_loss += f.Jg[i][i] - 0.5 * imt * f.JJ[i][i];
    for (int l = 0; l < 2; l++) s->Jg.at[1 + i][1 + l] += w * f.Jg[i][l], s->JJ.at[1 + i][1 + l] += w * f.JJ[i][l];
  }
  s->loss += w * (Jn * u - 0.5 * imr * Jn * Jn + tangential_loss);
}

void gg_theory_contact_sums_by_speed(const gg_contact_pair *p, const double m[3], const gg_tensor *S,
                                     gg_local_sums *sums)
{
  const double v = S->at[0][0], r[2] = {S->at[1][0] / v, S->at[2][0] / v};
  const double C[2][2] = {{S->at[1][1] - v * r[0] * r[0], S->at[1][2] - v * r[0] * r[1]},
                          {S->at[2][1] - v * r[1] * r[0], S->at[2][2] - v * r[1] * r[1]}};
  const double D = C[0][0] * C[1][1] - C[0][1] * C[1][0];
  tangential t = {.P = {{C[1][1] / D, -C[0][1] / D}, {-C[1][0] / D, C[0][0] / D}}, .norm = 1 / (2 * M_PI * sqrt(D))};
  double end[GG_SPEED_PANELS + 1];
  memset(sums, 0, sizeof *sums);
  if (!(D > 0)) return; /* no Gaussian */
  const int n = gg_theory_speed_panels(p, fmax(m[0] + 8 * sqrt(v), sqrt(v)), SPEEDS, end);
  for (int k = 0; k < 6 * n; k++) {
    double u, w;
    gg_theory_panel_point(end[k / 6], end[k / 6 + 1], k % 6, &u, &w);
    for (int i = 0; i < 2; i++) t.m[i] = m[1 + i] + r[i] * (u - m[0]);
    add_speed(p, u, w * u * exp(-(u - m[0]) * (u - m[0]) / (2 * v)) / sqrt(2 * M_PI * v), &t, sums);
  }
}
