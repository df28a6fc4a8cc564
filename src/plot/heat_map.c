/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/heat_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "plot/plot.h"

/* Layout pixels. */
enum {
  CELL_WIDE = 42,
  LEAST_WIDE = 30 /* for a number */,
  CELL_TALL = 22,
  LEAST_TALL = 140 /* of a panel, for the name of its row */,
  LEFT = 92,
  RIGHT = 16,
  BETWEEN = 14,
  ABOVE = 66,
  BELOW = 140
};
/* Height of the colour bar's frame, and where its lower edge stands. */
enum { BAR_TALL = 13, BAR_AT = 46, BAR_WIDE = 440 };

#define SMALLEST 0.005
#define LARGEST 1.0
static const double lines[] = {0.01, 0.05, 0.2}; /* between cells on either side of these */
enum { N_LINES = sizeof lines / sizeof *lines };

double gg_plot_heat_place(double value)
{
  const double place = log1p(fabs(value) / SMALLEST) / log1p(LARGEST / SMALLEST);
  return copysign(fmin(place, 1), value);
}

/* Between white and the darkest, of either sign: of equal lightness at equal places, so that grey tells how large. */
unsigned gg_plot_heat_colour(double value)
{
  static const unsigned shades[2][4] = {{0xffffff, 0x9dc3e6, 0x3f7fbf, 0x0b3566},
                                        {0xffffff, 0xe8b878, 0xb8681a, 0x5e2b00}};
  const double at = fabs(gg_plot_heat_place(value)) * 3;
  const int low = (int)fmin(at, 2);
  unsigned colour = 0;
  for (int shift = 16; shift >= 0; shift -= 8) {
    const double a = (double)(shades[value > 0][low] >> shift & 0xff),
                 b = (double)(shades[value > 0][low + 1] >> shift & 0xff);
    colour |= (unsigned)lround(a + (at - low) * (b - a)) << shift;
  }
  return colour;
}

typedef struct heat_page {
  const gg_heat_map *map;
  FILE *script;
  double size[2], wide, tall, left; /* of the page, of a cell, before the first panel */
} heat_page;

static const gg_heat_cell *cells_of(const gg_heat_map *m, size_t row, size_t column)
{
  return m->cell + (row * m->columns + column) * m->n_x * m->n_y;
}

static bool is_known(const gg_heat_cell *c)
{
  return isfinite(c->value);
}

static void print_percent(double value, char text[16])
{
  const double percent = 100 * value, size = fabs(percent);
  snprintf(text, 16, size < 9.95 ? "%+.1f" : "%+.0f", percent);
  if (size < 0.05) snprintf(text, 16, "0.0");
}

/* Cells with their colours and numbers; letters are white on dark ones. */
static void print_cells(const heat_page *p, const gg_heat_cell *cell)
{
  fprintf(p->script, "$cells << EOD\n");
  for (size_t i = 0; i < p->map->n_x * p->map->n_y; i++) {
    char number[16];
    if (!is_known(&cell[i])) continue;
    print_percent(cell[i].value, number);
    fprintf(p->script, "%zu %zu %u %s %u\n", i % p->map->n_x, i / p->map->n_x, gg_plot_heat_colour(cell[i].value),
            number, fabs(gg_plot_heat_place(cell[i].value)) > 0.5 ? 0xffffffu : 0x000000u);
  }
  fprintf(p->script, "EOD\n");
}

/* Three strokes across a cell, left free in the middle for the number. */
static void print_hatches(const heat_page *p, const gg_heat_cell *cell)
{
  static const double strokes[][4] = {
      {-0.5, 0.1, 0.18, 0.4}, {-0.5, -0.35, 0.12, 0.15}, {0.38, 0.35, 0.12, 0.15}, {0.32, -0.5, 0.18, 0.4}};
  fprintf(p->script, "$hatches << EOD\n");
  for (size_t i = 0; i < p->map->n_x * p->map->n_y; i++) {
    if (!is_known(&cell[i]) || !(fabs(cell[i].value) < 2 * cell[i].error)) continue;
    for (size_t k = 0; k < sizeof strokes / sizeof *strokes; k++)
      fprintf(p->script, "%g %g %g %g\n", (double)(i % p->map->n_x) + strokes[k][0],
              (double)(i / p->map->n_x) + strokes[k][1], strokes[k][2], strokes[k][3]);
  }
  fprintf(p->script, "NaN NaN NaN NaN\nEOD\n");
}

/* In the upper corners: on the right what is not steady, on the left what is not homogeneous. */
static void print_marks(const heat_page *p, const gg_heat_cell *cell)
{
  enum { CROSS = 2, TRIANGLE = 9, DIAMOND = 13 };
  fprintf(p->script, "$marks << EOD\n");
  for (size_t i = 0; i < p->map->n_x * p->map->n_y; i++) {
    const double x = (double)(i % p->map->n_x), y = (double)(i / p->map->n_x) + 0.27;
    if (is_known(&cell[i]) && cell[i].not_steady) fprintf(p->script, "%g %g %d\n", x + 0.36, y, CROSS);
    if (is_known(&cell[i]) && cell[i].structure)
      fprintf(p->script, "%g %g %d\n", x - 0.38, y, cell[i].structure == 'c' ? TRIANGLE : DIAMOND);
  }
  fprintf(p->script, "NaN NaN NaN\nEOD\n");
}

/* An edge between two cells where one is on each side of a line; unknown cells have no lines. */
static void print_edge(const heat_page *p, const gg_heat_cell *a, const gg_heat_cell *b, double line,
                       const double at[4])
{
  if (is_known(a) && is_known(b) && (fabs(a->value) > line) != (fabs(b->value) > line))
    fprintf(p->script, "%g %g %g %g\n", at[0], at[1], at[2], at[3]);
}

static void print_lines(const heat_page *p, const gg_heat_cell *cell)
{
  const size_t n_x = p->map->n_x, n_y = p->map->n_y;
  for (int k = 0; k < N_LINES; k++) {
    fprintf(p->script, "$lines%d << EOD\n", k);
    for (size_t i = 0; i < n_x * n_y; i++) {
      const double x = (double)(i % n_x), y = (double)(i / n_x);
      if (i % n_x + 1 < n_x) print_edge(p, &cell[i], &cell[i + 1], lines[k], (const double[]){x + 0.5, y - 0.5, 0, 1});
      if (i / n_x + 1 < n_y)
        print_edge(p, &cell[i], &cell[i + n_x], lines[k], (const double[]){x - 0.5, y + 0.5, 1, 0});
    }
    fprintf(p->script, "NaN NaN NaN NaN\nEOD\n");
  }
}

static void print_tics(const heat_page *p, char axis, const char *const *value, size_t n, bool shown)
{
  fprintf(p->script, "set %ctics scale 0 (", axis);
  for (size_t i = 0; i < n; i++) {
    fprintf(p->script, "%s'", i ? ", " : "");
    if (shown) gg_plot_text_print_plain(p->script, value[i]);
    fprintf(p->script, "' %zu", i);
  }
  fprintf(p->script, ")\n");
}

static void place_panel(const heat_page *p, size_t row, size_t column)
{
  const gg_heat_map *m = p->map;
  const double wide = (double)m->n_x * p->wide, tall = (double)m->n_y * p->tall;
  const double left = p->left + (double)column * (wide + BETWEEN), above = ABOVE + (double)row * (tall + BETWEEN);
  gg_plot_page_place(p->script, (gg_panel){left / p->size[0], (left + wide) / p->size[0],
                                           1 - (above + tall) / p->size[1], 1 - above / p->size[1]});
}

/* Names over the first row and before the first column, axes below the last and there. */
static void print_names(const heat_page *p, size_t row, size_t column)
{
  const gg_heat_map *m = p->map;
  const bool last = row + 1 == m->rows, first = column == 0;
  print_tics(p, 'x', m->x_value, m->n_x, last);
  print_tics(p, 'y', m->y_value, m->n_y, first);
  fprintf(p->script, "set xlabel '%s' offset 0,0.4\n", last ? m->x_label : "");
  fprintf(p->script, "set ylabel ''\n");
  if (first)
    fprintf(p->script,
            "set label 1 '%s' at graph 0,0.5 center rotate by 90 offset char -8.6,0\n"
            "set label 2 '%s' at graph 0,0.5 center offset char -5.6,0\n",
            m->row_name[row], m->y_label);
  if (row == 0) fprintf(p->script, "set label 3 '%s' at graph 0.5,1 center offset 0,0.7\n", m->column_name[column]);
}

static bool has_any(const gg_heat_map *m, const gg_heat_cell *cell)
{
  bool any = false;
  for (size_t i = 0; i < m->n_x * m->n_y; i++) any |= is_known(&cell[i]);
  return any;
}

static void draw_panel(const heat_page *p, size_t row, size_t column)
{
  const gg_heat_map *m = p->map;
  const gg_heat_cell *cell = cells_of(m, row, column);
  place_panel(p, row, column);
  print_names(p, row, column);
  fprintf(p->script, "set border 15\nunset grid\nset xrange [-0.5:%g]\nset yrange [-0.5:%g]\n", (double)m->n_x - 0.5,
          (double)m->n_y - 0.5);
  if (!has_any(m, cell)) {
    fprintf(p->script, "set label 4 '%s' at graph 0.5,0.5 center textcolor rgb '#777777'\nplot NaN notitle\n",
            (double)m->n_x * p->wide > 130 ? "nothing to compare" : "nothing");
    return;
  }
  const char *note = m->panel_note ? m->panel_note[row * m->columns + column] : NULL;
  if (note)
    fprintf(p->script, "set label 5 '%s' at graph 1,1 right offset 0,0.35 font ',7' textcolor rgb '#555555'\n", note);
  print_cells(p, cell);
  print_hatches(p, cell);
  print_marks(p, cell);
  print_lines(p, cell);
  fprintf(p->script,
          "plot $cells using 1:2:(0.5):(0.5):3 with boxxyerror lc rgb variable fs solid noborder notitle, "
          "$hatches using 1:2:3:4 with vectors nohead lc rgb '#888888' lw 0.7 notitle, "
          "$lines0 using 1:2:3:4 with vectors nohead lc rgb '#000000' lw 0.8 dt (3,2) notitle, "
          "$lines1 using 1:2:3:4 with vectors nohead lc rgb '#000000' lw 1.3 notitle, "
          "$lines2 using 1:2:3:4 with vectors nohead lc rgb '#000000' lw 2.8 notitle, "
          "$marks using 1:2:3 with points pt variable ps 0.95 lw 3 lc rgb '#ffffff' notitle, "
          "$marks using 1:2:3 with points pt variable ps 0.6 lw 1.2 lc rgb '#d00000' notitle%s\n",
          p->wide < LEAST_WIDE ? "" : ", $cells using 1:2:4:5 with labels textcolor rgb variable font ',8' notitle");
}

/* The scale, and what lines, hatches and crosses mean. */
static void draw_bar(const heat_page *p)
{
  static const double tics[] = {-1, -0.2, -0.05, -0.01, 0, 0.01, 0.05, 0.2, 1};
  enum { STEPS = 120 };
  const double left = (p->size[0] - BAR_WIDE) / 2;
  gg_plot_page_place(p->script, (gg_panel){left / p->size[0], (left + BAR_WIDE) / p->size[0], BAR_AT / p->size[1],
                                           (BAR_AT + BAR_TALL) / p->size[1]});
  fprintf(p->script, "$bar << EOD\n");
  for (int i = 0; i < STEPS; i++) {
    const double at = (2 * i + 1.0) / STEPS - 1, value = SMALLEST * expm1(fabs(at) * log1p(LARGEST / SMALLEST));
    fprintf(p->script, "%.5g 0 %u\n", at, gg_plot_heat_colour(copysign(value, at)));
  }
  fprintf(p->script,
          "EOD\nset border 15\nunset grid\nset ylabel ''\nset xrange [-1:1]\nset yrange [-1:1]\nunset ytics\nset "
          "xtics scale 0.4 (");
  for (size_t i = 0; i < sizeof tics / sizeof *tics; i++)
    fprintf(p->script, "%s'%g' %.6g", i ? ", " : "", 100 * tics[i], gg_plot_heat_place(tics[i]));
  fprintf(p->script,
          ")\nset xlabel 'deviation [%%]' offset 0,0.5\nset label 1 'lines at 1 %% (dashed), 5 %% and 20 %% (thick); "
          "hatched: below two standard errors' at graph "
          "0.5,1 center offset 0,1.7\nset label 2 'red: × not steady, ▲ clustered or swirling, ◆ collapsed' at graph "
          "0.5,1 center offset "
          "0,0.6\nplot $bar using 1:2:(%g):(1):3 with boxxyerror lc rgb variable fs solid noborder "
          "notitle\n",
          1.5 / STEPS);
}

/* Cells are as wide as they like, or as the paper has room for. */
static heat_page lay_out(const gg_heat_map *m, double width, FILE *script)
{
  const double columns = (double)m->columns, others = LEFT + RIGHT + (columns - 1) * BETWEEN,
               cells = columns * (double)m->n_x, least = BAR_WIDE + 260;
  heat_page p = {.map = m,
                 .script = script,
                 .wide = width > 0 ? fmax((width - others) / cells, 4) : CELL_WIDE,
                 .tall = fmax(CELL_TALL, (double)LEAST_TALL / (double)m->n_y)};
  p.size[0] = width > 0 ? width : fmax(others + cells * p.wide, least);
  p.size[1] = ABOVE + BELOW + (double)m->rows * ((double)m->n_y * p.tall + BETWEEN) - BETWEEN;
  p.left = LEFT + (p.size[0] - others - cells * p.wide) / 2;
  return p;
}

static void draw(const gg_heat_map *m, const gg_plot_paper *paper, FILE *script)
{
  const heat_page p = lay_out(m, paper->width, script);
  gg_plot_page_open(script, m->title, paper, p.size[0], p.size[1]);
  for (size_t row = 0; row < m->rows; row++)
    for (size_t column = 0; column < m->columns; column++) draw_panel(&p, row, column);
  draw_bar(&p);
  fprintf(script, "unset multiplot\n");
}

gg_status gg_plot_heat_map_draw(const gg_heat_map *m, const char *picture, const char *width, gg_error *err)
{
  char *text = NULL;
  gg_plot_paper paper;
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, width, err));
  FILE *script = gg_base_memory_stream_open(&text);
  if (!script) return gg_base_out_of_memory(err);
  draw(m, &paper, script);
  gg_status status = gg_base_memory_stream_close(script, &text) ? gg_plot_gnuplot_run(text, NULL, picture, err)
                                                                : gg_base_out_of_memory(err);
  free(text);
  return status;
}
