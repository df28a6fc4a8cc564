/* A law of normal restitution: e of the relative normal speed at contact, where a scene has one instead of constants.
 */
#ifndef GG_RESTITUTION_H
#define GG_RESTITUTION_H

#include "common/error.h"
#include "common/vec.h"

typedef struct gg_restitution_law {
  const char *name;  /* borrowed, as `context` is */
  gg_restitution *e; /* NULL: e is constant */
  void *context;
} gg_restitution_law;

/* e of two species at a speed in the units of results, within 0 and 1 whatever the law says. */
GG_INLINE double gg_law_at(const gg_restitution_law *law, double normal_speed, int species_1, int species_2)
{
  double e = law->e(law->context, normal_speed, species_1, species_2);
  return e < 1 ? (e > 0 ? e : 0) : e >= 1 ? 1 : 0;
}

/* A law read off a table of ascending speeds: the `gg_restitution` of a `context` that is one of these. */
typedef struct gg_law_table {
  size_t n;
  const double *speed, *e;
} gg_law_table;
double gg_law_from_table(void *table, double normal_speed, int species_1, int species_2);

/* Is it a number from 0 to 1 at speeds of all sizes? */
gg_status gg_law_check(const gg_restitution_law *law, int n_species, gg_error *err);

#endif
