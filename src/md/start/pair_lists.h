/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs of grains that may come to overlap in a large periodic box, each once, in parts that threads share. A part is
 * a range of grains, which stand along a space-filling curve, so that most of its pairs are its own. Parts do not
 * depend on the number of threads. */
#ifndef GG_MD_START_PAIR_LISTS_H
#define GG_MD_START_PAIR_LISTS_H

#include "md/start/place.h"

enum { GG_MD_PLACE_PARTS = 16, GG_MD_PLACE_BETWEEN_LOOKS = 1 << 14 /* grains: some milliseconds */ };

typedef struct gg_md_pair_part {
  uint32_t first, end; /* its grains */
  size_t *from;        /* of its grain i: neighbour[from[i - first]] to neighbour[from[i - first + 1]], its own, too */
  uint32_t *neighbour;
  uint32_t (*across)[2]; /* pairs with grains of other parts */
  size_t room, n_across, room_across;
  bool failed; /* no memory */
} gg_md_pair_part;

/* A grain where it stands when lists are made, in the order of cells. */
typedef struct gg_md_listed {
  gg_vec r;
  double reach; /* pairs are listed up to the sum of both */
} gg_md_listed;

typedef struct gg_md_pair_lists {
  gg_md_packing *p;
  double margin, skin;
  int32_t n[3];
  double inverse[3];     /* of a cell's width */
  uint32_t *begin;       /* of a cell in the order of cells */
  uint32_t *cell, *rank; /* of a grain: its cell, its place in that order */
  uint32_t *grain;       /* in that order */
  gg_vec *before;        /* of a grain: where it stands */
  gg_md_listed *listed;  /* likewise */
  gg_md_pair_part part[GG_MD_PLACE_PARTS];
} gg_md_pair_lists;

gg_status gg_md_pair_lists_make(gg_md_pair_lists *l, gg_md_packing *p, double margin, double skin, gg_error *err);
void gg_md_pair_lists_free(gg_md_pair_lists *l);

/* All pairs closer than (1 + margin) contact distances and a skin, as grains stand now, which are put into the box. */
gg_status gg_md_pair_lists_fill(gg_md_pair_lists *l, gg_error *err);

#endif
