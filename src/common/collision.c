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

static const struct {
  bool along_surfaces; /* it acts on the surfaces, whose mass is m_t, not on the centres alone */
  bool turns;
} kicks[GG_N_KICKS] = {[GG_NORMAL_KICK] = {false, false}, [GG_TANGENTIAL_KICK] = {true, true}};

void gg_common_contact_set_kicks(gg_contact *c, bool spins, const double D[GG_N_KICKS])
{
  if (!spins) c->ik1 = c->ik2 = 0;
  for (int k = 0; k < GG_N_KICKS; k++)
    c->kick[k] = 2 * D[k] / (kicks[k].along_surfaces ? gg_inverse_mt(c) : gg_inverse_mr(c));
}

bool gg_common_kick_turns(gg_kick_kind kind)
{
  return kicks[kind].turns;
}

gg_rule gg_common_rule_select(double beta, double mu)
{
  if (beta <= -1 || mu <= 0) return GG_SMOOTH;
  return isinf(mu) ? GG_ROUGH : GG_FRICTIONAL;
}
