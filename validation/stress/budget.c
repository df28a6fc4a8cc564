/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "budget.h"

#include <math.h>

#include "common/thermostat.h"
#include "rule.h"

/* Work of the shear on the grains since `before`. It is exact for md, whose grains fly freely between collisions. */
static double work_of_shear(const gg_simulation *g, const sample *before, const sample *after)
{
  const double rate = g->model.shear_rate, dt = after->state.time - before->state.time;
  if (g->model.ensemble) return -rate * 0.5 * (before->xy + after->xy) * dt;
  return -rate * (before->xy * dt - 0.5 * rate * before->yy * dt * dt);
}

/* Work of gravity since `before`. Displacements along x and z are minimum images: grains may cross these faces. */
static double work_of_gravity(const gg_simulation *g, const sample *before, const sample *after)
{
  double work = 0;
  for (size_t i = 0; before->position && i < before->n; i++)
    for (size_t a = 0; a < 3; a++) {
      double way = after->position[3 * i + a] - before->position[3 * i + a];
      if (a != 1) way -= g->model.box[a] * rint(way / g->model.box[a]);
      work += g->model.mass[before->species[i]] * g->model.gravity[a] * way;
    }
  return work;
}

/* Collisional work of the shear and work of the walls, minus the losses in collisions. */
static double gain_in_contacts(const gg_simulation *g, const gg_simulation_sums *sums)
{
  const double per = g->model.volume * sums->time / g->model.stress_unit;
  double gain = -g->model.shear_rate * sums->collisional_stress[1][0] * per - sums->dissipation * per - sums->wall_loss;
  for (int w = 0; w < g->model.n_surfaces; w++) {
    const gg_vec v = g->model.surface[w].velocity;
    const double *J = sums->wall_impulse[w];
    gain -= J[0] * v.x + J[1] * v.y + J[2] * v.z;
  }
  return gain;
}

static void swap(sample *a, sample *b)
{
  const sample c = *a;
  *a = *b;
  *b = c;
}

/* Square of the error of the work in one step. dsmc collides in the middle of a step, but the work is computed from the
 * samples at its ends; a collision changes sum m C_x C_y by about T, with either sign. */
static double uncertainty(const gg_simulation *g, const sample *before, const sample *after)
{
  const double strain = g->model.shear_rate * (after->state.time - before->state.time);
  const double energy = after->translation + after->rotation, each = 10 * strain * energy / (double)after->n;
  return g->model.ensemble ? each * each : 0;
}

/* Allowed relative error of the energy. The Gaussian thermostat of dsmc returns in a step the energy that collisions
 * lost in the step before. */
static double rounding(const gg_simulation *g, int steps)
{
  if (g->model.ensemble && gg_common_heat_of(&g->model) == GG_HEAT_SCALES) return 1 / sqrt((double)g->model.n);
  return g->model.single ? 1e-4 : 1e-12 * (1 + steps);
}

gg_status budget_follow(gg_simulation *g, sample *before, sample *after, int steps, budget *b, gg_error *err)
{
  const gg_heat heat = gg_common_heat_of(&g->model);
  gg_simulation_sums sums;
  rule_watch watch = {.model = &g->model};
  GG_TRY(gg_simulation_take_sums(g, &sums, err));
  if (!g->model.ensemble) GG_TRY(gg_simulation_on_collision(g, rule_note, &watch, err));
  sample_take(before, g);
  const double energy = before->translation + before->rotation, kinetic = before->translation;
  double work = 0, off = 0, most = energy;
  *b = (budget){.in_time = true};
  for (int k = 0; k < steps; k++) {
    watch.seen = 0;
    GG_TRY(gg_simulation_collide(g, 1, err));
    sample_take(after, g);
    work += work_of_shear(g, before, after) + work_of_gravity(g, before, after);
    if (!(after->state.time >= before->state.time)) b->in_time = false;
    if (!g->model.ensemble && after->state.collisions != before->state.collisions + 1) b->in_time = false;
    rule_check(&watch, before, after);
    off += uncertainty(g, before, after);
    most = fmax(most, after->translation + after->rotation);
    swap(before, after);
  }
  GG_TRY(gg_simulation_take_sums(g, &sums, err));
  if (!g->model.ensemble) GG_TRY(gg_simulation_on_collision(g, NULL, NULL, err));
  b->energy_allowed = rounding(g, steps) + 6 * sqrt(off) / most;
  b->rule = watch.worst;
  const double change = before->translation + before->rotation - energy;
  /* dsmc has no x and z, which the work of this gravity needs. */
  const bool slides = g->model.gravity[0] != 0 || g->model.gravity[2] != 0;
  if (g->model.ensemble && slides)
    b->energy = NAN;
  else if (heat == GG_UNHEATED)
    b->energy = fabs(change - work - gain_in_contacts(g, &sums)) / most;
  else
    b->energy = heat == GG_HEAT_SCALES ? fabs(before->translation / kinetic - 1) : NAN;
  return GG_OK;
}
