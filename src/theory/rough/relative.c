/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/relative.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/overlap.h"
#include "theory/rough/eight_directions.h"
#include "theory/rough/friction.h"

/* Points of the rule in k_z on (0, 1), and in azimuth on (0, pi), to 1e-6: by symmetry a quarter of the sphere is
 * enough. */
enum { POLAR = 4, AZIMUTH = 12 };

typedef struct gg_relative_work {
  double *flux;   /* n3 x n3: < g_n Ho_t(d) Ho_s(d) > */
  double *ladder; /* the same for t to N and s to 2 N, from which `flux` follows */
  gg_rough_eight eight;
  int (*wide)[3], n_wide, *place;
} gg_relative_work;

static int cell(int side, int x, int y, int z)
{
  return (x * side + y) * side + z;
}

static gg_status make_work(gg_relative_work *w, const gg_rough_functions *f, gg_error *err)
{
  size_t n3 = (size_t)f->n3;
  int most = 2 * f->degree, side = most + 1;
  *w = (gg_relative_work){.n_wide = gg_rough_count3(most)};
  w->flux = malloc(n3 * n3 * sizeof *w->flux);
  w->ladder = malloc(n3 * (size_t)w->n_wide * sizeof *w->ladder);
  w->wide = malloc((size_t)w->n_wide * sizeof *w->wide);
  w->place = malloc((size_t)(side * side * side) * sizeof *w->place);
  if (!w->flux || !w->ladder || !w->wide || !w->place) return gg_base_out_of_memory(err);
  for (int k = 0, at = 0; k <= most; k++)
    for (int x = k; x >= 0; x--)
      for (int y = k - x; y >= 0; y--, at++) {
        w->wide[at][0] = x, w->wide[at][1] = y, w->wide[at][2] = k - x - y;
        w->place[cell(side, x, y, k - x - y)] = at;
      }
  return GG_OK;
}

static void clear_work(gg_relative_work *w)
{
  free(w->flux);
  gg_rough_eight_clear(&w->eight);
  free(w->ladder);
  free(w->wide);
  free(w->place);
}

/* < g_n Ho_s(d) > = moment_|s| sqrt(|s|!/s!) normal^s. */
static double first_row(const int s[3], const double normal[3], const double *moment)
{
  int total = s[0] + s[1] + s[2];
  double value = moment[total] * sqrt(tgamma(total + 1.));
  for (int i = 0; i < 3; i++) value *= pow(normal[i], s[i]) / sqrt(tgamma(s[i] + 1.));
  return value;
}

/* g_n commutes with each coordinate, d_i = sqrt(t_i + 1) (t -> t + e_i) + sqrt(t_i) (t -> t - e_i): row after row. */
static void make_flux(const gg_rough_functions *f, gg_relative_work *w, const gg_rough_collision *c)
{
  int most = 2 * f->degree, side = most + 1;
  double moment[2 * GG_ROUGH_MOST_DEGREE + 1];
  gg_rough_flux(c, most, moment);
  for (int s = 0; s < w->n_wide; s++) w->ladder[s] = first_row(w->wide[s], c->normal, moment);
  for (int t = 1; t < f->n3; t++) {
    int x[3] = {f->three[t][0], f->three[t][1], f->three[t][2]}, i = x[0] > 0 ? 0 : x[1] > 0 ? 1 : 2;
    double root = sqrt(x[i]), less = sqrt(x[i] - 1);
    x[i]--;
    int total = x[0] + x[1] + x[2] + 1;
    const double *one = w->ladder + (size_t)w->place[cell(side, x[0], x[1], x[2])] * (size_t)w->n_wide, *two = NULL;
    if (x[i] > 0) x[i]--, two = w->ladder + (size_t)w->place[cell(side, x[0], x[1], x[2])] * (size_t)w->n_wide;
    double *row = w->ladder + (size_t)t * (size_t)w->n_wide;
    for (int s = 0; s < gg_rough_count3(most - total); s++) {
      int y[3] = {w->wide[s][0], w->wide[s][1], w->wide[s][2]};
      y[i]++;
      double value = sqrt(y[i]) * one[w->place[cell(side, y[0], y[1], y[2])]];
      y[i] -= 2;
      if (y[i] >= 0) value += sqrt(y[i] + 1) * one[w->place[cell(side, y[0], y[1], y[2])]];
      if (two) value -= less * two[s];
      row[s] = value / root;
    }
  }
  for (int t = 0; t < f->n3; t++)
    memcpy(w->flux + t * f->n3, w->ladder + (size_t)t * (size_t)w->n_wide, (size_t)f->n3 * sizeof *w->flux);
}

static void add_impulse(gg_rough_relative *r, const gg_relative_work *w, const gg_rough_collision *c, const double k[3],
                        double weight)
{
  const gg_rough_functions *f = &r->f;
  for (int j = 0; j < 3; j++) {
    double row[1 + 2 * GG_ROUGH_AXES];
    int place[1 + GG_ROUGH_AXES] = {0};
    row[0] = c->J0[j];
    for (int x = 0; x < GG_ROUGH_AXES; x++) row[x + 1] = c->J[j][x], place[x + 1] = f->up[0][x];
    for (int x = 0; x <= GG_ROUGH_AXES; x++) {
      if (place[x] < 0) continue;
      int s = 0, t = place[x];
      while (f->from[s + 1] <= t) s++;
      t -= f->from[s];
      const int *spin = f->three[s];
      for (int v = 0; v < gg_rough_count3(f->degree - spin[0] - spin[1] - spin[2]); v++)
        for (int i = 0; i < 3; i++) r->J[i][j][f->from[s] + v] += weight * k[i] * row[x] * w->flux[t * f->n3 + v];
    }
  }
  for (int v = 0; v < f->n3; v++) r->rate[v] += weight * w->flux[v];
}

static void set_direction(gg_rough_relative *r, gg_relative_work *w, const gg_rough_gas *gas,
                          const gg_rough_weight *weight, const double k[3], double solid_angle, int lane)
{
  gg_rough_collision c = gg_rough_collision_at(gas, weight, k);
  make_flux(&r->f, w, &c);
  gg_rough_eight_set(&w->eight, lane, &c, w->flux, solid_angle);
  add_impulse(r, w, &c, k, solid_angle);
}

static void direction_of(double kz, double azimuth, double k[3])
{
  const double s = sqrt(1 - kz * kz);
  k[0] = s * cos(azimuth), k[1] = s * sin(azimuth), k[2] = kz;
}

static gg_status add_all(gg_rough_relative *r, gg_relative_work *w, const gg_rough_gas *gas,
                         const gg_rough_weight *weight, bool one_direction, gg_error *err)
{
  double z[2 * POLAR], wz[2 * POLAR], k[3] = {0, 0, 1};
  GG_TRY(gg_rough_eight_make(&w->eight, &r->f, err));
  if (one_direction) {
    set_direction(r, w, gas, weight, k, 4 * M_PI, 0);
    gg_rough_eight_add(&w->eight, r->W);
    return GG_OK;
  }
  GG_TRY(gg_hermite_legendre_rule(2 * POLAR, z, wz, err));
  _Static_assert(POLAR * AZIMUTH % GG_ROUGH_LANES == 0, "no lane is left over");
  for (int n = 0; n < POLAR * AZIMUTH; n++) {
    const int i = POLAR + n / AZIMUTH, lane = n % GG_ROUGH_LANES;
    direction_of(2 * z[i] - 1, M_PI * (n % AZIMUTH + 0.5) / AZIMUTH, k);
    set_direction(r, w, gas, weight, k, 8 * wz[i] * M_PI / AZIMUTH, lane);
    if (lane < GG_ROUGH_LANES - 1) continue;
    GG_TRY(gg_stop_check(gas->stop, err));
    gg_rough_eight_add(&w->eight, r->W);
  }
  return GG_OK;
}

static gg_status make(gg_rough_relative *r, const gg_rough_gas *gas, int degree, bool factored, gg_error *err)
{
  *r = (gg_rough_relative){.stop = gas->stop};
  GG_TRY(gg_rough_functions_make(&r->f, degree, err));
  size_t n = (size_t)r->f.n;
  r->rate = calloc(10 * n, sizeof *r->rate);
  if (factored)
    r->factors = malloc(sizeof *r->factors);
  else
    r->W = calloc(n * n, sizeof *r->W);
  if (!r->rate || (!r->W && !r->factors)) return gg_base_out_of_memory(err);
  for (size_t i = 0; i < 9; i++) r->J[i / 3][i % 3] = r->rate + (i + 1) * n;
  return GG_OK;
}

/* A coarser rule in azimuth, to 1e-4: a direction with friction takes much longer. */
static gg_status add_sphere_of_friction(gg_rough_friction *friction, const gg_rough_gas *gas,
                                        const gg_rough_weight *weight, gg_rough_sums *sums, gg_error *err)
{
  enum { FEW_POLAR = 3, FEW_AZIMUTH = 8 };
  double z[2 * FEW_POLAR], wz[2 * FEW_POLAR], k[3];
  GG_TRY(gg_hermite_legendre_rule(2 * FEW_POLAR, z, wz, err));
  for (int n = 0; n < FEW_POLAR * FEW_AZIMUTH; n++) {
    const int i = FEW_POLAR + n / FEW_AZIMUTH;
    GG_TRY(gg_stop_check(gas->stop, err));
    direction_of(2 * z[i] - 1, M_PI * (n % FEW_AZIMUTH + 0.5) / FEW_AZIMUTH, k);
    GG_TRY(gg_rough_friction_add(friction, gas, weight, k, 8 * wz[i] * M_PI / FEW_AZIMUTH, sums, err));
  }
  return GG_OK;
}

static gg_status add_friction(gg_rough_relative *r, const gg_rough_gas *gas, const gg_rough_weight *weight,
                              bool one_direction, gg_error *err)
{
  gg_rough_friction *friction;
  gg_rough_sums sums = {r->W, r->rate, r->J};
  const double k[3] = {0, 0, 1};
  gg_status status = gg_rough_friction_make(&friction, &r->f, one_direction, err);
  if (status == GG_OK && one_direction)
    status = gg_rough_friction_add(friction, gas, weight, k, 4 * M_PI, &sums, err);
  else if (status == GG_OK)
    status = add_sphere_of_friction(friction, gas, weight, &sums, err);
  gg_rough_friction_free(friction);
  return status;
}

static gg_status make_frictional(gg_rough_relative *r, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                 int degree, bool one_direction, gg_error *err)
{
  gg_status status = make(r, gas, degree, false, err);
  if (status == GG_OK) status = add_friction(r, gas, weight, one_direction, err);
  if (status != GG_OK) gg_rough_relative_clear(r);
  return status;
}

gg_status gg_rough_relative_make(gg_rough_relative *r, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                 int degree, bool one_direction, gg_error *err)
{
  gg_relative_work w = {0};
  if (isfinite(gas->mu)) return make_frictional(r, gas, weight, degree, one_direction, err);
  gg_status status = make(r, gas, degree, false, err);
  if (status == GG_OK) status = make_work(&w, &r->f, err);
  if (status == GG_OK) status = add_all(r, &w, gas, weight, one_direction, err);
  clear_work(&w);
  if (status != GG_OK) gg_rough_relative_clear(r);
  return status;
}

gg_status gg_rough_relative_isotropic(gg_rough_relative *r, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                      int degree, gg_error *err)
{
  gg_relative_work w = {0};
  double k[3] = {0, 0, 1};
  if (isfinite(gas->mu)) return make_frictional(r, gas, weight, degree, true, err);
  gg_status status = make(r, gas, degree, true, err);
  if (status == GG_OK) status = make_work(&w, &r->f, err);
  if (status == GG_OK) {
    gg_rough_collision c = gg_rough_collision_at(gas, weight, k);
    make_flux(&r->f, &w, &c);
    add_impulse(r, &w, &c, k, 4 * M_PI);
    status = gg_rough_factors_make(r->factors, &c, degree, err);
  }
  clear_work(&w);
  if (status != GG_OK) gg_rough_relative_clear(r);
  return status;
}

void gg_rough_relative_clear(gg_rough_relative *r)
{
  gg_rough_functions_clear(&r->f);
  free(r->W);
  free(r->rate);
  free(r->factors);
  *r = (gg_rough_relative){0};
}
