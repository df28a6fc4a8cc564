/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/band_matrix.h"

#include <math.h>

static int smaller(int a, int b)
{
  return a < b ? a : b;
}

static void exchange(double *a, double *b)
{
  const double keep = *a;
  *a = *b, *b = keep;
}

/* Row with the largest element of column k, from the diagonal down. */
static int pivot_of(const gg_band_matrix *A, int k, int last)
{
  int best = k;
  for (int i = k + 1; i <= last; i++)
    if (fabs(*gg_band_at(A, i, k)) > fabs(*gg_band_at(A, best, k))) best = i;
  return best;
}

bool gg_theory_band_factor(gg_band_matrix *A)
{
  for (int k = 0; k < A->n; k++) {
    const int last = smaller(k + A->below, A->n - 1), end = smaller(k + A->below + A->above, A->n - 1);
    const int p = A->pivot[k] = pivot_of(A, k, last);
    if (p != k)
      for (int j = k; j <= end; j++) exchange(gg_band_at(A, k, j), gg_band_at(A, p, j));
    const double pivot = *gg_band_at(A, k, k);
    if (!(fabs(pivot) > 0) || !isfinite(pivot)) return false;
    for (int i = k + 1; i <= last; i++) {
      const double factor = *gg_band_at(A, i, k) /= pivot;
      if (factor == 0) continue;
      for (int j = k + 1; j <= end; j++) *gg_band_at(A, i, j) -= factor * *gg_band_at(A, k, j);
    }
  }
  return true;
}

void gg_theory_band_solve(const gg_band_matrix *A, double *b)
{
  for (int k = 0; k < A->n; k++) {
    exchange(&b[k], &b[A->pivot[k]]);
    for (int i = k + 1; i <= smaller(k + A->below, A->n - 1); i++) b[i] -= *gg_band_at(A, i, k) * b[k];
  }
  for (int k = A->n - 1; k >= 0; k--) {
    for (int j = k + 1; j <= smaller(k + A->below + A->above, A->n - 1); j++) b[k] -= *gg_band_at(A, k, j) * b[j];
    b[k] /= *gg_band_at(A, k, k);
  }
}
