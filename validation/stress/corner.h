/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A corner: a scene at the end of what keys allow. The suite runs it on both engines, which compute it correctly or
 * reject it with the reason. A new corner is a new row of the table in corners.c. */
#ifndef STRESS_CORNER_H
#define STRESS_CORNER_H

#include <stdbool.h>
#include <stddef.h>

#include "api/simulation.h"

/* In place of a reason: this engine does not run the corner. */
#define NOT_RUN ""

/* QUICK: part of `stress --quick`. NIGHTLY: all other runs. ONLY_BY_NAME: takes minutes, runs if it is named. */
typedef enum selection { QUICK, NIGHTLY, ONLY_BY_NAME } selection;

typedef struct corner {
  const char *subject;   /* begins a section of the table, all else is zero; NULL: a corner */
  const char *name;      /* NULL without a subject: end of the table */
  const char *scene;     /* YAML; `engine` is filled in, and dsmc gets as many grains as md unless it says otherwise */
  const char *refused;   /* part of the reason for which both engines refuse it; NULL: they run it, and are right */
  const char *md, *dsmc; /* the same of one of them; or NOT_RUN */
  double collisions;     /* a grain; 0: 60 */
  double cools;          /* factor by which T must have changed at the end: 1e-12, 1e12; 0: not asked */
  const char *agrees; /* a quantity whose means of both engines, and of Enskog's equation solved where it can be, must
                       * agree in a comparison (four combined errors); NULL: none is made */
  const char *apart;  /* with `agrees`: why md is another problem, so that only dsmc is held against the solution */
  void (*start)(gg_simulation *simulation); /* puts the grains elsewhere first; NULL: as they are */
  selection when;
} corner;

/* corners.c */
extern const corner corners[];

/* Result of one corner on one engine. */
typedef struct finding {
  bool refused, ended; /* the scene was refused; or the engine gave up on the way */
  char reason[1024];
  double collisions; /* in all */
  double overlap;    /* worst, in contact distances; NAN where there are no places */
  double allowed_overlap;
  size_t escapes;
  double momentum, energy, rule; /* see sample.h, budget.h */
  double drift;                  /* of the energy that nothing changes, over the whole course; in `energy`, too */
  double energy_allowed, momentum_allowed;
  bool monotone, numbers;         /* time and collisions never fell, and time got on; no number was NaN or infinite */
  double cooled;                  /* T at the end over T at the start */
  int same_pairs, compared_pairs; /* md: first collisions that are those of the reference path; of so many */
  double z, departure;            /* md - dsmc; engine - solution, in combined errors; NAN: not known */
  double seconds;
} finding;

/* Run it. false: out of memory or the suite itself is wrong (scene that does not parse ...), told in `reason`. */
void corner_run(const corner *c, const char *engine, finding *f);
/* NULL: as it should be; else what is wrong. */
const char *corner_wrong(const corner *c, const char *engine, const finding *f, char text[256]);

/* plain.c: the first collisions beside those of the reference path. */
void corner_compare_plain(const gg_scene *scene, finding *f);
/* z_scores.c: a comparison of both engines and the solved equation; of each engine alone where the other refuses. */
void corner_compare_means(const corner *c, finding *md, finding *dsmc);

#endif
