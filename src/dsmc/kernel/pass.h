/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pass of acceptance-rejection over a pair of species (or one species) and an interval of time: input and output of a
 * kernel.
 *
 * Bird's null-collision selection carried to the Enskog equation (Montanero & Santos, Phys. Rev. E 54 (1996) 438):
 * every pair of grains and direction k collides at rate (sigma^2 chi/V) dk max(0, g_n), g_n = k.C12 - sigma rate k_x
 * k_y (the second term is the shear between the centres: with k from 1 to 2, y_1 - y_2 = -sigma k_y). Candidates are
 * drawn at the rate of a majorant of g_n and accepted with probability g_n/majorant.
 *
 * Majorant overflow. A pass realises the part of the rate between `floor` and `floor + majorant`. Usually one pass from
 * 0 is enough. If g_n of a candidate exceeds the majorant, a correction pass over the layer above realises the missing
 * part. */
#ifndef GG_DSMC_PASS_H
#define GG_DSMC_PASS_H

#include "common/engine.h"
#include "common/laws/coefficient_tables.h"
#include "common/rng.h"
#include "dsmc/block.h"

typedef enum gg_dsmc_shear {
  GG_DSMC_UNSHEARED,
  GG_DSMC_SHEARED_DILUTE, /* streaming only */
  GG_DSMC_SHEARED_DENSE   /* streaming, and the difference of flow velocity between the centres */
} gg_dsmc_shear;

/* Sums over collisions. */
typedef enum gg_dsmc_sums_kept {
  GG_DSMC_LOSS,  /* Boltzmann: energy loss; the collisional stress is 0 */
  GG_DSMC_STRESS /* Enskog: energy loss and collisional stress */
} gg_dsmc_sums_kept;

/* Features of the collisions of a pair of species, which select a kernel. */
typedef struct gg_dsmc_features {
  gg_rule rule;
  gg_dsmc_shear shear;
  gg_dsmc_sums_kept sums;
  bool same; /* both grains of one species */
  bool own;  /* the contact is made at the collision: coefficients by the speed, but for a callback; or kicks */
} gg_dsmc_features;

/* Features with a law of restitution or kicks, which have fewer instances: rough grains use the frictional rule. */
GG_INLINE gg_dsmc_features gg_dsmc_features_of_own(gg_dsmc_features features)
{
  if (features.rule == GG_ROUGH) features.rule = GG_FRICTIONAL;
  features.own = true;
  return features;
}

/* Collision callback; the plain path calls it. */
typedef struct gg_dsmc_callback {
  gg_collision_callback *call;
  void *context;
  double *last[GG_MAX_SPECIES];  /* time of the last collision of each grain; -INFINITY: none */
  int64_t first[GG_MAX_SPECIES]; /* number of the first grain of a species */
} gg_dsmc_callback;

/* A range of blocks of a population. */
typedef struct gg_dsmc_range {
  uint32_t first, n;
} gg_dsmc_range;

typedef struct gg_dsmc_pass {
  /* input */
  gg_dsmc_callback *callback; /* NULL: none */
  int species[2];             /* for the callback and the law */
  double time, time_step;     /* for the callback: of the first candidate, and between two candidates */
  gg_dsmc_population *one, *two;
  gg_dsmc_range blocks[2]; /* of `one` and `two`; the plain path uses all grains */
  gg_contact contact;
  const gg_restitution_law *law;       /* for the plain path; NULL: constant `contact` */
  double law_unit;                     /* speed in units of the start over the present one */
  const gg_coefficient_tables *tables; /* NULL: constant `contact` */
  double loss_scale;                   /* speed in units of the tables over the present one */
  double shift;                        /* sigma x rate */
  double sigma;                        /* for the stress */
  double floor, majorant;              /* layer of g_n */
  double strain, strain_step;          /* rate x time of the first candidate, and between two candidates */
  uint64_t candidates;
  /* Scale of the speed bounds of both species: at the strain where the interval begins; on return where it ends. With a
   * margin above 1 the scale is valid at all strains of the interval and constant; new bounds are larger by the margin.
   */
  double bound_scale, bound_margin;
  /* output */
  uint64_t tried; /* candidate pairs of grains */
  uint64_t collisions, overflows, clamped;
  double largest;            /* largest g_n of a candidate */
  double stress[3][3], loss; /* stress: of Enskog's equation; loss: of all energy, kicks included */
  double given;              /* by kicks */
} gg_dsmc_pass;

/* Eight random streams, one a lane. */
typedef struct gg_dsmc_rng_lanes {
  uint64_t s[4][GG_DSMC_LANES];
} gg_dsmc_rng_lanes;

/* Seed the lanes by streams `stream` to `stream` + 7 of this seed. */
GG_INLINE void gg_dsmc_rng_lanes_seed(gg_dsmc_rng_lanes *lanes, uint64_t seed, uint64_t stream)
{
  for (unsigned l = 0; l < GG_DSMC_LANES; l++) {
    gg_rng lane = gg_common_rng_seed(seed, stream + l);
    for (int i = 0; i < 4; i++) lanes->s[i][l] = lane.s[i];
  }
}

/* The plain path, one candidate after another: the reference for all other kernels. */
void gg_dsmc_collide_plain(gg_dsmc_features features, gg_dsmc_pass *pass, gg_rng *rng);

/* Collide a block pair that the block kernels leave to the plain path: a and b are the same block, or one of them is
 * not full. Every pair of grains has the same rate as in a pair of full blocks: lane l of a and lane l ^ order of b are
 * one candidate, whose rate, integrated over directions, is bounded by pi `majorant`. */
void gg_dsmc_collide_odd_blocks(gg_dsmc_features features, gg_dsmc_pass *pass, uint32_t a, uint32_t b, unsigned order,
                                gg_rng *rng);

#endif
