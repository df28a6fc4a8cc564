/* The ensemble: the velocities (and spins) that stand for the distribution function, in blocks of eight grains.
 *
 * A block holds eight grains as structure of arrays, one cache line a component, so that a kernel takes them lane by
 * lane; the logical width is eight on every processor. The last block of a species may have empty lanes, always 0.
 * A scene may keep its grains in single precision instead: half a line a component, and so two lines a block. Only the
 * block kernels compute in it; everybody else sees such grains as double (gg_dsmc_block_get, gg_dsmc_blocks_in_double).
 *
 * Grains of a sheared gas stream as dC_x/dt = -rate C_y. That motion is the same linear map for all grains, so it is
 * not carried out grain by grain: what is stored is x = C_x + strain C_y, constant while streaming, with strain = rate
 * x (time since the map was last applied). The kernels undo it for the two grains that collide;
 * gg_dsmc_ensemble_synchronise applies it to all.
 *
 * Of every block an upper bound of its speeds is kept, for the kernels to draw pairs of blocks by: C^2 <= speed_bound x
 * bound_scale in all lanes while the strain stays where `bound_scale` was set. Streaming over a strain of `delta`
 * stretches speeds by no more than exp(delta/2) (the larger singular value of a shear is exp(asinh(delta/2))), so
 * bound_scale may go along instead of all speed bounds. */
#ifndef GG_DSMC_ENSEMBLE_H
#define GG_DSMC_ENSEMBLE_H

#include "common/archive.h"
#include "common/model.h"
#include "common/rng.h"

enum { GG_DSMC_LANES = 8 };

typedef struct gg_dsmc_block {
  double x[GG_DSMC_LANES], y[GG_DSMC_LANES], z[GG_DSMC_LANES];
} __attribute__((aligned(64))) gg_dsmc_block;

typedef struct gg_dsmc_block_single {
  float x[GG_DSMC_LANES], y[GG_DSMC_LANES], z[GG_DSMC_LANES];
} __attribute__((aligned(32))) gg_dsmc_block_single;

/* The grains of one species. */
typedef struct gg_dsmc_population {
  int64_t n;
  size_t n_blocks;
  double mass, inertia; /* m; K = 4I/(m d^2) */
  bool single;          /* blocks are gg_dsmc_block_single, else gg_dsmc_block */
  void *c, *s;          /* blocks: peculiar velocities; surface spins, NULL if smooth */
  float *speed_bound;   /* of each block */
} gg_dsmc_population;

typedef struct gg_dsmc_ensemble {
  int n_species;
  gg_dsmc_population of[GG_MAX_SPECIES];
  double bound_scale, bound_strain, bound_width; /* it holds at strains from bound_strain on, over bound_width */
  int segments;                /* that each species is divided into (parallel/partition.h): by size alone, 1 if small */
  int grouping;                /* paired last, and maybe in caches: the quarter that went with the first */
  struct gg_thread_pool *pool; /* threads that share them; NULL: one thread does all */
  const struct gg_dsmc_kernels *kernels; /* for the instructions of this processor */
} gg_dsmc_ensemble;

typedef struct gg_dsmc_moments {
  double temperature; /* sum m C^2/(3N): a velocity squared for one species of mass 1 */
  double fastest;     /* largest |C| */
  gg_vec centre;      /* velocity of the centre of mass */
} gg_dsmc_moments;

gg_status gg_dsmc_ensemble_new(const gg_model *model, gg_dsmc_ensemble *e, gg_error *err);
void gg_dsmc_ensemble_free(gg_dsmc_ensemble *e);

/* Maxwellians at the model's temperature0 and ratio0; the mean spin of a sheared dense gas is -rate/2. */
void gg_dsmc_ensemble_start(const gg_model *model, gg_dsmc_ensemble *e, gg_rng *rng);

/* C_x -= strain C_y for every grain, all times `scale`, less the velocity `centre`: rounding feeds the motion of the
 * centre of mass, and cooling or a thermostat would let it grow relative to the thermal speed without bound. Returns
 * what is there then. `bound_scale` (a velocity squared of the order of the temperature) becomes that of the speed
 * bounds. */
gg_dsmc_moments gg_dsmc_ensemble_synchronise(gg_dsmc_ensemble *e, double strain, double scale, gg_vec centre,
                                             double bound_scale);
/* Let the speed bounds hold at other strains: from `strain` to `strain + width`. */
void gg_dsmc_ensemble_strain_bounds(gg_dsmc_ensemble *e, double strain, double width);
/* Every velocity times a factor. */
void gg_dsmc_ensemble_heat(gg_dsmc_ensemble *e, double factor);
/* Every velocity and spin times a factor. */
void gg_dsmc_ensemble_scale(gg_dsmc_ensemble *e, double factor);
/* `n` blocks (of p->c or p->s) from `first` on, as double: the ensemble's own, or copied to `room`. */
const gg_dsmc_block *gg_dsmc_blocks_in_double(const gg_dsmc_population *p, const void *blocks, size_t first, size_t n,
                                              gg_dsmc_block *room);
gg_status gg_dsmc_ensemble_save(const gg_dsmc_ensemble *e, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_ensemble_restore(gg_dsmc_ensemble *e, const gg_archive *archive, gg_error *err);

/* At least exp(|delta|), up to |delta| = 1. */
GG_INLINE double gg_dsmc_bound_growth(double delta)
{
  return 1 + fabs(delta) + delta * delta;
}

/* 1/bound_scale and a little more, so that rounding to float breaks no bound. */
GG_INLINE double gg_dsmc_per_bound(double bound_scale)
{
  return (1 + 1e-6) / bound_scale;
}

GG_INLINE size_t gg_dsmc_block_size(const gg_dsmc_population *p)
{
  return p->single ? sizeof(gg_dsmc_block_single) : sizeof(gg_dsmc_block);
}

/* Blocks (of p->c or p->s) from `first` on. */
GG_INLINE void *gg_dsmc_blocks_at(const gg_dsmc_population *p, void *blocks, size_t first)
{
  return (char *)blocks + first * gg_dsmc_block_size(p);
}

/* Grain i of blocks (p->c or p->s). */
GG_INLINE gg_vec gg_dsmc_block_get(const gg_dsmc_population *p, const void *blocks, uint32_t i)
{
  const uint32_t at = i / GG_DSMC_LANES, l = i % GG_DSMC_LANES;
  if (p->single) {
    const gg_dsmc_block_single *b = (const gg_dsmc_block_single *)blocks + at;
    return (gg_vec){b->x[l], b->y[l], b->z[l]};
  }
  const gg_dsmc_block *b = (const gg_dsmc_block *)blocks + at;
  return (gg_vec){b->x[l], b->y[l], b->z[l]};
}

GG_INLINE void gg_dsmc_block_set(const gg_dsmc_population *p, void *blocks, uint32_t i, gg_vec v)
{
  const uint32_t at = i / GG_DSMC_LANES, l = i % GG_DSMC_LANES;
  if (p->single) {
    gg_dsmc_block_single *b = (gg_dsmc_block_single *)blocks + at;
    b->x[l] = (float)v.x, b->y[l] = (float)v.y, b->z[l] = (float)v.z;
    return;
  }
  gg_dsmc_block *b = (gg_dsmc_block *)blocks + at;
  b->x[l] = v.x, b->y[l] = v.y, b->z[l] = v.z;
}

#endif
