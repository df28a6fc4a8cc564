/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md_test.h"

#include <stdlib.h>
#include <string.h>

#include "common/model.h"
#include "common/surface/shapes.h"
#include "scene/model_of_scene.h"

gg_scene md_scene(md_case c)
{
  gg_scene s = gg_scene_defaults();
  s.flow = c.flow;
  s.particles = c.n;
  s.phi = c.phi;
  s.md.contact_time = 1e-4;
  for (int p = 0; p < GG_PAIRS; p++) {
    s.collision.e[p] = c.e;
    s.collision.beta[p] = c.beta;
    s.collision.mu[p] = c.mu;
  }
  for (int a = 0; a < 3; a++) s.aspect[a] = c.aspect[a] > 0 ? c.aspect[a] : 1;
  return s;
}

gg_model md_model_of(const gg_scene *s)
{
  gg_model m;
  gg_error err = {0};
  if (gg_scene_model_make(s, GG_MD, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

gg_model md_model(md_case c)
{
  gg_scene s = md_scene(c);
  return md_model_of(&s);
}

gg_md *md_create(const gg_model *model, uint64_t seed)
{
  gg_engine *engine = NULL;
  gg_error err = {0};
  if (gg_md_ops.create(model, seed, 0, &engine, &err) != GG_OK) fail_msg("%s", err.message);
  return (gg_md *)engine;
}

void md_destroy(gg_md *e)
{
  gg_md_ops.destroy(&e->base);
}

double md_collide(gg_md *e, uint64_t collisions)
{
  double elapsed;
  gg_error err = {0};
  if (gg_md_ops.advance(&e->base, INFINITY, collisions, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
  return elapsed;
}

/* FNV-1a. */
uint64_t md_mix(uint64_t h, const void *data, size_t bytes)
{
  const uint8_t *p = data;
  for (size_t k = 0; k < bytes; k++) h = (h ^ p[k]) * 0x100000001b3u;
  return h;
}

uint64_t md_hash(const gg_md *e)
{
  uint64_t h = 0xcbf29ce484222325u;
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_md_grain *g = &e->grain[i];
    const uint32_t both = 2 * g->counter + g->species; /* the form that the stored hashes were made with */
    h = md_mix(h, &g->r, sizeof g->r + sizeof g->v + sizeof g->t);
    h = md_mix(h, &both, sizeof both);
    h = md_mix(h, &e->node[i].time, 2 * sizeof(double));
    if (e->spin) h = md_mix(h, &e->spin[i], sizeof e->spin[i]);
  }
  h = md_mix(h, &e->k.now, sizeof e->k.now);
  return md_mix(h, &e->k.collisions, sizeof e->k.collisions);
}

typedef struct separation {
  long double r[3], v[3]; /* of j relative to i; images one box higher move with image_velocity */
  long double offset, image_velocity;
} separation;

/* The place and velocity of a grain now. */
static void place_now(const gg_md *e, const gg_md_grain *g, long double r[3], long double v[3])
{
  long double dt = (long double)e->k.now - g->t;
  for (int k = 0; k < 3; k++) {
    long double w = gg_along(&e->gravity, k);
    r[k] = gg_along(&g->r, k) + gg_along(&g->v, k) * dt + w * dt * dt / 2;
    v[k] = gg_along(&g->v, k) + w * dt;
  }
}

static separation separate(const gg_md *e, uint32_t i, uint32_t j)
{
  separation s = {.image_velocity = e->box.image_velocity,
                  .offset = e->box.offset0 + (long double)e->box.image_velocity * e->k.now};
  long double r[3], v[3];
  place_now(e, &e->grain[i], r, v);
  place_now(e, &e->grain[j], s.r, s.v);
  for (int k = 0; k < 3; k++) s.r[k] -= r[k], s.v[k] -= v[k];
  return s;
}

static long double contact(const long double r[3], const long double v[3], long double sigma)
{
  long double a = 0, b = 0, c = -sigma * sigma;
  for (int k = 0; k < 3; k++) a += v[k] * v[k], b += r[k] * v[k], c += r[k] * r[k];
  long double q = b * b - a * c;
  if (b >= 0 || q < 0) return INFINITY;
  long double t = (-b - sqrtl(q)) / a;
  return t > 0 ? t : 0;
}

static long double next_of_pair(const gg_md *e, uint32_t i, uint32_t j, double horizon)
{
  separation s = separate(e, i, j);
  int o = gg_pair(gg_md_species_of(&e->grain[i]), gg_md_species_of(&e->grain[j]));
  long double first = INFINITY, sigma = e->model.sigma[o], L[3];
  for (int k = 0; k < 3; k++) L[k] = e->box.edge[k];
  int ny = 2 + (int)(fabsl(s.v[1]) * horizon / L[1]), nz = 2 + (int)(fabsl(s.v[2]) * horizon / L[2]);
  if (e->model.walled) ny = 0;
  for (int y = -ny; y <= ny; y++) {
    if (fabsl(s.r[1] + y * L[1]) > fabsl(s.v[1]) * horizon + sigma) continue; /* out of reach */
    for (int z = -nz; z <= nz; z++) {
      if (fabsl(s.r[2] + z * L[2]) > fabsl(s.v[2]) * horizon + sigma) continue;
      long double v[3] = {s.v[0] + y * s.image_velocity, s.v[1], s.v[2]}, x0 = s.r[0] + y * s.offset;
      /* Images along x that pass within reach before the horizon. */
      long double span = fabsl(v[0]) * horizon + sigma;
      for (long long x = (long long)((-span - x0) / L[0]) - 1; x <= (long long)((span - x0) / L[0]) + 1; x++) {
        long double r[3] = {x0 + x * L[0], s.r[1] + y * L[1], s.r[2] + z * L[2]}, t = contact(r, v, sigma);
        if (t < first) first = t;
      }
    }
  }
  return first <= horizon ? first : INFINITY;
}

md_prediction md_oracle(const gg_md *e, double horizon)
{
  md_prediction f = {.time = INFINITY};
  for (uint32_t i = 0; i < e->n; i++)
    for (uint32_t j = 0; j < i; j++) {
      long double t = next_of_pair(e, i, j, horizon);
      if (t < f.time) f = (md_prediction){t, {j, i}};
    }
  return f;
}

/* The first t >= 0 with h + v t + w t^2/2 = 0 and h falling, from both roots of the quadratic equation. */
static long double next_touch(long double h, long double v, long double w)
{
  long double root[2] = {-h / v, -h / v}, first = INFINITY, q = v * v - 2 * w * h;
  if (w != 0) {
    if (q < 0) return INFINITY;
    root[0] = (-v - sqrtl(q)) / w, root[1] = (-v + sqrtl(q)) / w;
  }
  for (int k = 0; k < 2; k++)
    if (v + w * root[k] < 0 && root[k] > -1e-13L && root[k] < first) first = root[k] > 0 ? root[k] : 0;
  return first;
}

/* A grain that flies freely from now on. */
typedef struct flight {
  const gg_md *e;
  const gg_surface *surface;
  long double r[3], v[3];
  double radius;
} flight;

/* Distance to contact with a surface of any shape. */
static double clearance_at(const flight *f, double t)
{
  gg_vec r;
  for (int k = 0; k < 3; k++)
    *gg_component(&r, k) = (double)(f->r[k] + f->v[k] * t + (long double)gg_along(&f->e->gravity, k) * t * t / 2);
  return gg_surface_clearance(f->surface, &r, f->radius);
}

/* The time between a and b at which the clearance is least (sign 1) or greatest (-1). */
static double extreme_between(const flight *f, double a, double b, int sign)
{
  for (int k = 0; k < 80; k++) {
    double m = a + 0.382 * (b - a), n = b - 0.382 * (b - a);
    if (sign * clearance_at(f, m) < sign * clearance_at(f, n))
      b = n;
    else
      a = m;
  }
  return 0.5 * (a + b);
}

/* The first time up to the horizon at which the clearance falls below 0. It is searched in steps of a hundredth of a
 * diameter: in each step at whose end it is below 0, or within which its least value may be. */
static double next_touch_of(const flight *f, double horizon)
{
  double speed = 0;
  for (int k = 0; k < 3; k++) speed += fabs((double)f->v[k]) + fabs(gg_along(&f->e->gravity, k)) * horizon;
  int steps = 2 + (int)fmin(speed * horizon / 0.01, 1e6);
  double step = horizon / steps, before = clearance_at(f, 0), now = before;
  for (int k = 1; k <= steps; k++) {
    double t = k * step, after = clearance_at(f, t), end = t;
    if (after > 0 && now <= before && now <= after && now < 1e-3) {
      end = extreme_between(f, fmax(t - 2 * step, 0), t, 1);
      if (k > 1 && clearance_at(f, end) > 0) end = t;
    }
    before = now, now = after;
    if (!(clearance_at(f, end) < 0)) continue;
    double a = extreme_between(f, fmax(end - 2 * step, 0), end, -1), b = end;
    if (clearance_at(f, a) < -1e-12) continue;
    for (int m = 0; m < 100; m++) {
      double middle = 0.5 * (a + b);
      if (clearance_at(f, middle) > 0)
        a = middle;
      else
        b = middle;
    }
    return b;
  }
  return INFINITY;
}

static long double next_contact(const flight *f, double horizon)
{
  const gg_surface *s = f->surface;
  if (s->shape != GG_SHAPE_plane) return next_touch_of(f, horizon);
  long double side = s->side, w = gg_along(&f->e->gravity, s->axis);
  return next_touch(side * (s->place - f->r[s->axis]) - f->radius, -side * f->v[s->axis], -side * w);
}

md_prediction md_oracle_walls(const gg_md *e, double horizon)
{
  md_prediction first = {.time = INFINITY};
  for (uint32_t i = 0; i < e->n; i++)
    for (int w = 0; w < e->model.n_surfaces; w++) {
      flight f = {.e = e, .surface = &e->model.surface[w]};
      f.radius = 0.5 * e->model.diameter[gg_md_species_of(&e->grain[i])];
      place_now(e, &e->grain[i], f.r, f.v);
      long double t = next_contact(&f, horizon);
      if (t < first.time) first = (md_prediction){t, {i, GG_MD_SURFACE(w)}};
    }
  return first;
}

long double md_closest(const gg_md *e)
{
  long double closest = INFINITY;
  for (uint32_t i = 0; i < e->n; i++)
    for (uint32_t j = 0; j < i; j++) {
      separation s = separate(e, i, j);
      int o = gg_pair(gg_md_species_of(&e->grain[i]), gg_md_species_of(&e->grain[j]));
      long double y = e->model.walled ? 0 : rintl(s.r[1] / e->box.edge[1]),
                  r[3] = {s.r[0] - y * s.offset, s.r[1] - y * e->box.edge[1], s.r[2]};
      r[0] -= e->box.edge[0] * rintl(r[0] / e->box.edge[0]);
      r[2] -= e->box.edge[2] * rintl(r[2] / e->box.edge[2]);
      long double d = sqrtl(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / e->model.sigma[o];
      if (d < closest) closest = d;
    }
  return closest;
}

static bool is_in_cell(const gg_md *e, uint32_t i, gg_vec r)
{
  if (e->search.kind == GG_MD_COMOVING_ROWS) { /* the cell moves */
    double L = e->box.edge[0], middle = (e->node[i].cell[0] + 0.5) * e->cells.width[0];
    const gg_md_row *row = &e->search.rows.row[e->node[i].cell[1]];
    r.x -= row->origin + row->speed * e->k.now;
    r.x -= L * rint((r.x - middle) / L);
  }
  for (int a = 0; a < 3; a++) {
    double x = gg_along(&r, a), w = e->cells.width[a], lower = e->node[i].cell[a] * w;
    bool above = gg_common_surface_is_open_above(&e->model) && a == 1 && e->node[i].cell[a] == e->cells.n[a] - 1;
    if (x < lower - 1e-12 * e->box.edge[a] || (x > lower + w + 1e-12 * e->box.edge[a] && !above)) return false;
  }
  return true;
}

/* The x of the grain's image that is in a co-moving row. */
static double along_row(const gg_md *e, int32_t row, gg_vec r)
{
  double layers = rint((r.y - (row + 0.5) * e->cells.width[1]) / e->box.edge[1]);
  return r.x - layers * gg_md_offset(&e->box, e->k.now) - e->search.rows.row[row].origin -
         e->search.rows.row[row].speed * e->k.now;
}

/* Is x where a grain is in one overlapping cell along this axis, or (`both`) in two? The region in which it is also in
 * the next cell begins half a contact distance before that cell. */
static bool is_between(const gg_md *e, int axis, double x, int32_t cell, bool both)
{
  double half = 0.5 * e->cells.reach, w = e->cells.width[axis], L = e->box.edge[axis], room = 1e-12 * L;
  double depth = x - cell * w;
  depth -= L * rint((depth - w) / L);
  return depth > half - room && depth < (1 + both) * w - half + room;
}

static bool is_in_overlapping_cells(const gg_md *e, uint32_t i, gg_vec r)
{
  const gg_md_node *node = &e->node[i];
  uint32_t both = node->neighbours;
  int32_t lower = node->cell[1], upper = (lower + 1) % e->cells.n[1];
  const bool rows = e->search.kind == GG_MD_OVERLAPPING_ROWS;
  for (int a = rows ? 1 : 0; a < 3; a++)
    if (!is_between(e, a, gg_along(&r, a), node->cell[a], both >> a & 1)) return false;
  if (!rows) return true;
  if (!is_between(e, 0, along_row(e, lower, r), node->cell[0], both & 1)) return false;
  return !(both & 2) || is_between(e, 0, along_row(e, upper, r), node->upper, both >> 3 & 1);
}

/* Under shear skins shrink and move; there the search for contacts tests them instead. */
static bool is_in_skin(const gg_md *e, uint32_t i, gg_vec r)
{
  gg_vec dr = gg_sub(r, e->search.lists.skin[i].centre);
  if (e->model.shear_rate == 0 && gg_dot(dr, dr) > e->search.lists.radius * e->search.lists.radius * (1 + 1e-9))
    return false;
  const uint32_t *mine = e->search.lists.neighbour + (size_t)i * GG_MD_LIST;
  for (uint32_t k = 0; k < e->node[i].neighbours; k++) {
    const uint32_t *other = e->search.lists.neighbour + (size_t)mine[k] * GG_MD_LIST;
    bool back = false;
    for (uint32_t m = 0; m < e->node[mine[k]].neighbours; m++) back |= other[m] == i;
    if (!back) return false;
  }
  return true;
}

static bool is_off_surfaces(const gg_md *e, uint32_t i, gg_vec r)
{
  double radius = 0.5 * e->model.diameter[gg_md_species_of(&e->grain[i])], room = 1e-11;
  for (int w = 0; w < e->model.n_surfaces; w++)
    if (!(gg_surface_clearance(&e->model.surface[w], &r, radius) > -room)) return false;
  return true;
}

uint32_t md_misplaced(const gg_md *e)
{
  uint32_t count = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec r = gg_md_position(e, e->falls, &e->grain[i], e->k.now);
    bool in = e->search.kind == GG_MD_NEIGHBOUR_LISTS ? is_in_skin(e, i, r)
              : gg_md_search_overlaps(e->search.kind) ? is_in_overlapping_cells(e, i, r)
                                                      : is_in_cell(e, i, r);
    count += !in || !is_off_surfaces(e, i, r);
  }
  return count;
}

gg_vec md_momentum(const gg_md *e)
{
  gg_vec sum = {0, 0, 0};
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec r = gg_md_position(e, e->falls, &e->grain[i], e->k.now), c = e->grain[i].v;
    c.x -= e->model.shear_rate * (r.y - 0.5 * e->box.edge[1]);
    sum = gg_axpy(e->model.mass[gg_md_species_of(&e->grain[i])], c, sum);
  }
  return sum;
}

double md_energy(const gg_md *e)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    int s = gg_md_species_of(&e->grain[i]);
    double m = e->model.mass[s], K = e->model.inertia[s];
    sum += 0.5 * m * gg_dot(e->grain[i].v, e->grain[i].v);
    if (e->spin) sum += 0.5 * K * m * gg_dot(e->spin[i], e->spin[i]);
  }
  return sum;
}

uint64_t md_hash_all(gg_md *e)
{
  gg_collision_sums sums;
  gg_md_ops.take_sums(&e->base, &sums);
  uint64_t h = md_mix(md_hash(e), &sums, sizeof sums);
  h = md_mix(h, &e->k.events, sizeof e->k.events);
  h = md_mix(h, &e->k.treated, sizeof e->k.treated);
  return md_mix(h, &e->k.worst_overlap, sizeof e->k.worst_overlap);
}
