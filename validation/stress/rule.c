/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rule.h"

#include <math.h>

#include "common/thermostat.h"

void rule_note(void *context, const gg_collision_event *event)
{
  rule_watch *w = context;
  w->event = *event;
  w->seen++;
}

static gg_vec vector(const double v[3])
{
  return (gg_vec){v[0], v[1], v[2]};
}

static double length(gg_vec v)
{
  return sqrt(gg_dot(v, v));
}

/* Keep the largest departure; NaN counts as infinite. */
static void note(rule_watch *w, double departure)
{
  if (!(departure <= w->worst)) w->worst = isnan(departure) ? INFINITY : departure;
}

/* Check one grain: its velocity changes by the impulse alone, its spin by the impulse's torque. */
static void check_grain(rule_watch *w, const sample *before, const sample *after, int which, double speed)
{
  const gg_collision_event *e = &w->event;
  const size_t at = 3 * e->grain[which];
  const int kind = e->species[which];
  const gg_model *m = w->model;
  const double dt = after->state.time - before->state.time, d = m->diameter[kind], sign = which ? 1 : -1;
  const double inertia = m->inertia[kind] * m->mass[kind] * d * d / 4;
  gg_vec c = vector(before->velocity + at), k = vector(e->k), J = vector(e->impulse), kJ = gg_cross(k, J);
  c.x -= m->shear_rate * dt * c.y;
  const gg_vec kick = gg_sub(gg_scale(m->mass[kind], gg_sub(vector(after->velocity + at), c)), gg_scale(sign, J));
  note(w, length(kick) / (m->mass[kind] * speed));
  const gg_vec spin = vector(before->spin + at), turn = gg_sub(vector(after->spin + at), spin);
  if (m->rule == GG_SMOOTH)
    note(w, length(turn) / speed);
  else /* same sign for both grains: J and its lever arm change sign together */
    note(w, length(gg_axpy(0.5 * d / inertia, kJ, turn)) * 0.5 * d / (speed + 0.5 * d * length(spin)));
}

/* Check the tangential impulse against the relative velocity of the surfaces: sticking or sliding contact. */
static void check_tangential(rule_watch *w, const sample *before, double speed)
{
  const gg_collision_event *e = &w->event;
  const gg_model *m = w->model;
  const int i = e->species[0], j = e->species[1], pair = gg_pair(i, j);
  const gg_vec k = vector(e->k), J = vector(e->impulse), c12 = vector(e->velocity);
  const gg_vec s = gg_axpy(0.5 * m->diameter[i], vector(before->spin + 3 * e->grain[0]),
                           gg_scale(0.5 * m->diameter[j], vector(before->spin + 3 * e->grain[1])));
  const gg_vec g = gg_sub(c12, gg_cross(k, s)), gt = gg_axpy(-gg_dot(k, g), k, g);
  const double Jn = gg_dot(k, J), im = 1 / m->mass[i] + 1 / m->mass[j];
  const double imt = im + 1 / (m->inertia[i] * m->mass[i]) + 1 / (m->inertia[j] * m->mass[j]);
  const gg_vec Jt = gg_axpy(-Jn, k, J);
  const double stuck = (1 + m->beta[pair]) / imt * length(gt), slid = m->mu[pair] * Jn;
  const double wanted = m->mu[pair] == 0 || m->beta[pair] == -1 ? 0 : fmin(stuck, slid);
  const double along = length(gt) > 0 ? gg_dot(Jt, gt) / length(gt) : 0;
  note(w, fabs(along - wanted) * im / (speed + length(s)));
  note(w, length(gg_axpy(length(gt) > 0 ? -along / length(gt) : 0, gt, Jt)) * im / (speed + length(s)));
}

void rule_check(rule_watch *w, const sample *before, const sample *after)
{
  const gg_collision_event *e = &w->event;
  const gg_model *m = w->model;
  if (w->seen != 1) return;
  const int i = e->species[0], j = e->species[1];
  /* Rounding errors scale with the largest velocities in the box. */
  const double flow = m->shear_rate * m->box[1], walls = m->n_surfaces ? length(m->surface[0].velocity) : 0;
  const double thermal = sqrt(after->translation / (double)after->n / fmin(m->mass[i], m->mass[j]));
  const double speed = length(vector(e->velocity)) + thermal + flow + walls;
  const double im = 1 / m->mass[i] + 1 / m->mass[j], gn = e->normal_speed;
  const double departure = gg_dot(vector(e->k), vector(e->impulse)) * im - (1 + m->e[gg_pair(i, j)]) * gn;
  const double treated = gg_dot(vector(e->k), vector(e->impulse)) * im - 2 * gn;
  const bool is_treated = m->contact_time > 0 && fabs(treated) < fabs(departure);
  if (!m->law.name) note(w, fabs(is_treated ? treated : departure) / speed);
  if (gg_common_heat_of(m) != GG_UNHEATED || m->walled) return; /* not only collisions change velocities */
  check_grain(w, before, after, 0, speed);
  check_grain(w, before, after, 1, speed);
  if (!is_treated && m->rule != GG_SMOOTH) check_tangential(w, before, speed);
}
