/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of an event-driven run. Each grain has two records of 64 bytes: gg_md_grain is read by every prediction,
 * gg_md_node by the grain's own events only. Around them are the box, the cells, the event queue and the sums.
 *
 * A record holds the position at its own time t, the grain's last event; r(t') = r + v (t' - t). Times count from the
 * start of the present epoch. At the end of an epoch all times are re-zeroed (epoch.c), so that the last digit of a
 * time means the same after 10^10 collisions as after 10^4.
 *
 * Velocities are laboratory velocities in the box, v = C + shear_rate (y - L_y/2) x_hat. */
#ifndef GG_MD_STATE_H
#define GG_MD_STATE_H

#include "common/engine.h"
#include "common/laws/coefficient_tables.h"
#include "common/rng.h"
#include "common/thermostat.h"
#include "md/box.h"
#include "md/cell_grid.h"
#include "md/contacts.h"
#include "md/queue.h"

typedef struct gg_md_grain {
  gg_vec r, v;
  double t;
  uint32_t species; /* before the counter: batches read it in the lowest bits of both words as one */
  uint32_t counter; /* collision counter: changes of velocity so far */
} __attribute__((aligned(64))) gg_md_grain;

/* Images of the box: a grain has left the box upwards along an axis so many times more often than downwards. */
typedef struct gg_md_image {
  int32_t x, y, z;
} gg_md_image;

/* Skin of a grain, a sphere. The grain may not leave it before its neighbour list is updated. */
typedef struct gg_md_skin {
  gg_vec centre; /* under shear it moves with the flow: its position at the start of the epoch */
} gg_md_skin;
enum { GG_MD_LIST = 24 }; /* most neighbours in a list */

/* Room for candidates of a search, and distance between the arrays of two searches. A load waits for a store to an
 * address with the same lower twelve bits, so the two arrays are half a page apart. They are not on the stack, whose
 * address varies from run to run. */
enum { GG_MD_MOST_CANDIDATES = 2048, GG_MD_CANDIDATES_APART = GG_MD_MOST_CANDIDATES + 512 };

/* A row of cells along x that moves with the flow (search/comoving_rows.h). */
typedef struct gg_md_row {
  double origin, speed; /* origin: position of its first cell at the start of the epoch */
  int32_t above, below; /* cells by which the rows above and below are shifted against it */
} gg_md_row;

/* Neighbour searches, each a header of search/. Rows, overlapping or not, move with the flow. */
typedef enum gg_md_search_kind {
  GG_MD_PLAIN_CELLS,
  GG_MD_COMOVING_ROWS,
  GG_MD_OVERLAPPING_CELLS,
  GG_MD_OVERLAPPING_ROWS,
  GG_MD_NEIGHBOUR_LISTS,
  GG_MD_SEARCH_KINDS
} gg_md_search_kind;

/* Data of a search beside the cells. */
typedef struct gg_md_rows {
  gg_md_row *row;    /* for each layer along y, and for images: -1, n_y, n_y + 1 */
  double next_shift; /* epoch time of the next shift by a cell; INFINITY: never */
} gg_md_rows;
typedef struct gg_md_lists {
  gg_md_skin *skin;
  uint32_t *neighbour;                           /* GG_MD_LIST a grain */
  double radius;                                 /* s, of the skins */
  double shrinkage;                              /* kappa: rate at which skins shrink under shear */
  double reach[GG_MAX_SPECIES * GG_MAX_SPECIES]; /* sigma + 2 s by ordered pair of species (gg_md_pair) */
} gg_md_lists;

typedef struct gg_md_search_state {
  gg_md_search_kind kind;
  uint8_t *near[3]; /* surfaces that a grain can touch before its next crossing, a bit each, by the index of its cell
                       along each axis; the AND of the three counts. NULL: no surfaces */
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
  double chance;          /* fraction of slots with a kick; in a bath: with one of fixed length, others are Gaussian */
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

/* Resolves a contact of two grains at the present time: dr from 1 to 2, c12 = c1 - c2, for the nearest images. */
typedef void gg_md_resolution(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12);
/* Resolves a contact of a grain with a surface of the model. */
typedef void gg_md_surface_resolution(gg_md *e, uint32_t i, int surface);
/* An instance of the event loop (event_loops.h). */
typedef struct gg_md_kernel {
  void (*run)(gg_md *e);                                 /* run events until k.stop, k.collisions_left or e->look_at */
  void (*predict)(gg_md *e, uint32_t from, uint32_t to); /* predict the next events of these grains */
  void (*predict_two)(gg_md *e, uint32_t i, uint32_t j);
} gg_md_kernel;

/* Plain data beside the arrays; a checkpoint holds its bytes. */
typedef struct gg_md_counts {
  double now, epoch_start;                 /* present time in the epoch; start of the epoch in the time of the run */
  double contact_time;                     /* absolute; 0: off */
  double mean_free_time;                   /* present mean free time per grain */
  double window_time;                      /* since mean_free_time was last measured */
  uint64_t window_collisions;              /* in window_time */
  uint64_t epoch_events, epoch_collisions; /* counts at the start of the epoch */
  uint64_t collisions, events, treated, wall_treated, clamped;
  double worst_overlap;
  gg_rng rng;
  double next_kick;        /* epoch time of the earliest slot; INFINITY: no kicks */
  double kick_temperature; /* highest temperature for which slots are frequent enough */
  gg_md_kick_progress kick[GG_MAX_SPECIES];
  /* Gaussian thermostat (md_thermostat.h): the gas inside cools freely; outside, velocities are larger by `scale` and
   * the clock is slower by it. */
  double scale, kinetic, kinetic0; /* kinetic: present energy inside; kinetic0: constant energy outside */
  double mark, outer;              /* at inside time `mark` the outside time since the advance began was `outer` */
  double outer_time;               /* outside time up to the present advance */
  /* The present advance, which may have been stopped. */
  double asked;             /* its length, outside */
  double stop;              /* its end, or the end of its present leg, in epoch time */
  double beyond_kick;       /* rest of it after the next kick; -INFINITY: no kick before its end */
  uint64_t collisions_left; /* of it */
  double image_turns;       /* edges by which the image above has moved before the epoch, beside the offset */
  double fractional_shift, common_shift; /* of co-moving rows (row_motion.c), at the start of the epoch */
  int32_t row_shift, image_shift;
  int32_t power;              /* velocities are 2^power times those of the start (rescale) */
  gg_collision_sums transfer; /* last: it is long */
} gg_md_counts;

struct gg_md {
  gg_engine base;
  gg_model model;
  gg_md_contacts contacts;
  gg_md_grain *grain; /* n grains, and one at position NaN, which meets none, to fill up lists */
  gg_md_node *node;
  gg_vec *spin;                  /* surface velocities, outside of a Gaussian thermostat; NULL: smooth grains */
  gg_coefficient_tables *tables; /* of coefficients that depend on the speed; NULL: none */
  double *last;                  /* times of last collisions, for the contact-time rule or a callback; NULL: neither */
  gg_md_image *image;            /* of each grain (images.h); NULL: not counted */
  uint32_t *id;                  /* number of each grain in results; in memory grains follow a space-filling curve */
  uint32_t n;
  gg_vec gravity;
  bool falls; /* gravity is not zero */
  gg_md_box box;
  gg_md_cells cells;
  gg_md_search_state search;
  uint32_t *candidates; /* of two searches, GG_MD_CANDIDATES_APART from each other (search/candidates.h) */
  gg_md_queue queue;
  gg_md_counts k;
  uint64_t look_at;   /* number of events at which the loop returns, to poll `stop` */
  bool plain;         /* for tests: the reference path, one pair at a time */
  bool out_of_memory; /* a cell could not grow: the run has failed */
  bool no_number;     /* a NaN or infinity was found: the run has failed (verify.c) */
  bool stands_still;  /* the contacts of one grain never end: the run has failed */
  uint64_t check_at;  /* number of events at which all grains are inspected again */
  const gg_md_kernel *kernel;
  gg_md_resolution *resolve;
  gg_md_surface_resolution *resolve_surface;
  gg_collision_callback *callback; /* receives every collision; NULL: none, and `resolve` is not wrapped */
  void *callback_context;
  gg_md_resolution *resolve_shown; /* resolution that a callback wraps */
  gg_md_surface_resolution *resolve_surface_shown;
  gg_md_resolution *resolve_parted; /* resolution that gg_md_resolve_parting wraps */
  gg_heat heat;
  double noise; /* xi^2 of white noise without drag */
  gg_md_kicks kicks;
  struct gg_md_parallel *parallel; /* parallel/: threads that share the events; NULL: one thread */
  bool is_thread_local;            /* a copy for a thread (parallel/parallel.h), which cannot rebuild all lists */
  bool lists_are_full;             /* set by such a copy if it would have to */
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

/* Position and velocity of a grain at epoch time t; on a parabola only if the constant `gravity` is true. */
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
