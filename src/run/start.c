#include "run/start.h"

#include <math.h>

#include "common/small_shear.h"
#include "theory/theory.h"

/* Linear response: at the beginning of a sweep of the reduced shear rate. */
static void start_of_sweep(gg_model *model)
{
  double speed = 1 / (gg_small_shear_of(model).start * gg_model_nu0(model, 1));
  model->temperature0 = speed * speed;
}

void gg_start_near_steady(gg_model *model)
{
  if (model->small_shear) start_of_sweep(model);
  if (!model->steady || model->shear_rate == 0) return;
  const char *const best_first[] = {"gaussian_closure", "lun1991"};
  for (int i = 0; i < 2; i++) {
    const gg_theory *theory = gg_theory_find(best_first[i]);
    gg_theory_answer answer;
    if (!theory || gg_theory_evaluate(theory, model, &answer, NULL) != GG_OK) continue;
    double T = answer.value[GG_Q_TEMPERATURE], ratio = answer.value[GG_Q_TEMPERATURE_RATIO];
    if (!(T > 0)) continue;
    model->temperature0 = T;
    if (ratio > 0) model->ratio0 = ratio;
    return;
  }
}
