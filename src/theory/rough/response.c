/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/linear_solve.h"
#include "theory/rough/one_direction.h"
#include "theory/rough/tensors.h"

enum { X = 0, Z = 2, SPIN = 3 };

/* A function of one grain by its nonzero coefficients. */
typedef struct sparse {
  int n;
  gg_rough_term *term;
} sparse;

/* Functions of one grain are rows of f.n coefficients. */
typedef struct response {
  const gg_rough_steady *s;
  gg_rough_functions f;
  gg_rough_tensors t;
  gg_rough_direction by, flux; /* collisions for the tests; and for moments of degree 2, without decay */
  double L, S;                 /* of the weight, along an axis */
  double reach;        /* the diameter in units in which n chi sigma^2 is the frequency; 0 in the dilute limit */
  double *M, *overlap; /* d<psi_m>/dt and <psi_m> of function n, by rows */
  double *f0, *gradient, *x, *y; /* f0; d f0/d ln T = -d/d(C, s) . ((C, s) f0)/2 */
  sparse base, of_parity[4];     /* f0, also by gg_rough_parity */
  double *rows[3];               /* n each */
} response;

static bool pick(const response *r, const double *x, sparse *s)
{
  s->n = 0;
  for (int q = 0; q < r->f.n; q++) s->n += x[q] != 0;
  s->term = malloc(((size_t)s->n + 1) * sizeof *s->term);
  for (int q = 0, k = 0; q < r->f.n && s->term; q++)
    if (x[q] != 0) s->term[k++] = gg_rough_term_of(r->f.function[q].r, x[q]);
  return s->term != NULL;
}

/* to += amount x C_i, and to += amount x d/dC_i, of the function `from` (with its weight). */
static void times(const response *r, int axis, double amount, const double *from, double *to)
{
  for (int q = 0; q < r->f.n; q++) {
    const int up = r->f.up[q][axis], down = r->f.down[q][axis];
    if (from[q] == 0) continue;
    if (up >= 0) to[up] += amount * r->L * sqrt(r->f.function[up].r[axis]) * from[q];
    if (down >= 0) to[down] += amount * r->L * sqrt(r->f.function[q].r[axis]) * from[q];
  }
}

static void slope(const response *r, int axis, double amount, const double *from, double *to)
{
  for (int q = 0; q < r->f.n; q++) {
    const int up = r->f.up[q][axis];
    if (from[q] != 0 && up >= 0) to[up] -= amount / r->L * sqrt(r->f.function[up].r[axis]) * from[q];
  }
}

/* to += what an axis adds to df/dt: drag, -d(-drag x f)/dx, and noise. */
static void stream(const response *r, int axis, double drag, double diffusion, const double *from, double *to)
{
  const double spread = axis < SPIN ? r->L : r->S;
  for (int q = 0; q < r->f.n; q++) {
    if (from[q] == 0) continue;
    const int up = r->f.up[q][axis], twice = up < 0 ? -1 : r->f.up[up][axis], quanta = r->f.function[q].r[axis];
    to[q] -= drag * quanta * from[q];
    if (twice >= 0) to[twice] += (diffusion / (spread * spread) - drag) * sqrt((quanta + 1.) * (quanta + 2.)) * from[q];
  }
}

static const int *index_of(const response *r, int q)
{
  return r->f.function[q].r;
}

/* rows_m += amount <psi_m> of a component's x. */
static void test(const response *r, int c, double amount, const double *x, double *rows)
{
  const gg_rough_tensors *t = &r->t;
  for (int k = 0; k < t->many[c]; k++) {
    double sum = 0;
    for (int q = 0; q < r->f.n; q++)
      if (x[q] != 0) sum += x[q] * gg_rough_direction_kept(&r->by, index_of(r, t->place[c][k]), index_of(r, q));
    for (int m = 0; m < t->n; m++) rows[m] += amount * t->share[c] * sum * t->of[c][m * t->many[c] + k];
  }
}

/* Sum over one test and functions of both grains: sum one two <psi>. */
static double both(const gg_rough_direction *by, const int *test, const sparse *one, const sparse *two)
{
  double sum = 0;
  for (int p = 0; p < one->n; p++)
    sum += one->term[p].value * gg_rough_direction_sum(by, test, one->term[p].r, false, two->term, two->n);
  return sum;
}

/* rows_m += amount d<psi_m>/dt of grains of f0 that collide with partners of x, ahead. */
static gg_status add_collisions(const response *r, int c, double amount, const double *x, double *rows, gg_error *err)
{
  const gg_rough_tensors *t = &r->t;
  sparse partner;
  if (!pick(r, x, &partner)) return gg_base_out_of_memory(err);
  gg_status status = GG_OK;
  for (int k = 0; k < t->many[c] && (status = gg_stop_check(r->s->gas.stop, err)) == GG_OK; k++) {
    const double rate =
        amount * r->s->gas.frequency * t->share[c] * both(&r->by, index_of(r, t->place[c][k]), &r->base, &partner);
    for (int m = 0; m < t->n; m++) rows[m] += rate * t->of[c][m * t->many[c] + k];
  }
  free(partner.term);
  return status;
}

/* d<psi_test>/dt of f0 and a small part of `place`, by collisions. */
static double linearised(const response *r, const int *test, int place)
{
  const int *q = index_of(r, place);
  const sparse *base = &r->of_parity[gg_rough_parity(test) ^ gg_rough_parity(q)];
  double sum = 0;
  for (int k = 0; k < 2; k++) sum += gg_rough_direction_sum(&r->by, test, q, k, base->term, base->n);
  return r->s->gas.frequency * sum;
}

/* The same by streaming. */
static double streamed(const response *r, const int *test, int place)
{
  const gg_rough_stream *s = &r->s->stream;
  double sum = 0;
  for (int axis = 0; axis < GG_ROUGH_AXES; axis++) {
    const bool spin = axis >= SPIN;
    const double drag = spin ? s->spin : s->velocity[0][0], spread = spin ? r->S : r->L;
    const double diffusion = (spin ? s->spin_diffusion : s->diffusion) / (spread * spread);
    gg_rough_index q = r->f.function[place];
    const int quanta = q.r[axis];
    sum -= drag * quanta * gg_rough_direction_kept(&r->by, test, q.r);
    q.r[axis] += 2;
    sum += (diffusion - drag) * sqrt((quanta + 1.) * (quanta + 2.)) * gg_rough_direction_kept(&r->by, test, q.r);
  }
  return sum;
}

static gg_status add_component(response *r, int c, double *column, gg_error *err)
{
  const gg_rough_tensors *t = &r->t;
  const int many = t->many[c];
  for (int q = 0; q < many; q++) {
    GG_TRY(gg_stop_check(r->s->gas.stop, err));
    memset(column, 0, 2 * (size_t)t->n * sizeof *column);
    for (int k = 0; k < many; k++) {
      const int *test = index_of(r, t->place[c][k]), place = t->place[c][q];
      if (index_of(r, place)[5] && (test[5] + index_of(r, place)[5]) % 2) continue;
      const double rate = linearised(r, test, place) + streamed(r, test, place);
      const double kept = gg_rough_direction_kept(&r->by, test, index_of(r, place));
      for (int m = 0; m < t->n; m++) {
        const double of = t->share[c] * t->of[c][m * many + k];
        column[m] += of * rate, column[t->n + m] += of * kept;
      }
    }
    for (int m = 0; m < t->n; m++)
      for (int n = 0; n < t->n; n++) {
        const double of = t->of[c][n * many + q];
        r->M[m * t->n + n] += column[m] * of, r->overlap[m * t->n + n] += column[t->n + m] * of;
      }
  }
  return GG_OK;
}

/* f0 of the state, with space for its streaming terms. */
static gg_status take_state(response *r, gg_error *err)
{
  const gg_rough_steady *s = r->s;
  for (int q = 0; q < s->form.n; q++)
    r->f0[gg_rough_place(&r->f, s->relative.f.function[s->form.function[q]].r)] = s->a[q];
  for (int axis = 0; axis < GG_ROUGH_AXES; axis++) stream(r, axis, -0.5, 0, r->f0, r->gradient);
  bool fine = pick(r, r->f0, &r->base);
  for (int parity = 0; parity < 4; parity++) {
    for (int q = 0; q < r->f.n; q++) r->x[q] = gg_rough_parity(index_of(r, q)) == parity ? r->f0[q] : 0;
    fine &= pick(r, r->x, &r->of_parity[parity]);
  }
  return fine ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status make(response *r, const gg_rough_steady *s, int rank, double phi_chi, gg_error *err)
{
  static const gg_rough_choice none = {.decay = 0};
  const int highest = s->degree + (rank == 1);
  *r = (response){
      .s = s, .L = s->weight.L[0][0], .S = s->weight.S[0][0], .reach = 6 / M_PI * phi_chi / s->gas.frequency};
  GG_TRY(gg_rough_functions_make(&r->f, highest + 2, err));
  GG_TRY(gg_rough_tensors_make(&r->t, &r->f, rank, highest, err));
  GG_TRY(gg_rough_direction_make(&r->by, &s->gas, &s->weight, &s->choice, highest, highest + 2, err));
  if (phi_chi > 0) GG_TRY(gg_rough_direction_make(&r->flux, &s->gas, &s->weight, &none, 2, highest + 2, err));
  const size_t n = (size_t)r->t.n, all = (size_t)r->f.n;
  r->M = calloc(2 * n * n + 3 * n + 4 * all, sizeof *r->M);
  double *column = malloc(2 * n * sizeof *column);
  gg_status status = r->M && column ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) {
    r->overlap = r->M + n * n;
    for (int k = 0; k < 3; k++) r->rows[k] = r->overlap + n * n + (size_t)k * n;
    r->f0 = r->rows[2] + n, r->gradient = r->f0 + all, r->x = r->gradient + all, r->y = r->x + all;
    status = take_state(r, err);
  }
  for (int c = 0; c < r->t.components && status == GG_OK; c++) status = add_component(r, c, column, err);
  free(column);
  return status;
}

static void clear(response *r)
{
  gg_rough_functions_clear(&r->f);
  gg_rough_tensors_clear(&r->t);
  gg_rough_direction_clear(&r->by);
  gg_rough_direction_clear(&r->flux);
  free(r->base.term);
  for (int parity = 0; parity < 4; parity++) free(r->of_parity[parity].term);
  free(r->M);
}

/* (M + fading) f1 = -rows; f1 replaces the rows. Without the first function, C, if there must be no momentum. */
static gg_status solve(const response *r, double fading, double *rows, gg_error *err)
{
  const size_t all = (size_t)r->t.n, skip = r->t.rank == 1, n = all - skip;
  double *M = gg_theory_linear_new(n), *x = M ? M + n * n : NULL;
  for (size_t m = 0; M && m < n; m++) {
    x[m] = -rows[m + skip];
    for (size_t k = 0; k < n; k++) {
      const size_t at = (m + skip) * all + k + skip;
      M[m * n + k] = r->M[at] + fading * r->overlap[at];
    }
  }
  const bool solved = M && gg_theory_linear_solve(n, M);
  if (skip) rows[0] = 0;
  for (size_t m = 0; solved && m < n; m++) rows[m + skip] = x[m];
  free(M);
  return solved ? GG_OK : gg_base_fail(err, GG_FAILED, "no linear response was found");
}

/* A component of f1. */
static void expand(const response *r, int c, const double *f1, double *x)
{
  memset(x, 0, (size_t)r->f.n * sizeof *x);
  for (int m = 0; m < r->t.n; m++)
    for (int k = 0; k < r->t.many[c]; k++) x[r->t.place[c][k]] += f1[m] * r->t.of[c][m * r->t.many[c] + k];
}

/* Collisional transfer along z of sum_k amount_k x the Hermite function `test_k`, over the distance, for collisions
 * of grains of f0 and of x: both ways for f1, which is everywhere (sign 1), with opposite signs for a gradient (-1). */
static double carried(const response *r, int n, const gg_rough_index *test, const double *amount, double sign,
                      const double *x)
{
  sparse other;
  double sum = 0;
  if (!pick(r, x, &other)) return NAN;
  for (int k = 0; k < n; k++) {
    const double ahead = both(&r->flux, test[k].r, &r->base, &other);
    sum += amount[k] * (ahead + sign * both(&r->flux, test[k].r, &other, &r->base));
  }
  free(other.term);
  return -r->s->gas.frequency * r->reach / 2 * r->t.share[0] * sum;
}

static double coefficient(const response *r, const double *x, int a, int b, int c)
{
  gg_rough_index index = {{0}};
  index.r[a]++, index.r[b]++, index.r[c]++;
  return x[gg_rough_place(&r->f, index.r)];
}

/* C_z times the translational (spin: rotational) energy, of f1 along z. */
static double flown(const response *r, bool spin, const double *x)
{
  double sum = 0;
  for (int i = 0; i < 3; i++)
    sum += (!spin && i == Z ? sqrt(6) : M_SQRT2) * coefficient(r, x, Z, i + SPIN * spin, i + SPIN * spin);
  return (spin ? r->s->gas.K * r->S * r->S : r->L * r->L) * r->L / 2 * sum;
}

static double energy_carried(const response *r, bool spin, double sign, const double *x)
{
  gg_rough_index test[3] = {{{0}}};
  double amount[3];
  for (int i = 0; i < 3; i++) {
    test[i].r[i + SPIN * spin] = 2;
    amount[i] = (spin ? r->s->gas.K * r->S * r->S : r->L * r->L) * M_SQRT1_2;
  }
  return r->reach > 0 ? carried(r, 3, test, amount, sign, x) : 0;
}

/* Source terms of both gradients: -C D - (1 + y) df0/dC, and -C f0 - ...; partners ahead have D, and f0. */
static gg_status heat_sources(response *r, gg_hermite_density d, gg_error *err)
{
  const double y = 4 * r->s->gas.eta1 * d.phi_chi, pressed[2] = {1 + y, 1 + y * (2 + d.slope)};
  const double *of[2] = {r->gradient, r->f0}, distant[2] = {r->reach, r->reach * (1 + d.slope / 2)};
  for (int k = 0; k < 2; k++) {
    for (int c = 0; c < r->t.components; c++) {
      const int axis = c ? X : Z;
      memset(r->x, 0, (size_t)r->f.n * sizeof *r->x);
      times(r, axis, -1, of[k], r->x);
      slope(r, axis, -pressed[k], r->f0, r->x);
      test(r, c, 1, r->x, r->rows[k]);
    }
    if (r->reach > 0) GG_TRY(add_collisions(r, 0, distant[k], of[k], r->rows[k], err));
  }
  return GG_OK;
}

static gg_status conduct(response *r, gg_hermite_density d, gg_rough_heat *heat, gg_error *err)
{
  const double rate = -r->s->stream.velocity[0][0];
  double *A = r->rows[0], *B = r->rows[1];
  GG_TRY(heat_sources(r, d, err));
  GG_TRY(solve(r, rate, A, err));
  for (int m = 0; m < r->t.n; m++)
    for (int n = 0; n < r->t.n; n++) B[m] += 2 * rate * (1 + d.slope) * r->overlap[m * r->t.n + n] * A[n];
  GG_TRY(solve(r, 0, B, err));
  expand(r, 0, A, r->x);
  expand(r, 0, B, r->y);
  for (int spin = 0; spin < 2; spin++) {
    heat->conductivity_kinetic[spin] = -flown(r, spin, r->x);
    heat->diffusive_kinetic[spin] = -flown(r, spin, r->y);
    heat->conductivity[spin] = heat->conductivity_kinetic[spin] - energy_carried(r, spin, 1, r->x) -
                               r->reach / 2 * energy_carried(r, spin, -1, r->gradient);
    heat->diffusive[spin] = heat->diffusive_kinetic[spin] - energy_carried(r, spin, 1, r->y);
  }
  return GG_OK;
}

gg_status gg_rough_heat_of(const gg_rough_steady *cooling, gg_hermite_density density, gg_rough_heat *heat,
                           gg_error *err)
{
  response r;
  gg_base_gsl_enter();
  gg_status status = make(&r, cooling, 1, density.phi_chi, err);
  if (status == GG_OK) status = conduct(&r, density, heat, err);
  gg_base_gsl_leave();
  clear(&r);
  return status;
}

/* Momentum transferred by collisions, E_c z . J, of x. */
static double momentum_carried(const response *r, int c, double sign, const double *x)
{
  double E[3][3], amount[2];
  const gg_rough_index test[2] = {{{1}}, {{0, 0, 1}}};
  gg_rough_tensors_unit(c, E);
  for (int k = 0; k < 2; k++) amount[k] = r->t.share[c] / r->t.share[0] * r->L * E[k ? Z : X][Z];
  return r->reach > 0 ? carried(r, 2, test, amount, sign, x) : 0;
}

/* -(E_c z) . df0/dC: difference of f0 of a partner ahead in a flow of gradient E. */
static void partner_ahead(const response *r, double E[3][3], double *x)
{
  memset(x, 0, (size_t)r->f.n * sizeof *x);
  for (int i = 0; i < 3; i++)
    if (E[i][Z] != 0) slope(r, i, -E[i][Z], r->f0, x);
}

static gg_status shear(response *r, double fading, gg_rough_viscosity *v, gg_error *err)
{
  double E[3][3], carried = 0;
  for (int c = 0; c < r->t.components; c++) {
    gg_rough_tensors_unit(c, E);
    memset(r->x, 0, (size_t)r->f.n * sizeof *r->x);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        if (E[i][j] == 0) continue;
        memset(r->y, 0, (size_t)r->f.n * sizeof *r->y);
        slope(r, i, E[i][j], r->f0, r->y);
        times(r, j, 1, r->y, r->x);
      }
    test(r, c, 1, r->x, r->rows[0]);
    partner_ahead(r, E, r->x);
    if (r->reach > 0) GG_TRY(add_collisions(r, c, r->reach, r->x, r->rows[0], err));
    carried += r->reach / 2 * momentum_carried(r, c, -1, r->x);
  }
  GG_TRY(solve(r, fading * r->s->stream.velocity[0][0], r->rows[0], err));
  for (int c = 0; c < r->t.components; c++) {
    expand(r, c, r->rows[0], r->x);
    carried += momentum_carried(r, c, 1, r->x);
  }
  v->kinetic =
      -r->L * r->L * M_SQRT1_2 * r->x[gg_rough_place(&r->f, (int[GG_ROUGH_AXES]){1, 1})]; /* xy is the last component */
  v->total = v->kinetic - carried / 2;
  return GG_OK;
}

gg_status gg_rough_viscosity_of(const gg_rough_steady *state, double phi_chi, double fading, gg_rough_viscosity *v,
                                gg_error *err)
{
  response r;
  gg_base_gsl_enter();
  gg_status status = make(&r, state, 2, phi_chi, err);
  if (status == GG_OK) status = shear(&r, fading, v, err);
  gg_base_gsl_leave();
  clear(&r);
  return status;
}
