/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over collisions (stress, energy loss): a note of each block pair, and now and then the sums over a handful of
 * notes. Summed at once, seven sums would be loaded and stored with every block pair, in the midst of a kernel that has
 * its registers full. A handful later they stay in registers: a tenth of the cost. */
#ifndef GG_DSMC_COLLISION_SUMS_H
#define GG_DSMC_COLLISION_SUMS_H

#include "dsmc/kernel/lanes_collision.h"
#include "dsmc/kernel/pass.h"

enum { GG_DSMC_NOTES = 8 };

/* What the collisions of a block pair leave: J is 0 where nothing collides, and k finite. */
typedef struct gg_dsmc_note {
  gg_vd3 k, J;      /* for the stress, and kept nowhere else: the write-back takes them from here */
  gg_vd Jg, Jn, J2; /* for what of the loss does not follow from those */
} gg_dsmc_note;

typedef struct gg_dsmc_sums {
  unsigned n; /* block pairs noted */
  gg_dsmc_note note[GG_DSMC_NOTES][GG_PARTS];
  /* Lane by lane, double in either precision: stress as gg_collision_sums has it, and what the loss follows from
   * (gg_dsmc_all_terms). */
  double xx[GG_DSMC_LANES], yy[GG_DSMC_LANES], zz[GG_DSMC_LANES], xy[GG_DSMC_LANES], yx[GG_DSMC_LANES],
      Jg[GG_DSMC_LANES], Jn2[GG_DSMC_LANES], J2[GG_DSMC_LANES];
} gg_dsmc_sums;

/* Constant coefficients make terms of the loss follow from others (gg_dsmc_all_terms): of smooth grains all from one,
 * of rough ones the third. With a law of restitution all are summed. */
GG_INLINE bool gg_dsmc_sums_one(gg_dsmc_features features)
{
  return features.rule == GG_SMOOTH && !features.law;
}
GG_INLINE bool gg_dsmc_sums_all(gg_dsmc_features features)
{
  return features.rule == GG_FRICTIONAL || features.law;
}

/* The terms of the loss that k and J do not tell later. */
GG_INLINE void gg_dsmc_note_loss(gg_dsmc_features features, gg_dsmc_note *note, gg_vd3 g, gg_vd3 J, gg_vd Jn)
{
  if (features.sums == GG_DSMC_NO_SUMS) return;
  const bool stress = features.sums == GG_DSMC_STRESS, one = gg_dsmc_sums_one(features);
  if (!stress || !one) note->Jg = gg_vd3_dot(J, g);
  if (!stress && !one) note->Jn = Jn;
  if (!stress && gg_dsmc_sums_all(features)) note->J2 = gg_vd3_dot(J, J);
}

GG_INLINE void gg_dsmc_sums_add(double *sum, int part, gg_vd v)
{
  typedef double gg_doubles __attribute__((vector_size(8 * GG_WIDTH)));
  gg_doubles s;
  __builtin_memcpy(&s, sum + part * GG_WIDTH, sizeof s);
  s += __builtin_convertvector(v, gg_doubles);
  __builtin_memcpy(sum + part * GG_WIDTH, &s, sizeof s);
}

/* The loss alone. */
GG_INLINE void gg_dsmc_sums_collect_loss(gg_dsmc_features features, gg_dsmc_sums *sums, int part)
{
  gg_vd Jg = gg_all(0), Jn2 = Jg, J2 = Jg;
  for (unsigned i = 0; i < sums->n; i++) {
    const gg_dsmc_note *note = &sums->note[i][part];
    Jg += note->Jg;
    if (!gg_dsmc_sums_one(features)) Jn2 += note->Jn * note->Jn;
    if (gg_dsmc_sums_all(features)) J2 += note->J2;
  }
  gg_dsmc_sums_add(sums->Jg, part, Jg);
  if (!gg_dsmc_sums_one(features)) gg_dsmc_sums_add(sums->Jn2, part, Jn2);
  if (gg_dsmc_sums_all(features)) gg_dsmc_sums_add(sums->J2, part, J2);
}

/* Stress and loss; what is not kept need not be computed. */
GG_INLINE void gg_dsmc_sums_collect_stress(gg_dsmc_features features, gg_dsmc_sums *sums, int part)
{
  const bool one = gg_dsmc_sums_one(features);
  const gg_vd none = gg_all(0);
  gg_vd xx = none, yy = none, zz = none, xy = none, yx = none, Jg = none, Jn2 = none, J2 = none;
  for (unsigned i = 0; i < sums->n; i++) {
    const gg_dsmc_note *note = &sums->note[i][part];
    gg_vd3 k = note->k, J = note->J;
    gg_vd x = k.x * J.x, y = k.y * J.y, z = k.z * J.z, Jn = x + y + z;
    xx += x;
    yy += y;
    zz += z;
    xy += k.x * J.y;
    yx += k.y * J.x;
    Jn2 += Jn * Jn;
    J2 += gg_vd3_dot(J, J);
    if (!one) Jg += note->Jg;
  }
  gg_dsmc_sums_add(sums->xx, part, xx);
  gg_dsmc_sums_add(sums->yy, part, yy);
  gg_dsmc_sums_add(sums->zz, part, zz);
  gg_dsmc_sums_add(sums->xy, part, xy);
  gg_dsmc_sums_add(sums->Jn2, part, Jn2);
  if (one) return;
  gg_dsmc_sums_add(sums->yx, part, yx);
  gg_dsmc_sums_add(sums->Jg, part, Jg);
  if (gg_dsmc_sums_all(features)) gg_dsmc_sums_add(sums->J2, part, J2);
}

GG_INLINE void gg_dsmc_sums_collect(gg_dsmc_features features, gg_dsmc_sums *sums)
{
  for (int part = 0; part < GG_PARTS; part++)
    if (features.sums == GG_DSMC_STRESS)
      gg_dsmc_sums_collect_stress(features, sums, part);
    else
      gg_dsmc_sums_collect_loss(features, sums, part);
  sums->n = 0;
}

/* A block pair has its impulses; the note stays as it is until the next but one has its own. */
GG_INLINE void gg_dsmc_sums_next(gg_dsmc_features features, gg_dsmc_sums *sums)
{
  if (features.sums != GG_DSMC_NO_SUMS && ++sums->n == GG_DSMC_NOTES) gg_dsmc_sums_collect(features, sums);
}

GG_INLINE double gg_dsmc_sum_of_lanes(const double v[GG_DSMC_LANES])
{
  double sum = 0;
  for (int l = 0; l < GG_DSMC_LANES; l++) sum += v[l];
  return sum;
}

GG_INLINE void gg_dsmc_sums_finish(gg_dsmc_features features, gg_dsmc_sums *sums, gg_dsmc_pass *pass)
{
  if (features.sums == GG_DSMC_NO_SUMS) return;
  gg_dsmc_sums_collect(features, sums);
  /* The kernel's impulses are in units of a mass, and so are their sums. */
  const double mass = gg_dsmc_impulse_unit(features.same, &pass->contact), stress = pass->sigma * mass;
  gg_loss_terms terms = {.Jg = mass * gg_dsmc_sum_of_lanes(sums->Jg),
                         .Jn2 = mass * mass * gg_dsmc_sum_of_lanes(sums->Jn2),
                         .J2 = mass * mass * gg_dsmc_sum_of_lanes(sums->J2)};
  if (features.sums == GG_DSMC_STRESS && gg_dsmc_sums_one(features)) terms.Jg = terms.Jn2 / pass->contact.jn;
  if (!gg_dsmc_sums_all(features)) terms = gg_dsmc_all_terms(features.rule, &pass->contact, terms);
  pass->loss += gg_loss_of_terms(&pass->contact, terms);
  if (features.sums == GG_DSMC_LOSS) return;
  pass->stress[0][0] += stress * gg_dsmc_sum_of_lanes(sums->xx);
  pass->stress[1][1] += stress * gg_dsmc_sum_of_lanes(sums->yy);
  pass->stress[2][2] += stress * gg_dsmc_sum_of_lanes(sums->zz);
  pass->stress[0][1] += stress * gg_dsmc_sum_of_lanes(sums->xy);
  pass->stress[1][0] += stress * gg_dsmc_sum_of_lanes(gg_dsmc_sums_one(features) ? sums->xy : sums->yx);
}

#endif
