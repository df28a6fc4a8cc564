/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/dsmc_thermostat.h"

#include "base/thread_pool.h"
#include "common/thermostat.h"
#include "dsmc/kernel/kernels.h"
#include "dsmc/parallel/schedule.h"

enum { RUN = 64 }; /* blocks that are converted at once */

static void add_squares(const gg_dsmc_block *c, size_t n, double strain, double lane[GG_DSMC_LANES])
{
  for (size_t b = 0; b < n; b++)
    for (int l = 0; l < GG_DSMC_LANES; l++) {
      double x = c[b].x[l] - strain * c[b].y[l];
      lane[l] += x * x + c[b].y[l] * c[b].y[l] + c[b].z[l] * c[b].z[l];
    }
}

typedef struct energies {
  const gg_dsmc_ensemble *e;
  double strain;
  double lane[GG_DSMC_MAX_SEGMENTS][GG_MAX_SPECIES][GG_DSMC_LANES]; /* sums of C^2 */
} energies;

static void sum_of_segment(void *context, int part)
{
  energies *w = context;
  const int segment = gg_dsmc_segment_in(w->e->segments, w->e->grouping, part);
  for (int i = 0; i < w->e->n_species; i++) {
    const gg_dsmc_population *p = &w->e->of[i];
    gg_dsmc_range r = gg_dsmc_segment(p, w->e->segments, segment);
    double lane[GG_DSMC_LANES] = {0};
    for (size_t done = 0; done < r.n; done += RUN) {
      const size_t n = r.n - done < RUN ? r.n - done : RUN;
      gg_dsmc_block room[RUN];
      add_squares(gg_dsmc_blocks_in_double(p, p->c, r.first + done, n, room), n, w->strain, lane);
    }
    for (int l = 0; l < GG_DSMC_LANES; l++) w->lane[segment][i][l] = lane[l];
  }
}

static double twice_kinetic_energy(const gg_dsmc_ensemble *e, double strain)
{
  energies w = {.e = e, .strain = strain};
  gg_base_thread_pool_for(e->pool, e->segments, sum_of_segment, &w);
  double sum = 0;
  for (int i = 0; i < e->n_species; i++) {
    double all = 0;
    for (int segment = 0; segment < e->segments; segment++)
      for (int l = 0; l < GG_DSMC_LANES; l++) all += w.lane[segment][i][l];
    sum += e->of[i].mass * all;
  }
  return sum;
}

/* Least relative gain of energy in single precision, eight units in the last place; a quarter of a mean free time needs
 * more if e < 1 - 6e-6. */
#define LEAST_GAIN 1e-6

double gg_dsmc_thermostat_return(gg_dsmc_ensemble *e, double strain, double kept, double missing, double half)
{
  double energy = 0.5 * twice_kinetic_energy(e, strain);
  if (kept > 0) missing = kept - energy;
  /* The loss is proportional to T^(3/2), and the second half is hotter than the first by the loss of the first. */
  double advance = half * (1 + 1.5 * half / energy);
  double gain = (missing + advance) / energy, factor = gain > -1 ? sqrt(1 + gain) : 0;
  /* A gain that single precision would round away is deferred until it has accumulated. */
  if (e->of[0].single && fabs(gain) < LEAST_GAIN) return -missing;
  gg_dsmc_ensemble_heat(e, factor);
  return advance;
}

typedef struct kicking {
  gg_dsmc_ensemble *e;
  double strain;
  gg_dsmc_kick_map centre[GG_MAX_SPECIES], spin[GG_MAX_SPECIES];
  bool spins; /* spins are kicked, too */
  gg_dsmc_rng_lanes *lanes;
  gg_dsmc_block sum[GG_DSMC_MAX_SEGMENTS][GG_MAX_SPECIES]; /* of the kicked velocities, by lane */
} kicking;

/* Reset the empty lanes of the last block, and remove them from the sum. */
static void clear_rest(const gg_dsmc_population *p, void *blocks, gg_dsmc_block *sum)
{
  for (size_t a = (size_t)p->n; a < p->n_blocks * GG_DSMC_LANES; a++) {
    const gg_vec v = gg_dsmc_block_get(p, blocks, (uint32_t)a);
    const size_t l = a % GG_DSMC_LANES;
    sum->x[l] -= v.x, sum->y[l] -= v.y, sum->z[l] -= v.z;
    gg_dsmc_block_set(p, blocks, (uint32_t)a, (gg_vec){0, 0, 0});
  }
}

static void kick_segment(void *context, int part)
{
  kicking *w = context;
  const int segment = gg_dsmc_segment_in(w->e->segments, w->e->grouping, part);
  for (int i = 0; i < w->e->n_species; i++) {
    gg_dsmc_population *p = &w->e->of[i];
    gg_dsmc_range r = gg_dsmc_segment(p, w->e->segments, segment);
    const bool kicks_spins = w->spins && p->s, last = segment == w->e->segments - 1;
    gg_dsmc_block sum = {{0}, {0}, {0}}, spins = sum;
    w->e->kernels->kick(gg_dsmc_blocks_at(p, p->c, r.first), p->single, p->speed_bound + r.first, r.n, w->strain,
                        &w->centre[i], w->e->bound_scale, &w->lanes[segment], &sum);
    if (kicks_spins)
      w->e->kernels->kick(gg_dsmc_blocks_at(p, p->s, r.first), p->single, NULL, r.n, 0, &w->spin[i], 1,
                          &w->lanes[segment], &spins);
    if (last) clear_rest(p, p->c, &sum);
    if (last && kicks_spins) clear_rest(p, p->s, &spins);
    w->sum[segment][i] = sum;
  }
}

static void kick(kicking *w)
{
  gg_base_thread_pool_for(w->e->pool, w->e->segments, kick_segment, w);
  w->e->bound_strain = w->strain;
  w->e->bound_width = 0;
}

void gg_dsmc_thermostat_kick(gg_dsmc_ensemble *e, double strain, double variance, gg_dsmc_rng_lanes *lanes)
{
  kicking w = {.e = e, .strain = strain, .lanes = lanes};
  for (int i = 0; i < e->n_species; i++)
    w.centre[i] = (gg_dsmc_kick_map){.factor = 1, .size = sqrt(variance), .widening = 1, .lean = strain};
  kick(&w);
}

/* Velocity of the centre of mass, of stored velocities. */
static gg_vec velocity_of_centre(const kicking *w)
{
  gg_vec momentum = {0, 0, 0};
  double mass = 0;
  for (int i = 0; i < w->e->n_species; i++) {
    const gg_dsmc_population *p = &w->e->of[i];
    for (int segment = 0; segment < w->e->segments; segment++)
      for (int l = 0; l < GG_DSMC_LANES; l++) {
        const gg_dsmc_block *sum = &w->sum[segment][i];
        momentum = gg_axpy(p->mass, (gg_vec){sum->x[l], sum->y[l], sum->z[l]}, momentum);
      }
    mass += p->mass * (double)p->n;
  }
  return gg_scale(1 / mass, momentum);
}

void gg_dsmc_thermostat_bath(gg_dsmc_ensemble *e, const gg_model *m, const gg_dsmc_bath_step *step, gg_vec *centre,
                             gg_dsmc_rng_lanes *lanes)
{
  const gg_bath *b = &m->bath;
  const double rate = m->shear_rate;
  kicking w = {.e = e, .strain = step->strain, .lanes = lanes, .spins = b->spin_drag[0] > 0 || m->turns};
  for (int i = 0; i < e->n_species; i++) {
    const gg_relaxation r = gg_common_relaxation(b->drag[i], step->dt),
                        s = gg_common_relaxation(b->spin_drag[i], step->dt);
    const double turned = gg_common_relaxation(0.5 * b->spin_drag[i], step->dt).spread;
    w.centre[i] = (gg_dsmc_kick_map){.factor = r.decay,
                                     .size = sqrt(b->noise[i] * r.spread),
                                     .widening = sqrt(1 + rate * rate * r.width),
                                     .lean = step->begin + rate * r.mean,
                                     .drift = gg_scale(-r.decay, *centre)};
    w.spin[i] = (gg_dsmc_kick_map){.factor = s.decay,
                                   .size = sqrt(b->spin_noise[i] * s.spread),
                                   .widening = 1,
                                   .drift = {.z = (1 - s.decay) * gg_model_rolling(m, i) + m->torque[i] * turned}};
  }
  kick(&w);
  *centre = velocity_of_centre(&w);
}
