/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formulas of a theory that use each other: names, order of evaluation, cycles. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/printable.h"
#include "base/text.h"
#include "common/quantity.h"
#include "theory/formula.h"

enum { NEW, OPEN, DONE };

typedef struct formula_reader {
  int n;
  const char *const *name, *const *text;
  gg_formula_theory *theory;
  int state[GG_THEORY_FORMULAS], n_ordered; /* of the search in depth */
  int path[GG_THEORY_FORMULAS], depth;      /* formulas that are open, each uses the next */
  bool is_used[GG_THEORY_FORMULAS];         /* by another formula */
  int *failed;
  gg_error *err;
} formula_reader;

static bool is_parameter(const char *name)
{
  for (int k = 0; gg_theory_parameters[k]; k++)
    if (strcmp(gg_theory_parameters[k], name) == 0) return true;
  return false;
}

static gg_status check_name(const formula_reader *r, int index)
{
  const char *name = r->name[index];
  *r->failed = index;
  if (!gg_base_text_is_name(name, 40))
    return gg_base_fail(r->err, GG_BAD_INPUT,
                        "'%.60s' is not a valid name: use a letter, then letters, digits and _, at most 40", name);
  if (is_parameter(name) || gg_common_expression_knows(name))
    return gg_base_fail(r->err, GG_BAD_INPUT, "the name '%s' is taken: it is a %s of formulas", name,
                        is_parameter(name) ? "parameter" : "word");
  for (int k = 0; k < index; k++)
    if (strcmp(r->name[k], name) == 0)
      return gg_base_fail(r->err, GG_BAD_INPUT, "the %s '%s' is given twice",
                          gg_common_quantity_find(name) == GG_N_QUANTITIES ? "name" : "quantity", name);
  return GG_OK;
}

/* Report a cycle: the open formulas from `index` on, and `index` again. */
static gg_status reject_cycle(const formula_reader *r, int index)
{
  char path[400] = "";
  int k = 0;
  while (r->path[k] != index) k++;
  for (; k < r->depth; k++) gg_base_text_append(path, sizeof path, "%s uses ", r->name[r->path[k]]);
  *r->failed = index;
  return gg_base_fail(r->err, GG_BAD_INPUT, "the formula of '%s' depends on itself: %s%s", r->name[index], path,
                      r->name[index]);
}

/* Put the formula behind all that it uses. */
static gg_status order(formula_reader *r, int index)
{
  const gg_expression *e = &r->theory->of[index];
  if (r->state[index] == OPEN) return reject_cycle(r, index);
  if (r->state[index] == DONE) return GG_OK;
  r->state[index] = OPEN;
  r->path[r->depth++] = index;
  for (int i = 0; i < e->n; i++) {
    const int used = e->step[i].code == 'p' ? (int)e->step[i].number - GG_THEORY_PARAMETERS : -1;
    if (used < 0) continue;
    r->is_used[used] = true;
    GG_TRY(order(r, used));
  }
  r->depth--;
  r->state[index] = DONE;
  r->theory->order[r->n_ordered++] = index;
  return GG_OK;
}

static gg_status parse(const formula_reader *r)
{
  const char *variable[GG_THEORY_PARAMETERS + GG_THEORY_FORMULAS + 1] = {NULL};
  memcpy(variable, gg_theory_parameters, GG_THEORY_PARAMETERS * sizeof *variable);
  for (int k = 0; k < r->n; k++) {
    GG_TRY(check_name(r, k));
    variable[GG_THEORY_PARAMETERS + k] = r->name[k];
  }
  for (int k = 0; k < r->n; k++) {
    *r->failed = k;
    GG_TRY(gg_common_expression_parse(&r->theory->of[k], r->text[k], variable, r->err));
  }
  return GG_OK;
}

static gg_status read_all(formula_reader *r, const char **quantity)
{
  gg_formula_theory *t = r->theory;
  GG_TRY(parse(r));
  for (int k = 0; k < r->n; k++) GG_TRY(order(r, k));
  for (int k = 0; k < r->n; k++) {
    if (r->is_used[k] && gg_common_quantity_find(r->name[k]) == GG_N_QUANTITIES) continue;
    quantity[t->n_quantities] = r->name[k];
    t->answer[t->n_quantities++] = k;
  }
  return GG_OK;
}

gg_status gg_theory_formulas_read(int n, const char *const *name, const char *const *text, gg_formula_theory **theory,
                                  const char **quantity, int *failed, gg_error *err)
{
  formula_reader r = {.n = n, .name = name, .text = text, .failed = failed, .err = err};
  *failed = 0;
  r.theory = gg_base_array_new(1, sizeof *r.theory + (size_t)n * sizeof(gg_expression), err);
  if (!r.theory) return GG_FAILED;
  r.theory->n = n;
  const gg_status status = read_all(&r, quantity);
  if (status == GG_OK)
    *theory = r.theory;
  else
    free(r.theory);
  return status;
}
