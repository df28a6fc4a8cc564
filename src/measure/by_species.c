#include "measure/by_species.h"

gg_species_view gg_measure_species_chunk(const gg_chunk *chunk, int species, gg_species_scratch *scratch)
{
  gg_species_view v = {0};
  if (!chunk->species) {
    v.n = species == 0 ? chunk->n : 0;
    for (int a = 0; a < 3; a++) v.c[a] = chunk->c[a], v.s[a] = chunk->s[a];
    return v;
  }
  for (size_t i = 0; i < chunk->n; i++) {
    if (chunk->species[i] != species) continue;
    for (int a = 0; a < 3; a++) {
      scratch->c[a][v.n] = chunk->c[a][i];
      if (chunk->s[0]) scratch->s[a][v.n] = chunk->s[a][i];
    }
    v.n++;
  }
  for (int a = 0; a < 3; a++) {
    v.c[a] = scratch->c[a];
    v.s[a] = chunk->s[0] ? scratch->s[a] : NULL;
  }
  return v;
}
