/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/mesh.h"

#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { LEAST_MESH = 16, MOST_MESH = 96 };
#define MESH_SPACING 0.25

/* FFTW plans with one planner for the whole process: only execution is free of locks. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

int gg_measure_mesh_points_along(const gg_model *m)
{
  double longest = fmax(fmax(m->box[0], m->box[1]), m->box[2]);
  return 4 * (int)ceil(fmin(fmax(longest / MESH_SPACING, LEAST_MESH), MOST_MESH) / 4);
}

gg_status gg_measure_mesh_init(gg_mesh *m, int n, gg_error *err)
{
  size_t plane = (size_t)n * (size_t)n;
  *m = (gg_mesh){.n = n};
  m->field = fftw_alloc_real(plane * (size_t)n);
  m->modes = fftw_alloc_complex(plane * (size_t)(n / 2 + 1));
  const bool lacked = !m->field || !m->modes || !gg_base_memory_is_room();
  if (!lacked) {
    pthread_mutex_lock(&planner);
    m->plan = fftw_plan_dft_r2c_3d(n, n, n, m->field, m->modes, FFTW_ESTIMATE);
    pthread_mutex_unlock(&planner);
  }
  if (m->plan) return GG_OK;
  gg_measure_mesh_clear(m);
  if (lacked) return gg_base_out_of_memory_for(err, "a mesh of %d^3", n);
  return gg_base_fail(err, GG_FAILED, "no Fourier transform on a mesh of %d^3 could be planned", n);
}

void gg_measure_mesh_clear(gg_mesh *m)
{
  pthread_mutex_lock(&planner);
  if (m->plan) fftw_destroy_plan(m->plan);
  pthread_mutex_unlock(&planner);
  fftw_free(m->field);
  fftw_free(m->modes);
  *m = (gg_mesh){0};
}

/* The four points of the cubic spline around the position x of the edge, and their weights. */
typedef struct spread {
  int at[4];
  double weight[4];
} spread;

static spread spread_over(double x, int n)
{
  spread s;
  double place = (x - floor(x)) * n, whole = floor(place), t = place - whole, u = 1 - t;
  const double weight[4] = {u * u * u / 6, 2.0 / 3 - t * t + t * t * t / 2, 2.0 / 3 - u * u + u * u * u / 2,
                            t * t * t / 6};
  for (int k = 0; k < 4; k++) {
    s.at[k] = ((int)whole + k - 1 + n) % n;
    s.weight[k] = weight[k];
  }
  return s;
}

void gg_measure_mesh_transform(gg_mesh *m, const gg_snapshot *s, const gg_images *b, const double *f)
{
  size_t n = (size_t)m->n;
  memset(m->field, 0, n * n * n * sizeof *m->field);
  for (size_t i = 0; i < s->n; i++) {
    double y = s->r[1][i] * b->inverse[1], x = (s->r[0][i] - b->offset * y) * b->inverse[0], value = f ? f[i] : 1;
    spread sx = spread_over(x, m->n), sy = spread_over(y, m->n), sz = spread_over(s->r[2][i] * b->inverse[2], m->n);
    for (int c = 0; c < 4; c++)
      for (int d = 0; d < 4; d++) {
        double *row = m->field + ((size_t)sz.at[c] * n + (size_t)sy.at[d]) * n,
               share = value * sz.weight[c] * sy.weight[d];
        for (int e = 0; e < 4; e++) row[sx.at[e]] += share * sx.weight[e];
      }
  }
  fftw_execute(m->plan);
}

/* Transform of the cubic spline. */
static double window(int k, int n)
{
  double x = M_PI * k / n, sinc = k ? sin(x) / x : 1;
  return sinc * sinc * sinc * sinc;
}

gg_mode gg_measure_mesh_mode(const gg_mesh *m, int nx, int ny, int nz)
{
  int n = m->n;
  size_t at = ((size_t)((nz + n) % n) * (size_t)n + (size_t)((ny + n) % n)) * (size_t)(n / 2 + 1) + (size_t)nx;
  double w = window(nx, n) * window(ny, n) * window(nz, n);
  return (gg_mode){m->modes[at][0] / w, m->modes[at][1] / w};
}

gg_vec gg_measure_mesh_wave_vector(const gg_images *b, int nx, int ny, int nz)
{
  return (gg_vec){2 * M_PI * nx * b->inverse[0], 2 * M_PI * (ny - nx * b->offset * b->inverse[0]) * b->inverse[1],
                  2 * M_PI * nz * b->inverse[2]};
}
