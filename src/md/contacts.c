/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/contacts.h"

#include <stdlib.h>

#include "base/memory.h"

/* Number of the GG_MD_DITHERS collisions that must round up so that the mean is `exact`; its two neighbours. */
static int upper_turns(long double exact, double *lower, double *upper)
{
  double nearest = (double)exact;
  *lower = nearest <= exact ? nearest : nextafter(nearest, -INFINITY);
  *upper = *lower < exact ? nextafter(*lower, INFINITY) : *lower;
  if (*upper == *lower) return 0;
  return (int)lrintl((exact - *lower) / ((long double)*upper - *lower) * GG_MD_DITHERS);
}

/* True if dither k rounds up, where `count` of all do, evenly distributed. */
static bool rounds_up(int k, int count)
{
  return (k + 1) * count / GG_MD_DITHERS > k * count / GG_MD_DITHERS;
}

/* Make the dithered contacts of a pair. `dithered`: the first one; the next ones are n_pairs further. */
static void make_dithered(gg_md_contacts *c, gg_contact *dithered, const gg_contact *rounded, double e, double beta)
{
  long double mr = (long double)rounded->im1 + rounded->im2;
  long double mt = mr + ((long double)rounded->ik1 + rounded->ik2);
  double lower[2], upper[2];
  int up[2] = {upper_turns((1 + (long double)e) / mr, &lower[0], &upper[0]),
               upper_turns((1 + (long double)beta) / mt, &lower[1], &upper[1])};
  for (int k = 0; k < GG_MD_DITHERS; k++, dithered += c->n_pairs) {
    *dithered = *rounded;
    dithered->jn = rounds_up(k, up[0]) ? upper[0] : lower[0];
    if (rounded->jt > 0) dithered->jt = rounds_up(k, up[1]) ? upper[1] : lower[1];
  }
  if (up[0] || (up[1] && rounded->jt > 0)) c->dither_mask = GG_MD_DITHERS - 1;
}

double gg_md_contact_normal_coefficient(const gg_contact *c, double e, uint64_t number)
{
  double lower, upper;
  int up = upper_turns((1 + (long double)e) / ((long double)c->im1 + c->im2), &lower, &upper);
  return rounds_up((int)(number % GG_MD_DITHERS), up) ? upper : lower;
}

static void make_pair(gg_md_contacts *c, const gg_model *m, int i, int j)
{
  const int o = gg_md_pair(c, i, j), q = gg_pair(i, j);
  c->sigma2[o] = m->sigma[q] * m->sigma[q];
  c->inverse[o] = 1 / sqrt(c->sigma2[o]);
  c->residue[o] = (double)((long double)c->sigma2[o] * c->inverse[o] * c->inverse[o] - 1);
  make_dithered(c, c->contact + o, &m->contact[i][j], m->e[q], m->beta[q]);
  make_dithered(c, c->treated + o, &m->treated[i][j], 1, gg_common_treated_beta(m, i, j));
}

gg_status gg_md_contacts_make(gg_md_contacts *c, const gg_model *m, gg_error *err)
{
  c->n_species = m->n_species;
  c->n_pairs = m->n_species * m->n_species;
  c->contact = gg_base_array_new((size_t)c->n_pairs * GG_MD_DITHERS, sizeof *c->contact, err);
  c->treated = gg_base_array_new((size_t)c->n_pairs * GG_MD_DITHERS, sizeof *c->treated, err);
  if (!c->contact || !c->treated) return GG_FAILED;
  for (int k = 0; k < GG_MD_DITHERS; k++)
    c->tilt[k] = (13 * k % GG_MD_DITHERS - 0.5 * (GG_MD_DITHERS - 1)) * (0x1p-53 / GG_MD_DITHERS);
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) make_pair(c, m, i, j);
  return GG_OK;
}

void gg_md_contacts_free(gg_md_contacts *c)
{
  free(c->contact);
  free(c->treated);
}
