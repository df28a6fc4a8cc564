/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/chart.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Layout pixels: pages, frames, and the room around a frame for tics, labels and the label of y above it. */
enum { ONE_WIDE = 600, WIDE = 430, SHARED_WIDE = 550, LEAST_WIDE = 260, TALL = 370, LEAST_TALL = 170 };
enum { LEFT = 70, RIGHT = 26, ABOVE = 8, BELOW = 60, Y_LABEL = 28, MARGIN = 8 };
enum { MOST_ENTRIES = 96 };

gg_chart *gg_plot_chart_new(void)
{
  return calloc(1, sizeof(gg_chart));
}

gg_chart_panel *gg_plot_chart_panel(gg_chart *c)
{
  if (c->n == GG_CHART_PANELS) return NULL;
  gg_chart_panel *p = calloc(1, sizeof *p);
  if (p) c->panel[c->n++] = p;
  c->lacks |= !p;
  return p;
}

gg_chart_series *gg_plot_chart_series(gg_chart *c, const char *method, const char *group, int style)
{
  return gg_plot_panel_series(c, c->panel[c->n - 1], method, group, style);
}

gg_chart_series *gg_plot_panel_series(gg_chart *c, gg_chart_panel *p, const char *method, const char *group, int style)
{
  if (p->n == GG_CHART_SERIES) return NULL;
  gg_chart_series *s = calloc(1, sizeof *s);
  c->lacks |= !s;
  if (!s) return NULL;
  s->method = method, s->group = group, s->look.style = style;
  p->series[p->n++] = s;
  return s;
}

void gg_plot_chart_point(gg_chart *c, gg_chart_series *s, gg_chart_point at)
{
  if (!s) return;
  if (s->n == s->room) {
    const size_t room = 2 * s->room + 16;
    gg_chart_point *grown = realloc(s->point, room * sizeof *grown);
    c->lacks |= !grown;
    if (!grown) return;
    s->point = grown, s->room = room;
  }
  s->point[s->n++] = at;
}

const char *gg_plot_chart_last_text(gg_chart *c)
{
  c->lacks |= !c->texts.n;
  return c->texts.n ? c->texts.text[c->texts.n - 1] : "";
}

void gg_plot_chart_free(gg_chart *c)
{
  for (size_t p = 0; c && p < c->n; p++) {
    for (size_t k = 0; k < c->panel[p]->n; k++) free(c->panel[p]->series[k]->point), free(c->panel[p]->series[k]);
    free(c->panel[p]);
  }
  if (c) gg_base_string_list_clear(&c->texts);
  free(c);
}

typedef struct layout {
  double page[2], legend, note; /* tops */
  gg_legend_entry entry[MOST_ENTRIES];
  int n;
  struct {
    gg_box frame;
    double head; /* from the top of the panel to its frame */
    gg_legend_entry *entry;
    int n;
  } panel[GG_CHART_PANELS];
} layout;

/* The width of each panel's column: fewer columns on a narrow page. */
static void share_width(const gg_chart *c, double width, layout *l)
{
  int columns = c->columns > 0 ? c->columns : c->n == 4 ? 2 : c->n < 3 ? (int)c->n : 3;
  if (columns > (int)c->n) columns = (int)c->n;
  double least = 1;
  for (size_t i = 0; i < c->n; i++) least = c->panel[i]->share > 0 ? fmin(least, c->panel[i]->share) : least;
  const bool shared = least < 1;
  l->page[0] = width > 0 ? width : columns * (shared ? SHARED_WIDE : columns == 1 ? ONE_WIDE : WIDE);
  while (columns > 1 && l->page[0] / columns < LEAST_WIDE) columns--;
  for (size_t i = 0; i < c->n; i++)
    l->panel[i].frame.wide = l->page[0] * (!shared || columns == 1           ? 1.0 / columns
                                           : least * l->page[0] < LEAST_WIDE ? 1
                                                                             : c->panel[i]->share);
}

/* Panels of a row have one height, that of the narrowest. Returns the end of the row. */
static double place_row(const gg_chart *c, layout *l, size_t from, size_t to, double top)
{
  double tall = TALL, head = 0, left = 0;
  for (size_t i = from; i < to; i++) {
    const double wide = l->panel[i].frame.wide - LEFT - RIGHT;
    tall = fmin(tall, fmax(0.68 * wide, LEAST_TALL));
    head = fmax(head, ABOVE + gg_plot_page_rows(NULL, 0, 0, wide + RIGHT, "", c->panel[i]->title) + Y_LABEL +
                          gg_plot_page_legend(NULL, 0, 0, wide + RIGHT, l->panel[i].entry, l->panel[i].n));
  }
  for (size_t i = from; i < to; i++) {
    const double column = l->panel[i].frame.wide;
    l->panel[i].head = head;
    l->panel[i].frame = (gg_box){left + LEFT, top + head, column - LEFT - RIGHT, tall};
    left += column;
  }
  return top + head + tall + BELOW;
}

static void lay_out(const gg_chart *c, double width, layout *l)
{
  double top = MARGIN, left = 0;
  size_t from = 0;
  share_width(c, width, l);
  top += gg_plot_page_rows(NULL, 0, 0, l->page[0], "", c->title);
  l->legend = top += 4;
  top += gg_plot_page_legend(NULL, 0, 0, l->page[0] - LEFT - RIGHT, l->entry, l->n);
  for (size_t i = 0; i < c->n; i++) {
    if (left + l->panel[i].frame.wide > 1.001 * l->page[0]) top = place_row(c, l, from, i, top), from = i, left = 0;
    left += l->panel[i].frame.wide;
  }
  l->note = place_row(c, l, from, c->n, top);
  l->page[1] = l->note + gg_plot_page_rows(NULL, 0, 0, l->page[0], "", c->note) + MARGIN;
}

/* x, y, ends of the bars of x and of y, and whether the symbol is open. On a logarithmic axis a bar that ends at or
 * below 0 ends at the edge. */
static void print_data(FILE *s, const gg_chart_panel *p, size_t k, double offset)
{
  fprintf(s, "$series%zu << EOD\n", k);
  for (size_t i = 0; i < p->series[k]->n; i++) {
    const gg_chart_point *a = &p->series[k]->point[i];
    const double x = a->x + offset, dx = isfinite(a->x_error) ? fabs(a->x_error) : 0;
    const double dy = isfinite(a->error) ? fabs(a->error) : 0;
    const double low = p->y.log && a->y <= dy ? fmin(p->y.from, a->y) : a->y - dy;
    const double left = p->x.log && x <= dx ? fmin(p->x.from, x) : x - dx;
    if (gg_plot_point_shows(p, a))
      fprintf(s, "%.8g %.8g %.8g %.8g %.8g %.8g %d\n", x, a->y, left, x + dx, low, a->y + dy, a->open);
    else
      fprintf(s, "\n");
  }
  fprintf(s, "EOD\n");
}

static void print_series(const gg_page *page, const gg_chart_panel *p, size_t k)
{
  const gg_chart_series *c = p->series[k];
  FILE *s = page->script;
  if (c->look.shaded)
    fprintf(s, ", $series%zu using %s fc rgb '#%06x' fs transparent solid 0.25 noborder notitle", k,
            p->n_categories ? "1:2:($1-0.4):($1+0.4):5:6 with boxxyerror" : "1:5:6 with filledcurves", c->look.colour);
  if (c->look.style == GG_CHART_LINE || (c->look.style == GG_CHART_BAND && !p->n_categories)) {
    fprintf(s, ", $series%zu using 1:2 with lines ", k);
    gg_plot_page_look(page, &c->look, false);
    fprintf(s, " notitle");
  }
  bool across = false;
  for (size_t i = 0; i < c->n; i++) across |= c->point[i].x_error > 0;
  for (int open = 0; open < 2 && c->look.style == GG_CHART_POINTS; open++) {
    bool any = false;
    for (size_t i = 0; i < c->n; i++) any |= c->point[i].open == open;
    if (!any) continue;
    fprintf(s, ", $series%zu using 1:($7==%d?$2:NaN):%s ", k, open,
            across ? "3:4:5:6 with xyerrorbars" : "5:6 with yerrorbars");
    gg_plot_page_look(page, &c->look, open);
    fprintf(s, " notitle");
  }
}

/* Bands under lines under points, and the first points over the others; of many points lines go over them. */
static void plot_series(const gg_page *page, const gg_chart_panel *p)
{
  static const int orders[][3] = {{GG_CHART_BAND, GG_CHART_LINE, GG_CHART_POINTS},
                                  {GG_CHART_BAND, GG_CHART_POINTS, GG_CHART_LINE}};
  fprintf(page->script, "plot NaN notitle");
  for (int pass = 0; pass < 3; pass++)
    for (size_t i = 0; i < p->n; i++) {
      const int style = orders[p->own_legend][pass];
      const size_t k = style == GG_CHART_POINTS ? p->n - 1 - i : i;
      const gg_chart_series *c = p->series[k];
      if ((int)c->look.style == style && c->n && !c->hidden) print_series(page, p, k);
    }
  fprintf(page->script, "\n");
}

/* Position of a series beside the middle of its category. */
static double offset_of(const gg_chart_panel *p, size_t k)
{
  int place = 0, n = 0;
  for (size_t i = 0; i < p->n; i++) {
    const bool counts = p->series[i]->look.style == GG_CHART_POINTS && !p->series[i]->hidden;
    n += counts, place += counts && i < k;
  }
  return p->series[k]->look.style == GG_CHART_POINTS && n ? fmin(0.8 / n, 0.13) * (place - 0.5 * (n - 1)) : 0;
}

/* Values outside of the axis are written at its edge, upright and beside each other, as many as a category has room
 * for. */
static void label_outliers(const gg_page *page, const gg_chart_panel *p, gg_box f, bool above)
{
  const double wide = f.wide / ((double)p->n_categories + 0.1), slot = 13;
  for (size_t category = 0; category < p->n_categories; category++) {
    double x = f.left + wide * ((double)category + 0.05) + slot / 2;
    const double end = x + wide - slot;
    for (size_t k = 0; k < p->n; k++)
      for (size_t i = 0; i < p->series[k]->n && !p->series[k]->hidden; i++) {
        const gg_chart_point *a = &p->series[k]->point[i];
        char text[48], style[64];
        if (lround(a->x) != (long)category + 1 || x > end || !(above ? a->y > p->y.to : a->y < p->y.from)) continue;
        snprintf(text, sizeof text, "%s %.3g", above ? "→" : "←", a->y);
        snprintf(style, sizeof style, "%s rotate by 90 tc rgb '#%06x'", above ? "right" : "left",
                 p->series[k]->look.colour);
        gg_plot_page_small_text(page, x, above ? f.top + 4 : f.top + f.tall - 4, style, text);
        x += slot;
      }
  }
}

/* Symbols below the axis, in turn in up to three rows if they are wide, and words below them if all have room. */
static void print_categories(const gg_page *page, const gg_chart_panel *p, gg_box f)
{
  const double n = (double)p->n_categories, wide = f.wide / (n + 0.1), small = 6.5;
  size_t word = 0, symbol = 0;
  for (size_t i = 0; i < p->n_categories; i++) {
    if (strlen(p->word[i]) > word) word = strlen(p->word[i]);
    if (strlen(p->symbol[i]) > symbol) symbol = strlen(p->symbol[i]);
  }
  const size_t rows = (size_t)fmin(3, 1 + floor((double)symbol * GG_LETTER / wide));
  for (size_t i = 0; i < p->n_categories; i++) {
    const double x = f.left + wide * ((double)i + 0.55), y = f.top + f.tall;
    gg_plot_page_text(page, x, y + 14 + GG_ROW * (double)(i % rows), "center", p->symbol[i]);
    if (rows == 1 && (double)word * small < wide)
      gg_plot_page_small_text(page, x, y + 32, "center noenhanced", p->word[i]);
    if (i)
      fprintf(page->script, "set arrow from %g,graph 0 to %g,graph 1 nohead back lc rgb '#eeeeee' lw 0.8\n",
              (double)i + 0.5, (double)i + 0.5);
  }
  fprintf(page->script,
          "unset xtics\nset xrange [0.45:%g]\nset arrow from graph 0,first %g to graph 1,first %g nohead back lc rgb "
          "'#888888' lw 1\n",
          n + 0.55, p->level, p->level);
}

static void label_axis(const gg_page *page, const gg_chart_axis *a, double x, double y, const char *style)
{
  char unit[96], text[400];
  gg_plot_text_unit(a->unit ? a->unit : "1", unit, sizeof unit);
  if (strcmp(unit, "1") == 0)
    snprintf(text, sizeof text, "%s", a->label ? a->label : "");
  else
    snprintf(text, sizeof text, "%s\u00a0[%s]", a->label ? a->label : "", unit);
  gg_plot_page_text(page, x, y, style, text);
}

static void draw_panel(const gg_page *page, const gg_chart *c, const layout *l, size_t i)
{
  const gg_chart_panel *p = c->panel[i];
  const gg_box f = l->panel[i].frame;
  size_t points = 0;
  double top = f.top - l->panel[i].head + ABOVE;
  gg_plot_page_panel(page, f, false);
  if (i == 0) { /* what belongs to the page */
    const double middle = l->page[0] / 2;
    gg_plot_page_rows(page, middle, MARGIN, l->page[0], "center noenhanced", c->title);
    gg_plot_page_legend(page, LEFT, l->legend, l->page[0] - LEFT - RIGHT, l->entry, l->n);
    gg_plot_page_rows(page, middle, l->note, l->page[0], "center noenhanced tc rgb '#444444'", c->note);
  }
  top += gg_plot_page_rows(page, f.left, top, f.wide + RIGHT, "left", p->title);
  gg_plot_page_legend(page, f.left, top, f.wide + RIGHT, l->panel[i].entry, l->panel[i].n);
  label_axis(page, &p->y, f.left - LEFT + MARGIN, f.top - 15, "left tc rgb '#222222'");
  label_axis(page, &p->x, f.left + f.wide / 2, f.top + f.tall + 40, "center tc rgb '#222222'");
  gg_plot_axis_print(page->script, 'y', &p->y);
  if (p->n_categories)
    print_categories(page, p, f), label_outliers(page, p, f, true), label_outliers(page, p, f, false);
  else
    gg_plot_axis_print(page->script, 'x', &p->x);
  if (p->shade[1] > p->shade[0])
    fprintf(page->script,
            "set object 1 rectangle from %.9g,graph 0 to %.9g,graph 1 behind fc rgb '#eef2f5' fs solid noborder\n",
            p->shade[0], p->shade[1]);
  for (size_t k = 0; k < p->n; k++) {
    print_data(page->script, p, k, p->n_categories ? offset_of(p, k) : 0);
    points += p->series[k]->n;
  }
  if (p->own_legend && !points)
    gg_plot_page_text(page, f.left + f.wide / 2, f.top + f.tall / 2, "center tc rgb '#666666'", "not enough samples");
  plot_series(page, p);
}

static gg_status draw(const gg_chart *c, layout *l, const gg_plot_paper *paper, const char *picture, gg_error *err)
{
  gg_page page;
  lay_out(c, paper->width, l);
  const bool open = gg_plot_page_open(&page, paper, l->page[0], l->page[1]);
  for (size_t i = 0; i < c->n && open; i++) draw_panel(&page, c, l, i);
  return gg_plot_page_finish(&page, open && !c->lacks, picture, err);
}

gg_status gg_plot_chart_finish(gg_chart *c, const gg_plot_paper *paper, const char *picture, gg_error *err)
{
  GG_FREED layout *l = calloc(1, sizeof *l);
  bool whole = l != NULL;
  for (size_t i = 0; i < c->n && whole; i++) {
    gg_plot_axes_choose(c->panel[i]);
    if (!c->panel[i]->own_legend) continue;
    whole = (l->panel[i].entry = calloc(MOST_ENTRIES, sizeof *l->entry)) != NULL;
    if (whole) l->panel[i].n = gg_plot_looks_choose(c, c->panel[i], l->panel[i].entry, MOST_ENTRIES);
  }
  if (whole) l->n = gg_plot_looks_choose(c, NULL, l->entry, MOST_ENTRIES);
  gg_status status = !whole  ? gg_base_out_of_memory(err)
                     : !c->n ? GG_REFUSE(err, "%s: there is nothing to draw", picture)
                             : draw(c, l, paper, picture, err);
  for (size_t i = 0; l && i < c->n; i++) free(l->panel[i].entry);
  gg_plot_chart_free(c);
  return status;
}
