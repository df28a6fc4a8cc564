/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One pass of acceptance-rejection over a pair of species (or over one) and an interval of time: what a kernel is given
 * and what it hands back.
 *
 * Bird's null-collision selection carried to the Enskog equation (Montanero & Santos, Phys. Rev. E 54 (1996) 438):
 * every pair of grains and direction k collides at rate (sigma^2 chi/V) dk max(0, g_n), g_n = k.C12 - sigma rate k_x
 * k_y (the second term is the shear between the centres: with k from 1 to 2, y_1 - y_2 = -sigma k_y). Candidates come
 * at the rate of a majorant of g_n and are accepted with probability g_n/majorant.
 *
 * Majorant overflow. A pass realises that part of the rate which lies between `floor` and `floor + majorant`. One pass
 * from 0 is all there is unless some candidate's g_n exceeded the majorant. Then a correction pass, over the layer
 * above it, makes up for what the first could not do. */
#ifndef GG_DSMC_PASS_H
#define GG_DSMC_PASS_H

#include "common/engine.h"
#include "common/laws/loss_table.h"
#include "common/rng.h"
#include "dsmc/block.h"

typedef enum gg_dsmc_shear {
  GG_DSMC_UNSHEARED,
  GG_DSMC_SHEARED_DILUTE, /* streaming alone */
  GG_DSMC_SHEARED_DENSE   /* and the difference of flow velocity between the centres */
} gg_dsmc_shear;

/* Which sums over collisions are kept. */
typedef enum gg_dsmc_sums_kept {
  GG_DSMC_NO_SUMS,
  GG_DSMC_LOSS,  /* Boltzmann: energy loss; there is no collisional stress */
  GG_DSMC_STRESS /* Enskog: and collisional stress */
} gg_dsmc_sums_kept;

/* What the collisions of a pair of species need: it selects a kernel. */
typedef struct gg_dsmc_features {
  gg_rule rule;
  gg_dsmc_shear shear;
  gg_dsmc_sums_kept sums;
  bool same; /* both grains of one species */
  bool law;  /* of restitution, built in */
} gg_dsmc_features;

/* With a law there are fewer instances: rough grains go with frictional ones, and the sums there can be are kept. */
GG_INLINE gg_dsmc_features gg_dsmc_features_by_law(gg_dsmc_features features, bool boltzmann)
{
  if (features.rule == GG_ROUGH) features.rule = GG_FRICTIONAL;
  features.sums = boltzmann ? GG_DSMC_LOSS : GG_DSMC_STRESS;
  features.law = true;
  return features;
}

/* The plain path reports each collision to it. */
typedef struct gg_dsmc_callback {
  gg_collision_callback *call;
  void *context;
  double *last[GG_MAX_SPECIES];  /* when each grain last collided; -INFINITY: not yet */
  int64_t first[GG_MAX_SPECIES]; /* number of a species' first grain */
} gg_dsmc_callback;

/* Blocks of a population. */
typedef struct gg_dsmc_range {
  uint32_t first, n;
} gg_dsmc_range;

typedef struct gg_dsmc_pass {
  /* given */
  gg_dsmc_callback *callback; /* NULL: none */
  int species[2];             /* for the callback and the law */
  double time, time_step;     /* the same: of the first candidate, and from one to the next */
  gg_dsmc_population *one, *two;
  gg_dsmc_range blocks[2]; /* of `one` and `two` that take part; the plain path takes all grains */
  gg_contact contact;
  const gg_restitution_law *law; /* which the plain path alone asks; NULL: `contact` as it is */
  double law_unit;               /* speed in units of the start over the present one */
  const gg_loss_table *losses;   /* of a built-in law; NULL: `contact` as it is */
  double loss_scale;             /* speed in units of the table over the present one */
  double shift;                  /* sigma x rate */
  double sigma;                  /* for the stress */
  double floor, majorant;        /* the layer of g_n */
  double strain, strain_step;    /* of the first candidate, and from one to the next: rate x time */
  uint64_t candidates;
  /* Of both species' speed bounds: at the strain where the interval begins, then where it ends. With a margin above 1
   * it holds at all strains of the interval and beyond, and stays; new bounds are larger by the margin, to hold there.
   */
  double bound_scale, bound_margin;
  /* handed back */
  uint64_t tried; /* candidate pairs of grains */
  uint64_t collisions, overflows, clamped;
  double largest;            /* largest g_n of a candidate */
  double stress[3][3], loss; /* if kept */
} gg_dsmc_pass;

/* Eight streams side by side, for kernels that work on eight lanes. */
typedef struct gg_dsmc_rng_lanes {
  uint64_t s[4][GG_DSMC_LANES];
} gg_dsmc_rng_lanes;

/* Streams `stream` to `stream` + 7 of this seed. */
GG_INLINE void gg_dsmc_rng_lanes_seed(gg_dsmc_rng_lanes *lanes, uint64_t seed, uint64_t stream)
{
  for (unsigned l = 0; l < GG_DSMC_LANES; l++) {
    gg_rng lane = gg_common_rng_seed(seed, stream + l);
    for (int i = 0; i < 4; i++) lanes->s[i][l] = lane.s[i];
  }
}

/* The plain path, one candidate after another: what every other kernel is measured against. */
void gg_dsmc_collide_plain(gg_dsmc_features features, gg_dsmc_pass *pass, gg_rng *rng);

/* What the block kernels leave to it: blocks a and b are the same one, or one of them is not full. Every pair of grains
 * has the rate that it would have in a pair of full blocks: lane l of a against lane l ^ order of b, each as one
 * candidate whose rate, integrated over directions, is bounded by pi `majorant`. */
void gg_dsmc_collide_odd_blocks(gg_dsmc_features features, gg_dsmc_pass *pass, uint32_t a, uint32_t b, unsigned order,
                                gg_rng *rng);

#endif
