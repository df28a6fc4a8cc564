/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of two times of a cooling gas that is followed in time, by species: displacements and the autocorrelation
 * of velocities from waiting times t_w on, A(t_w, t) = <C(t_w)C(t)>/sqrt(<C(t_w)^2><C(t)^2>).
 *
 * In the time t - t_w the gas ages: A decays the slower the later it begins. In collisions per grain since t_w,
 * int nu(T) dt with Enskog's rate at the measured temperature, a gas in its scaled state has the same A for all t_w.
 * Displacements grow in proportion to that number, which grows as the logarithm of time: <Dr^2> = 6 D/nu times it, with
 * D/nu constant (J.J. Brey, M.J. Ruiz-Montero, D. Cubero & R. Garcia-Rojo, Phys. Fluids 12 (2000) 876; A. Bodrova,
 * A.V. Chechkin, A.G. Cherstvy & R. Metzler, Phys. Chem. Chem. Phys. 17 (2015) 21791). */
#ifndef GG_TWO_TIMES_H
#define GG_TWO_TIMES_H

#include "measure/curve.h"
#include "measure/displacement.h"

typedef struct gg_two_times gg_two_times;

bool gg_measure_two_times_applies(const gg_model *model);
gg_two_times *gg_measure_two_times_new(const gg_model *model, gg_error *err);
void gg_measure_two_times_free(gg_two_times *t); /* NULL: nothing */
void *gg_measure_two_times_memory(gg_two_times *t, size_t *bytes);
bool gg_measure_two_times_is_memory(const gg_two_times *t);
void gg_measure_two_times_restart(gg_two_times *t);
size_t gg_measure_two_times_bins(const gg_model *model);
void gg_measure_two_times_collide(gg_two_times *t, const gg_collision_record *collision);
void gg_measure_two_times_rescaled(gg_two_times *t, double factor);
void gg_measure_two_times_add(gg_two_times *t, const gg_snapshot *s, double *bins);
void gg_measure_two_times_curves(const gg_model *model, const double *bins, gg_curves *list);

#endif
