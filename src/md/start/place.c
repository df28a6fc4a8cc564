/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Positions without overlaps, at any solid fraction: random points are sorted along a space-filling curve and pushed
 * apart pair by pair until no two are closer than their contact distance (the overlap-removing relaxation of Jodrey &
 * Tory, Phys. Rev. A 32 (1985) 2347, all pairs in a sweep). The result is amorphous: a fluid configuration where a
 * fluid exists. */
#include <math.h>

#include "base/memory.h"
#include "common/portable_math.h"
#include "common/surface/shapes.h"
#include "md/start/place.h"

enum { GRAINS_PER_POLL = 1 << 13 }; /* some milliseconds */

/* A sweep pushes apart every pair closer than (1 + margin) contact distances, and counts real overlaps. */
typedef struct sweep {
  gg_md_packing *p;
  double margin;
  bool pushing, checking; /* checking: validate given positions, without moving them */
  uint64_t overlaps;
  gg_status status;
  uint32_t pair[2]; /* first two grains that overlap */
  double distance;  /* of their centres */
} sweep;

static void try_pair(sweep *s, uint32_t i, uint32_t j)
{
  gg_md_packing *p = s->p;
  gg_vec dr = gg_sub(p->r[j], p->r[i]), unused = {0, 0, 0};
  gg_md_minimum_image(&p->box, p->box.offset0 != 0, 0, &dr, &unused);
  double sigma = 0.5 * (p->diameter[i] + p->diameter[j]), wanted = sigma * (1 + s->margin), r2 = gg_dot(dr, dr);
  if (r2 >= wanted * wanted) return;
  double distance = sqrt(r2);
  if (s->checking && distance < sigma * (1 - GG_MD_TOUCHING) && !s->overlaps++)
    s->pair[0] = i, s->pair[1] = j, s->distance = distance;
  if (!s->checking && distance < sigma * (1 + GG_MD_TOUCHING)) s->overlaps++;
  if (!s->pushing) return;
  if (distance == 0) dr = (gg_vec){1e-3, 0, 0}, distance = 1e-3;
  double push = 0.5 * (wanted - distance) / distance;
  p->r[i] = gg_axpy(-push, dr, p->r[i]);
  p->r[j] = gg_axpy(push, dr, p->r[j]);
}

gg_status gg_md_place_interrupted(gg_error *err)
{
  return gg_base_fail(err, GG_INTERRUPTED, "md: interrupted while grains were placed");
}

/* Poll `stop` once in some grains, counted over all sweeps, so that small systems are never interrupted. */
static bool is_stopped(sweep *s)
{
  if (++s->p->tried % GRAINS_PER_POLL == 0 && gg_md_place_is_stopped(s->p)) s->status = GG_INTERRUPTED;
  return s->status != GG_OK;
}

static void sweep_small(sweep *s)
{
  for (uint32_t i = 0; i < s->p->n && !is_stopped(s); i++)
    for (uint32_t j = 0; j < i; j++) try_pair(s, i, j);
}

static void cell_of(const gg_md_cells *c, gg_vec r, int32_t at[3])
{
  for (int a = 0; a < 3; a++) {
    int32_t k = (int32_t)(gg_along(&r, a) * c->inverse[a]);
    at[a] = k < c->n[a] ? k : c->n[a] - 1;
  }
}

/* Cell along x beside a position in the layer above or below, where images may be displaced. */
static int32_t column_of(const gg_md_packing *p, gg_vec r, const int32_t at[3], int32_t layer)
{
  const int32_t y = at[1] + layer;
  if (p->box.offset0 == 0 || (y >= 0 && y < p->cells.n[1])) return at[0];
  int32_t to[3];
  const double x = r.x - (y < 0 ? -1 : 1) * p->box.offset0;
  cell_of(&p->cells, (gg_vec){gg_wrap(x, p->box.edge[0], p->box.inverse[0]), r.y, r.z}, to);
  return to[0];
}

static void sweep_cells(sweep *s)
{
  gg_md_packing *p = s->p;
  gg_md_cells *c = &p->cells;
  gg_md_cells_clear(c);
  int32_t at[3], to[3];
  for (uint32_t i = 0; i < p->n && !is_stopped(s); i++) {
    cell_of(c, p->r[i], at);
    for (int32_t q = 0; q < 27; q++) {
      int32_t step[3] = {q % 3 - 1, q / 3 % 3 - 1, q / 9 - 1};
      for (int a = 0; a < 3; a++) {
        to[a] = (a == 0 ? column_of(p, p->r[i], at, step[1]) : at[a]) + step[a];
        to[a] += to[a] < 0 ? c->n[a] : to[a] >= c->n[a] ? -c->n[a] : 0;
      }
      const uint32_t *cell = gg_md_cell_at(c, to);
      for (uint32_t k = 1; k <= cell[0]; k++) try_pair(s, i, cell[k]);
    }
    while (!gg_md_cell_add(c, at, i))
      if (!gg_md_cells_grow(c)) {
        s->status = GG_FAILED;
        return;
      }
  }
}

void gg_md_place_into_box(const gg_md_packing *p, uint32_t i)
{
  for (int a = 0; a < 3; a++) {
    double *x = gg_component(&p->r[i], a), edge = p->box.edge[a], radius = 0.5 * p->diameter[i];
    if (p->box.inverse[a] == 0) {
      if (*x < radius) *x = radius;
      if (*x > edge - radius) *x = edge - radius;
    } else {
      *x = gg_wrap(*x, edge, p->box.inverse[a]);
      if (!(*x < edge)) *x = 0;
    }
  }
  for (int w = 0; w < p->model->n_surfaces; w++)
    gg_surface_put_outside(&p->model->surface[w], 0.5 * p->diameter[i], &p->r[i]);
}

static gg_status sweep_all(sweep *s, gg_error *err)
{
  if (s->p->cells.cell)
    sweep_cells(s);
  else
    sweep_small(s);
  if (s->status == GG_INTERRUPTED) return gg_md_place_interrupted(err);
  if (s->status == GG_FAILED) return gg_base_out_of_memory_for(err, "the grid of cells");
  return GG_OK;
}

static gg_status sweep_once(gg_md_packing *p, double margin, bool pushing, bool *free, gg_error *err)
{
  sweep s = {.p = p, .margin = margin, .pushing = pushing};
  for (uint32_t i = 0; i < p->n; i++) gg_md_place_into_box(p, i);
  gg_status status = sweep_all(&s, err);
  *free = s.overlaps == 0;
  return status;
}

gg_status gg_md_place_check(gg_md_packing *p, const uint32_t *id, gg_error *err)
{
  sweep s = {.p = p, .checking = true};
  for (uint32_t i = 0; i < p->n; i++)
    for (int w = 0; w < p->model->n_surfaces; w++) {
      const double inside = -gg_surface_clearance(&p->model->surface[w], &p->r[i], 0.5 * p->diameter[i]);
      if (inside > GG_MD_TOUCHING)
        return gg_base_fail(err, GG_BAD_INPUT, "grain %u overlaps the %s wall by %g d", id[i],
                            p->model->surface[w].word, inside);
    }
  GG_TRY(sweep_all(&s, err));
  if (!s.overlaps) return GG_OK;
  const uint32_t one = id[s.pair[0]], other = id[s.pair[1]];
  return gg_base_fail(err, GG_BAD_INPUT, "grains %u and %u overlap: their centres are %.9g d apart, %.9g d is contact",
                      one < other ? one : other, one < other ? other : one, s.distance,
                      0.5 * (p->diameter[s.pair[0]] + p->diameter[s.pair[1]]));
}

double gg_md_place_margin(double phi)
{
  double room = gg_root(0.64 / phi, 3) - 1;
  return fmin(0.02, fmax(0.25 * room, 1e-4));
}

gg_status gg_md_place_relax(gg_md_packing *p, double margin, int most_sweeps, bool *free, gg_error *err)
{
  *free = false;
  for (int k = 0; k < most_sweeps && !*free; k++) {
    GG_TRY(sweep_once(p, margin, true, free, err));
    if (*free) GG_TRY(sweep_once(p, margin, false, free, err));
  }
  return GG_OK;
}

/* Face-centred lattice, stretched to the box; some sites are left empty at random. */
static const double basis[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};

/* Distance of nearest sites with m[] cubes along the edges. */
static double spacing(const gg_md_box *box, const uint32_t m[3])
{
  double a[3], nearest = INFINITY;
  for (int k = 0; k < 3; k++) a[k] = box->edge[k] / m[k];
  for (int k = 0; k < 3; k++) {
    nearest = fmin(nearest, a[k]);
    nearest = fmin(nearest, 0.5 * sqrt(a[k] * a[k] + a[(k + 1) % 3] * a[(k + 1) % 3]));
  }
  return nearest;
}

/* Choose the numbers of cubes for which nearest sites are farthest apart. */
static void choose_cubes(const gg_md_box *box, uint32_t n, uint32_t best[3])
{
  double widest = 0, edge = gg_root(4 * box->edge[0] * box->edge[1] * box->edge[2] / n, 3);
  uint32_t most[3];
  for (int k = 0; k < 3; k++) most[k] = 2 + (uint32_t)(2 * box->edge[k] / edge);
  for (uint32_t x = 1; x <= most[0]; x++)
    for (uint32_t y = 1; y <= most[1]; y++) {
      uint32_t m[3] = {x, y, (uint32_t)ceil(n / (4.0 * x * y))};
      double wide = spacing(box, m);
      if (wide > widest) widest = wide, best[0] = m[0], best[1] = m[1], best[2] = m[2];
    }
}

void gg_md_place_lattice(const gg_md_box *box, uint32_t n, gg_rng *rng, gg_vec *r)
{
  uint32_t m[3] = {1, 1, 1}, placed = 0, visited = 0;
  choose_cubes(box, n, m);
  uint32_t sites = 4 * m[0] * m[1] * m[2];
  for (uint32_t cube = 0; cube < sites / 4; cube++)
    for (int b = 0; b < 4; b++, visited++) {
      if (gg_rng_below(rng, sites - visited) >= n - placed) continue;
      uint32_t at[3] = {cube % m[0], cube / m[0] % m[1], cube / (m[0] * m[1])};
      for (int a = 0; a < 3; a++) *gg_component(&r[placed], a) = box->edge[a] * (at[a] + basis[b][a] + 0.25) / m[a];
      placed++;
    }
}
