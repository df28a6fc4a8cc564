/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourier amplitudes over whole periods, x(t) = Re sum_h x_h exp(i h w t). With the stress sigma = -P_xy and the strain
 * g:
 *
 *   G' + i G'' = sigma_1/g_1;  third harmonic |sigma_3/sigma_1|;  T = T_0 + |T_2| cos(2 (w t + arg g_1) + phase).
 *
 * Grains are sampled at the ends of steps, and collisions are summed over steps: a sum is the mean over its step, whose
 * amplitude is smaller by sinc(h w dt/2) and late by half a step. Errors are those of independent replicas. */
#include "measure/harmonics.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/quantity.h"
#include "statistics/estimator.h"

/* Channels: amplitudes of a replica. */
enum { SIGMA_1, SIGMA_3 = SIGMA_1 + 2, T_0 = SIGMA_3 + 2, T_2, STRAIN_1 = T_2 + 2, CHANNELS = STRAIN_1 + 2 };

static double complex harmonic(const double *x, size_t steps, int h)
{
  double complex sum = 0;
  for (size_t j = 0; j < steps; j++) sum += x[j] * cexp(-2 * M_PI * I * h * (double)(j + 1) / (double)steps);
  return 2 * sum / (double)steps;
}

static void put(double *to, double complex z)
{
  to[0] = creal(z), to[1] = cimag(z);
}

static double complex at(const double *a, int channel)
{
  return a[channel] + I * a[channel + 1];
}

static double complex stress_harmonic(const gg_cycle *c, size_t steps, int h)
{
  const double half = M_PI * h / (double)steps;
  return -harmonic(c->kinetic, steps, h) - harmonic(c->collisional, steps, h) * cexp(I * half) * half / sin(half);
}

static void find_amplitudes(const gg_oscillation *o, const gg_cycle *c, double *a)
{
  double mean = 0;
  for (size_t j = 0; j < o->steps; j++) mean += c->T[j] / (double)o->steps;
  put(a + SIGMA_1, stress_harmonic(c, o->steps, 1));
  put(a + SIGMA_3, stress_harmonic(c, o->steps, 3));
  a[T_0] = mean;
  put(a + T_2, harmonic(c->T, o->steps, 2));
  put(a + STRAIN_1, harmonic(o->strain, o->steps, 1));
}

static double storage_modulus(const double *a, const gg_model *m)
{
  (void)m;
  return creal(at(a, SIGMA_1) / at(a, STRAIN_1));
}
static double loss_modulus(const double *a, const gg_model *m)
{
  (void)m;
  return cimag(at(a, SIGMA_1) / at(a, STRAIN_1));
}
static double stress_amplitude(const double *a, const gg_model *m)
{
  (void)m;
  return cabs(at(a, SIGMA_1));
}
static double stress_phase(const double *a, const gg_model *m)
{
  (void)m;
  return carg(at(a, SIGMA_1) / at(a, STRAIN_1));
}
static double third_harmonic(const double *a, const gg_model *m)
{
  (void)m;
  return cabs(at(a, SIGMA_3) / at(a, SIGMA_1));
}
static double strain_amplitude(const double *a, const gg_model *m)
{
  (void)m;
  return cabs(at(a, STRAIN_1));
}
static double mean_temperature(const double *a, const gg_model *m)
{
  (void)m;
  return a[T_0];
}
static double temperature_amplitude(const double *a, const gg_model *m)
{
  (void)m;
  return cabs(at(a, T_2)) / a[T_0];
}
static double temperature_phase(const double *a, const gg_model *m)
{
  (void)m;
  return carg(at(a, T_2) / cpow(at(a, STRAIN_1), 2));
}

/* Numbers of the two curves. unit: 's' that of the curve, 'r' radians, '1' none. */
static const struct {
  const char *name;
  gg_of_means *of;
  int curve;
  char unit;
} numbers[] = {{"storage_modulus", storage_modulus, 0, 's'},
               {"loss_modulus", loss_modulus, 0, 's'},
               {"stress_amplitude", stress_amplitude, 0, 's'},
               {"stress_phase", stress_phase, 0, 'r'},
               {"third_harmonic", third_harmonic, 0, '1'},
               {"mean_temperature", mean_temperature, 1, 's'},
               {"temperature_amplitude", temperature_amplitude, 1, '1'},
               {"temperature_phase", temperature_phase, 1, 'r'}};

static void add_numbers(const gg_oscillation *o, const double *amplitude, int curve, const char *unit, gg_curve *c)
{
  const size_t n = o->n;
  const double **row = gg_base_array_new(n, sizeof *row, NULL);
  double scratch[2 * CHANNELS];
  for (size_t i = 0; row && i < n; i++) row[i] = amplitude + CHANNELS * i;
  for (size_t k = 0; row && k < sizeof numbers / sizeof *numbers; k++) {
    const char *of = numbers[k].unit == 's' ? unit : numbers[k].unit == 'r' ? "rad" : "1";
    char name[40];
    if (numbers[k].curve != curve || c->n_numbers + 2 > GG_CURVE_NUMBERS) continue;
    const gg_mean m =
        gg_statistics_estimate_over_runs(row, n, CHANNELS, (gg_function){.of = numbers[k].of}, o->model, scratch);
    gg_measure_curve_put_number(c, numbers[k].name, m.mean, of);
    c->number[c->n_numbers - 1].error = m.error;
    snprintf(name, sizeof name, "%.24s_of_closure", numbers[k].name);
    if (o->theory) gg_measure_curve_put_setting(c, name, numbers[k].of(amplitude + CHANNELS * n, o->model), of);
  }
  if (curve == 0) gg_measure_curve_put_setting(c, "strain_amplitude", strain_amplitude(amplitude, NULL), "1");
  free(row);
}

/* Stress at the end of step j: collisions from the steps before and after. */
static double stress_at(const gg_oscillation *o, const gg_cycle *c, size_t j)
{
  return -c->kinetic[j] - (c->collisional[j] + c->collisional[(j + 1) % o->steps]) / 2;
}

static double value_at(const gg_oscillation *o, int curve, size_t replica, size_t j)
{
  return curve ? o->of[replica].T[j] : stress_at(o, &o->of[replica], j);
}

/* Mean over replicas of the point j of a period, its last one for 0. */
static void set_point(const gg_oscillation *o, int curve, size_t j, gg_curve *c)
{
  const size_t n = o->n, i = j > 0 ? j - 1 : o->steps - 1;
  double sum = 0, squares = 0;
  for (size_t k = 0; k < n; k++) sum += value_at(o, curve, k, i) / (double)n;
  for (size_t k = 0; k < n; k++) squares += pow(value_at(o, curve, k, i) - sum, 2);
  c->x[j] = curve ? o->period * (double)j / (double)o->steps : o->strain[i];
  c->value[j] = sum;
  c->error[j] = n > 1 ? gg_statistics_student(n) * sqrt(squares / (double)(n * (n - 1))) : NAN;
  if (c->reference) c->reference[j] = value_at(o, curve, n, i);
}

static void add_curve(const gg_oscillation *o, const double *amplitude, int curve, gg_curves *list)
{
  const gg_model *m = o->model;
  const char *unit = gg_common_quantity_unit(curve ? GG_Q_TEMPERATURE : GG_Q_P_XY, m);
  gg_curve *c = gg_measure_curve_add(list, o->steps + 1, curve ? "temperature_in_period" : "stress_over_strain",
                                     curve ? "T in a period" : "stress over strain", "measured");
  gg_measure_curve_axes(c, curve ? "t" : "strain", curve ? gg_measure_curve_unit(m, "time") : "1",
                        curve ? "T" : "-P_{xy}", unit);
  c->samples = (uint64_t)(o->n * o->periods);
  for (size_t j = 0; j < c->n; j++) c->x[j] = (double)j;
  if (o->theory) gg_measure_curve_beside(c, o->theory, gg_measure_curve_level, &(double){0});
  for (size_t j = 0; j < c->n; j++) set_point(o, curve, j, c);
  add_numbers(o, amplitude, curve, unit, c);
}

gg_status gg_measure_harmonics(const gg_oscillation *o, gg_curves *list, gg_error *err)
{
  double *amplitude = gg_base_array_new(CHANNELS * (o->n + 1), sizeof *amplitude, err);
  if (!amplitude) return GG_FAILED;
  for (size_t i = 0; i < o->n + (o->theory != NULL); i++) find_amplitudes(o, &o->of[i], amplitude + CHANNELS * i);
  list->group = "oscillation";
  for (int curve = 0; curve < 2; curve++) add_curve(o, amplitude, curve, list);
  list->group = NULL;
  free(amplitude);
  return GG_OK;
}
