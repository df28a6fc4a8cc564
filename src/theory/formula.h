/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories written in a scene: formulas of its parameters, or a table of points. */
#ifndef GG_THEORY_FORMULA_H
#define GG_THEORY_FORMULA_H

#include "common/expression.h"

typedef struct gg_facts gg_facts; /* of the public header */

/* Parameters of formulas and columns of tables; ends with NULL. Names without an index are those of species 1: e,
 * beta, mu, chi, K; a mixture of two also has e_12, e_22, x_1, x_2 and so on. */
extern const char *const gg_theory_parameters[];
enum { GG_THEORY_PARAMETERS = 27 };

enum { GG_THEORY_FORMULAS = 64 };

/* A theory as the context of its definition: one allocation, from malloc. Formulas read parameters and the values of
 * other formulas, whose index follows those of the parameters. */
typedef struct gg_formula_theory {
  int n, order[GG_THEORY_FORMULAS];             /* formulas; their order of evaluation */
  int n_quantities, answer[GG_THEORY_FORMULAS]; /* the formula of each quantity; the others are intermediate values */
  gg_expression of[];
} gg_formula_theory;

/* Read `n` formulas, up to GG_THEORY_FORMULAS, in any order. A name that is no quantity and that another formula uses
 * is an intermediate value. `quantity` gets the names of the quantities. On failure *failed is the index of the formula
 * at fault. *theory is to be freed. */
gg_status gg_theory_formulas_read(int n, const char *const *name, const char *const *text, gg_formula_theory **theory,
                                  const char **quantity, int *failed, gg_error *err);

typedef struct gg_points_theory {
  size_t n_rows;
  int n_keys, n; /* columns of parameters, then of quantities */
  int key[GG_THEORY_PARAMETERS];
  double cell[]; /* row by row */
} gg_points_theory;

/* For gg_theory_definition.evaluate. Formulas of one species do not apply to a mixture; a table answers only at its
 * points, which are compared to nine digits. */
const char *gg_theory_formula_evaluate(void *theory, const gg_facts *facts, double *values);
const char *gg_theory_points_evaluate(void *theory, const gg_facts *facts, double *values);

/* A table from text: a line of names, parameters and quantities in any order, then numbers, with commas; an empty
 * cell is no answer. A parameter may have its key in scenes, collision.e; other keys (walls.e) are an error, and so
 * is a name with two columns. *quantity (to be freed) has the names of `n` quantities, to which *names (to be freed)
 * points. */
gg_status gg_theory_points_read(const char *text, const char *name, gg_points_theory **theory, char ***quantity,
                                char **names, gg_error *err);

#endif
