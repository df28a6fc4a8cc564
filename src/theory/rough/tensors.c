/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/tensors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void gg_rough_tensors_unit(int component, double E[3][3])
{
  static const double unit[GG_ROUGH_COMPONENTS][3][3] = {
      {{-0.40824829046386301637, 0, 0}, {0, -0.40824829046386301637, 0}, {0, 0, 0.81649658092772603273}},
      {{0, 0, M_SQRT1_2}, {0, 0, 0}, {M_SQRT1_2, 0, 0}},
      {{0, M_SQRT1_2, 0}, {M_SQRT1_2, 0, 0}, {0, 0, 0}}};
  memcpy(E, unit[component], sizeof unit[component]);
}

/* to += amount times creation operators of these axes applied to `from`. */
static void create(const gg_rough_functions *f, const int *axes, int n, double amount, const double *from, double *to)
{
  for (int q = 0; q < f->n; q++) {
    if (from[q] == 0) continue;
    double value = amount * from[q];
    int at = q;
    for (int i = 0; i < n && at >= 0; i++) {
      at = f->up[at][axes[i]];
      if (at >= 0) value *= sqrt(f->function[at].r[axes[i]]);
    }
    if (at >= 0) to[at] += value;
  }
}

static int even(int i, int j, int k) /* sign of a permutation: 1, -1, or 0 */
{
  return (j - i) * (k - j) * (k - i) / 2;
}

enum { A, B = 3 };

/* Contribution of a vector v = sum of coefficients of axes to a kind of function. */
static void along(const gg_rough_functions *f, int kind, int c, double amount, const double *from, double *to)
{
  for (int i = 0; i < 3; i++) {
    if (kind == 0 && i == c) create(f, (int[]){A + c}, 1, amount, from, to);
    if (kind == 1) create(f, (int[]){B + c, A + i, B + i}, 3, amount, from, to);
    for (int j = 0; kind == 2 && j < 3; j++)
      if (even(c, i, j)) create(f, (int[]){B + i, A + j}, 2, amount * even(c, i, j), from, to);
  }
}

/* Tensors: E_ij (first: a_i, b_i, or b_i (a.b)) times a_j, b_j, or (b x a)_j. */
static void across(const gg_rough_functions *f, int kind, int i, int j, double amount, const double *from, double *to)
{
  const int pair[][2] = {{A + i, A + j}, {B + i, B + j}};
  if (kind < 2) create(f, pair[kind], 2, amount, from, to);
  for (int l = 0; kind == 2 && l < 3; l++) create(f, (int[]){A + i, B + j, A + l, B + l}, 4, amount, from, to);
  for (int l = 0; kind > 2 && l < 9; l++) {
    const double sign = even(j, l / 3, l % 3) * amount;
    const int axes[] = {kind == 3 ? A + i : B + i, B + l / 3, A + l % 3};
    for (int k = 0; kind == 4 && sign != 0 && k < 3; k++)
      create(f, (int[]){axes[0], axes[1], axes[2], A + k, B + k}, 5, sign, from, to);
    if (kind == 3 && sign != 0) create(f, axes, 3, sign, from, to);
  }
}

static const int degree_of[2][5] = {{1, 3, 2}, {2, 2, 4, 3, 5}};

static void component(const gg_rough_functions *f, int rank, int kind, int c, const double *from, double *to)
{
  double E[3][3];
  if (rank == 1) along(f, kind, c ? 0 : 2, 1, from, to);
  if (rank == 1) return;
  gg_rough_tensors_unit(c, E);
  for (int i = 0; i < 9; i++)
    if (E[i / 3][i % 3] != 0) across(f, kind, i / 3, i % 3, E[i / 3][i % 3], from, to);
}

/* (a.a)^i (b.b)^j (a.b)^2k */
static void scalar(const gg_rough_functions *f, int i, int j, int k, double *x, double *y)
{
  memset(x, 0, (size_t)f->n * sizeof *x);
  x[0] = 1;
  for (int step = 0; step < i + j + 2 * k; step++) {
    memset(y, 0, (size_t)f->n * sizeof *y);
    for (int axis = 0; axis < 3; axis++)
      create(f, (int[]){axis + (step >= i && step < i + j ? B : A), axis + (step < i ? A : B)}, 2, 1, x, y);
    memcpy(x, y, (size_t)f->n * sizeof *x);
  }
}

typedef struct work {
  double *x, *y, *all[GG_ROUGH_COMPONENTS]; /* all: rows of f->n */
  int capacity;
} work;

/* List all functions; without `work` only count them. */
static int list(const gg_rough_functions *f, const gg_rough_tensors *t, int degree, work *w)
{
  int n = 0;
  for (int total = 0; total <= degree; total++)
    for (int kind = 0; kind < 2 * t->rank + 1; kind++) {
      const int left = total - degree_of[t->rank - 1][kind];
      for (int k = 0; left >= 0 && left % 2 == 0 && 4 * k <= left; k++)
        for (int j = 0; 2 * j + 4 * k <= left; j++, n++) {
          double norm = 0;
          if (!w) continue;
          scalar(f, left / 2 - j - 2 * k, j, k, w->x, w->y);
          for (int c = 0; c < t->components; c++) {
            double *row = w->all[c] + (size_t)n * (size_t)f->n;
            component(f, t->rank, kind, c, w->x, row);
            for (int q = 0; q < f->n; q++) norm += t->share[c] * row[q] * row[q];
          }
          for (int c = 0; c < t->components; c++)
            for (int q = 0; q < f->n; q++) w->all[c][(size_t)n * (size_t)f->n + (size_t)q] /= sqrt(norm);
        }
    }
  return n;
}

static bool pack(gg_rough_tensors *t, int c, int n, const double *all)
{
  t->place[c] = malloc((size_t)n * sizeof *t->place[c]);
  for (int q = 0; q < n && t->place[c]; q++) {
    bool any = false;
    for (int m = 0; m < t->n; m++) any |= all[(size_t)m * (size_t)n + (size_t)q] != 0;
    if (any) t->place[c][t->many[c]++] = q;
  }
  t->of[c] = malloc((size_t)t->n * (size_t)t->many[c] * sizeof *t->of[c]);
  for (int m = 0; m < t->n && t->of[c]; m++)
    for (int k = 0; k < t->many[c]; k++)
      t->of[c][m * t->many[c] + k] = all[(size_t)m * (size_t)n + (size_t)t->place[c][k]];
  return t->place[c] && t->of[c];
}

gg_status gg_rough_tensors_make(gg_rough_tensors *t, const gg_rough_functions *f, int rank, int degree, gg_error *err)
{
  *t = (gg_rough_tensors){.rank = rank, .components = rank + 1};
  for (int c = 0; c <= rank; c++) t->share[c] = (c ? 2. : 1.) / (2 * rank + 1);
  t->n = list(f, t, degree, NULL);
  const size_t n = (size_t)f->n, rows = n * (size_t)t->n;
  work w = {.x = malloc(2 * n * sizeof *w.x)};
  bool fine = w.x != NULL;
  w.y = w.x + n;
  for (int c = 0; c < t->components; c++) fine &= (w.all[c] = calloc(rows, sizeof(double))) != NULL;
  if (fine) list(f, t, degree, &w);
  for (int c = 0; c < t->components; c++) {
    fine = fine && pack(t, c, f->n, w.all[c]);
    free(w.all[c]);
  }
  free(w.x);
  if (fine) return GG_OK;
  gg_rough_tensors_clear(t);
  return gg_base_out_of_memory(err);
}

void gg_rough_tensors_clear(gg_rough_tensors *t)
{
  for (int c = 0; c < GG_ROUGH_COMPONENTS; c++) {
    free(t->place[c]);
    free(t->of[c]);
  }
  *t = (gg_rough_tensors){0};
}
