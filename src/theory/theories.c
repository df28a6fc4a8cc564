/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "theory/answer.h"
#include "theory/theory_list.h"
#include "theory/walls/gap.h"

#define ENTRY(name) &gg_theory_##name,
const gg_theory *const gg_theory_theories[] = {GG_THEORIES(ENTRY) NULL};

const gg_theory *gg_theory_find(const char *name)
{
  for (const gg_theory *const *t = gg_theory_theories; *t; t++)
    if (strcmp((*t)->name, name) == 0) return *t;
  return NULL;
}

const gg_theory *gg_theory_of(const gg_model *model, int index)
{
  const int shared = (int)(sizeof gg_theory_theories / sizeof *gg_theory_theories) - 1;
  return index < shared ? gg_theory_theories[index] : gg_common_extension_face(model->extension, index - shared);
}

const char *gg_theory_beyond(const gg_theory *theory, const gg_model *model)
{
  return theory->beyond ? theory->beyond(model) : NULL;
}

/* "free cooling or uniform shear" */
static void list_states(unsigned flows, char *text, size_t size)
{
  size_t used = 0;
  for (int f = 0; f < GG_N_FLOWS && used < size; f++) {
    if (!(flows & GG_FLOW_BIT(f))) continue;
    flows &= ~GG_FLOW_BIT(f);
    const char *after = !flows ? "" : flows & (flows - 1) ? ", " : " or ";
    used += (size_t)snprintf(text + used, size - used, "%s%s", gg_common_flows[f].state, after);
  }
}

static gg_status check_flow(const gg_theory *theory, const gg_model *m, gg_error *err)
{
  char states[320];
  if (gg_model_is_sheared(m) && !(m->shear_rate > 0))
    return gg_theory_reject(err, theory->name, "describes steady shear; at the end of this run the rate is %s",
                            m->shear_rate < 0 ? "below 0" : "0, or it changes all the time");
  if (!theory->flows || (theory->flows & GG_FLOW_BIT(m->flow))) return GG_OK;
  list_states(theory->flows, states, sizeof states);
  return gg_theory_reject(err, theory->name, "describes %s; this scene is %s", states, gg_flow_of(m->flow)->state);
}

static gg_status check_bath(const gg_theory *theory, const gg_model *m, gg_error *err)
{
  if (!m->bath.on || theory->baths || theory->own) return GG_OK;
  return gg_theory_reject(err, theory->name, "has no bath, nor heating of a given strength; this scene has");
}

static gg_status check_collisions(const gg_theory *theory, const gg_model *model, gg_error *err)
{
  if (theory->own) return GG_OK;
  if (model->kicks || model->turns)
    return gg_theory_reject(err, theory->name, "does not describe %s, which this scene has",
                            model->kicks ? "kicks at contact" : "torques");
  const bool by_speed = gg_speed_laws_any(&model->by_speed, gg_pairs_of(model->n_species));
  if (!model->law.name || (by_speed && theory->by_speed)) return GG_OK;
  if (by_speed)
    return gg_theory_reject(err, theory->name,
                            "describes constant coefficients; in this scene %.*s depends on the speed",
                            (int)strcspn(model->law.name, "("), model->law.name);
  return gg_base_fail(err, GG_BAD_INPUT, "%s describes grains of constant e; this scene has the restitution law '%s'",
                      theory->name, model->law.name);
}

static void clear(gg_theory_answer *answer)
{
  answer->remark[0] = '\0';
  for (int q = 0; q < GG_MOST_QUANTITIES; q++) answer->value[q] = answer->error[q] = NAN;
}

/* An interrupted theory has no answer, even if parts of it are done. */
static gg_status finish(const gg_theory *theory, const gg_model *model, gg_status status, gg_error *err)
{
  if (!gg_stop_asked(model->stop)) return status;
  return gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted", theory->name);
}

/* Results of one call of a theory: answers, curves or both; NULL: without these. */
typedef struct request {
  gg_theory_answer *answer;
  gg_curves *list;
  unsigned measure;
} request;

static gg_status run(const gg_theory *theory, const gg_model *model, request r, gg_error *err)
{
  if (theory->gap) return gg_theory_gap_answer(theory->gap, model, r.answer, r.measure, r.list, err);
  if (r.list) return theory->curves(model, r.measure, r.list, err);
  return theory->own ? gg_theory_user_theory_evaluate(theory->own, model, r.answer, err)
                     : theory->evaluate(model, r.answer, err);
}

static gg_status checked(const gg_theory *theory, const gg_model *model, request r, gg_error *err)
{
  GG_TRY(check_collisions(theory, model, err));
  GG_TRY(check_flow(theory, model, err));
  GG_TRY(check_bath(theory, model, err));
  const unsigned before = gg_base_memory_failures();
  gg_base_gsl_enter();
  gg_status status = run(theory, model, r, err);
  gg_base_gsl_leave();
  status = finish(theory, model, status, err);
  const char *beyond = r.answer && status == GG_OK && !*r.answer->remark ? gg_theory_beyond(theory, model) : NULL;
  if (beyond) snprintf(r.answer->remark, sizeof r.answer->remark, "%s", beyond);
  return gg_base_memory_failures() != before ? gg_base_out_of_memory(err) : status;
}

static gg_status answers(const gg_theory *theory, const gg_model *model, request r, gg_error *err)
{
  if (r.answer) clear(r.answer);
  if (r.list) *r.list = (gg_curves){.model = model};
  if (r.list && !theory->curves && !theory->gap) return GG_OK;
  const gg_status status = checked(theory, model, r, err);
  if (r.answer && status == GG_INTERRUPTED) clear(r.answer);
  for (int q = 0; r.answer && q < GG_MOST_QUANTITIES; q++) r.answer->value[q] += 0.0; /* no -0 */
  if (r.list) r.list->group = NULL;                                                   /* every curve has its own copy */
  if (r.list && status != GG_OK) gg_measure_curves_clear(r.list);
  return status;
}

gg_status gg_theory_evaluate(const gg_theory *theory, const gg_model *model, gg_theory_answer *answer, gg_error *err)
{
  return answers(theory, model, (request){.answer = answer}, err);
}

gg_status gg_theory_curves(const gg_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                           gg_error *err)
{
  return answers(theory, model, (request){.list = list, .measure = measure}, err);
}

gg_status gg_theory_evaluate_gap(const gg_theory *theory, const gg_model *model, unsigned measure,
                                 gg_theory_answer *answer, gg_curves *list, gg_error *err)
{
  return answers(theory, model, (request){answer, list, measure}, err);
}

gg_status gg_theory_fluxes(const gg_theory *theory, const gg_model *model, size_t n, const gg_local_state *state,
                           gg_local_fluxes *fluxes, gg_error *err)
{
  if (!theory->gap || !theory->gap->gas_of)
    return gg_theory_reject(err, theory->name,
                            "gives no fluxes at single heights; navier_stokes, navier_stokes_hermite and moments do");
  GG_TRY(check_collisions(theory, model, err));
  GG_TRY(check_flow(theory, model, err));
  GG_TRY(check_bath(theory, model, err));
  const unsigned before = gg_base_memory_failures();
  gg_base_gsl_enter();
  const gg_status status = gg_theory_gap_fluxes(theory->gap, model, n, state, fluxes, err);
  gg_base_gsl_leave();
  if (gg_base_memory_failures() != before) return gg_base_out_of_memory(err);
  return finish(theory, model, status, err);
}

/* Enskog's equation solved without random numbers: quadratures over pairs of species, of which shear has the more; the
 * viscosity of mixtures up to six species. All others are formulas, or small equations. */
double gg_theory_seconds(const gg_model *m)
{
  enum { MOST_SHEARED = 8, MOST_VISCOUS = 6 };
  const double formulas = 0.02, n = m->n_species;
  const bool sheared = m->flow == GG_USF || m->flow == GG_HEATED_SHEAR;
  if (!(gg_theory_enskog_hermite.flows & GG_FLOW_BIT(m->flow)) || m->law.name) return formulas;
  if (m->rule == GG_ROUGH && n == 1) return 0.9;
  if (m->rule != GG_SMOOTH || (sheared && n > MOST_SHEARED)) return formulas;
  if (sheared) return 1.5 * pow(n, 1.5);
  return n > MOST_VISCOUS ? 1 : 0.5 + 0.4 * n * n;
}
