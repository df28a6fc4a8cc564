/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integrals over velocities, at fixed direction k, are those of a Gaussian vector z = (g, C_1, s_1) with mean m
 * and covariance S, weighted by the normal velocity u = k.g > 0, u ~ N(mu, v). With the regression on u, R = S
 * k_g/v, B = m - R mu, C = S - v R R^T, and I_p = int_0^inf u^p N(u; mu, v) du:
 *   <u+ z> = I_1 B + I_2 R,   <u+ z z^T> = I_1 (B B^T + C) + I_2 (B R^T + R B^T) + I_3 R R^T
 * One quadrature over the sphere remains. After J.T. Jenkins & M.W. Richman, J. Fluid Mech. 192 (1988) 313 and S.
 * Saha & M. Alam, J. Fluid Mech. 795 (2016) 549, without their expansions. */
#include "theory/gaussian_moments.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "common/vec.h"

/* Everything is even under k -> -k and under reflection at the shear plane: a quarter of the sphere is enough. */
enum { POLAR = 24, AZIMUTH = 16 };

/* A pair of species: grain 1 of species i, grain 2 of species j. */
typedef struct pair {
  const gg_gaussian *one, *two;
  const gg_contact *contact;
  double shear;          /* sigma * shear rate; 0 in the Boltzmann limit */
  double frequency;      /* n_j sigma^2 chi */
  double loss_n, loss_t; /* energy lost over g_n^2 and g_t^2 */
} pair;

/* Part of z, say a: <u+ a> and <u+ a b^T> follow from B_a, R_a and the covariance of a and b. */
typedef struct part {
  gg_vec B, R;
} part;

/* Moments of the impulse J and of its torque k x J at one k, weighted with u+. The torque is kept separately: the
 * normal impulse, much the larger one for weakly rough grains, does not contribute to it. */
typedef struct impulse {
  double u;            /* <u+>, the flux itself */
  double loss;         /* <u+ loss> */
  gg_vec J, kJ;        /* <u+ J>, <u+ k x J> */
  gg_tensor JC, JJ;    /* <u+ J C_1^T>, <u+ J J^T> */
  gg_tensor kJs, kJkJ; /* <u+ (k x J) s_1^T>, <u+ (k x J)(k x J)^T> */
} impulse;

static gg_vec times(gg_tensor A, gg_vec b)
{
  return (gg_vec){A.at[0][0] * b.x + A.at[0][1] * b.y + A.at[0][2] * b.z,
                  A.at[1][0] * b.x + A.at[1][1] * b.y + A.at[1][2] * b.z,
                  A.at[2][0] * b.x + A.at[2][1] * b.y + A.at[2][2] * b.z};
}

static gg_tensor product(gg_tensor A, gg_tensor B)
{
  gg_tensor C;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      C.at[i][j] = A.at[i][0] * B.at[0][j] + A.at[i][1] * B.at[1][j] + A.at[i][2] * B.at[2][j];
  return C;
}

/* A + f B */
static gg_tensor plus(gg_tensor A, double f, gg_tensor B)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) A.at[i][j] += f * B.at[i][j];
  return A;
}

static gg_tensor scaled(double f, gg_tensor A)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) A.at[i][j] *= f;
  return A;
}

static gg_tensor transposed(gg_tensor A)
{
  gg_tensor B;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) B.at[i][j] = A.at[j][i];
  return B;
}

static gg_tensor outer(gg_vec a, gg_vec b)
{
  return (gg_tensor){
      {{a.x * b.x, a.x * b.y, a.x * b.z}, {a.y * b.x, a.y * b.y, a.y * b.z}, {a.z * b.x, a.z * b.y, a.z * b.z}}};
}

/* X w = k x w */
static gg_tensor cross_tensor(gg_vec k)
{
  return (gg_tensor){{{0, -k.z, k.y}, {k.z, 0, -k.x}, {-k.y, k.x, 0}}};
}

double gg_theory_trace(gg_tensor A)
{
  return A.at[0][0] + A.at[1][1] + A.at[2][2];
}

/* I_1 .. I_3 by recursion, I_p+1 = mu I_p + p v I_p-1. */
static void flux_integrals(double mu, double v, double I[4])
{
  I[0] = 0.5 * erfc(-mu / sqrt(2 * v));
  I[1] = mu * I[0] + sqrt(v / (2 * M_PI)) * exp(-mu * mu / (2 * v));
  I[2] = mu * I[1] + v * I[0];
  I[3] = mu * I[2] + 2 * v * I[1];
}

/* <u+ a b^T> */
static gg_tensor moment(const double I[4], double v, part a, part b, gg_tensor covariance)
{
  gg_tensor out = scaled(I[1], plus(outer(a.B, b.B), 1, covariance));
  out = plus(out, I[2], plus(outer(a.B, b.R), 1, outer(a.R, b.B)));
  return plus(out, I[3] - v * I[1], outer(a.R, b.R));
}

/* Mean of g: -sigma rate k_y x - k x (s_1 + s_2). */
static gg_vec mean_contact_velocity(const pair *p, gg_vec k)
{
  gg_vec mean = {-p->shear * k.y, 0, 0}, spin = {0, 0, p->one->spin + p->two->spin};
  return p->contact->jt > 0 ? gg_sub(mean, gg_cross(k, spin)) : mean;
}

/* <u+ ...> with J = L g, L = (jn - jt) k k^T + jt 1. */
static impulse impulse_at(const pair *p, gg_vec k)
{
  double jn = p->contact->jn, jt = p->contact->jt;
  gg_tensor L = {{{jt, 0, 0}, {0, jt, 0}, {0, 0, jt}}}, X = cross_tensor(k), S = plus(p->one->M, 1, p->two->M);
  L = plus(L, jn - jt, outer(k, k));
  /* Regression on u: spins do not contribute, and S_gC = M_1. */
  gg_vec mean = mean_contact_velocity(p, k), Sk = times(S, k);
  double v = gg_dot(k, Sk), mu = gg_dot(k, mean), I[4];
  flux_integrals(mu, v, I);
  part g = {.R = gg_scale(1 / v, Sk)}, C = {.R = gg_scale(1 / v, times(p->one->M, k))}, s = {.B = {0, 0, p->one->spin}};
  g.B = gg_axpy(-mu, g.R, mean);
  C.B = gg_scale(-mu, C.R);
  /* S_gg = M_1 + M_2 + X (Theta_1 + Theta_2) X^T,   S_gs = -X Theta_1 */
  if (jt > 0) S = plus(S, -1, product(product(X, plus(p->one->Theta, 1, p->two->Theta)), X));
  gg_vec ug = gg_axpy(I[2], g.R, gg_scale(I[1], g.B));
  gg_tensor ugg = moment(I, v, g, g, S);
  double normal = gg_dot(k, times(ugg, k));
  impulse f = {.u = I[1], .J = times(L, ug), .loss = p->loss_n * normal};
  f.JC = product(L, moment(I, v, g, C, p->one->M));
  f.JJ = product(product(L, ugg), L);
  if (jt == 0) return f;
  f.loss += p->loss_t * (gg_theory_trace(ugg) - normal);
  gg_tensor Sgs = product(X, scaled(-1, p->one->Theta));
  f.kJ = gg_scale(jt, gg_cross(k, ug));
  f.kJs = scaled(jt, product(X, moment(I, v, g, s, Sgs)));
  f.kJkJ = scaled(-jt * jt, product(product(X, ugg), X)); /* X^T = -X */
  return f;
}

/* C_1' = C_1 - J/m_1 */
static void add_velocity(const pair *p, const impulse *f, double w, gg_gaussian *change)
{
  double a = p->contact->im1;
  gg_tensor gain = plus(f->JC, 1, transposed(f->JC));
  change->M = plus(plus(change->M, -w * a, gain), w * a * a, f->JJ);
}

/* s_1' = s_1 - k x J/(K_1 m_1); the second moment about the mean, which moves as well. */
static void add_spin(const pair *p, const impulse *f, double w, gg_gaussian *change)
{
  double q = p->contact->ik1, spin_rate = -w * q * f->kJ.z;
  gg_tensor gain = plus(f->kJs, 1, transposed(f->kJs));
  change->Theta = plus(plus(change->Theta, -w * q, gain), w * q * q, f->kJkJ);
  change->Theta.at[2][2] -= 2 * p->one->spin * spin_rate;
  change->spin += spin_rate;
}

static double number_density(const gg_model *m, int i)
{
  return m->number_density[i];
}

static void add_pair(const gg_model *m, const gg_gaussian *state, int i, int j, gg_vec k, double w,
                     gg_gaussian_rates *r)
{
  int o = gg_pair(i, j);
  double sigma = m->sigma[o];
  pair p = {&state[i],
            &state[j],
            &m->contact[i][j],
            .shear = m->boltzmann ? 0 : sigma * m->shear_rate,
            .frequency = number_density(m, j) * m->chi[o] * sigma * sigma,
            .loss_n = 0.5 * (1 - m->e[o]) * (1 + m->e[o]) / gg_inverse_mr(&m->contact[i][j]),
            .loss_t = 0.5 * (1 - m->beta[o]) * (1 + m->beta[o]) / gg_inverse_mt(&m->contact[i][j])};
  impulse f = impulse_at(&p, k);
  w *= p.frequency;
  r->frequency[i] += w * f.u;
  add_velocity(&p, &f, w, &r->change[i]);
  if (p.contact->jt > 0) add_spin(&p, &f, w, &r->change[i]);
  r->loss += 0.5 * number_density(m, i) * w * f.loss;
  if (!m->boltzmann) r->Pc = plus(r->Pc, 0.5 * number_density(m, i) * w * sigma, outer(k, f.J));
}

/* One direction; w: its solid angle. */
static void add_direction(const gg_model *m, const gg_gaussian *state, gg_vec k, double w, gg_gaussian_rates *r)
{
  for (int i = 0; i < m->n_species; i++) {
    double spread = gg_dot(k, times(state[i].M, k));
    r->speed[i] += w * sqrt(2 * spread / M_PI) / (2 * M_PI); /* |C| = int |k.C| dk/(2 pi) */
    for (int j = 0; j < m->n_species; j++) add_pair(m, state, i, j, k, w, r);
  }
}

/* Terms odd in z cancel between the quarters of the sphere. */
static void drop_odd(gg_tensor *A)
{
  A->at[0][2] = A->at[2][0] = A->at[1][2] = A->at[2][1] = 0;
}

void gg_theory_gaussian_rates_at(const gg_model *m, const gg_gaussian *state, gg_gaussian_rates *r)
{
  memset(r, 0, sizeof *r);
  gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(POLAR);
  if (!table) { /* the caller reports the missing table */
    gg_base_memory_lacked();
    return;
  }
  for (size_t a = 0; a < POLAR; a++) {
    double z, wz;
    gsl_integration_glfixed_point(-1, 1, a, &z, &wz, table);
    if (z < 0) continue;
    for (int b = 0; b < AZIMUTH; b++) {
      double phi = M_PI * (b + 0.5) / AZIMUTH, s = sqrt(1 - z * z);
      add_direction(m, state, (gg_vec){s * cos(phi), s * sin(phi), z}, 4 * wz * M_PI / AZIMUTH, r);
    }
  }
  gsl_integration_glfixed_table_free(table);
  drop_odd(&r->Pc);
  for (int i = 0; i < m->n_species; i++) drop_odd(&r->change[i].M), drop_odd(&r->change[i].Theta);
}

bool gg_theory_species_spins(const gg_model *m, int species)
{
  for (int j = 0; j < m->n_species; j++)
    if (m->contact[species][j].jt > 0) return true;
  return false;
}
