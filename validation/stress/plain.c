/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare md with its reference path (plain cells, one pair at a time) from the same initial state. Rounding differs
 * between neighbour searches, and each collision amplifies it, by more if free paths are longer. So only collisions
 * are compared that end short chains of collisions. */
#include <math.h>
#include <stdlib.h>

#include "common/engine_grains.h"
#include "corner.h"
#include "md/grid.h"
#include "md/md_allocate.h"
#include "md/select_search.h"
#include "md/start/start.h"

enum { MOST = 2000 };

typedef struct course {
  int n;
  size_t pair[MOST][2];
} course;

static void note(void *context, const gg_collision_record *collision)
{
  course *c = context;
  if (c->n == MOST || collision->wall) return;
  c->pair[c->n][0] = (size_t)collision->id[0];
  c->pair[c->n++][1] = (size_t)collision->id[1];
}

/* Make an engine as gg_md_ops.create does, but with another grid. Positions of an equilibrium start are copied from the
 * first engine, which has found them by a simulation. */
static gg_status make_reference(const gg_model *model, uint64_t seed, const gg_engine_grains *g, gg_md **engine,
                                gg_error *err)
{
  const gg_grain_arrays start = {.r = g->grains.r, .species = g->grains.species};
  GG_TRY(gg_md_allocate(model, engine, err));
  gg_md *e = *engine;
  int32_t n[3];
  gg_md_cells_count(&e->box, fmax(gg_md_reach(model), cbrt(model->volume / e->n)), n);
  e->base.ops = &gg_md_ops, e->plain = true;
  gg_status status = gg_md_start(e, seed, 0, gg_md_starts_in_equilibrium(model) ? &start : NULL, err);
  if (status == GG_OK) status = gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(model), err);
  if (status == GG_OK) status = gg_md_find_near_surfaces(e, err);
  if (status == GG_OK) status = gg_md_begin(e, err);
  if (status != GG_OK) gg_md_free(e);
  return status;
}

static gg_status follow(gg_engine *e, uint64_t collisions, course *c, gg_error *err)
{
  double gone;
  GG_TRY(e->ops->set_callback(e, note, c, err));
  return e->ops->advance(e, INFINITY, collisions, &gone, err);
}

static bool is_same(const size_t a[2], const size_t b[2])
{
  return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]);
}

/* Longest chain of collisions after which rounding is still small: each amplifies it by about the mean free path over
 * the diameter. */
static int longest_chain(const gg_model *m)
{
  return (int)fmax(1, 9 / log10(30 * (1 + 0.1 / m->phi)));
}

/* Number of collisions before the first one that ends a chain longer than longest_chain(). */
static int in_short_chains(const course *c, const gg_model *m)
{
  int *chain = calloc((size_t)m->n, sizeof *chain), k = 0;
  for (; chain && k < c->n; k++) {
    int *one = &chain[c->pair[k][0]], *two = &chain[c->pair[k][1]];
    *one = *two = 1 + (*one > *two ? *one : *two);
    if (*one > longest_chain(m)) break;
  }
  free(chain);
  return k;
}

void corner_compare_plain(const gg_scene *scene, finding *f)
{
  gg_simulation *g = NULL;
  gg_md *reference = NULL;
  course *fast = calloc(2, sizeof *fast), *plain = fast ? fast + 1 : NULL;
  gg_engine_grains grains = {0};
  bool made = fast && gg_simulation_new(scene, NULL, &g, NULL) == GG_OK &&
              gg_common_engine_grains_make(&grains, (size_t)g->model.n, NULL) == GG_OK;
  if (made) {
    gg_common_engine_grains_read(g->engine, &g->model, &grains);
    made = make_reference(&g->model, g->scene.run.seed, &grains, &reference, NULL) == GG_OK;
  }
  gg_common_engine_grains_clear(&grains);
  if (!made) {
    gg_simulation_free(g);
    free(fast);
    return;
  }
  const uint64_t some = (uint64_t)fmin(MOST, fmax(3, (double)g->model.n));
  if (follow(g->engine, some, fast, NULL) == GG_OK && follow(&reference->base, some, plain, NULL) == GG_OK) {
    f->compared_pairs = in_short_chains(fast, &g->model);
    while (f->same_pairs < f->compared_pairs && f->same_pairs < plain->n &&
           is_same(fast->pair[f->same_pairs], plain->pair[f->same_pairs]))
      f->same_pairs++;
  }
  gg_md_free(reference);
  gg_simulation_free(g);
  free(fast);
}
