/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A surface that grains bounce off: what engine, sums, profiles and files know of a wall. The model holds a list of
 * them (common/model.h), made by surfaces.c, and shapes.h lists the functions of a shape.
 *
 * Surfaces bound the gas across y at least: there is no period along y where a model has any. */
#ifndef GG_SURFACE_H
#define GG_SURFACE_H

#include "common/collision.h"
#include "common/species.h"
#include "common/vec.h"

enum { GG_MOST_SURFACES = 6 };

/* Lengths, speeds and masses in the model's units. */
typedef struct gg_surface {
  const char *word;  /* in tables and files: "lower", as in wall_P_yy_lower */
  const char *title; /* in text: "a wall below" */
  int shape;         /* GG_SHAPE_... (shapes.h) */
  int axis;          /* it lies across this axis, from 0 ... */
  double side;     /* ... at the gas's upper (1) or lower (-1) end of it: the grain's way into it is side e_axis ... */
  double place;    /* ... and begins there */
  double radius;   /* of curved shapes */
  gg_vec velocity; /* of the material */
  double temperature;                 /* of a thermal wall (collide.h), */
  double accommodation;               /* and the share of contacts that it rules; 0: none */
  gg_contact contact[GG_MAX_SPECIES]; /* grain (1) against the surface (2) */
  gg_contact treated[GG_MAX_SPECIES]; /* the same with e = 1, for the contact-time rule */
} gg_surface;

/* The walls at both ends of y, in the model's units. */
typedef struct gg_walls {
  double e, beta, mu;
  double speed;          /* of the upper wall along x; the lower one moves the other way */
  double temperature[2]; /* lower, upper; GG_AUTO: none */
  double accommodation;  /* fraction of contacts that leave with it */
  double ridges;         /* number of half cylinders side by side along x, whole; 0: flat */
  bool open_top;         /* no upper wall */
} gg_walls;

/* A grain in flight: centre, velocity, acceleration. */
typedef struct gg_flight {
  const gg_vec *r, *v, *g;
  double radius;
} gg_flight;

/* A box in space. */
typedef struct gg_region {
  double from[3], to[3];
} gg_region;

#endif
