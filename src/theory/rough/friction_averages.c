/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/friction_averages.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "simd/clones.h"
#include "simd/matrix.h"

/* Points that a product of matrices takes at once. */
enum { BATCH = 128, SIDE = GG_ROUGH_MOST_DEGREE + 1 };

/* Rows of the functions of one degree of delta up to it, of all velocities that go with them. */
static int rows_up_to(const gg_rough_functions *f, int L)
{
  int n = 0;
  for (int k = 0; k <= L; k++) n += gg_rough_count3(f->degree - k);
  return n;
}

static size_t whole(int panel, int rows)
{
  return (size_t)gg_panels(panel, rows) * (size_t)panel;
}

gg_status gg_rough_averages_make(gg_rough_averages *x, const gg_rough_functions *f, gg_error *err)
{
  const size_t columns = whole(GG_RIGHT_PANEL, f->n3), n = whole(GG_LEFT_PANEL, f->n), n3 = whole(GG_LEFT_PANEL, f->n3);
  const size_t slides = whole(GG_LEFT_PANEL, rows_up_to(f, f->degree)), most = f->n3 > BATCH ? (size_t)f->n3 : BATCH;
  const size_t left = n * (size_t)f->n3 > slides * BATCH ? n * (size_t)f->n3 : slides * BATCH;
  *x = (gg_rough_averages){.f = f, .stride = (int)columns};
  x->T = calloc((n + n3 + slides + 4 + most) * columns + left, sizeof *x->T);
  if (!x->T) return gg_base_out_of_memory(err);
  x->G = x->T + n * columns, x->Q = x->G + n3 * columns, x->rate = x->Q + slides * columns;
  for (int i = 0; i < 3; i++) x->J[i] = x->rate + (size_t)(i + 1) * columns;
  x->right = x->J[2] + columns, x->left = x->right + most * columns;
  return gg_rough_rays_make(&x->rays, f->degree, err);
}

void gg_rough_averages_clear(gg_rough_averages *x)
{
  gg_rough_rays_free(x->rays);
  free(x->T);
  *x = (gg_rough_averages){0};
}

static void hermite_three(const gg_rough_functions *f, const double y[3], double *value)
{
  double one[3][SIDE];
  for (int i = 0; i < 3; i++) {
    one[i][0] = 1, one[i][1] = y[i];
    for (int k = 1; k < f->degree; k++) one[i][k + 1] = (y[i] * one[i][k] - sqrt(k) * one[i][k - 1]) / sqrt(k + 1);
  }
  for (int s = 0; s < f->n3; s++) value[s] = one[0][f->three[s][0]] * one[1][f->three[s][1]] * one[2][f->three[s][2]];
}

/* sum[row][b] += sum over points of left (`rows` of them, set by the caller) x right. */
static void add_product(const gg_rough_averages *x, int rows, int many, double *sum)
{
  gg_simd_multiply(many, x->left, gg_panels(GG_LEFT_PANEL, rows), x->right, gg_panels(GG_RIGHT_PANEL, x->f->n3), sum,
                   x->stride);
}

static void set_right(gg_rough_averages *x, double factor, const double *value, int k, int many)
{
  for (int b = 0; b < x->f->n3; b++) x->right[gg_panel_place(GG_RIGHT_PANEL, many, b, k)] = factor * value[b];
}

static void sum_sticking(gg_rough_averages *x, const gg_rough_points *p)
{
  double value[GG_ROUGH_MOST_THREE];
  memset(x->G, 0, whole(GG_LEFT_PANEL, x->f->n3) * (size_t)x->stride * sizeof *x->G);
  for (int at = 0; at < p->sticks; at += BATCH) {
    const int many = p->sticks - at < BATCH ? p->sticks - at : BATCH;
    for (int k = 0; k < many; k++) {
      hermite_three(x->f, p->stick[at + k].y, value);
      for (int c = 0; c < x->f->n3; c++) x->left[gg_panel_place(GG_LEFT_PANEL, many, c, k)] = value[c];
      set_right(x, p->stick[at + k].weight, value, k, many);
    }
    add_product(x, x->f->n3, many, x->G);
  }
}

/* A coordinate after the collision, linear in those before: sum_j by[j] y_j + by[3]. */
typedef struct linear {
  double by[4];
} linear;

/* Row `to` = row `from`, a sum of Ho_c(y) of degree less than `degree`, times the coordinate. */
static void times_linear(gg_rough_averages *x, const linear *by, int degree, int from, int to, const double *root)
{
  const gg_rough_functions *f = x->f;
  const int inner = gg_rough_count3(degree - 1), next = gg_rough_count3(degree - 2);
  double old[GG_ROUGH_MOST_THREE];
  for (int c = 0; c < inner; c++) old[c] = x->left[gg_panel_place(GG_LEFT_PANEL, f->n3, from, c)];
  for (int c = 0; c < gg_rough_count3(degree); c++) {
    double sum = c < inner ? by->by[3] * old[c] : 0;
    for (int j = 0; j < 3; j++) {
      const int r = f->three[c][j];
      if (r > 0) sum += by->by[j] * root[r] * old[f->down[c][j]];
      if (c < next) sum += by->by[j] * root[r + 1] * old[f->up[c][j]];
    }
    x->left[gg_panel_place(GG_LEFT_PANEL, f->n3, to, c)] = sum;
  }
}

static int first_axis(const int r[3])
{
  return r[0] > 0 ? 0 : r[1] > 0 ? 1 : 2;
}

/* The coordinates after the collision: y1, y2, y3, and the shifts of y4, y5, y6. */
static void set_linear(const gg_rough_frame *frame, linear coordinate[GG_ROUGH_AXES])
{
  const double eta[3] = {frame->eta1, frame->eta2, frame->eta2};
  for (int i = 0; i < GG_ROUGH_AXES; i++)
    for (int j = 0; j < 4; j++) {
      double sum = i == j && i < 3;
      for (int k = 0; k < 3; k++) sum += frame->D[i][k] * eta[k] * (j < 3 ? frame->R[k][j] : frame->m[k]);
      coordinate[i].by[j] = sum;
    }
}

/* Rows (a, l) of the left operand: Ho_a(y') delta^l - 1_(l = 0) Ho_a(y) by Ho_c(y). That of a = l = 0, whose
 * difference is 0, keeps its 1: it makes the rate. */
static void expand_sticking(gg_rough_averages *x, const gg_rough_frame *frame)
{
  const gg_rough_functions *f = x->f;
  linear by[GG_ROUGH_AXES];
  double root[SIDE + 1];
  for (int k = 0; k <= SIDE; k++) root[k] = sqrt(k);
  set_linear(frame, by);
  memset(x->left, 0, whole(GG_LEFT_PANEL, f->n) * (size_t)f->n3 * sizeof *x->left);
  x->left[0] = 1;
  for (int a = 1; a < f->n3; a++) {
    const int *r = f->three[a], axis = first_axis(r), degree = r[0] + r[1] + r[2];
    const int once = f->down[a][axis], twice = f->down[once][axis];
    times_linear(x, &by[axis], degree, once, a, root);
    for (int c = 0; c < gg_rough_count3(degree); c++) {
      double *to = &x->left[gg_panel_place(GG_LEFT_PANEL, f->n3, a, c)];
      if (twice >= 0) *to -= root[r[axis] - 1] * x->left[gg_panel_place(GG_LEFT_PANEL, f->n3, twice, c)];
      *to /= root[r[axis]];
    }
  }
  for (int l = 1; l < f->n3; l++) {
    const int *r = f->three[l], axis = first_axis(r);
    for (int place = f->from[l]; place < f->from[l + 1]; place++)
      times_linear(x, &by[3 + axis], gg_rough_degree(f->function[place]), f->down[place][3 + axis], place, root);
  }
  for (int a = 1; a < f->n3; a++) x->left[gg_panel_place(GG_LEFT_PANEL, f->n3, a, a)] -= 1;
}

static void add_sticking(gg_rough_averages *x, const gg_rough_points *p, const gg_rough_frame *frame)
{
  const gg_rough_functions *f = x->f;
  sum_sticking(x, p);
  expand_sticking(x, frame);
  for (int c = 0; c < f->n3; c++) set_right(x, 1, x->G + (size_t)c * (size_t)x->stride, c, f->n3);
  add_product(x, f->n, f->n3, x->T);
  const double eta[3] = {frame->eta1, frame->eta2, frame->eta2};
  for (int i = 0; i < 3; i++)
    for (int b = 0; b < f->n3; b++) {
      double g = frame->m[i] * x->G[b];
      for (int j = 0; j < 3; j++) g += frame->R[i][j] * x->G[f->up[0][j] * x->stride + b];
      for (int j = 0; j < 3; j++) x->J[j][b] += eta[i] * g * frame->axis[i][j];
    }
}

/* Rows (L, a): Ho_a(y') g_n^L; the difference from before where L = 0, but 1 for a = 0. */
static void sum_sliding(gg_rough_averages *x, const gg_rough_slide *slide, const double step[GG_ROUGH_AXES])
{
  const gg_rough_functions *f = x->f;
  const int rows = rows_up_to(f, f->degree);
  double before[GG_ROUGH_MOST_THREE], after[GG_ROUGH_MOST_THREE], y[3];
  memset(x->Q, 0, whole(GG_LEFT_PANEL, rows) * (size_t)x->stride * sizeof *x->Q);
  for (int at = 0; at < slide->n; at += BATCH) {
    const int many = slide->n - at < BATCH ? slide->n - at : BATCH;
    for (int k = 0; k < many; k++) {
      const gg_rough_point *p = &slide->point[at + k];
      double power = 1;
      for (int i = 0; i < 3; i++) y[i] = p->y[i] + p->normal * step[i];
      hermite_three(f, p->y, before);
      hermite_three(f, y, after);
      set_right(x, p->weight, before, k, many);
      for (int L = 0, row = 0; L <= f->degree; L++, power *= p->normal)
        for (int a = 0; a < gg_rough_count3(f->degree - L); a++, row++)
          x->left[gg_panel_place(GG_LEFT_PANEL, many, row, k)] = after[a] * power - (L == 0 && a > 0 ? before[a] : 0);
    }
    add_product(x, rows, many, x->Q);
  }
}

GG_CLONES static void add_row(size_t n, double factor, const double *from, double *to)
{
  for (size_t i = 0; i < n; i++) to[i] += factor * from[i];
}

static void add_sliding(gg_rough_averages *x, const gg_rough_slide *slide, const gg_rough_frame *frame)
{
  const gg_rough_functions *f = x->f;
  const size_t stride = (size_t)x->stride;
  double step[GG_ROUGH_AXES], power[3][SIDE];
  if (slide->n == 0) return; /* the powers of a step with huge mu may be infinite */
  for (int y = 0; y < GG_ROUGH_AXES; y++) {
    step[y] = 0;
    for (int i = 0; i < 3; i++) step[y] += frame->D[y][i] * slide->J[i];
  }
  sum_sliding(x, slide, step);
  for (int i = 0; i < 3; i++) {
    power[i][0] = 1;
    for (int k = 0; k < f->degree; k++) power[i][k + 1] = power[i][k] * step[3 + i];
  }
  for (int l = 0; l < f->n3; l++) {
    const int *r = f->three[l], L = r[0] + r[1] + r[2];
    add_row((size_t)gg_rough_count3(f->degree - L) * stride, power[0][r[0]] * power[1][r[1]] * power[2][r[2]],
            x->Q + (size_t)rows_up_to(f, L - 1) * stride, x->T + (size_t)f->from[l] * stride);
  }
  for (int j = 0; j < 3; j++) {
    double J = 0;
    for (int i = 0; i < 3; i++) J += slide->J[i] * frame->axis[i][j];
    add_row(stride, J, x->Q + (size_t)rows_up_to(f, 0) * stride, x->J[j]);
  }
}

bool gg_rough_averages_at(gg_rough_averages *x, const gg_rough_frame *frame)
{
  const gg_rough_points p = gg_rough_rays_points(x->rays, frame);
  const size_t row = (size_t)x->stride * sizeof *x->T;
  if (p.azimuths == 0) return false;
  memset(x->T, 0, whole(GG_LEFT_PANEL, x->f->n) * row);
  memset(x->rate, 0, 4 * row);
  add_sticking(x, &p, frame);
  for (int a = 0; a < p.azimuths; a++) add_sliding(x, &p.slide[a], frame);
  memcpy(x->rate, x->T, row);
  memset(x->T, 0, row);
  return true;
}
