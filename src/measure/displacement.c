/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/displacement.h"

#include <math.h>

#include "measure/diffusion_lags.h"
#include "measure/pairs.h"

/* Without positions; in a run that is followed in time, whose intervals may have any length; or if a fast grain may
 * travel half the shortest edge between two snapshots. */
bool gg_measure_displacement_follows_flights(const gg_model *m)
{
  if (m->homogeneous || m->cuts_steps) return true;
  double lightest = m->mass[0], fast, path;
  for (int k = 1; k < m->n_species; k++) lightest = fmin(lightest, m->mass[k]);
  fast = 5 / sqrt(lightest);
  path = fast / (GG_LAG_SNAPSHOTS / 2.0 * gg_common_model_collision_rate(m, 1));
  return path > 0.5 * fmin(m->box[0], fmin(m->box[1], m->box[2]));
}

size_t gg_measure_displacement_bytes(const gg_model *m)
{
  const size_t doubles = gg_measure_displacement_follows_flights(m) ? 13 : 9;
  return (size_t)m->n * (doubles * sizeof(double) + sizeof(uint32_t));
}

void *gg_measure_displacement_bind(gg_displacement *d, const gg_model *m, void *memory)
{
  double *at = memory;
  *d = (gg_displacement){.model = m, .n = (size_t)m->n};
  for (int a = 0; a < 3; a++) {
    double **arrays[] = {&d->r[a], &d->c[a], &d->moved[a]};
    for (int k = 0; k < 3; k++, at += d->n) *arrays[k] = at;
  }
  if (gg_measure_displacement_follows_flights(m)) {
    for (int a = 0; a < 3; a++, at += d->n) d->flown[a] = at;
    d->until = at;
    at += d->n;
  }
  d->place = (uint32_t *)at;
  return d->place + d->n;
}

bool gg_measure_displacement_is_valid(const gg_displacement *d)
{
  for (size_t i = 0; i < d->n; i++)
    if (d->place[i] >= d->n) return false;
  return true;
}

/* Displacement since the snapshot `dt` ago: of all images of the new place the one nearest to `path`. */
static gg_vec displacement(const gg_displacement *d, const gg_images *b, gg_vec from, gg_vec to, gg_vec path, double dt)
{
  double rate = d->model->shear_rate;
  gg_vec move = gg_sub(to, from);
  double layers = gg_round_half((move.y - path.y) * b->inverse[1]);
  move.y -= layers * b->edge[1];
  move.x -= layers * b->offset + rate * (from.y + 0.5 * move.y - 0.5 * b->edge[1]) * dt;
  move.x -= b->edge[0] * gg_round_half((move.x - path.x) * b->inverse[0]);
  move.z -= b->edge[2] * gg_round_half((move.z - path.z) * b->inverse[2]);
  return move;
}

/* The peculiar displacement of a flight that ends with `c`: back from there C_x grows by the shear rate times C_y.
 * Kicks of white noise within a flight are neglected: an error below half an edge leads to the right image. */
static void fly(gg_displacement *d, size_t g, gg_vec c, double now)
{
  double t = now - d->until[g];
  d->flown[0][g] += (c.x + 0.5 * d->model->shear_rate * c.y * t) * t;
  d->flown[1][g] += c.y * t;
  d->flown[2][g] += c.z * t;
  d->until[g] = now;
}

/* Estimate of the displacement since the last snapshot from the velocities. */
static gg_vec estimated_path(gg_displacement *d, size_t g, gg_vec c, const gg_snapshot *s)
{
  if (d->until) {
    fly(d, g, c, s->time);
    return (gg_vec){d->flown[0][g], d->flown[1][g], d->flown[2][g]};
  }
  return gg_scale(0.5 * s->elapsed, gg_add((gg_vec){d->c[0][g], d->c[1][g], d->c[2][g]}, c));
}

static size_t number_of(const gg_snapshot *s, size_t i)
{
  return s->id ? (size_t)s->id[i] : i;
}

static void give_places(gg_displacement *d, const gg_snapshot *s)
{
  uint32_t next[GG_MAX_SPECIES] = {0};
  for (int k = 1; k < d->model->n_species; k++) next[k] = next[k - 1] + (uint32_t)d->model->n_of[k - 1];
  for (size_t i = 0; i < s->n; i++) d->place[number_of(s, i)] = next[gg_snapshot_species(s, i)]++;
}

void gg_measure_displacement_collide(gg_displacement *d, const gg_collision_record *collision)
{
  if (!d->until) return;
  for (int i = 0; i < 2; i++) fly(d, d->place[collision->id[i]], collision->c[i], collision->time);
}

void gg_measure_displacement_rescaled(gg_displacement *d, double factor)
{
  for (int a = 0; a < 3; a++)
    for (size_t g = 0; g < d->n; g++) d->c[a][g] *= factor;
  for (size_t g = 0; d->until && g < d->n; g++) d->until[g] /= factor;
}

void gg_measure_displacement_take(gg_displacement *d, const gg_snapshot *s, bool first)
{
  const bool placed = !d->model->homogeneous;
  gg_images b = {0};
  if (placed) b = gg_measure_pairs_images(s);
  if (first) give_places(d, s);
  for (size_t i = 0; i < s->n; i++) {
    size_t g = d->place[number_of(s, i)];
    const gg_vec c = {s->c[0][i], s->c[1][i], s->c[2][i]},
                 to = placed ? (gg_vec){s->r[0][i], s->r[1][i], s->r[2][i]} : (gg_vec){0, 0, 0};
    gg_vec move = {0, 0, 0};
    if (!first && !placed)
      move = estimated_path(d, g, c, s);
    else if (!first)
      move =
          displacement(d, &b, (gg_vec){d->r[0][g], d->r[1][g], d->r[2][g]}, to, estimated_path(d, g, c, s), s->elapsed);
    const double step[3] = {move.x, move.y, move.z};
    for (int a = 0; a < 3; a++) {
      if (placed) d->r[a][g] = s->r[a][i];
      d->c[a][g] = s->c[a][i];
      d->moved[a][g] = first ? 0 : d->moved[a][g] + step[a];
      if (d->until) d->flown[a][g] = 0;
    }
    if (d->until) d->until[g] = s->time;
  }
}

double gg_measure_displacement_temperature(const gg_displacement *d)
{
  double sum = 0;
  size_t from = 0;
  for (int k = 0; k < d->model->n_species; k++) {
    const size_t to = from + (size_t)d->model->n_of[k];
    for (int a = 0; a < 3; a++)
      for (size_t g = from; g < to; g++) sum += d->model->mass[k] * d->c[a][g] * d->c[a][g];
    from = to;
  }
  return sum / (3 * (double)d->n);
}

double gg_measure_displacement_path(double before, double now, double time)
{
  const double fall = before - now;
  if (fabs(fall) < 1e-5 * before) return time * sqrt(before * now); /* off by a part in 1e11 */
  return time * before * now * log(before / now) / fall;
}
