/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/error_course.h"

#include <math.h>

static void moments(const gg_course *c, int q, int mark, double *mean, double *variance)
{
  *mean = *variance = 0;
  for (int i = 0; i < c->seeds; i++) *mean += c->mean[q][mark][i] / c->seeds;
  for (int i = 0; i < c->seeds; i++) *variance += pow(c->mean[q][mark][i] - *mean, 2) / (c->seeds - 1);
}

gg_course_end gg_statistics_course_last(const gg_course *c, int q)
{
  double mean, variance;
  moments(c, q, c->marks - 1, &mean, &variance);
  /* The scatter of a few runs may be too small by chance: use the error from blocks as a lower bound. */
  double scatter = c->seeds < 2 ? c->error[q] : fmax(sqrt(variance), c->error[q] > 0 ? c->error[q] : 0);
  return (gg_course_end){mean, scatter / sqrt(c->seeds), scatter};
}

double gg_statistics_course_noise(const gg_course *c, int q)
{
  double sum = 0;
  int n = 0;
  for (int k = c->marks / 2; k < c->marks; k++, n++) {
    double mean, variance;
    moments(c, q, k, &mean, &variance);
    sum += variance * (c->seconds[k] - c->warmup);
  }
  return sqrt(sum / n);
}

double gg_statistics_course_distance(const gg_course *c, int q, int mark, double value, double *error)
{
  double square = 0;
  for (int i = 0; i < c->seeds; i++) square += pow(c->mean[q][mark][i] - value, 2) / c->seeds;
  *error = sqrt(square) / sqrt(2.0 * c->seeds);
  return sqrt(square);
}
