/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Species and their pairs. GG_MAX_SPECIES may be changed: everything else follows from it. */
#ifndef GG_SPECIES_H
#define GG_SPECIES_H

#include <stdbool.h>
#include <stdint.h>

enum { GG_MAX_SPECIES = 16, GG_PAIRS = GG_MAX_SPECIES * (GG_MAX_SPECIES + 1) / 2 };

/* Index of the unordered pair of species i, j: 11, 12, 22, 13, 23, 33 ... It does not depend on how many species there
 * are, so that those of one species or two come first. */
static inline int gg_pair(int i, int j)
{
  return i < j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j;
}
enum { GG_11, GG_12, GG_22 };

/* How many pairs so many species have. */
static inline int gg_pairs_of(int n_species)
{
  return n_species * (n_species + 1) / 2;
}

/* The species of a pair, i <= j. */
typedef struct gg_species_pair {
  int i, j;
} gg_species_pair;
gg_species_pair gg_common_pair_species(int pair);

/* A pair as scenes and results name it: "12"; from the tenth species on "1-10". */
enum { GG_PAIR_NAME = 16 };
const char *gg_common_pair_name(int pair, char name[GG_PAIR_NAME]);
/* The pair of such a name, in either order of its species; "1-2" is 12, too. -1: the pair of no two species. */
int gg_common_pair_find(const char *name);

/* Whole numbers of n grains by species: the largest remainders are rounded up, among equal ones the first. */
void gg_common_species_deal(int64_t n, int n_species, const double *weight, int64_t *n_of);

#endif
