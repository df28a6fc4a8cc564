/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/extension.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "graingas.h"

struct gg_extension {
  atomic_int holders;
  gg_extension *before;
  int n_observables, n_quantities, n_theories; /* up to this link */
  bool is_law;
  gg_observable_definition observable; /* sample NULL: the link is none */
  gg_theory_definition theory;         /* evaluate NULL: none */
  struct gg_theory *face;
  gg_restitution_law law;
  gg_law_table table;
  char *text; /* strings and tables of all these: one block, filled up to `used` */
  size_t used;
  void *owned;
  char *source; /* of the theory; NULL: none */
};

/* Room for a copy of a string; 8 bytes more for the alignment of what follows. */
static size_t room(const char *s)
{
  return s ? strlen(s) + 9 : 0;
}

static void *copy(gg_extension *x, const void *what, size_t bytes)
{
  void *at = x->text + x->used;
  memcpy(at, what, bytes);
  x->used += (bytes + 7) / 8 * 8;
  return at;
}

static const char *copy_text(gg_extension *x, const char *s)
{
  return s ? copy(x, s, strlen(s) + 1) : NULL;
}

static gg_extension *new_link(gg_extension *before, size_t bytes, gg_error *err)
{
  gg_extension *x = gg_base_array_new(1, sizeof *x, err);
  if (!x) return NULL;
  x->text = gg_base_array_new(bytes + 8, 1, err);
  if (!x->text) {
    free(x);
    return NULL;
  }
  atomic_init(&x->holders, 1);
  x->before = before;
  if (!before) return x;
  x->n_observables = before->n_observables;
  x->n_quantities = before->n_quantities;
  x->n_theories = before->n_theories;
  return x;
}

gg_extension *gg_common_extension_with_observable(gg_extension *before, const gg_observable_definition *o,
                                                  gg_error *err)
{
  size_t n = (size_t)o->n_quantities, bytes = room(o->name) + room(o->doc) + n * sizeof *o->quantities;
  for (size_t k = 0; k < n; k++)
    bytes += room(o->quantities[k].name) + room(o->quantities[k].unit) + room(o->quantities[k].doc);
  gg_extension *x = new_link(before, bytes, err);
  if (!x) return NULL;
  x->observable = *o;
  x->observable.name = copy_text(x, o->name);
  x->observable.doc = copy_text(x, o->doc);
  gg_quantity_definition *q = copy(x, o->quantities, n * sizeof *q);
  for (size_t k = 0; k < n; k++) {
    q[k].name = copy_text(x, q[k].name);
    q[k].unit = q[k].unit ? copy_text(x, q[k].unit) : "1";
    q[k].doc = q[k].doc ? copy_text(x, q[k].doc) : "";
  }
  x->observable.quantities = q;
  x->n_observables++;
  x->n_quantities += o->n_quantities;
  return x;
}

gg_extension *gg_common_extension_with_theory(gg_extension *before, const gg_theory_definition *t,
                                              struct gg_theory *face, gg_error *err)
{
  size_t n = (size_t)t->n_quantities, bytes = n * sizeof *t->quantities;
  bytes += room(t->name) + room(t->title) + room(t->citation) + room(t->assumptions);
  for (size_t k = 0; k < n; k++) bytes += room(t->quantities[k]);
  gg_extension *x = new_link(before, bytes, err);
  if (!x) return NULL;
  x->theory = *t;
  x->face = face;
  x->theory.name = copy_text(x, t->name);
  x->theory.title = t->title ? copy_text(x, t->title) : x->theory.name;
  x->theory.citation = t->citation ? copy_text(x, t->citation) : "";
  x->theory.assumptions = t->assumptions ? copy_text(x, t->assumptions) : "";
  const char **names = copy(x, t->quantities, n * sizeof *names);
  for (size_t k = 0; k < n; k++) names[k] = copy_text(x, names[k]);
  x->theory.quantities = names;
  x->n_theories++;
  return x;
}

gg_extension *gg_common_extension_with_law(gg_extension *before, const gg_restitution_law *law,
                                           const gg_law_table *table, gg_error *err)
{
  size_t numbers = table ? table->n * sizeof(double) : 0;
  gg_extension *x = new_link(before, room(law->name) + 2 * numbers, err);
  if (!x) return NULL;
  x->is_law = true;
  x->law = *law;
  x->law.name = copy_text(x, law->name);
  if (!table) return x;
  x->table = (gg_law_table){table->n, copy(x, table->speed, numbers), copy(x, table->e, numbers)};
  x->law.e = gg_common_law_from_table;
  x->law.context = &x->table;
  return x;
}

void gg_common_extension_keep(gg_extension *x, void *owned)
{
  x->owned = owned;
}

void gg_common_extension_set_source(gg_extension *x, char *source)
{
  x->source = source;
}

gg_extension *gg_common_extension_hold(gg_extension *x)
{
  if (x) atomic_fetch_add(&x->holders, 1);
  return x;
}

void gg_common_extension_release(gg_extension *x)
{
  while (x && atomic_fetch_sub(&x->holders, 1) == 1) {
    gg_extension *before = x->before;
    free(x->face);
    free(x->text);
    free(x->owned);
    free(x->source);
    free(x);
    x = before;
  }
}

int gg_common_extension_observables(const gg_extension *x)
{
  return x ? x->n_observables : 0;
}
int gg_common_extension_quantities(const gg_extension *x)
{
  return x ? x->n_quantities : 0;
}
int gg_common_extension_theories(const gg_extension *x)
{
  return x ? x->n_theories : 0;
}

const gg_observable_definition *gg_common_extension_observable(const gg_extension *x, int index)
{
  while (x && !(x->observable.sample && x->n_observables == index + 1)) x = x->before;
  return x ? &x->observable : NULL;
}

const gg_quantity_definition *gg_common_extension_quantity(const gg_extension *x, int index)
{
  while (x && !(x->observable.sample && x->n_quantities - x->observable.n_quantities <= index)) x = x->before;
  return x ? &x->observable.quantities[index - (x->n_quantities - x->observable.n_quantities)] : NULL;
}

static const gg_extension *theory_link(const gg_extension *x, int index)
{
  while (x && !(x->theory.evaluate && x->n_theories == index + 1)) x = x->before;
  return x;
}

const gg_theory_definition *gg_common_extension_theory(const gg_extension *x, int index)
{
  x = theory_link(x, index);
  return x ? &x->theory : NULL;
}

const struct gg_theory *gg_common_extension_face(const gg_extension *x, int index)
{
  x = theory_link(x, index);
  return x ? x->face : NULL;
}

const char *gg_common_extension_theory_source(const gg_extension *x, int index)
{
  x = theory_link(x, index);
  return x ? x->source : NULL;
}

gg_restitution_law gg_common_extension_law(const gg_extension *x)
{
  while (x && !x->is_law) x = x->before;
  return x && x->law.e ? x->law : (gg_restitution_law){0};
}

void gg_common_extension_signature(const gg_extension *x, char *text, size_t size)
{
  gg_restitution_law law = gg_common_extension_law(x);
  *text = '\0';
  if (law.e) gg_base_text_append(text, size, "law %s", law.name);
  for (int k = 0; k < gg_common_extension_observables(x); k++) {
    const gg_observable_definition *o = gg_common_extension_observable(x, k);
    gg_base_text_append(text, size, "%sobservable %s/%d/%zu", *text ? "; " : "", o->name, o->n_quantities,
                        o->state_size);
  }
}
