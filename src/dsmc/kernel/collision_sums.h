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
GG_INLINE bool gg_dsmc_sums_one(gg_dsmc_features f)
{
  return f.rule == GG_SMOOTH && !f.law;
}
GG_INLINE bool gg_dsmc_sums_all(gg_dsmc_features f)
{
  return f.rule == GG_FRICTIONAL || f.law;
}

/* The terms of the loss that k and J do not tell later. */
GG_INLINE void gg_dsmc_note_loss(gg_dsmc_features f, gg_dsmc_note *note, gg_vd3 g, gg_vd3 J, gg_vd Jn)
{
  if (f.sums == GG_DSMC_NO_SUMS) return;
  const bool stress = f.sums == GG_DSMC_STRESS, one = gg_dsmc_sums_one(f);
  if (!stress || !one) note->Jg = gg_vd3_dot(J, g);
  if (!stress && !one) note->Jn = Jn;
  if (!stress && gg_dsmc_sums_all(f)) note->J2 = gg_vd3_dot(J, J);
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
GG_INLINE void gg_dsmc_sums_collect_loss(gg_dsmc_features f, gg_dsmc_sums *t, int p)
{
  gg_vd Jg = gg_all(0), Jn2 = Jg, J2 = Jg;
  for (unsigned i = 0; i < t->n; i++) {
    const gg_dsmc_note *note = &t->note[i][p];
    Jg += note->Jg;
    if (!gg_dsmc_sums_one(f)) Jn2 += note->Jn * note->Jn;
    if (gg_dsmc_sums_all(f)) J2 += note->J2;
  }
  gg_dsmc_sums_add(t->Jg, p, Jg);
  if (!gg_dsmc_sums_one(f)) gg_dsmc_sums_add(t->Jn2, p, Jn2);
  if (gg_dsmc_sums_all(f)) gg_dsmc_sums_add(t->J2, p, J2);
}

/* Stress and loss; what is not kept need not be computed. */
GG_INLINE void gg_dsmc_sums_collect_stress(gg_dsmc_features f, gg_dsmc_sums *t, int p)
{
  const bool one = gg_dsmc_sums_one(f);
  const gg_vd none = gg_all(0);
  gg_vd xx = none, yy = none, zz = none, xy = none, yx = none, Jg = none, Jn2 = none, J2 = none;
  for (unsigned i = 0; i < t->n; i++) {
    const gg_dsmc_note *note = &t->note[i][p];
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
  gg_dsmc_sums_add(t->xx, p, xx);
  gg_dsmc_sums_add(t->yy, p, yy);
  gg_dsmc_sums_add(t->zz, p, zz);
  gg_dsmc_sums_add(t->xy, p, xy);
  gg_dsmc_sums_add(t->Jn2, p, Jn2);
  if (one) return;
  gg_dsmc_sums_add(t->yx, p, yx);
  gg_dsmc_sums_add(t->Jg, p, Jg);
  if (gg_dsmc_sums_all(f)) gg_dsmc_sums_add(t->J2, p, J2);
}

GG_INLINE void gg_dsmc_sums_collect(gg_dsmc_features f, gg_dsmc_sums *t)
{
  for (int p = 0; p < GG_PARTS; p++)
    if (f.sums == GG_DSMC_STRESS)
      gg_dsmc_sums_collect_stress(f, t, p);
    else
      gg_dsmc_sums_collect_loss(f, t, p);
  t->n = 0;
}

/* A block pair has its impulses; the note stays as it is until the next but one has its own. */
GG_INLINE void gg_dsmc_sums_next(gg_dsmc_features f, gg_dsmc_sums *t)
{
  if (f.sums != GG_DSMC_NO_SUMS && ++t->n == GG_DSMC_NOTES) gg_dsmc_sums_collect(f, t);
}

GG_INLINE double gg_dsmc_sum_of_lanes(const double v[GG_DSMC_LANES])
{
  double sum = 0;
  for (int l = 0; l < GG_DSMC_LANES; l++) sum += v[l];
  return sum;
}

GG_INLINE void gg_dsmc_sums_finish(gg_dsmc_features f, gg_dsmc_sums *t, gg_dsmc_pass *p)
{
  if (f.sums == GG_DSMC_NO_SUMS) return;
  gg_dsmc_sums_collect(f, t);
  /* The kernel's impulses are in units of a mass, and so are their sums. */
  const double mass = gg_dsmc_impulse_unit(f.same, &p->contact), stress = p->sigma * mass;
  gg_loss_terms terms = {.Jg = mass * gg_dsmc_sum_of_lanes(t->Jg),
                         .Jn2 = mass * mass * gg_dsmc_sum_of_lanes(t->Jn2),
                         .J2 = mass * mass * gg_dsmc_sum_of_lanes(t->J2)};
  if (f.sums == GG_DSMC_STRESS && gg_dsmc_sums_one(f)) terms.Jg = terms.Jn2 / p->contact.jn;
  if (!gg_dsmc_sums_all(f)) terms = gg_dsmc_all_terms(f.rule, &p->contact, terms);
  p->loss += gg_loss_of_terms(&p->contact, terms);
  if (f.sums == GG_DSMC_LOSS) return;
  p->stress[0][0] += stress * gg_dsmc_sum_of_lanes(t->xx);
  p->stress[1][1] += stress * gg_dsmc_sum_of_lanes(t->yy);
  p->stress[2][2] += stress * gg_dsmc_sum_of_lanes(t->zz);
  p->stress[0][1] += stress * gg_dsmc_sum_of_lanes(t->xy);
  p->stress[1][0] += stress * gg_dsmc_sum_of_lanes(gg_dsmc_sums_one(f) ? t->xy : t->yx);
}

#endif
