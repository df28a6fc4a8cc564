/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free cooling with friction: grains planted with fast spins, in both engines. Friction takes
 * ds/dt = -pi^2 (mu eta_1/K) n chi (T + T_f)/2 from them, T_f of their own velocities, however fast they spin
 * (docs/explanation/free_cooling_with_friction.md). Above the threshold spins grow in thermal units, below they fall.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "graingas.h"

enum { STEPS = 60 }; /* of half a collision a grain */
static const double K = 0.4, e = 0.9, mu = 0.5, phi = 0.05;

static void must(gg_status status, const gg_error *err)
{
  if (status != GG_OK) fail_msg("%s", err->message);
}

static double temperature(const gg_simulation *s, double *time)
{
  gg_simulation_state now;
  must(gg_simulation_get_state(s, &now, NULL), NULL);
  if (time) *time = now.time;
  return now.temperature;
}

static double length(const double *x)
{
  return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

typedef struct planted {
  const char *engine;
  size_t n, count; /* grains, the first of which are planted */
  double *velocity, *spin;
  gg_simulation *simulation;
} planted;

static void read_grains(planted *p)
{
  gg_error err;
  must(gg_simulation_get_grains(p->simulation, &(gg_grains){.velocity = p->velocity, .spin = p->spin}, &err), &err);
}

static void start(planted *p)
{
  gg_error err;
  gg_scene *scene;
  char text[300];
  snprintf(
      text, sizeof text,
      "{flow: hcs, engine: %s, phi: %g, particles: %zu, dsmc: {particles: %zu}, collision: {e: %g, beta: 0, mu: %g}, "
      "run: {seed: 7}}",
      p->engine, phi, p->n, p->n, e, mu);
  must(gg_scene_parse(text, "scene", &scene, &err), &err);
  must(gg_simulation_new(scene, NULL, &p->simulation, &err), &err);
  gg_scene_free(scene);
  p->velocity = calloc(3 * p->n, sizeof(double)), p->spin = calloc(3 * p->n, sizeof(double));
  must(gg_simulation_collide(p->simulation, 10 * p->n, &err), &err);
}

static void end(planted *p)
{
  gg_simulation_free(p->simulation);
  free(p->velocity), free(p->spin);
}

/* Directions along the axes in turn. A spin is given as surface velocity over sqrt(T). */
static void plant(planted *p, double spin)
{
  gg_error err;
  const double omega = 2 * spin * sqrt(temperature(p->simulation, NULL));
  read_grains(p);
  for (size_t i = 0; i < 3 * p->count; i++) p->spin[i] = i % 3 == i / 3 % 3 ? (i / 9 % 2 ? omega : -omega) : 0;
  must(gg_simulation_set_grains(p->simulation, &(gg_grains){.spin = p->spin}, p->n, &err), &err);
}

static int falling(const void *one, const void *other)
{
  const double a = *(const double *)one, b = *(const double *)other;
  return (a < b) - (a > b);
}

/* Spins of the planted grains, which are the fastest (dsmc permutes grains): mean, variance; and their temperature. */
static void measure(planted *p, double *mean, double *variance, double *own)
{
  double(*fast)[2] = calloc(p->n, sizeof *fast);
  *mean = *variance = *own = 0;
  read_grains(p);
  for (size_t i = 0; i < p->n; i++) {
    const double speed = length(p->velocity + 3 * i);
    fast[i][0] = length(p->spin + 3 * i) / 2, fast[i][1] = speed * speed;
  }
  qsort(fast, p->n, sizeof *fast, falling);
  for (size_t i = 0; i < p->count; i++)
    *mean += fast[i][0] / (double)p->count, *own += fast[i][1] / (3. * (double)p->count);
  for (size_t i = 0; i < p->count; i++) *variance += pow(fast[i][0] - *mean, 2) / (double)(p->count - 1);
  free(fast);
}

/* s*, over sqrt(T), at equal temperatures: x = zeta/2 = 0.222 nu_0/2. */
static double threshold(void)
{
  return M_PI * M_PI * mu * (1 + e) / 2 / K / (0.222 * 3.2 * sqrt(M_PI) / 2);
}

static void friction_takes_a_bounded_spin(planted *p)
{
  const double c = M_PI * M_PI * mu * (1 + e) / 2 / K * 6 * phi / M_PI * (1 - phi / 2) / pow(1 - phi, 3);
  double mean, variance, own, time, before, was, first, sum = 0, cold = 0;
  gg_error err;
  start(p);
  plant(p, 5 * threshold());
  before = temperature(p->simulation, &was);
  measure(p, &first, &variance, &own);
  const double T0 = before, s0 = first;
  before = (before + own) / 2;
  double T_before = T0;
  for (int k = 0; k < STEPS; k++) {
    must(gg_simulation_collide(p->simulation, p->n / 4, &err), &err);
    const double T = temperature(p->simulation, &time);
    measure(p, &mean, &variance, &own);
    const double both = (T + own) / 2;
    sum += (time - was) * sqrt(before * both), cold += (time - was) * sqrt(T_before * T);
    before = both, T_before = T, was = time;
  }
  const double error = sqrt(variance / (double)p->count), T = T_before, growth = mean / sqrt(T) / (s0 / sqrt(T0));
  print_message("# %s: lost %.4g +- %.2g, formula %.4g, at T_f = T %.4g; T_f/T %.3g; thermal spins grew %.3g times\n",
                p->engine, s0 - mean, error, c * sum, c * cold, own / T, growth);
  assert_true(fabs(s0 - mean - c * sum) < 4 * error + 0.05 * c * sum);
  assert_true(s0 - mean > 1.1 * c * cold); /* the planted grains are hot */
  assert_true(own / T > 1.3 && own / T < 2.5); /* 2.0 in the end */
  assert_true(growth > 5 && growth < sqrt(T0 / T));
  end(p);
}

/* From half the threshold nearly all grains come back, from three times it none. */
static void spins_below_the_threshold_return(planted *p)
{
  double mean, variance, own;
  gg_error err;
  start(p);
  plant(p, 0.5 * threshold());
  must(gg_simulation_collide(p->simulation, 15 * p->n, &err), &err);
  measure(p, &mean, &variance, &own);
  const double thermal = sqrt(0.53 * temperature(p->simulation, NULL) / K);
  print_message("# %s: from half the threshold to %.3g thermal spins\n", p->engine, mean / thermal);
  assert_true(mean < 5 * thermal);
  end(p);
}

static void in_md(void **state)
{
  (void)state;
  planted p = {.engine = "md", .n = 2000, .count = 30};
  friction_takes_a_bounded_spin(&p);
  spins_below_the_threshold_return(&p);
}

static void in_dsmc(void **state)
{
  (void)state;
  planted p = {.engine = "dsmc", .n = 20000, .count = 150};
  friction_takes_a_bounded_spin(&p);
  spins_below_the_threshold_return(&p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(in_md), cmocka_unit_test(in_dsmc)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
