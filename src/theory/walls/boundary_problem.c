/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/boundary_problem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/walls/band_matrix.h"

enum { MOST = GG_BOUNDARY_FUNCTIONS, STEPS = 40, HALVINGS = 8, STUCK = 3, LOST = 5, MESHES = 24 };

/* Width of differences for derivatives, in units of a function's scale; step of Newton's method, likewise, below which
 * it has converged. */
static const double difference = 1e-7, converged = 1e-11;

typedef double square[MOST][MOST];

typedef struct work {
  const gg_boundary_problem *p;
  gg_boundary_solution *s;
  gg_functions *v, *f; /* a trial, and its slopes */
  square *J;           /* df/dv at the points */
  double *left, *step; /* left sides of the equations; the step of Newton's method */
  gg_band_matrix A;
} work;

static int unknowns(const work *w)
{
  return w->p->n * w->s->points;
}

static void slopes(const gg_boundary_problem *p, int points, const gg_functions *v, gg_functions *f)
{
  for (int i = 0; i < points; i++) p->slope(p->self, v[i], f[i]);
}

/* Value in the middle of an interval of length h, from values and slopes at its ends. */
static void middle_of(const gg_boundary_problem *p, double h, const gg_functions *v, const gg_functions *f, double *to)
{
  for (int k = 0; k < p->n; k++) to[k] = 0.5 * (v[0][k] + v[1][k]) - h / 8 * (f[1][k] - f[0][k]);
}

/* Left sides of all equations, in units of scales: 0 for a solution. */
static void leftover(const work *w, const gg_functions *v, const gg_functions *f, double *left)
{
  const gg_boundary_problem *p = w->p;
  const int n = p->n, last = w->s->points - 1;
  p->lower(p->self, v[0], left);
  for (int i = 0; i < last; i++) {
    const double h = w->s->y[i + 1] - w->s->y[i];
    double vm[MOST], fm[MOST], *at = left + p->n_lower + n * i;
    middle_of(p, h, v + i, f + i, vm);
    p->slope(p->self, vm, fm);
    for (int k = 0; k < n; k++)
      at[k] = (v[i + 1][k] - v[i][k] - h / 6 * (f[i][k] + 4 * fm[k] + f[i + 1][k])) / p->scale[k];
  }
  p->upper(p->self, v[last], left + p->n_lower + n * last);
}

typedef void of_values(void *self, const double v[], double f[]);

/* df_j/dv_k of `rows` functions by central differences, per scale of v_k. */
static void derivative(const gg_boundary_problem *p, of_values *f, int rows, const double *v, square J)
{
  double at[MOST], up[MOST], down[MOST];
  memcpy(at, v, (size_t)p->n * sizeof *v);
  for (int k = 0; k < p->n; k++) {
    const double d = difference * p->scale[k];
    at[k] = v[k] + d, f(p->self, at, up);
    at[k] = v[k] - d, f(p->self, at, down);
    at[k] = v[k];
    for (int j = 0; j < rows; j++) J[j][k] = (up[j] - down[j]) / (2 * difference);
  }
}

static void put_conditions(const work *w, of_values *f, int rows, const double *v, int row, int column)
{
  square J;
  derivative(w->p, f, rows, v, J);
  for (int j = 0; j < rows; j++)
    for (int k = 0; k < w->p->n; k++) *gg_band_at(&w->A, row + j, column + k) = J[j][k];
}

/* The derivatives of an interval's equations to the values at its ends: side 0 and 1. */
static void put_interval(const work *w, int i)
{
  const gg_boundary_problem *p = w->p;
  const int n = p->n;
  const double h = w->s->y[i + 1] - w->s->y[i];
  double vm[MOST];
  square Jm;
  middle_of(p, h, (const gg_functions *)w->s->v + i, (const gg_functions *)w->s->f + i, vm);
  derivative(p, p->slope, n, vm, Jm);
  for (int side = 0; side < 2; side++) {
    const double sign = side ? 1 : -1;
    for (int j = 0; j < n; j++)
      for (int k = 0; k < n; k++) {
        double through = 0.5 * Jm[j][k];
        for (int l = 0; l < n; l++) through -= sign * h / 8 * Jm[j][l] / p->scale[l] * w->J[i + side][l][k];
        double d = -h / 6 * (w->J[i + side][j][k] + 4 * through) / p->scale[j];
        *gg_band_at(&w->A, p->n_lower + n * i + j, n * (i + side) + k) = d + (j == k ? sign : 0);
      }
  }
}

static bool factor(work *w)
{
  const gg_boundary_problem *p = w->p;
  const int last = w->s->points - 1, end = p->n * last;
  w->A.n = unknowns(w);
  memset(w->A.cell, 0, (size_t)w->A.n * (size_t)gg_band_width(w->A.below, w->A.above) * sizeof *w->A.cell);
  for (int i = 0; i <= last; i++) derivative(p, p->slope, p->n, w->s->v[i], w->J[i]);
  put_conditions(w, p->lower, p->n_lower, w->s->v[0], 0, 0);
  for (int i = 0; i < last; i++) put_interval(w, i);
  put_conditions(w, p->upper, p->n - p->n_lower, w->s->v[last], p->n_lower + end, end);
  return gg_theory_band_factor(&w->A);
}

static double square_of(const double *x, int n)
{
  double sum = 0;
  for (int i = 0; i < n; i++) sum += x[i] * x[i];
  return sum;
}

/* The trial at `part` of the step. Returns the square of the step that Newton's method would take there, with the
 * derivatives of the last point: smaller where the trial is an advance. Infinity is not finite. */
static double attempt(work *w, double part)
{
  const int n = w->p->n, N = unknowns(w);
  for (int i = 0; i < N; i++) w->v[i / n][i % n] = w->s->v[i / n][i % n] - part * w->step[i] * w->p->scale[i % n];
  slopes(w->p, w->s->points, (const gg_functions *)w->v, w->f);
  leftover(w, (const gg_functions *)w->v, (const gg_functions *)w->f, w->left);
  gg_theory_band_solve(&w->A, w->left);
  const double size = square_of(w->left, N);
  return isfinite(size) ? size : INFINITY;
}

static void accept(work *w)
{
  const size_t bytes = (size_t)w->s->points * sizeof *w->v;
  memcpy(w->s->v, w->v, bytes);
  memcpy(w->s->f, w->f, bytes);
}

/* Damped steps on one mesh: each shortens the next one. It gives up after STUCK steps in a row that do not, or LOST in
 * a row that start where the equations have no value. */
static bool newton(work *w)
{
  const int N = unknowns(w);
  slopes(w->p, w->s->points, (const gg_functions *)w->s->v, w->s->f);
  int stuck = 0, lost = 0;
  for (int step = 0; step < STEPS && stuck < STUCK && lost < LOST && !gg_stop_asked(w->p->stop); step++) {
    bool nowhere = false, *outside = w->p->outside ? w->p->outside : &nowhere;
    *outside = false;
    if (!factor(w)) return false;
    leftover(w, (const gg_functions *)w->s->v, (const gg_functions *)w->s->f, w->step);
    lost = *outside ? lost + 1 : 0;
    gg_theory_band_solve(&w->A, w->step);
    const double size = square_of(w->step, N);
    if (!isfinite(size)) return false;
    double part = 1;
    int halvings = 0;
    while (attempt(w, part) > (1 - 0.4 * part) * size && size > N * converged * converged && halvings++ < HALVINGS)
      part /= 2;
    stuck = halvings > HALVINGS ? stuck + 1 : 0;
    accept(w);
    if (part == 1 && size <= N * converged * converged) return true;
  }
  return false;
}

void gg_theory_boundary_at(const gg_boundary_solution *s, int n, double y, double v[], double slope[])
{
  int low = 0, high = s->points - 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    *(y < s->y[middle] ? &high : &low) = middle;
  }
  const double h = s->y[low + 1] - s->y[low], t = (y - s->y[low]) / h;
  for (int k = 0; k < n; k++) {
    const double a = s->v[low][k], b = s->v[low + 1][k], c = h * s->f[low][k], d = h * s->f[low + 1][k];
    const double second = 3 * (b - a) - 2 * c - d, third = c + d - 2 * (b - a);
    v[k] = a + t * (c + t * (second + t * third));
    if (slope) slope[k] = (c + t * (2 * second + 3 * t * third)) / h;
  }
}

/* Root mean square of the residual over an interval: Lobatto's formula, whose other three points have none. */
static double residual_of(const work *w, int i)
{
  const gg_boundary_problem *p = w->p;
  const double h = w->s->y[i + 1] - w->s->y[i], length = w->s->y[w->s->points - 1] - w->s->y[0];
  double sum = 0;
  for (int side = -1; side <= 1; side += 2) {
    double v[MOST], slope[MOST], f[MOST];
    gg_theory_boundary_at(w->s, p->n, w->s->y[i] + 0.5 * h * (1 + side * sqrt(3. / 7)), v, slope);
    p->slope(p->self, v, f);
    for (int k = 0; k < p->n; k++) {
      const double off = (slope[k] - f[k]) / (fabs(f[k]) + p->scale[k] / length);
      sum += 49. / 180 * off * off;
    }
  }
  return sqrt(sum);
}

/* One more point in intervals whose residual is above the tolerance, two where it is far above. False: no room. */
static bool refine(work *w, bool *fine)
{
  gg_boundary_solution *s = w->s;
  const double tolerance = w->p->tolerance;
  int add[GG_BOUNDARY_POINTS], more = 0;
  s->residual = 0;
  for (int i = 0; i + 1 < s->points; i++) {
    const double residual = residual_of(w, i);
    s->residual = fmax(s->residual, residual);
    add[i] = residual <= tolerance ? 0 : residual <= 10 * tolerance ? 1 : 2;
    more += add[i];
  }
  *fine = more == 0;
  if (*fine) return true;
  if (!isfinite(s->residual) || s->points + more > GG_BOUNDARY_POINTS) return false;
  for (int i = s->points - 2, to = s->points - 1 + more; i >= 0; i--) { /* from above: nothing is overwritten */
    const int parts = add[i] + 1, from = to - parts;
    const double low = s->y[i], h = s->y[i + 1] - low;
    gg_functions inside[2];
    for (int k = 1; k < parts; k++) gg_theory_boundary_at(s, w->p->n, low + h * k / parts, inside[k - 1], NULL);
    s->y[to] = low + h, memcpy(s->v[to], s->v[i + 1], sizeof *s->v);
    for (int k = 1; k < parts; k++)
      s->y[from + k] = low + h * k / parts, memcpy(s->v[from + k], inside[k - 1], sizeof *s->v);
    to = from;
  }
  s->points += more;
  return true;
}

static gg_status solve(work *w, gg_error *err)
{
  for (int mesh = 0; mesh < MESHES; mesh++) {
    bool fine;
    if (!newton(w)) return gg_base_fail(err, GG_FAILED, "the equations do not converge");
    if (!refine(w, &fine))
      return gg_base_fail(err, GG_FAILED, "profiles are too steep for %d points", GG_BOUNDARY_POINTS);
    if (fine) return GG_OK;
  }
  return gg_base_fail(err, GG_FAILED, "the equations do not converge on finer and finer points");
}

gg_status gg_theory_boundary_solve(const gg_boundary_problem *p, gg_boundary_solution *s, gg_error *err)
{
  const int below = p->n_lower + p->n - 1, above = 2 * p->n - 1 - p->n_lower, most = GG_BOUNDARY_POINTS * MOST;
  work w = {.p = p,
            .s = s,
            .v = malloc(GG_BOUNDARY_POINTS * sizeof *w.v),
            .f = malloc(GG_BOUNDARY_POINTS * sizeof *w.f),
            .J = malloc(GG_BOUNDARY_POINTS * sizeof *w.J),
            .left = malloc((size_t)most * sizeof *w.left),
            .step = malloc((size_t)most * sizeof *w.step),
            .A = {.below = below,
                  .above = above,
                  .pivot = malloc((size_t)most * sizeof *w.A.pivot),
                  .cell = malloc((size_t)most * (size_t)gg_band_width(below, above) * sizeof *w.A.cell)}};
  const bool room = w.v && w.f && w.J && w.left && w.step && w.A.pivot && w.A.cell;
  const gg_status status = room ? solve(&w, err) : gg_base_out_of_memory(err);
  free(w.v), free(w.f), free(w.J), free(w.left), free(w.step), free(w.A.pivot), free(w.A.cell);
  return status;
}
