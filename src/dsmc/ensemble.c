/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of the ensemble, and operations on all of its grains. */
#include "dsmc/ensemble.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/memory.h"
#include "base/thread_pool.h"
#include "dsmc/block.h"
#include "dsmc/kernel/kernels.h"
#include "dsmc/parallel/schedule.h"

/* Allocate blocks, in huge pages if possible: a large ensemble with random access has more small pages than the TLB has
 * entries. */
static void *new_blocks(const gg_dsmc_population *p, gg_error *err)
{
  const size_t huge = (size_t)1 << 21, n = p->n_blocks, bytes = n * gg_dsmc_block_size(p);
  size_t unit = bytes >= 2 * huge ? huge : 64, rounded = (bytes + unit - 1) / unit * unit;
  void *b = aligned_alloc(unit, rounded);
  if (!b) {
    gg_base_out_of_memory_for(err, "an ensemble of %zu grains: lower dsmc.particles", n * GG_DSMC_LANES);
    return NULL;
  }
#ifdef MADV_HUGEPAGE
  if (unit == huge) (void)madvise(b, rounded, MADV_HUGEPAGE); /* a hint; failure is harmless */
#endif
  memset(b, 0, rounded);
  return b;
}

gg_status gg_dsmc_ensemble_new(const gg_model *model, gg_dsmc_ensemble *e, gg_error *err)
{
  *e = (gg_dsmc_ensemble){.n_species = model->n_species, .kernels = gg_dsmc_kernels_for(gg_simd_instructions_best())};
  size_t blocks = 0;
  for (int i = 0; i < e->n_species; i++) {
    gg_dsmc_population *p = &e->of[i];
    p->n = model->n_of[i];
    p->n_blocks = ((size_t)p->n + GG_DSMC_LANES - 1) / GG_DSMC_LANES;
    blocks += p->n_blocks;
    p->mass = model->mass[i];
    p->inertia = model->inertia[i];
    p->single = model->single;
    p->c = new_blocks(p, err);
    if (p->c && model->rule != GG_SMOOTH) p->s = new_blocks(p, err);
    p->speed_bound = gg_base_array_new(p->n_blocks, sizeof *p->speed_bound, err);
    if (!p->c || !p->speed_bound || (model->rule != GG_SMOOTH && !p->s)) {
      gg_dsmc_ensemble_free(e);
      return GG_FAILED;
    }
  }
  e->segments = gg_dsmc_segments_of(blocks);
  return GG_OK;
}

void gg_dsmc_ensemble_free(gg_dsmc_ensemble *e)
{
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    free(e->of[i].c);
    free(e->of[i].s);
    free(e->of[i].speed_bound);
  }
  gg_base_thread_pool_free(e->pool);
  *e = (gg_dsmc_ensemble){0};
}

static void scale_blocks(const gg_dsmc_population *p, void *blocks, gg_dsmc_range r, double factor)
{
  const size_t n = (size_t)r.n * GG_DSMC_COMPONENTS;
  if (p->single) {
    float *v = gg_dsmc_blocks_at(p, blocks, r.first);
    for (size_t i = 0; i < n; i++) v[i] = (float)(v[i] * factor);
  } else {
    double *v = gg_dsmc_blocks_at(p, blocks, r.first);
    for (size_t i = 0; i < n; i++) v[i] *= factor;
  }
}

typedef struct scaling {
  gg_dsmc_ensemble *e;
  double factor;
} scaling;

static void heat_segment(void *context, int part)
{
  const scaling *w = context;
  const int segment = gg_dsmc_segment_in(w->e->segments, w->e->grouping, part);
  for (int i = 0; i < w->e->n_species; i++) {
    const gg_dsmc_population *p = &w->e->of[i];
    scale_blocks(p, p->c, gg_dsmc_segment(p, w->e->segments, segment), w->factor);
  }
}

typedef struct turning {
  gg_dsmc_ensemble *e;
  const double *acceleration;
  double dt;
} turning;

static void turn_segment(void *context, int part)
{
  const turning *w = context;
  const int segment = gg_dsmc_segment_in(w->e->segments, w->e->grouping, part);
  for (int i = 0; i < w->e->n_species; i++) {
    const gg_dsmc_population *p = &w->e->of[i];
    const gg_dsmc_range r = gg_dsmc_segment(p, w->e->segments, segment);
    const size_t all = (size_t)p->n, end = (r.first + r.n) * GG_DSMC_LANES;
    for (size_t a = r.first * GG_DSMC_LANES; p->s && a < (end < all ? end : all); a++) {
      gg_vec s = gg_dsmc_block_get(p, p->s, (uint32_t)a);
      s.z += w->acceleration[i] * w->dt;
      gg_dsmc_block_set(p, p->s, (uint32_t)a, s);
    }
  }
}

void gg_dsmc_ensemble_turn(gg_dsmc_ensemble *e, const double acceleration[], double dt)
{
  gg_base_thread_pool_for(e->pool, e->segments, turn_segment, &(turning){e, acceleration, dt});
}

void gg_dsmc_ensemble_heat(gg_dsmc_ensemble *e, double factor)
{
  gg_base_thread_pool_for(e->pool, e->segments, heat_segment, &(scaling){e, factor});
  e->bound_scale *= factor * factor * (1 + 1e-15);
}

void gg_dsmc_ensemble_scale(gg_dsmc_ensemble *e, double factor)
{
  gg_dsmc_ensemble_heat(e, factor);
  for (int i = 0; i < e->n_species; i++) {
    const gg_dsmc_population *p = &e->of[i];
    if (p->s) scale_blocks(p, p->s, gg_dsmc_all_blocks(p), factor);
  }
}

/* Synchronise a last block with empty lanes, which stay 0. */
static void synchronise_odd_block(gg_dsmc_synchronise_blocks *synchronise, gg_dsmc_population *p, double strain,
                                  double scale, gg_vec centre, double bound_scale, gg_dsmc_block_sums *s)
{
  const size_t last = p->n_blocks - 1;
  void *block = gg_dsmc_blocks_at(p, p->c, last);
  gg_dsmc_block_sums ignored = {0};
  float *speed_bound = &p->speed_bound[last];
  synchronise(block, speed_bound, 1, strain, scale, centre, bound_scale, &ignored);
  for (uint32_t a = (uint32_t)p->n; a < p->n_blocks * GG_DSMC_LANES; a++)
    gg_dsmc_block_set(p, p->c, a, (gg_vec){0, 0, 0});
  synchronise(block, speed_bound, 1, 0, 1, (gg_vec){0, 0, 0}, bound_scale, s);
}

typedef struct synchronising {
  gg_dsmc_ensemble *e;
  double strain, scale, bound_scale;
  gg_vec centre;
  gg_dsmc_block_sums of[GG_DSMC_MAX_SEGMENTS][GG_MAX_SPECIES];
} synchronising;

static void synchronise_segment(void *context, int part)
{
  synchronising *w = context;
  const int segment = gg_dsmc_segment_in(w->e->segments, w->e->grouping, part);
  for (int i = 0; i < w->e->n_species; i++) {
    gg_dsmc_population *p = &w->e->of[i];
    gg_dsmc_range r = gg_dsmc_segment(p, w->e->segments, segment);
    bool odd = p->n % GG_DSMC_LANES && segment == w->e->segments - 1;
    gg_dsmc_block_sums s = {0};
    gg_dsmc_synchronise_blocks *synchronise = w->e->kernels->synchronise[p->single];
    synchronise(gg_dsmc_blocks_at(p, p->c, r.first), p->speed_bound + r.first, r.n - odd, w->strain, w->scale,
                w->centre, w->bound_scale, &s);
    if (odd) synchronise_odd_block(synchronise, p, w->strain, w->scale, w->centre, w->bound_scale, &s);
    w->of[segment][i] = s;
  }
}

gg_dsmc_moments gg_dsmc_ensemble_synchronise(gg_dsmc_ensemble *e, double strain, double scale, gg_vec centre,
                                             double bound_scale)
{
  double n = 0, mass = 0, energy = 0, most = 0;
  gg_vec momentum = {0, 0, 0};
  synchronising w = {.e = e, .strain = strain, .scale = scale, .bound_scale = bound_scale, .centre = centre};
  gg_base_thread_pool_for(e->pool, e->segments, synchronise_segment, &w);
  for (int i = 0; i < e->n_species; i++) {
    gg_dsmc_population *p = &e->of[i];
    for (int segment = 0; segment < e->segments; segment++)
      for (int l = 0; l < GG_DSMC_LANES; l++) {
        const gg_dsmc_block_sums *s = &w.of[segment][i];
        momentum = gg_axpy(p->mass, (gg_vec){s->c.x[l], s->c.y[l], s->c.z[l]}, momentum);
        energy += p->mass * s->c2[l];
        most = s->fastest[l] > most ? s->fastest[l] : most;
      }
    n += (double)p->n;
    mass += p->mass * (double)p->n;
  }
  e->bound_scale = bound_scale;
  e->bound_strain = e->bound_width = 0;
  return (gg_dsmc_moments){
      .temperature = energy / (3 * n), .fastest = sqrt(most), .centre = gg_scale(1 / mass, momentum)};
}

void gg_dsmc_ensemble_strain_bounds(gg_dsmc_ensemble *e, double strain, double width)
{
  double below = e->bound_strain - strain, above = (strain + width) - (e->bound_strain + e->bound_width);
  double delta = fmax(fmax(below, above), 0), part = gg_dsmc_bound_growth(delta / 8); /* a few units at most */
  for (int twice = 0; twice < 3; twice++) part *= part;
  e->bound_scale *= part;
  e->bound_strain = strain;
  e->bound_width = width;
}

const gg_dsmc_block *gg_dsmc_blocks_in_double(const gg_dsmc_population *p, const void *blocks, size_t first, size_t n,
                                              gg_dsmc_block *room)
{
  if (!p->single) return (const gg_dsmc_block *)blocks + first;
  const float *from = (const float *)((const gg_dsmc_block_single *)blocks + first);
  double *to = (double *)room;
  for (size_t i = 0; i < n * GG_DSMC_COMPONENTS; i++) to[i] = from[i];
  return room;
}
