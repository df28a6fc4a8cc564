#include "theory/hermite/operator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "theory/hermite/contact.h"
#include "theory/hermite/room.h"

/* Points of the rule in k_z on (0, 1), and in azimuth on (0, pi): a quarter of the sphere stands for the whole. */
enum { POLAR = 5, AZIMUTH = 16, N1 = GG_HERMITE_MOST_DEGREE + 1 };

static gg_hermite_room *make_room(const gg_hermite_operator *op)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_flux *f = &op->flux;
  int N = b->degree, box = (N + 1) * (N + 1), wide = gg_padded(b->n, GG_PRODUCT_COLUMNS);
  int pairs = gg_padded((N + 1) * (N + 2) / 2, GG_PRODUCT_ROWS), tall = b->n_rotated + GG_PRODUCT_ROWS;
  gg_hermite_room *r = calloc(1, sizeof *r);
  if (!r) return NULL;
  *r = (gg_hermite_room){.wide = wide, .pairs = pairs, .box = box};
  double **const part[] = {&r->D, &r->t, &r->damped, &r->q, &r->K, &r->E, &r->X, &r->V, &r->VX, &r->S, &r->work};
  const int size[] = {b->n_rotated * wide,
                      b->n_rotated,
                      (N + 1) * box,
                      b->n_rotated,
                      box * pairs,
                      box * wide,
                      tall * wide,
                      f->n_u * (N + 1) * pairs,
                      pairs * f->width_X,
                      tall * (N / 2 + 1),
                      (int)gg_hermite_rotation_room(N)};
  enum { PARTS = sizeof size / sizeof *size };
  size_t total = 0;
  for (int i = 0; i < PARTS; i++) total += (size_t)size[i];
  double *at = calloc(total, sizeof *at);
  for (int i = 0; i < PARTS && at; at += size[i++]) *part[i] = at;
  if (at) return r;
  free(r);
  return NULL;
}

static gg_status make_directions(gg_hermite_operator *op, bool isotropic, gg_error *err)
{
  double z[2 * POLAR], w[2 * POLAR]; /* of (-1, 1), where everything is even, the upper half */
  op->n_directions = isotropic ? 1 : POLAR * AZIMUTH;
  op->direction = calloc((size_t)op->n_directions, sizeof *op->direction);
  op->weight = calloc((size_t)op->n_directions, sizeof *op->weight);
  if (!op->direction || !op->weight) return gg_fail(err, GG_FAILED, "out of memory");
  op->direction[0][2] = 1, op->weight[0] = 4 * M_PI;
  GG_TRY(gg_legendre_rule(2 * POLAR, z, w, err));
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
  if (!op->overlap) return gg_fail(err, GG_FAILED, "out of memory");
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
  if (status == GG_OK && !(op->room = make_room(op))) status = gg_fail(err, GG_FAILED, "out of memory");
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
  if (op->room) free(op->room->D);
  free(op->room);
  *op = (gg_hermite_operator){0};
}

/* The coefficients in the rotated frame, t_q = sum_s D_qs a_s. */
static void rotate(const gg_hermite_operator *op, double axis[3][3], const double *a)
{
  const gg_hermite_room *r = op->room;
  gg_hermite_rotation(&op->basis, axis, r->wide, r->D, r->work);
  for (int q = 0; q < op->basis.n_rotated; q++) {
    const double *row = r->D + (size_t)q * (size_t)r->wide;
    double sum = 0;
    for (int s = 0; s < op->basis.n; s++) sum += row[s] * a[s];
    r->t[q] = sum;
  }
}

/* t_(2l,0,0): the distribution of normal velocities. */
static void marginal_of(const gg_hermite_operator *op, double *marginal)
{
  for (int l = 0; l <= op->basis.degree / 2; l++)
    marginal[l] = op->room->t[gg_hermite_rotated_place(&op->basis, 2 * l, 0, 0)];
}

double gg_hermite_marginal(gg_hermite_operator *op, double L[3][3], const double *a, const double k[3],
                           double *marginal)
{
  double axis[3][3];
  gg_hermite_contact contact = gg_hermite_contact_at(1, 0, L, k, axis);
  rotate(op, axis, a);
  marginal_of(op, marginal);
  return contact.s;
}

/* sum_q Z_Qq t_jpq, by Q and (j,p) */
static void damp(const gg_hermite_operator *op)
{
  const gg_hermite_room *r = op->room;
  const gg_hermite_flux *f = &op->flux;
  int N = op->basis.degree;
  memset(r->damped, 0, (size_t)((N + 1) * r->box) * sizeof *r->damped);
  for (int i = 0; i < op->basis.n_rotated; i++) {
    const int *q = op->basis.rotated[i].r;
    for (int Q = q[2] % 2; Q <= N; Q += 2)
      r->damped[Q * r->box + q[0] * (N + 1) + q[1]] += f->Z[Q * f->trials + q[2]] * r->t[i];
  }
}

/* A rotated test (J,P,Q): sum over trials (j,p) of W. */
static double apply(const gg_hermite_operator *op, const int test[3])
{
  const gg_hermite_room *r = op->room;
  int N = op->basis.degree;
  double sum = 0;
  if (test[0] + test[1] + test[2] <= 2) {
    for (int j = 0; j <= N - test[2]; j++)
      for (int p = (j + test[2]) % 2; p <= N - test[2] - j; p += 2)
        sum +=
            gg_hermite_W(&op->low, test[0], test[1], j, p) * r->t[gg_hermite_rotated_place(&op->basis, j, p, test[2])];
    return sum;
  }
  const double *t = r->damped + test[2] * r->box;
  for (int j = 0; j <= N; j++)
    for (int p = (j + test[2]) % 2; p <= N - j; p += 2)
      sum += gg_hermite_W(&op->flux, test[0], test[1], j, p) * t[j * (N + 1) + p];
  return sum;
}

/* Back from the rotated frame: R_r = sum_q D_qr q_q, and the same of the derivatives. */
static void rotate_back(const gg_hermite_operator *op, double w, double *R, double *jacobian)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_room *r = op->room;
  for (int q = 0; q < b->n_rotated; q++) {
    const double *D = r->D + (size_t)q * (size_t)r->wide, *X = r->X + (size_t)q * (size_t)r->wide;
    for (int i = 0; i < b->n; i++) {
      R[i] += w * D[i] * r->q[q];
      if (!jacobian || D[i] == 0) continue; /* another degree */
      double d = w * D[i], *restrict row = jacobian + (size_t)i * (size_t)b->n;
      for (int s = 0; s < b->n; s++) row[s] += d * X[s];
    }
  }
}

static void add_direction(gg_hermite_operator *op, const gg_hermite_gas *gas, double L[3][3], const double *a,
                          int direction, double *R, double *jacobian)
{
  double axis[3][3], marginal[N1];
  gg_hermite_contact contact = gg_hermite_contact_at(gas->eta, gas->shear, L, op->direction[direction], axis);
  rotate(op, axis, a);
  marginal_of(op, marginal);
  gg_hermite_flux_at(&op->flux, &contact, marginal, jacobian != NULL);
  gg_hermite_flux_at(&op->low, &contact, marginal, jacobian != NULL);
  damp(op);
  for (int i = 0; i < op->basis.n_rotated; i++) op->room->q[i] = apply(op, op->basis.rotated[i].r);
  if (jacobian) gg_hermite_differentiate(op);
  rotate_back(op, gas->frequency * op->weight[direction], R, jacobian);
}

void gg_hermite_operator_at(gg_hermite_operator *op, const gg_hermite_gas *gas, double L[3][3], const double *a,
                            double *R, double *jacobian)
{
  size_t n = (size_t)op->basis.n;
  memset(R, 0, n * sizeof *R);
  if (jacobian) memset(jacobian, 0, n * n * sizeof *jacobian);
  for (int k = 0; k < op->n_directions; k++) add_direction(op, gas, L, a, k, R, jacobian);
  gg_hermite_add_streaming(op, gas, L, a, R, jacobian);
}
