/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of restitution that are built in: how e falls with the normal speed g at contact. Each is a function of the
 * speed in units of its own, and of nothing else: what a material is like is its unit of speed, which follows from
 * `collision.e`, the restitution at the speed `collision.speed`. A law that a program sets (gg_scene_set_restitution)
 * takes the place of these. */
#ifndef GG_LAWS_H
#define GG_LAWS_H

/* X(NAME, name, description): `name` is the word in scenes, gg_loss_<name> the function, in a file of its own. */
#define GG_LAWS(X)                                                                                                     \
  X(VISCOELASTIC, viscoelastic, "viscoelastic spheres: 1 - e grows as g^(1/5); collision.e is e at collision.speed")

#define GG_LAW_VALUE(NAME, name, description) GG_LAW_##NAME,
typedef enum gg_law_kind { GG_LAW_CONSTANT, GG_LAWS(GG_LAW_VALUE) GG_N_LAWS } gg_law_kind;
#undef GG_LAW_VALUE

/* 1 - e at the speed u > 0: it rises with u, from 0 at 0 towards 1. */
typedef double gg_loss(double u);
#define GG_LAW_FUNCTION(NAME, name, description) gg_loss gg_common_loss_##name;
GG_LAWS(GG_LAW_FUNCTION)
#undef GG_LAW_FUNCTION

#endif
