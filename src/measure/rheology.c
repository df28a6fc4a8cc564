/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The default set: temperatures, spin, stress, rates, moments. */
#include "measure/rheology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/cooling_interval.h"
#include "measure/grain_snapshot.h"
#include "measure/long_waves.h"
#include "measure/velocity_moments.h"

/* Data that one sample leaves for the next. */
typedef struct memory {
  double last_temperature; /* at the previous sample, engine's scale */
  double log2_scale;       /* engine's velocities are 2^this times those of the start: in the end beyond all doubles */
  double mean_spin[GG_MAX_SPECIES][3];
  double energy, momentum[2];         /* of all grains; m c_x and m c_y, between walls */
  gg_dragged dragged[GG_MAX_SPECIES]; /* at the previous sample */
  double density_waves, momentum_waves;
  uint64_t samples;
} memory;

/* Long waves change slowly, and positions cost time: they are taken every so many samples. */
enum { WAVES_EVERY = 10 };

typedef struct rheology {
  const gg_model *model;
  gg_velocity_moments moments[GG_MAX_SPECIES];
  bool quick;
  memory memory;
  double energy, momentum[2], torque_power,
      shear_stress; /* of this sample's grains in the laboratory, if moments are about a local flow: the power of
                       torques, the sum of m c_x c_y */
  gg_long_waves waves;
  gg_species_scratch scratch;
} rheology;

static size_t width(const gg_model *m)
{
  return CH_SPECIES + (size_t)m->n_species * gg_rheology_species_width(m);
}

static void *create(const gg_model *model, gg_error *err)
{
  rheology *r = gg_base_array_new(1, sizeof *r, err);
  if (!r) return NULL;
  r->model = model;
  return r;
}

static void *memory_of(void *self, size_t *bytes)
{
  rheology *r = self;
  *bytes = sizeof r->memory;
  return &r->memory;
}

/* Spins are taken about their mean of the previous sample, so that one pass over the grains is enough. Moments are
 * corrected afterwards (gg_measure_velocity_moments_centre); the effect of the shift on the angles to C is of second
 * order, as for any mean over N grains. */
static void begin(void *self)
{
  rheology *r = self;
  r->waves = (gg_long_waves){0};
  const double T = r->memory.last_temperature;
  r->energy = r->momentum[0] = r->momentum[1] = r->torque_power = r->shear_stress = 0;
  r->quick = T > 0x1p-60 && T < 0x1p60; /* squares of velocities are well within the range of single precision */
  for (int i = 0; i < r->model->n_species; i++) {
    r->moments[i] = (gg_velocity_moments){0};
    memcpy(r->moments[i].mean_spin, r->memory.mean_spin[i], sizeof r->memory.mean_spin[i]);
  }
}

static bool wants_positions(const void *self)
{
  const rheology *r = self;
  return gg_measure_has_long_waves(r->model) && r->memory.samples % WAVES_EVERY == 0;
}

/* Between walls and about cells: the energy of the grains in the laboratory, their flow included. */
static void add_whole(rheology *r, const gg_chunk *chunk)
{
  const gg_model *m = r->model;
  for (size_t k = 0; k < chunk->n; k++) {
    int i = chunk->species ? chunk->species[k] : 0;
    double cc = 0, ss = 0;
    for (int a = 0; a < 3; a++) cc += chunk->whole_c[a][k] * chunk->whole_c[a][k];
    for (int a = 0; a < 3 && chunk->whole_s[0]; a++) ss += chunk->whole_s[a][k] * chunk->whole_s[a][k];
    r->energy += 0.5 * m->mass[i] * (cc + m->inertia[i] * ss);
    if (m->turns) r->torque_power += m->mass[i] * m->inertia[i] * m->torque[i] * chunk->whole_s[2][k];
    for (int a = 0; a < 2; a++) r->momentum[a] += m->mass[i] * chunk->whole_c[a][k];
    r->shear_stress += m->mass[i] * chunk->whole_c[0][k] * chunk->whole_c[1][k];
  }
}

/* Elsewhere: the energy from moments, spins about their mean. */
static double energy_of_moments(const rheology *r)
{
  double energy = 0;
  for (int i = 0; i < r->model->n_species; i++) {
    const gg_velocity_moments *m = &r->moments[i];
    double squares = 0;
    for (int a = 0; a < 3; a++)
      squares += m->cc[a] + r->model->inertia[i] * (m->ww[a] + m->n * m->mean_spin[a] * m->mean_spin[a]);
    energy += 0.5 * r->model->mass[i] * squares;
  }
  return energy;
}

static void add_chunk(void *self, const gg_chunk *chunk)
{
  rheology *r = self;
  if (chunk->whole_c[0]) add_whole(r, chunk);
  if (chunk->r[0] && wants_positions(r)) {
    gg_chunk grains = *chunk; /* structure does not depend on the frame */
    for (int a = 0; a < 3 && chunk->whole_c[0]; a++) grains.c[a] = chunk->whole_c[a];
    gg_measure_long_waves_add(&r->waves, r->model, &grains);
  }
  for (int i = 0; i < r->model->n_species; i++) {
    gg_species_view v = gg_measure_species_chunk(chunk, i, &r->scratch);
    gg_velocity_moment_view grains = {
        v.n, GG_VELOCITY_MOMENT_LANES, 0, {v.c[0], v.c[1], v.c[2]}, {v.s[0], v.s[1], v.s[2]}};
    gg_measure_velocity_moments_add(&r->moments[i], r->quick, &grains);
  }
}

static void add_blocks(void *self, const gg_block_run *run)
{
  rheology *r = self;
  gg_velocity_moment_view grains = {.n = run->n, .stride = 3 * GG_VELOCITY_MOMENT_LANES, .strain = run->strain};
  for (int a = 0; a < 3; a++) {
    grains.c[a] = run->c + a * GG_VELOCITY_MOMENT_LANES;
    if (run->s) grains.s[a] = run->s + a * GG_VELOCITY_MOMENT_LANES;
  }
  gg_measure_velocity_moments_add(&r->moments[run->species], r->quick, &grains);
}

/* T = sum x_i m_i <C.C>_i/3 of this instant. */
static double temperature(const rheology *r)
{
  double sum = 0;
  for (int i = 0; i < r->model->n_species; i++) {
    const gg_velocity_moments *m = &r->moments[i];
    sum += r->model->mass[i] * (m->cc[0] + m->cc[1] + m->cc[2]);
  }
  return sum / (3 * (double)r->model->n);
}

static void put_moments(const rheology *r, int species, double T, double *ch)
{
  const gg_velocity_moments *m = &r->moments[species];
  double second = 1 / (m->n * T), fourth = second / T;
  for (int a = 0; a < 3; a++) {
    ch[CH_C2X + a] = m->cc[a] * second;
    ch[CH_C4X + a] = m->c4[a] * fourth;
  }
  ch[CH_CXY] = m->cxcy * second;
  ch[CH_CCCC] = m->cccc * fourth;
  ch[CH_SPEED] = m->speed / (m->n * sqrt(T));
  if (r->model->rule == GG_SMOOTH) return;
  ch[CH_SPIN_Z] = m->mean_spin[2] / sqrt(T);
  for (int a = 0; a < 3; a++) {
    ch[CH_W2X + a] = m->ww[a] * second;
    ch[CH_W4X + a] = m->w4[a] * fourth;
  }
  ch[CH_W3Z] = m->w3[2] * second / sqrt(T);
  ch[CH_COS2] = m->cos2 / m->n;
  const double product = (m->cc[0] + m->cc[1] + m->cc[2]) * (m->ww[0] + m->ww[1] + m->ww[2]) / m->n;
  ch[CH_A11] = product > 0 ? m->ccww / product : 1; /* grains without spin: no correlation */
  ch[CH_B] = product > 0 ? m->cwcw / product : 1.0 / 3;
}

static void put_rates(const rheology *r, const gg_interval *in, gg_cooling_interval h, double *row)
{
  const gg_model *m = r->model;
  const gg_collision_sums *t = in->transfer;
  double collisions = 0, loss = 0, given = 0, p[3][3] = {{0}};
  for (int q = 0; q < gg_pairs_of(r->model->n_species); q++) {
    collisions += (double)t->collisions[q];
    loss += t->loss[q], given += t->given[q];
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) p[a][b] += t->stress[q][a][b];
  }
  row[CH_RATE] = 2 * collisions / ((double)m->n * h.root);
  row[CH_LOSS] = loss * m->stress_unit / (m->volume * in->elapsed);
  row[CH_GIVEN] = given * m->stress_unit / (m->volume * in->elapsed);
  row[CH_ZETA] = 2 * h.growth / gg_common_model_nu0(m, 1);
  double unit = m->stress_unit / (m->volume * h.first);
  row[CH_PC_XX] = p[0][0] * unit, row[CH_PC_YY] = p[1][1] * unit, row[CH_PC_ZZ] = p[2][2] * unit;
  row[CH_PC_XY] = p[0][1] * unit, row[CH_PC_YX] = p[1][0] * unit;
}

/* The mean speed over an interval, over that at its end: the rate is that of the interval, and a free path the ratio
 * of both. 1 if the temperature is constant, and in free cooling, where both are scaled by that of their own time. */
static double speed_during(const rheology *r, double T0, double T1, double dt)
{
  if (gg_model_keeps_temperature(r->model) || gg_flow_cools(r->model->flow) || !(T0 > 0 && T1 > 0)) return 1;
  return gg_cooling_interval_of(T0, T1, dt).root / (dt * sqrt(T1));
}

/* Direction along x of the force of the gas on a wall: moving walls are dragged back, walls at rest resist gravity. */
static double drag_of(const gg_model *m, const gg_surface *wall)
{
  double ahead = wall->velocity.x != 0 ? -wall->velocity.x : m->gravity[0];
  return ahead > 0 ? 1 : -1;
}

/* Energy supplied to and removed from the grains between this sample and the one before. The work of gravity by the
 * trapezoidal rule: momenta change little from sample to sample. */
static void put_energy(rheology *r, const gg_interval *in, double *row)
{
  const gg_model *m = r->model;
  const double g[2] = {m->gravity[0], m->gravity[1]};
  double energy = m->walled || m->frame ? r->energy : energy_of_moments(r), f = in->velocity_factor;
  double work = 0, loss = 0, drag = 0, push = 0, heat = 0;
  if (in->elapsed > 0) {
    double unit = m->stress_unit / (m->volume * in->elapsed);
    for (int w = 0; w < m->n_surfaces; w++) {
      const gg_surface *wall = &m->surface[w];
      const gg_surface_sums *sums = &in->transfer->surface[w];
      loss += sums->loss, heat += 0.5 * wall->side * sums->loss;
      work -= sums->impulse[0] * wall->velocity.x;
      drag += drag_of(m, wall) * sums->impulse[0], push += wall->side * sums->impulse[wall->axis];
    }
    for (int a = 0; a < 2; a++) work += 0.5 * g[a] * (r->momentum[a] + f * r->memory.momentum[a]) * in->elapsed;
    if (m->frame) work = -in->model->shear_rate * r->shear_stress * in->elapsed;
    work += r->torque_power * in->elapsed;
    row[CH_GROWTH] = (energy - f * f * r->memory.energy) * unit;
    row[CH_WALL_LOSS] = loss * unit, row[CH_WALL_WORK] = work * unit;
    row[CH_WALL_DRAG] = drag * unit, row[CH_WALL_PUSH] = push * unit;
    row[CH_WALL_HEAT] = heat * unit * m->box[1];
  }
  r->memory.energy = energy;
  memcpy(r->memory.momentum, r->momentum, sizeof r->memory.momentum);
}

/* The balance has the power of drag at the sample; that of the interval is, by the trapezoidal rule, half its change
 * less. In a steady window changes cancel; in a gas that cools or heats they do not. Both ends have the coefficients of
 * the present model, which a protocol may have changed at the previous sample. */
static void put_drag(rheology *r, const gg_interval *in, double *row)
{
  const double f = in->velocity_factor, before = f * f * gg_measure_rheology_drag(r->memory.dragged, r->model);
  for (int i = 0; i < r->model->n_species; i++) r->memory.dragged[i] = gg_measure_rheology_dragged(row, r->model, i);
  if (in->elapsed > 0) row[CH_GROWTH] -= (gg_measure_rheology_drag(r->memory.dragged, r->model) - before) / 2;
}

static void put_waves(rheology *r, double *row)
{
  if (r->waves.matter_squares > 0)
    gg_measure_long_waves_finish(&r->waves, r->model, &r->memory.density_waves, &r->memory.momentum_waves);
  r->memory.samples++;
  row[CH_DENSITY_WAVES] = r->memory.density_waves, row[CH_MOMENTUM_WAVES] = r->memory.momentum_waves;
}

static void finish(void *self, const gg_interval *in, double *row)
{
  rheology *r = self;
  bool cooling = gg_flow_cools(r->model->flow);
  for (int i = 0; i < r->model->n_species; i++) {
    gg_measure_velocity_moments_centre(&r->moments[i]);
    memcpy(r->memory.mean_spin[i], r->moments[i].mean_spin, sizeof r->memory.mean_spin[i]);
  }
  double T = temperature(r), T0 = r->memory.last_temperature * in->velocity_factor * in->velocity_factor;
  r->memory.last_temperature = T;
  r->memory.log2_scale += log2(in->velocity_factor);
  put_energy(r, in, row);
  put_waves(r, row);
  row[CH_LN_T] = log(T) - 2 * M_LN2 * r->memory.log2_scale;
  row[CH_T2] = cooling ? 1 : T * T;
  double *of_species = row + CH_SPECIES;
  const size_t width = gg_rheology_species_width(r->model);
  for (int i = 0; i < r->model->n_species; i++) put_moments(r, i, cooling ? T : 1, of_species + (size_t)i * width);
  put_drag(r, in, row);
  if (!(in->elapsed > 0)) return; /* the start has no rates */
  const gg_cooling_interval h =
      cooling ? gg_cooling_interval_of(T0, T, in->elapsed) : (gg_cooling_interval){in->elapsed, in->elapsed, 0};
  put_rates(r, in, h, row);
  double during = speed_during(r, T0, T, in->elapsed);
  for (int i = 0; i < r->model->n_species; i++) of_species[(size_t)i * width + CH_SPEED] *= during;
}

static double log_temperature(const double *row)
{
  return row[CH_LN_T];
}

const gg_observable gg_measure_rheology = {
    GG_OBSERVABLE(RHEOLOGY, rheology),
    .create = create,
    .destroy = free,
    .memory = memory_of,
    .rows = &(const gg_observable_rows){.width = width,
                                        .begin = begin,
                                        .wants_positions = wants_positions,
                                        .add_chunk = add_chunk,
                                        .add_blocks = add_blocks,
                                        .finish = finish,
                                        .derived = gg_measure_rheology_derived,
                                        .history = gg_measure_rheology_history,
                                        .log_temperature = log_temperature},
};
