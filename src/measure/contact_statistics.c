#include "measure/contact_statistics.h"

#include <math.h>

#include <gsl/gsl_multifit.h>

/* Sums over the bins of the gap: pairs that approach, that part, normal speeds of the approaching; over the bins of y:
 * pairs that part. */
enum { APPROACHING = 0, PARTING = GG_NEAR_BINS, SPEED = 2 * GG_NEAR_BINS, WAYS = 3 * GG_NEAR_BINS };
enum { ITERATIONS = 12, ENOUGH = 20 /* pairs for each number of a fit */ };
#define OVERLAP 1e-4 /* by rounding: a contact */

/* ln g falls over the length (1 + phi/2)(1 - phi)/(4.5 phi (1 + phi)) next to contact (Percus & Yevick's equation:
 * Wertheim 1963), in units of the smallest diameter; over half of it a cubic is within 1e-4 at contact, of the same
 * equation's g, at every density. In dilute gases third grains interfere little, and a parabola over 1 does. */
gg_near gg_measure_contact_setup(const gg_model *m, double sigma, double longest_reach)
{
  double phi = m->phi, smallest = gg_common_model_narrowest(m);
  double length = (1 + phi / 2) * (1 - phi) / (4.5 * phi * (1 + phi));
  gg_near n = {.sigma = sigma, .order = length > 10 ? 2 : 3};
  double gap = smallest * fmin(0.5 * length, n.order == 2 ? 1 : 0.6);
  n.reach = fmin((n.order == 2 ? 4 : 2) * gap, longest_reach - sigma); /* nearly all that have come so far */
  n.gap = fmin(gap, n.reach);
  n.way = fmin(fmin(gap, 0.6 * smallest), n.reach / (n.order == 2 ? 4 : 2));
  return n;
}

static int bin_of(double x, double range)
{
  if (!(x < range)) return -1;
  int k = (int)(fmax(x, 0) * (GG_NEAR_BINS / range));
  return k < GG_NEAR_BINS ? k : GG_NEAR_BINS - 1;
}

/* Straight back in time: |r - g t| = sigma. */
static void count_parting(const gg_near *n, double *bin, double square, double along, double g2, double weight)
{
  double outside = fmax(square - n->sigma * n->sigma, 0), discriminant = along * along - g2 * outside;
  if (discriminant < 0) return; /* they have passed each other */
  double root = sqrt(discriminant), time = outside / (along + root);
  int k = bin_of(time * root / n->sigma, n->way);
  if (k >= 0) bin[WAYS + k] += weight;
}

void gg_measure_contact_count(const gg_near *n, double *bin, gg_vec r, double square, gg_vec g, double speed,
                              double weight)
{
  double distance = sqrt(square), gap = distance - n->sigma, along = gg_dot(r, g);
  if (gap > n->reach || gap < -OVERLAP * n->sigma) return;
  int k = bin_of(gap, n->gap);
  if (k >= 0) bin[(along < 0 ? APPROACHING : PARTING) + k] += weight;
  if (k >= 0 && along < 0) bin[SPEED + k] -= weight * along / (distance * speed);
  if (along > 0) count_parting(n, bin, square, along, gg_dot(g, g), weight);
}

/* Where a polynomial is fitted to, and its value at x = 0. */
typedef struct fit {
  size_t points, terms;
  gsl_matrix *X, *covariance;
  gsl_vector *y, *w, *c;
  gsl_multifit_linear_workspace *work;
} fit;

static void clear(fit *f)
{
  gsl_multifit_linear_free(f->work);
  gsl_vector_free(f->c);
  gsl_vector_free(f->w);
  gsl_vector_free(f->y);
  gsl_matrix_free(f->covariance);
  gsl_matrix_free(f->X);
}

/* A polynomial of the order over the points x. */
static bool start(fit *f, const double *x, size_t points, int order)
{
  *f = (fit){.points = points, .terms = (size_t)order + 1};
  f->X = gsl_matrix_alloc(points, f->terms);
  f->covariance = gsl_matrix_alloc(f->terms, f->terms);
  f->y = gsl_vector_alloc(points), f->w = gsl_vector_alloc(points), f->c = gsl_vector_alloc(f->terms);
  f->work = gsl_multifit_linear_alloc(points, f->terms);
  if (!(f->X && f->covariance && f->y && f->w && f->c && f->work)) return false;
  for (size_t i = 0; i < points; i++)
    for (size_t k = 0; k < f->terms; k++) gsl_matrix_set(f->X, i, k, pow(x[i], (double)k));
  return true;
}

static bool solve(fit *f)
{
  double chi2;
  return gsl_multifit_wlinear(f->X, f->w, f->y, f->c, f->covariance, &chi2, f->work) == 0;
}

static double at_point(const fit *f, size_t i)
{
  double sum = 0;
  for (size_t k = 0; k < f->terms; k++) sum += gsl_matrix_get(f->X, i, k) * gsl_vector_get(f->c, k);
  return sum;
}

/* The density of counts at x = 0 if its logarithm is a polynomial, by maximum likelihood of Poisson's law (iterated
 * least squares): least squares of logarithms are biased where counts are few. */
static double density_at_contact(const double *x, const double *volume, const double *counts, int order)
{
  fit f;
  double total = 0, value = NAN;
  bool good = start(&f, x, GG_NEAR_BINS, order);
  for (int i = 0; i < GG_NEAR_BINS; i++) total += counts[i];
  good = good && total > ENOUGH * (order + 1);
  for (int iteration = 0; good && iteration < ITERATIONS; iteration++) {
    for (size_t i = 0; i < GG_NEAR_BINS; i++) {
      double expected = iteration ? volume[i] * exp(at_point(&f, i)) : counts[i] + 0.5;
      expected = fmin(fmax(expected, 1e-6 * total), total);
      gsl_vector_set(f.w, i, expected);
      gsl_vector_set(f.y, i, log(expected / volume[i]) + (iteration ? (counts[i] - expected) / expected : 0));
    }
    good = solve(&f);
  }
  if (good) value = exp(gsl_vector_get(f.c, 0));
  clear(&f);
  return value;
}

/* sum[i]/counts[i] at x = 0, taken as a parabola. */
static double mean_at_contact(const double *x, const double *sum, const double *counts)
{
  fit f;
  double value = NAN;
  bool good = start(&f, x, GG_NEAR_BINS, 2);
  for (size_t i = 0; good && i < GG_NEAR_BINS; i++) {
    gsl_vector_set(f.w, i, counts[i]);
    gsl_vector_set(f.y, i, counts[i] > 0 ? sum[i] / counts[i] : 0);
    good = counts[i] >= 0;
  }
  if (good && solve(&f)) value = gsl_vector_get(f.c, 0);
  clear(&f);
  return value;
}

/* Shells from contact to n->gap: the mean gap in each, and its volume. */
static void shells(const gg_near *n, double *x, double *volume)
{
  for (int i = 0; i < GG_NEAR_BINS; i++) {
    double a = n->sigma + i * n->gap / GG_NEAR_BINS, b = n->sigma + (i + 1) * n->gap / GG_NEAR_BINS;
    double cubes = (pow(b, 3) - pow(a, 3)) / 3;
    volume[i] = 4 * M_PI * cubes;
    x[i] = (pow(b, 4) - pow(a, 4)) / 4 / cubes - n->sigma;
  }
}

gg_contact_density gg_measure_contact_estimate(const gg_near *n, const double *bin, double pairs_per_volume,
                                               double samples)
{
  double x[GG_NEAR_BINS], y[GG_NEAR_BINS], shell[GG_NEAR_BINS], way[GG_NEAR_BINS];
  double in[GG_NEAR_BINS], out[GG_NEAR_BINS], all[GG_NEAR_BINS];
  shells(n, x, shell);
  for (int i = 0; i < GG_NEAR_BINS; i++) {
    in[i] = bin[APPROACHING + i] * samples;
    all[i] = in[i] + bin[PARTING + i] * samples;
    out[i] = bin[WAYS + i] * samples;
    y[i] = (i + 0.5) * n->way / GG_NEAR_BINS;
    way[i] = 4 * M_PI * n->sigma * n->sigma * n->way / GG_NEAR_BINS;
  }
  double one = pairs_per_volume * samples, seen = 0;
  for (int i = 0; i < GG_NEAR_BINS; i++) seen += in[i];
  return (gg_contact_density){
      .approaching = 2 * density_at_contact(x, shell, in, n->order) / one,
      .parting = 2 * density_at_contact(y, way, out, n->order) / one,
      .alike = density_at_contact(x, shell, all, n->order) / one,
      .speed = seen > ENOUGH * 3 ? mean_at_contact(x, bin + SPEED, bin + APPROACHING) : NAN, /* of a parabola */
  };
}
