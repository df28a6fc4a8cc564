#include "common/thermostat.h"

gg_thermostat gg_common_thermostat_of(const gg_model *model)
{
  return gg_flow_takes(model->flow, model->thermostat) ? model->thermostat : gg_flow_of(model->flow)->thermostat;
}

/* Mean energy that a collision of Maxwellians destroys: <g_n^2> = 2 <c12_x^2>, <g_t^2> = 2 (<c12_x^2> + <s_x^2>). */
static double loss_per_collision(const gg_model *m, int i, int j)
{
  const int o = gg_pair(i, j);
  const gg_contact *c = &m->contact[i][j];
  double T = m->temperature0, normal = T * (1 - m->e[o] * m->e[o]);
  if (gg_common_rule_select(m->beta[o], m->mu[o]) == GG_SMOOTH) return normal;
  double spread = T * (c->im1 + c->im2) + m->ratio0 * T * (c->ik1 + c->ik2);
  return normal + (1 - m->beta[o] * m->beta[o]) * spread / gg_inverse_mt(c);
}

double gg_common_thermostat_noise(const gg_model *m)
{
  double loss = 0, mass = 0, n = (double)m->n;
  for (int i = 0; i < m->n_species; i++) {
    mass += m->mass[i] * (double)m->n_of[i] / n;
    for (int j = 0; j < m->n_species; j++) {
      int o = gg_pair(i, j);
      double spread = m->temperature0 * (1 / m->mass[i] + 1 / m->mass[j]);
      double rate = m->sigma[o] * m->sigma[o] * m->chi[o] * sqrt(8 * M_PI * spread) * m->density / 2;
      loss += (double)m->n_of[i] / n * (double)m->n_of[j] / n * rate * loss_per_collision(m, i, j);
    }
  }
  return loss / (1.5 * mass);
}
