/* Sums over collisions (stress, energy loss): a note of each block pair, and now and then the sums over a handful of
 * notes. Summed at once, seven sums would be loaded and stored with every block pair, in the midst of a kernel that has
 * its registers full. A handful later they stay in registers: a tenth of the cost. */
#ifndef GG_DSMC_COLLISION_SUMS_H
#define GG_DSMC_COLLISION_SUMS_H

#include "dsmc/kernel/lanes_collision.h"
#include "dsmc/kernel/pass.h"

enum { GG_DSMC_NOTES = 8 };

/* k, impulse and J.g of one block pair: J is 0 where nothing collides, and k finite. Of smooth grains k and J_n are
 * enough (J = J_n k, J.g = J_n^2/jn), and J.x stands for the latter. */
typedef struct gg_dsmc_note {
  gg_vd3 k, J;
  gg_vd Jg;
} gg_dsmc_note;

typedef struct gg_dsmc_sums {
  unsigned n; /* block pairs noted */
  gg_dsmc_note note[GG_DSMC_NOTES][GG_PARTS];
  /* Lane by lane, double in either precision: stress as gg_collision_sums has it, and what the loss follows from
   * (gg_dsmc_loss_of). */
  double xx[GG_DSMC_LANES], yy[GG_DSMC_LANES], zz[GG_DSMC_LANES], xy[GG_DSMC_LANES], yx[GG_DSMC_LANES],
      Jg[GG_DSMC_LANES], Jn2[GG_DSMC_LANES], J2[GG_DSMC_LANES];
} gg_dsmc_sums;

/* Smooth grains lose a share of J.g: for that alone k need not be known. */
GG_INLINE bool gg_dsmc_sums_need_k(gg_dsmc_features f)
{
  return f.sums == GG_DSMC_STRESS || (f.sums == GG_DSMC_LOSS && f.rule != GG_SMOOTH);
}

GG_INLINE bool gg_dsmc_sums_smooth(gg_dsmc_features f)
{
  return f.sums == GG_DSMC_STRESS && f.rule == GG_SMOOTH;
}

GG_INLINE void gg_dsmc_sums_note(gg_dsmc_features f, gg_dsmc_sums *t, int part, gg_vd3 k, gg_vd3 g, gg_vd3 J, gg_vd Jn)
{
  if (f.sums == GG_DSMC_NO_SUMS) return;
  gg_dsmc_note *note = &t->note[t->n][part];
  if (!gg_dsmc_sums_smooth(f)) note->Jg = gg_vd3_dot(J, g);
  if (!gg_dsmc_sums_need_k(f)) return;
  note->k = k;
  if (gg_dsmc_sums_smooth(f))
    note->J.x = Jn;
  else
    note->J = J;
}

GG_INLINE void gg_dsmc_sums_add(double *sum, int part, gg_vd v)
{
  typedef double gg_doubles __attribute__((vector_size(8 * GG_WIDTH)));
  gg_doubles s;
  __builtin_memcpy(&s, sum + part * GG_WIDTH, sizeof s);
  s += __builtin_convertvector(v, gg_doubles);
  __builtin_memcpy(sum + part * GG_WIDTH, &s, sizeof s);
}

GG_INLINE void gg_dsmc_sums_collect_part(gg_dsmc_features f, gg_dsmc_sums *t, int p)
{
  const gg_vd none = gg_all(0);
  gg_vd xx = none, yy = none, zz = none, xy = none, yx = none, Jg = none, Jn2 = none, J2 = none;
  for (unsigned i = 0; i < t->n; i++) {
    const gg_dsmc_note *note = &t->note[i][p];
    if (!gg_dsmc_sums_smooth(f)) Jg += note->Jg;
    if (!gg_dsmc_sums_need_k(f)) continue;
    gg_vd3 k = note->k, J = gg_dsmc_sums_smooth(f) ? gg_vd3_scale(note->J.x, k) : note->J;
    gg_vd x = k.x * J.x, y = k.y * J.y, z = k.z * J.z, Jn = gg_dsmc_sums_smooth(f) ? note->J.x : x + y + z;
    xx += x;
    yy += y;
    zz += z;
    xy += k.x * J.y;
    yx += k.y * J.x;
    Jn2 += Jn * Jn;
    J2 += gg_vd3_dot(J, J);
  }
  if (!gg_dsmc_sums_smooth(f)) gg_dsmc_sums_add(t->Jg, p, Jg);
  if (gg_dsmc_sums_need_k(f)) gg_dsmc_sums_add(t->Jn2, p, Jn2);
  if (f.rule == GG_FRICTIONAL) gg_dsmc_sums_add(t->J2, p, J2);
  if (f.sums != GG_DSMC_STRESS) return; /* what is not kept need not be computed */
  gg_dsmc_sums_add(t->xx, p, xx);
  gg_dsmc_sums_add(t->yy, p, yy);
  gg_dsmc_sums_add(t->zz, p, zz);
  gg_dsmc_sums_add(t->xy, p, xy);
  if (f.rule != GG_SMOOTH) gg_dsmc_sums_add(t->yx, p, yx);
}

GG_INLINE void gg_dsmc_sums_collect(gg_dsmc_features f, gg_dsmc_sums *t)
{
  for (int p = 0; p < GG_PARTS; p++) gg_dsmc_sums_collect_part(f, t, p);
  t->n = 0;
}

/* A block pair is done. */
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
  gg_dsmc_loss_terms terms = {.Jg = gg_dsmc_sum_of_lanes(t->Jg)};
  if (gg_dsmc_sums_smooth(f)) terms.Jg = gg_dsmc_sum_of_lanes(t->Jn2) / p->contact.jn;
  if (f.rule != GG_SMOOTH) terms.Jn2 = gg_dsmc_sum_of_lanes(t->Jn2);
  if (f.rule == GG_FRICTIONAL) terms.J2 = gg_dsmc_sum_of_lanes(t->J2);
  p->loss += gg_dsmc_loss_of(f.rule, &p->contact, terms);
  if (f.sums == GG_DSMC_LOSS) return;
  p->stress[0][0] += p->sigma * gg_dsmc_sum_of_lanes(t->xx);
  p->stress[1][1] += p->sigma * gg_dsmc_sum_of_lanes(t->yy);
  p->stress[2][2] += p->sigma * gg_dsmc_sum_of_lanes(t->zz);
  p->stress[0][1] += p->sigma * gg_dsmc_sum_of_lanes(t->xy);
  p->stress[1][0] += p->sigma * gg_dsmc_sum_of_lanes(f.rule == GG_SMOOTH ? t->xy : t->yx);
}

#endif
