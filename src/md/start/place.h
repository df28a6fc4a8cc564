/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Positions of the centres at a start: a lattice, or random points pushed apart. */
#ifndef GG_MD_START_PLACE_H
#define GG_MD_START_PLACE_H

#include <stdatomic.h>
#include <stdbool.h>

#include "base/cancellation.h"
#include "base/thread_pool.h"
#include "common/model.h"
#include "common/rng.h"
#include "md/cell_grid.h"

/* Overlap in contact distances that may be rounding. Fresh positions leave as much free. */
#define GG_MD_TOUCHING 1e-9

/* Centres and diameters in a box, on their way to a state without overlaps. */
typedef struct gg_md_packing {
  gg_md_box box;         /* inverse[a] = 0: closed along a, and centres keep a radius from its ends */
  const gg_model *model; /* its surfaces keep the centres off */
  uint32_t n;
  gg_vec *r;
  const double *diameter;
  gg_md_cells cells; /* none in boxes of fewer than three cells along an edge: all pairs are tested */
  const gg_stop *stop;
  atomic_bool stopped;  /* `stop` was set; it is not polled again */
  gg_thread_pool *pool; /* for large boxes; NULL: one thread */
  uint64_t tried;       /* grains, over all sweeps */
} gg_md_packing;

/* Poll `stop`, from any thread. */
static inline bool gg_md_place_is_stopped(gg_md_packing *p)
{
  if (!atomic_load(&p->stopped) && gg_stop_asked(p->stop)) atomic_store(&p->stopped, true);
  return atomic_load(&p->stopped);
}

/* The error of an interruption. */
gg_status gg_md_place_interrupted(gg_error *err);

/* Sort centres along a space-filling curve; `id` (may be NULL) receives the old index of each. */
gg_status gg_md_place_sort(gg_md_packing *p, uint32_t *id, gg_error *err);
/* Choose n random sites of a face-centred lattice that fills the box. */
void gg_md_place_lattice(const gg_md_box *box, uint32_t n, gg_rng *rng, gg_vec *r);
/* Margin in diameters by which grains are pushed beyond contact: denser systems leave less room. */
double gg_md_place_margin(double phi);
/* Push overlapping grains apart in at most so many sweeps. *free: no overlap remains. Positions are in the box. */
gg_status gg_md_place_relax(gg_md_packing *p, double margin, int most_sweeps, bool *free, gg_error *err);
/* relax_lists.c: true of a large periodic box, for gg_md_place_relax_lists. */
bool gg_md_place_has_lists(const gg_md_packing *p);
/* The same as gg_md_place_relax, faster and with other positions. */
gg_status gg_md_place_relax_lists(gg_md_packing *p, double margin, int most_sweeps, bool *free, gg_error *err);
/* Move a centre into the box: wrapped, and off the walls. */
void gg_md_place_into_box(const gg_md_packing *p, uint32_t i);
/* Validate given positions: GG_BAD_INPUT names two grains, or a grain and a wall, that overlap by more than rounding.
 */
gg_status gg_md_place_check(gg_md_packing *p, const uint32_t *id, gg_error *err);

#endif
