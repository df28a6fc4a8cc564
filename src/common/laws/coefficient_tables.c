/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/laws/coefficient_tables.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"

/* A built-in law: one table, of which each pair has a unit of speed. */
static gg_status make_built_in(const gg_model *m, gg_coefficient_tables *t, gg_error *err)
{
  GG_TRY(gg_common_loss_table_new(m->law.kind, &t->made[0], err));
  t->n = 1;
  for (int p = 0; p < gg_pairs_of(m->n_species); p++) t->of[GG_OF_E][p] = t->made[0], t->scale[p] = m->law.scale[p];
  return GG_OK;
}

/* The table of a pair, or that of an earlier pair with the same text. */
static gg_status make_pair(const gg_model *m, gg_contact_coefficient of, int pair, gg_coefficient_tables *t,
                           gg_error *err)
{
  const char *text = gg_speed_law_text(&m->by_speed, of, pair);
  if (!text) return GG_OK;
  for (int p = 0; p < pair && !t->of[of][pair]; p++)
    if (gg_speed_law_text(&m->by_speed, of, p) == text) t->of[of][pair] = t->of[of][p];
  if (t->of[of][pair]) return GG_OK;
  GG_TRY(gg_common_law_table_new(of, text, &t->made[t->n], err));
  t->of[of][pair] = t->made[t->n++];
  return GG_OK;
}

static gg_status make_by_speed(const gg_model *m, gg_coefficient_tables *t, gg_error *err)
{
  for (int p = 0; p < gg_pairs_of(m->n_species); p++) {
    t->scale[p] = ldexp(m->speed_unit, -GG_LAW_OCTAVES);
    for (int c = 0; c < GG_N_COEFFICIENTS; c++) GG_TRY(make_pair(m, (gg_contact_coefficient)c, p, t, err));
  }
  return GG_OK;
}

gg_status gg_common_coefficient_tables_new(const gg_model *m, gg_coefficient_tables **tables, gg_error *err)
{
  *tables = NULL;
  if (!m->law.name || m->law.e) return GG_OK;
  gg_coefficient_tables *t = gg_base_array_new(1, sizeof *t, err);
  if (!t) return GG_FAILED;
  const gg_status status = m->law.kind != GG_LAW_CONSTANT ? make_built_in(m, t, err) : make_by_speed(m, t, err);
  if (status == GG_OK)
    *tables = t;
  else
    gg_common_coefficient_tables_free(t);
  return status;
}

/* A bar of up to 30 marks for 1; beta from -1 on. */
static void draw_row(double v, double x, double bar, void (*line)(void *context, const char *text), void *context)
{
  enum { MARKS = 30 };
  char text[120], marks[2 * MARKS + 1];
  int n = (int)lrint(MARKS * fmin(fmax(bar, 0), 2));
  for (int k = 0; k < n; k++) marks[k] = '#';
  marks[n] = '\0';
  snprintf(text, sizeof text, "  v = %-8.3g %-8.4g %s", v, x, marks);
  line(context, text);
}

static void describe_law(const gg_model *m, gg_contact_coefficient of, int i, int j,
                         void (*line)(void *context, const char *text), void *context)
{
  gg_speed_law law;
  char text[120];
  const char *source = gg_speed_law_text(&m->by_speed, of, gg_pair(i, j));
  const double mean = m->speed_unit * sqrt(M_PI / 2 * m->temperature0 * (1 / m->mass[i] + 1 / m->mass[j]));
  if (!source || gg_common_speed_law_parse(&law, of, source, NULL) != GG_OK) return;
  snprintf(text, sizeof text, "%s(v) of species %d and %d; mean v at the start %.3g", gg_common_coefficient_name(of),
           i + 1, j + 1, mean);
  line(context, text);
  for (double v = mean / 16; v < 12 * mean; v *= 2) {
    const double x = gg_common_speed_law_value(&law, v, NULL);
    draw_row(v, x, of == GG_OF_BETA ? (1 + x) / 2 : x, line, context);
  }
}

void gg_common_coefficients_describe(const gg_model *m, void (*line)(void *context, const char *text), void *context)
{
  for (int c = 0; c < GG_N_COEFFICIENTS; c++)
    for (int i = 0; i < m->n_species; i++)
      for (int j = i; j < m->n_species; j++) describe_law(m, (gg_contact_coefficient)c, i, j, line, context);
}

void gg_common_coefficient_tables_free(gg_coefficient_tables *t)
{
  for (int k = 0; t && k < t->n; k++) free(t->made[k]);
  free(t);
}
