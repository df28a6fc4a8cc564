/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Write synthetic series with known statistics: synthetic FOLDER [--windows N]. FOLDER gets one file per kind, with one
 * series of N (1000) windows of 600 correlation times each. Integrated correlation time: about ten rows.
 * Exit code: 0; 2: invalid command line; 3: a file could not be written. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/rng.h"
#include "stored.h"

#define ROWS 10.0 /* correlation time */
enum { LONGEST = 600 };

typedef struct kind {
  const char *name;
  double slow_share, slow, fast; /* of the variance; integrated times */
  double bend;                   /* y = exp(bend x); 0: y = x */
} kind;

static const kind kinds[] = {
    {"ar1", 1, ROWS, ROWS, 0},          {"fast+slow", 1 / 3.0, 27, 1.5, 0}, {"half slow", 0.5, 19, 1, 0},
    {"exp half x", 1, ROWS, ROWS, 0.5}, {"exp x", 1, ROWS, ROWS, 1},
};

/* Coefficient of a first-order autoregressive series with this integrated correlation time. */
static double memory(double time)
{
  return (2 * time - 1) / (2 * time + 1);
}

/* exp(b x) of normal x with correlation rho: covariance exp(b^2) (exp(b^2 rho) - 1). */
static double bent_time(double rho, double b)
{
  double sum = 0.5, r = rho;
  for (; r > 1e-12; r *= rho) sum += expm1(b * b * r) / expm1(b * b);
  return sum;
}

static void make(const kind *k, gg_rng *rng, double *y, size_t n)
{
  double rho[2] = {memory(k->slow), memory(k->fast)}, share[2] = {k->slow_share, 1 - k->slow_share};
  double at[2] = {gg_common_rng_normal(rng), gg_common_rng_normal(rng)};
  for (size_t i = 0; i < n; i++) {
    double x = 0;
    for (int m = 0; m < 2; m++) {
      at[m] = rho[m] * at[m] + sqrt(1 - rho[m] * rho[m]) * gg_common_rng_normal(rng);
      x += sqrt(share[m]) * at[m];
    }
    y[i] = k->bend > 0 ? exp(k->bend * x) : x;
  }
}

int main(int argc, char **argv)
{
  int windows = argc == 2 ? 1000 : argc == 4 && strcmp(argv[2], "--windows") == 0 ? atoi(argv[3]) : 0;
  if (windows < 1) {
    fprintf(stderr, "synthetic FOLDER [--windows N]\n");
    return 2;
  }
  size_t n = (size_t)(windows * LONGEST * ROWS);
  double *y = malloc(n * sizeof *y);
  bool good = y != NULL;
  for (size_t i = 0; good && i < sizeof kinds / sizeof *kinds; i++) {
    const kind *k = &kinds[i];
    gg_rng rng = gg_common_rng_seed(i, 0);
    make(k, &rng, y, n);
    double time = k->slow_share * k->slow + (1 - k->slow_share) * k->fast;
    if (k->bend > 0) time = bent_time(memory(k->slow), k->bend);
    good = stored_write(argv[1], k->name, y, n, time, k->bend > 0 ? exp(k->bend * k->bend / 2) : 0);
  }
  free(y);
  return good ? 0 : 3;
}
