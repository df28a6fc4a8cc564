/* The search for a grain's next event: the cells around it, image by image, and its own cell's faces.
 *
 * Every neighbouring cell is looked at as one definite image, with its shift, so that boxes of one or two cells across
 * and grains that meet several images of one partner need no special case.
 *
 * Rows across a sheared boundary, of cells at rest in small boxes (else: rows.h): the image row of cells stands at any
 * offset and slides. The grain looks at all of it that can come within reach of its cell until a time `valid`, and
 * looks anew then. What makes incremental scans right: at every scan a grain looks at the whole window of each sliding
 * row, and otherwise neighbourhoods are symmetric. */
#ifndef GG_MD_SCAN_H
#define GG_MD_SCAN_H

#include <string.h>

#include "md/axes.h"
#include "md/predict.h"
#include "md/state.h"

/* What a scene's motion needs; constant in every kernel. */
typedef struct gg_features {
  bool sheared, walled, gravity, mixture;
  bool listed; /* neighbour lists instead of cells */
  bool shared; /* cells that overlap; wide, too */
  bool drifts; /* rows of cells that move with the flow */
  bool inside; /* all in one image of the box, or of drifting rows, but for images along x */
  bool wide;   /* eight pairs at a time; else one by one: the reference for the tests */
} gg_features;

typedef struct gg_search {
  uint32_t grain;
  const gg_grain *self; /* at the present time */
  double collision;     /* earliest so far, and with whom */
  uint32_t partner;
  double valid;           /* until then the sliding rows have been searched */
  bool regular;           /* no image of those to try has slid: of drifting rows */
  bool inside;            /* they and the grain are in the same image of the box */
  uint32_t n_near, *near; /* wide: whom to try */
} gg_search;

/* Bring a grain's record to the present time. */
GG_INLINE gg_grain *gg_settle(gg_md *e, gg_features f, uint32_t i)
{
  gg_grain *g = &e->grain[i];
  g->r = gg_position(e, f.gravity, g, e->k.now);
  g->v = gg_velocity(e, f.gravity, g, e->k.now);
  g->t = e->k.now;
  return g;
}

/* Only what is read before it is written: `near` stays as it is. */
GG_INLINE void gg_begin_search(gg_search *s, uint32_t i, const gg_grain *self, double collision, uint32_t partner)
{
  s->grain = i;
  s->self = self;
  s->collision = collision;
  s->partner = partner;
  s->n_near = 0;
  s->regular = s->inside = false;
}

/* The contact with grain j, which is separated by dr and dv. */
GG_INLINE void gg_try_separated(const gg_md *e, gg_features f, gg_search *s, uint32_t j, gg_vec dr, gg_vec dv)
{
  double sigma = e->model.sigma[f.mixture ? 2 * gg_species_of(s->self) + gg_species_of(&e->grain[j]) : 0];
  double t = e->k.now + gg_contact_delay(dr, dv, sigma * sigma);
  /* Ties go by index, so that the order in a cell's chain never matters. */
  if (t < s->collision || (t == s->collision && t < INFINITY && j < s->partner)) {
    s->collision = t;
    s->partner = j;
  }
}

/* The same with an image shifted by `shift`, sliding by `slide`. */
GG_INLINE void gg_try_pair(const gg_md *e, gg_features f, gg_search *s, uint32_t j, gg_vec shift, double slide)
{
  const gg_grain *one = s->self, *two = &e->grain[j];
  gg_vec dr = gg_add(gg_sub(gg_position(e, f.gravity, two, e->k.now), one->r), shift);
  gg_vec dv = gg_sub(gg_velocity(e, f.gravity, two, e->k.now), one->v);
  if (f.sheared) dv.x += slide;
  gg_try_separated(e, f, s, j, dr, dv);
}

/* All grains of a cell behind the n that there are, eight words at a time: what stands behind its end does not count.
 */
GG_INLINE uint32_t gg_append_cell(uint32_t *near, uint32_t n, const uint32_t *cell)
{
  uint32_t count = cell[0];
  memcpy(near + n, cell + 1, 8 * sizeof *cell);
  for (uint32_t k = 8; k < count; k += 8) memcpy(near + n + k, cell + 1 + k, 8 * sizeof *cell);
  return n + count;
}
/* At the end of a list, of cells of sixteen words or more, line by line: the word behind a line would be another line
 * to wait for. Returns the new end. */
GG_INLINE uint32_t *gg_append_large(uint32_t *end, const uint32_t *cell)
{
  typedef uint32_t line __attribute__((vector_size(64), may_alias, aligned(4)));
  uint32_t count = cell[0];
  line first = *(const line *)cell;
  first = __builtin_shufflevector(first, first, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0);
  memcpy(end, &first, sizeof first);
  for (uint32_t k = 15; k < count; k += 16) memcpy(end + k, cell + 1 + k, sizeof first);
  return end + count;
}
/* Of cells of eight words. */
GG_INLINE uint32_t gg_append_small(uint32_t *near, uint32_t n, const uint32_t *cell)
{
  memcpy(near + n, cell + 1, 8 * sizeof *cell);
  return n + cell[0];
}

/* False: no more room. */
GG_INLINE bool gg_take_cell(gg_search *s, const uint32_t *cell)
{
  if (s->n_near + cell[0] > GG_MOST_NEAR) return false;
  s->n_near = gg_append_cell(s->near, s->n_near, cell);
  return true;
}

/* Cells from..to (unwrapped) of row (y, z): images shifted by `shift`, sliding by `slide`. */
GG_INLINE void gg_scan_row(const gg_md *e, gg_features f, gg_search *s, int32_t from, int32_t to, int32_t y, int32_t z,
                           gg_vec shift, double slide)
{
  const gg_cells *c = &e->cells;
  const uint32_t *row = gg_cell_at(c, (int32_t[3]){0, y, z});
  for (int32_t k = from; k <= to; k++) {
    int32_t x = k;
    gg_vec here = shift;
    while (x < 0) x += c->n[0], here.x -= e->box.edge[0];
    while (x >= c->n[0]) x -= c->n[0], here.x += e->box.edge[0];
    const uint32_t *cell = row + (size_t)x * c->stride;
    if (f.wide && gg_take_cell(s, cell)) continue;
    for (uint32_t m = 1; m <= cell[0]; m++)
      if (cell[m] != s->grain) gg_try_pair(e, f, s, cell[m], here, slide);
  }
}

/* Index of a neighbouring cell along one axis, and the shift of its image. */
GG_INLINE int32_t gg_image_cell(const gg_md *e, int axis, int32_t k, double *shift)
{
  *shift = 0;
  if (k < 0) {
    *shift = -e->box.edge[axis];
    return k + e->cells.n[axis];
  }
  if (k >= e->cells.n[axis]) {
    *shift = e->box.edge[axis];
    return k - e->cells.n[axis];
  }
  return k;
}

/* Cells from..to (unwrapped) of the row at (y, z), unless it lies across the sheared boundary. */
GG_INLINE void gg_scan_plain_row(const gg_md *e, gg_features f, gg_search *s, int32_t from, int32_t to, int32_t y,
                                 int32_t z)
{
  gg_vec shift = {0, 0, 0};
  if (f.walled && (y < 0 || y >= e->cells.n[1])) return;
  int32_t iy = gg_image_cell(e, 1, y, &shift.y);
  if (f.sheared && shift.y != 0) return;
  int32_t iz = gg_image_cell(e, 2, z, &shift.z);
  gg_scan_row(e, f, s, from, to, iy, iz, shift, 0);
}

/* The sliding row above (side = 1) or below (-1): cell k of it now covers x from k w + D to (k+1) w + D. */
GG_INLINE void gg_scan_sliding(const gg_md *e, gg_features f, gg_search *s, int side)
{
  const gg_cells *c = &e->cells;
  const gg_node *node = &e->node[s->grain];
  double w = c->width[0], D = side * gg_offset(&e->box, e->k.now);
  double left = node->cell[0] * w - c->reach, right = (node->cell[0] + 1) * w + c->reach;
  int32_t from = (int32_t)gg_floor((left - D) / w), to = (int32_t)gg_floor((right - D) / w);
  if (side > 0)
    from--; /* it moves right: one cell of store on the left */
  else
    to++;
  double room = side > 0 ? left - (from * w + D) : (to + 1) * w + D - right;
  double valid = e->k.now + room / e->box.slide;
  if (valid < s->valid) s->valid = valid;
  for (int32_t z = node->cell[2] - 1; z <= node->cell[2] + 1; z++) {
    gg_vec shift = {D, side * e->box.edge[1], 0};
    int32_t iz = gg_image_cell(e, 2, z, &shift.z);
    gg_scan_row(e, f, s, from, to, side > 0 ? 0 : c->n[1] - 1, iz, shift, side * e->box.slide);
  }
}

GG_INLINE void gg_scan_sliding_rows(const gg_md *e, gg_features f, gg_search *s)
{
  s->valid = INFINITY;
  if (!f.sheared) return;
  int32_t y = e->node[s->grain].cell[1];
  if (y == e->cells.n[1] - 1) gg_scan_sliding(e, f, s, 1);
  if (y == 0) gg_scan_sliding(e, f, s, -1);
}

/* Is no cell around in another image of the box? */
GG_INLINE bool gg_is_inside(const gg_md *e, const int32_t at[3])
{
  const int32_t *n = e->cells.n;
  return ((uint32_t)(at[0] - 1) < (uint32_t)(n[0] - 2)) & ((uint32_t)(at[1] - 1) < (uint32_t)(n[1] - 2)) &
         ((uint32_t)(at[2] - 1) < (uint32_t)(n[2] - 2));
}

/* Is there room for so many full cells? */
GG_INLINE bool gg_has_room(const gg_md *e, int cells)
{
  return (uint32_t)cells * e->cells.stride <= GG_MOST_NEAR;
}

/* The cells from `from` to `to` relative to `at`, where no wall stands. All that does not change is
 * in local variables: to the compiler, what goes into `near` might overwrite the rest. */
GG_INLINE void gg_take_rows(const gg_md *e, gg_search *s, const int32_t at[3], const int from[3], const int to[3],
                            bool small)
{
  const gg_cells *c = &e->cells;
  const uint32_t *x = c->part[0] + at[0], *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  const uint32_t *row[3][3];
  size_t stride = c->stride, step[3];
  for (int k = from[0]; k <= to[0]; k++) step[k + 1] = x[k] * stride;
  for (int m = from[2]; m <= to[2]; m++)
    for (int l = from[1]; l <= to[1]; l++) row[m + 1][l + 1] = c->cell + (size_t)(z[m] + y[l]) * stride;
  uint32_t n = s->n_near;
  for (int m = from[2]; m <= to[2]; m++)
    for (int l = from[1]; l <= to[1]; l++)
      for (int k = from[0]; k <= to[0]; k++) {
        const uint32_t *cell = row[m + 1][l + 1] + step[k + 1];
        n = small ? gg_append_small(s->near, n, cell) : gg_append_cell(s->near, n, cell);
      }
  s->n_near = n;
}

/* Those of them that are in the box, in wide kernels; false: there may be no room for all. */
GG_INLINE bool gg_take_box(const gg_md *e, gg_features f, gg_search *s, const int32_t at[3], const int from[3],
                           const int to[3])
{
  if (!f.wide || !gg_has_room(e, 27)) return false;
  bool lowest = f.walled & (at[1] == 0), highest = f.walled & (at[1] == e->cells.n[1] - 1);
  int lower[3] = {from[0], lowest && from[1] < 0 ? 0 : from[1], from[2]};
  int upper[3] = {to[0], highest && to[1] > 0 ? 0 : to[1], to[2]};
  if (e->cells.stride == 8)
    gg_take_rows(e, s, at, lower, upper, true);
  else
    gg_take_rows(e, s, at, lower, upper, false);
  s->inside = gg_is_inside(e, at);
  return true;
}

/* The cells from `from` to `to`, and what slides past. */
GG_INLINE void gg_scan_cells(const gg_md *e, gg_features f, gg_search *s, const int from[3], const int to[3])
{
  const int32_t *at = e->node[s->grain].cell;
  if (!gg_take_box(e, f, s, at, from, to))
    for (int32_t z = at[2] + from[2]; z <= at[2] + to[2]; z++)
      for (int32_t y = at[1] + from[1]; y <= at[1] + to[1]; y++)
        gg_scan_plain_row(e, f, s, at[0] + from[0], at[0] + to[0], y, z);
  gg_scan_sliding_rows(e, f, s);
}

/* All 27 cells. */
GG_INLINE void gg_scan_around(const gg_md *e, gg_features f, gg_search *s)
{
  gg_scan_cells(e, f, s, (const int[3]){-1, -1, -1}, (const int[3]){1, 1, 1});
}

/* The nine cells that came within reach by crossing a face. */
GG_INLINE void gg_scan_ahead(const gg_md *e, gg_features f, gg_search *s, int axis, int32_t step)
{
  int from[3] = {-1, -1, -1}, to[3] = {1, 1, 1};
  from[axis] = to[axis] = step;
  gg_scan_cells(e, f, s, from, to);
}

/* A wall that the grain meets before anything else so far. Only grains in the cells along a wall can touch it. */
GG_INLINE void gg_try_walls(const gg_md *e, gg_features f, gg_search *s)
{
  const gg_grain *g = s->self;
  int32_t y = e->node[s->grain].cell[1];
  double radius = 0.5 * e->model.diameter[f.mixture ? gg_species_of(g) : 0];
  double lower = INFINITY, upper = INFINITY, fall = f.gravity ? e->gravity.y : 0;
  if (y == 0) lower = e->k.now + gg_fall_delay(g->r.y - radius, -g->v.y, -fall);
  if (y == e->cells.n[1] - 1 && !e->model.open_top)
    upper = e->k.now + gg_fall_delay(e->box.edge[1] - radius - g->r.y, g->v.y, fall);
  if (lower < s->collision) s->collision = lower, s->partner = GG_LOWER_WALL;
  if (upper < s->collision) s->collision = upper, s->partner = GG_UPPER_WALL;
}

/* Faces that are walls are not crossed. */
GG_INLINE bool gg_is_wall_above(const gg_md *e, gg_features f, const int32_t *cell)
{
  return f.walled && cell[1] == e->cells.n[1] - 1;
}
GG_INLINE bool gg_is_wall_below(gg_features f, const int32_t *cell)
{
  return f.walled && cell[1] == 0;
}

/* When a grain on a parabola leaves its cell along one axis, and through which face. */
GG_INLINE double gg_fall_out(const gg_md *e, gg_features f, const gg_search *s, int axis, int32_t *face)
{
  double x = gg_along(&s->self->r, axis), v = gg_along(&s->self->v, axis), width = e->cells.width[axis];
  const int32_t *cell = e->node[s->grain].cell;
  bool bottom = axis == 1 && gg_is_wall_below(f, cell), top = axis == 1 && gg_is_wall_above(e, f, cell);
  double w = gg_along(&e->gravity, axis);
  double down = bottom ? INFINITY : gg_fall_delay(x - cell[axis] * width, -v, -w);
  double up = top ? INFINITY : gg_fall_delay((cell[axis] + 1) * width - x, v, w);
  *face = 2 * axis + (up < down);
  return up < down ? up : down;
}

GG_INLINE double gg_first_fall_out(const gg_md *e, gg_features f, const gg_search *s, int32_t *face)
{
  int32_t other;
  double first = gg_fall_out(e, f, s, 0, face);
  for (int axis = 1; axis < 3; axis++) {
    double delay = gg_fall_out(e, f, s, axis, &other);
    *face = delay < first ? other : *face;
    first = delay < first ? delay : first;
  }
  return first;
}

/* Place and velocity relative to the grain's row, in the image that is in its cell. */
GG_INLINE void gg_seen_from_row(const gg_md *e, const int32_t *cell, gg_axes *r, gg_axes *v)
{
  double x = (*r)[0] - gg_row_begins(e, cell[1]), depth = x - cell[0] * e->cells.width[0];
  (*r)[0] = x - e->box.edge[0] * gg_nearest(depth * e->box.inverse[0]);
  (*v)[0] -= e->row[cell[1]].speed;
}

/* The same on a straight line. Rounding may have left the grain outside by a digit: then at once. */
GG_INLINE double gg_first_exit(const gg_md *e, gg_features f, const gg_search *s, int32_t *face)
{
  const int32_t *cell = e->node[s->grain].cell;
  gg_axes r = gg_load_axes(&s->self->r.x), v = gg_load_axes(&s->self->v.x), zero = {0}, one = {1, 1, 1, 1};
  if (f.drifts) gg_seen_from_row(e, cell, &r, &v);
  gg_axes never = {INFINITY, INFINITY, INFINITY, INFINITY};
  gg_axes_mask up = v > 0, open = (v != 0) & (gg_axes_mask){-1, -1, -1, 0};
  if (gg_is_wall_below(f, cell)) open &= up | (gg_axes_mask){-1, 0, -1, 0};
  if (gg_is_wall_above(e, f, cell)) open &= ~up | (gg_axes_mask){-1, 0, -1, 0};
  gg_axes ahead = __builtin_convertvector(gg_load_indices(cell), gg_axes) + gg_choose_axes(up, one, zero);
  gg_axes delay = (ahead * gg_load_axes(e->cells.width) - r) / v;
  delay = gg_choose_axes(open, gg_choose_axes(delay > 0, delay, zero), never);
  gg_axes first = gg_least_axes(delay);
  int axis = __builtin_ctz(gg_axes_bits(delay == first));
  *face = 2 * axis + (int)(gg_axes_bits(up) >> axis & 1);
  return first[0];
}

/* Which face of its cell the grain crosses next, and when. */
GG_INLINE double gg_next_face(const gg_md *e, gg_features f, const gg_search *s, int32_t *face)
{
  double first = f.gravity ? gg_first_fall_out(e, f, s, face) : gg_first_exit(e, f, s, face);
  double t = e->k.now + first;
  if (f.sheared && !f.drifts && s->valid < t) t = s->valid, *face = GG_SLIDE;
  return t;
}

#endif
