/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories of the user's program (graingas.h, "Extension"): they receive the scene and answer as all others do. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "graingas.h"
#include "theory/theory.h"

gg_status gg_theory_user_theory_add(gg_extension **extension, const gg_theory_definition *t, gg_error *err)
{
  gg_theory *face = gg_base_array_new(1, sizeof *face, err);
  if (!face) return GG_FAILED;
  gg_extension *x = gg_common_extension_with_theory(*extension, t, face, err);
  if (!x) {
    free(face);
    return GG_FAILED;
  }
  const gg_theory_definition *kept = gg_common_extension_theory(x, gg_common_extension_theories(x) - 1);
  *face = (gg_theory){.name = kept->name,
                      .title = kept->title,
                      .citation = kept->citation,
                      .assumptions = kept->assumptions,
                      .own = kept};
  *extension = x;
  return GG_OK;
}

static void describe_species(const gg_model *m, gg_species_facts *species, gg_pair_facts *pairs)
{
  for (int i = 0; i < m->n_species; i++) {
    species[i] = (gg_species_facts){m->fraction[i], m->diameter[i], m->mass[i], m->inertia[i]};
    for (int j = 0; j < m->n_species; j++) {
      int o = gg_pair(i, j);
      pairs[m->n_species * i + j] = (gg_pair_facts){m->e[o], m->beta[o], m->mu[o], m->sigma[o], m->chi[o]};
    }
  }
}

gg_status gg_theory_user_theory_evaluate(const gg_theory_definition *t, const gg_model *m, gg_theory_answer *a,
                                         gg_error *err)
{
  gg_species_facts species[GG_MAX_SPECIES];
  gg_pair_facts pairs[GG_MAX_SPECIES * GG_MAX_SPECIES];
  describe_species(m, species, pairs);
  const gg_facts facts = {.flow = gg_flow_of(m->flow)->word,
                          .thermostat = gg_common_thermostats[gg_flow_thermostat(m->flow, m->thermostat)].word,
                          .restitution_law = m->law.name,
                          .phi = m->phi,
                          .density = m->density,
                          .shear_rate = m->shear_rate,
                          .gravity = {m->gravity[0], m->gravity[1], m->gravity[2]},
                          .box = {m->box[0], m->box[1], m->box[2]},
                          .temperature = m->temperature0,
                          .stress_unit = m->stress_unit,
                          .n_species = m->n_species,
                          .species = species,
                          .pairs = pairs};
  size_t n = (size_t)t->n_quantities;
  double *values = gg_base_array_new(n, sizeof *values, err);
  if (!values) return GG_FAILED;
  for (size_t k = 0; k < n; k++) values[k] = NAN;
  const char *refusal = t->evaluate(t->context, &facts, values);
  for (size_t k = 0; k < n && !refusal; k++) {
    gg_quantity q = gg_common_quantity_find_in(m, t->quantities[k]);
    if (q < GG_MOST_QUANTITIES && isfinite(values[k])) a->value[q] = values[k];
  }
  free(values);
  GG_TRY(gg_base_callback_settle(GG_OK, err));
  return refusal ? gg_base_fail(err, GG_BAD_INPUT, "%s %s", t->name, refusal) : GG_OK;
}
