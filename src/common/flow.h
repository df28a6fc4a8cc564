/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flows there are, a row each, with everything that depends on the flow: its words, its frame, what drives
 * and what warms it, who can run it, what it is known by. A new flow is a name below and its row in flow.c: the scene's
 * words and page, defaults, checks, units, titles, engines' acceptance and headline quantities follow from the row. */
#ifndef GG_FLOW_H
#define GG_FLOW_H

#include <stdbool.h>
#include <stddef.h>

/* New ones at the end: checkpoints hold the number. */
typedef enum gg_flow {
  GG_EQUILIBRIUM,
  GG_USF,
  GG_HCS,
  GG_HSS,
  GG_COUETTE,
  GG_POISEUILLE,
  GG_CHUTE,
  GG_SMALL_SHEAR,
  GG_HEATED_SHEAR,
  GG_FOURIER,
  GG_N_FLOWS
} gg_flow;

/* Names; common/thermostat.c has their rows. */
typedef enum gg_thermostat {
  GG_NO_THERMOSTAT,
  GG_GAUSSIAN,
  GG_WHITE_NOISE,
  GG_BATH,
  GG_INJECTION,
  GG_N_THERMOSTATS
} gg_thermostat;

/* The frame in which the gas is homogeneous or at rest. In all but the first the centre of mass is followed: what
 * rounding leaves of its velocity would grow relative to the thermal speed. */
typedef enum gg_flow_frame {
  GG_LABORATORY,     /* walls hold it, or nothing makes a drift grow */
  GG_CENTRE_OF_MASS, /* heated */
  GG_SHEARED_FRAME,  /* moves with the shear: C = c - rate y x_hat; time in 1/shear_rate */
  GG_COOLING_FRAME   /* velocities decay: they are scaled up again as they do, and the clock with them */
} gg_flow_frame;

typedef enum gg_flow_walls { GG_NO_WALLS, GG_RESTING_WALLS, GG_MOVING_WALLS } gg_flow_walls;   /* at both ends of y */
typedef enum gg_flow_falling { GG_NEVER_FALLS, GG_MAY_FALL, GG_ALWAYS_FALLS } gg_flow_falling; /* gravity acts */

typedef struct gg_flow_row {
  const char *word;  /* in scenes */
  const char *title; /* of results and pictures */
  const char *doc;   /* behind the word, on the scene page */
  const char *state; /* what theories describe or do not: "free cooling" */
  gg_flow_frame frame;
  gg_flow_walls walls;
  gg_flow_falling falling;
  bool may_be_open;     /* the upper wall may be left away */
  bool conserves;       /* collisions must lose no energy */
  bool linear_response; /* shear so slow that it goes to zero (linear_response.h) */
  unsigned thermostats; /* allowed ones, a sum of 1u << gg_thermostat */
  unsigned engines;     /* which can run it, a sum of 1u << gg_engine_kind */
  unsigned measure;     /* what is measured of it in any case, GG_MEASURE_... */
  /* Defaults of keys that depend on the flow (that of collision.e: 1 where energy is conserved). */
  gg_thermostat thermostat;
  double gravity[3];
  double wall_temperature[2]; /* lower, upper; 0: none. A flow that has them lives by them, and needs some */
  /* Headline quantities, whose errors end a run: gg_quantity, ends with
   * GG_N_QUANTITIES. A scene has those that it does not lack (gg_common_quantity_missing). */
  const int *headline, *headline_in_bath; /* the latter NULL: the same */
} gg_flow_row;

extern const gg_flow_row gg_common_flows[GG_N_FLOWS];

static inline const gg_flow_row *gg_flow_of(gg_flow flow)
{
  return &gg_common_flows[flow];
}

static inline bool gg_flow_is_sheared(gg_flow flow)
{
  return gg_flow_of(flow)->frame == GG_SHEARED_FRAME;
}
static inline bool gg_flow_cools(gg_flow flow)
{
  return gg_flow_of(flow)->frame == GG_COOLING_FRAME;
}
static inline bool gg_flow_is_walled(gg_flow flow)
{
  return gg_flow_of(flow)->walls != GG_NO_WALLS;
}
static inline bool gg_flow_has_moving_walls(gg_flow flow)
{
  return gg_flow_of(flow)->walls == GG_MOVING_WALLS;
}
/* True if time is counted in 1/gamma, gamma the shear rate imposed by the box or by walls; else in d/v_0. */
static inline bool gg_flow_is_timed_by_shear(gg_flow flow)
{
  return gg_flow_is_sheared(flow) || gg_flow_has_moving_walls(flow);
}
static inline bool gg_flow_takes(gg_flow flow, gg_thermostat thermostat)
{
  return gg_flow_of(flow)->thermostats >> thermostat & 1;
}
/* The thermostat in force: the one given, or the flow's default where the flow does not take it. */
static inline gg_thermostat gg_flow_thermostat(gg_flow flow, gg_thermostat given)
{
  return gg_flow_takes(flow, given) ? given : gg_flow_of(flow)->thermostat;
}
/* `engine`: a gg_engine_kind. */
static inline bool gg_flow_runs_in(gg_flow flow, int engine)
{
  return gg_flow_of(flow)->engines >> engine & 1;
}
/* Homogeneous, and warm by a thermostat alone. */
static inline bool gg_flow_is_heated(gg_flow flow)
{
  return gg_flow_of(flow)->frame == GG_CENTRE_OF_MASS;
}

/* A set of flows: a sum of these. */
#define GG_FLOW_BIT(flow) (1u << (flow))

/* The words of those for which `test` holds, "couette, poiseuille or chute", cut to `size` bytes. */
void gg_common_flow_list(bool (*test)(gg_flow flow), char *text, size_t size);
/* The same of those that take a thermostat. */
void gg_common_flows_taking(gg_thermostat thermostat, char *text, size_t size);

#endif
