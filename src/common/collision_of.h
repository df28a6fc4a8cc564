/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision rule of common/collision.h, written once for every kind of number: one pair of grains
 * (doubles) or one a lane (registers of dsmc's kernels). Included with
 *
 *   GG_NUMBER, GG_VECTOR, GG_OF(name)    as in common/vec_of.h
 *   GG_CONTACT                           a struct with the members of gg_contact
 *   GG_ALL(x)                            a coefficient of it as a GG_NUMBER
 *   GG_ABS(x), GG_SQRT(x), GG_IF_LESS(a, b, yes, no)
 *
 * Products and sums are those of the language, in the order written, for all kinds: so they leave the same bits. No
 * guard: each inclusion makes the functions of its own kind, and forgets what it was included with. */

/* Relative velocity of the surfaces at contact, g = c12 - k x (s1 + s2). */
GG_INLINE GG_VECTOR GG_OF(contact_velocity)(gg_rule rule, GG_VECTOR k, GG_VECTOR c12, GG_VECTOR s1, GG_VECTOR s2)
{
  return rule == GG_SMOOTH ? c12 : GG_OF(sub)(c12, GG_OF(cross)(k, GG_OF(add)(s1, s2)));
}

/* Impulse J on grain 2 (-J on grain 1), from the contact velocity, its normal part gn = k.g and that of the impulse, Jn
 * = m_r (1+e) gn; jt = m_t (1+beta). */
GG_INLINE GG_VECTOR GG_OF(impulse_of)(gg_rule rule, GG_NUMBER jt, GG_NUMBER mu, GG_VECTOR k, GG_VECTOR g, GG_NUMBER gn,
                                      GG_NUMBER Jn)
{
  GG_VECTOR normal = GG_OF(scale)(Jn, k);
  if (rule == GG_SMOOTH) return normal;
  GG_VECTOR gt = GG_OF(sub)(g, GG_OF(scale)(gn, k));
  if (rule == GG_FRICTIONAL) {
    GG_NUMBER gt2 = GG_OF(dot)(gt, gt), limit = mu * GG_ABS(Jn);
    jt = GG_IF_LESS(limit * limit, jt * jt * gt2, limit / GG_SQRT(gt2), jt); /* sliding; never with gt = 0 */
  }
  return GG_OF(axpy)(jt, gt, normal);
}

/* The same for the coefficients of the contact. */
GG_INLINE GG_VECTOR GG_OF(impulse)(gg_rule rule, const GG_CONTACT *c, GG_VECTOR k, GG_VECTOR g, GG_NUMBER gn)
{
  return GG_OF(impulse_of)(rule, GG_ALL(c->jt), GG_ALL(c->mu), k, g, gn, c->jn * gn);
}

/* Normal part of the impulse of kicks. */
GG_INLINE GG_NUMBER GG_OF(normal_kick)(const GG_CONTACT *c, GG_VECTOR k)
{
  (void)k; /* no kick depends on the direction */
  return GG_ALL(c->kick[GG_NORMAL_KICK]);
}

/* The impulse with the kicks of the contact, from the part Jn without them. */
GG_INLINE GG_VECTOR GG_OF(kicked_impulse_of)(gg_rule rule, const GG_CONTACT *c, GG_NUMBER jt, GG_NUMBER mu, GG_VECTOR k,
                                             GG_VECTOR g, GG_NUMBER gn, GG_NUMBER Jn)
{
  GG_VECTOR J = GG_OF(impulse_of)(rule, jt, mu, k, g, gn, Jn + GG_OF(normal_kick)(c, k));
  const GG_NUMBER kt = GG_ALL(c->kick[GG_TANGENTIAL_KICK]);
  J.x = J.x - kt * k.y;
  J.y = J.y + kt * k.x;
  return J;
}
GG_INLINE GG_VECTOR GG_OF(kicked_impulse)(gg_rule rule, const GG_CONTACT *c, GG_VECTOR k, GG_VECTOR g, GG_NUMBER gn)
{
  return GG_OF(kicked_impulse_of)(rule, c, GG_ALL(c->jt), GG_ALL(c->mu), k, g, gn, GG_ALL(c->jn) * gn);
}

/* Energy that the kicks P give within the impulse J, whose normal part is Jn: that after J, less that after J - P. */
GG_INLINE GG_NUMBER GG_OF(kick_energy)(const GG_CONTACT *c, GG_VECTOR k, GG_VECTOR g, GG_NUMBER gn, GG_VECTOR J,
                                       GG_NUMBER Jn)
{
  GG_NUMBER kn = GG_OF(normal_kick)(c, k), kt = GG_ALL(c->kick[GG_TANGENTIAL_KICK]),
            imr = GG_ALL(c->im1) + GG_ALL(c->im2), imt = imr + (GG_ALL(c->ik1) + GG_ALL(c->ik2));
  GG_NUMBER along_J = k.x * J.y - k.y * J.x, along_g = k.x * g.y - k.y * g.x, square = k.x * k.x + k.y * k.y;
  return kn * (imr * (Jn - 0.5 * kn) - gn) + kt * (imt * (along_J - 0.5 * kt * square) - along_g);
}

/* Give the impulse to both partners: to their centres, and to their spins. */
GG_INLINE void GG_OF(kick_centres)(GG_NUMBER im1, GG_NUMBER im2, GG_VECTOR J, GG_VECTOR *c1, GG_VECTOR *c2)
{
  *c1 = GG_OF(sub)(*c1, GG_OF(scale)(im1, J));
  *c2 = GG_OF(add)(*c2, GG_OF(scale)(im2, J));
}
GG_INLINE void GG_OF(kick_spins)(GG_NUMBER ik1, GG_NUMBER ik2, GG_VECTOR k, GG_VECTOR J, GG_VECTOR *s1, GG_VECTOR *s2)
{
  GG_VECTOR kJ = GG_OF(cross)(k, J);
  *s1 = GG_OF(sub)(*s1, GG_OF(scale)(ik1, kJ));
  *s2 = GG_OF(sub)(*s2, GG_OF(scale)(ik2, kJ));
}

#undef GG_NUMBER
#undef GG_VECTOR
#undef GG_OF
#undef GG_CONTACT
#undef GG_ALL
#undef GG_ABS
#undef GG_SQRT
#undef GG_IF_LESS
