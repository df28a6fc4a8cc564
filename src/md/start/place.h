/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places for the centres at a start: a lattice, or random ones pushed apart. */
#ifndef GG_MD_START_PLACE_H
#define GG_MD_START_PLACE_H

#include <stdatomic.h>
#include <stdbool.h>

#include "base/cancellation.h"
#include "base/thread_pool.h"
#include "common/model.h"
#include "common/rng.h"
#include "md/cell_grid.h"

/* Of what overlaps by less, nothing is known but rounding. Fresh places leave as much free. */
#define GG_MD_TOUCHING 1e-9

/* Centres and diameters in a box, on their way to a state without overlaps. */
typedef struct gg_md_packing {
  gg_md_box box;         /* inverse[a] = 0: closed along a, no closer to its ends than a radius */
  const gg_model *model; /* whose surfaces keep the centres off */
  uint32_t n;
  gg_vec *r;
  const double *diameter;
  gg_md_cells cells; /* none in boxes below three cells across: then all pairs are tried */
  const gg_stop *stop;
  atomic_bool stopped;  /* the caller said so, and is not asked again */
  gg_thread_pool *pool; /* shares large boxes; NULL: one thread */
  uint64_t tried;       /* grains, over all sweeps */
} gg_md_packing;

/* From any thread that shares it. */
static inline bool gg_md_place_is_stopped(gg_md_packing *p)
{
  if (!atomic_load(&p->stopped) && gg_stop_asked(p->stop)) atomic_store(&p->stopped, true);
  return atomic_load(&p->stopped);
}

/* GG_INTERRUPTED, and why. */
gg_status gg_md_place_interrupted(gg_error *err);

/* Order centres along a space-filling curve; `id` (may be NULL) receives which one each was. */
gg_status gg_md_place_sort(gg_md_packing *p, uint32_t *id, gg_error *err);
/* n of the sites of a face-centred lattice that fills the box. */
void gg_md_place_lattice(const gg_md_box *box, uint32_t n, gg_rng *rng, gg_vec *r);
/* By what share of a diameter grains are pushed beyond contact: denser systems leave less room. */
double gg_md_place_margin(double phi);
/* Push overlapping grains apart, *free: no overlap is left after so many sweeps. Positions end in the box. */
gg_status gg_md_place_relax(gg_md_packing *p, double margin, int most_sweeps, bool *free, gg_error *err);
/* relax_lists.c: the same for large periodic boxes, faster and with other places; is this one? */
bool gg_md_place_has_lists(const gg_md_packing *p);
gg_status gg_md_place_relax_lists(gg_md_packing *p, double margin, int most_sweeps, bool *free, gg_error *err);
/* Into the box: wrapped, or off the walls. */
void gg_md_place_into_box(const gg_md_packing *p, uint32_t i);
/* GG_BAD_INPUT names two grains, or a grain and a wall, that overlap by more than rounding. */
gg_status gg_md_place_check(gg_md_packing *p, const uint32_t *id, gg_error *err);

#endif
