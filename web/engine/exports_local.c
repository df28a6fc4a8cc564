/* The temperature between walls at one instant. */
#include <math.h>

#include "exports.h"

enum { MOST_SLABS = 128, GRAINS_PER_SLAB = 30 };

typedef struct slab {
  double n, c[3], m, mc[3], mcc; /* grains, and sums over them: velocity, mass, momentum, m c^2 */
} slab;

static void add_to_slab(slab *s, double mass, const double *c)
{
  s->n++, s->m += mass;
  for (int a = 0; a < 3; a++) s->c[a] += c[a], s->mc[a] += mass * c[a], s->mcc += mass * c[a] * c[a];
}

/* sum m (c - u)^2 about the mean u of the slab, with what the mean of few takes away given back. */
static double heat_of_slab(const slab *s)
{
  double sum = s->mcc;
  if (s->n < 2) return 0;
  for (int a = 0; a < 3; a++) {
    double u = s->c[a] / s->n;
    sum += u * (s->m * u - 2 * s->mc[a]);
  }
  return sum * s->n / (s->n - 1);
}

/* T of these grains about the mean velocities of this instant in slabs across y, which are those of the measurements:
 * between walls the results' temperature is such a one, the state's is not. */
PAGE double page_local_temperature(int n, const double *position, const double *velocity, const int *species,
                                   const double *mass, double height)
{
  slab slabs[MOST_SLABS] = {0};
  double heat = 0;
  int n_slabs = (int)fmin(fmax(fmin(floor(height), floor((double)n / GRAINS_PER_SLAB)), 1), MOST_SLABS);
  for (int i = 0; i < n; i++) {
    double at = position[3 * i + 1] / height * n_slabs;
    add_to_slab(&slabs[(int)fmin(fmax(at, 0), n_slabs - 1)], mass[species[i]], velocity + 3 * i);
  }
  for (int k = 0; k < n_slabs; k++) heat += heat_of_slab(&slabs[k]);
  return heat / (3.0 * n);
}
