/* The bound on g_n of one pair of species: learned from the candidates, kept relative to the thermal speed so that it
 * follows a cooling or heating gas, exceeded rarely and never unnoticed. */
#ifndef GG_DSMC_MAJORANT_H
#define GG_DSMC_MAJORANT_H

#include <stdint.h>

typedef struct gg_majorant {
  double now, before; /* largest g_n over thermal speed in this window of candidates, and in the one before */
  uint64_t seen;      /* candidates in this window */
} gg_majorant;

/* Start from a bound that holds for sure. */
void gg_majorant_start(gg_majorant *m, double bound, double thermal);
/* The bound to use at this thermal speed. */
double gg_majorant_bound(const gg_majorant *m, double thermal);
/* Take in the largest g_n among `candidates`; a window ends after `window` of them. */
void gg_majorant_learn(gg_majorant *m, double worst, double thermal, uint64_t candidates, uint64_t window);

#endif
