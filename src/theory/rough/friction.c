/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/friction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/vec.h"
#include "simd/clones.h"
#include "theory/rough/friction_averages.h"
#include "theory/rough/turn.h"

enum {
  MORE_ROWS = 4, /* beside those of the functions: the collision rate and the three components of J */
  PANEL = 16,    /* rows that are turned at a time */
  CLASSES = 4    /* pairs of parities, gg_rough_class */
};

struct gg_rough_friction {
  const gg_rough_functions *f;
  gg_rough_averages averages;
  gg_rough_turn turn;
  bool alone;
  double *W;                              /* n x n; NULL: alone */
  double *panel;                          /* n x PANEL */
  double *more;                           /* n x MORE_ROWS: the additional rows as columns */
  int *by_class, class_from[CLASSES + 1]; /* functions of equal parities */
};

static void sort_by_class(gg_rough_friction *x)
{
  int n = 0;
  for (int class = 0; class < CLASSES; class ++) {
    x->class_from[class] = n;
    for (int q = 0; q < x->f->n; q++)
      if (gg_rough_class(x->f->function[q]) == class) x->by_class[n++] = q;
  }
  x->class_from[CLASSES] = n;
}

gg_status gg_rough_friction_make(gg_rough_friction **out, const gg_rough_functions *f, bool alone, gg_error *err)
{
  gg_rough_friction *x = *out = calloc(1, sizeof *x);
  const size_t n = (size_t)f->n, size = sizeof(double);
  if (!x) return gg_base_out_of_memory(err);
  x->f = f, x->alone = alone;
  x->more = malloc(n * MORE_ROWS * size);
  x->panel = malloc(n * PANEL * size);
  x->by_class = malloc(n * sizeof *x->by_class);
  if (!alone) x->W = malloc(n * n * size);
  if (!x->more || !x->panel || !x->by_class || (!alone && !x->W)) return gg_base_out_of_memory(err);
  sort_by_class(x);
  GG_TRY(gg_rough_turn_make(&x->turn, f, err));
  return gg_rough_averages_make(&x->averages, f, err);
}

void gg_rough_friction_free(gg_rough_friction *x)
{
  if (!x) return;
  gg_rough_averages_clear(&x->averages);
  gg_rough_turn_clear(&x->turn);
  free(x->W);
  free(x->panel);
  free(x->more);
  free(x->by_class);
  free(x);
}

/* Turn T/sqrt(l!) to z, as the columns (b, 0) of W. */
static void turn_averages(const gg_rough_friction *x, double *W)
{
  const gg_rough_functions *f = x->f;
  const size_t stride = (size_t)x->averages.stride;
  double *T = x->averages.T;
  for (int l = 0; l < f->n3; l++) {
    const int *r = f->three[l];
    const double root = sqrt(tgamma(r[0] + 1.) * tgamma(r[1] + 1.) * tgamma(r[2] + 1.));
    for (size_t i = (size_t)f->from[l] * stride; i < (size_t)f->from[l + 1] * stride; i++) T[i] /= root;
  }
  gg_rough_turn_rows(&x->turn, T, x->averages.stride);
  for (int R = 0; R < f->n; R++)
    memcpy(W + (size_t)R * (size_t)f->n, T + (size_t)R * stride, (size_t)f->n3 * sizeof *W);
}

/* to = sum_i factor_i of_i */
GG_INLINE void combine_six(int n, const double factor[GG_ROUGH_AXES], const double *const of[GG_ROUGH_AXES],
                           double *restrict to)
{
  for (int b = 0; b < n; b++) {
    double sum = factor[0] * of[0][b];
    for (int i = 1; i < GG_ROUGH_AXES; i++) sum += factor[i] * of[i][b];
    to[b] = sum;
  }
}

/* The columns (b, Q) with Q > 0, by their degree in y4, y5, y6. The creation operator of one of these coordinates,
 * over sqrt(Q), makes column (b, Q) of column (b, Q - 1), since collisions only shift that coordinate. The rows
 * belong to z already: there the creation operator of y_j is the sum over i of Y_ji times that of z_i. */
GG_CLONES static void raise_columns(const gg_rough_functions *f, const double Y[GG_ROUGH_AXES][GG_ROUGH_AXES],
                                    double *W)
{
  const size_t n = (size_t)f->n;
  for (int R = 0; R < f->n; R++) {
    double factor[3][GG_ROUGH_AXES];
    const double *below[GG_ROUGH_AXES], *of[GG_ROUGH_AXES];
    for (int i = 0; i < GG_ROUGH_AXES; i++) {
      const int r = f->function[R].r[i];
      below[i] = W + (size_t)(r > 0 ? f->down[R][i] : 0) * n; /* row 0 is 0: the number of grains stays */
      for (int j = 0; j < 3; j++) factor[j][i] = Y[3 + j][i] * sqrt(r);
    }
    for (int Q = 1; Q < f->n3; Q++) {
      const int *q = f->three[Q], j = q[0] > 0 ? 0 : q[1] > 0 ? 1 : 2;
      double over[GG_ROUGH_AXES];
      for (int i = 0; i < GG_ROUGH_AXES; i++) {
        over[i] = factor[j][i] / sqrt(q[j]);
        of[i] = below[i] + f->down[f->from[Q]][3 + j];
      }
      combine_six(f->from[Q + 1] - f->from[Q], over, of, W + (size_t)R * n + f->from[Q]);
    }
  }
}

/* Turn the columns of some rows of W, from `first` on, and add those of equal parities: others cancel between the
 * quarters of the sphere. In `alone`, the rows become their own sum. Few rows at a time stay in the cache. */
static void add_rows(const gg_rough_friction *x, double solid_angle, int first, double *W, double *to)
{
  const gg_rough_functions *f = x->f;
  const int n = f->n, rows = n - first < PANEL ? n - first : PANEL;
  for (int S = 0; S < n; S++)
    for (int r = 0; r < PANEL; r++)
      x->panel[S * PANEL + r] = r < rows ? W[(size_t)(first + r) * (size_t)n + (size_t)S] : 0;
  gg_rough_turn_rows(&x->turn, x->panel, PANEL);
  for (int r = 0; r < rows; r++) {
    double *sum = to + (size_t)(first + r) * (size_t)n;
    const int class = gg_rough_class(f->function[first + r]);
    if (x->alone) memset(sum, 0, (size_t)n * sizeof *sum);
    for (int i = x->class_from[class]; i < x->class_from[class + 1]; i++)
      sum[x->by_class[i]] += solid_angle * x->panel[x->by_class[i] * PANEL + r];
  }
}

static void add_more(gg_rough_friction *x, const double k[3], double solid_angle, gg_rough_sums *sums)
{
  const gg_rough_functions *f = x->f;
  memset(x->more, 0, (size_t)f->n * MORE_ROWS * sizeof *x->more);
  for (int b = 0; b < f->n3; b++)
    for (int i = 0; i < MORE_ROWS; i++)
      x->more[b * MORE_ROWS + i] = i == 0 ? x->averages.rate[b] : x->averages.J[i - 1][b];
  gg_rough_turn_rows(&x->turn, x->more, MORE_ROWS);
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
  if (!gg_rough_averages_at(&x->averages, &frame))
    return gg_base_fail(err, GG_FAILED, "the gas is too cold beside the shear for the integrals of friction");
  gg_rough_turn_set(&x->turn, frame.Y);
  turn_averages(x, W);
  raise_columns(x->f, frame.Y, W);
  for (int R = 0; R < x->f->n; R += PANEL) add_rows(x, solid_angle, R, W, sums->W);
  add_more(x, k, solid_angle, sums);
  return gg_stop_check(gas->stop, err);
}
