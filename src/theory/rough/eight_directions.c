/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/eight_directions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/vec.h"
#include "simd/clones.h"

typedef gg_rough_lanes lanes;

/* Columns of the flux that are computed at once. */
enum { TILE = 8, HALF_TILE = 4 };

static lanes *new_lanes(int n)
{
  lanes *x = aligned_alloc(sizeof *x, (size_t)n * sizeof *x);
  if (x) memset(x, 0, (size_t)n * sizeof *x);
  return x;
}

static int roots_of(const gg_rough_functions *f)
{
  return f->degree + 2;
}

/* The first axis along which a test is not constant: it follows from the test one degree lower along that axis. */
static int axis_of(gg_rough_index index)
{
  int axis = 0;
  while (index.r[axis] == 0) axis++;
  return axis;
}

/* All tests that follow from R, directly or not. */
static int walk(const gg_rough_functions *f, int R, int *path, int n)
{
  if (R > 0) path[n++] = R;
  const int last = R > 0 ? axis_of(f->function[R]) : GG_ROUGH_AXES - 1;
  for (int axis = 0; axis <= last; axis++)
    if (f->up[R][axis] >= 0) n = walk(f, f->up[R][axis], path, n);
  return n;
}

static void find_below(gg_rough_eight *x)
{
  const gg_rough_functions *f = x->f;
  for (int T = 0; T < f->n; T++) {
    gg_rough_below *below = &x->below[T];
    below->n = 0;
    for (int j = 0; j < GG_ROUGH_AXES; j++) {
      if (f->down[T][j] < 0) continue;
      below->from[below->n] = f->down[T][j];
      below->root[below->n++] = j * roots_of(f) + f->function[T].r[j];
    }
  }
}

/* Columns of the flux by class of their velocity index: parity, and parity of z. */
static void sort_columns(gg_rough_eight *x)
{
  const gg_rough_functions *f = x->f;
  for (int s = 0; s < f->n3; s++) {
    const int *v = f->three[s], kind = (v[0] + v[1] + v[2]) % 2 + 2 * (v[2] % 2);
    x->sorted[kind * f->n3 + x->sorted_n[kind]++] = s;
  }
}

gg_status gg_rough_eight_make(gg_rough_eight *x, const gg_rough_functions *f, gg_error *err)
{
  *x = (gg_rough_eight){.f = f};
  x->path = malloc((size_t)f->n * sizeof *x->path);
  x->below = malloc((size_t)f->n * sizeof *x->below);
  x->root = new_lanes(GG_ROUGH_AXES * GG_ROUGH_AXES * roots_of(f));
  x->row = new_lanes((f->degree + 1) * f->n);
  x->flux = new_lanes(4 * f->n3 * f->n3 + TILE);
  x->sorted = malloc(4 * (size_t)f->n3 * sizeof *x->sorted);
  if (!x->path || !x->below || !x->root || !x->row || !x->flux || !x->sorted) return gg_base_out_of_memory(err);
  walk(f, 0, x->path, 0);
  find_below(x);
  sort_columns(x);
  x->row[0] += 1;
  return GG_OK;
}

void gg_rough_eight_clear(gg_rough_eight *x)
{
  free(x->path);
  free(x->below);
  free(x->root);
  free(x->row);
  free(x->flux);
  free(x->sorted);
  *x = (gg_rough_eight){0};
}

void gg_rough_eight_set(gg_rough_eight *x, int lane, const gg_rough_collision *c, const double *flux,
                        double solid_angle)
{
  const gg_rough_functions *f = x->f;
  lanes *root = x->root;
  for (int i = 0; i < GG_ROUGH_AXES; i++) {
    x->b[i][lane] = c->b[i];
    for (int j = 0; j < GG_ROUGH_AXES; j++)
      for (int r = 0; r < roots_of(f); r++) (*root++)[lane] = c->M[i][j] * sqrt(r);
  }
  for (int kind = 0; kind < 4; kind++)
    for (int t = 0; t < f->n3; t++)
      for (int at = 0; at < x->sorted_n[kind]; at++)
        x->flux[(kind * f->n3 + t) * f->n3 + at][lane] = solid_angle * flux[t * f->n3 + x->sorted[kind * f->n3 + at]];
}

/* z'_axis times a row, in the column T: contributions of T itself, of columns below and above it. */
GG_INLINE lanes times(const gg_rough_eight *x, int axis, const lanes *row, int T, bool own, bool above)
{
  const gg_rough_functions *f = x->f;
  const int roots = roots_of(f);
  const lanes *root = x->root + axis * GG_ROUGH_AXES * roots;
  const gg_rough_below *below = &x->below[T];
  lanes sum = {0};
  if (own) sum = x->b[axis] * row[T];
  if (above)
    for (int j = 0; j < GG_ROUGH_AXES; j++) sum += root[j * roots + f->function[T].r[j] + 1] * row[f->up[T][j]];
  for (int k = 0; k < below->n; k++) sum += root[below->root[k]] * row[below->from[k]];
  return sum;
}

/* The row of R by the recursion of Hermite polynomials in z' = M z + b, from those of one and two degrees less. A
 * row of degree k ends there. */
GG_INLINE void make_row(const gg_rough_eight *x, int R, int degree)
{
  const gg_rough_functions *f = x->f;
  const int axis = axis_of(f->function[R]), r = f->function[R].r[axis], *upto = f->upto;
  const lanes *before = x->row + (degree - 1) * f->n, *second = before - (r > 1 ? f->n : 0);
  lanes *to = x->row + degree * f->n;
  const double inverse = 1 / sqrt(r), less = r > 1 ? sqrt(r - 1) : 0;
  int i = 0;
  for (; degree > 1 && i < upto[degree - 1]; i++) {
    const int T = f->by_degree[i];
    to[T] = inverse * (times(x, axis, before, T, true, true) - less * second[T]);
  }
  for (; i < upto[degree]; i++) {
    const int T = f->by_degree[i];
    to[T] = inverse * times(x, axis, before, T, true, false);
  }
  for (; i < upto[degree + 1]; i++) {
    const int T = f->by_degree[i];
    to[T] = inverse * times(x, axis, before, T, false, false);
  }
}

GG_INLINE double sum_of(lanes x)
{
  x += __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3);
  x += __builtin_shufflevector(x, x, 2, 3, 0, 1, 6, 7, 4, 5);
  return x[0] + x[1];
}

/* to += row times flux, in `width` columns of which n are wanted. */
GG_INLINE void add_columns(const lanes *row, int many, const lanes *flux, int stride, int width, int n,
                           const int *column, double *to)
{
  lanes sum[TILE] = {{0}};
  for (int t = 0; t < many; t++, flux += stride)
    for (int v = 0; v < width; v++) sum[v] += row[t] * flux[v];
  for (int v = 0; v < n && v < width; v++) to[column[v]] += sum_of(sum[v]);
}

/* The same by halves of the lanes, in vectors of 256 bits: gcc 12 keeps wider ones in memory where registers have no
 * more, and takes them apart there. The sums have the same order. */
typedef double half __attribute__((vector_size(GG_ROUGH_LANES / 2 * sizeof(double)), may_alias));

GG_INLINE void add_columns_by_halves(const lanes *row, int many, const lanes *flux, int stride, int width, int n,
                                     const int *column, double *to)
{
  half sum[2][TILE];
  for (int h = 0; h < 2; h++) {
    const half *one = (const half *)row + h, *two = (const half *)flux + h;
    for (int v = 0; v < width; v++) sum[h][v] = (half){0};
    for (int t = 0; t < many; t++, one += 2, two += 2 * stride)
      for (int v = 0; v < width; v++) sum[h][v] += *one * two[2 * v];
  }
  for (int v = 0; v < n && v < width; v++) {
    const half x = sum[0][v] + sum[1][v];
    to[column[v]] += (x[0] + x[2]) + (x[1] + x[3]);
  }
}

GG_INLINE void add_some(const lanes *row, int many, const lanes *flux, int stride, int width, int n, const int *column,
                        bool halves, double *to)
{
  if (halves)
    add_columns_by_halves(row, many, flux, stride, width, n, column, to);
  else
    add_columns(row, many, flux, stride, width, n, column, to);
}

/* A row of E times the flux, in the columns of the same class as the row: the others cancel between the quarters of
 * the sphere. */
GG_INLINE void add_row(const gg_rough_eight *x, const lanes *row, int degree, int class, bool halves, double *to)
{
  const gg_rough_functions *f = x->f;
  for (int s = 0; s < f->n3; s++) {
    const int *spin = f->three[s], spins = spin[0] + spin[1] + spin[2];
    const int kind = class % 2 + 2 * ((class / 2 + spin[0] + spin[1]) % 2), *column = x->sorted + kind * f->n3;
    const int many = gg_rough_count3(degree - spins), all = gg_rough_count3(f->degree - spins);
    const lanes *flux = x->flux + kind * f->n3 * f->n3;
    if (many == 0) break; /* by degree */
    int n = x->sorted_n[kind];
    while (n > 0 && column[n - 1] >= all) n--;
    int v = 0;
    for (; n - v > HALF_TILE; v += TILE)
      add_some(row + f->from[s], many, flux + v, f->n3, TILE, n - v, column + v, halves, to + f->from[s]);
    if (n > v) add_some(row + f->from[s], many, flux + v, f->n3, HALF_TILE, n - v, column + v, halves, to + f->from[s]);
  }
}

/* Contribution of Ho_R(z') - Ho_R(z). */
GG_INLINE void add_all(const gg_rough_eight *x, bool halves, double *W)
{
  const gg_rough_functions *f = x->f;
  for (int i = 0; i < f->n - 1; i++) {
    const int R = x->path[i], degree = gg_rough_degree(f->function[R]);
    make_row(x, R, degree);
    lanes *row = x->row + degree * f->n, own = row[R];
    row[R] -= 1;
    add_row(x, row, degree, gg_rough_class(f->function[R]), halves, W + (size_t)R * (size_t)f->n);
    row[R] = own;
  }
}

GG_NARROW_CLONES static void add_all_by_halves(const gg_rough_eight *x, double *W)
{
  add_all(x, true, W);
}

#ifdef GG_WIDE_TARGET
GG_WIDE_TARGET static void add_all_whole(const gg_rough_eight *x, double *W)
{
  add_all(x, false, W);
}
#endif

void gg_rough_eight_add(const gg_rough_eight *x, double *W)
{
#ifdef GG_WIDE_TARGET
  if (__builtin_cpu_supports("avx512f")) {
    add_all_whole(x, W);
    return;
  }
#endif
  add_all_by_halves(x, W);
}
