/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model: the problem in the engines' units, with everything that both engines and the theories derive from it once.
 * scene/model_of_scene.c makes it from a scene; a program without scenes fills in the members that no function below
 * sets and calls these in their order. It has room for any number of species; engines copy what their kernels read into
 * arrays as small as the problem needs.
 *
 * Units: length d of species 1, mass m of species 1; time 1/shear_rate (of the start) in sheared and walled-shear
 * flows, else d/v_0. v_0 = sqrt(2 T_0/m) with the temperature of the start in gases that cool, are in equilibrium or
 * keep that temperature, so that T_0 = 1/2; between resting walls, in a bath, and with a given noise or rate it is one
 * diameter per unit of time of the scene. These are the units of every result, too.
 * Boltzmann limit (phi = 0): n d^2 = 1 sets the length; formally n = d = chi = 1, and nothing of collisional transfer.
 *
 * Spins are surface velocities s = (d/2) omega throughout (see common/collision.h). */
#ifndef GG_MODEL_H
#define GG_MODEL_H

#include "base/cancellation.h"
#include "common/collision.h"
#include "common/extension.h"
#include "common/flow.h"
#include "common/kinds.h"
#include "common/laws/speed_laws.h"
#include "common/observables.h"
#include "common/restitution.h"
#include "common/species.h"
#include "common/surface/surface.h"

/* Drag and noise on every grain between collisions, relative to the imposed flow, by species (thermostat.h):
 *   dC = -drag C dt + sqrt(noise) dW,   ds = -spin_drag (s - rolling) dt + sqrt(spin_noise) dW. */
typedef struct gg_bath {
  bool on;
  double drag[GG_MAX_SPECIES], noise[GG_MAX_SPECIES], spin_drag[GG_MAX_SPECIES], spin_noise[GG_MAX_SPECIES];
} gg_bath;

/* The units of the model in those of the scene. */
typedef struct gg_units {
  double length, mass, time;
} gg_units;

/* A velocity, and a temperature (mass x velocity^2), of the scene in units of the model. */
static inline double gg_units_velocity(gg_units unit, double velocity)
{
  return velocity * unit.time / unit.length;
}
static inline double gg_units_temperature(gg_units unit, double temperature)
{
  return gg_units_velocity(unit, gg_units_velocity(unit, temperature)) / unit.mass;
}

typedef struct gg_model {
  gg_units unit;
  gg_flow flow;
  gg_thermostat thermostat;
  gg_rule rule;         /* the most complex rule that any collision of the scene needs */
  bool boltzmann;       /* phi = 0 */
  bool ensemble;        /* Monte Carlo: the number of grains is that of samples, not part of the problem */
  bool homogeneous;     /* no box: an ensemble that stands for one point of the flow (dsmc without walls or a wave) */
  bool elastic_grains;  /* every collision between grains conserves energy */
  bool elastic;         /* every collision conserves energy: e = 1 and (smooth, or beta = 1 without sliding); of walls
                         * those without a temperature count */
  bool linear_response; /* of a cooling or heated gas to shear (linear_response.h) */
  bool steady;          /* a steady state can exist (scaled, for cooling) */

  int64_t n; /* grains (of the engine's kind: `dsmc.particles` may differ from `particles`) */
  int n_species;
  int64_t n_of[GG_MAX_SPECIES];          /* 0 in a model for theories alone */
  double fraction[GG_MAX_SPECIES];       /* n_i/n: of the grains there are; for theories alone, exactly the scene's */
  double number_density[GG_MAX_SPECIES]; /* n_i d_1^3 */
  double diameter[GG_MAX_SPECIES], mass[GG_MAX_SPECIES], inertia[GG_MAX_SPECIES]; /* inertia: K = 4I/(m d^2) */

  gg_frame_kind frame;                      /* of peculiar velocities; imposed where there are walls, or no box */
  int frame_cells;                          /* along each edge, or slabs along y */
  double local_density[GG_LOCAL_DENSITIES]; /* of local_distributions, up to a 0; none: multiples of phi */

  double phi, density;   /* density: n d_1^3, 1 in the Boltzmann limit */
  double box[3], volume; /* edges, volume = n/density */
  double length;         /* cube root of the volume; between walls of that in md, whatever the ensemble's size */
  double shear_rate;     /* 1 if sheared, until it changes on the way, also to 0 or below; else 0 */
  double gravity[3];
  gg_bath bath;
  bool turns;                    /* some species has a torque */
  double torque[GG_MAX_SPECIES]; /* constant, about z: over moment of inertia and radius, an acceleration of s */

  gg_contact contact[GG_MAX_SPECIES][GG_MAX_SPECIES]; /* grain 1 of the first species, grain 2 of the second */
  gg_contact treated[GG_MAX_SPECIES][GG_MAX_SPECIES]; /* for the contact-time rule: e = 1, see gg_common_treated_beta */
  /* By pair of species: gg_pair. */
  double sigma[GG_PAIRS];         /* (d_i + d_j)/2 */
  double chi[GG_PAIRS];           /* contact value; 1 in the Boltzmann limit */
  double chi_slope;               /* d ln chi/d ln phi of one species; 0 in the Boltzmann limit */
  gg_contact_value contact_value; /* which chi is, for other densities than phi */
  double e[GG_PAIRS], beta[GG_PAIRS], mu[GG_PAIRS];
  double kick[GG_N_KICKS][GG_PAIRS]; /* D and D_t of common/collision.h */
  bool kicks;                        /* some pair has a kick */
  /* Law of restitution between grains (name NULL: none), or formulas and tables by_speed of e, beta and mu, whose name
   * is "e(v)". With one, `e`, `beta`, `mu` and `contact` are those at the mean impact speed of some temperature
   * (gg_common_model_at), for estimates, and engines evaluate the law at every collision. */
  gg_restitution_law law;
  gg_speed_laws by_speed;
  double speed_unit; /* a speed in the units of by_speed, those of the scene, over that of the model */

  bool walled;       /* there are surfaces: the box is closed along y, and no flow is imposed */
  gg_rule wall_rule; /* of smooth grains, too, whose spins it leaves alone */
  int n_surfaces;
  gg_surface surface[GG_MOST_SURFACES];

  double temperature0; /* <C.C>/3 that a run starts from (mass-averaged for mixtures: sum x_i m_i <C.C>_i/3) */
  double ratio0;       /* theta/T that a run starts from */
  double a2_0;         /* fourth cumulant of the velocities that a run starts from */
  double wave;         /* amplitude of a transverse wave that a run starts from, over v_0 (shear_wave.h); 0: none */
  bool lattice;        /* md: a run starts from a face-centred lattice */
  double spin0;        /* mean spin along z that a run starts from, angular velocity; see gg_model_starting_spin */
  double contact_time; /* of the contact-time rule, in units of gg_common_model_contact_unit; 0: off */
  double time_step;    /* dsmc, in mean free times per grain; GG_AUTO */
  bool cuts_steps;     /* dsmc: a given step, too, ends with an advance: it is followed in time, or stepped */
  double asked_error;  /* relative, that ends the run; 0: none does. dsmc chooses its step by it */
  bool single;         /* dsmc: velocities kept in single precision */

  const gg_extension *extension;       /* borrowed from the scene */
  const gg_stop *stop;                 /* borrowed from the caller of the engine: no physics; NULL: nothing stops it */
  const struct gg_grain_arrays *start; /* md: grains to start with, likewise borrowed (engine.h); NULL: the engine's */
  int threads;                         /* that may share its start, the caller's included: no physics; 0: one */

  double stress_unit; /* reported stress = stress_unit * (stress per volume in model units): pi/6, or 1 */
} gg_model;

/* True if the temperature stays what it is, in a steady state. Else sampling follows the collision rate, and what has a
 * dimension of velocity or time has no mean. */
static inline bool gg_model_keeps_temperature(const gg_model *model)
{
  return model->steady && !gg_flow_cools(model->flow);
}

/* True if the flow is sheared. The rate may be 0 at times, in a box whose images keep an offset. */
static inline bool gg_model_is_sheared(const gg_model *m)
{
  return gg_flow_is_sheared(m->flow);
}

/* x n_i/n, of whole numbers of grains without the rounding of the fraction. */
static inline double gg_model_part(const gg_model *m, double x, int i)
{
  return m->n_of[i] ? x * (double)m->n_of[i] / (double)m->n : x * m->fraction[i];
}

/* Do collisions have a speed of their own, by a law of restitution or kicks? Then nothing scales with sqrt(T). */
static inline bool gg_model_has_speed(const gg_model *m)
{
  return m->law.name || m->kicks;
}

/* Do kicks at contact, torques, or an e above 1 at some speed give energy? */
static inline bool gg_model_is_injected(const gg_model *m)
{
  return m->kicks || m->turns || m->by_speed.gains;
}

/* The collision rule of a pair of species at all speeds. */
static inline gg_rule gg_model_pair_rule(const gg_model *m, int pair)
{
  return gg_common_speed_laws_rule(&m->by_speed, pair, m->beta[pair], m->mu[pair]);
}

/* Radius of a grain that turns a surface velocity into a spin; 1 in the Boltzmann limit. */
static inline double gg_model_radius(const gg_model *m, int species)
{
  return m->boltzmann ? 1 : m->diameter[species] / 2;
}

/* Surface velocity of a grain that rolls with the imposed shear; 0 in the Boltzmann limit, beside thermal ones. */
static inline double gg_model_rolling(const gg_model *m, int species)
{
  return m->boltzmann ? 0 : -m->shear_rate * m->diameter[species] / 4;
}

/* Mean surface velocity along z of the grains of a species at the start. */
static inline double gg_model_starting_spin(const gg_model *m, int species)
{
  return m->spin0 * gg_model_radius(m, species);
}

/* Density, volume and box, from n, n_species, n_of or fraction, diameter, and the relative edges of the box. */
void gg_common_model_set_size(gg_model *model, double phi, const double aspect[3]);
/* Contacts, contact values and the collision rule, from e, beta and mu by pair and from contact_value. */
void gg_common_model_set_pairs(gg_model *model);
/* Walls of a flow that has some. Smooth grains have no spin to take up the torque of a rough wall, which acts on their
 * centres (with beta_w = 0 the flat wall of type A of Campbell, J. Fluid Mech. 247 (1993) 111). With spins that nothing
 * else changes, the torques of both walls would have to cancel in a steady state, and with them the shear stress.
 * GG_BAD_INPUT: no room for the gas. */
gg_status gg_common_model_set_walls(gg_model *model, const gg_walls *walls, gg_error *err);
/* The start: temperature0, here or (GG_AUTO) by an order-of-magnitude estimate; ratio0 and spin0 by estimates, which
 * the caller may improve before an engine is made; and the rest of the model: is it steady, its unit of stress. */
void gg_common_model_set_start(gg_model *model, double temperature);

/* With a restitution law: e, beta, mu and contacts at the mean normal speed at impact of Maxwellians at temperature T.
 */
void gg_common_model_at(gg_model *model, double T);

/* Name the law of a model that has formulas or tables of the speed: "e(v)". */
void gg_common_model_name_law(gg_model *model);

/* Unit of contact times in words: under gravity the time of a fall, unless gravity is too weak (md/contact_time.c). */
const char *gg_common_model_contact_unit(const gg_model *model);

/* True if a wall of a temperature of its own warms or cools the gas. All walls have one, or none. */
static inline bool gg_model_has_thermal_walls(const gg_model *m)
{
  return m->n_surfaces > 0 && m->surface[0].accommodation > 0;
}

/* True if the energy that collisions, drag and kicks exchange can be in balance, and the torque of every spin. */
bool gg_common_model_balances(const gg_model *model);

/* True if torques or tangential kicks single out the z axis. */
bool gg_common_model_is_turned(const gg_model *model);

/* True if collisions of these two species destroy energy. */
bool gg_common_pair_loses(const gg_model *model, int i, int j);

/* Largest and smallest diameter of a species. */
double gg_common_model_widest(const gg_model *model);
double gg_common_model_narrowest(const gg_model *model);

/* Tangential restitution of contacts that the contact-time rule treats, whose e is 1. Unlike grains lose nothing at
 * all: smooth, or perfectly rough where they are. (With friction left a light grain is rolled to rest between heavy
 * ones, by collisions without end: masses 1:100 did, at any contact time.) */
double gg_common_treated_beta(const gg_model *model, int i, int j);

/* Collisions per unit time of `share` grains of species i with grains of j, at temperature T = m <c^2>/3. */
double gg_common_model_pair_rate(const gg_model *model, double share, int i, int j, double T);

/* Boltzmann-Enskog collision rate per grain at temperature T: 4 n d^2 chi sqrt(pi T) for one species. */
double gg_common_model_collision_rate(const gg_model *model, double T);

/* The same of a grain of species i, all species at the temperature T. */
double gg_common_model_species_rate(const gg_model *model, int i, double T);

/* nu_0 that the cooling rate zeta* is counted in: (16/5) sqrt(pi) n d^2 sqrt(T) (Garzo & Dufty 1999), T = <C.C>/3, for
 * one species; sqrt(pi) n sigma_12^2 v_0, v_0^2 = 2T(m1+m2)/(m1 m2) for two (Montanero & Garzo 2003); of more the mean
 * of that over all unlike pairs of grains. */
double gg_common_model_nu0(const gg_model *model, double T);

/* surface/surfaces.c: the list of surfaces, for gg_common_model_set_walls. Grains without spins are acted on at their
 * centres. GG_BAD_INPUT where they leave no room for the gas. */
gg_status gg_common_surfaces_make(gg_model *model, const gg_walls *walls, bool spins, gg_error *err);

/* The plain or other surface at the upper (1) or lower (-1) end of an axis; NULL: none. */
const gg_surface *gg_surface_at(const gg_model *model, int axis, double side);

/* True if the box is closed along this axis: not periodic, with no grain beyond its ends; also without an upper
 * wall. */
bool gg_common_surface_is_closed(const gg_model *model, int axis);
/* Closed across y, and nothing at the upper end. */
bool gg_common_surface_is_open_above(const gg_model *model);

/* The surface that takes this one's place where y changes its sign; -1: none. */
int gg_surface_image(const gg_model *model, int surface);

#endif
