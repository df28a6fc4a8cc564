/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over collisions (stress, energy loss). Each block pair leaves a note, and eight notes are summed at once.
 * Otherwise seven sums would be loaded and stored with every block pair, in a kernel that uses all registers. Over
 * several notes the sums stay in registers, at a tenth of the cost. */
#ifndef GG_DSMC_COLLISION_SUMS_H
#define GG_DSMC_COLLISION_SUMS_H

#include "dsmc/kernel/lanes_collision.h"
#include "dsmc/kernel/pass.h"

enum { GG_DSMC_NOTES = 8 };

/* Note of the collisions of a block pair. In lanes without a collision J is 0 and k is finite. */
typedef struct gg_dsmc_note {
  gg_vd3 k, J;      /* for the stress; the write-back reads them from here */
  gg_vd Jg, Jn, J2; /* terms of the loss that do not follow from k and J */
  gg_vd given;      /* by kicks */
} gg_dsmc_note;

typedef struct gg_dsmc_sums {
  unsigned n; /* notes */
  bool kicks; /* notes have what kicks give */
  gg_dsmc_note note[GG_DSMC_NOTES][GG_PARTS];
  /* Sums by lane, in double for both precisions: stress as in gg_collision_sums, and terms of the loss
   * (gg_dsmc_all_terms). */
  double xx[GG_DSMC_LANES], yy[GG_DSMC_LANES], zz[GG_DSMC_LANES], xy[GG_DSMC_LANES], yx[GG_DSMC_LANES],
      Jg[GG_DSMC_LANES], Jn2[GG_DSMC_LANES], J2[GG_DSMC_LANES], given[GG_DSMC_LANES];
} gg_dsmc_sums;

/* True if one term of the loss is enough. With constant coefficients terms follow from each other (gg_dsmc_all_terms):
 * for smooth grains all from one, for rough grains the third. With a law of restitution or kicks all terms are
 * summed. */
GG_INLINE bool gg_dsmc_sums_one(gg_dsmc_features features)
{
  return features.rule == GG_SMOOTH && !features.own;
}
GG_INLINE bool gg_dsmc_sums_all(gg_dsmc_features features)
{
  return features.rule == GG_FRICTIONAL || features.own;
}

/* Note the terms of the loss that do not follow from k and J. */
GG_INLINE void gg_dsmc_note_loss(gg_dsmc_features features, gg_dsmc_note *note, gg_vd3 g, gg_vd3 J, gg_vd Jn)
{
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

/* Sum the energy that kicks gave. */
GG_INLINE void gg_dsmc_sums_collect_given(gg_dsmc_features features, gg_dsmc_sums *sums, int part)
{
  gg_vd given = gg_all(0);
  if (!features.own || !sums->kicks) return;
  for (unsigned i = 0; i < sums->n; i++) given += sums->note[i][part].given;
  gg_dsmc_sums_add(sums->given, part, given);
}

/* Sum the notes of the loss alone. */
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

/* Sum the notes of stress and loss. */
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
  for (int part = 0; part < GG_PARTS; part++) {
    if (features.sums == GG_DSMC_STRESS)
      gg_dsmc_sums_collect_stress(features, sums, part);
    else
      gg_dsmc_sums_collect_loss(features, sums, part);
    gg_dsmc_sums_collect_given(features, sums, part);
  }
  sums->n = 0;
}

/* Finish the note of a block pair. It stays unchanged until the next but one is written. */
GG_INLINE void gg_dsmc_sums_next(gg_dsmc_features features, gg_dsmc_sums *sums)
{
  if (++sums->n == GG_DSMC_NOTES) gg_dsmc_sums_collect(features, sums);
}

GG_INLINE double gg_dsmc_sum_of_lanes(const double v[GG_DSMC_LANES])
{
  double sum = 0;
  for (int l = 0; l < GG_DSMC_LANES; l++) sum += v[l];
  return sum;
}

GG_INLINE void gg_dsmc_sums_finish(gg_dsmc_features features, gg_dsmc_sums *sums, gg_dsmc_pass *pass)
{
  gg_dsmc_sums_collect(features, sums);
  /* Impulses of the kernel, and so their sums, are in units of a mass. */
  const double mass = gg_dsmc_impulse_unit(features.same, &pass->contact), stress = pass->sigma * mass;
  gg_loss_terms terms = {.Jg = mass * gg_dsmc_sum_of_lanes(sums->Jg),
                         .Jn2 = mass * mass * gg_dsmc_sum_of_lanes(sums->Jn2),
                         .J2 = mass * mass * gg_dsmc_sum_of_lanes(sums->J2)};
  if (features.sums == GG_DSMC_STRESS && gg_dsmc_sums_one(features)) terms.Jg = terms.Jn2 / pass->contact.jn;
  if (!gg_dsmc_sums_all(features)) terms = gg_dsmc_all_terms(features.rule, &pass->contact, terms);
  pass->loss += gg_loss_of_terms(&pass->contact, terms);
  if (features.own) pass->given += mass * gg_dsmc_sum_of_lanes(sums->given);
  if (features.sums == GG_DSMC_LOSS) return;
  pass->stress[0][0] += stress * gg_dsmc_sum_of_lanes(sums->xx);
  pass->stress[1][1] += stress * gg_dsmc_sum_of_lanes(sums->yy);
  pass->stress[2][2] += stress * gg_dsmc_sum_of_lanes(sums->zz);
  pass->stress[0][1] += stress * gg_dsmc_sum_of_lanes(sums->xy);
  pass->stress[1][0] += stress * gg_dsmc_sum_of_lanes(gg_dsmc_sums_one(features) ? sums->xy : sums->yx);
}

#endif
