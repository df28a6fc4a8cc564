/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/collision.h"

gg_contact gg_common_contact_make(gg_partner one, gg_partner two, double e, double beta, double mu)
{
  gg_contact c = {.mu = mu, .im1 = 1 / one.mass, .im2 = 1 / two.mass};
  c.ik1 = isinf(one.mass) ? 0 : 1 / (one.inertia * one.mass);
  c.ik2 = isinf(two.mass) ? 0 : 1 / (two.inertia * two.mass);
  c.jn = (1 + e) / gg_inverse_mr(&c);
  c.jt = gg_common_rule_select(beta, mu) == GG_SMOOTH ? 0 : (1 + beta) / gg_inverse_mt(&c);
  return c;
}

void gg_common_contact_set_kicks(gg_contact *c, bool spins, double normal, double tangential)
{
  if (!spins) c->ik1 = c->ik2 = 0;
  c->kn = 2 * normal / gg_inverse_mr(c);
  c->kt = 2 * tangential / gg_inverse_mt(c);
}

gg_rule gg_common_rule_select(double beta, double mu)
{
  if (beta <= -1 || mu <= 0) return GG_SMOOTH;
  return isinf(mu) ? GG_ROUGH : GG_FRICTIONAL;
}
