/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories: one file each. All answer under the shared names, in the units of the model. */
#ifndef GG_THEORY_H
#define GG_THEORY_H

#include "common/quantity.h"
#include "measure/curve.h"
#include "theory/local_state.h" /* made of the public header (src/theory/meson.build) */

enum { GG_THEORY_REMARK = 480 };

/* Answers of a theory: NaN where it has none. `error`: distance of a number from the solution of the theory's
 * equations, where these are solved numerically; else NaN. */
typedef struct gg_theory_answer {
  double value[GG_MOST_QUANTITIES];
  double error[GG_MOST_QUANTITIES];
  char remark[GG_THEORY_REMARK]; /* why the model is outside the theory's range, though it answers; "" within */
} gg_theory_answer;

/* Names of quantities, separated by blanks, for `answers`. */
#define GG_ANSWERS_STRESS "P_xx P_yy P_zz P_xy P_yx P_xx_kinetic P_yy_kinetic P_zz_kinetic P_xy_kinetic P_yx_kinetic "
#define GG_ANSWERS_TRANSFER "P_xx_collisional P_yy_collisional P_zz_collisional P_xy_collisional P_yx_collisional "
#define GG_ANSWERS_RATES "collision_rate mean_free_path knudsen "
#define GG_ANSWERS_KURTOSES "kurtosis_Cx kurtosis_Cy kurtosis_Cz "
#define GG_ANSWERS_VISCOSITY "viscosity_reduced viscosity_reduced_kinetic "
#define GG_ANSWERS_HEAT                                                                                                \
  "thermal_conductivity_reduced thermal_conductivity_reduced_kinetic diffusive_heat_conductivity_reduced "
#define GG_ANSWERS_EXPANSION "bulk_viscosity_reduced cooling_rate_transport "
#define GG_ANSWERS_LENGTHS "clustering_length heat_mode_length "
#define GG_ANSWERS_MIXTURE "temperature_1 temperature_2 partial_temperature_ratio "

typedef struct gg_theory {
  const char *name;        /* "lun1991": the JSON key */
  const char *title;       /* one line for people */
  const char *citation;    /* the original paper */
  const char *assumptions; /* and range, one or two sentences */
  unsigned flows;          /* the flows that it describes, a sum of GG_FLOW_BIT; 0: it checks by itself */
  bool baths;              /* it describes gases in a bath, too */
  bool by_speed;           /* coefficients that depend on the normal speed, too */
  /* For those flows alone: GG_OK with the answer, or GG_BAD_INPUT with the reason why the theory does not apply to
   * this model. A theory that takes longer than a tenth of a second checks model->stop between its parts, and then
   * fails. */
  gg_status (*evaluate)(const gg_model *model, gg_theory_answer *answer, gg_error *err);
  /* The remark of answers without one of their own; NULL (also the function) within the range. */
  const char *(*beyond)(const gg_model *model);
  /* Curves, under the names and at the abscissae of those of the observables in `measure` (GG_MEASURE_...); the
   * error of a point is its distance from the solution of the theory's equations. Only for models for which
   * `evaluate` answers. GG_OK also without any of these; GG_BAD_INPUT with the reason if this model has none. NULL:
   * no curves. */
  gg_status (*curves)(const gg_model *model, unsigned measure, gg_curves *list, gg_error *err);
  /* A flow between walls (walls/gap.h), which replaces evaluate and curves; else NULL. */
  const struct gg_gap_theory *gap;
  /* A theory of the user's program (user_theory.c), which replaces evaluate and beyond; else NULL. */
  const gg_theory_definition *own;
  const char
      *answers; /* names of the quantities that it may answer, separated by blanks; for families of two species */
} gg_theory;

/* All theories (theory_list.h), NULL-terminated, in the order of tables. */
extern const gg_theory *const gg_theory_theories[];
const gg_theory *gg_theory_find(const char *name);

/* Theories of a model: all of the above, then those of the scene. NULL beyond the last. */
const gg_theory *gg_theory_of(const gg_model *model, int index);

/* user_theory.c: add a theory of the user's program before those of the scene. */
gg_status gg_theory_user_theory_add(gg_extension **extension, const gg_theory_definition *definition, gg_error *err);
gg_status gg_theory_user_theory_evaluate(const gg_theory_definition *theory, const gg_model *model,
                                         gg_theory_answer *answer, gg_error *err);

/* The reason from `beyond`, NULL if there is none. */
const char *gg_theory_beyond(const gg_theory *theory, const gg_model *model);

/* Evaluate with every value preset to NaN. GG_INTERRUPTED, without answers, after a stop. */
gg_status gg_theory_evaluate(const gg_theory *theory, const gg_model *model, gg_theory_answer *answer, gg_error *err);

/* The curves of a theory, if it has some, for a model that it describes; none after a failure. To be cleared. */
gg_status gg_theory_curves(const gg_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                           gg_error *err);

/* Answer and curves from one solution, of a theory that has its gap. */
gg_status gg_theory_evaluate_gap(const gg_theory *theory, const gg_model *model, unsigned measure,
                                 gg_theory_answer *answer, gg_curves *list, gg_error *err);

/* Stress and heat flux of n given states of a gas between walls; NaN where the theory has none. GG_BAD_INPUT from one
 * without a gap. */
gg_status gg_theory_fluxes(const gg_theory *theory, const gg_model *model, size_t n, const gg_local_state *state,
                           gg_local_fluxes *fluxes, gg_error *err);

#endif
