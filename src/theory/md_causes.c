/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/md_causes.h"

#include <math.h>
#include <stdio.h>

#include "theory/goldhirsch_zanetti1993.h"

double gg_theory_expected_deviation(const gg_model *m, gg_quantity q)
{
  bool dissipative = false;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) dissipative = dissipative || m->e[gg_pair(i, j)] < 0.7;
  if (gg_common_quantity_mask(q) & GG_STRESS_DIFFERENCE) return m->phi <= 0.3 && !dissipative ? 0.02 : 0.05;
  if (m->phi <= 0.05) return dissipative ? 0.015 : 0.01;
  return m->phi <= 0.3 && !dissipative ? 0.03 : 0.10;
}

/* Waves of a homogeneous gas near its instability may be a few times those of an elastic one: sheared, e = 0.5, 1000
 * grains, three times. */
#define STRUCTURED 4.0

static bool is_raised(const gg_mean *waves)
{
  const double error = isfinite(waves->error) ? waves->error : 0;
  return waves->mean - 2 * error > STRUCTURED;
}

static bool has_waves(const gg_mean *density)
{
  return isfinite(density->mean) && density->mean > 0;
}

bool gg_theory_structure(const gg_mean *density, const gg_mean *momentum, char *text, size_t size)
{
  if (!has_waves(density)) return false;
  if (is_raised(density))
    snprintf(text, size,
             "the grains have clustered: density waves of the box's length are %.2g times those of a homogeneous gas, "
             "shear waves %.2g times",
             density->mean, momentum->mean);
  else if (is_raised(momentum))
    snprintf(text, size,
             "the gas swirls: shear waves of the box's length are %.2g times those of a homogeneous gas, density waves "
             "%.2g times",
             momentum->mean, density->mean);
  else
    return false;
  return true;
}

/* 1: the quantity grows with the energy of the grains; -1: it falls; 0: neither is known. */
static int follows_energy(gg_quantity q)
{
  switch (q) {
  case GG_Q_TEMPERATURE:
  case GG_Q_ROTATIONAL_TEMPERATURE:
  case GG_Q_PRESSURE:
  case GG_Q_SHEAR_VISCOSITY:
  case GG_Q_COLLISION_RATE: return 1;
  case GG_Q_COOLING_RATE: return -1;
  default: return 0;
  }
}

/* Each writes its sentence and returns true where it applies to this difference. */
typedef bool cause(const gg_theory_difference *d, char *text, size_t size);

static bool not_steady(const gg_theory_difference *d, char *text, size_t size)
{
  if (!d->unsteady) return false;
  snprintf(text, size, "md has no steady mean: %s", d->unsteady);
  return true;
}

/* Structure is a cause of its own, which several others are not beside. */
static bool is_homogeneous(const gg_theory_difference *d)
{
  char text[240];
  return !gg_theory_structure(&d->density_waves, &d->momentum_waves, text, sizeof text);
}

/* Quantities that do not depend on velocities of single grains are the same in any frame. */
static bool about_cells(const gg_theory_difference *d, char *text, size_t size)
{
  if (!d->model->frame || d->q == GG_Q_COLLISION_RATE || d->q == GG_Q_DISSIPATION) return false;
  snprintf(text, size,
           "md's velocities are relative to the means of cells (frame), those of Monte Carlo and theories to "
           "the imposed flow");
  return true;
}

static bool structured(const gg_theory_difference *d, char *text, size_t size)
{
  char what[240];
  if (!gg_theory_structure(&d->density_waves, &d->momentum_waves, what, sizeof what)) return false;
  snprintf(text, size, "%s; %lld grains, default %lld; a Monte Carlo ensemble stays homogeneous", what,
           (long long)d->model->n, (long long)d->default_size);
  return true;
}

/* Shear waves decay slowly near their instability; they respond to the shear and so raise the viscosity. */
static bool waves_respond(const gg_theory_difference *d, char *text, size_t size)
{
  const gg_mean *waves = &d->momentum_waves;
  if (!(d->model->linear_response && waves->mean - 2 * waves->error > 1.5)) return false;
  snprintf(
      text, size,
      "shear waves of the box's length, %.2g times those of a homogeneous gas, answer the shear, too: in a smaller "
      "box the viscosity is lower",
      waves->mean);
  return true;
}

/* Results of versions that did not measure waves. */
static bool may_be_structured(const gg_theory_difference *d, char *text, size_t size)
{
  const gg_model *m = d->model;
  const double L = gg_theory_clustering_length(m), edge = fmax(m->box[0], fmax(m->box[1], m->box[2]));
  if (m->walled || has_waves(&d->density_waves) || !(edge > (m->shear_rate != 0 ? 3 : 1) * L)) return false;
  snprintf(
      text, size,
      "the box, %.3g d, is longer than the length above which this gas forms clusters or vortices, %.3g d; a Monte "
      "Carlo ensemble stays homogeneous",
      edge, L);
  return true;
}

/* Collisions without loss leave more energy. It changes by less than ten times their fraction. */
static bool treated(const gg_theory_difference *d, char *text, size_t size)
{
  const double fraction = d->treated;
  if (!(fraction > 1e-3 && d->by * follows_energy(d->q) > 0 && fabs(d->by) < 10 * fraction)) return false;
  snprintf(text, size, "%.2g %% of md's collisions fell under the contact-time rule and lost no energy",
           100 * fraction);
  return true;
}

/* Dense dissipative grains do not part after a contact: collisions are then many times as frequent as Enskog's at this
 * temperature. usf, e = 0.5, beta = 0: 1.5, 4.6, 16 and 81 times at phi = 0.3, 0.4, 0.45 and 0.5, the same with 250 to
 * 2000 grains; smooth grains 2.5 times at phi = 0.5. */
#define LASTING_CONTACTS 4.0
static bool lasting_contacts(const gg_theory_difference *d, char *text, size_t size)
{
  const double enskog = gg_common_model_collision_rate(d->model, d->T), times = d->rate / enskog;
  if (!(d->model->phi > 0.3 && times > LASTING_CONTACTS && d->by * follows_energy(d->q) >= 0)) return false;
  snprintf(text, size,
           "grains stay in contact: md collides %.2g times as often as Enskog's equation at this temperature; forces "
           "pass along chains of grains as near jamming, so that a kinetic theory of pairs does not apply",
           times);
  return true;
}

static bool number_of_grains(const gg_theory_difference *d, char *text, size_t size)
{
  const gg_model *m = d->model;
  if (!(is_homogeneous(d) && m->shear_rate != 0 && m->phi > 0.01 && m->phi <= 0.3 && follows_energy(d->q) > 0 &&
        d->by > 0 && d->by < 0.4))
    return false;
  snprintf(
      text, size,
      "number of grains, %lld here (default %lld): md's T rises from 200 grains to 8000 by a few per cent, at phi = "
      "0.1 and e = 0.7 by a fifth or more; compare at equal numbers",
      (long long)m->n, (long long)d->usual_size);
  return true;
}

static bool hot_spins(const gg_theory_difference *d, char *text, size_t size)
{
  const gg_model *m = d->model;
  if (!(is_homogeneous(d) && m->rule == GG_ROUGH && d->q == GG_Q_TEMPERATURE_RATIO && m->phi > 0.05 && d->by > 0 &&
        d->by < 0.2))
    return false;
  snprintf(text, size,
           "rough grains: velocities and spins are correlated, so that theta/T in md lies above Enskog's, by some 9 %% "
           "at phi = 0.3 and beta = 0");
  return true;
}

static bool correlated(const gg_theory_difference *d, char *text, size_t size)
{
  const gg_model *m = d->model;
  const bool dense = m->phi > 0.3, moderate = m->phi > 0.05 && !m->elastic && fabs(d->by) < 0.3;
  if (!is_homogeneous(d) || (!dense && !moderate)) return false;
  snprintf(text, size,
           "velocities of neighbours are correlated before they collide, which Enskog's equation leaves out; the more "
           "so the denser and the more dissipative the gas");
  return true;
}

/* hss, e = 0.8, phi = 0.1: md's rate of collisions is 1.2, 4.9 and 9.8 % above Enskog's where a grain goes 1.8, 0.49
 * and 0.2 diameters until the bath turns it; T agrees. */
#define LONG_DISTANCE 3
static bool meets_again(const gg_theory_difference *d, char *text, size_t size)
{
  const gg_model *m = d->model;
  const double T = d->T;
  const bool of_collisions = d->q == GG_Q_COLLISION_RATE || d->q == GG_Q_MEAN_FREE_PATH || d->q == GG_Q_KNUDSEN;
  const double distance = sqrt(isfinite(T) ? T : m->temperature0) / m->bath.drag[0];
  if (!(is_homogeneous(d) && m->bath.drag[0] > 0 && m->shear_rate == 0 && of_collisions && distance < LONG_DISTANCE &&
        d->by * (d->q == GG_Q_COLLISION_RATE ? 1 : -1) > 0 && fabs(d->by) < 0.4))
    return false;
  snprintf(
      text, size,
      "the bath turns a grain after sqrt(T)/drag = %.2g d, so that grains that have met meet again: md collides more "
      "often than Enskog's equation has, at phi = 0.1 by 5 %% where that distance is 0.5 d, by 10 %% at 0.2 d",
      distance);
  return true;
}

static bool at_walls(const gg_theory_difference *d, char *text, size_t size)
{
  if (!d->model->walled || fabs(d->by) > 0.3) return false;
  snprintf(text, size,
           "near walls grains meet again after one returns from the wall, which Enskog's equation leaves out, and "
           "layers order "
           "along it, which Monte Carlo has shallower: at phi = 0.3 the first minimum is 0.27 in it, 0.24 in md");
  return true;
}

static cause *const causes[] = {not_steady,        about_cells,      structured,  waves_respond,
                                may_be_structured, lasting_contacts, treated,     number_of_grains,
                                hot_spins,         correlated,       meets_again, at_walls};

int gg_theory_md_causes(const gg_theory_difference *d, void (*add)(void *context, const char *text), void *context)
{
  char text[GG_CAUSE_TEXT];
  int n = 0;
  for (size_t i = 0; i < sizeof causes / sizeof *causes; i++)
    if (causes[i](d, text, sizeof text)) add(context, text), n++;
  return n;
}
