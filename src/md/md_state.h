/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of an event-driven run: one 64-byte record a grain for what every prediction reads, one for what only the
 * grain's own events read, and the box, the cells, the event queue and the sums around them.
 *
 * Each grain is kept where it stood at its own time t, its last event; r(t') = r + v (t' - t) wherever it is needed.
 * Times count from the start of the present epoch: at an epoch's end all of them are re-zeroed (epoch.c), so that the
 * last digit of a time means the same after 10^10 collisions as after 10^4.
 *
 * Velocities are laboratory velocities in the box, v = C + shear_rate (y - L_y/2) x_hat. */
#ifndef GG_MD_STATE_H
#define GG_MD_STATE_H

#include "common/engine.h"
#include "common/laws/loss_table.h"
#include "common/rng.h"
#include "md/box.h"
#include "md/cell_grid.h"
#include "md/contacts.h"
#include "md/queue.h"

typedef struct gg_md_grain {
  gg_vec r, v;
  double t;
  uint32_t species; /* before the counter: batches find it in the lowest bits of both words as one */
  uint32_t counter; /* changes of velocity so far */
} __attribute__((aligned(64))) gg_md_grain;

/* Of the neighbour lists: the centre of the skin, which the grain may not leave before its list is updated. */
typedef struct gg_md_skin {
  gg_vec centre; /* under shear: where it stood at the epoch's start, moving with the flow */
} gg_md_skin;
enum { GG_MD_LIST = 24 }; /* most neighbours in a list */

/* Room for so many grains to try. Stores into one array and loads from another do not hinder each other where the
 * lower twelve bits of their addresses differ: the arrays of two searches lie half a page apart, and not on the stack,
 * which stands elsewhere at every start. */
enum { GG_MD_MOST_CANDIDATES = 2048, GG_MD_CANDIDATES_APART = GG_MD_MOST_CANDIDATES + 512 };

/* A row of cells along x that moves with the flow (search/comoving_rows.h): where its first cell begins at the epoch's
 * start, its speed, and by how many cells the rows above and below are ahead of it. */
typedef struct gg_md_row {
  double origin, speed;
  int32_t above, below;
} gg_md_row;

/* How neighbours are found: a header of search/ each. Rows, overlapping or not, move with the flow. */
typedef enum gg_md_search_kind {
  GG_MD_PLAIN_CELLS,
  GG_MD_COMOVING_ROWS,
  GG_MD_OVERLAPPING_CELLS,
  GG_MD_OVERLAPPING_ROWS,
  GG_MD_NEIGHBOUR_LISTS,
  GG_MD_SEARCH_KINDS
} gg_md_search_kind;

/* What such a search keeps beside the cells. */
typedef struct gg_md_rows {
  gg_md_row *row;    /* one for each layer along y, and images: -1, n_y, n_y + 1 */
  double next_shift; /* epoch time at which rows will have shifted by a cell; INFINITY: never */
} gg_md_rows;
typedef struct gg_md_lists {
  gg_md_skin *skin;
  uint32_t *neighbour;                           /* GG_MD_LIST a grain */
  double radius;                                 /* s */
  double shrinkage;                              /* kappa */
  double reach[GG_MAX_SPECIES * GG_MAX_SPECIES]; /* sigma + 2 s by ordered pair of species (gg_md_pair) */
} gg_md_lists;

typedef struct gg_md_search_state {
  gg_md_search_kind kind;
  uint8_t *near[3]; /* by index of a grain's cell along each axis, the surfaces that it can touch before its next
                       crossing, a bit each: those whose bit is there along all three. NULL without surfaces */
  union {
    gg_md_rows rows;
    gg_md_lists lists;
  };
} gg_md_search_state;

/* Kick schedule of a species (kicks.h). */
typedef struct gg_md_kick_schedule {
  uint32_t first, n;      /* grains of the species in `order` */
  uint32_t group;         /* grains that are kicked one after the other */
  uint32_t step;          /* from one group to the next, in groups */
  double interval;        /* mean time between slots of the species */
  double size;            /* change of velocity; in a bath its standard deviation along each axis */
  double keep, spin_keep; /* in a bath: factor of the velocity, of the spin */
  double spin_size;       /* in a bath: standard deviation of the change of spin along each axis */
} gg_md_kick_schedule;
typedef struct gg_md_kicks {
  gg_md_kick_schedule schedule[GG_MAX_SPECIES];
  uint32_t *order; /* grains by species; NULL: one species */
} gg_md_kicks;
typedef struct gg_md_kick_progress {
  double at;       /* epoch time of the next slot */
  uint64_t number; /* of the next slot */
} gg_md_kick_progress;

typedef struct gg_md gg_md;

/* What happens to two grains in contact at the present time: dr from 1 to 2, c12 = c1 - c2, images accounted for. */
typedef void gg_md_resolution(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12);
/* What happens to a grain in contact with a surface of the model. */
typedef void gg_md_surface_resolution(gg_md *e, uint32_t i, int surface);
/* An instance of the event loop (kernels.h). */
typedef struct gg_md_kernel {
  void (*run)(gg_md *e); /* handle events until k.stop, k.collisions_left or e->look_at */
  void (*predict)(gg_md *e, uint32_t from, uint32_t to); /* predict the next event of each of these grains */
} gg_md_kernel;

/* Plain data beside the arrays: goes into a checkpoint as it is. */
typedef struct gg_md_counts {
  double now, epoch_start; /* present time in the epoch, and the epoch's start in the run's */
  double contact_time;     /* absolute; 0: off */
  double mean_free_time;   /* present mean free time per grain */
  double window_time;      /* since mean_free_time was last measured, with so many collisions */
  uint64_t window_collisions, epoch_events, epoch_collisions; /* the latter two: counts at the epoch's start */
  uint64_t collisions, events, treated, wall_treated, clamped;
  double worst_overlap;
  gg_rng rng;
  double next_kick;        /* epoch time of the earliest slot; INFINITY: no kicks */
  double kick_temperature; /* highest temperature for which slots are frequent enough */
  gg_md_kick_progress kick[GG_MAX_SPECIES];
  /* Gaussian thermostat: the gas inside cools freely; outside, velocities are `scale` times larger and clocks slower.
   */
  double scale, kinetic, kinetic0; /* kinetic: energy inside, at present; kinetic0: outside, kept */
  double mark, outer;              /* outside time `outer` since the advance began had gone by at inside time `mark` */
  double outer_time;               /* outside, up to the present advance */
  /* Of the present advance, which may have been stopped. */
  double asked, stop;                    /* its length, outside; its end, or that of its present leg, in epoch time */
  double beyond_kick;                    /* what is left of it after the next kick; -INFINITY: that comes too late */
  uint64_t collisions_left;              /* to it */
  double fractional_shift, common_shift; /* of co-moving rows (row_motion.c), at the epoch's start */
  int32_t row_shift, image_shift;
  uint32_t keeps_sums;
  int32_t power;              /* velocities are 2^power times those of the start (rescale) */
  gg_collision_sums transfer; /* last: it is long */
} gg_md_counts;

struct gg_md {
  gg_engine base;
  gg_model model;
  gg_md_contacts contacts;
  gg_md_grain *grain; /* n of them, and one at no place that nobody meets, to fill up lists with */
  gg_md_node *node;
  gg_vec *spin;          /* surface velocities, those outside of a Gaussian thermostat; NULL for smooth grains */
  gg_loss_table *losses; /* of a built-in law of restitution; NULL: none */
  double *last;          /* time of the last collision, for the contact-time rule or a callback; NULL without either */
  uint32_t *id;          /* the grain's number to the outside; grains stand in memory along a space-filling curve */
  uint32_t n;
  gg_vec gravity;
  bool falls; /* gravity is not zero */
  gg_md_box box;
  gg_md_cells cells;
  gg_md_search_state search;
  uint32_t *candidates; /* of two searches at a time, GG_MD_CANDIDATES_APART: whom to try (search/candidates.h) */
  gg_md_queue queue;
  gg_md_counts k;
  uint64_t look_at;   /* events after which the loop is left, to look whether to stop */
  bool plain;         /* one pair at a time, the reference for the tests */
  bool out_of_memory; /* a cell could not grow: the run is over */
  bool no_number;     /* nor does it continue with what is no number (verify.c) */
  bool stands_still;  /* nor where one grain's contacts never end */
  uint64_t check_at;  /* events after which all grains are looked at again */
  const gg_md_kernel *kernel;
  gg_md_resolution *resolve;
  gg_md_surface_resolution *resolve_surface;
  gg_collision_callback *callback; /* receives every collision; NULL: none, and `resolve` is not wrapped */
  void *callback_context;
  gg_md_resolution *resolve_shown; /* what `resolve` goes on to then */
  gg_md_surface_resolution *resolve_surface_shown;
  gg_md_resolution *resolve_parted; /* what gg_md_resolve_parting goes on to */
  gg_thermostat thermostat;
  double noise; /* xi^2 of the white-noise thermostat */
  gg_md_kicks kicks;
  struct gg_md_parallel *parallel; /* parallel/: threads that share the events; NULL: one does all */
  bool is_thread_local;            /* of one of them: no lists are made anew, but */
  bool lists_are_full;
};

GG_INLINE bool gg_md_search_has_rows(gg_md_search_kind kind)
{
  return kind == GG_MD_COMOVING_ROWS || kind == GG_MD_OVERLAPPING_ROWS;
}
GG_INLINE bool gg_md_search_overlaps(gg_md_search_kind kind)
{
  return kind == GG_MD_OVERLAPPING_CELLS || kind == GG_MD_OVERLAPPING_ROWS;
}

GG_INLINE int gg_md_species_of(const gg_md_grain *g)
{
  return (int)g->species;
}

/* Where the grain is at epoch time t, and how it moves there; on a parabola only if the constant `gravity` is true. */
GG_INLINE gg_vec gg_md_position(const gg_md *e, bool gravity, const gg_md_grain *g, double t)
{
  double dt = t - g->t;
  gg_vec r = gg_axpy(dt, g->v, g->r);
  return gravity ? gg_axpy(0.5 * dt * dt, e->gravity, r) : r;
}
GG_INLINE gg_vec gg_md_velocity(const gg_md *e, bool gravity, const gg_md_grain *g, double t)
{
  return gravity ? gg_axpy(t - g->t, e->gravity, g->v) : g->v;
}

#endif
