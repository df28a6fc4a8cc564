/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles of theories between walls, and their numbers. */
#ifndef GG_WALLS_TEST_H
#define GG_WALLS_TEST_H

#include "theory_test.h"

static gg_curves curves_of(const gg_theory *theory, const gg_model *m)
{
  gg_curves list;
  gg_error err;
  if (gg_theory_curves(theory, m, GG_MEASURE_PROFILES | GG_MEASURE_FLUXES, &list, &err) != GG_OK)
    fail_msg("%s", err.message);
  return list;
}

static const gg_curve *find(const gg_curves *list, const char *name)
{
  for (int i = 0; i < list->n; i++)
    if (strcmp(list->curve[i].name, name) == 0) return &list->curve[i];
  fail_msg("no curve %s", name);
  return NULL;
}

static double number_of(const gg_curves *list, const char *curve, const char *name)
{
  const gg_curve *c = find(list, curve);
  for (int i = 0; i < c->n_numbers; i++)
    if (strcmp(c->number[i].name, name) == 0) return c->number[i].value;
  fail_msg("%s has no number %s", curve, name);
  return NAN;
}

#endif
