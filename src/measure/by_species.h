/* Sort the grains of a chunk by species into scratch, so that observables are written for one species only. */
#ifndef GG_BY_SPECIES_H
#define GG_BY_SPECIES_H

#include "common/engine.h"

typedef struct gg_species_scratch {
  double c[3][GG_CHUNK], s[3][GG_CHUNK];
} gg_species_scratch;

/* The grains of one species in the chunk: pointers into the chunk itself (one species) or into scratch. */
typedef struct gg_species_view {
  size_t n;
  const double *c[3], *s[3]; /* s[0] NULL without spins */
} gg_species_view;

gg_species_view gg_measure_species_chunk(const gg_chunk *chunk, int species, gg_species_scratch *scratch);

#endif
