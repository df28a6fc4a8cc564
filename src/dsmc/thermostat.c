#include "dsmc/thermostat.h"

#include "dsmc/sweep.h"

enum { RUN = 64 }; /* blocks looked at together */

static void add_squares(const gg_block *c, size_t n, double drift, double lane[GG_LANES])
{
  for (size_t b = 0; b < n; b++)
    for (int l = 0; l < GG_LANES; l++) {
      double x = c[b].x[l] - drift * c[b].y[l];
      lane[l] += x * x + c[b].y[l] * c[b].y[l] + c[b].z[l] * c[b].z[l];
    }
}

/* Twice the kinetic energy. */
static double vis_viva(const gg_ensemble *e, double drift)
{
  double sum = 0;
  for (int i = 0; i < e->n_species; i++) {
    const gg_population *p = &e->of[i];
    double lane[GG_LANES] = {0}, all = 0;
    for (size_t first = 0; first < p->n_blocks; first += RUN) {
      const size_t n = p->n_blocks - first < RUN ? p->n_blocks - first : RUN;
      gg_block room[RUN];
      add_squares(gg_blocks_in_double(p, p->c, first, n, room), n, drift, lane);
    }
    for (int l = 0; l < GG_LANES; l++) all += lane[l];
    sum += p->mass * all;
  }
  return sum;
}

double gg_thermostat_return(gg_ensemble *e, double drift, double missing, double half)
{
  double energy = 0.5 * vis_viva(e, drift);
  /* The loss goes as T^(3/2), and the second half is hotter than the first by what it destroyed. */
  double advance = half * (1 + 1.5 * half / energy);
  double gain = (missing + advance) / energy, factor = gain > -1 ? sqrt(1 + gain) : 0;
  gg_ensemble_heat(e, factor);
  return advance;
}

void gg_thermostat_kick(gg_ensemble *e, double drift, double variance, gg_rng_lanes *lanes)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_population *p = &e->of[i];
    gg_kick_blocks(p->c, p->single, p->top, p->n_blocks, drift, sqrt(variance), e->top_unit, lanes);
    for (size_t a = (size_t)p->n; a < p->n_blocks * GG_LANES; a++)
      gg_block_set(p, p->c, (uint32_t)a, (gg_vec){0, 0, 0});
  }
  e->top_drift = drift;
}
