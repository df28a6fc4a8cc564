/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helpers for the tests of dsmc: a scene in one line, and means with error bars from blocks of time. */
#ifndef GG_TESTS_DSMC_LAB_H
#define GG_TESTS_DSMC_LAB_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/engine.h"
#include "scene/model_of_scene.h"

static inline gg_scene lab_scene(gg_flow flow, double phi, double e, double beta, int64_t n)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow;
  s.engine = GG_DSMC;
  s.phi = phi;
  s.dsmc.particles = n;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = e, s.collision.beta[p] = beta;
  return s;
}

static inline gg_model lab_model(const gg_scene *s)
{
  gg_model m;
  gg_error err = {0};
  if (gg_scene_model_make(s, GG_DSMC, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

static inline gg_engine *lab_engine(const gg_model *m, uint64_t seed)
{
  gg_engine *g = NULL;
  gg_error err = {0};
  if (gg_dsmc_ops.create(m, seed, 0, &g, &err) != GG_OK) fail_msg("%s", err.message);
  return g;
}

static inline double lab_advance(gg_engine *g, double dt, uint64_t collisions)
{
  double elapsed = 0;
  gg_error err = {0};
  if (gg_dsmc_ops.advance(g, dt, collisions, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
  return elapsed;
}

/* Sums over the grains of a snapshot. */
typedef struct lab_view {
  double n, momentum[3], cc[3][3], c4, ss, s_mean[3];
  double n_of[2], c4_of[2], cc_of[2], xy_of[2]; /* by species; sums of C^4, C^2, C_x C_y */
} lab_view;

static inline void lab_add_chunk(void *context, const gg_chunk *k)
{
  lab_view *v = context;
  for (size_t i = 0; i < k->n; i++) {
    double c[3] = {k->c[0][i], k->c[1][i], k->c[2][i]}, c2 = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    int s = k->species ? k->species[i] : 0;
    v->n++, v->c4 += c2 * c2;
    v->n_of[s]++, v->cc_of[s] += c2, v->c4_of[s] += c2 * c2, v->xy_of[s] += c[0] * c[1];
    for (int a = 0; a < 3; a++) {
      v->momentum[a] += c[a];
      for (int b = 0; b < 3; b++) v->cc[a][b] += c[a] * c[b];
      if (k->s[a]) v->ss += k->s[a][i] * k->s[a][i], v->s_mean[a] += k->s[a][i];
    }
  }
}

static inline lab_view lab_snapshot(gg_engine *g)
{
  lab_view v = {0};
  gg_dsmc_ops.snapshot(g, false, lab_add_chunk, &v);
  return v;
}

static inline double lab_temperature(const lab_view *v)
{
  return (v->cc[0][0] + v->cc[1][1] + v->cc[2][2]) / (3 * v->n);
}

/* A mean and its standard error, from values that each average an interval much longer than the correlation time. */
typedef struct lab_mean {
  int n;
  double sum, sum2;
} lab_mean;

static inline void lab_add(lab_mean *m, double x)
{
  m->n++, m->sum += x, m->sum2 += x * x;
}
static inline double lab_value(const lab_mean *m)
{
  return m->sum / m->n;
}
static inline double lab_error(const lab_mean *m)
{
  double mean = lab_value(m), var = fmax(m->sum2 / m->n - mean * mean, 0);
  return sqrt(var / (m->n - 1));
}

/* Fails unless the mean is within 4 standard errors (of both) of `expected`, and unless the error is small enough that
 * a relative deviation of `sight` would be 4 of them. */
static inline void lab_expect(const char *what, const lab_mean *m, double expected, double expected_error, double sight)
{
  double error = hypot(lab_error(m), expected_error);
  printf("# %-28s %.6f +- %.6f, expected %.6f +- %.6f (%+.2f sigma)\n", what, lab_value(m), lab_error(m), expected,
         expected_error, (lab_value(m) - expected) / error);
  if (fabs(lab_value(m) - expected) > 4 * error)
    fail_msg("%s: %g +- %g is not %g", what, lab_value(m), error, expected);
  if (4 * error > sight * fabs(expected)) fail_msg("%s: an error of %g is too large to prove anything", what, error);
}

/* Averages of a sheared, heated or cooling gas over blocks of time. Stresses are per volume. */
typedef struct lab_flow {
  lab_mean T, theta, P[3][3], kinetic[3][3], rate, balance, N1, N2, p, loss, a2, spin_z, eta;
} lab_flow;

/* Averages over `blocks` blocks of `length` collisions a grain, ten samples each, after `warmup` collisions a grain. */
static inline void lab_average(gg_engine *g, const gg_model *m, double warmup, int blocks, double length, lab_flow *f)
{
  const int samples = 10;
  double n = (double)m->n;
  lab_advance(g, INFINITY, (uint64_t)(warmup * n / 2));
  for (int b = 0; b < blocks; b++) {
    lab_view sum = {0};
    double time = 0;
    gg_collision_sums t;
    gg_dsmc_ops.take_sums(g, &t);
    for (int s = 0; s < samples; s++) {
      time += lab_advance(g, INFINITY, (uint64_t)(length * n / 2 / samples));
      gg_dsmc_ops.snapshot(g, false, lab_add_chunk, &sum);
    }
    gg_dsmc_ops.take_sums(g, &t);
    double P[3][3], K[3][3], trace = 0, T = lab_temperature(&sum), loss = 0, collisions = 0;
    for (int q = 0; q < GG_PAIRS; q++) loss += t.loss[q] / (m->volume * time), collisions += (double)t.collisions[q];
    for (int a = 0; a < 3; a++)
      for (int c = 0; c < 3; c++) {
        K[a][c] = m->density * sum.cc[a][c] / sum.n;
        P[a][c] = K[a][c];
        for (int q = 0; q < GG_PAIRS; q++) P[a][c] += t.stress[q][a][c] / (m->volume * time);
        lab_add(&f->P[a][c], P[a][c]);
        lab_add(&f->kinetic[a][c], K[a][c]);
        if (a == c) trace += P[a][c];
      }
    lab_add(&f->T, T);
    lab_add(&f->p, trace / 3);
    lab_add(&f->N1, 3 * (P[0][0] - P[1][1]) / trace);
    lab_add(&f->N2, 3 * (P[1][1] - P[2][2]) / trace);
    lab_add(&f->rate, 2 * collisions / (n * time));
    lab_add(&f->loss, loss);
    lab_add(&f->balance, -(K[0][1] + P[1][0] - K[1][0]) * m->shear_rate / loss);
    lab_add(&f->a2, sum.c4 / sum.n / (15 * T * T) - 1);
    double sz = sum.s_mean[2] / sum.n;
    lab_add(&f->spin_z, 2 * sz);
    lab_add(&f->theta, m->inertia[0] * (sum.ss / sum.n - sz * sz) / 3);
    lab_add(&f->eta, -P[0][1]);
  }
}

/* Both engines store the same bits. */
static inline void lab_same_archive(gg_engine *a, gg_engine *b)
{
  gg_archive one = {0}, two = {0};
  gg_error err = {0};
  assert_int_equal(a->ops->save(a, &one, &err), GG_OK);
  assert_int_equal(b->ops->save(b, &two, &err), GG_OK);
  assert_int_equal(one.n_items, two.n_items);
  for (size_t i = 0; i < one.n_items; i++) {
    assert_int_equal(one.items[i].count, two.items[i].count);
    assert_memory_equal(one.items[i].data, two.items[i].data,
                        one.items[i].count * gg_base_archive_item_size(one.items[i].type));
  }
  gg_base_archive_clear(&one);
  gg_base_archive_clear(&two);
}

#endif
