/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

#define GRAINS_PER_CELL 2.0 /* on average: fewer cost more lookups, more cost pairs that are out of reach */

double gg_measure_pairs_longest_reach(const gg_model *m)
{
  return fmin(fmin(m->box[0], m->box[1]), m->box[2]) / 2;
}

/* Number of tries a grain if all pairs of cells up to `whole` are taken; the image above is not displaced. */
static double tries(gg_pairs *p, const gg_images *b, double whole)
{
  const size_t cells = gg_pairs_cells(p);
  double sum = 0;
  p->whole = whole;
  for (size_t i = 0; i < cells; i++) {
    gg_pairs_offset o = gg_measure_pairs_offset_of(p, b, i);
    sum += i ? o.share : 0.5;
  }
  return sum * (double)p->n / (double)cells;
}

static void choose_radius(gg_pairs *p, const gg_model *m, double budget)
{
  gg_snapshot none = {.model = m};
  gg_images b = gg_measure_pairs_images(&none);
  double low = 0, high = b.edge[0] + b.edge[1] + b.edge[2];
  if (tries(p, &b, INFINITY) <= budget) return;
  for (int k = 0; k < 16; k++) {
    double middle = 0.5 * (low + high);
    *(tries(p, &b, middle) <= budget ? &low : &high) = middle;
  }
  p->whole = low;
}

gg_status gg_measure_pairs_init(gg_pairs *p, const gg_model *m, double reach, double budget, double fall, gg_error *err)
{
  double slant = gg_model_is_sheared(m) ? hypot(1, 0.5 * m->box[0] / m->box[1]) : 1;
  double width = cbrt(GRAINS_PER_CELL * m->volume / (double)m->n);
  *p = (gg_pairs){.reach = reach, .fall = fall, .n = (size_t)m->n};
  for (int a = 0; a < 3; a++) p->cells[a] = (int)fmax(fmin(floor(m->box[a] / (a == 0 ? slant : 1) / width), 1024), 1);
  p->start = gg_base_array_new(gg_pairs_cells(p) + 1, sizeof *p->start, err);
  p->grain = gg_base_array_new(p->n, sizeof *p->grain, err);
  p->cell = gg_base_array_new(p->n, sizeof *p->cell, err);
  p->at = gg_base_array_new(p->n, sizeof *p->at, err);
  if (p->start && p->grain && p->cell && p->at) {
    choose_radius(p, m, budget);
    return GG_OK;
  }
  gg_measure_pairs_clear(p);
  return GG_FAILED;
}

void gg_measure_pairs_clear(gg_pairs *p)
{
  free(p->start);
  free(p->grain);
  free(p->cell);
  free(p->at);
  *p = (gg_pairs){0};
}

gg_images gg_measure_pairs_images(const gg_snapshot *s)
{
  gg_images b = {.offset = gg_model_is_sheared(s->model) ? s->offset : 0};
  for (int a = 0; a < 3; a++) b.edge[a] = s->model->box[a], b.inverse[a] = 1 / b.edge[a];
  b.offset -= b.edge[0] * gg_round_half(b.offset * b.inverse[0]);
  return b;
}

static int index_of(double share, int n)
{
  int k = (int)((share - floor(share)) * n);
  return k < n ? k : n - 1;
}

void gg_measure_pairs_sort(gg_pairs *p, const gg_snapshot *s, const gg_images *b)
{
  size_t cells = gg_pairs_cells(p);
  memset(p->start, 0, (cells + 1) * sizeof *p->start);
  for (size_t i = 0; i < s->n; i++) {
    double y = s->r[1][i] * b->inverse[1], x = (s->r[0][i] - b->offset * y) * b->inverse[0];
    int cx = index_of(x, p->cells[0]), cy = index_of(y, p->cells[1]);
    int cz = index_of(s->r[2][i] * b->inverse[2], p->cells[2]);
    p->cell[i] = (uint32_t)((cz * p->cells[1] + cy) * p->cells[0] + cx);
    p->start[p->cell[i]]++;
  }
  uint32_t end = 0;
  for (size_t c = 0; c <= cells; c++) {
    end += c < cells ? p->start[c] : 0;
    p->start[c] = end;
  }
  for (size_t i = s->n; i-- > 0;) {
    uint32_t at = --p->start[p->cell[i]];
    p->grain[at] = (uint32_t)i;
    p->at[at] = (gg_vec){s->r[0][i], s->r[1][i], s->r[2][i]};
  }
}

gg_rng gg_measure_pairs_stream(const gg_snapshot *s)
{
  uint64_t time, place;
  memcpy(&time, &s->time, sizeof time);
  memcpy(&place, s->r[0], sizeof place);
  return gg_common_rng_seed(time ^ gg_rotl(place, 32), s->collisions);
}

/* The shortest of the vectors between the middles of two such cells. */
static gg_vec middle_to_middle(const gg_images *b, gg_vec d)
{
  gg_vec shortest = {0, 0, 0};
  double least = INFINITY;
  d = gg_nearest_separation(b, d);
  for (int layer = -1; layer <= 1; layer++) {
    gg_vec e = {d.x + layer * b->offset, d.y + layer * b->edge[1], d.z};
    e.x -= b->edge[0] * gg_round_half(e.x * b->inverse[0]);
    if (gg_dot(e, e) >= least) continue;
    shortest = e;
    least = gg_dot(e, e);
  }
  return shortest;
}

/* True if two cells overlap along an axis, given the lengths across. */
static bool is_along(double one, double width_one, double two, double width_two)
{
  return fabs(one) < width_one && fabs(two) < width_two;
}

static double share_at(const gg_pairs *p, gg_vec d, gg_vec width)
{
  double r = sqrt(gg_dot(d, d));
  if (r > p->reach + sqrt(gg_dot(width, width))) return 0; /* no two grains of these cells are in reach */
  if (r <= p->whole) return 1;
  bool along = is_along(d.y, width.y, d.z, width.z) || is_along(d.x, width.x, d.z, width.z) ||
               is_along(d.x, width.x, d.y, width.y);
  return fmax(pow(p->whole / r, along ? p->fall - 1 : p->fall), 1e-6);
}

gg_pairs_offset gg_measure_pairs_offset_of(const gg_pairs *p, const gg_images *b, size_t index)
{
  const int *n = p->cells;
  gg_pairs_offset o = {
      {(int)(index % (size_t)n[0]), (int)(index / (size_t)n[0]) % n[1], (int)(index / (size_t)(n[0] * n[1]))}, 0, 1};
  int back[3];
  for (int a = 0; a < 3; a++) back[a] = (n[a] - o.by[a]) % n[a];
  size_t inverse = ((size_t)back[2] * (size_t)n[1] + (size_t)back[1]) * (size_t)n[0] + (size_t)back[0];
  if (inverse < index) return o;
  gg_vec width = {(b->edge[0] / n[0]) + fabs(b->offset) / n[1], b->edge[1] / n[1], b->edge[2] / n[2]};
  gg_vec d = {o.by[0] * b->edge[0] / n[0] + o.by[1] * b->offset / n[1], o.by[1] * width.y, o.by[2] * width.z};
  o.share = share_at(p, middle_to_middle(b, d), width);
  /* An offset that is its own inverse leads to every pair from both sides. */
  o.weight = (inverse == index && index > 0 ? 0.5 : 1) / fmax(o.share, 1e-300);
  return o;
}
