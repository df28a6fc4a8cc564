/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/rough_collision.h"

#include <gsl/gsl_integration.h>
#include <math.h>

/* Points of the rule on (u0, farthest); beyond that the weight is below 1e-31. */
enum { POINTS = 48 };
static const double farthest = 12;

static void cross(const double a[3], const double b[3], double c[3])
{
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, l = (i + 2) % 3;
    c[i] = a[j] * b[l] - a[l] * b[j];
  }
}

void gg_rough_divide(const double A[3][3], double x[3])
{
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < i; j++) x[i] -= A[i][j] * x[j];
    x[i] /= A[i][i];
  }
}

static double dot(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* J = eta2 g + (eta1 - eta2) k g_n */
static void impulse(const gg_rough_gas *gas, const double k[3], const double g[3], double J[3])
{
  double along = dot(k, g);
  for (int i = 0; i < 3; i++) J[i] = gas->eta2 * g[i] + (gas->eta1 - gas->eta2) * along * k[i];
}

/* Change of (d, p) by an impulse: d' = d - sqrt2 L^-1 J, p' = p - (sqrt2/K) S^-1 (k x J). */
static void kick(const gg_rough_gas *gas, const gg_rough_weight *w, const double k[3], const double J[3],
                 double change[GG_ROUGH_AXES])
{
  double torque[3], *spin = change + 3;
  cross(k, J, torque);
  for (int i = 0; i < 3; i++) change[i] = -M_SQRT2 * J[i], spin[i] = -M_SQRT2 / gas->K * torque[i];
  gg_rough_divide(w->L, change);
  gg_rough_divide(w->S, spin);
}

/* Contact velocity g = C_12 - flow - k x (s1 + s2) of one standard normal coordinate at 1 and all others at 0. */
static void contact_velocity(const gg_rough_weight *w, const double k[3], int axis, double g[3])
{
  double column[3], swirl[3];
  bool spin = axis >= 3;
  for (int i = 0; i < 3; i++) column[i] = M_SQRT2 * (spin ? w->S[i][axis - 3] : w->L[i][axis]);
  cross(k, column, swirl);
  for (int i = 0; i < 3; i++) g[i] = spin ? -swirl[i] : column[i];
}

gg_rough_collision gg_rough_collision_at(const gg_rough_gas *gas, const gg_rough_weight *w, const double k[3])
{
  gg_rough_collision c = {.s = 0};
  double g[3], J[3], change[GG_ROUGH_AXES], mean[3] = {0, 0, 2 * w->spin}, swirl[3], length;
  for (int axis = 0; axis < GG_ROUGH_AXES; axis++) {
    contact_velocity(w, k, axis, g);
    if (axis < 3) c.normal[axis] = dot(k, g);
    impulse(gas, k, g, J);
    kick(gas, w, k, J, change);
    for (int i = 0; i < 3; i++) c.J[i][axis] = J[i];
    for (int i = 0; i < GG_ROUGH_AXES; i++) c.M[i][axis] = (i == axis) + change[i];
  }
  cross(k, mean, swirl);
  for (int i = 0; i < 3; i++) g[i] = -gas->shear * k[1] * (i == 0) - swirl[i];
  impulse(gas, k, g, c.J0);
  kick(gas, w, k, c.J0, c.b);
  length = sqrt(dot(c.normal, c.normal));
  for (int i = 0; i < 3; i++) c.normal[i] /= length;
  c.s = length;
  c.u0 = -dot(k, g) / length;
  return c;
}

gg_rough_contact gg_rough_contact_at(const gg_rough_gas *gas, const gg_rough_weight *w, const double k[3],
                                     const double axis[3][3])
{
  gg_rough_contact c;
  double g[3], mean[3] = {0, 0, 2 * w->spin}, swirl[3];
  cross(k, mean, swirl);
  for (int i = 0; i < 3; i++) {
    kick(gas, w, k, axis[i], c.B[i]);
    c.m[i] = -gas->shear * k[1] * axis[i][0] - dot(axis[i], swirl);
  }
  for (int z = 0; z < GG_ROUGH_AXES; z++) {
    contact_velocity(w, k, z, g);
    for (int i = 0; i < 3; i++) c.G[i][z] = dot(axis[i], g);
  }
  return c;
}

void gg_rough_flux(const gg_rough_collision *c, int most, double *moment)
{
  double from = fmax(c->u0, -farthest), to = fmax(farthest, from);
  gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(POINTS);
  for (int m = 0; m <= most; m++) moment[m] = 0;
  for (size_t i = 0; rule && i < POINTS; i++) {
    double u, w, before = 0, now = 1;
    gsl_integration_glfixed_point(from, to, i, &u, &w, rule);
    w *= c->s * (u - c->u0) * exp(-u * u / 2) / sqrt(2 * M_PI);
    for (int m = 0; m <= most; m++) {
      moment[m] += w * now;
      double next = (u * now - sqrt(m) * before) / sqrt(m + 1);
      before = now, now = next;
    }
  }
  if (rule) gsl_integration_glfixed_table_free(rule);
}
