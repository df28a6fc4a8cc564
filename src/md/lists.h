/* Neighbour lists for dense systems: who can be met before one of both leaves its shell.
 *
 * Each grain has a shell of radius s around where it stood when its list was made; the list holds everybody whose
 * shell centre then lay within rho = sigma + 2 s of its own, and is symmetric. While two grains that are not listed
 * stay in their shells they cannot touch. A grain that leaves its shell gets a new one, and lists are mended.
 *
 * Under shear the centres move with the flow at their height, and shells shrink at the rate kappa = shear_rate rho/4:
 * two centres at a distance R approach at most at shear_rate R/2, so what holds at the making holds until the exit. A
 * centre is kept by where it stood at the epoch's start, which does not change: the cells of the centres are at rest.
 *
 * Predictions take the whole list, eight at a time. */
#ifndef GG_MD_LISTS_H
#define GG_MD_LISTS_H

#include "md/axes.h"
#include "md/batch.h"
#include "md/scan.h"

GG_INLINE uint32_t *gg_list(const gg_md *e, uint32_t i)
{
  return e->neighbour + (size_t)i * GG_LIST;
}

/* Where shell i's centre is at the present time. */
GG_INLINE gg_vec gg_centre(const gg_md *e, gg_features f, uint32_t i)
{
  gg_vec c = e->shell[i].centre;
  if (f.sheared) c.x += e->model.shear_rate * (c.y - 0.5 * e->box.edge[1]) * e->k.now;
  return c;
}

/* When the grain leaves its shell: |dr + dv t| = s - kappa t, root without cancellation. */
GG_INLINE double gg_shell_exit(const gg_md *e, gg_features f, uint32_t i, const gg_grain *g)
{
  gg_vec centre = gg_centre(e, f, i), dr = gg_sub(g->r, centre), dv = g->v;
  double radius = e->shell_radius, kappa = f.sheared ? e->shrinkage : 0;
  if (f.sheared) {
    dr.x -= e->box.edge[0] * gg_nearest(dr.x * e->box.inverse[0]); /* the centre is kept wrapped */
    dv.x -= e->model.shear_rate * (centre.y - 0.5 * e->box.edge[1]);
    radius -= kappa * (e->k.now - e->node[i].shell_built);
  }
  double a = gg_dot(dv, dv) - kappa * kappa, b = gg_dot(dr, dv) + kappa * radius;
  double c = gg_dot(dr, dr) - radius * radius;
  if (!(c < 0) || radius < 0) return e->k.now;
  double root = sqrt(b * b - a * c);
  bool out = b > 0; /* half of all: no branch */
  double delay = (out ? -c : root - b) / (out ? b + root : a);
  return (out | (a > 0)) ? e->k.now + delay : INFINITY;
}

/* What a pointer points at is loaded where it is used: a constant kept in all lanes of a register would only push out
 * others. */
#define GG_RELOAD(pointer) __asm__("" : "+r"(pointer))

/* Eight grains of a list against s->self, images accounted for. */
GG_INLINE gg_quadratic gg_try_batch(const gg_md *e, gg_features f, const gg_search *s, const uint32_t *list,
                                    double offset)
{
  const gg_grain *g = s->self;
  const double *L = e->box.edge, *inverse = e->box.inverse, *sigma2 = e->contacts.sigma2;
  GG_RELOAD(L);
  GG_RELOAD(inverse);
  GG_RELOAD(sigma2);
  gg_batch b = gg_gather(e->grain, list);
  gg_v8 dt = e->k.now - b.t;
  gg_v8 x = b.x + dt * b.vx - g->r.x, y = b.y + dt * b.vy - g->r.y, z = b.z + dt * b.vz - g->r.z;
  gg_v8 vx = b.vx - g->v.x, vy = b.vy - g->v.y, vz = b.vz - g->v.z;
  if (f.gravity) {
    gg_v8 half = 0.5 * dt * dt;
    x = (b.x + dt * b.vx + half * e->gravity.x) - g->r.x, vx = (b.vx + dt * e->gravity.x) - g->v.x;
    y = (b.y + dt * b.vy + half * e->gravity.y) - g->r.y, vy = (b.vy + dt * e->gravity.y) - g->v.y;
    z = (b.z + dt * b.vz + half * e->gravity.z) - g->r.z, vz = (b.vz + dt * e->gravity.z) - g->v.z;
  }
  if (f.drifts && f.inside) {
    x -= L[0] * gg_nearest8(x * inverse[0]); /* rows may have carried them apart by several edges: not exact if fused */
  } else if (f.sheared) {
    gg_v8 layers = gg_nearest8(y * inverse[1]);
    y -= L[1] * layers;
    x -= layers * offset;
    x -= L[0] * gg_nearest8(x * inverse[0]);
    vx -= layers * e->box.slide;
  } else if (!f.inside) {
    x = f.drifts ? x - L[0] * gg_nearest8(x * inverse[0]) : gg_fold8(x, L[0], inverse[0]);
    if (!f.walled) y = gg_fold8(y, L[1], inverse[1]);
  }
  if (!f.inside) z = gg_fold8(z, L[2], inverse[2]);
  gg_v8 touch2 = gg_all(sigma2[0]);
  if (f.mixture) {
    int species = gg_species_of(g);
    double s0 = sigma2[2 * species], s1 = sigma2[2 * species + 1];
    touch2 = gg_choose(gg_odd8(b.tag), gg_all(s1), gg_all(s0));
  }
  return gg_contact_quadratic8(x, y, z, vx, vy, vz, touch2);
}

/* A contact against the earliest known. */
GG_INLINE void gg_take_contact(gg_search *s, double t, int64_t partner)
{
  if (t < s->collision || (t == s->collision && t < INFINITY && partner < s->partner)) {
    s->collision = t;
    s->partner = (uint32_t)partner;
  }
}

/* Exact times of a batch. */
GG_INLINE void gg_take_batch(const gg_md *e, gg_search *s, gg_quadratic q, gg_m8 who)
{
  int64_t partner;
  double t = gg_earliest8(e->k.now + gg_contact_delay8(q), who, &partner);
  gg_take_contact(s, t, partner);
}

/* The exact time of one lane, which is with `who`. */
GG_INLINE void gg_take_lane(const gg_md *e, gg_search *s, const gg_quadratic *q, uint32_t lane, uint32_t who)
{
  double delay = q->c[lane] / (sqrt(q->discriminant[lane]) - q->b[lane]);
  gg_take_contact(s, e->k.now + (delay > 0 ? delay : 0), who);
}

GG_INLINE gg_m8 gg_who8(const uint32_t *list)
{
  return __builtin_convertvector(*(const gg_list8 *)list, gg_m8);
}

/* Of several batches, by lane: how soon the earliest contact is, labelled by where it stands in the list, and the
 * second; and the first one's quadratic. */
typedef struct gg_foremost {
  gg_v8 soonest, second;
  gg_quadratic q;
} gg_foremost;

GG_INLINE void gg_compare_batch(gg_foremost *best, gg_quadratic q, gg_m8 place)
{
  gg_v8 soon = gg_label8(gg_how_soon8(q), place);
  gg_k8 sooner = gg_less8(best->soonest, soon);
  best->second = gg_larger8(best->second, gg_smaller8(soon, best->soonest));
  best->soonest = gg_larger8(soon, best->soonest);
  best->q.b = gg_choose(sooner, q.b, best->q.b);
  best->q.c = gg_choose(sooner, q.c, best->q.c);
  best->q.discriminant = gg_choose(sooner, q.discriminant, best->q.discriminant);
}

/* The earliest contact with the grains of a list, which goes on to a multiple of eight with the grain at no place.
 * Which it is, is seen from about when the contacts are; where that leaves doubt, all are worked out. */
GG_INLINE void gg_scan_batches(const gg_md *e, gg_features f, gg_search *s, const uint32_t *list, uint32_t count)
{
  double offset = f.sheared ? gg_offset(&e->box, e->k.now) : 0;
  gg_v8 never = gg_all(0);
  gg_foremost best = {never, never, {never, never, never}};
  gg_m8 place = {0, 1, 2, 3, 4, 5, 6, 7};
  for (uint32_t k = 0; k < count; k += GG_BATCH, place += GG_BATCH) {
    gg_quadratic q = gg_try_batch(e, f, s, list + k, offset);
    if (f.shared && !gg_any8(gg_meets8(q))) continue; /* few are in the way */
    gg_compare_batch(&best, q, place);
  }
  gg_v8 first = gg_greatest8(best.soonest);
  if (!(first[0] >= GG_SOON_AT_ALL)) return;
  uint32_t at = gg_label_of(first[0]), lane = at % GG_BATCH;
  gg_v8 limit = (1 - 4 * GG_ABOUT) * first;
  uint32_t lanes = gg_lanes8(gg_not_above8(limit, best.soonest));
  bool alone = !(lanes & (lanes - 1)) && first[0] < GG_AT_ONCE;
  if (__builtin_expect(alone && !gg_any8(gg_not_above8(limit, best.second)), 1)) {
    gg_take_lane(e, s, &best.q, lane, list[at]);
    return;
  }
  for (uint32_t k = 0; k < count; k += GG_BATCH)
    gg_take_batch(e, s, gg_try_batch(e, f, s, list + k, offset), gg_who8(list + k));
}

/* Those that cells were searched for. */
GG_INLINE void gg_scan_near(const gg_md *e, gg_features f, gg_search *s)
{
  for (int l = 0; l < GG_BATCH; l++) s->near[s->n_near + (uint32_t)l] = e->n;
  gg_features still = f, inside = f;
  still.sheared = inside.sheared = false;
  inside.inside = true;
  if (!f.shared && s->inside)
    gg_scan_batches(e, inside, s, s->near, s->n_near);
  else if (f.drifts && !f.shared && s->regular)
    gg_scan_batches(e, still, s, s->near, s->n_near);
  else
    gg_scan_batches(e, f, s, s->near, s->n_near);
}

/* Everybody in the cells that can hold centres within rho of shell i's, under shear, as far as there is room. */
GG_INLINE void gg_collect_sheared(const gg_md *e, uint32_t i, gg_search *s)
{
  const gg_cells *c = &e->cells;
  const int32_t *at = e->node[i].cell;
  gg_vec centre = e->shell[i].centre;
  double rho = c->reach, strain = e->model.shear_rate * e->k.now;
  s->n_near = 0;
  for (int32_t z = at[2] - 1; z <= at[2] + 1; z++) {
    if (z * c->width[2] > centre.z + rho || (z + 1) * c->width[2] < centre.z - rho) continue;
    for (int32_t y = at[1] - 1; y <= at[1] + 1; y++) {
      gg_vec shift = {0, 0, 0};
      int32_t iy = gg_image_cell(e, 1, y, &shift.y), iz = gg_image_cell(e, 2, z, &shift.z);
      shift.x = shift.y > 0 ? e->box.offset0 : shift.y < 0 ? -e->box.offset0 : 0;
      double below = y * c->width[1] - centre.y, above = (y + 1) * c->width[1] - centre.y;
      if (below > rho || above < -rho) continue;
      if (below < -rho) below = -rho;
      if (above > rho) above = rho;
      int32_t from = (int32_t)gg_floor((centre.x - rho - strain * above - shift.x) * c->inverse[0]);
      int32_t to = (int32_t)gg_floor((centre.x + rho - strain * below - shift.x) * c->inverse[0]);
      if (to - from >= c->n[0]) to = from + c->n[0] - 1;
      const uint32_t *row = gg_cell_at(c, (int32_t[3]){0, iy, iz});
      for (int32_t k = from; k <= to; k++) {
        int32_t x = k;
        while (x < 0) x += c->n[0];
        while (x >= c->n[0]) x -= c->n[0];
        if (!gg_take_cell(s, row + (size_t)x * c->stride)) s->n_near = GG_MOST_NEAR;
      }
    }
  }
}

/* The 27 cells around one: where they begin, and a bit for each that a sphere of radius rho reaches into. */
typedef struct gg_nearby {
  uint32_t index[28], which; /* x fastest */
} gg_nearby;

GG_INLINE void gg_cells_nearby(const gg_md *e, uint32_t i, gg_nearby *nearby)
{
  typedef uint32_t words __attribute__((vector_size(16)));
  typedef uint32_t words_there __attribute__((vector_size(16), may_alias, aligned(4)));
  const gg_cells *c = &e->cells;
  const int32_t *at = e->node[i].cell;
  const uint32_t *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  words x = *(const words_there *)(c->part[0] + at[0] - 1);
  double below[3], above[3]; /* squared distances to the cells below and above along each axis */
  for (int a = 0; a < 3; a++) {
    double depth = gg_along(&e->shell[i].centre, a) - at[a] * c->width[a], rest = c->width[a] - depth;
    below[a] = depth * depth;
    above[a] = rest * rest;
  }
  gg_axes far = {below[0], 0, above[0], INFINITY};
  double far_y[3] = {below[1], 0, above[1]}, far_z[3] = {below[2], 0, above[2]}, rho2 = c->reach * c->reach;
  nearby->which = 0;
  for (int m = 0; m < 3; m++)
    for (int l = 0; l < 3; l++) {
      int row = 3 * (3 * m + l);
      *(words_there *)(nearby->index + row) = x + (z[m - 1] + y[l - 1]);
      nearby->which |= gg_axes_bits(far < rho2 - far_z[m] - far_y[l]) << row;
    }
}

/* The same where nothing slides. */
GG_INLINE void gg_collect_near(const gg_md *e, uint32_t i, gg_search *s)
{
  gg_nearby nearby;
  gg_cells_nearby(e, i, &nearby);
  bool room = gg_has_room(e, 27);
  const uint32_t *cells = e->cells.cell;
  size_t stride = e->cells.stride;
  uint32_t n = 0;
  for (uint32_t which = nearby.which; which; which &= which - 1) {
    const uint32_t *cell = cells + nearby.index[__builtin_ctz(which)] * stride;
    if (room || n + cell[0] <= GG_MOST_NEAR)
      n = gg_append_cell(s->near, n, cell);
    else
      n = GG_MOST_NEAR;
  }
  s->n_near = n;
}

typedef double gg_centre4 __attribute__((vector_size(32), may_alias, aligned(8)));

/* The centres of eight shells as columns. */
GG_INLINE void gg_gather_centres(const gg_shell *shell, const uint32_t *index, gg_v8 *x, gg_v8 *y, gg_v8 *z)
{
#define TWO(k, m)                                                                                                      \
  __builtin_shufflevector(*(const gg_centre4 *)&shell[index[k]].centre, *(const gg_centre4 *)&shell[index[m]].centre,  \
                          0, 1, 2, 3, 4, 5, 6, 7)
  gg_v8 a = TWO(0, 4), b = TWO(1, 5), c = TWO(2, 6), d = TWO(3, 7);
#undef TWO
  gg_v8 ab0 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  gg_v8 cd0 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  *x = __builtin_shufflevector(ab0, cd0, 0, 1, 8, 9, 4, 5, 12, 13);
  *z = __builtin_shufflevector(ab0, cd0, 2, 3, 10, 11, 6, 7, 14, 15);
  gg_v8 ab1 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  gg_v8 cd1 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  *y = __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 4, 5, 12, 13);
}

/* Room for a full list, and for eight more that are written before they are counted. */
enum { GG_FOUND = GG_LIST + 1 + GG_BATCH };

/* Everybody whose centre lies within rho of shell i's: ids into found[GG_FOUND]; more than GG_LIST: too many. */
GG_INLINE uint32_t gg_search_shell(const gg_md *e, gg_features f, uint32_t i, uint32_t *found)
{
  gg_search s = {.near = e->near};
  if (f.sheared)
    gg_collect_sheared(e, i, &s);
  else
    gg_collect_near(e, i, &s);
  uint32_t *near = s.near, n = s.n_near, count = 0;
  const gg_vec centre = e->shell[i].centre;
  const double *L = e->box.edge, *inverse = e->box.inverse;
  double strain = f.sheared ? e->model.shear_rate * e->k.now : 0;
  int species = f.mixture ? gg_species_of(&e->grain[i]) : 0;
  for (int l = 0; l < GG_BATCH; l++) near[n + (uint32_t)l] = e->n;
  for (uint32_t k = 0; k < n && count <= GG_LIST; k += GG_BATCH) {
    gg_v8 x, y, z, reach = gg_all(e->pair_reach[0]);
    gg_gather_centres(e->shell, near + k, &x, &y, &z);
    for (int l = 0; f.mixture && l < GG_BATCH; l++)
      reach[l] = e->pair_reach[species + gg_species_of(&e->grain[near[k + (uint32_t)l]])];
    x -= centre.x, y -= centre.y, z -= centre.z;
    gg_v8 layers = gg_nearest8(y * inverse[1]);
    y -= L[1] * layers;
    if (f.sheared) x += strain * y - layers * e->box.offset0;
    x -= L[0] * gg_nearest8(x * inverse[0]);
    z -= L[2] * gg_nearest8(z * inverse[2]);
    count += gg_pick8(found + count, near + k, i, gg_less8(x * x + y * y + z * z, reach * reach));
  }
  return n == GG_MOST_NEAR ? GG_LIST + 1 : count;
}

/* The shell of grain i anew, around where it now is: image in the box, centre, cell (not yet in the chains). */
GG_INLINE void gg_new_shell(gg_md *e, gg_features f, uint32_t i)
{
  gg_grain *g = gg_settle(e, f, i);
  gg_node *node = &e->node[i];
  gg_shell *shell = &e->shell[i];
  double layers = gg_floor(g->r.y * e->box.inverse[1]);
  g->r.y -= layers * e->box.edge[1];
  if (f.sheared && layers != 0) {
    g->r.x -= layers * gg_offset(&e->box, e->k.now);
    g->v.x -= layers * e->box.slide;
  }
  g->r.x = gg_wrap(g->r.x, e->box.edge[0], e->box.inverse[0]);
  g->r.z = gg_wrap(g->r.z, e->box.edge[2], e->box.inverse[2]);
  gg_vec centre = g->r;
  if (f.sheared) {
    centre.x -= e->model.shear_rate * (centre.y - 0.5 * e->box.edge[1]) * e->k.now;
    centre.x = gg_wrap(centre.x, e->box.edge[0], e->box.inverse[0]);
  }
  *shell = (gg_shell){centre};
  node->shell_built = e->k.now;
  gg_md_cell_of(&e->cells, centre, node->cell);
}

GG_INLINE void gg_list_clear(gg_md *e, uint32_t i)
{
  uint32_t *list = gg_list(e, i);
  for (int k = 0; k < GG_LIST; k++) list[k] = e->n;
  e->node[i].neighbours = 0;
}

/* Beyond its end a list holds the grain at no place. */
GG_INLINE bool gg_list_add(gg_md *e, uint32_t i, uint32_t j)
{
  if (e->node[i].neighbours == GG_LIST) return false;
  gg_list(e, i)[e->node[i].neighbours++] = j;
  return true;
}

/* Where in a list of GG_LIST a grain stands: a bit for each place. */
GG_INLINE uint32_t gg_list_places(const uint32_t *list, uint32_t j)
{
  return gg_words_equal16(list, j) | gg_words_equal8(list + 16, j) << 16;
}

GG_INLINE void gg_list_remove(gg_md *e, uint32_t i, uint32_t j)
{
  uint32_t *list = gg_list(e, i), last = --e->node[i].neighbours;
  list[__builtin_ctz(gg_list_places(list, j))] = list[last];
  list[last] = e->n;
}

/* Replace i's list by found[], and mend the lists of those who are no longer or newly in it. False: no room. */
GG_INLINE bool gg_mend_lists(gg_md *e, uint32_t i, const uint32_t *found, uint32_t count)
{
  uint32_t old[GG_LIST], *list = gg_list(e, i), n_old = e->node[i].neighbours, still = 0, fresh = 0;
  if (count > GG_LIST) return false;
  for (int k = 0; k < GG_LIST; k++) old[k] = list[k], list[k] = (uint32_t)k < count ? found[k] : e->n;
  e->node[i].neighbours = count;
  for (uint32_t k = 0; k < count; k++) {
    uint32_t places = gg_list_places(old, found[k]);
    still |= places;
    fresh |= (uint32_t)(places == 0) << k;
  }
  for (uint32_t gone = gg_lowest_bits(n_old) & ~still; gone; gone &= gone - 1)
    gg_list_remove(e, old[__builtin_ctz(gone)], i);
  for (; fresh; fresh &= fresh - 1)
    if (!gg_list_add(e, found[__builtin_ctz(fresh)], i)) return false;
  return true;
}

#endif
