#include "theory/rough/relative.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/overlap.h"

/* Points of the rule in k_z on (0, 1), and in azimuth on (0, pi), to 1e-6: a quarter of the sphere stands for the
 * whole. */
enum { POLAR = 4, AZIMUTH = 12 };

typedef struct gg_relative_work {
  double *E;      /* n x n: Ho_R(M z + b) - Ho_R(z) = sum_T E_RT Ho_T(z) */
  double *flux;   /* n3 x n3: < g_n Ho_t(d) Ho_s(d) > */
  double *ladder; /* the same of t to N and s to 2 N, from which it comes */
  double *by_kind;
  int *sorted, sorted_n[4];
  int (*wide)[3], n_wide, *place;
} gg_relative_work;

static int cell(int side, int x, int y, int z)
{
  return (x * side + y) * side + z;
}

static gg_status make_work(gg_relative_work *w, const gg_rough_functions *f, bool factored, gg_error *err)
{
  size_t n = factored ? 1 : (size_t)f->n, n3 = (size_t)f->n3;
  int most = 2 * f->degree, side = most + 1;
  *w = (gg_relative_work){.n_wide = gg_rough_count3(most)};
  w->E = malloc(n * n * sizeof *w->E);
  w->flux = malloc(n3 * n3 * sizeof *w->flux);
  w->by_kind = malloc(4 * n3 * n3 * sizeof *w->by_kind);
  w->sorted = malloc(4 * n3 * sizeof *w->sorted);
  w->ladder = malloc(n3 * (size_t)w->n_wide * sizeof *w->ladder);
  w->wide = malloc((size_t)w->n_wide * sizeof *w->wide);
  w->place = malloc((size_t)(side * side * side) * sizeof *w->place);
  if (!w->E || !w->flux || !w->by_kind || !w->sorted || !w->ladder || !w->wide || !w->place)
    return gg_base_out_of_memory(err);
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
  free(w->E);
  free(w->flux);
  free(w->by_kind);
  free(w->sorted);
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

/* to = (sum_j M_j z_j + b) from, on an expansion of degree `degree`. */
static void multiply(const gg_rough_functions *f, const double *M, double b, int degree, const double *from, double *to)
{
  double root[GG_ROUGH_AXES][GG_ROUGH_MOST_DEGREE + 3];
  for (int j = 0; j < GG_ROUGH_AXES; j++)
    for (int r = 0; r <= f->degree + 1; r++) root[j][r] = M[j] * sqrt(r);
  for (int i = 0; i < f->upto[degree + 2]; i++) {
    int T = f->by_degree[i];
    const int *r = f->function[T].r, *up = f->up[T], *down = f->down[T];
    double sum = b * from[T];
    for (int j = 0; j < GG_ROUGH_AXES; j++) {
      if (M[j] == 0) continue;
      if (up[j] >= 0) sum += root[j][r[j] + 1] * from[up[j]];
      if (down[j] >= 0) sum += root[j][r[j]] * from[down[j]];
    }
    to[T] = sum;
  }
}

/* Row after row by the recursion of Hermite's polynomials in z' = M z + b. */
static void expand_tests(const gg_rough_functions *f, const gg_rough_collision *c, double *E)
{
  size_t n = (size_t)f->n;
  memset(E, 0, n * n * sizeof *E);
  E[0] = 1;
  for (int i = 1; i < f->n; i++) {
    int R = f->by_degree[i], total = gg_rough_degree(f->function[R]), axis = 0;
    const int *r = f->function[R].r;
    while (r[axis] == 0) axis++;
    int before = f->down[R][axis], twice = f->down[before][axis];
    double *row = E + (size_t)R * n, root = 1 / sqrt(r[axis]), less = twice < 0 ? 0 : sqrt(r[axis] - 1);
    const double *second = E + (size_t)(twice < 0 ? 0 : twice) * n;
    multiply(f, c->M[axis], c->b[axis], total - 1, E + (size_t)before * n, row);
    for (int T = 0; T < f->n; T++) row[T] = root * (row[T] - less * second[T]);
  }
  for (int R = 0; R < f->n; R++) E[(size_t)R * n + (size_t)R] -= 1;
}

/* Columns of the flux by class of their velocity index: parity, and parity of z. */
static void sort_flux(const gg_rough_functions *f, gg_relative_work *w)
{
  memset(w->sorted_n, 0, sizeof w->sorted_n);
  for (int s = 0; s < f->n3; s++) {
    const int *v = f->three[s];
    int kind = (v[0] + v[1] + v[2]) % 2 + 2 * (v[2] % 2), at = w->sorted_n[kind]++;
    w->sorted[kind * f->n3 + at] = s;
    for (int t = 0; t < f->n3; t++) w->by_kind[(kind * f->n3 + t) * f->n3 + at] = w->flux[t * f->n3 + s];
  }
}

/* to += weight * row of E times the flux, in the columns that are of the class of the row: the others cancel between
 * the quarters of the sphere. */
static void add_row(const gg_rough_functions *f, const gg_relative_work *w, const double *E, int class, double weight,
                    double *to)
{
  double sum[3 * GG_ROUGH_MOST_DEGREE * GG_ROUGH_MOST_DEGREE];
  for (int s = 0; s < f->n3; s++) {
    const int *spin = f->three[s];
    int spins = spin[0] + spin[1] + spin[2], kind = class % 2 + 2 * ((class / 2 + spin[0] + spin[1]) % 2), n = 0;
    int many = gg_rough_count3(f->degree - spins);
    const int *column = w->sorted + kind * f->n3;
    while (n < w->sorted_n[kind] && column[n] < many) n++;
    const double *e = E + f->from[s], *flux = w->by_kind + (size_t)(kind * f->n3 * f->n3);
    if (n == 0) continue;
    memset(sum, 0, (size_t)n * sizeof *sum);
    for (int t = 0; t < many; t++) {
      if (e[t] == 0) continue;
      for (int v = 0; v < n; v++) sum[v] += e[t] * flux[t * f->n3 + v];
    }
    for (int v = 0; v < n; v++) to[f->from[s] + column[v]] += weight * sum[v];
  }
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

static void add_direction(gg_rough_relative *r, gg_relative_work *w, const gg_rough_gas *gas,
                          const gg_rough_weight *weight, const double k[3], double solid_angle)
{
  const gg_rough_functions *f = &r->f;
  gg_rough_collision c = gg_rough_collision_at(gas, weight, k);
  make_flux(f, w, &c);
  sort_flux(f, w);
  expand_tests(f, &c, w->E);
  for (int R = 1; R < f->n; R++)
    add_row(f, w, w->E + (size_t)R * (size_t)f->n, gg_rough_class(f->function[R]), solid_angle,
            r->W + (size_t)R * (size_t)f->n);
  add_impulse(r, w, &c, k, solid_angle);
}

static gg_status add_all(gg_rough_relative *r, gg_relative_work *w, const gg_rough_gas *gas,
                         const gg_rough_weight *weight, bool one_direction, gg_error *err)
{
  double z[2 * POLAR], wz[2 * POLAR], k[3] = {0, 0, 1};
  if (one_direction) {
    add_direction(r, w, gas, weight, k, 4 * M_PI);
    return GG_OK;
  }
  GG_TRY(gg_hermite_legendre_rule(2 * POLAR, z, wz, err));
  for (int n = 0; n < POLAR * AZIMUTH; n++) {
    int i = POLAR + n / AZIMUTH;
    double angle = M_PI * (n % AZIMUTH + 0.5) / AZIMUTH;
    k[2] = 2 * z[i] - 1;
    double s = sqrt(1 - k[2] * k[2]);
    k[0] = s * cos(angle), k[1] = s * sin(angle);
    add_direction(r, w, gas, weight, k, 8 * wz[i] * M_PI / AZIMUTH);
  }
  return GG_OK;
}

static gg_status make(gg_rough_relative *r, gg_relative_work *w, int degree, bool factored, gg_error *err)
{
  *r = (gg_rough_relative){0};
  GG_TRY(gg_rough_functions_make(&r->f, degree, err));
  size_t n = (size_t)r->f.n;
  r->rate = calloc(10 * n, sizeof *r->rate);
  if (factored)
    r->factors = malloc(sizeof *r->factors);
  else
    r->W = calloc(n * n, sizeof *r->W);
  if (!r->rate || (!r->W && !r->factors)) return gg_base_out_of_memory(err);
  for (size_t i = 0; i < 9; i++) r->J[i / 3][i % 3] = r->rate + (i + 1) * n;
  return make_work(w, &r->f, factored, err);
}

gg_status gg_rough_relative_make(gg_rough_relative *r, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                 int degree, bool one_direction, gg_error *err)
{
  gg_relative_work w = {0};
  gg_status status = make(r, &w, degree, false, err);
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
  gg_status status = make(r, &w, degree, true, err);
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
