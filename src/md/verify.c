/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/verify.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "md/select_search.h"

#define FAR 1000   /* largest distance of a grain from the box, in boxes: indices can represent it */
#define MOVED 1e15 /* largest motion of images within an epoch, in boxes: a whole number can represent it */

bool gg_md_is_search_of(const gg_model *m, const int32_t cells[3], double skin_radius, bool overlapping, bool comoving)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(m, &radius, n);
  const bool lists = kind == GG_MD_NEIGHBOUR_LISTS;
  if (lists != (skin_radius > 0)) return false;
  if (overlapping != gg_md_search_overlaps(kind) || comoving != gg_md_search_has_rows(kind)) return false;
  return (!lists || skin_radius <= radius) && cells[0] == n[0] && cells[1] == n[1] && cells[2] == n[2];
}

static bool are_numbers(const double *x, size_t n)
{
  for (size_t i = 0; i < n; i++)
    if (isnan(x[i])) return false;
  return true;
}

bool gg_md_are_counts(const gg_md_counts *k, const int32_t cells[3])
{
  const double finite[] = {k->now,        k->epoch_start,     k->contact_time, k->mean_free_time,   k->window_time,
                           k->scale,      k->outer,           k->kinetic,      k->fractional_shift, k->common_shift,
                           k->outer_time, k->kick_temperature};
  const double others[] = {k->worst_overlap, k->next_kick, k->kinetic0, k->mark, k->asked, k->stop, k->beyond_kick};
  for (size_t i = 0; i < sizeof finite / sizeof *finite; i++)
    if (!(fabs(finite[i]) < 1e300)) return false;
  for (int s = 0; s < GG_MAX_SPECIES; s++)
    if (isnan(k->kick[s].at)) return false;
  if (!(fabs(k->image_turns) < 1e15)) return false;
  return are_numbers(others, sizeof others / sizeof *others) && k->row_shift >= 0 && k->row_shift < cells[0] &&
         k->image_shift >= 0 && k->image_shift < cells[0] && k->power > -1000000000 && k->power < 1000000000;
}

static bool is_in_box(const gg_md *e, gg_vec r, double boxes)
{
  for (int a = 0; a < 3; a++)
    if (!(fabs(gg_along(&r, a)) <= boxes * e->box.edge[a])) return false;
  return true;
}

/* Position of the grain at time t on its present path. */
static gg_vec place_at(const gg_md *e, const gg_md_grain *g, double t)
{
  const double dt = t - g->t, half = 0.5 * dt * dt;
  return (gg_vec){g->r.x + g->v.x * dt + e->gravity.x * half, g->r.y + g->v.y * dt + e->gravity.y * half,
                  g->r.z + g->v.z * dt + e->gravity.z * half};
}

static bool is_grain(const gg_md *e, uint32_t i)
{
  const gg_md_grain *g = &e->grain[i];
  return g->species < (uint32_t)e->model.n_species && is_in_box(e, g->r, FAR) && isfinite(g->v.x) && isfinite(g->v.y) &&
         isfinite(g->v.z) && isfinite(g->t) && is_in_box(e, place_at(e, g, e->k.now), FAR);
}

static bool is_partner(const gg_md *e, uint32_t i, uint32_t partner)
{
  if (GG_MD_NO_GRAIN(partner)) return partner == GG_MD_NONE || GG_MD_SURFACE_OF(partner) < e->model.n_surfaces;
  return partner < e->n && partner != i;
}

/* Validate the contact of a predicted collision: its two centres are apart. If the partner has changed its velocity
 * since, the collision will not happen and the partner may be anywhere; its counter can only have grown. */
static bool is_contact(const gg_md *e, uint32_t i, const gg_md_node *node)
{
  if (node->time != node->collision || !isfinite(node->time) || GG_MD_NO_GRAIN(node->partner)) return true;
  const gg_md_grain *one = &e->grain[i], *other = &e->grain[node->partner];
  const int32_t changes = (int32_t)(other->counter - node->counter);
  if (changes != 0) return changes > 0;
  gg_vec dr = gg_sub(place_at(e, one, node->time), place_at(e, other, node->time)), dv = {0, 0, 0};
  if (!is_in_box(e, dr, 2 * FAR)) return false;
  gg_md_minimum_image(&e->box, gg_model_is_sheared(&e->model), node->time, &dr, &dv);
  const double sigma = e->model.sigma[gg_pair((int)one->species, (int)other->species)];
  return gg_dot(dr, dr) > 1e-6 * sigma * sigma;
}

static bool is_event(const gg_md *e, uint32_t i)
{
  const gg_md_node *n = &e->node[i];
  for (int a = 0; a < 3; a++)
    if (n->cell[a] < 0 || n->cell[a] >= e->cells.n[a]) return false;
  const bool rows = e->search.kind == GG_MD_OVERLAPPING_ROWS;
  if (rows && (n->upper < 0 || n->upper >= e->cells.n[0])) return false;
  if (gg_md_search_overlaps(e->search.kind) && n->neighbours > (rows ? 15u : 7u)) return false;
  if (rows && !(n->neighbours & 2) && n->neighbours & 8) return false;
  if (n->face != GG_MD_IMAGES_MOVED && (n->face < 0 || n->face > 7)) return false;
  if (isnan(n->time) || isnan(n->collision) || isnan(n->skin_time) || n->time < -0.5 * e->queue.width) return false;
  if (!is_partner(e, i, n->partner)) return false;
  /* A grain at rest but for rounding: the frame, which follows the centre of mass, may move farther than the grain. */
  if (n->time > 0x1p60 * gg_md_queue_span(&e->queue)) return true;
  return is_in_box(e, place_at(e, &e->grain[i], n->time), FAR);
}

/* Validate the numbers of grains of each species, and that every grain number occurs once. */
static bool are_all_there(const gg_md *e)
{
  int64_t of[GG_MAX_SPECIES] = {0};
  uint8_t *found = calloc(e->n, 1);
  bool good = found != NULL;
  if (!good) gg_base_memory_lacked(); /* the check was not done */
  for (uint32_t i = 0; good && i < e->n; i++) {
    of[e->grain[i].species]++;
    good = e->id[i] < e->n && !found[e->id[i]];
    if (good) found[e->id[i]] = 1;
  }
  for (int k = 0; good && k < e->model.n_species; k++) good = of[k] == e->model.n_of[k];
  free(found);
  return good;
}

static bool is_listed(const gg_md *e, uint32_t i, uint32_t j)
{
  const uint32_t *list = e->search.lists.neighbour + (size_t)i * GG_MD_LIST;
  for (uint32_t k = 0; k < e->node[i].neighbours; k++)
    if (list[k] == j) return true;
  return false;
}

/* Validate the neighbour lists: they are symmetric, and filled up with the grain at position NaN. */
static bool are_lists(const gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++)
    if (e->node[i].neighbours > GG_MD_LIST) return false;
  for (uint32_t i = 0; i < e->n; i++) {
    const uint32_t *list = e->search.lists.neighbour + (size_t)i * GG_MD_LIST;
    if (!is_in_box(e, e->search.lists.skin[i].centre, 1 + 1e-9)) return false;
    for (uint32_t k = 0; k < GG_MD_LIST; k++) {
      const bool used = k < e->node[i].neighbours;
      if (used ? list[k] >= e->n || list[k] == i || !is_listed(e, list[k], i) : list[k] != e->n) return false;
      for (uint32_t l = 0; used && l < k; l++)
        if (list[l] == list[k]) return false;
    }
  }
  return true;
}

const char *gg_md_wrong_grains(const gg_md *e)
{
  if (!(fabs(e->box.image_velocity * e->k.now) < MOVED * e->box.edge[0])) return "the time";
  for (uint32_t i = 0; i < e->n; i++) {
    if (!is_grain(e, i)) return "a grain";
    if (e->spin && !(isfinite(e->spin[i].x) && isfinite(e->spin[i].y) && isfinite(e->spin[i].z))) return "a spin";
    if (e->last && isnan(e->last[i])) return "the time of a collision";
  }
  if (!are_all_there(e)) return "the grains' species or numbers";
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS && !are_lists(e)) return "a neighbour list";
  for (uint32_t i = 0; i < e->n; i++)
    if (!is_event(e, i) || !is_contact(e, i, &e->node[i])) return "an event";
  return NULL;
}

/* True if all components of both vectors are finite. Collisions check the velocities that they set
 * (search/neighbour_search.h); gg_md_check_numbers inspects all grains, so that no run continues with NaN of any
 * origin. */
static bool is_number(gg_vec a, gg_vec b)
{
  return fabs((a.x + a.y + a.z) + (b.x + b.y + b.z)) < INFINITY;
}

bool gg_md_check_numbers(gg_md *e)
{
  if (e->no_number || e->k.events < e->check_at) return !e->no_number;
  e->check_at = e->k.events + e->n;
  const gg_vec none = {0, 0, 0};
  for (uint32_t i = 0; i < e->n; i++)
    if (!is_number(e->grain[i].r, e->grain[i].v) || !is_number(e->spin ? e->spin[i] : none, none)) e->no_number = true;
  if (e->no_number) e->k.collisions_left = 0;
  return !e->no_number;
}
