/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/sheet.h"

#include <stdarg.h>
#include <stdlib.h>

#include "base/memory.h"

bool gg_plot_is_unsteady(const gg_stored_engine *e)
{
  return e->name && json_is_false(json_object_get(e->document, "steady"));
}

static void write_note(const gg_stored_result *stored, char *note, size_t size)
{
  const bool md = gg_plot_is_unsteady(&stored->engine[GG_MD]), dsmc = gg_plot_is_unsteady(&stored->engine[GG_DSMC]);
  if (md || dsmc)
    snprintf(note, size, "Open symbols: not steady (%s%s%s)", md ? "md" : "", md && dsmc ? ", " : "",
             dsmc ? "dsmc" : "");
}

gg_plot_sheet *gg_plot_sheet_new(const gg_stored_result *stored, const gg_plot_paper *paper)
{
  gg_plot_sheet *s = calloc(1, sizeof *s);
  if (!s) return NULL;
  gg_plot_page_title(stored, s->title, sizeof s->title);
  write_note(stored, s->note, sizeof s->note);
  s->chart = (gg_chart){.title = s->title, .note = s->note, .panel = s->panel};
  s->width = paper->width;
  return s;
}

static bool has_open_symbols(const gg_plot_sheet *s)
{
  bool any = false;
  for (size_t p = 0; p < s->chart.n; p++)
    for (size_t k = 0; k < s->panel[p].n; k++) {
      const gg_chart_series *series = &s->panel[p].series[k];
      any |= series->style == GG_CHART_POINTS && (series->all_open || series->open);
    }
  return any;
}

gg_status gg_plot_sheet_finish(gg_plot_sheet *s, const gg_plot_paper *paper, const char *picture, gg_error *err)
{
  if (!has_open_symbols(s)) *s->note = '\0';
  gg_status status = s->lacks ? gg_base_out_of_memory(err) : gg_plot_chart_draw_on(&s->chart, paper, picture, err);
  for (size_t p = 0; p < s->chart.n; p++)
    for (size_t k = 0; k < s->panel[p].n; k++) free((void *)(uintptr_t)s->series[p][k].x);
  free(s);
  return status;
}

gg_chart_panel *gg_plot_sheet_add_panel(gg_plot_sheet *s)
{
  size_t n = s->chart.n;
  if (n == GG_SHEET_PANELS) return NULL;
  s->panel[n] = (gg_chart_panel){.series = s->series[n]};
  s->chart.n++;
  return &s->panel[n];
}

/* x, y and errors in one piece of memory. */
gg_chart_series *gg_plot_sheet_add_series(gg_plot_sheet *s, gg_chart_series like, size_t room)
{
  size_t p = s->chart.n - 1;
  if (s->panel[p].n == GG_SHEET_SERIES) return NULL;
  double *numbers = malloc((3 * room + 1) * sizeof *numbers);
  s->lacks |= !numbers;
  if (!numbers) return NULL;
  like.n = 0, like.x = numbers, like.y = numbers + room, like.error = numbers + 2 * room;
  gg_chart_series *series = &s->series[p][s->panel[p].n++];
  *series = like;
  return series;
}

void gg_plot_sheet_drop_series(gg_plot_sheet *s)
{
  size_t p = s->chart.n - 1;
  free((void *)(uintptr_t)s->series[p][--s->panel[p].n].x);
}

void gg_plot_sheet_add_point(gg_chart_series *s, double x, double y, double error)
{
  ((double *)(uintptr_t)s->x)[s->n] = x;
  ((double *)(uintptr_t)s->y)[s->n] = y;
  ((double *)(uintptr_t)s->error)[s->n++] = error;
}

const char *gg_plot_sheet_add_text(gg_plot_sheet *s, const char *format, ...)
{
  if (s->n_texts == sizeof s->text / sizeof *s->text) return "";
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(s->text[s->n_texts], sizeof *s->text, format, arguments);
  va_end(arguments);
  return s->text[s->n_texts++];
}
