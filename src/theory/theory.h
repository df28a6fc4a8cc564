/* Theories: one file each, all answering under the shared names and in the units of the model. */
#ifndef GG_THEORY_H
#define GG_THEORY_H

#include "common/quantity.h"

/* What a theory says: NaN where it has no answer. */
typedef struct gg_theory_answer {
  double value[GG_N_QUANTITIES];
} gg_theory_answer;

typedef struct gg_theory {
  const char *name;        /* "lun1991": the JSON key */
  const char *title;       /* one line for people */
  const char *citation;    /* the original paper */
  const char *assumptions; /* and range, one or two sentences */
  /* GG_OK with the answer, or GG_BAD_INPUT with the reason why the theory does not apply to this model. */
  gg_status (*evaluate)(const gg_model *model, gg_theory_answer *answer, gg_error *err);
  /* Why this model is beyond what the theory was made for, though it answers; NULL (also the function) within it. */
  const char *(*beyond)(const gg_model *model);
} gg_theory;

/* Every theory there is, NULL-terminated, in the order they are shown. */
extern const gg_theory *const gg_theories[];
const gg_theory *gg_theory_find(const char *name);

/* What of the above applies, NULL if nothing does. */
const char *gg_theory_beyond(const gg_theory *theory, const gg_model *model);

/* Evaluate with every value preset to NaN. */
gg_status gg_theory_evaluate(const gg_theory *theory, const gg_model *model, gg_theory_answer *answer, gg_error *err);

#endif
