/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/verdict.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/engine.h"
#include "common/quantity.h"
#include "sweep/text_table.h"

const double gg_sweep_thresholds[GG_THRESHOLDS] = {0.01, 0.05, 0.2};

typedef struct writing {
  const gg_grid_view *view;
  const gg_agreement *agreement;
  const char *repeat;
  gg_text_table *table;
  FILE *out;
} writing;

bool gg_sweep_is_difference(const char *quantity)
{
  const gg_quantity q = gg_common_quantity_find(quantity);
  return q < GG_N_QUANTITIES && gg_common_quantity_mask(q) & GG_STRESS_DIFFERENCE;
}

double gg_sweep_deviation_of(const gg_point_row *row)
{
  return gg_sweep_is_difference(row->quantity) ? row->difference : row->deviation;
}

double gg_sweep_deviation_error_of(const gg_point_row *row)
{
  return gg_sweep_is_difference(row->quantity) ? row->difference_error : row->deviation_error;
}

/* True if a row deviates by more than `threshold` and by more than two errors. */
static bool is_off(const gg_point_row *row, double threshold)
{
  const double off = row ? fabs(gg_sweep_deviation_of(row)) : NAN;
  return off > threshold && !(off < 2 * gg_sweep_deviation_error_of(row));
}

/* "phi 0.1, e 0.5, beta 0.3, mu 0.1" */
static void name_point(const gg_grid_view *v, size_t point, char text[GG_PANEL_NAME])
{
  *text = '\0';
  for (size_t k = 0; gg_sweep_column_key(v->sweep, k); k++) {
    const char *key = gg_sweep_column_key(v->sweep, k), *dot = strrchr(key, '.'),
               *value = gg_sweep_column_value(v->sweep, point, k);
    if (strcmp(value, ".inf") == 0) continue;
    gg_base_text_append(text, GG_PANEL_NAME, "%s%s %.24s", *text ? ", " : "", dot ? dot + 1 : key, value);
  }
}

/* Count the points with a result of an engine ("md", "dsmc"), and those that are not steady. */
static void count_engine(const gg_grid_view *v, const char *engine, size_t *n, size_t *unsteady)
{
  *n = *unsteady = 0;
  for (size_t i = 0; i < v->sweep->n; i++)
    for (size_t r = v->first[i]; r < v->first[i + 1]; r++) {
      const gg_point_row *row = &v->table->row[r];
      if (strcmp(row->method, engine) != 0) continue;
      ++*n, *unsteady += !row->steady;
      break;
    }
}

const char *gg_sweep_not_steady(const gg_grid_view *v, size_t point)
{
  const char *which = NULL;
  for (size_t r = v->first[point]; r < v->first[point + 1]; r++) {
    const gg_point_row *row = &v->table->row[r];
    if (!row->steady && which && strcmp(which, row->method) != 0) return "md and dsmc";
    if (!row->steady) which = row->method;
  }
  return which;
}

const char *gg_sweep_not_homogeneous(const gg_grid_view *v, size_t point)
{
  for (size_t r = v->first[point]; r < v->first[point + 1]; r++)
    if (v->table->row[r].structure) return v->table->row[r].structure;
  return NULL;
}

const char *gg_sweep_no_reference(const gg_grid_view *v, size_t point)
{
  for (size_t r = v->first[point]; r < v->first[point + 1]; r++)
    if (v->table->row[r].reference) return NULL;
  return gg_sweep_grid_has(v, point) ? "neither a noise-free solution nor dsmc" : NULL;
}

/* "Not steady:" and a list, "- md at phi 0.1, e 0.5" and so on; nothing if no point has this trouble. */
static void print_trouble(const writing *w, const char *what, gg_point_trouble *trouble)
{
  char name[GG_PANEL_NAME];
  size_t n = 0;
  for (size_t i = 0; i < w->view->sweep->n; i++) {
    const char *which = trouble(w->view, i);
    if (!which) continue;
    name_point(w->view, i, name);
    if (!n++) fprintf(w->out, "%s:\n\n", what);
    fprintf(w->out, "- %s at %s\n", which, name);
  }
  if (n) fprintf(w->out, "\n");
}

static void print_points(const writing *w)
{
  const gg_grid_view *v = w->view;
  size_t missing = 0, fell_short = 0, n, unsteady;
  for (size_t i = 0; i < v->sweep->n; i++) {
    missing += !gg_sweep_grid_has(v, i);
    fell_short += gg_sweep_grid_has(v, i) && v->table->row[v->first[i]].fell_short;
  }
  fprintf(w->out, "%zu points", v->sweep->n);
  if (missing) fprintf(w->out, ", of which %zu have no result", missing);
  if (fell_short) fprintf(w->out, ", %zu ended before the requested error", fell_short);
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const char *engine = gg_common_engine_of(k)->name;
    count_engine(v, engine, &n, &unsteady);
    fprintf(w->out, "%s %s at %zu", k ? "," : ";", engine, n);
    if (unsteady) fprintf(w->out, " (%zu not steady)", unsteady);
  }
  fprintf(w->out, ".\n\n");
  print_trouble(w, "Not steady", gg_sweep_not_steady);
  print_trouble(w, "Not homogeneous (md)", gg_sweep_not_homogeneous);
  print_trouble(w, "Without a reference", gg_sweep_no_reference);
}

static void print_agreement_table(const writing *w)
{
  gg_sweep_text_row(w->table);
  gg_sweep_text_cells(w->table, "quantity\tpoints\tmean of z\tallowed\tmean of z^2\tallowed\tlargest");
  for (int i = 0; i < w->agreement->n; i++) {
    const gg_scores *r = &w->agreement->row[i].scores;
    gg_sweep_text_row(w->table);
    gg_sweep_text_cells(w->table, "%s%s\t%zu\t%+.2f\t+-%.2f\t%.2f", w->agreement->row[i].quantity, r->fails ? " !" : "",
                        r->n, r->mean, r->most_mean, r->variance);
    gg_sweep_text_cells(w->table, isfinite(r->most_variance) ? "%.2f" : "-", r->most_variance);
    gg_sweep_text_cells(w->table, "%.1f", r->largest);
  }
  gg_sweep_text_print(w->table, w->out);
}

static void print_agreement(const writing *w)
{
  const gg_agreement *a = w->agreement;
  fprintf(w->out, "## dsmc against the noise-free solution\n\n");
  if (!a->n_values) {
    fprintf(w->out,
            "Nothing to compare: of the points with a result %zu have no noise-free solution, and dsmc is not "
            "steady at %zu others.\n\n",
            a->unanswered, a->unsteady);
    return;
  }
  fprintf(w->out,
          "**%s** %zu values of %d quantities at %zu points. Without any fault, one grid in %.0f would fail: by a mean "
          "or a mean square of z beyond the table's, or by a single |z| above %.1f.",
          a->fails ? "dsmc and `enskog_hermite` disagree beyond chance."
                   : "dsmc and `enskog_hermite` agree within their errors.",
          a->n_values, a->n, a->n_points, 1 / GG_AGREEMENT_CHANCE, a->most);
  if (a->unanswered) fprintf(w->out, " %zu points have no noise-free solution.", a->unanswered);
  if (a->unsteady) fprintf(w->out, " %zu points whose dsmc is not steady are left out.", a->unsteady);
  fprintf(w->out, "\n\n");
  print_agreement_table(w);
}

enum { WORST = 10 };

static int by_z(const void *a, const void *b)
{
  const gg_point_row *const *one = a, *const *two = b;
  const double x = fabs((*one)->z), y = fabs((*two)->z);
  return x < y ? 1 : x > y ? -1 : 0;
}

size_t gg_sweep_find_worst(const gg_grid_view *v, const gg_point_row **found)
{
  size_t n = 0;
  const bool all = v->table->n_documents == 1;
  for (size_t i = 0; i < v->sweep->n; i++) {
    const size_t before = n;
    for (size_t r = v->first[i]; r < v->first[i + 1]; r++) {
      const gg_point_row *row = &v->table->row[r];
      if (!gg_sweep_agreement_counts(row)) continue;
      if (all || n == before)
        found[n++] = row;
      else if (fabs(row->z) > fabs(found[before]->z))
        found[before] = row;
    }
  }
  qsort(found, n, sizeof *found, by_z);
  return n < WORST || all ? n : WORST;
}

static void print_worst_row(const writing *w, const gg_point_row *row)
{
  char name[GG_PANEL_NAME];
  name_point(w->view, row->point, name);
  gg_sweep_text_row(w->table);
  gg_sweep_text_cells(w->table, "%+.1f\t%s\t%.5g\t%.2g\t%.5g\t%s", row->z, row->quantity, row->mean, row->error,
                      row->reference_mean, name);
  if (w->repeat) gg_sweep_text_cells(w->table, "`%s %zu`", w->repeat, row->point + 1);
}

static gg_status print_worst(const writing *w, gg_error *err)
{
  GG_FREED const gg_point_row **found = gg_base_array_new(w->view->table->n + 1, sizeof(void *), err);
  if (!found) return GG_FAILED;
  const size_t n = gg_sweep_find_worst(w->view, found);
  if (!n) return GG_OK;
  fprintf(w->out, "The largest z:\n\n");
  gg_sweep_text_row(w->table);
  gg_sweep_text_cells(w->table, "z\tquantity\tdsmc\terror\tenskog_hermite\tpoint%s", w->repeat ? "\trepeat it" : "");
  for (size_t i = 0; i < n; i++) print_worst_row(w, found[i]);
  gg_sweep_text_print(w->table, w->out);
  return GG_OK;
}

gg_off_counts gg_sweep_count_off(const gg_grid_view *v, const char *method, const char *quantity)
{
  gg_off_counts c = {0};
  for (size_t i = 0; i < v->sweep->n; i++) {
    const gg_point_row *row = gg_sweep_grid_row(v, i, method, quantity);
    const double off = row ? gg_sweep_deviation_of(row) : NAN;
    if (!isfinite(off)) continue;
    c.n++;
    for (int k = 0; k < GG_THRESHOLDS; k++) c.off[k] += is_off(row, gg_sweep_thresholds[k]);
    if (!(fabs(off) <= fabs(c.largest))) c.largest = off, c.where = row;
  }
  return c;
}

static void head_of_counts(const writing *w, const char *what)
{
  gg_sweep_text_row(w->table);
  gg_sweep_text_cells(w->table, "%s\tpoints", what);
  for (int k = 0; k < GG_THRESHOLDS; k++) gg_sweep_text_cells(w->table, "beyond %g %%", 100 * gg_sweep_thresholds[k]);
  gg_sweep_text_cells(w->table, "largest\twhere");
}

static void row_of_counts(const writing *w, const char *name, const gg_off_counts *c)
{
  char where[GG_PANEL_NAME] = "";
  if (!c->n) return;
  if (c->where) name_point(w->view, c->where->point, where);
  gg_sweep_text_row(w->table);
  gg_sweep_text_cells(w->table, "%s\t%zu", name, c->n);
  for (int k = 0; k < GG_THRESHOLDS; k++) gg_sweep_text_cells(w->table, "%zu", c->off[k]);
  gg_sweep_text_cells(w->table, "%+.3g %%\t%s", 100 * c->largest, where);
}

/* Panels down, values of x across: for each threshold the largest y (of md's deviation; e) with one beyond it, or of a
 * theory the least y from which on it is within `within`. */
typedef void cell_printer(const writing *w, const char *method, size_t panel, size_t x);

static void print_over_panels(const writing *w, const char *method, cell_printer *print)
{
  const gg_grid_view *v = w->view;
  char name[GG_PANEL_NAME];
  gg_sweep_text_row(w->table);
  gg_sweep_text_cells(w->table, "%s", "");
  for (size_t x = 0; x < v->x.n; x++)
    gg_sweep_text_cells(w->table, "%s%s%.24s", v->x.key ? v->x.key : "", v->x.key ? " " : "",
                        gg_sweep_grid_value(v, &v->x, x));
  for (size_t p = 0; p < v->n_panels; p++) {
    gg_sweep_grid_panel_name(v, p, false, name);
    gg_sweep_text_row(w->table);
    gg_sweep_text_cells(w->table, "%s", *name ? name : "all");
    for (size_t x = 0; x < v->x.n; x++) print(w, method, p, x);
  }
  gg_sweep_text_print(w->table, w->out);
}

static const gg_point_row *temperature_at(const writing *w, const char *method, size_t panel, size_t x, size_t y)
{
  return gg_sweep_grid_row(w->view, gg_sweep_grid_point(w->view, panel, x, y), method, "temperature");
}

static void print_leaving(const writing *w, const char *method, size_t panel, size_t x)
{
  char text[GG_TEXT_CELL] = "";
  bool any = false;
  for (int k = 0; k < GG_THRESHOLDS; k++) {
    const char *last = "-";
    for (size_t y = 0; y < w->view->y.n; y++) {
      const gg_point_row *row = temperature_at(w, method, panel, x, y);
      any |= row && isfinite(gg_sweep_deviation_of(row));
      if (is_off(row, gg_sweep_thresholds[k])) last = gg_sweep_grid_value(w->view, &w->view->y, y);
    }
    gg_base_text_append(text, sizeof text, "%s%.12s", k ? " / " : "", last);
  }
  gg_sweep_text_cells(w->table, "%s", any ? text : "no reference");
}

/* The least y from which on all that are known are within 5 %. */
static void print_within(const writing *w, const char *method, size_t panel, size_t x)
{
  size_t known = 0, from = w->view->y.n;
  for (size_t y = w->view->y.n; y-- > 0;) {
    const gg_point_row *row = temperature_at(w, method, panel, x, y);
    const double off = row ? gg_sweep_deviation_of(row) : NAN;
    if (!isfinite(off)) continue;
    known++;
    if (fabs(off) > gg_sweep_thresholds[1]) break;
    from = y;
  }
  if (known && from < w->view->y.n)
    gg_sweep_text_cells(w->table, "e >= %.12s", gg_sweep_grid_value(w->view, &w->view->y, from));
  else
    gg_sweep_text_cells(w->table, known ? "nowhere" : "no answer");
}

static bool y_is_restitution(const gg_grid_view *v)
{
  return v->y.key && strcmp(v->y.key, "collision.e") == 0;
}

static void print_md(const writing *w)
{
  gg_off_counts c = gg_sweep_count_off(w->view, "md", "temperature");
  fprintf(w->out, "## md against Enskog's equation\n\n"
                  "Points where md differs from the noise-free solution (without one from dsmc) by more than 1, 5 and "
                  "20 %% and by more than two errors. `N1` and `N2`: of the pressure.\n\n");
  head_of_counts(w, "quantity");
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++) {
    const char *name = gg_common_quantity_name(q);
    if (!gg_sweep_is_main_quantity(name)) continue;
    const gg_off_counts of = gg_sweep_count_off(w->view, "md", name);
    row_of_counts(w, name, &of);
  }
  gg_sweep_text_print(w->table, w->out);
  if (!c.n || !y_is_restitution(w->view)) return;
  fprintf(w->out, "The largest e at which md's temperature is off by more than 1 / 5 / 20 %%:\n\n");
  print_over_panels(w, "md", print_leaving);
}

static bool is_among(const char *name, const char *const *list, size_t n)
{
  while (n--)
    if (strcmp(list[n], name) == 0) return true;
  return false;
}

static void print_theories(const writing *w)
{
  fprintf(w->out, "## Theories against Enskog's equation\n\n"
                  "The temperature of each theory against the noise-free solution (without one against dsmc).\n\n");
  head_of_counts(w, "theory");
  const char *seen[GG_TEXT_ROWS];
  for (size_t i = 0, n = 0; i < w->view->table->n && n < GG_TEXT_ROWS; i++) {
    const gg_point_row *row = &w->view->table->row[i];
    if (!row->theory || is_among(row->method, seen, n)) continue;
    seen[n++] = row->method;
    const gg_off_counts c = gg_sweep_count_off(w->view, row->method, "temperature");
    row_of_counts(w, row->method, &c);
  }
  gg_sweep_text_print(w->table, w->out);
  if (!y_is_restitution(w->view) || !gg_sweep_count_off(w->view, "lun1991", "temperature").n) return;
  fprintf(w->out, "Lun's temperature (`lun1991`) is within 5 %% where:\n\n");
  print_over_panels(w, "lun1991", print_within);
}

gg_status gg_sweep_verdict_print(const gg_grid_view *view, const gg_agreement *agreement, const char *repeat, FILE *out,
                                 gg_error *err)
{
  GG_FREED gg_text_table *table = gg_base_array_new(1, sizeof *table, err);
  const writing w = {view, agreement, repeat, table, out};
  if (!table) return GG_FAILED;
  print_points(&w);
  print_agreement(&w);
  gg_status status = print_worst(&w, err);
  print_md(&w);
  print_theories(&w);
  return status;
}
