/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/friction_points.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Points of the discrete weight from which a Gauss rule is made, on (0, B/sqrt A + farthest). */
enum { DISCRETE = 64, MOST = GG_ROUGH_MOST_DEGREE + 1, FEWEST_AZIMUTHS = 16 };
static const double farthest = 10;

/* Square of the mean contact velocity in units of thermal ones up to which the azimuths give 1e-5. */
static const double fastest = 10;

struct gg_rough_rays {
  int degree, azimuths;
  gg_rough_point *stick, *slides;
  gg_rough_slide *slide; /* by azimuth */
  gsl_integration_glfixed_table *discrete;
  gsl_eigen_symmv_workspace *eigen;
  gsl_matrix *jacobi, *vectors;
  gsl_vector *values;
};

static double dot6(const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < GG_ROUGH_AXES; i++) sum += a[i] * b[i];
  return sum;
}

static void set_axes(const double k[3], double axis[3][3])
{
  const int least = fabs(k[0]) < 0.9 ? 0 : 1;
  double along = k[least], length = sqrt(1 - along * along);
  for (int i = 0; i < 3; i++) axis[0][i] = k[i], axis[1][i] = ((i == least) - along * k[i]) / length;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    axis[2][i] = k[j] * axis[1][l] - k[l] * axis[1][j];
  }
}

/* Append the part of `vector` that is orthogonal to the n rows so far, if it is longer than `least` of the vector. */
static int append(double Y[][GG_ROUGH_AXES], int n, const double *vector, double least)
{
  double rest[GG_ROUGH_AXES];
  if (n == GG_ROUGH_AXES) return n;
  memcpy(rest, vector, sizeof rest);
  for (int twice = 0; twice < 2; twice++)
    for (int i = 0; i < n; i++) {
      const double along = dot6(Y[i], rest);
      for (int z = 0; z < GG_ROUGH_AXES; z++) rest[z] -= along * Y[i][z];
    }
  const double length = sqrt(dot6(rest, rest));
  if (!(length > least * sqrt(dot6(vector, vector)))) return n;
  for (int z = 0; z < GG_ROUGH_AXES; z++) Y[n][z] = rest[z] / length;
  return n + 1;
}

static double determinant(double A[GG_ROUGH_AXES][GG_ROUGH_AXES])
{
  double B[GG_ROUGH_AXES][GG_ROUGH_AXES], product = 1;
  memcpy(B, A, sizeof B);
  for (int c = 0; c < GG_ROUGH_AXES; c++) {
    int pivot = c;
    for (int r = c + 1; r < GG_ROUGH_AXES; r++)
      if (fabs(B[r][c]) > fabs(B[pivot][c])) pivot = r;
    for (int i = 0; i < GG_ROUGH_AXES && pivot != c; i++) {
      const double kept = B[c][i];
      B[c][i] = B[pivot][i], B[pivot][i] = -kept;
    }
    product *= B[c][c];
    for (int r = c + 1; r < GG_ROUGH_AXES; r++)
      for (int i = GG_ROUGH_AXES - 1; i >= c; i--) B[r][i] -= B[r][c] / B[c][c] * B[c][i];
  }
  return product;
}

/* Orthonormal rows: first those of G, then the shifts by impulses, then unit vectors for what is missing. */
static void set_rows(gg_rough_frame *x, const gg_rough_contact *c)
{
  int n = 0;
  for (int i = 0; i < 3; i++) n = append(x->Y, n, c->G[i], 0);
  for (int i = 0; i < 3; i++) n = append(x->Y, n, c->B[i], 1e-8);
  for (int z = 0; z < GG_ROUGH_AXES; z++) {
    double unit[GG_ROUGH_AXES] = {0};
    unit[z] = 1;
    n = append(x->Y, n, unit, 0.3);
  }
  if (determinant(x->Y) < 0)
    for (int z = 0; z < GG_ROUGH_AXES; z++) x->Y[GG_ROUGH_AXES - 1][z] *= -1;
}

gg_rough_frame gg_rough_frame_of(const gg_rough_gas *gas, const gg_rough_weight *weight, const double k[3])
{
  gg_rough_frame x = {.eta1 = gas->eta1, .eta2 = gas->eta2, .mu = gas->mu};
  set_axes(k, x.axis);
  const gg_rough_contact c = gg_rough_contact_at(gas, weight, k, (const double(*)[3])x.axis);
  set_rows(&x, &c);
  for (int i = 0; i < 3; i++) {
    x.m[i] = c.m[i];
    for (int j = 0; j <= i; j++) x.R[i][j] = dot6(c.G[i], x.Y[j]);
    for (int y = 0; y < GG_ROUGH_AXES; y++) x.D[y][i] = dot6(x.Y[y], c.B[i]);
  }
  return x;
}

/* Points in psi on either side of the angle at which contacts begin to slide, by the part of pi/2 that the side has. */
static int polar_points(int degree, double part)
{
  return 4 + (int)((degree + 6) * part + 0.5);
}

static int most_polar(int degree)
{
  return polar_points(degree, 1);
}

gg_status gg_rough_rays_make(gg_rough_rays **out, int degree, gg_error *err)
{
  gg_rough_rays *x = *out = calloc(1, sizeof *x);
  if (!x) return gg_base_out_of_memory(err);
  const size_t n = (size_t)degree + 1;
  x->degree = degree;
  x->azimuths = 2 * degree + 6 > FEWEST_AZIMUTHS ? 2 * degree + 6 : FEWEST_AZIMUTHS;
  const size_t most = (size_t)x->azimuths * (size_t)most_polar(degree) * n;
  x->stick = malloc(most * sizeof *x->stick);
  x->slides = malloc(most * sizeof *x->slides);
  x->slide = malloc((size_t)x->azimuths * sizeof *x->slide);
  x->discrete = gsl_integration_glfixed_table_alloc(DISCRETE);
  x->eigen = gsl_eigen_symmv_alloc(n);
  x->jacobi = gsl_matrix_alloc(n, n);
  x->vectors = gsl_matrix_alloc(n, n);
  x->values = gsl_vector_alloc(n);
  if (!x->stick || !x->slides || !x->slide || !x->discrete || !x->eigen || !x->jacobi || !x->vectors || !x->values)
    return gg_base_out_of_memory(err);
  return GG_OK;
}

void gg_rough_rays_free(gg_rough_rays *x)
{
  if (!x) return;
  free(x->stick);
  free(x->slides);
  free(x->slide);
  if (x->discrete) gsl_integration_glfixed_table_free(x->discrete);
  if (x->eigen) gsl_eigen_symmv_free(x->eigen);
  if (x->jacobi) gsl_matrix_free(x->jacobi);
  if (x->vectors) gsl_matrix_free(x->vectors);
  if (x->values) gsl_vector_free(x->values);
  free(x);
}

/* Coefficients of the recursion of polynomials that are orthonormal under a discrete weight, as a Jacobi matrix
 * (Stieltjes' procedure). Returns the sum of the weight. */
static double make_jacobi(const double *x, const double *w, gsl_matrix *J)
{
  const size_t n = J->size1;
  double p[DISCRETE], before[DISCRETE] = {0}, sum = 0, beta = 0;
  for (int i = 0; i < DISCRETE; i++) sum += w[i];
  for (int i = 0; i < DISCRETE; i++) p[i] = 1 / sqrt(sum);
  gsl_matrix_set_zero(J);
  for (size_t k = 0; k < n; k++) {
    double alpha = 0, norm = 0;
    for (int i = 0; i < DISCRETE; i++) alpha += w[i] * x[i] * p[i] * p[i];
    gsl_matrix_set(J, k, k, alpha);
    for (int i = 0; i < DISCRETE; i++) {
      const double next = (x[i] - alpha) * p[i] - beta * before[i];
      before[i] = p[i], p[i] = next;
      norm += w[i] * next * next;
    }
    beta = sqrt(norm);
    for (int i = 0; i < DISCRETE; i++) p[i] /= beta;
    if (k + 1 < n) gsl_matrix_set(J, k, k + 1, beta), gsl_matrix_set(J, k + 1, k, beta);
  }
  return sum;
}

/* Gauss rule of x^3 exp(-x^2/2 + b x) on (0, inf). */
static void make_rule(gg_rough_rays *r, double b, double *x, double *w)
{
  double at[DISCRETE], weight[DISCRETE];
  for (size_t i = 0; i < DISCRETE; i++) {
    gsl_integration_glfixed_point(0, fmax(b, 0) + farthest, i, &at[i], &weight[i], r->discrete);
    weight[i] *= at[i] * at[i] * at[i] * exp((b - at[i] / 2) * at[i]);
  }
  const double sum = make_jacobi(at, weight, r->jacobi);
  gsl_eigen_symmv(r->jacobi, r->values, r->vectors, r->eigen);
  for (size_t i = 0; i < r->values->size; i++) {
    const double first = gsl_matrix_get(r->vectors, 0, i);
    x[i] = gsl_vector_get(r->values, i);
    w[i] = sum * first * first;
  }
}

/* The Gaussian in terms of rays. */
typedef struct ray_gauss {
  double n, t[3];             /* spread of g_n; of g_t = (t[0] cos alpha, t[1] cos alpha + t[2] sin alpha) */
  double y0[3];               /* R^-1 m */
  double C;                   /* its square */
  double unit;                /* exp(-C/2) and all that is the same for all rays */
  double x[MOST], w[MOST], b; /* the latest rule in rho */
} ray_gauss;

static ray_gauss gauss_of(gg_rough_rays *r, const gg_rough_frame *f)
{
  ray_gauss g = {.n = f->R[0][0], .b = 0};
  const double(*R)[3] = f->R;
  const double S11 = R[1][0] * R[1][0] + R[1][1] * R[1][1], S12 = R[1][0] * R[2][0] + R[1][1] * R[2][1];
  const double S22 = R[2][0] * R[2][0] + R[2][1] * R[2][1] + R[2][2] * R[2][2];
  g.t[0] = sqrt(S11), g.t[1] = S12 / g.t[0], g.t[2] = sqrt(S22 - g.t[1] * g.t[1]);
  for (int i = 0; i < 3; i++) g.y0[i] = f->m[i];
  gg_rough_divide(R, g.y0);
  g.C = g.y0[0] * g.y0[0] + g.y0[1] * g.y0[1] + g.y0[2] * g.y0[2];
  g.unit = g.n * g.t[0] * g.t[2] * exp(-g.C / 2) / (pow(2 * M_PI, 1.5) * R[0][0] * R[1][1] * R[2][2]);
  make_rule(r, 0, g.x, g.w);
  return g;
}

static gg_rough_point *add_ray(gg_rough_rays *r, const gg_rough_frame *f, ray_gauss *g, const double v[3],
                               double weight, gg_rough_point *to)
{
  double u[3] = {v[0], v[1], v[2]}, A = 0, B = 0;
  gg_rough_divide(f->R, u);
  for (int i = 0; i < 3; i++) A += u[i] * u[i], B += u[i] * g->y0[i];
  const double b = B / sqrt(A);
  if (b != g->b) make_rule(r, g->b = b, g->x, g->w);
  for (int q = 0; q <= r->degree; q++, to++) {
    const double rho = g->x[q] / sqrt(A);
    to->weight = weight * g->unit * v[0] * g->w[q] / (A * A);
    to->normal = rho * v[0];
    for (int i = 0; i < 3; i++) to->y[i] = rho * u[i] - g->y0[i];
  }
  return to;
}

gg_rough_points gg_rough_rays_points(gg_rough_rays *r, const gg_rough_frame *f)
{
  ray_gauss g = gauss_of(r, f);
  const double limit = f->mu * f->eta1 * g.n / f->eta2, middle = atan(limit / sqrt(g.t[0] * g.t[2]));
  const int many[2] = {polar_points(r->degree, middle / M_PI_2), polar_points(r->degree, 1 - middle / M_PI_2)};
  gg_rough_point *to[2] = {r->stick, r->slides};
  gsl_integration_glfixed_table *rule[2];
  int a = 0;
  for (int side = 0; side < 2; side++) rule[side] = gsl_integration_glfixed_table_alloc((size_t)many[side]);
  for (; a < r->azimuths && g.C < fastest && rule[0] && rule[1]; a++) {
    const double alpha = 2 * M_PI * (a + 0.5) / r->azimuths;
    const double t[2] = {g.t[0] * cos(alpha), g.t[1] * cos(alpha) + g.t[2] * sin(alpha)}, along = hypot(t[0], t[1]);
    const double edge = atan(limit / along), slip = f->mu * f->eta1 / along;
    const int points = many[0] + (edge < M_PI_2 ? many[1] : 0);
    r->slide[a] = (gg_rough_slide){.J = {f->eta1, slip * t[0], slip * t[1]}, .point = to[1]};
    for (int i = 0; i < points; i++) {
      const int side = i >= many[0];
      double psi, w;
      gsl_integration_glfixed_point(side ? edge : 0, side ? M_PI_2 : edge, (size_t)(side ? i - many[0] : i), &psi, &w,
                                    rule[side]);
      const double v[3] = {g.n * cos(psi), sin(psi) * t[0], sin(psi) * t[1]};
      to[side] = add_ray(r, f, &g, v, w * sin(psi) * 2 * M_PI / r->azimuths, to[side]);
    }
    r->slide[a].n = (int)(to[1] - r->slide[a].point);
  }
  for (int side = 0; side < 2; side++)
    if (rule[side]) gsl_integration_glfixed_table_free(rule[side]);
  return (gg_rough_points){(int)(to[0] - r->stick), a, r->stick, r->slide};
}
