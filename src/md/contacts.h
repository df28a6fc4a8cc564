/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with dithered rounding, whose errors do not add up. A rounding to the same side at every collision would
 * change the energy of elastic grains by some 10^-16 T a collision: 3 x 10^-10 of it in 10^9 collisions of 1000 grains.
 *
 * The normal: near sigma = 1 the square root of |dr|^2 falls between two numbers and is mostly rounded down. So k is
 * computed from the difference |dr|^2 - sigma^2, which is exact. The rest to be rounded is a few quanta of the last
 * digit, and a quarter of a quantum would always be lost. A shift by less than a quantum, different in each of
 * GG_MD_DITHERS collisions, makes it count in a quarter of them (dither).
 *
 * The coefficients jn = m_r (1+e) and jt = m_t (1+beta) are seldom exact: in the same way they are rounded up in some
 * of these collisions and down in the others, so that their mean is right. */
#ifndef GG_MD_CONTACTS_H
#define GG_MD_CONTACTS_H

#include <stdint.h>

#include "common/model.h"

enum { GG_MD_DITHERS = 32 };

/* Contacts by ordered pair of species (gg_md_pair). */
typedef struct gg_md_contacts {
  int n_species, n_pairs;
  uint64_t dither_mask;                                /* GG_MD_DITHERS - 1, or 0 where every coefficient is exact */
  gg_contact *contact, *treated;                       /* GG_MD_DITHERS rows of n_pairs */
  double tilt[GG_MD_DITHERS];                          /* shift of the last digit of k, by dither */
  double inverse[GG_MAX_SPECIES * GG_MAX_SPECIES];     /* 1/sigma */
  double residue[GG_MAX_SPECIES * GG_MAX_SPECIES];     /* sigma^2 x inverse^2 - 1: the rounding of the two */
  double sigma2[GG_MAX_SPECIES * GG_MAX_SPECIES + 16]; /* sigma^2; sixteen numbers can be read from any pair on */
} gg_md_contacts;

gg_status gg_md_contacts_make(gg_md_contacts *contacts, const gg_model *model, gg_error *err);
void gg_md_contacts_free(gg_md_contacts *contacts);

/* Ordered pair: grain 1 of species a, grain 2 of species b. */
GG_INLINE int gg_md_pair(const gg_md_contacts *c, int a, int b)
{
  return a * c->n_species + b;
}

/* jn = m_r (1+e), dithered, for the e of one collision. `number`: of the collision. */
double gg_md_contact_normal_coefficient(const gg_contact *contact, double e, uint64_t number);

/* Unit vector along dr; |dr| is sigma but for rounding, r2 = |dr|^2. `number`: of the collision. */
GG_INLINE gg_vec gg_md_contact_normal(const gg_md_contacts *c, int pair, gg_vec dr, double r2, uint64_t number)
{
  double y = (r2 - c->sigma2[pair]) * (c->inverse[pair] * c->inverse[pair]) + c->residue[pair];
  if (__builtin_expect(!(fabs(y) < 1e-6), 0)) return gg_scale(1 / sqrt(r2), dr); /* a start with overlaps */
  gg_vec k = gg_scale(c->inverse[pair], dr);
  return gg_axpy(y * (0.375 * y - 0.5) + c->tilt[number % GG_MD_DITHERS], k, k); /* (1 + y)^(-1/2) */
}

#endif
