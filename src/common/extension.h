/* SPDX-License-Identifier: GPL-3.0-or-later */
/* User-defined observables, theories and restitution law of a scene (graingas.h, "Extension").
 *
 * A linked list, the latest addition first. Links are immutable and reference-counted. A scene holds a reference to the
 * head, and so do objects that outlive the scene (results). Runs borrow it. */
#ifndef GG_EXTENSION_H
#define GG_EXTENSION_H

#include <stddef.h>

#include "common/restitution.h"

enum { GG_MOST_OWN_QUANTITIES = 32, GG_MOST_OWN_THEORIES = 8 };

typedef struct gg_extension gg_extension;
/* The public header defines these. */
typedef struct gg_quantity_definition gg_quantity_definition;
typedef struct gg_observable_definition gg_observable_definition;
typedef struct gg_theory_definition gg_theory_definition;
struct gg_theory; /* of src/theory */

/* A link in front of `before`, whose hold goes over to it (on failure it stays with the caller). Definitions are taken
 * to be right: src/api checks them. NULL: out of memory. */
gg_extension *gg_common_extension_with_observable(gg_extension *before, const gg_observable_definition *o,
                                                  gg_error *err);
/* `face` (from malloc, and the link's from now on) is what src/theory makes of the definition. */
gg_extension *gg_common_extension_with_theory(gg_extension *before, const gg_theory_definition *t,
                                              struct gg_theory *face, gg_error *err);
/* With a table, `law` has neither callback nor context; the table is copied. */
gg_extension *gg_common_extension_with_law(gg_extension *before, const gg_restitution_law *law,
                                           const gg_law_table *table, gg_error *err);

/* The head frees `owned` (from malloc) when it goes: what its callbacks have as their context. */
void gg_common_extension_keep(gg_extension *x, void *owned);
/* Set the source of the theory at the head, as a scene's text has it, in JSON: {"temperature": "phi*e"} or
 * "points.csv". The head frees `source` (from malloc). */
void gg_common_extension_set_source(gg_extension *x, char *source);

/* Both take NULL, too: a scene without extension. */
gg_extension *gg_common_extension_hold(gg_extension *x);
void gg_common_extension_release(gg_extension *x);

/* In the order of registration; the index of a quantity counts over all observables. */
int gg_common_extension_observables(const gg_extension *x);
const gg_observable_definition *gg_common_extension_observable(const gg_extension *x, int index);
int gg_common_extension_quantities(const gg_extension *x);
const gg_quantity_definition *gg_common_extension_quantity(const gg_extension *x, int index);
int gg_common_extension_theories(const gg_extension *x);
const gg_theory_definition *gg_common_extension_theory(const gg_extension *x, int index);
const struct gg_theory *gg_common_extension_face(const gg_extension *x, int index);
/* NULL: a program defines the theory. */
const char *gg_common_extension_theory_source(const gg_extension *x, int index);
/* The latest law; e NULL if there is none. */
gg_restitution_law gg_common_extension_law(const gg_extension *x);

/* A line to compare the law and observables of two scenes by: "law viscoelastic; observable heat/2" (as far
 * as names and numbers of quantities tell); empty without any. */
void gg_common_extension_signature(const gg_extension *x, char *text, size_t size);

#endif
