/* SPDX-License-Identifier: GPL-3.0-or-later */
/* After J.T. Jenkins & M.W. Richman, J. Fluid Mech. 192 (1988) 313 and S. Saha & M. Alam, J. Fluid Mech. 795 (2016)
 * 549, without their expansions: the averages over contacts of one direction (contact_averages.h), and one quadrature
 * over the sphere. */
#include "theory/gaussian_moments.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "common/vec.h"

/* C_1' = C_1 - J/m_1 */
static void add_velocity(const gg_contact_pair *p, const gg_contact_average *f, double w, gg_gaussian *change)
{
  double a = p->contact->im1;
  gg_tensor gain = gg_tensor_plus(f->JC, 1, gg_tensor_transposed(f->JC));
  change->M = gg_tensor_plus(gg_tensor_plus(change->M, -w * a, gain), w * a * a, f->JJ);
}

/* s_1' = s_1 - k x J/(K_1 m_1); the second moment about the mean, which moves as well. */
static void add_spin(const gg_contact_pair *p, const gg_contact_average *f, double w, gg_gaussian *change)
{
  double q = p->contact->ik1, spin_rate = -w * q * f->kJ.z;
  gg_tensor gain = gg_tensor_plus(f->kJs, 1, gg_tensor_transposed(f->kJs));
  change->Theta = gg_tensor_plus(gg_tensor_plus(change->Theta, -w * q, gain), w * q * q, f->kJkJ);
  change->Theta.at[2][2] -= 2 * p->one->spin * spin_rate;
  change->spin += spin_rate;
}

static void add_pair(const gg_model *m, const gg_gaussian *state, int i, int j, gg_vec k, double w,
                     gg_gaussian_rates *r)
{
  int o = gg_pair(i, j);
  double sigma = m->sigma[o];
  gg_contact_pair p = {&state[i],
                       &state[j],
                       &m->contact[i][j],
                       .shear = m->boltzmann ? 0 : sigma * m->shear_rate,
                       .loss_n = 0.5 * (1 - m->e[o]) * (1 + m->e[o]) / gg_inverse_mr(&m->contact[i][j]),
                       .loss_t = 0.5 * (1 - m->beta[o]) * (1 + m->beta[o]) / gg_inverse_mt(&m->contact[i][j]),
                       .speed_unit = m->speed_unit};
  gg_speed_law law[GG_N_COEFFICIENTS];
  for (int c = 0; m->law.name && c < GG_N_COEFFICIENTS; c++) {
    const char *text = gg_speed_law_text(&m->by_speed, (gg_contact_coefficient)c, o);
    if (text && gg_common_speed_law_parse(&law[c], (gg_contact_coefficient)c, text, NULL) == GG_OK) p.law[c] = &law[c];
  }
  gg_contact_average f = gg_theory_contact_average(&p, k);
  w *= m->number_density[j] * m->chi[o] * sigma * sigma;
  r->frequency[i] += w * f.rate;
  add_velocity(&p, &f, w, &r->change[i]);
  if (p.contact->jt > 0) add_spin(&p, &f, w, &r->change[i]);
  r->loss += 0.5 * m->number_density[i] * w * f.loss;
  if (!m->boltzmann) r->Pc = gg_tensor_plus(r->Pc, 0.5 * m->number_density[i] * w * sigma, gg_tensor_outer(k, f.J));
}

/* One direction; w: its solid angle. */
static void add_direction(const gg_model *m, const gg_gaussian *state, gg_vec k, double w, gg_gaussian_rates *r)
{
  for (int i = 0; i < m->n_species; i++) {
    double spread = gg_dot(k, gg_tensor_times(state[i].M, k));
    r->speed[i] += w * sqrt(2 * spread / M_PI) / (2 * M_PI); /* |C| = int |k.C| dk/(2 pi) */
    for (int j = 0; j < m->n_species; j++) add_pair(m, state, i, j, k, w, r);
  }
}

/* Everything is even under k -> -k and under reflection at the shear plane: a quarter of the sphere is enough. */
static void add_sphere(const gg_model *m, const gg_gaussian *state, gg_gaussian_rates *r)
{
  const int polar = m->rule == GG_FRICTIONAL ? 10 : 24, azimuth = m->rule == GG_FRICTIONAL ? 14 : 16;
  gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc((size_t)polar);
  if (!table) { /* the caller reports the missing table */
    gg_base_memory_lacked();
    return;
  }
  for (int a = 0; a < polar; a++) {
    double z, wz;
    gsl_integration_glfixed_point(-1, 1, (size_t)a, &z, &wz, table);
    if (z < 0) continue;
    for (int b = 0; b < azimuth; b++) {
      double phi = M_PI * (b + 0.5) / azimuth, s = sqrt(1 - z * z);
      add_direction(m, state, (gg_vec){s * cos(phi), s * sin(phi), z}, 4 * wz * M_PI / azimuth, r);
    }
  }
  gsl_integration_glfixed_table_free(table);
}

static bool is_isotropic(gg_tensor A)
{
  return A.at[0][1] == 0 && A.at[0][0] == A.at[1][1] && A.at[0][0] == A.at[2][2];
}

/* At rest, with isotropic velocities and spins, all directions are alike. */
static bool at_rest(const gg_model *m, const gg_gaussian *state)
{
  bool rest = m->shear_rate == 0;
  for (int i = 0; i < m->n_species; i++)
    rest &= is_isotropic(state[i].M) && is_isotropic(state[i].Theta) && state[i].spin == 0;
  return rest;
}

/* Terms odd in z cancel between the quarters of the sphere. */
static void drop_odd(gg_tensor *A)
{
  A->at[0][2] = A->at[2][0] = A->at[1][2] = A->at[2][1] = 0;
}

/* The mean over all directions of one direction's tensor. */
static void make_isotropic(gg_tensor *A)
{
  const double third = gg_tensor_trace(*A) / 3;
  *A = (gg_tensor){{{third, 0, 0}, {0, third, 0}, {0, 0, third}}};
}

void gg_theory_gaussian_rates_at(const gg_model *m, const gg_gaussian *state, gg_gaussian_rates *r)
{
  const bool rest = at_rest(m, state);
  void (*const symmetry)(gg_tensor *) = rest ? make_isotropic : drop_odd;
  memset(r, 0, sizeof *r);
  if (rest)
    add_direction(m, state, (gg_vec){0, 0, 1}, 4 * M_PI, r);
  else
    add_sphere(m, state, r);
  symmetry(&r->Pc);
  for (int i = 0; i < m->n_species; i++) {
    symmetry(&r->change[i].M);
    symmetry(&r->change[i].Theta);
    if (rest) r->change[i].spin = 0;
  }
}

bool gg_theory_species_spins(const gg_model *m, int species)
{
  for (int j = 0; j < m->n_species; j++)
    if (m->contact[species][j].jt > 0) return true;
  return false;
}
