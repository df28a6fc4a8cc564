#include "reproduce/stated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "reproduce/panel.h"
#include "reproduce/straight.h"

gg_told gg_reproduce_find_zero(size_t n, const double *x, const double *y, const double *e)
{
  for (size_t i = 0; i + 1 < n; i++) {
    if (!(y[i] * y[i + 1] <= 0) || y[i] == y[i + 1]) continue;
    double t = y[i] / (y[i] - y[i + 1]), width = x[i + 1] - x[i], slope = (y[i + 1] - y[i]) / width;
    return (gg_told){x[i] + t * width, hypot((1 - t) * e[i], t * e[i + 1]) / fabs(slope), NULL};
  }
  return GG_NO_VALUE;
}

/* The top of the parabola through three points. */
static double top(const double x[3], const double y[3])
{
  double a = (y[1] - y[0]) / (x[1] - x[0]), b = (y[2] - y[1]) / (x[2] - x[1]), curve = (b - a) / (x[2] - x[0]);
  return 0.5 * (x[0] + x[1]) - a / (2 * curve);
}

gg_told gg_reproduce_find_extreme(size_t n, const double *x, const double *y, const double *e, bool least)
{
  size_t at = 0;
  for (size_t i = 1; i < n; i++)
    if (least ? y[i] < y[at] : y[i] > y[at]) at = i;
  if (n < 3 || at == 0 || at == n - 1) return GG_NO_VALUE;
  bool log_x = x[at - 1] > 0;
  double u[3], v[3], variance = 0;
  for (int k = 0; k < 3; k++) {
    u[k] = log_x ? log(x[at - 1 + (size_t)k]) : x[at - 1 + (size_t)k];
    v[k] = y[at - 1 + (size_t)k];
  }
  double here = top(u, v);
  for (int k = 0; k < 3; k++) {
    double kept = v[k];
    v[k] += e[at - 1 + (size_t)k];
    variance += pow(top(u, v) - here, 2);
    v[k] = kept;
  }
  double value = log_x ? exp(here) : here;
  return (gg_told){value, sqrt(variance) * (log_x ? value : 1), NULL};
}

gg_told gg_reproduce_find_power(size_t n, const double *x, const double *y, const double *e, bool exponent)
{
  gg_straight line;
  double *all = malloc(3 * n * sizeof *all + 1);
  if (!all) {
    gg_base_memory_lacked();
    return GG_NO_VALUE;
  }
  for (size_t i = 0; i < n; i++) {
    bool told = x[i] > 0 && y[i] > 0;
    all[i] = told ? log(x[i]) : NAN, all[n + i] = told ? log(y[i]) : NAN, all[2 * n + i] = e[i] / y[i];
  }
  bool fitted = gg_reproduce_straight_fit(n, all, all + n, all + 2 * n, &line);
  free(all);
  if (!fitted) return GG_NO_VALUE;
  if (exponent) return (gg_told){line.b, line.b_error, NULL};
  return (gg_told){exp(line.a), exp(line.a) * line.a_error, NULL};
}

static bool takes(const gg_stated *s, const gg_figure_point *p)
{
  return (!s->sweep || strcmp(s->sweep, p->sweep) == 0) && gg_reproduce_scene_meets(&p->scene, &s->at);
}

/* All points along the key, or the one there is. */
static gg_status gather(const gg_stated *s, const gg_figure_points *all, gg_asked *asked, gg_drawn *d, gg_error *err)
{
  asked->points = all, asked->source = &s->of, asked->name = s->of.names.text[0];
  for (size_t i = 0; i < all->n; i++) {
    const gg_figure_point *p = &all->point[i];
    if (!takes(s, p) || (asked->engine >= 0 && !p->stored.engine[asked->engine].document)) continue;
    double x = s->over ? gg_reproduce_key_number(&p->scene, s->over) : 0;
    if (s->x.n) x = gg_reproduce_expression_value(&s->x, (gg_variables){.x = x});
    gg_told y = gg_reproduce_figure_value(asked, p, x);
    if (isfinite(x) && isfinite(y.mean)) GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y.mean, y.error, err));
  }
  gg_reproduce_drawn_sort(d);
  return GG_OK;
}

static gg_told found(const gg_stated *s, const gg_drawn *d)
{
  switch (s->find) {
  case GG_FIND_VALUE: return d->n ? (gg_told){d->y[0], d->error[0], NULL} : GG_NO_VALUE;
  case GG_FIND_ZERO: return gg_reproduce_find_zero(d->n, d->x, d->y, d->error);
  case GG_FIND_MINIMUM:
  case GG_FIND_MAXIMUM: return gg_reproduce_find_extreme(d->n, d->x, d->y, d->error, s->find == GG_FIND_MINIMUM);
  case GG_FIND_PREFACTOR:
  case GG_FIND_EXPONENT: return gg_reproduce_find_power(d->n, d->x, d->y, d->error, s->find == GG_FIND_EXPONENT);
  }
  return GG_NO_VALUE;
}

static gg_status ask(const gg_stated *s, const gg_figure_points *all, int engine, const char *theory, gg_told *value,
                     gg_error *err)
{
  gg_drawn_panel holder = {0};
  gg_asked asked = {.engine = engine, .theory = theory};
  gg_drawn *d = gg_reproduce_panel_add(&holder, "", "", GG_CHART_POINTS);
  gg_status status = d ? gather(s, all, &asked, d, err) : gg_base_out_of_memory(err);
  if (status == GG_OK) *value = found(s, d);
  gg_reproduce_panel_clear(&holder);
  return status;
}

gg_status gg_reproduce_stated_rows(const gg_figure_entry *entry, const gg_figure_points *all, gg_stated_row *rows,
                                   gg_error *err)
{
  for (int i = 0; i < entry->n_numbers; i++) {
    const gg_stated *s = &entry->number[i];
    rows[i] = (gg_stated_row){.of = s};
    for (int k = 0; k < 2; k++) {
      GG_TRY(ask(s, all, k, NULL, &rows[i].engine[k], err));
      rows[i].z[k] = (rows[i].engine[k].mean - s->paper) / hypot(rows[i].engine[k].error, s->error);
    }
    for (int k = 0; k < s->theories.n; k++) {
      rows[i].theory[k] = GG_NO_VALUE;
      if (s->of.kind == GG_OF_QUANTITY) GG_TRY(ask(s, all, -1, s->theories.text[k], &rows[i].theory[k], err));
    }
  }
  return GG_OK;
}
