/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes, models and comparisons for the tests of theories. */
#ifndef GG_THEORY_TEST_H
#define GG_THEORY_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/model_of_scene.h"
#include "theory/theory.h"
#include "theory/theory_list.h"

/* |a - b| <= tolerance * |b| (absolute where b = 0). */
#define assert_close(a, b, tolerance)                                                                                  \
  do {                                                                                                                 \
    double gg_a = (a), gg_b = (b), gg_scale = gg_b == 0 ? 1 : fabs(gg_b);                                              \
    if (!(fabs(gg_a - gg_b) <= (tolerance)*gg_scale))                                                                  \
      fail_msg("%s = %.17g, not %.17g within %g", #a, gg_a, gg_b, (double)(tolerance));                                \
  } while (0)

static inline gg_scene scene_of(gg_flow flow, double phi, double e, double beta)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow;
  s.phi = phi;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = e, s.collision.beta[p] = beta;
  return s;
}

static inline gg_model model_of(const gg_scene *s)
{
  gg_model m;
  gg_error err;
  if (gg_scene_model_make(s, GG_DSMC, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

static inline gg_model model_for(gg_flow flow, double phi, double e, double beta)
{
  gg_scene s = scene_of(flow, phi, e, beta);
  return model_of(&s);
}

/* Two species: mass ratio m1/m2, diameter ratio d1/d2, n1/n2, one e and beta for all pairs; in units of species 1. */
static inline gg_model mixture_for(gg_flow flow, double phi, double e, double beta, double mass, double size,
                                   double number)
{
  gg_scene s = scene_of(flow, phi, e, beta);
  s.n_species = 2;
  s.species[0] = (gg_species){number / (1 + number), 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){1 / (1 + number), 1 / size, 1 / mass, 0.4, 1, 0};
  s.dsmc.particles = 600000; /* so that fractions in thirds and halves are exact */
  return model_of(&s);
}

static inline gg_theory_answer answer_of(const gg_theory *theory, const gg_model *m)
{
  gg_theory_answer a;
  gg_error err;
  if (gg_theory_evaluate(theory, m, &a, &err) != GG_OK) fail_msg("%s", err.message);
  return a;
}

static inline double value_of(const gg_theory *theory, const gg_model *m, gg_quantity q)
{
  return answer_of(theory, m).value[q];
}

/* The theory must reject the model, with a message that contains `because`. */
static inline void assert_refused(const gg_theory *theory, const gg_model *m, const char *because)
{
  gg_theory_answer a;
  gg_error err = {0};
  assert_int_equal(gg_theory_evaluate(theory, m, &a, &err), GG_BAD_INPUT);
  if (!strstr(err.message, because)) fail_msg("'%s' does not say '%s'", err.message, because);
  for (int q = 0; q < GG_N_QUANTITIES; q++) assert_true(isnan(a.value[q]));
}

#endif
