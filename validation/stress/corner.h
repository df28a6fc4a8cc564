/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A corner: a scene at the end of what keys allow. The suite runs it on both engines, which compute it correctly or
 * reject it with the reason. A new corner is a new row of the table in corners.c. */
#ifndef STRESS_CORNER_H
#define STRESS_CORNER_H

#include <stdbool.h>
#include <stddef.h>

#include "api/simulation.h"

/* Value of `md` or `dsmc`: the suite does not run the corner on this engine. */
#define NOT_RUN ""

/* QUICK: `stress --quick` and all other runs. NIGHTLY: other runs. ONLY_BY_NAME: runs if named, as it takes minutes. */
typedef enum selection { QUICK, NIGHTLY, ONLY_BY_NAME } selection;

typedef struct corner {
  const char *subject;   /* title of a section of the table, all other members zero; NULL: a corner */
  const char *name;      /* NULL without a subject: end of the table */
  const char *scene;     /* YAML without `engine`; dsmc has as many grains as md unless the scene sets another number */
  const char *refused;   /* part of the message with which both engines reject the scene; NULL: they must run it */
  const char *md, *dsmc; /* part of the message with which this engine alone rejects it; or NOT_RUN */
  double collisions;     /* per grain; 0: 60 */
  double cools;          /* factor by which T must have changed at the end: 1e-12, 1e12; 0: not tested */
  const char *agrees; /* quantity whose means must agree within four combined errors: of both engines and, where it can
                       * be solved, of Enskog's equation; NULL: no comparison */
  const char *apart; /* with `agrees`: why md solves another problem, so that only dsmc is compared with the solution */
  void (*start)(gg_simulation *simulation); /* changes the initial state; NULL: the engine's */
  selection when;
} corner;

/* corners.c */
extern const corner corners[];

/* Result of one corner on one engine. */
typedef struct finding {
  bool refused, ended; /* the scene was rejected; the engine stopped with an error */
  char reason[1024];
  double collisions; /* total number */
  double overlap;    /* largest, in contact distances; NAN without positions */
  double allowed_overlap;
  size_t escapes;
  double momentum, energy, rule; /* see sample.h, budget.h */
  double drift;                  /* relative change of the energy over the run if it is conserved; part of `energy` */
  double energy_allowed, momentum_allowed;
  bool monotone, numbers;         /* time and collisions never fell, and time grew; all numbers were finite */
  double cooled;                  /* T at the end over T at the start */
  int same_pairs, compared_pairs; /* md: number of first collisions equal to the reference path's, of those compared */
  double z, departure;            /* md - dsmc; engine - solution, in combined errors; NAN: not known */
  double seconds;
} finding;

/* Run the corner on one engine. An error of the suite itself (memory, a scene that does not parse) is in `reason`. */
void corner_run(const corner *c, const char *engine, finding *f);
/* Description of the first failed check, in `text`; NULL if all passed. */
const char *corner_wrong(const corner *c, const char *engine, const finding *f, char text[256]);

/* plain.c: compare the first collisions with those of the reference path. */
void corner_compare_plain(const gg_scene *scene, finding *f);
/* z_scores.c: compare means of both engines and the solved equation; of one engine if the other rejects the scene. */
void corner_compare_means(const corner *c, finding *md, finding *dsmc);

#endif
