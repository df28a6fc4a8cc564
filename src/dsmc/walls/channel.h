/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog Monte Carlo in a channel, the space between two walls. The gas is uniform along x and z; grains have a height
 * and are sorted into cells across the channel. A step is half a flight, collisions, half a flight. The method is
 * explained in docs/explanation/dsmc.md.
 *
 * For a gas with a transverse wave (gg_model.wave) the channel has no walls and is periodic: heights and the cells of
 * partners wrap. There candidates are drawn by cells alone. Such a gas may have a thermostat (channel_heat.c).
 *
 * Frezzotti, Phys. Fluids 9 (1997) 1329; Montanero & Santos, Phys. Rev. E 54 (1996) 438; Bird's method at phi = 0. */
#ifndef GG_DSMC_WALLS_CHANNEL_H
#define GG_DSMC_WALLS_CHANNEL_H

#include <math.h>

#include "base/thread_pool.h"
#include "common/engine.h"
#include "common/laws/coefficient_tables.h"
#include "common/rng.h"
#include "common/thermostat.h"
#include "dsmc/advance.h"
#include "dsmc/kernel/pass.h"
#include "dsmc/majorant.h"
#include "simd/dispatch.h"

/* Relative bias of a step of h mean free times: 0.12 h^2 in the shear stress of a sheared gas, 0.06 to 0.08 h^2 in its
 * temperature, measured at phi = 0.01, e = 0.9. */
#define GG_DSMC_CHANNEL_FREE_TIMES_PER_STEP 0.2
#define GG_DSMC_CHANNEL_BIAS_OF_STEP 0.12

/* Height and velocity of a grain. */
typedef struct gg_dsmc_channel_motion {
  double y;
  gg_vec c;
} gg_dsmc_channel_motion;

/* Grains; when they collide, sorted by cell and within a cell by species. */
typedef struct gg_dsmc_channel_grains {
  gg_dsmc_channel_motion *at;
  gg_vec *s;    /* spins; NULL for smooth grains */
  double *last; /* time of the last contact; NULL without a collision callback */
  uint32_t *id;
  uint8_t *species;
} gg_dsmc_channel_grains;

/* Cells of equal width over the heights that centres can have; with an open top far beyond the box. */
typedef struct gg_dsmc_channel_cells {
  int n;                               /* cells */
  int reach;                           /* half width of `kernel`, in half cells */
  double from, width, inverse, volume; /* `from`: lower edge of the first cell */
  uint32_t *start;       /* [n x species + 1]: first grain of each; defined for an empty cell below and above, too */
  uint32_t *start_below; /* [(n + 2) x species + 1]: the allocated array */
  uint32_t *next; /* [parts x stride]: number of grains by part and cell; then index of the next one when sorted */
  size_t stride;
  double *counted; /* [n x species]: grains x time since the last measurement */
  double *mean;    /* [n x species]: mean number of grains, over about a thermal flight of a diameter */
  double *hits;    /* [n]: grains that collided since the last measurement */
  double *chi;     /* [pairs x 2n]: contact value between the middles of cells a and b, at a + b + 1 */
  double *filled;  /* [7 n, and more for extend_mean]: local solid fraction, by set_chi */
  double *kernel;  /* [species x (reach + 1)]: fraction of a cell's grains that fills a slice so many half cells away */
  gg_dsmc_majorant *majorant; /* [n x species x species]: of chi N g_n, with N grains in the partner's cell; of g_n for
                                 the first cell of a block */
  /* Narrow cells: candidates are drawn by blocks of `block` cells; 0: by cells. */
  int block, blocks, far; /* number of blocks; distance of partners in blocks */
  double *height;         /* [far + 1]: largest max(|k_y|, 1/2) of two grains so many blocks apart */
  double *most_chi;       /* [2 blocks]: largest contact value between blocks A and B, at A + B */
} gg_dsmc_channel_cells;

/* Most blocks on either side of a block that have partners. */
enum { GG_DSMC_CHANNEL_MOST_FAR = 12 };

/* Several threads advance a large gas, and no bit depends on their number. Grains fly and are sorted in parts of equal
 * size; each part has a random stream for contacts with walls. Cells collide in slabs: every second slab at once, since
 * these are so far apart that they share no partners. Each slab has its own random streams and sums. */
enum {
  GG_DSMC_CHANNEL_MOST_PARTS = 8,
  GG_DSMC_CHANNEL_MOST_SLABS = 8,
  GG_DSMC_CHANNEL_LEAST_SHARED = 10000 /* fewest grains for several threads */
};

typedef struct gg_dsmc_channel_streams {
  gg_rng walls[GG_DSMC_CHANNEL_MOST_PARTS], cells[GG_DSMC_CHANNEL_MOST_SLABS];
  gg_dsmc_rng_lanes lanes[GG_DSMC_CHANNEL_MOST_SLABS];
} gg_dsmc_channel_streams;

/* A slab of cells, and the sums over its collisions. */
typedef struct gg_dsmc_channel_slab {
  int first, end;   /* cells [first, end) */
  int cells_before; /* cells that collide before them in a step */
  uint64_t collisions, candidates, overflows, clamped;
  gg_collision_sums transfer;
} __attribute__((aligned(64))) gg_dsmc_channel_slab;

/* All other variables of a run: plain data, saved as bytes. */
typedef struct gg_dsmc_channel_state {
  gg_dsmc_channel_streams streams;
  double time;
  double pending;     /* time of flight that is still to be applied, up to the present time */
  double step, rate;  /* time step; collision rate of a grain, averaged over collisions */
  double all_rate;    /* collisions per time */
  double temperature; /* sum m c^2/(3N), the flow included: the scale of majorants */
  double unmeasured;  /* time since the last measurement */
  double overfilled;  /* fraction of grains where contact values are limited, averaged over about a crossing of the
                         channel */
  uint64_t steps, collisions, candidates, overflows, forced_rebounds, clamped;
  gg_collision_sums transfer;
  gg_dsmc_advance advance;
} gg_dsmc_channel_state;

struct gg_dsmc_channel;
typedef void gg_dsmc_channel_collide(struct gg_dsmc_channel *d, double dt);

typedef struct gg_dsmc_channel {
  gg_engine base;
  gg_model model;
  gg_dsmc_channel_grains grains, sorted; /* sorted: room for the next sort */
  uint32_t *place;                       /* of each grain: its cell, then its index after sorting */
  double low[GG_MAX_SPECIES], high[GG_MAX_SPECIES], radius[GG_MAX_SPECIES]; /* heights of centres */
  double reach[GG_PAIRS]; /* distance of centres at contact; 0 in the Boltzmann limit */
  bool periodic;          /* along y, without walls */
  bool heated;            /* by a thermostat, in a periodic channel */
  double kept, loss_rate; /* Gaussian thermostat: energy of the centres, and what the last step lost of it per time */
  gg_vec gravity;
  gg_rule wall_rule; /* rule of contacts with walls; without spins a wall acts on the centre */
  gg_dsmc_channel_cells cells;
  gg_coefficient_tables *tables;
  int parts, slabs;
  gg_dsmc_channel_slab *slab;
  gg_thread_pool *pool; /* NULL: one thread does all */
  gg_dsmc_channel_state now;
  gg_dsmc_channel_collide *collide;
  bool plain; /* for tests: candidates one by one */
  gg_collision_callback *callback;
  void *callback_context;
} gg_dsmc_channel;

/* Copy of one grain. */
typedef struct gg_dsmc_channel_grain {
  gg_vec r, c, s; /* s: 0 without spins */
  int species;
  bool touched; /* it has touched a wall */
} gg_dsmc_channel_grain;

/* Sums over contacts with walls. */
typedef struct gg_dsmc_channel_contacts {
  gg_surface_sums surface[GG_MOST_SURFACES];
  uint64_t forced_rebounds; /* contacts that would have left a grain at rest on a wall */
  bool shown;               /* report contacts to the callback */
  uint32_t id;              /* of the present grain */
} __attribute__((aligned(64))) gg_dsmc_channel_contacts;

/* First grain of a part. */
GG_INLINE size_t gg_dsmc_channel_part(const gg_dsmc_channel *d, int part)
{
  return (size_t)d->model.n * (size_t)part / (size_t)d->parts;
}

/* The image of a height in a periodic channel. */
GG_INLINE double gg_dsmc_channel_wrap(const gg_dsmc_channel *d, double y)
{
  return y - d->model.box[1] * floor(y / d->model.box[1]);
}

/* channel_flight.c: move all grains for a time, and count them by cell. */
void gg_dsmc_channel_fly(gg_dsmc_channel *d, double dt);
/* Move one grain for a time; the engine is unchanged. */
void gg_dsmc_channel_fly_grain(const gg_dsmc_channel *d, double dt, gg_rng *rng, gg_dsmc_channel_grain *grain,
                               gg_dsmc_channel_contacts *all);

/* channel_heat.c: the thermostat of a periodic channel acts for half of a step, before and after its collisions. */
bool gg_dsmc_channel_is_heated(const gg_model *model);
void gg_dsmc_channel_heat_before(gg_dsmc_channel *d, double dt);
void gg_dsmc_channel_heat_after(gg_dsmc_channel *d, double dt);

/* channel_cells.c */
gg_status gg_dsmc_channel_cells_new(gg_dsmc_channel *d, gg_error *err);
void gg_dsmc_channel_cells_free(gg_dsmc_channel_cells *cells);
/* Width of a cell. */
double gg_dsmc_channel_cell_width(const gg_model *model);
/* Time step in mean free times. */
double gg_dsmc_channel_free_times(const gg_model *model);
/* Sort the grains by cell, after a flight. */
void gg_dsmc_channel_sort(gg_dsmc_channel *d);
/* Set the contact values by the present mean numbers. Returns the number of grains where contact values are limited. */
double gg_dsmc_channel_set_chi(gg_dsmc_channel *d);
/* Measure mean numbers, contact values and temperature over the last steps, and choose the next step. */
void gg_dsmc_channel_measure(gg_dsmc_channel *d);
void gg_dsmc_channel_choose_step(gg_dsmc_channel *d);

/* channel_collide.c, compiled once for each set of instructions, with the same bits: the collisions of a step. The
 * grains must be sorted. */
#define GG_DSMC_CHANNEL_COLLIDE_OF(set, name) gg_dsmc_channel_collide gg_dsmc_channel_collide_##name;
GG_EACH_COMPILED_SET(GG_DSMC_CHANNEL_COLLIDE_OF)
extern gg_dsmc_channel_collide *const gg_dsmc_channel_collide_of[GG_INSTRUCTION_SETS];

/* channel_start.c: allocate an engine for this model. The caller sets base.ops. */
gg_status gg_dsmc_channel_allocate(const gg_model *model, gg_dsmc_channel **d, gg_error *err);
/* Allocate times of last contacts, if there are none. */
gg_status gg_dsmc_channel_allocate_last(gg_dsmc_channel *d, gg_error *err);
void gg_dsmc_channel_destroy(gg_engine *engine);
/* Set the initial state. Arrays of `given` (NULL: none) are taken as they are. */
gg_status gg_dsmc_channel_start(gg_dsmc_channel *d, uint64_t seed, uint64_t stream, const gg_grain_arrays *given,
                                gg_error *err);

/* channel_describe.c */
gg_status gg_dsmc_channel_accepts(const gg_model *model, gg_error *err);
double gg_dsmc_channel_bytes(const gg_model *model);
void gg_dsmc_channel_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);

/* channel_checkpoint.c. The caller of gg_dsmc_channel_restore sets base.ops. */
gg_status gg_dsmc_channel_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_channel_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

/* True of a model for this engine: with walls, or with a wave in a periodic channel. */
static inline bool gg_dsmc_channel_has(const gg_model *model)
{
  return gg_flow_is_walled(model->flow) || model->wave > 0;
}

/* channel_engine.c: operations of engines in a channel; gg_dsmc_ops passes their models to them. */
extern const gg_engine_ops gg_dsmc_channel_ops;

#endif
