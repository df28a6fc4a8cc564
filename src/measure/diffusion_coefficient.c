/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The coefficient of self-diffusion from correlations at lags up to 480 collisions a grain. */
#include <math.h>

#include "measure/diffusion_lags.h"

/* Lags, in steps of their level, at which D(t) is evaluated. */
static const int node_steps[] = {4, 5, 6, 7, 8, 10, 12, 14}; /* and 16, the first of the next level */
enum { NODES_PER_LEVEL = 8, NODES = (GG_LAG_LEVELS - 1) * NODES_PER_LEVEL };

/* Collisions a grain until e^-10 of a velocity remains, also for heavy grains among light ones: momentum is lost at
 * the rate (8/3) sum_j n_j sigma^2 chi sqrt(2 pi T m_r) (1 + e)/(2 m) in a gas of Maxwellians (T as an energy: 1). */
static double kinetic_collisions(const gg_model *m, int species)
{
  double friction = 0;
  for (int j = 0; j < m->n_species; j++) {
    int q = gg_pair(species, j);
    double reduced = m->mass[species] * m->mass[j] / (m->mass[species] + m->mass[j]),
           n = (double)m->n_of[j] / m->volume;
    friction += 8.0 / 3 * n * m->sigma[q] * m->sigma[q] * m->chi[q] * sqrt(2 * M_PI * reduced) * (1 + m->e[q]) / 2;
  }
  return 9.7 * m->mass[species] / friction * gg_common_model_collision_rate(m, 1);
}

typedef struct node {
  int lag;
  double spacing; /* of the origins of its level */
} node;

/* Nodes with samples, later than so many collisions a grain. */
static int nodes_of(const double *bin, double least, node *list)
{
  int n = 0;
  double step = gg_lag_mean(bin, 1, GG_LAG_TIME); /* of time, between two snapshots */
  for (int level = 1; level < GG_LAG_LEVELS; level++)
    for (int k = 0; k < NODES_PER_LEVEL; k++) {
      node at = {gg_lag_index(level, node_steps[k]), ldexp(step, 2 * level) * GG_LAG_REACH / gg_lag_origins[level]};
      if (isnan(gg_lag_mean(bin, at.lag, GG_LAG_TIME))) return n;
      if (ldexp(node_steps[k], 2 * level) * 2 / GG_LAG_SNAPSHOTS > least) list[n++] = at;
    }
  return n;
}

/* Components of which a component of the tensor is made, of mean temperature and mean D. */
static double diagonal(const double *bin, int lag, int channel, int a)
{
  if (a < GG_LAG_XY) return gg_lag_mean(bin, lag, channel + a);
  return sqrt(fabs(gg_lag_mean(bin, lag, channel) * gg_lag_mean(bin, lag, channel + 1)));
}

/* C(0) r(t) scatters by T 2Dt, and there are two velocities, at both ends. */
static gg_coefficient green_kubo(const gg_long_time_tail *tail, const double *bin, int a, const node *list, int n,
                                 double samples)
{
  gg_running at[NODES];
  double T = diagonal(bin, 0, GG_LAG_CC, a);
  for (int k = 0; k < n; k++) {
    int lag = list[k].lag;
    at[k] = (gg_running){.t = gg_lag_mean(bin, lag, GG_LAG_TIME), .D = gg_lag_mean(bin, lag, GG_LAG_CR + a)};
    at[k].noise =
        T * fabs(diagonal(bin, list[0].lag, GG_LAG_CR, a)) / (bin[lag * GG_LAG_WIDTH + GG_LAG_COUNT] * samples);
  }
  return gg_measure_long_time_tail_coefficient(tail, at, n);
}

/* Half the slope between two nodes is the value in the middle. Displacements of many origins overlap: the slope
 * scatters by 4 D^2 t over the whole time, summed over all origins and grains. */
static gg_coefficient einstein(const gg_long_time_tail *tail, const double *bin, int a, const node *list, int n,
                               double samples)
{
  gg_running at[NODES];
  for (int k = 0; k + 1 < n; k++) {
    int one = list[k].lag, two = list[k + 1].lag;
    double from = gg_lag_mean(bin, one, GG_LAG_TIME), to = gg_lag_mean(bin, two, GG_LAG_TIME);
    at[k] = (gg_running){.t = 0.5 * (from + to)};
    const int rr = GG_LAG_RR + (a < GG_LAG_XY ? a : GG_LAG_XY);
    at[k].D = 0.5 * (gg_lag_mean(bin, two, rr) - gg_lag_mean(bin, one, rr)) / (to - from);
    const double scatter = a < GG_LAG_XY ? at[0].D : diagonal(bin, list[0].lag, GG_LAG_CR, a);
    at[k].noise = 4 * scatter * scatter / (bin[one * GG_LAG_WIDTH + GG_LAG_COUNT] * samples * list[k].spacing);
  }
  return gg_measure_long_time_tail_coefficient(tail, at, n - 1);
}

/* In a driven gas the decay of the correlation differs from that in equilibrium. Under shear (phi = 0.3, e = 0.9) a
 * tenth of D_xx comes after 16 collisions a grain, and 3 % after 56. So no tail is assumed before DRIVEN times the
 * decay time of velocities, and LEFT phi D for the later part. */
#define DRIVEN 4
#define LEFT 0.05

gg_diffusion_coefficients gg_measure_diffusion_read(const gg_model *m, int species, int a, const double *bin,
                                                    double samples)
{
  double T = 0;
  for (int b = 0; b < 3; b++) T += m->mass[species] * gg_lag_mean(bin, 0, GG_LAG_CC + b) / 3;
  bool driven = !gg_flow_of(m->flow)->conserves;
  node list[NODES];
  int n = nodes_of(bin, kinetic_collisions(m, species) * (driven ? DRIVEN : 1), list);
  gg_long_time_tail tail = gg_measure_long_time_tail_of(m, T);
  if (m->homogeneous && n > 0) /* Enskog's equation has no vortices */
    tail = gg_measure_long_time_tail_driven(0, gg_lag_mean(bin, list[0].lag, GG_LAG_TIME));
  else if (driven && n > 0)
    tail = gg_measure_long_time_tail_driven(LEFT * m->phi * fabs(gg_lag_mean(bin, list[0].lag, GG_LAG_CR + a)),
                                            gg_lag_mean(bin, list[0].lag, GG_LAG_TIME));
  return (gg_diffusion_coefficients){green_kubo(&tail, bin, a, list, n, samples),
                                     einstein(&tail, bin, a, list, n, samples)};
}
