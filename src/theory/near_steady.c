/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/near_steady.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/linear_response.h"
#include "common/portable_math.h"
#include "theory/theory.h"

/* Linear response: at the beginning of a sweep of the reduced shear rate. */
static void start_of_sweep(gg_model *model)
{
  double speed = 1 / (gg_common_linear_response_of(model).start * gg_common_model_nu0(model, 1));
  model->temperature0 = speed * speed;
}

static gg_status try_theories(gg_model *model, gg_model *constant, gg_error *err)
{
  const char *const best_first[] = {"gaussian_closure", "lun1991"};
  for (int i = 0; i < 2; i++) {
    const gg_theory *theory = gg_theory_find(best_first[i]);
    gg_theory_answer answer;
    gg_error why;
    const unsigned before = gg_base_memory_failures();
    gg_status status = theory ? gg_theory_evaluate(theory, constant, &answer, &why) : GG_BAD_INPUT;
    if (gg_base_memory_failures() != before) return gg_base_out_of_memory_for(err, "%s", best_first[i]);
    if (status == GG_INTERRUPTED) return gg_base_fail(err, status, "%s", why.message);
    if (status != GG_OK) continue;
    double T = answer.value[GG_Q_TEMPERATURE], ratio = answer.value[GG_Q_TEMPERATURE_RATIO];
    if (!(T > 0)) continue;
    model->temperature0 = gg_agreed(T, GG_AGREED_SOLUTION);
    if (ratio > 0) model->ratio0 = gg_agreed(ratio, GG_AGREED_SOLUTION);
    return GG_OK;
  }
  return GG_OK;
}

/* With at most so many species theories take milliseconds. They are then not interrupted, so that a run that is stopped
 * at once still has its initial temperature. */
enum { FEW = 2 };

/* Theories know constant coefficients alone: for a law, its value at the mean impact speed. */
static gg_status start_at_theory(gg_model *model, gg_error *err)
{
  gg_model *constant = gg_base_array_new(1, sizeof *constant, err);
  if (!constant) return GG_FAILED;
  *constant = *model;
  constant->law = (gg_restitution_law){0};
  memset(&constant->by_speed, 0, sizeof constant->by_speed);
  constant->kicks = constant->turns = false;
  if (model->n_species <= FEW) constant->stop = NULL;
  gg_status status = try_theories(model, constant, err);
  free(constant);
  return status;
}

/* With a law, temperature and mean impact speed depend on each other: a few iterations. */
gg_status gg_theory_start_near_steady(gg_model *model, gg_error *err)
{
  if (model->linear_response) start_of_sweep(model);
  if (!model->steady || !gg_model_is_sheared(model)) return GG_OK;
  for (int round = 0; round < (model->law.name ? 5 : 1); round++) {
    GG_TRY(start_at_theory(model, err));
    gg_common_model_at(model, model->temperature0);
  }
  return GG_OK;
}
