#include "theory/hermite/product.h"

static void add_tile(int depth, const double *restrict A, int stride_A, const double *restrict B, int stride_B,
                     double *restrict C, int stride_C)
{
  double sum[GG_PRODUCT_ROWS][GG_PRODUCT_COLUMNS] = {{0}};
  for (int d = 0; d < depth; d++, A += stride_A, B += stride_B)
    for (int i = 0; i < GG_PRODUCT_ROWS; i++)
      for (int k = 0; k < GG_PRODUCT_COLUMNS; k++) sum[i][k] += A[i] * B[k];
  for (int i = 0; i < GG_PRODUCT_ROWS; i++)
    for (int k = 0; k < GG_PRODUCT_COLUMNS; k++) C[i * stride_C + k] += sum[i][k];
}

void gg_add_product(int rows, int columns, int depth, const double *A, int stride_A, const double *B, int stride_B,
                    double *C, int stride_C)
{
  for (int row = 0; row < rows; row += GG_PRODUCT_ROWS)
    for (int column = 0; column < columns; column += GG_PRODUCT_COLUMNS)
      add_tile(depth, A + row, stride_A, B + column, stride_B, C + (long)row * stride_C + column, stride_C);
}
