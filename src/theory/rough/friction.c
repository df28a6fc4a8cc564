/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/friction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "simd/matrix.h"
#include "theory/rough/friction_points.h"
#include "theory/rough/turn.h"

/* Points that a product of matrices takes at once. Rows beside those of the functions: the rate, and J. */
enum { BATCH = 128, MORE_ROWS = 4, SIDE = GG_ROUGH_MOST_DEGREE + 1 };

struct gg_rough_friction {
  const gg_rough_functions *f;
  gg_rough_rays *rays;
  double *left, *right; /* functions at the points of a batch: after the collision less before, and before */
  double *T;            /* n + MORE_ROWS rows, in whole panels */
  int lefts, rights;    /* panels */
  bool alone;
  double *W;             /* n x n; NULL: alone */
  double *more;          /* n x MORE_ROWS: the additional rows as columns */
  double up[SIDE][SIDE]; /* sqrt(P!/Q!)/(P - Q)! */
};

gg_status gg_rough_friction_make(gg_rough_friction **out, const gg_rough_functions *f, bool alone, gg_error *err)
{
  gg_rough_friction *x = *out = calloc(1, sizeof *x);
  const size_t n = (size_t)f->n, size = sizeof(double);
  if (!x) return gg_base_out_of_memory(err);
  x->f = f, x->alone = alone;
  x->lefts = gg_panels(GG_LEFT_PANEL, f->n + MORE_ROWS), x->rights = gg_panels(GG_RIGHT_PANEL, f->n3);
  x->left = calloc((size_t)x->lefts * GG_LEFT_PANEL * BATCH, size);
  x->right = calloc((size_t)x->rights * GG_RIGHT_PANEL * BATCH, size);
  x->T = malloc((size_t)x->lefts * GG_LEFT_PANEL * (size_t)x->rights * GG_RIGHT_PANEL * size);
  x->more = malloc(n * MORE_ROWS * size);
  if (!alone) x->W = malloc(n * n * size);
  if (!x->left || !x->right || !x->T || !x->more || (!alone && !x->W)) return gg_base_out_of_memory(err);
  for (int p = 0; p <= f->degree; p++)
    for (int q = 0; q <= p; q++) x->up[p][q] = sqrt(tgamma(p + 1.) / tgamma(q + 1.)) / tgamma(p - q + 1.);
  return gg_rough_rays_make(&x->rays, f->degree, err);
}

void gg_rough_friction_free(gg_rough_friction *x)
{
  if (!x) return;
  gg_rough_rays_free(x->rays);
  free(x->left);
  free(x->right);
  free(x->T);
  free(x->W);
  free(x->more);
  free(x);
}

/* Products over three coordinates of values of one each, by f->three. */
static void multiply_three(const gg_rough_functions *f, double one[3][SIDE], double *product)
{
  for (int s = 0; s < f->n3; s++) product[s] = one[0][f->three[s][0]] * one[1][f->three[s][1]] * one[2][f->three[s][2]];
}

static void hermite_three(const gg_rough_functions *f, const double y[3], double *value)
{
  double one[3][SIDE];
  for (int i = 0; i < 3; i++) {
    one[i][0] = 1, one[i][1] = y[i];
    for (int k = 1; k < f->degree; k++) one[i][k + 1] = (y[i] * one[i][k] - sqrt(k) * one[i][k - 1]) / sqrt(k + 1);
  }
  multiply_three(f, one, value);
}

static void powers_three(const gg_rough_functions *f, const double y[3], double *value)
{
  double one[3][SIDE];
  for (int i = 0; i < 3; i++) {
    one[i][0] = 1;
    for (int k = 0; k < f->degree; k++) one[i][k + 1] = y[i] * one[i][k];
  }
  multiply_three(f, one, value);
}

static void set_point(gg_rough_friction *x, const gg_rough_point *p, int k, int many)
{
  const gg_rough_functions *f = x->f;
  double before[GG_ROUGH_MOST_THREE], after[GG_ROUGH_MOST_THREE], shift[GG_ROUGH_MOST_THREE];
  hermite_three(f, p->y, before);
  hermite_three(f, p->after, after);
  powers_three(f, p->shift, shift);
  for (int s = 0; s < f->n3; s++) x->right[gg_panel_place(GG_RIGHT_PANEL, many, s, k)] = p->weight * before[s];
  int row = 0;
  for (int s = 0; s < f->n3; s++)
    for (int v = 0; v < f->from[s + 1] - f->from[s]; v++, row++)
      x->left[gg_panel_place(GG_LEFT_PANEL, many, row, k)] = after[v] * shift[s] - (s == 0 ? before[v] : 0);
  for (int i = 0; i < MORE_ROWS; i++)
    x->left[gg_panel_place(GG_LEFT_PANEL, many, row + i, k)] = i == 0 ? 1 : p->J[i - 1];
}

static void make_T(gg_rough_friction *x, const gg_rough_point *point, int n)
{
  const int stride = x->rights * GG_RIGHT_PANEL;
  memset(x->T, 0, (size_t)x->lefts * GG_LEFT_PANEL * (size_t)stride * sizeof *x->T);
  for (int at = 0; at < n; at += BATCH) {
    const int many = n - at < BATCH ? n - at : BATCH;
    for (int k = 0; k < many; k++) set_point(x, &point[at + k], k, many);
    gg_simd_multiply(many, x->left, x->lefts, x->right, x->rights, x->T, stride);
  }
}

/* A row of W, of velocity index `a` and spin index P. */
static void make_row(const gg_rough_friction *x, const int *a, const int *P, double *W)
{
  const gg_rough_functions *f = x->f;
  const int stride = x->rights * GG_RIGHT_PANEL;
  memset(W, 0, (size_t)f->n * sizeof *W);
  for (int q0 = 0; q0 <= P[0]; q0++)
    for (int q1 = 0; q1 <= P[1]; q1++)
      for (int q2 = 0; q2 <= P[2]; q2++) {
        const int source[GG_ROUGH_AXES] = {a[0], a[1], a[2], P[0] - q0, P[1] - q1, P[2] - q2};
        const int Q[GG_ROUGH_AXES] = {0, 0, 0, q0, q1, q2}, first = gg_rough_place(f, Q);
        const double up = x->up[P[0]][q0] * x->up[P[1]][q1] * x->up[P[2]][q2];
        const double *T = x->T + (size_t)gg_rough_place(f, source) * (size_t)stride;
        for (int b = 0; b < gg_rough_count3(f->degree - q0 - q1 - q2); b++) W[first + b] = up * T[b];
      }
}

static void make_W(const gg_rough_friction *x, double *W)
{
  const gg_rough_functions *f = x->f;
  for (int R = 0; R < f->n; R++) make_row(x, f->function[R].r, f->function[R].r + 3, W + (size_t)R * (size_t)f->n);
}

static void transpose(int n, double *W)
{
  enum { TILE = 16 };
  for (int i = 0; i < n; i += TILE)
    for (int j = i; j < n; j += TILE)
      for (int r = i; r < n && r < i + TILE; r++)
        for (int c = j > r ? j : r + 1; c < n && c < j + TILE; c++) {
          double *one = W + (size_t)r * (size_t)n + c, *two = W + (size_t)c * (size_t)n + r, kept = *one;
          *one = *two, *two = kept;
        }
}

/* Elements between functions of different parities cancel between the quarters of the sphere. */
static void add_W(const gg_rough_friction *x, double solid_angle, const double *W, double *to)
{
  const gg_rough_functions *f = x->f;
  for (int R = 0; R < f->n; R++) {
    const int class = gg_rough_class(f->function[R]);
    for (int S = 0; S < f->n; S++, W++, to++) {
      const double before = x->alone ? 0 : *to;
      *to = gg_rough_class(f->function[S]) == class ? before + solid_angle * *W : before;
    }
  }
}

static void add_more(gg_rough_friction *x, const gg_rough_frame *frame, const double k[3], double solid_angle,
                     gg_rough_sums *sums)
{
  const gg_rough_functions *f = x->f;
  const double *T = x->T + (size_t)f->n * (size_t)(x->rights * GG_RIGHT_PANEL);
  memset(x->more, 0, (size_t)f->n * MORE_ROWS * sizeof *x->more);
  for (int b = 0; b < f->n3; b++)
    for (int i = 0; i < MORE_ROWS; i++) x->more[b * MORE_ROWS + i] = T[i * x->rights * GG_RIGHT_PANEL + b];
  gg_rough_turn(f, frame->Y, x->more, MORE_ROWS);
  for (int S = 0; S < f->n; S++) {
    const double *more = x->more + (size_t)S * MORE_ROWS;
    sums->rate[S] += solid_angle * more[0];
    for (int i = 0; i < 9; i++) sums->J[i / 3][i % 3][S] += solid_angle * k[i / 3] * more[1 + i % 3];
  }
}

gg_status gg_rough_friction_add(gg_rough_friction *x, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                const double k[3], double solid_angle, gg_rough_sums *sums, gg_error *err)
{
  const gg_rough_frame frame = gg_rough_frame_of(gas, weight, k);
  double *W = x->alone ? sums->W : x->W;
  int n;
  const gg_rough_point *point = gg_rough_rays_points(x->rays, &frame, &n);
  if (n == 0) return gg_base_fail(err, GG_FAILED, "the gas is too cold beside the shear for the integrals of friction");
  make_T(x, point, n);
  make_W(x, W);
  gg_rough_turn(x->f, frame.Y, W, x->f->n);
  transpose(x->f->n, W);
  gg_rough_turn(x->f, frame.Y, W, x->f->n);
  transpose(x->f->n, W);
  add_W(x, solid_angle, W, sums->W);
  add_more(x, &frame, k, solid_angle, sums);
  return gg_stop_check(gas->stop, err);
}
