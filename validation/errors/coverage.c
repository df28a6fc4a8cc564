/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How often the true mean lies within the stated error, and within 1.96 of it: coverage FOLDER NAME ... reads stored
 * series, cuts each into windows of 30, 60, 200 and 600 correlation times, at most 1000 of each, and prints a line a
 * window for the errors of src/statistics/estimator.c ("graingas") and for 32 batch means with Student's t. The
 * columns: series, estimator, correlation times, windows, per cent within 68.27 and 95 % intervals, mean square of
 * deviation over error, mean square of the error over that of the deviation. Exit code 0; 2: the command line is wrong;
 * 3: a file is unreadable. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "statistics/estimator.h"
#include "stored.h"

enum { MOST_WINDOWS = 1000, BATCHES = 32 };
static const double lengths[] = {30, 60, 200, 600};

typedef struct tally {
  int n, in68, in95;
  double z2, error2, deviation2;
} tally;

/* low, high: of which errors the two intervals are made. */
static void count(tally *t, double deviation, double error, double low, double high)
{
  t->n++;
  t->in68 += fabs(deviation) <= low * error;
  t->in95 += fabs(deviation) <= high * error;
  t->z2 += deviation * deviation / (error * error);
  t->error2 += error * error;
  t->deviation2 += deviation * deviation;
}

static void tell(const char *series, const char *estimator, double length, const tally *t)
{
  if (t->n)
    printf("%-24s %-10s %4.0f %5d %5.1f %5.1f %6.3f %6.3f\n", series, estimator, length, t->n, 100.0 * t->in68 / t->n,
           100.0 * t->in95 / t->n, t->z2 / t->n, t->error2 / t->deviation2);
}

static double of_batches(const double *y, size_t n)
{
  double mean[BATCHES];
  size_t length = n / BATCHES;
  for (size_t b = 0; b < BATCHES; b++) mean[b] = gsl_stats_mean(y + b * length, 1, length);
  return gsl_stats_sd(mean, 1, BATCHES) / sqrt(BATCHES);
}

static bool judge(const stored *s, const char *name, double length)
{
  size_t n = (size_t)round(length * s->time), windows = s->n / n;
  tally ours = {0}, batches = {0};
  double t68 = gsl_cdf_tdist_Pinv(0.5 + 0.6826895 / 2, BATCHES - 1), t95 = gsl_cdf_tdist_Pinv(0.975, BATCHES - 1);
  for (size_t w = 0; w < windows && w < MOST_WINDOWS; w++) {
    const double *y = s->y + w * n;
    gg_mean m;
    if (gg_statistics_estimate_scalar(y, n, 1, &m, NULL) != GG_OK) return false;
    count(&ours, m.mean - s->truth, m.error, 1, 1.959964);
    if (n >= BATCHES) count(&batches, gsl_stats_mean(y, 1, n) - s->truth, of_batches(y, n), t68, t95);
  }
  tell(name, "graingas", length, &ours);
  tell(name, "batches", length, &batches);
  return true;
}

int main(int argc, char **argv)
{
  if (argc < 3) {
    fprintf(stderr, "coverage FOLDER NAME ...\n");
    return 2;
  }
  for (int i = 2; i < argc; i++) {
    stored s;
    bool good = stored_read(argv[1], argv[i], &s);
    for (size_t k = 0; good && k < sizeof lengths / sizeof *lengths; k++) good = judge(&s, argv[i], lengths[k]);
    free(s.y);
    if (!good) return 3;
  }
  return 0;
}
