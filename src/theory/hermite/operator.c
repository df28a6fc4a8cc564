/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/operator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "simd/clones.h"
#include "theory/hermite/direction_workspace.h"

/* Points of the rule in k_z on (0, 1), and in azimuth on (0, pi): by symmetry a quarter of the sphere is enough. */
enum { POLAR = 5, AZIMUTH = 16, N1 = GG_HERMITE_MOST_DEGREE + 1 };

static gg_hermite_workspace *make_workspace(const gg_hermite_operator *op)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_flux *f = &op->flux;
  int N = b->degree, box = (N + 1) * (N + 1), wide = gg_padded(b->n, GG_PRODUCT_COLUMNS);
  int pairs = gg_hermite_partner_rows(N), tall = b->n_rotated + GG_PRODUCT_ROWS;
  gg_hermite_workspace *r = calloc(1, sizeof *r);
  if (!r) return NULL;
  *r = (gg_hermite_workspace){.wide = wide, .pairs = pairs, .box = box};
  double **const part[] = {&r->q, &r->K, &r->E, &r->X, &r->V, &r->VX, &r->S, &r->back, &r->work};
  const int size[] = {b->n_rotated,
                      box * pairs,
                      box * wide,
                      tall * wide,
                      f->n_u * (N + 1) * pairs,
                      pairs * f->width_X,
                      tall * (N / 2 + 1),
                      b->n * (N / 2 + 1),
                      (int)gg_hermite_rotation_scratch(N)};
  enum { PARTS = sizeof size / sizeof *size };
  size_t total = 0;
  for (int i = 0; i < PARTS; i++) total += (size_t)size[i];
  double *at = calloc(total, sizeof *at);
  for (int i = 0; i < PARTS && at; at += size[i++]) *part[i] = at;
  if (at) return r;
  free(r);
  return NULL;
}

static bool make_view(const gg_hermite_operator *op, gg_hermite_view *v)
{
  const gg_hermite_workspace *r = op->workspace;
  int n = op->basis.n_rotated;
  v->D = calloc((size_t)(n * r->wide + n + (op->basis.degree + 1) * r->box), sizeof *v->D);
  if (!v->D) return false;
  v->t = v->D + n * r->wide;
  v->damped = v->t + n;
  return true;
}

gg_status gg_hermite_operator_hold(gg_hermite_operator *op, int n_species, gg_error *err)
{
  for (; op->workspace->n_views < n_species; op->workspace->n_views++)
    if (!make_view(op, &op->workspace->view[op->workspace->n_views])) return gg_base_out_of_memory(err);
  return GG_OK;
}

static gg_status make_directions(gg_hermite_operator *op, bool isotropic, gg_error *err)
{
  double z[2 * POLAR], w[2 * POLAR]; /* of (-1, 1), where everything is even, the upper half */
  op->n_directions = isotropic ? 1 : POLAR * AZIMUTH;
  op->direction = calloc((size_t)op->n_directions, sizeof *op->direction);
  op->weight = calloc((size_t)op->n_directions, sizeof *op->weight);
  if (!op->direction || !op->weight) return gg_base_out_of_memory(err);
  op->direction[0][2] = 1, op->weight[0] = 4 * M_PI;
  GG_TRY(gg_hermite_legendre_rule(2 * POLAR, z, w, err));
  for (int n = 0; n < op->n_directions && !isotropic; n++) {
    int i = POLAR + n / AZIMUTH;
    double angle = M_PI * (n % AZIMUTH + 0.5) / AZIMUTH, *k = op->direction[n];
    k[2] = 2 * z[i] - 1;
    double s = sqrt(1 - k[2] * k[2]);
    k[0] = s * cos(angle), k[1] = s * sin(angle);
    op->weight[n] = 8 * w[i] * M_PI / AZIMUTH;
  }
  return GG_OK;
}

static gg_status make_overlap(gg_hermite_operator *op, int degree, gg_error *err)
{
  gg_hermite_overlap overlap;
  op->overlap = malloc((size_t)((degree + 3) * (degree + 1)) * sizeof *op->overlap);
  if (!op->overlap) return gg_base_out_of_memory(err);
  GG_TRY(gg_hermite_overlap_make(&overlap, degree + 3, degree + 1, op->decay, err));
  gg_hermite_overlap_at(&overlap, 0, op->overlap);
  gg_hermite_overlap_clear(&overlap);
  return GG_OK;
}

gg_status gg_hermite_operator_make(gg_hermite_operator *op, int degree, double decay, bool isotropic, gg_error *err)
{
  *op = (gg_hermite_operator){.decay = decay};
  gg_status status = gg_hermite_basis_make(&op->basis, degree, err);
  if (status == GG_OK) status = gg_hermite_flux_make(&op->flux, degree, degree + 1, decay, err);
  if (status == GG_OK) status = gg_hermite_flux_make(&op->low, degree, 3, 0, err);
  if (status == GG_OK) status = make_overlap(op, degree, err);
  if (status == GG_OK) status = make_directions(op, isotropic, err);
  if (status == GG_OK && !(op->workspace = make_workspace(op))) status = gg_base_out_of_memory(err);
  if (status == GG_OK) status = gg_hermite_operator_hold(op, 1, err);
  if (status != GG_OK) gg_hermite_operator_clear(op);
  return status;
}

void gg_hermite_operator_clear(gg_hermite_operator *op)
{
  gg_hermite_basis_clear(&op->basis);
  gg_hermite_flux_clear(&op->flux);
  gg_hermite_flux_clear(&op->low);
  free(op->overlap);
  free(op->direction);
  free(op->weight);
  for (int i = 0; op->workspace && i < op->workspace->n_views; i++) free(op->workspace->view[i].D);
  if (op->workspace) free(op->workspace->q);
  free(op->workspace);
  *op = (gg_hermite_operator){0};
}

/* The coefficients in the rotated frame, t_q = sum_s D_qs a_s. */
static void rotate_to_frame(const gg_hermite_operator *op, gg_hermite_state *state, const double k[3],
                            gg_hermite_view *v)
{
  const gg_hermite_basis *b = &op->basis;
  v->frame = gg_hermite_frame_at(state->L, k);
  gg_hermite_rotation(b, v->frame.axis, op->workspace->wide, v->D, op->workspace->work);
  for (int q = 0; q < b->n_rotated; q++) {
    const double *row = v->D + (size_t)q * (size_t)op->workspace->wide;
    double sum = 0;
    int degree = gg_hermite_degree(b->rotated[q]);
    for (int s = b->from[degree]; s < b->from[degree + 1]; s++) sum += row[s] * state->a[s];
    v->t[q] = sum;
  }
  for (int l = 0; l <= b->degree / 2; l++) v->marginal[l] = v->t[gg_hermite_rotated_place(b, 2 * l, 0, 0)];
}

void gg_hermite_set_views(gg_hermite_operator *op, int n_species, gg_hermite_state *state, const double k[3])
{
  for (int i = 0; i < n_species; i++) rotate_to_frame(op, &state[i], k, &op->workspace->view[i]);
}

/* sum_q Z_Qq t_jpq, by Q and (j,p) */
static void damp(const gg_hermite_operator *op, gg_hermite_view *v)
{
  const gg_hermite_workspace *r = op->workspace;
  const gg_hermite_flux *f = &op->flux;
  int N = op->basis.degree;
  memset(v->damped, 0, (size_t)((N + 1) * r->box) * sizeof *v->damped);
  for (int i = 0; i < op->basis.n_rotated; i++) {
    const int *q = op->basis.rotated[i].r;
    for (int Q = q[2] % 2; Q <= N; Q += 2)
      v->damped[Q * r->box + q[0] * (N + 1) + q[1]] += f->Z[Q * f->trials + q[2]] * v->t[i];
  }
}

/* A rotated test (J,P,Q): sum over trials (j,p) of W. */
static double apply(const gg_hermite_operator *op, const gg_hermite_view *v, const int test[3])
{
  int N = op->basis.degree;
  double sum = 0;
  if (test[0] + test[1] + test[2] <= 2) {
    for (int j = 0; j <= N - test[2]; j++)
      for (int p = (j + test[2]) % 2; p <= N - test[2] - j; p += 2)
        sum +=
            gg_hermite_W(&op->low, test[0], test[1], j, p) * v->t[gg_hermite_rotated_place(&op->basis, j, p, test[2])];
    return sum;
  }
  const double *t = v->damped + test[2] * op->workspace->box;
  for (int j = 0; j <= N; j++)
    for (int p = (j + test[2]) % 2; p <= N - j; p += 2)
      sum += gg_hermite_W(&op->flux, test[0], test[1], j, p) * t[j * (N + 1) + p];
  return sum;
}

GG_CLONES static void add_scaled(int n, double factor, const double *restrict from, double *restrict to)
{
  for (int s = 0; s < n; s++) to[s] += factor * from[s];
}

/* Back from the rotated frame: R_r = sum_q D_qr q_q, and the same of the derivatives. */
static void rotate_back(const gg_hermite_operator *op, const gg_hermite_view *v, double w, double *R, double *jacobian,
                        size_t stride)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_workspace *r = op->workspace;
  for (int q = 0; q < b->n_rotated; q++) {
    const double *D = v->D + (size_t)q * (size_t)r->wide, *X = r->X + (size_t)q * (size_t)r->wide;
    int degree = gg_hermite_degree(b->rotated[q]);
    for (int i = b->from[degree]; i < b->from[degree + 1]; i++) {
      R[i] += w * D[i] * r->q[q];
      if (jacobian) add_scaled(b->n, w * D[i], X, jacobian + (size_t)i * stride);
    }
  }
}

/* Contribution of one direction to one species, by partners of every species. */
static void add_species(gg_hermite_operator *op, const gg_hermite_gas *gas, int i, int direction, double *R,
                        double *jacobian, size_t stride)
{
  gg_hermite_view *own = &op->workspace->view[i];
  double w = op->weight[direction];
  gg_hermite_flux_begin(&op->flux);
  gg_hermite_flux_begin(&op->low);
  for (int j = 0; j < gas->n_species; j++) {
    const gg_hermite_view *partner = &op->workspace->view[j];
    gg_hermite_contact c =
        gg_hermite_contact_of(&gas->impact[i][j], &own->frame, &partner->frame, op->direction[direction]);
    gg_hermite_flux_add(&op->flux, &c, partner->marginal, jacobian != NULL);
    gg_hermite_flux_add(&op->low, &c, partner->marginal, jacobian != NULL);
    if (jacobian) gg_hermite_differentiate_partner(op, own, partner, w, jacobian + j * op->basis.n, stride);
  }
  for (int q = 0; q < op->basis.n_rotated; q++) op->workspace->q[q] = apply(op, own, op->basis.rotated[q].r);
  if (jacobian) gg_hermite_differentiate_own(op, own);
  rotate_back(op, own, w, R, jacobian ? jacobian + i * op->basis.n : NULL, stride);
}

bool gg_hermite_operator_at(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state, double *R,
                            double *jacobian)
{
  size_t n = (size_t)op->basis.n, all = n * (size_t)gas->n_species;
  memset(R, 0, all * sizeof *R);
  if (jacobian) memset(jacobian, 0, all * all * sizeof *jacobian);
  for (int k = 0; k < op->n_directions; k++) {
    if (gg_stop_asked(gas->stop)) return false;
    gg_hermite_set_views(op, gas->n_species, state, op->direction[k]);
    for (int i = 0; i < gas->n_species; i++) damp(op, &op->workspace->view[i]);
    for (size_t i = 0; i < (size_t)gas->n_species; i++)
      add_species(op, gas, (int)i, k, R + i * n, jacobian ? jacobian + i * n * all : NULL, all);
  }
  for (size_t i = 0; i < (size_t)gas->n_species; i++)
    gg_hermite_add_streaming(op, gas, (int)i, &state[i], R + i * n, jacobian ? jacobian + i * n * (all + 1) : NULL,
                             all);
  return true;
}
