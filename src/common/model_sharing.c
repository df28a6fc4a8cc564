/* How long elastic species take to share their energy: the longer the less alike their masses are. */
#include <gsl/gsl_eigen.h>
#include <math.h>

#include "base/gsl_errors.h"
#include "base/memory.h"
#include "common/model.h"

/* Of Maxwellians dT_i/dt = sum_j x_j k_ij (T_j - T_i), k_ij = (8/3) m_i m_j/(m_i + m_j)^2 times the rate at which a
 * grain of i meets those of j, were all grains j. Here at T = 1. */
static double exchange(const gg_model *m, int i, int j)
{
  const int o = gg_pair(i, j);
  const double both = m->mass[i] + m->mass[j], spread = 1 / m->mass[i] + 1 / m->mass[j]; /* <c12_x^2> */
  const double meeting = m->density * m->sigma[o] * m->sigma[o] * m->chi[o] * sqrt(8 * M_PI * spread);
  return 8 / 3.0 * m->mass[i] * m->mass[j] / (both * both) * meeting;
}

/* The same for sqrt(x_i) T_i, with the other sign: symmetric. */
static void fill(const gg_model *m, gsl_matrix *S)
{
  gsl_matrix_set_zero(S);
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      const double xi = (double)m->n_of[i] / (double)m->n, xj = (double)m->n_of[j] / (double)m->n;
      if (i == j) continue;
      const double k = exchange(m, i, j);
      *gsl_matrix_ptr(S, (size_t)i, (size_t)i) += xj * k;
      gsl_matrix_set(S, (size_t)i, (size_t)j, -sqrt(xi * xj) * k);
    }
}

/* The eigenvalue next to 0, which is that of equal temperatures. */
static double slowest_rate(const gg_model *m)
{
  double elements[GG_MAX_SPECIES * GG_MAX_SPECIES], values[GG_MAX_SPECIES], least = INFINITY, next = INFINITY;
  const size_t n = (size_t)m->n_species;
  gsl_matrix_view S = gsl_matrix_view_array(elements, n, n);
  gsl_vector_view rates = gsl_vector_view_array(values, n);
  gg_base_gsl_enter();
  gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc(n);
  gg_base_gsl_leave();
  if (!w) {
    gg_base_memory_lacked();
    return INFINITY;
  }
  fill(m, &S.matrix);
  gsl_eigen_symm(&S.matrix, &rates.vector, w);
  gsl_eigen_symm_free(w);
  for (size_t i = 0; i < n; i++) {
    if (values[i] < least)
      next = least, least = values[i];
    else if (values[i] < next)
      next = values[i];
  }
  return next;
}

double gg_common_model_sharing(const gg_model *m)
{
  return m->n_species > 1 ? gg_common_model_collision_rate(m, 1) / slowest_rate(m) : 0;
}
