/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Three-vectors by value, stated once for every kind of number. Included with
 *
 *   GG_NUMBER      a double, or a register with one number a lane
 *   GG_VECTOR      a struct of three of them, x, y and z
 *   GG_OF(name)    what an operation is called for them
 *
 * Everything inlines. No guard: each inclusion makes the operations of its own kind, and forgets what it was included
 * with. */

GG_INLINE GG_VECTOR GG_OF(add)(GG_VECTOR a, GG_VECTOR b)
{
  return (GG_VECTOR){a.x + b.x, a.y + b.y, a.z + b.z};
}
GG_INLINE GG_VECTOR GG_OF(sub)(GG_VECTOR a, GG_VECTOR b)
{
  return (GG_VECTOR){a.x - b.x, a.y - b.y, a.z - b.z};
}
GG_INLINE GG_VECTOR GG_OF(scale)(GG_NUMBER f, GG_VECTOR a)
{
  return (GG_VECTOR){f * a.x, f * a.y, f * a.z};
}
GG_INLINE GG_NUMBER GG_OF(dot)(GG_VECTOR a, GG_VECTOR b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
GG_INLINE GG_VECTOR GG_OF(cross)(GG_VECTOR a, GG_VECTOR b)
{
  return (GG_VECTOR){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* a + f b */
GG_INLINE GG_VECTOR GG_OF(axpy)(GG_NUMBER f, GG_VECTOR b, GG_VECTOR a)
{
  return (GG_VECTOR){a.x + f * b.x, a.y + f * b.y, a.z + f * b.z};
}

#undef GG_NUMBER
#undef GG_VECTOR
#undef GG_OF
