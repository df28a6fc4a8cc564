/* Collisions between two species (or within one) over a stretch of time: what a kernel is given and what it hands back.
 *
 * Bird's null-collision selection carried to the Enskog equation (Montanero & Santos, Phys. Rev. E 54 (1996) 438):
 * every pair of grains and direction k collides at rate (sigma^2 chi/V) dk max(0, g_n), g_n = k.C12 - sigma rate k_x
 * k_y (the second term is the shear between the centres: with k from 1 to 2, y_1 - y_2 = -sigma k_y). Candidates come
 * at the rate of a bound on g_n and are kept with probability g_n/bound.
 *
 * Rates are cut into layers: a pass realises that part of g_n which lies between `floor` and `floor + bound`. One pass
 * from 0 is all there is unless some g_n went over the top; then one more pass over the layer above makes up
 * for what the first could not do, wherever a candidate noticed. */
#ifndef GG_DSMC_PAIRING_H
#define GG_DSMC_PAIRING_H

#include "common/engine.h"
#include "dsmc/ensemble.h"

typedef enum gg_shear {
  GG_UNSHEARED,
  GG_SHEARED_DILUTE, /* streaming alone */
  GG_SHEARED_DENSE   /* and the difference of flow velocity between the centres */
} gg_shear;

typedef enum gg_tapped {
  GG_TAP_CLOSED,
  GG_TAP_LOSS,  /* Boltzmann: energy loss; there is no collisional stress */
  GG_TAP_STRESS /* Enskog: and collisional stress */
} gg_tapped;

/* What the collisions of a pair of species need; chosen once. */
typedef struct gg_features {
  gg_rule rule;
  gg_shear shear;
  gg_tapped tap;
  bool same; /* both grains of one species */
} gg_features;

/* Whom the plain path shows its collisions to. */
typedef struct gg_watching {
  gg_watch *watch;
  void *context;
  double *last[GG_MAX_SPECIES]; /* when each grain last collided; -INFINITY: not yet */
} gg_watching;

/* Blocks of a population. */
typedef struct gg_range {
  uint32_t first, n;
} gg_range;

typedef struct gg_pairing {
  /* given */
  gg_watching *watching;  /* NULL: nobody looks */
  int species[2];         /* for the watcher */
  double time, time_step; /* the same: of the first candidate, and from one to the next */
  gg_population *one, *two;
  gg_range blocks[2]; /* of `one` and `two` that take part; the plain path takes all grains */
  gg_contact contact;
  double shift;             /* sigma x rate */
  double sigma;             /* for the stress */
  double floor, bound;      /* the layer of g_n */
  double drift, drift_step; /* of the first candidate, and from one to the next: rate x time */
  uint64_t candidates;
  double top_unit; /* of the tops of both at the drift where the stretch begins; in the end, where it ends */
  /* handed back */
  uint64_t tried; /* pairs of grains looked at */
  uint64_t collisions, overflows;
  double worst;              /* largest g_n seen */
  double stress[3][3], loss; /* if tapped */
} gg_pairing;

/* Eight streams side by side, for kernels that work on eight lanes. */
typedef struct gg_rng_lanes {
  uint64_t s[4][GG_LANES];
} gg_rng_lanes;

/* Streams `stream` to `stream` + 7 of this seed. */
GG_INLINE void gg_rng_lanes_seed(gg_rng_lanes *lanes, uint64_t seed, uint64_t stream)
{
  for (unsigned l = 0; l < GG_LANES; l++) {
    gg_rng lane = gg_rng_seed(seed, stream + l);
    for (int i = 0; i < 4; i++) lanes->s[i][l] = lane.s[i];
  }
}

/* The plain path, one candidate after another: what every other kernel is measured against. */
void gg_collide_plain(gg_features f, gg_pairing *p, gg_rng *rng);

/* What the block kernels leave to it: blocks a and b are the same one, or one of them is not full. Every pair of grains
 * gets what it would from a draw of full blocks: lane l of a against lane l ^ order of b, each as one candidate whose
 * rate, integrated over directions, is bounded by pi `bound`. */
void gg_collide_odd_blocks(gg_features f, gg_pairing *p, uint32_t a, uint32_t b, unsigned order, gg_rng *rng);

#endif
