#include "dsmc/thermostat.h"

#include "dsmc/sweep.h"

gg_thermostat gg_thermostat_of(const gg_model *model)
{
  return model->flow == GG_HSS && model->thermostat == GG_NO_THERMOSTAT ? GG_GAUSSIAN : model->thermostat;
}

/* Mean energy that a collision of Maxwellians destroys: <g_n^2> = 2 <c12_x^2>, <g_t^2> = 2 (<c12_x^2> + <s_x^2>). */
static double loss_per_collision(const gg_model *m, int o)
{
  const gg_contact *c = &m->contact[o];
  double T = m->temperature0, normal = T * (1 - m->e[o] * m->e[o]);
  if (gg_rule_of(m->beta[o], m->mu[o]) == GG_SMOOTH) return normal;
  double spread = T * (c->im1 + c->im2) + m->ratio0 * T * (c->ik1 + c->ik2);
  return normal + (1 - m->beta[o] * m->beta[o]) * spread / gg_inverse_mt(c);
}

double gg_thermostat_noise(const gg_model *m)
{
  double loss = 0, mass = 0, n = (double)m->n;
  for (int i = 0; i < m->n_species; i++) {
    mass += m->mass[i] * (double)m->n_of[i] / n;
    for (int j = 0; j < m->n_species; j++) {
      int o = 2 * i + j;
      double spread = m->temperature0 * (1 / m->mass[i] + 1 / m->mass[j]);
      double rate = m->sigma[o] * m->sigma[o] * m->chi[o] * sqrt(8 * M_PI * spread) * m->density / 2;
      loss += (double)m->n_of[i] / n * (double)m->n_of[j] / n * rate * loss_per_collision(m, o);
    }
  }
  return loss / (1.5 * mass);
}

/* Twice the kinetic energy. */
static double vis_viva(const gg_ensemble *e, double drift)
{
  double sum = 0;
  for (int i = 0; i < e->n_species; i++) {
    double lane[GG_LANES] = {0}, all = 0;
    for (size_t b = 0; b < e->of[i].n_blocks; b++) {
      const gg_block *c = &e->of[i].c[b];
      for (int l = 0; l < GG_LANES; l++) {
        double x = c->x[l] - drift * c->y[l];
        lane[l] += x * x + c->y[l] * c->y[l] + c->z[l] * c->z[l];
      }
    }
    for (int l = 0; l < GG_LANES; l++) all += lane[l];
    sum += e->of[i].mass * all;
  }
  return sum;
}

double gg_thermostat_return(gg_ensemble *e, double drift, double missing, double half)
{
  double energy = 0.5 * vis_viva(e, drift);
  /* The loss goes as T^(3/2), and the second half is hotter than the first by what it destroyed. */
  double advance = half * (1 + 1.5 * half / energy);
  double gain = (missing + advance) / energy, factor = gain > -1 ? sqrt(1 + gain) : 0;
  for (int i = 0; i < e->n_species; i++) gg_blocks_scale(e->of[i].c, e->of[i].n_blocks, factor);
  return advance;
}

void gg_thermostat_kick(gg_ensemble *e, double drift, double variance, gg_rng_lanes *lanes)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_population *p = &e->of[i];
    gg_kick_blocks(p->c, p->n_blocks, drift, sqrt(variance), lanes);
    for (size_t a = (size_t)p->n; a < p->n_blocks * GG_LANES; a++) gg_block_set(p->c, (uint32_t)a, (gg_vec){0, 0, 0});
  }
}
