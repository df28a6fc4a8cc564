/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Products of matrices that leave the same bits on every processor: each element is a sum in the order of k, with
 * separate multiplications and additions. */
#ifndef GG_SIMD_MATRIX_H
#define GG_SIMD_MATRIX_H

/* Operands are stored by panels of a few rows: panel, k, row. A product reads both in order. */
enum { GG_LEFT_PANEL = 6, GG_RIGHT_PANEL = 8 };

/* Place of row i, k of `many`, in an operand of panels of that many rows. */
static inline int gg_panel_place(int panel, int many, int i, int k)
{
  return (i / panel * many + k) * panel + i % panel;
}

static inline int gg_panels(int panel, int n)
{
  return (n + panel - 1) / panel;
}

/* C_ij += sum_k left_ik right_jk for `lefts` panels times `rights` panels; C has rows i of `stride`, and whole panels.
 */
void gg_simd_multiply(int many, const double *left, int lefts, const double *right, int rights, double *C, int stride);

#endif
