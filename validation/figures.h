/* The figures of Montanero's review of granular mixtures (Enskog Monte Carlo against first-Sonine theory), as tables of
 * the points that are simulated anew. */
#ifndef GG_FIGURES_H
#define GG_FIGURES_H

#include "run/run.h"

typedef struct gg_point {
  double mass_ratio, size_ratio, mole_ratio; /* mu = m1/m2, omega = sigma1/sigma2, delta = n1/n2; mu = 0: one species */
  double e, phi;
  bool cooling; /* viscosity of the cooling state, not the heated one */
} gg_point;

typedef enum gg_subject { GG_CUMULANTS, GG_PARTIAL_TEMPERATURES, GG_VISCOSITY } gg_subject;

typedef struct gg_figure {
  const char *number, *title;
  gg_subject subject;
  const gg_point *points;
  int n;
} gg_figure;

extern const gg_figure gg_figures[]; /* ends with number NULL */

/* The scene of a point. */
gg_scene gg_figure_scene(gg_subject subject, const gg_point *point);

#endif
