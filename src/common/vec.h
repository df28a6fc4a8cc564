/* Three-vectors by value; everything inlines. */
#ifndef GG_VEC_H
#define GG_VEC_H

#define GG_INLINE static inline __attribute__((always_inline))

typedef struct gg_vec {
  double x, y, z;
} gg_vec;

GG_INLINE gg_vec gg_add(gg_vec a, gg_vec b)
{
  return (gg_vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
GG_INLINE gg_vec gg_sub(gg_vec a, gg_vec b)
{
  return (gg_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}
GG_INLINE gg_vec gg_scale(double f, gg_vec a)
{
  return (gg_vec){f * a.x, f * a.y, f * a.z};
}
GG_INLINE double gg_dot(gg_vec a, gg_vec b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
GG_INLINE gg_vec gg_cross(gg_vec a, gg_vec b)
{
  return (gg_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* a + f b */
GG_INLINE gg_vec gg_axpy(double f, gg_vec b, gg_vec a)
{
  return (gg_vec){a.x + f * b.x, a.y + f * b.y, a.z + f * b.z};
}

#endif
