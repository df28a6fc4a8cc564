/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of the pairs of grains that may overlap in a large periodic box, each pair once, in parts for several threads.
 * A part is a range of grains along a space-filling curve, so most of its pairs are within it. Parts do not depend on
 * the number of threads. */
#ifndef GG_MD_START_PAIR_LISTS_H
#define GG_MD_START_PAIR_LISTS_H

#include "md/start/place.h"

enum {
  GG_MD_PLACE_PARTS = 16,
  GG_MD_PLACE_PER_POLL = 1 << 14 /* grains between polls of `stop`: some milliseconds */
};

typedef struct gg_md_pair_part {
  uint32_t first, end; /* its grains */
  size_t
      *from; /* neighbours of grain i within the part: neighbour[from[i - first]] to neighbour[from[i - first + 1]] */
  uint32_t *neighbour;
  uint32_t (*across)[2]; /* pairs with grains of other parts */
  size_t room, n_across, room_across;
  bool failed; /* out of memory */
} gg_md_pair_part;

/* A grain when lists are made; in the order of cells. */
typedef struct gg_md_listed {
  gg_vec r;
  double reach; /* pairs are listed up to the sum of both reaches */
} gg_md_listed;

typedef struct gg_md_pair_lists {
  gg_md_packing *p;
  double margin, skin;
  int32_t n[3];
  double inverse[3];     /* of the width of a cell */
  uint32_t *begin;       /* first rank of each cell in the order of cells */
  uint32_t *cell, *rank; /* of each grain: its cell, its rank in that order */
  uint32_t *grain;       /* by rank */
  gg_vec *before;        /* position of each grain when lists are made */
  gg_md_listed *listed;  /* by rank */
  gg_md_pair_part part[GG_MD_PLACE_PARTS];
} gg_md_pair_lists;

gg_status gg_md_pair_lists_make(gg_md_pair_lists *l, gg_md_packing *p, double margin, double skin, gg_error *err);
void gg_md_pair_lists_free(gg_md_pair_lists *l);

/* List all pairs closer than (1 + margin) contact distances plus a skin. Positions are wrapped into the box. */
gg_status gg_md_pair_lists_fill(gg_md_pair_lists *l, gg_error *err);

#endif
