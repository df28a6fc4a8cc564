/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene: the user's input. Every number is in the user's own units of length, mass and time; temperatures are mass
 * x velocity^2. Plain data; the field table of src/scene/fields.c holds the default of every member, reads, checks,
 * prints and documents it. */
#ifndef GG_SCENE_H
#define GG_SCENE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "common/collision.h"
#include "common/extension.h"
#include "common/flow.h"
#include "common/kinds.h"
#include "common/laws/laws.h"
#include "common/laws/speed_laws.h"
#include "common/observables.h"
#include "common/species.h"

typedef enum gg_frames_after { GG_AFTER_START, GG_AFTER_WARMUP } gg_frames_after;
enum { GG_FIELDS_POSITION = 1, GG_FIELDS_VELOCITY = 2, GG_FIELDS_SPIN = 4, GG_FIELDS_IMAGE = 8, GG_FIELDS_ALL = 15 };
typedef enum gg_kept_state { GG_STATE_REMOVED, GG_STATE_KEPT } gg_kept_state;
#define GG_LATTICE "fcc"
typedef enum gg_top { GG_CLOSED_TOP, GG_OPEN_TOP } gg_top;

/* An ensemble of a few thousand stands for one point of the flow to better than 0.1 %; fewer only if requested. */
enum { GG_LEAST_ENSEMBLE = 5000 };

/* Collisions a grain for which a gas that cools by a law of restitution is followed: no error can be
 * requested for a rate that has no steady value. */
enum { GG_COLLISIONS_FOLLOWED = 400 };

/* By default, of a gas that is followed for run.duration. */
enum { GG_REPLICAS_FOLLOWED = 8 };

typedef struct gg_species {
  double fraction, diameter, mass, inertia; /* mole fraction (as given: a weight); user's units; K = 4I/(m d^2) */
  double drag;                              /* of a bath, over bath.drag */
  double torque;                            /* about z, user's units */
} gg_species;

/* At least GG_N_QUANTITIES, which only quantity.h knows. */
enum { GG_MAX_UNTIL = 112, GG_FILE_NAME = 256 };

/* Values that a run fixes and then keeps, through changes of keys and a checkpoint; GG_AUTO: not fixed. They are no
 * keys. */
typedef struct gg_scene_fixed {
  double clock_rate;     /* inverse of the model's unit of time: that of the start, see gg_scene_clock_rate */
  double contact_time;   /* md.contact_time: auto, after a collapse raised it */
  double ensemble_error; /* relative error (0: none) that dsmc.particles: auto was chosen for */
} gg_scene_fixed;

/* A change during the run: one key at one time, in the text of scenes. */
enum { GG_FORMULA_TEXT = 120, GG_MAX_CHANGES = 16, GG_CHANGE_TEXT = 40 };
typedef struct gg_change {
  double at; /* user's units */
  char key[GG_CHANGE_TEXT], value[GG_CHANGE_TEXT];
} gg_change;

/* A set of keys: a bit per row of the field table. */
enum { GG_KEY_BITS = 128 };
typedef struct gg_scene_keys {
  uint64_t bits[GG_KEY_BITS / 64];
} gg_scene_keys;

typedef struct gg_scene gg_scene; /* graingas.h: what the scene is for users */
struct gg_scene {
  gg_flow flow;
  gg_engine_kind engine;
  gg_thermostat thermostat;
  struct {
    double drag, temperature, rotation; /* user's units; rotation: drag of spins over that of velocities */
  } bath;
  double gaussian_rate, noise_strength; /* zeta_0 and xi^2 in the user's units, or GG_AUTO */
  gg_contact_value contact_value;       /* chi of the Monte Carlo engine and of theories */
  double phi;
  int64_t particles;
  struct {
    double rate;                   /* a number; or the largest absolute value of the formula (gg_scene_finish) */
    char formula[GG_FORMULA_TEXT]; /* of the time t, in the user's units; "": rate is constant */
    double period;                 /* of the formula, user's units; GG_AUTO: none */
    int64_t steps;                 /* of constant rate, in a period or in the run */
  } shear;
  struct {
    double temperature, rotational_temperature; /* or GG_AUTO */
    double a2;                                  /* fourth cumulant of the velocities */
    double spin;                                /* mean angular velocity along z, or GG_AUTO: rolling with the shear */
    double wave;                                /* amplitude of a transverse wave, over the thermal velocity */
    char positions[GG_FILE_NAME];               /* "": random; GG_LATTICE; or a file */
  } start;
  double aspect[3]; /* shape of the box, relative edges */
  struct {          /* by pair of species: gg_pair */
    double e[GG_PAIRS], beta[GG_PAIRS], mu[GG_PAIRS];
    double kick[GG_N_KICKS][GG_PAIRS]; /* user's units */
    gg_speed_laws by_speed; /* e, beta and mu that depend on the speed; e[] and so on are their values at 1 */
    gg_law_kind law;
    double speed; /* at which e is e, with a law; in the user's units, or GG_AUTO */
  } collision;
  int n_species;
  gg_species species[GG_MAX_SPECIES];
  double weights; /* what the fractions summed to before they were normalised; 0: they summed to 1. No key */
  struct {
    double e, beta, mu, speed, ridges;
    double temperature[2]; /* lower, upper, in the user's units; GG_AUTO: none */
    double accommodation;  /* share of contacts that leave with it */
    gg_top top;            /* chute: what is above */
  } walls;
  double gravity[3];
  struct {
    double relative_error, collisions, time_limit; /* GG_AUTO: not requested; neither of the first two: 0.01 */
    double until[GG_MAX_UNTIL];                    /* of gg_quantity: its own relative error; 0: not requested */
    double warmup;                                 /* collisions per particle, or GG_AUTO */
    double duration; /* user's units: the gas is followed from its start for so long; GG_AUTO: it is not */
    int64_t replicas;
    uint64_t seed;
  } run;
  struct {
    double contact_time; /* in mean free times, or sqrt(d/|g_y|) under gravity; 0: off; or GG_AUTO */
  } md;
  struct {
    double time_step;  /* in mean free times, or GG_AUTO */
    int64_t particles; /* size of the ensemble, or 0: chosen */
    gg_precision precision;
  } dsmc;
  gg_change protocol[GG_MAX_CHANGES]; /* in the order of times; ends with an empty key */
  unsigned measure;                   /* GG_MEASURE_... */
  gg_frame_kind frame;
  int64_t frame_cells;                        /* along each edge of the box, or slabs along y */
  double local_densities[GG_LOCAL_DENSITIES]; /* solid fractions, up to a 0; none: multiples of phi */
  struct {
    double checkpoint_every; /* seconds, 0: none */
    double trajectory_every; /* collisions per particle, 0: none */
    gg_kept_state state;     /* the last checkpoint of a finished run */
    gg_frames_after after;   /* which of these are stored */
    unsigned fields;         /* GG_FIELDS_..., of every frame */
    gg_precision precision;  /* of them in the file */
    char log[GG_FILE_NAME];  /* rows of samples; "": none */
  } output;
  gg_extension *extension; /* what the user's program adds; NULL: nothing. The scene of the interface holds it, copies
                              of its values borrow it */
  gg_scene_fixed fixed;
  gg_scene_keys given; /* keys that the user gave */
};

/* True if a key of the thermostat gives its strength, instead of the balance with the losses. */
bool gg_scene_is_driven(const gg_scene *scene);

/* True if kicks at contact, torques, or an e above 1 at some speed give energy. */
bool gg_scene_has_kicks(const gg_scene *scene);
bool gg_scene_has_torque(const gg_scene *scene);
static inline bool gg_scene_is_injected(const gg_scene *s)
{
  return gg_scene_has_kicks(s) || gg_scene_has_torque(s) || s->collision.by_speed.gains;
}

/* True if a coefficient depends on the speed by collision.law, a formula or a table. */
static inline bool gg_scene_has_law(const gg_scene *s)
{
  return s->collision.law != GG_LAW_CONSTANT || gg_speed_laws_any(&s->collision.by_speed, gg_pairs_of(s->n_species));
}

/* The collision rule of a pair at all speeds. */
static inline gg_rule gg_scene_pair_rule(const gg_scene *s, int pair)
{
  return gg_common_speed_laws_rule(&s->collision.by_speed, pair, s->collision.beta[pair], s->collision.mu[pair]);
}

/* True if the temperature of the start is the only scale of velocities. Then it makes the unit v_0. */
static inline bool gg_scene_scales_with_start(const gg_scene *s)
{
  return !gg_scene_is_driven(s) && !gg_scene_is_injected(s) && !gg_flow_is_sheared(s->flow) &&
         !gg_flow_is_walled(s->flow);
}

/* protocol.c: the rate that is the unit of sheared flows: the absolute value at the start, or of a start from rest and
 * of a formula the largest one. */
double gg_scene_unit_rate(const gg_scene *scene);

/* Inverse of the model's unit of time in flows without moving walls: the shear rate; v_0/d with v_0^2 = 2 T/m of the
 * start where that temperature is given and the only scale; else 1 of the user's, v_0 being a diameter per unit of
 * time.
 */
static inline double gg_scene_clock_rate(const gg_scene *s)
{
  if (s->fixed.clock_rate != GG_AUTO) return s->fixed.clock_rate;
  if (gg_flow_is_sheared(s->flow)) return gg_scene_unit_rate(s);
  if (s->start.temperature == GG_AUTO || !gg_scene_scales_with_start(s)) return 1;
  return sqrt(2 * s->start.temperature / s->species[0].mass) / s->species[0].diameter;
}

/* From its start in time, instead of means of a steady state. */
static inline bool gg_scene_is_followed(const gg_scene *scene)
{
  return scene->run.duration > 0;
}

/* Amplitude of the wave that a followed gas starts with. */
static inline double gg_scene_wave(const gg_scene *scene)
{
  return gg_scene_is_followed(scene) ? scene->start.wave : 0;
}

/* A scene with every default; flow and phi are still to be given (phi = GG_AUTO marks it missing). */
gg_scene gg_scene_defaults(void);

/* A copy on the heap that holds the extension, until gg_scene_free; NULL: out of memory. */
gg_scene *gg_scene_copy_new(const gg_scene *scene, gg_error *err);

#endif
