#include "md/contacts.h"

/* `exact` lies between two neighbours; how many turns of all must take the upper one? */
static int upper_turns(long double exact, double *lower, double *upper)
{
  double nearest = (double)exact;
  *lower = nearest <= exact ? nearest : nextafter(nearest, -INFINITY);
  *upper = *lower < exact ? nextafter(*lower, INFINITY) : *lower;
  if (*upper == *lower) return 0;
  return (int)lrintl((exact - *lower) / ((long double)*upper - *lower) * GG_MD_DITHERS);
}

/* Spread evenly: does turn k go up, if `count` turns do? */
static bool goes_up(int k, int count)
{
  return (k + 1) * count / GG_MD_DITHERS > k * count / GG_MD_DITHERS;
}

static void make_turns(gg_md_contacts *c, gg_contact (*turn)[4], int pair, const gg_contact *rounded, double e,
                       double beta)
{
  long double mr = (long double)rounded->im1 + rounded->im2;
  long double mt = mr + ((long double)rounded->ik1 + rounded->ik2);
  double lower[2], upper[2];
  int up[2] = {upper_turns((1 + (long double)e) / mr, &lower[0], &upper[0]),
               upper_turns((1 + (long double)beta) / mt, &lower[1], &upper[1])};
  for (int k = 0; k < GG_MD_DITHERS; k++) {
    turn[k][pair] = *rounded;
    turn[k][pair].jn = goes_up(k, up[0]) ? upper[0] : lower[0];
    if (rounded->jt > 0) turn[k][pair].jt = goes_up(k, up[1]) ? upper[1] : lower[1];
  }
  if (up[0] || (up[1] && rounded->jt > 0)) c->turns = GG_MD_DITHERS - 1;
}

double gg_md_contact_normal_coefficient(const gg_contact *c, double e, uint64_t number)
{
  double lower, upper;
  int up = upper_turns((1 + (long double)e) / ((long double)c->im1 + c->im2), &lower, &upper);
  return goes_up((int)(number % GG_MD_DITHERS), up) ? upper : lower;
}

void gg_md_contacts_make(gg_md_contacts *c, const gg_model *m)
{
  c->turns = 0;
  for (int k = 0; k < GG_MD_DITHERS; k++)
    c->tilt[k] = (13 * k % GG_MD_DITHERS - 0.5 * (GG_MD_DITHERS - 1)) * (0x1p-53 / GG_MD_DITHERS);
  for (int o = 0; o < 4; o++) {
    if (m->sigma[o] <= 0) continue; /* one species: no such pair */
    c->sigma2[o] = m->sigma[o] * m->sigma[o];
    c->inverse[o] = 1 / sqrt(c->sigma2[o]);
    c->residue[o] = (double)((long double)c->sigma2[o] * c->inverse[o] * c->inverse[o] - 1);
    make_turns(c, c->contact, o, &m->contact[o], m->e[o], m->beta[o]);
    make_turns(c, c->treated, o, &m->treated[o], 1, gg_treated_beta(m, o / 2, o % 2));
  }
}
