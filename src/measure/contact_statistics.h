/* Pairs near contact: those that approach and those that part apart, and from them the pair correlation at contact of
 * each, by extrapolation.
 *
 * Of grains at contact those that part are what collisions left of those that approached: as many leave the sphere as
 * reach it, at e times the normal speed, so that they are 1/e times as dense (Lutsko, Phys. Rev. E 63 (2001) 061211).
 * Enskog's chi is that of the pairs about to collide.
 *
 * Approaching pairs are counted by the gap r - sigma, in which their density is smooth. That of parting pairs is not
 * where collisions lose energy: directions of parting within a cone about the line of centres lead back to contact,
 * others past it, and the cone opens as sqrt(2 (r - sigma)/sigma). So of parting pairs those count whose straight way
 * back leads to contact, by y = (normal speed there) x (time since then). Contacts of normal speed g_n come at the rate
 * (density at contact) x g_n, and stay within dy for dy/g_n: the density in y begins with that at contact, whatever the
 * velocities, and changes only as third grains interfere. */
#ifndef GG_CONTACT_H
#define GG_CONTACT_H

#include "common/model.h"

enum { GG_NEAR_BINS = 32, GG_NEAR_WIDTH = 4 * GG_NEAR_BINS };

/* How far from contact is looked; for pairs of one diameter sigma. */
typedef struct gg_near {
  double sigma, reach; /* reach: the widest gap */
  double gap, way;     /* up to which r - sigma and y are fitted */
  int order;           /* of the polynomials in ln g */
} gg_near;

gg_near gg_measure_contact_setup(const gg_model *model, double sigma, double longest_reach);

/* Count a pair; r from the first to the second, g the second's velocity less the first's, flow included; `speed` is by
 * what normal speeds are divided. `bin`: GG_NEAR_WIDTH sums. */
void gg_measure_contact_count(const gg_near *near, double *bin, gg_vec r, double square, gg_vec g, double speed,
                              double weight);

/* Read off the means over samples: 2 g at contact of the approaching, of the parting, of both taken as alike (all pairs
 * by their gap); and the mean normal speed of the approaching at contact, in units of `speed`. pairs_per_volume: number
 * of pairs of grains over the volume. NaN where there are too few. */
typedef struct gg_contact_density {
  double approaching, parting, alike, speed;
} gg_contact_density;
gg_contact_density gg_measure_contact_estimate(const gg_near *near, const double *bin, double pairs_per_volume,
                                               double samples);

#endif
