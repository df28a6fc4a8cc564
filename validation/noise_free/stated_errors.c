/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Are the stated numerical errors of enskog_hermite honest? Random scenes of uniform shear, phi from 0 to 0.5 (a fifth
 * of them at 0) and e from 0.3 to 0.99, each answer beside the same expansion at degree 16: stated_errors [--scenes N]
 * prints, for each scene, the true error of T, P_xy, N1 and N2 over the stated one, and how many exceed it. Exit code
 * 0; 1 where more than a twentieth of the answers err by more than they state; 2: the command line is wrong. */
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference.h"
#include "theory/theory_list.h"
#include "scene/model_of_scene.h"

enum { REFERENCE_DEGREE = 16 };

static bool model_at(double phi, double e, gg_model *m)
{
  gg_scene s = gg_scene_defaults();
  gg_error err;
  s.flow = GG_USF, s.phi = phi;
  s.collision.e[0] = e, s.collision.beta[0] = -1;
  return gg_scene_model_make(&s, GG_DSMC, m, &err) == GG_OK;
}

typedef struct tally {
  int answers, exceed, refused, without_reference;
} tally;

static void look_at(double phi, double e, tally *t)
{
  gg_model m;
  gg_theory_answer a;
  gg_error err;
  double number[GG_REFERENCE_NUMBERS];
  if (!model_at(phi, e, &m)) return;
  if (gg_theory_evaluate(&gg_theory_enskog_hermite, &m, &a, &err) != GG_OK) {
    t->refused++;
    printf("%.5f %.4f  %s\n", phi, e, err.message);
    return;
  }
  if (!gg_reference_shear(&m, REFERENCE_DEGREE, number)) {
    t->without_reference++;
    printf("%.5f %.4f  no reference\n", phi, e);
    return;
  }
  printf("%.5f %.4f ", phi, e);
  for (int q = 0; q < GG_REFERENCE_NUMBERS; q++) {
    double stated = a.error[gg_reference_quantity[q]],
           share = fabs(a.value[gg_reference_quantity[q]] - number[q]) / stated;
    t->answers++;
    if (share > 1) t->exceed++;
    printf("  %.7g %.1e %.2f", a.value[gg_reference_quantity[q]], stated, share);
  }
  printf("\n");
  fflush(stdout);
}

int main(int argc, char **argv)
{
  int scenes = argc == 3 && strcmp(argv[1], "--scenes") == 0 ? atoi(argv[2]) : argc == 1 ? 200 : 0;
  if (scenes < 1) {
    fprintf(stderr, "stated_errors [--scenes N]\n");
    return 2;
  }
  tally t = {0};
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
  printf("# phi e, then T, P_xy, N1, N2: value, stated error, true error over stated\n");
  for (int k = 0; k < scenes; k++) {
    double phi = gsl_rng_uniform(random) < 0.2 ? 0 : 0.5 * gsl_rng_uniform(random);
    look_at(phi, 0.3 + 0.69 * gsl_rng_uniform(random), &t);
  }
  gsl_rng_free(random);
  printf("# %d answers in %d scenes: %d err by more than they state; %d scenes refused, %d without reference\n",
         t.answers, scenes, t.exceed, t.refused, t.without_reference);
  return 20 * t.exceed > t.answers;
}
