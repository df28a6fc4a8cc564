/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves: histograms, profiles, correlation functions, spectra, with standard errors, and the numbers derived from
 * them. An observable defines how curves follow from the means of its bins. Errors come from leaving out one block
 * of samples at a time (jackknife.h), so that they are right for ratios and fits, too. */
#ifndef GG_CURVE_H
#define GG_CURVE_H

#include "common/model.h"
#include "statistics/bins.h"

typedef struct gg_curve_number {
  char name[40], unit[40];
  double value, error;
  double truncation; /* standard error that is not in the scatter of samples: added to it in quadrature */
  bool setting;      /* chosen, not measured: no error, and nothing to compare */
} gg_curve_number;

enum { GG_CURVE_NUMBERS = 16, GG_MOST_CURVES = 160 + 64 * GG_MAX_SPECIES };

typedef struct gg_curve {
  char name[48];             /* unique in a result: "velocity_distribution_Cx" */
  char group[40];            /* the observable: one picture */
  char panel[48], label[24]; /* curves of one panel are drawn together, under their labels */
  char x_name[24], x_unit[40], y_name[40], unit[40];
  bool log_x, log_y; /* suggested axes of pictures */
  size_t n;
  double *x, *value, *error; /* NaN: no value, unknown error */
  double *reference;         /* a law to compare with, NULL if there is none; its name */
  char reference_label[32];
  bool law_lost;            /* there was no memory for the law */
  const char *divisor;      /* the number of this curve by which its values are divided, or NULL: if that is zero within
                               three errors, the curve has no values */
  bool folded;              /* the mean of the flow and its image under the symmetry of the walls */
  double block_correlation; /* between neighbouring blocks, on average over the points: errors include it */
  uint64_t samples;         /* snapshots at each point, all replicas */
  int n_numbers;
  gg_curve_number number[GG_CURVE_NUMBERS]; /* derived from this curve: exponents, contact values, coefficients */
} gg_curve;

typedef struct gg_curves {
  const gg_model *model;
  const char *group;
  uint64_t samples; /* over which the means are taken */
  int n;
  gg_curve *curve; /* space for GG_MOST_CURVES */
  bool failed;     /* out of memory or space: everything after is left out */
  gg_curve spare;  /* target of writes after a failure */
} gg_curves;

void gg_measure_curves_clear(gg_curves *list);

/* A new curve of n points, x and value for the caller to fill in; a curve of no points after a failure. */
gg_curve *gg_measure_curve_add(gg_curves *list, size_t n, const char *name, const char *panel, const char *label);
void gg_measure_curve_axes(gg_curve *c, const char *x_name, const char *x_unit, const char *y_name, const char *unit);
void gg_measure_curve_put_number(gg_curve *c, const char *name, double value, const char *unit);
/* The same with a standard error from another source, in addition to that of the samples. */
void gg_measure_curve_put_truncated(gg_curve *c, const char *name, double value, double truncation, const char *unit);
void gg_measure_curve_put_setting(gg_curve *c, const char *name, double value, const char *unit);

/* Add a law to the curve, whose x are set: f(x, parameters). */
typedef double gg_curve_law(double x, const double *parameters);
void gg_measure_curve_beside(gg_curve *c, const char *label, gg_curve_law *law, const double *parameters);
/* A constant: its only parameter. */
gg_curve_law gg_measure_curve_level;

/* Units of results for curves: "length", "time", "velocity", "temperature", "spin" of this model. */
const char *gg_measure_curve_unit(const gg_model *model, const char *what);

/* Curves from the mean of the bins over `list->samples` samples. */
typedef void gg_curves_of(const void *self, const double *mean, gg_curves *list);

/* Pool replicas' bins into curves with errors, appended to the list. `memory`: the decay time, in samples of the
 * bins, of a slow mode on which they may depend; 0: none is known. */
gg_status gg_measure_curves_estimate(const gg_bins *const *bins, size_t n_runs, gg_curves_of *of, const void *self,
                                     const char *group, double memory, gg_curves *list, gg_error *err);

#endif
