/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/curve.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/quantity.h"
#include "statistics/jackknife.h"

static void clear_curve(gg_curve *c)
{
  free(c->x);
  free(c->value);
  free(c->error);
  free(c->reference);
}

/* Empty the list; its memory stays. */
static void empty(gg_curves *list)
{
  for (int i = 0; i < list->n; i++) clear_curve(&list->curve[i]);
  list->n = 0;
}

void gg_measure_curves_clear(gg_curves *list)
{
  empty(list);
  clear_curve(&list->spare);
  free(list->curve);
  *list = (gg_curves){0};
}

/* Allocate the list. It has megabytes, of which little is used: an entry is cleared when it is taken. */
static bool has_places(gg_curves *list)
{
  if (!list->curve) list->curve = malloc(GG_MOST_CURVES * sizeof *list->curve);
  return list->curve;
}

/* The next free entry with arrays for n points; NULL if there is no memory. */
static gg_curve *new_curve(gg_curves *list, size_t n)
{
  if (!has_places(list) || list->n == GG_MOST_CURVES || list->failed) return NULL;
  gg_curve *c = &list->curve[list->n];
  *c = (gg_curve){.samples = list->samples, .n = n};
  snprintf(c->group, sizeof c->group, "%s", list->group ? list->group : "");
  c->x = calloc(n, sizeof(double));
  c->value = calloc(n, sizeof(double));
  c->error = calloc(n, sizeof(double));
  if (c->x && c->value && c->error) return c;
  clear_curve(c);
  return NULL;
}

gg_curve *gg_measure_curve_add(gg_curves *list, size_t n, const char *name, const char *panel, const char *label)
{
  gg_curve *c = new_curve(list, n);
  if (c) list->n++;
  if (!c) {
    list->failed = true;
    c = &list->spare;
    clear_curve(c);
    *c = (gg_curve){0};
  }
  snprintf(c->name, sizeof c->name, "%s", name);
  snprintf(c->panel, sizeof c->panel, "%s", panel);
  snprintf(c->label, sizeof c->label, "%s", label);
  return c;
}

void gg_measure_curve_axes(gg_curve *c, const char *x_name, const char *x_unit, const char *y_name, const char *unit)
{
  snprintf(c->x_name, sizeof c->x_name, "%s", x_name);
  snprintf(c->x_unit, sizeof c->x_unit, "%s", x_unit);
  snprintf(c->y_name, sizeof c->y_name, "%s", y_name);
  snprintf(c->unit, sizeof c->unit, "%s", unit);
}

void gg_measure_curve_put_number(gg_curve *c, const char *name, double value, const char *unit)
{
  if (c->n_numbers == GG_CURVE_NUMBERS) return;
  gg_curve_number *p = &c->number[c->n_numbers++];
  *p = (gg_curve_number){.value = value, .error = NAN};
  snprintf(p->name, sizeof p->name, "%s", name);
  snprintf(p->unit, sizeof p->unit, "%s", unit);
}

void gg_measure_curve_put_truncated(gg_curve *c, const char *name, double value, double truncation, const char *unit)
{
  int n = c->n_numbers;
  gg_measure_curve_put_number(c, name, value, unit);
  if (c->n_numbers > n) c->number[n].truncation = truncation;
}

void gg_measure_curve_put_setting(gg_curve *c, const char *name, double value, const char *unit)
{
  int n = c->n_numbers;
  gg_measure_curve_put_number(c, name, value, unit);
  if (c->n_numbers > n) c->number[n].setting = true;
}

void gg_measure_curve_beside(gg_curve *c, const char *label, gg_curve_law *law, const double *parameters)
{
  if (!c->reference) c->reference = calloc(c->n + 1, sizeof(double));
  c->law_lost = !c->reference;
  if (c->law_lost) return;
  snprintf(c->reference_label, sizeof c->reference_label, "%s", label);
  for (size_t i = 0; i < c->n; i++) c->reference[i] = law(c->x[i], parameters);
}

double gg_measure_curve_level(double x, const double *parameters)
{
  (void)x;
  return *parameters;
}

const char *gg_measure_curve_unit(const gg_model *m, const char *what)
{
  bool sheared = gg_flow_is_timed_by_shear(m->flow);
  if (strcmp(what, "length") == 0) return gg_common_quantity_unit(GG_Q_MEAN_FREE_PATH, m);
  if (strcmp(what, "temperature") == 0) return gg_common_quantity_unit(GG_Q_TEMPERATURE, m);
  if (strcmp(what, "spin") == 0) return gg_common_quantity_unit(GG_Q_SPIN_Z, m);
  if (strcmp(what, "velocity") == 0) return sheared ? m->boltzmann ? "gamma/(n d^2)" : "d gamma" : "v_0";
  if (strcmp(what, "time") == 0) return sheared ? "1/gamma" : m->boltzmann ? "1/(n d^2 v_0)" : "d/v_0";
  return "1";
}

static size_t shape(const gg_curves *list)
{
  size_t n = 0;
  for (int k = 0; k < list->n; k++) n += list->curve[k].n + (size_t)list->curve[k].n_numbers;
  return n;
}

/* Changes of every value and number when a block is left out; 0 where the part has no such value. */
static void differences(const gg_curves *full, const gg_curves *part, double *d)
{
  for (int k = 0; k < full->n; k++) {
    const gg_curve *f = &full->curve[k], *c = &part->curve[k];
    bool there = k < part->n;
    for (size_t i = 0; i < f->n; i++) *d++ = there && i < c->n ? c->value[i] - f->value[i] : 0;
    for (int i = 0; i < f->n_numbers; i++)
      *d++ = there && i < c->n_numbers ? c->number[i].value - f->number[i].value : 0;
  }
}

typedef struct pooled {
  const gg_bins *const *bins;
  size_t n_runs, width, blocks, per_block;
  double *total, *mean;
} pooled;

static void sum_up(pooled *p)
{
  for (size_t r = 0; r < p->n_runs; r++)
    for (size_t b = 0; b < gg_bins_blocks(p->bins[r]); b++)
      for (size_t k = 0; k < p->width; k++) p->total[k] += gg_bins_block(p->bins[r], b)[k];
}

static void evaluate(const pooled *p, const double *without, gg_curves_of *of, const void *self, gg_curves *list)
{
  list->samples = (p->blocks - (without != NULL)) * p->per_block;
  for (size_t k = 0; k < p->width; k++) p->mean[k] = (p->total[k] - (without ? without[k] : 0)) / (double)list->samples;
  of(self, p->mean, list);
}

/* Leave out every block in turn; blocks of a run are neighbours in time, those of different runs are not. */
static bool leave_one_out(const pooled *p, gg_curves_of *of, const void *self, const gg_curves *full, gg_jackknife *j)
{
  gg_curves part = {.model = full->model, .group = full->group};
  for (size_t r = 0; r < p->n_runs && !part.failed; r++) {
    gg_statistics_jackknife_cut(j);
    for (size_t b = 0; b < gg_bins_blocks(p->bins[r]) && !part.failed; b++) {
      evaluate(p, gg_bins_block(p->bins[r], b), of, self, &part);
      if (!part.failed) {
        differences(full, &part, gg_statistics_jackknife_next(j));
        gg_statistics_jackknife_add(j);
      }
      empty(&part);
    }
  }
  bool whole = !part.failed;
  gg_measure_curves_clear(&part);
  return whole;
}

static void put_errors(gg_curves *full, const gg_jackknife *j, double memory)
{
  size_t at = 0;
  for (int k = 0; k < full->n; k++) {
    gg_curve *c = &full->curve[k];
    c->block_correlation = gg_statistics_jackknife_errors(j, at, c->n, memory, NAN, c->error);
    for (size_t i = 0; i < c->n; i++)
      if (c->value[i] == 0 && c->error[i] == 0) c->error[i] = NAN; /* nothing was counted: unknown, not exact */
    at += c->n;
    for (int i = 0; i < c->n_numbers; i++, at++) {
      gg_statistics_jackknife_errors(j, at, 1, memory, c->block_correlation, &c->number[i].error);
      c->number[i].error = hypot(c->number[i].error, c->number[i].truncation);
      if (c->number[i].setting) c->number[i].error = 0;
    }
  }
}

#define SURE_OF_DIVISOR 3

static bool is_divided_by_zero(const gg_curve *c)
{
  for (int i = 0; c->divisor && i < c->n_numbers; i++)
    if (strcmp(c->number[i].name, c->divisor) == 0)
      return !(fabs(c->number[i].value) > SURE_OF_DIVISOR * c->number[i].error);
  return false;
}

static void withhold(gg_curves *full)
{
  for (gg_curve *c = full->curve; c < full->curve + full->n; c++)
    if (is_divided_by_zero(c))
      for (size_t i = 0; i < c->n; i++) c->value[i] = c->error[i] = NAN;
}

/* Move the curves of one list to the end of another. */
static bool append(gg_curves *to, gg_curves *from)
{
  if (!has_places(to) || to->n + from->n > GG_MOST_CURVES) return false;
  memcpy(to->curve + to->n, from->curve, (size_t)from->n * sizeof *from->curve);
  to->n += from->n;
  from->n = 0;
  return true;
}

gg_status gg_measure_curves_estimate(const gg_bins *const *bins, size_t n_runs, gg_curves_of *of, const void *self,
                                     const char *group, double memory, gg_curves *list, gg_error *err)
{
  pooled p = {.bins = bins, .n_runs = n_runs, .width = bins[0]->width, .per_block = bins[0]->per_block};
  for (size_t r = 0; r < n_runs; r++) p.blocks += gg_bins_blocks(bins[r]);
  if (p.blocks == 0) return GG_OK;
  p.total = gg_base_array_new(2 * p.width, sizeof(double), err);
  if (!p.total) return GG_FAILED;
  p.mean = p.total + p.width;
  gg_curves full = {.model = list->model, .group = group};
  const unsigned before = gg_base_memory_failures(); /* fits have no other way to report this */
  gg_base_gsl_enter();
  sum_up(&p);
  evaluate(&p, NULL, of, self, &full);
  gg_jackknife j;
  bool whole = gg_statistics_jackknife_init(&j, shape(&full), err) == GG_OK && !full.failed &&
               leave_one_out(&p, of, self, &full, &j);
  for (int k = 0; k < full.n; k++) whole = whole && !full.curve[k].law_lost;
  if (whole) put_errors(&full, &j, memory / (double)p.per_block), withhold(&full);
  gg_base_gsl_leave();
  if (gg_base_memory_failures() != before) whole = false;
  whole = whole && (full.n == 0 || append(list, &full));
  gg_statistics_jackknife_clear(&j);
  gg_measure_curves_clear(&full);
  free(p.total);
  return whole ? GG_OK : gg_base_out_of_memory_for(err, "the curves of %s", group);
}
