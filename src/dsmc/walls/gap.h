/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog Monte Carlo between walls: the gas in the gap, uniform along x and z. Grains have a height and live in cells
 * across the gap. A step is half a flight, collisions, half a flight; the explanation is in docs/explanation/dsmc.md.
 *
 * Frezzotti, Phys. Fluids 9 (1997) 1329; Montanero & Santos, Phys. Rev. E 54 (1996) 438; Bird's method at phi = 0. */
#ifndef GG_DSMC_WALLS_GAP_H
#define GG_DSMC_WALLS_GAP_H

#include "base/thread_pool.h"
#include "common/engine.h"
#include "common/laws/loss_table.h"
#include "common/rng.h"
#include "dsmc/kernel/pass.h"
#include "dsmc/majorant.h"
#include "simd/dispatch.h"

/* Relative bias of a step of h mean free times: 0.12 h^2 in the shear stress of a sheared gas, 0.06 to 0.08 h^2 in its
 * temperature, measured at phi = 0.01, e = 0.9. */
#define GG_GAP_FREE_TIMES_PER_STEP 0.2
#define GG_GAP_BIAS_OF_STEP 0.12

/* Height, and velocity. */
typedef struct gg_dsmc_gap_motion {
  double y;
  gg_vec c;
} gg_dsmc_gap_motion;

/* By cell when they collide, and within a cell by species. */
typedef struct gg_dsmc_gap_grains {
  gg_dsmc_gap_motion *at;
  gg_vec *s;    /* spins; NULL for smooth grains */
  double *last; /* time of the last contact; NULL without a collision callback */
  uint32_t *id;
  uint8_t *species;
} gg_dsmc_gap_grains;

/* Cells of equal width across the heights that centres can have; above an open top far beyond the box. */
typedef struct gg_dsmc_gap_cells {
  int n, reach; /* of them; half the width of a kernel, in half cells */
  double from, width, inverse, volume;
  uint32_t *start; /* [n x species + 1]: the first grain of each; of empty cells below the first, above the last, too */
  uint32_t *start_below;
  uint32_t *next; /* [parts x stride]: of each part (below) the grains of each, then the place of its next one */
  size_t stride;
  double *counted;   /* [n x species]: grains x time, since the last measurement */
  double *mean;      /* [n x species]: mean number of grains, over about a crossing of the gap */
  double *hits;      /* [n]: grains that collided since the last measurement */
  double *chi;       /* [pairs x 2n]: contact value between the middles of cells a and b, at a + b + 1 */
  double *kernel;    /* [species x (reach + 1)]: what share of a cell's grains fills the place half cells away */
  double overfilled; /* share of grains where contact values are held down, over about a crossing */
  gg_dsmc_majorant *majorant; /* [n x species x species]: of chi N g_n, N in the partner's cell */
} gg_dsmc_gap_cells;

/* Threads share the work of a large gas, and the bits do not depend on how many they are. Grains fly, and are ordered,
 * in parts of equal size; each has a stream of random numbers for its walls. Cells collide in slabs: every second one
 * at once, which are so far apart that they share no partners; each has streams, and sums of its own. */
enum { GG_GAP_MOST_PARTS = 8, GG_GAP_MOST_SLABS = 8, GG_GAP_LEAST_SHARED = 10000 };

typedef struct gg_dsmc_gap_streams {
  gg_rng walls[GG_GAP_MOST_PARTS], cells[GG_GAP_MOST_SLABS];
  gg_dsmc_rng_lanes lanes[GG_GAP_MOST_SLABS];
} gg_dsmc_gap_streams;

/* Cells [first, end), how many cells come before them in a step, and what their collisions leave. */
typedef struct gg_dsmc_gap_slab {
  int first, end, turn;
  uint64_t collisions, candidates, overflows, clamped;
  gg_collision_sums transfer;
} __attribute__((aligned(64))) gg_dsmc_gap_slab;

/* Everything else that changes while running: plain data, saved as it is. */
typedef struct gg_dsmc_gap_state {
  gg_dsmc_gap_streams streams;
  double time;
  double owed;        /* flight that is still to come before the present time */
  double step, rate;  /* the step; collisions of a grain per time, where collisions happen */
  double all_rate;    /* collisions per time */
  double temperature; /* sum m c^2/(3N), the flow included: the scale of majorants */
  double unmeasured;  /* time since the last measurement */
  uint64_t steps, collisions, candidates, overflows, rests, clamped;
  uint64_t keeps_sums;
  gg_collision_sums transfer;
  /* Of the present advance, which may have been stopped: its length, and what of it has gone; the last collision. */
  double asked, gone;
  uint64_t last_collision;
} gg_dsmc_gap_state;

struct gg_dsmc_gap;
typedef void gg_dsmc_gap_collide(struct gg_dsmc_gap *d, double dt);

typedef struct gg_dsmc_gap {
  gg_engine base;
  gg_model model;
  gg_dsmc_gap_grains grains, sorted; /* the latter is room for the next order */
  uint32_t *place;                   /* of each grain: its cell, then in that order */
  double low[GG_MAX_SPECIES], high[GG_MAX_SPECIES], radius[GG_MAX_SPECIES]; /* heights of centres */
  double reach[GG_PAIRS]; /* distance of centres at contact; 0 in the Boltzmann limit */
  gg_vec gravity;
  gg_rule wall_rule; /* of walls, as grains with or without spins have it */
  gg_dsmc_gap_cells cells;
  gg_loss_table *losses;
  int parts, slabs;
  gg_dsmc_gap_slab *slab;
  gg_thread_pool *pool; /* NULL: one thread does all */
  gg_dsmc_gap_state now;
  gg_dsmc_gap_collide *collide;
  bool plain; /* tests: candidates one by one */
  gg_collision_callback *callback;
  void *callback_context;
} gg_dsmc_gap;

/* A grain by itself. */
typedef struct gg_dsmc_gap_grain {
  gg_vec r, c, s; /* s: 0 without spins */
  int species;
  bool touched; /* a wall */
} gg_dsmc_gap_grain;

/* Contacts with walls, and how many would have left a grain at rest there. */
typedef struct gg_dsmc_gap_contacts {
  gg_surface_sums surface[GG_MOST_SURFACES];
  uint64_t rests;
  bool shown;  /* to the callback */
  uint32_t id; /* of the grain */
} __attribute__((aligned(64))) gg_dsmc_gap_contacts;

/* The first grain of a part. */
GG_INLINE size_t gg_dsmc_gap_part(const gg_dsmc_gap *d, int part)
{
  return (size_t)d->model.n * (size_t)part / (size_t)d->parts;
}

/* gap_flight.c: all grains for a time, which counts them by cell, too; one grain, where the engine stays as it is. */
void gg_dsmc_gap_fly(gg_dsmc_gap *d, double dt);
void gg_dsmc_gap_fly_grain(const gg_dsmc_gap *d, double dt, gg_rng *rng, gg_dsmc_gap_grain *grain,
                           gg_dsmc_gap_contacts *all);

/* gap_cells.c */
gg_status gg_dsmc_gap_cells_new(gg_dsmc_gap *d, gg_error *err);
void gg_dsmc_gap_cells_free(gg_dsmc_gap_cells *cells);
/* Width of a cell, and how many. */
double gg_dsmc_gap_cell_width(const gg_model *model);
/* A step in mean free times, where grains collide. */
double gg_dsmc_gap_free_times(const gg_model *model);
/* Order the grains by cell, after a flight. */
void gg_dsmc_gap_sort(gg_dsmc_gap *d);
/* Contact values of the present mean numbers. */
void gg_dsmc_gap_set_chi(gg_dsmc_gap *d);
/* After some steps: mean numbers, contact values, temperature, the next step. */
void gg_dsmc_gap_measure(gg_dsmc_gap *d);
void gg_dsmc_gap_choose_step(gg_dsmc_gap *d);

/* gap_collide.c, once for each set of instructions, with the same bits: the collisions of a step; sorted grains. */
#define GG_GAP_COLLIDE_OF(set, name) gg_dsmc_gap_collide gg_dsmc_gap_collide_##name;
GG_EACH_COMPILED_SET(GG_GAP_COLLIDE_OF)
extern gg_dsmc_gap_collide *const gg_dsmc_gap_collide_of[GG_INSTRUCTION_SETS];

/* gap_start.c: memory; the initial state, or grains from outside. */
gg_status gg_dsmc_gap_allocate(const gg_model *model, gg_dsmc_gap **d, gg_error *err);
gg_status gg_dsmc_gap_allocate_last(gg_dsmc_gap *d, gg_error *err);
void gg_dsmc_gap_destroy(gg_engine *engine);
gg_status gg_dsmc_gap_start(gg_dsmc_gap *d, uint64_t seed, uint64_t stream, const gg_grain_arrays *given,
                            gg_error *err);

/* gap_describe.c */
gg_status gg_dsmc_gap_accepts(const gg_model *model, gg_error *err);
double gg_dsmc_gap_bytes(const gg_model *model);
void gg_dsmc_gap_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);

/* gap_checkpoint.c */
gg_status gg_dsmc_gap_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_gap_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

/* What gg_dsmc_ops hands models between walls to; engines that it makes have it as their ops. */
extern const gg_engine_ops gg_dsmc_gap_ops;

#endif
