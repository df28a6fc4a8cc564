/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/rough_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "theory/hermite/contact_integral.h"
#include "theory/hermite/overlap.h"

enum { N1 = GG_ROUGH_MOST_DEGREE + 1 };

typedef struct gg_target {
  const gg_rough_form *form;
  const gg_rough_functions *f;
  const double *a;
  int r;
  double *R, *jacobian;
} gg_target;

/* R_r += amount a_s, s by its indices. */
static void add(const gg_target *t, const int index[GG_ROUGH_AXES], double amount)
{
  if (amount == 0) return;
  int place = gg_rough_place(t->f, index), s = place < 0 ? -1 : t->form->unknown[place];
  if (s < 0) return;
  t->R[t->r] += amount * t->a[s];
  if (t->jacobian) t->jacobian[(size_t)t->r * (size_t)t->form->n + (size_t)s] += amount;
}

/* amount < x_j d_i Ho_r >: d_i Ho_r = sqrt(r_i) Ho_(r-e_i), x_j Ho_r = sqrt(r_j + 1) Ho_(r+e_j) + sqrt(r_j) Ho_(r-e_j)
 */
static void add_flow(const gg_target *t, int i, int j, double amount)
{
  gg_rough_index index = t->f->function[t->form->test[t->r]];
  amount *= sqrt(index.r[i]);
  if (amount == 0) return;
  index.r[i]--;
  int quanta = index.r[j];
  index.r[j] = quanta + 1;
  add(t, index.r, amount * sqrt(quanta + 1));
  index.r[j] = quanta - 1;
  if (quanta > 0) add(t, index.r, amount * sqrt(quanta));
}

/* amount < d_i d_j Ho_r > */
static void add_diffusion(const gg_target *t, int i, int j, double amount)
{
  gg_rough_index index = t->f->function[t->form->test[t->r]];
  amount *= sqrt(index.r[i]);
  index.r[i]--;
  if (index.r[i] < 0 || index.r[j] < 1) return;
  amount *= sqrt(index.r[j]);
  index.r[j]--;
  add(t, index.r, amount);
}

/* amount < d_i Ho_r > */
static void add_drift(const gg_target *t, int i, double amount)
{
  gg_rough_index index = t->f->function[t->form->test[t->r]];
  amount *= sqrt(index.r[i]);
  if (index.r[i]-- > 0) add(t, index.r, amount);
}

static double product(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void gg_rough_stream_add(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                         const gg_rough_stream *stream, const double *a, double *R, double *jacobian)
{
  double AL[3][3], L[3][3], B[3][3], one[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, inverse[3][3], S[3][3],
                                     turned[3][3];
  memcpy(L, w->L, sizeof L);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      AL[i][j] = 0;
      for (int k = 0; k < 3; k++) AL[i][j] += stream->velocity[i][k] * L[k][j];
    }
  gg_hermite_left_divide(L, AL, B);
  gg_hermite_left_divide(L, one, inverse); /* d/dC_a = sum_i inverse_ia d_i */
  memcpy(S, w->S, sizeof S);
  gg_hermite_left_divide(S, one, turned);
  size_t many = (size_t)form->n_tests, n = (size_t)form->n;
  double *all = calloc(many * (n + 1), sizeof *all), *slopes = all ? all + many : NULL;
  if (!all) {
    R[1] = NAN; /* so that no iteration converges */
    return;
  }
  for (int r = 1; r < form->n_tests; r++) {
    gg_target t = {form, f, a, r, all, jacobian ? slopes : NULL};
    for (int i = 0; i < 3; i++) {
      add_flow(&t, 3 + i, 3 + i, -stream->spin);
      add_drift(&t, 3 + i, -stream->spin * (w->spin - stream->rolling) * turned[i][2]);
      for (int j = 0; j < 3; j++) {
        double G = product(inverse[i], inverse[j]);
        add_flow(&t, i, j, -B[i][j]);
        add_diffusion(&t, i, j, stream->diffusion * G);
        add_diffusion(&t, 3 + i, 3 + j, stream->spin_diffusion * product(turned[i], turned[j]));
      }
    }
  }
  gg_rough_test(form, all, R);
  for (int r = 0; r < form->n && jacobian; r++)
    for (int p = form->from[r]; p < form->from[r + 1]; p++) {
      const double *slope = slopes + (size_t)form->part[p].test * n;
      for (size_t x = 0; x < n; x++) jacobian[(size_t)r * n + x] += form->part[p].amount * slope[x];
    }
  free(all);
}

/* < Ho_k(n.x) > = sum over |r| = k of sqrt(k!/r!) n^r a_r, for a unit vector n. */
static void marginal(const gg_rough_form *form, const gg_rough_functions *f, const double *a, bool spin,
                     const double n[3], double *h)
{
  memset(h, 0, N1 * sizeof *h);
  for (int v = 0; v < f->n3; v++) {
    const int *x = f->three[v];
    gg_rough_index index = {{0}};
    int k = x[0] + x[1] + x[2];
    double amount = sqrt(tgamma(k + 1.));
    for (int i = 0; i < 3; i++) {
      index.r[i + (spin ? 3 : 0)] = x[i];
      amount *= pow(n[i], x[i]) / sqrt(tgamma(x[i] + 1.));
    }
    int q = form->unknown[gg_rough_place(f, index.r)];
    if (q >= 0) h[k] += amount * a[q];
  }
}

/* Row of L or S: its length, and its direction. */
static double row_of(const gg_rough_weight *w, bool spin, int axis, double n[3])
{
  double length = 0;
  for (int i = 0; i < 3; i++) {
    n[i] = spin ? w->S[axis][i] : w->L[axis][i];
    length += n[i] * n[i];
  }
  length = sqrt(length);
  for (int i = 0; i < 3; i++) n[i] /= length;
  return length;
}

void gg_rough_marginal(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                       const double *a, bool spin, int axis, double *h)
{
  double n[3];
  row_of(w, spin, axis, n);
  marginal(form, f, a, spin, n, h);
}

void gg_rough_moments(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w, const double *a,
                      bool spin, int axis, double moment[5])
{
  double n[3], h[N1], s = row_of(w, spin, axis, n), m = spin && axis == 2 ? w->spin : 0, x[5];
  marginal(form, f, a, spin, n, h);
  x[0] = 1, x[1] = h[1], x[2] = 1 + sqrt(2) * h[2];
  x[3] = sqrt(6) * h[3] + 3 * h[1];
  x[4] = sqrt(24) * h[4] + 6 * sqrt(2) * h[2] + 3;
  static const int choose[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
  for (int j = 0; j < 5; j++) {
    moment[j] = 0;
    for (int i = 0; i <= j; i++) moment[j] += choose[j][i] * pow(s, i) * x[i] * pow(m, j - i);
  }
}

double gg_rough_mean_spin(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                          const double *a)
{
  double moment[5];
  gg_rough_moments(form, f, w, a, true, 2, moment);
  return moment[1];
}

void gg_rough_covariance(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                         const double *a, bool spin, double M[3][3])
{
  double c[3][3], mean = spin ? gg_rough_mean_spin(form, f, w, a) - w->spin : 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      gg_rough_index index = {{0}};
      index.r[i + (spin ? 3 : 0)]++, index.r[j + (spin ? 3 : 0)]++;
      int q = form->unknown[gg_rough_place(f, index.r)];
      double value = q < 0 ? 0 : a[q];
      c[i][j] = i == j ? 1 + M_SQRT2 * value : value;
    }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      M[i][j] = i == 2 && j == 2 ? -mean * mean : 0;
      for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) M[i][j] += (spin ? w->S[i][k] * w->S[j][l] : w->L[i][k] * w->L[j][l]) * c[k][l];
    }
}

/* Coefficient of the function with these quanta, from axes of velocity (0 to 2) and spin (3 to 5); -1: no axis. */
static double coefficient(const gg_rough_form *form, const gg_rough_functions *f, const double *a, int i, int j, int k,
                          int l)
{
  const int axis[] = {i, j, k, l};
  gg_rough_index index = {{0}};
  for (int x = 0; x < 4; x++)
    if (axis[x] >= 0) index.r[axis[x]]++;
  const int place = gg_rough_place(f, index.r), q = place < 0 ? -1 : form->unknown[place];
  return q < 0 ? 0 : a[q];
}

/* <c_i c_j o_k o_l> of reduced velocities and spins: x^2 = 1 + sqrt2 Ho_2(x). */
static double fourth(const gg_rough_form *form, const gg_rough_functions *f, const double *a, int i, int j, int k,
                     int l)
{
  const double two = i == j ? M_SQRT2 : 1, other = k == l ? M_SQRT2 : 1;
  double sum = two * other * coefficient(form, f, a, i, j, 3 + k, 3 + l);
  if (i == j) sum += other * coefficient(form, f, a, 3 + k, 3 + l, -1, -1);
  if (k == l) sum += two * coefficient(form, f, a, i, j, -1, -1);
  return sum + (i == j && k == l);
}

/* <c_i c_j o_k> */
static double third(const gg_rough_form *form, const gg_rough_functions *f, const double *a, int i, int j, int k)
{
  const double sum = (i == j ? M_SQRT2 : 1) * coefficient(form, f, a, i, j, 3 + k, -1);
  return sum + (i == j ? coefficient(form, f, a, 3 + k, -1, -1, -1) : 0);
}

/* <C_x C_y W_v W_w>: axes by the rows of L and S, the spin less its mean, which is `mean` along z from the weight's. */
static double product_mean(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                           const double *a, double mean, const int x[4])
{
  double sum = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double C = w->L[x[0]][i] * w->L[x[1]][j], second = coefficient(form, f, a, i, j, -1, -1);
      const double CC = i == j ? 1 + M_SQRT2 * second : second;
      for (int k = 0; k < 3 && C != 0; k++) {
        const double shift = (x[3] == 2 ? w->S[x[2]][k] : 0) + (x[2] == 2 ? w->S[x[3]][k] : 0);
        if (mean != 0) sum -= C * mean * shift * third(form, f, a, i, j, k);
        for (int l = 0; l < 3; l++) {
          const double S = w->S[x[2]][k] * w->S[x[3]][l];
          if (S != 0) sum += C * S * fourth(form, f, a, i, j, k, l);
        }
      }
      if (x[2] == 2 && x[3] == 2) sum += C * mean * mean * CC;
    }
  return sum;
}

gg_rough_correlation gg_rough_correlations(const gg_rough_form *form, const gg_rough_functions *f,
                                           const gg_rough_weight *w, const double *a)
{
  double M[3][3], Theta[3][3], CC = 0, WW = 0, products = 0, dots = 0;
  const double mean = gg_rough_mean_spin(form, f, w, a) - w->spin;
  gg_rough_covariance(form, f, w, a, false, M);
  gg_rough_covariance(form, f, w, a, true, Theta);
  for (int x = 0; x < 3; x++) {
    CC += M[x][x], WW += Theta[x][x];
    for (int y = 0; y < 3; y++) {
      products += product_mean(form, f, w, a, mean, (int[4]){x, x, y, y});
      dots += product_mean(form, f, w, a, mean, (int[4]){x, y, x, y});
    }
  }
  return (gg_rough_correlation){products / (CC * WW) - 1, dots / (CC * WW) - 1. / 3};
}

/* <|x|> under exp(-x^2/2)/sqrt(2 pi) sum_l h_2l Ho_2l: <|x| Ho_2l> = sqrt(2/pi) (-1)^(l+1) (2l-3)!!/sqrt((2l)!). */
static double mean_modulus(int degree, const double *h)
{
  double sum = 1, term = 1;
  for (int l = 1; l <= degree / 2; l++) {
    if (l > 1) term *= -(2 * l - 3);
    term /= sqrt(2. * l * (2 * l - 1));
    sum += term * h[2 * l];
  }
  return sqrt(2 / M_PI) * sum;
}

/* |C| = int dn |n.C|/(2 pi), over a quarter of the sphere. */
double gg_rough_mean_speed(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                           const double *a)
{
  enum { POLAR = 12, AZIMUTH = 16 };
  double z[POLAR], wz[POLAR], sum = 0;
  gg_error ignored;
  if (gg_hermite_legendre_rule(POLAR, z, wz, &ignored) != GG_OK) return NAN;
  for (int p = 0; p < POLAR * AZIMUTH; p++) {
    int i = p / AZIMUTH;
    double angle = M_PI * (p % AZIMUTH + 0.5) / AZIMUTH, r = sqrt(1 - z[i] * z[i]), n[3], h[N1], length = 0;
    double k[3] = {r * cos(angle), r * sin(angle), z[i]};
    for (int x = 0; x < 3; x++) {
      n[x] = w->L[0][x] * k[0] + w->L[1][x] * k[1] + w->L[2][x] * k[2];
      length += n[x] * n[x];
    }
    length = sqrt(length);
    for (int x = 0; x < 3; x++) n[x] /= length;
    marginal(form, f, a, false, n, h);
    sum += 2 * wz[i] / AZIMUTH * length * mean_modulus(f->degree, h);
  }
  return sum;
}
