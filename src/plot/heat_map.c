/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/heat_map.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/page.h"

/* Layout pixels: cells, the least size of a cell with a number and of a panel with the name of its row, the room around
 * panels, and the colour bar. */
enum { CELL_WIDE = 42, CELL_TALL = 22, LEAST_WIDE = 34, LEAST_TALL = 140 };
enum { LEFT = 92, RIGHT = 16, BETWEEN = 16, ABOVE = 42, BELOW = 134, BAR_WIDE = 440, BAR_TALL = 13, BAR_BELOW = 46 };

static const char caption[] = "lines at 1 % (dashed), 5 % and 20 % (thick); hatched: below two standard errors; red: × "
                              "not steady, ▲ clustered or swirling, ◆ collapsed";

#define SMALLEST 0.005
#define LARGEST 1.0

double gg_plot_heat_place(double value)
{
  const double place = log1p(fabs(value) / SMALLEST) / log1p(LARGEST / SMALLEST);
  return copysign(fmin(place, 1), value);
}

/* Colour between white and the darkest of its sign. Both signs have equal lightness, so that a grey print shows sizes.
 */
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
  gg_page page;
  double wide, tall, left, above; /* of a cell; before and above the first panel */
  double caption;                 /* height of its rows */
} heat_page;

static bool is_known(const gg_heat_cell *c)
{
  return isfinite(c->value);
}

static void print_number(const heat_page *p, const gg_heat_cell *c, double x, double y)
{
  char text[16];
  const double percent = 100 * c->value, size = fabs(percent);
  snprintf(text, sizeof text, size < 0.05 ? "0.0" : size < 9.95 ? "%+.1f" : "%+.0f", percent);
  gg_plot_page_small_text(&p->page, x, y,
                          fabs(gg_plot_heat_place(c->value)) > 0.5 ? "center tc rgb '#ffffff'" : "center", text);
}

/* Three strokes across cells below two standard errors, with the middle left free for the number. */
static void print_hatches(const heat_page *p, const gg_heat_cell *cell)
{
  static const double strokes[][4] = {
      {-0.5, 0.1, 0.18, 0.4}, {-0.5, -0.35, 0.12, 0.15}, {0.38, 0.35, 0.12, 0.15}, {0.32, -0.5, 0.18, 0.4}};
  fprintf(p->page.script, "$hatches << EOD\n");
  for (size_t i = 0; i < p->map->n_x * p->map->n_y; i++)
    for (size_t k = 0; k < 4 && is_known(&cell[i]) && fabs(cell[i].value) < 2 * cell[i].error; k++)
      fprintf(p->page.script, "%g %g %g %g\n", (double)(i % p->map->n_x) + strokes[k][0],
              (double)(i / p->map->n_x) + strokes[k][1], strokes[k][2], strokes[k][3]);
  fprintf(p->page.script, "NaN NaN NaN NaN\nEOD\n");
}

/* Marks in the upper corners: on the right of runs that are not steady, on the left of gases that are not homogeneous.
 */
static void print_marks(const heat_page *p, const gg_heat_cell *cell)
{
  enum { CROSS = 2, TRIANGLE = 9, DIAMOND = 13 };
  fprintf(p->page.script, "$marks << EOD\n");
  for (size_t i = 0; i < p->map->n_x * p->map->n_y; i++) {
    const double x = (double)(i % p->map->n_x), y = (double)(i / p->map->n_x) + 0.27;
    if (is_known(&cell[i]) && cell[i].not_steady) fprintf(p->page.script, "%g %g %d\n", x + 0.36, y, CROSS);
    if (is_known(&cell[i]) && cell[i].structure)
      fprintf(p->page.script, "%g %g %d\n", x - 0.38, y, cell[i].structure == 'c' ? TRIANGLE : DIAMOND);
  }
  fprintf(p->page.script, "NaN NaN NaN\nEOD\n");
}

/* A line between two cells, one below and one above `level`. Cells without a number have no lines. */
static void print_edge(const heat_page *p, const gg_heat_cell *a, const gg_heat_cell *b, double level, const char *edge,
                       double x, double y)
{
  if (is_known(a) && is_known(b) && (fabs(a->value) > level) != (fabs(b->value) > level))
    fprintf(p->page.script, "%g %g %s\n", x, y, edge);
}

static void print_lines(const heat_page *p, const gg_heat_cell *cell, const char *name, double level)
{
  const size_t n_x = p->map->n_x, n = n_x * p->map->n_y;
  fprintf(p->page.script, "$%s << EOD\n", name);
  for (size_t i = 0; i < n; i++) {
    const double x = (double)(i % n_x), y = (double)(i / n_x);
    if (i % n_x + 1 < n_x) print_edge(p, &cell[i], &cell[i + 1], level, "0 1", x + 0.5, y - 0.5);
    if (i + n_x < n) print_edge(p, &cell[i], &cell[i + n_x], level, "1 0", x - 0.5, y + 0.5);
  }
  fprintf(p->page.script, "NaN NaN NaN NaN\nEOD\n");
}

/* Names over the first row and before the first column, values of the axes below the last row and there. */
static void print_names(const heat_page *p, gg_box f, size_t row, size_t column)
{
  const gg_heat_map *m = p->map;
  const double middle = f.top + f.tall / 2, below = f.top + f.tall;
  char text[64];
  for (size_t i = 0; i < m->n_x && row + 1 == m->rows; i++) {
    gg_plot_text_escape(m->x_value[i], text, sizeof text);
    gg_plot_page_small_text(&p->page, f.left + p->wide * ((double)i + 0.5), below + 12,
                            p->wide < LEAST_WIDE ? "right rotate by 90" : "center", text);
  }
  for (size_t i = 0; i < m->n_y && column == 0; i++) {
    gg_plot_text_escape(m->y_value[i], text, sizeof text);
    gg_plot_page_small_text(&p->page, f.left - 6, below - p->tall * ((double)i + 0.5), "right", text);
  }
  if (row + 1 == m->rows) gg_plot_page_text(&p->page, f.left + f.wide / 2, below + 46, "center", m->x_label);
  if (column == 0) {
    gg_plot_page_small_text(&p->page, f.left - 76, middle, "center rotate by 90", m->row_name[row]);
    gg_plot_page_text(&p->page, f.left - 56, middle, "center", m->y_label);
  }
  if (row == 0) gg_plot_page_text(&p->page, f.left + f.wide / 2, f.top - 22, "center", m->column_name[column]);
}

static void draw_panel(const heat_page *p, size_t row, size_t column)
{
  const gg_heat_map *m = p->map;
  const gg_heat_cell *cell = m->cell + (row * m->columns + column) * m->n_x * m->n_y;
  const double wide = (double)m->n_x * p->wide, tall = (double)m->n_y * p->tall;
  const gg_box f = {p->left + (double)column * (wide + BETWEEN), p->above + (double)row * (tall + BETWEEN), wide, tall};
  FILE *s = p->page.script;
  size_t known = 0;
  gg_plot_page_panel(&p->page, f, true);
  if (!row && !column)
    gg_plot_page_rows(&p->page, p->page.size[0] / 2, 4, p->page.size[0], "center noenhanced", m->title);
  print_names(p, f, row, column);
  fprintf(s, "unset xtics\nunset ytics\nset xrange [-0.5:%g]\nset yrange [-0.5:%g]\n$cells << EOD\n",
          (double)m->n_x - 0.5, (double)m->n_y - 0.5);
  for (size_t i = 0; i < m->n_x * m->n_y; i++)
    if (is_known(&cell[i]))
      known++, fprintf(s, "%zu %zu %u\n", i % m->n_x, i / m->n_x, gg_plot_heat_colour(cell[i].value));
  fprintf(s, "NaN NaN NaN\nEOD\n");
  for (size_t i = 0; i < m->n_x * m->n_y && p->wide >= LEAST_WIDE; i++)
    if (is_known(&cell[i]))
      print_number(p, &cell[i], f.left + p->wide * ((double)(i % m->n_x) + 0.5),
                   f.top + tall - p->tall * ((double)(i / m->n_x) + 0.5));
  if (!known) gg_plot_page_text(&p->page, f.left + wide / 2, f.top + tall / 2, "center tc rgb '#777777'", "no answer");
  if (m->panel_note && m->panel_note[row * m->columns + column])
    gg_plot_page_small_text(&p->page, f.left + wide, f.top - 7, "right tc rgb '#555555'",
                            m->panel_note[row * m->columns + column]);
  print_hatches(p, cell);
  print_marks(p, cell);
  print_lines(p, cell, "lines1", 0.01), print_lines(p, cell, "lines5", 0.05), print_lines(p, cell, "lines20", 0.2);
  fprintf(s, "plot $cells using 1:2:(0.5):(0.5):3 with boxxyerror lc rgb variable fs solid noborder, $hatches using "
             "1:2:3:4 with vectors nohead lc rgb '#888888' lw 0.7, $lines1 using 1:2:3:4 with vectors nohead lc rgb "
             "'#000000' lw 0.8 dt (3,2), $lines5 using 1:2:3:4 with vectors nohead lc rgb '#000000' lw 1.3, $lines20 "
             "using 1:2:3:4 with vectors nohead lc rgb '#000000' lw 2.8, $marks using 1:2:3 with points pt variable ps "
             "0.95 lw 3 lc rgb '#ffffff', $marks using 1:2:3 with points pt variable ps 0.6 lw 1.2 lc rgb '#d00000'\n");
}

/* The scale of colours, and the meaning of lines, hatches and marks. */
static void draw_bar(const heat_page *p)
{
  static const double tics[] = {-1, -0.2, -0.05, -0.01, 0, 0.01, 0.05, 0.2, 1};
  enum { STEPS = 120 };
  const double middle = p->page.size[0] / 2, wide = fmin(BAR_WIDE, p->page.size[0] - 40);
  const gg_box f = {middle - wide / 2, p->page.size[1] - BAR_BELOW - BAR_TALL, wide, BAR_TALL};
  FILE *s = p->page.script;
  gg_plot_page_panel(&p->page, f, true);
  fprintf(s, "$bar << EOD\n");
  for (int i = 0; i < STEPS; i++) {
    const double at = (2 * i + 1.0) / STEPS - 1, value = SMALLEST * expm1(fabs(at) * log1p(LARGEST / SMALLEST));
    fprintf(s, "%.5g 0 %u\n", at, gg_plot_heat_colour(copysign(value, at)));
  }
  fprintf(s, "EOD\nset xrange [-1:1]\nset yrange [-1:1]\nunset xtics\nunset ytics\n");
  for (size_t i = 0; i < sizeof tics / sizeof *tics; i++) {
    char text[16];
    snprintf(text, sizeof text, "%g", 100 * tics[i]);
    gg_plot_page_small_text(&p->page, middle + wide / 2 * gg_plot_heat_place(tics[i]), f.top + BAR_TALL + 10, "center",
                            text);
  }
  gg_plot_page_text(&p->page, middle, f.top + BAR_TALL + 30, "center", "deviation [%]");
  gg_plot_page_rows(&p->page, middle, f.top - p->caption - 6, p->page.size[0], "center", caption);
  fprintf(s, "plot $bar using 1:2:(%g):(1):3 with boxxyerror lc rgb variable fs solid noborder\n", 1.5 / STEPS);
}

/* Cells have their own width, or fill the paper. */
static void lay_out(heat_page *p, const gg_plot_paper *paper)
{
  const gg_heat_map *m = p->map;
  const double others = LEFT + RIGHT + ((double)m->columns - 1) * BETWEEN, cells = (double)(m->columns * m->n_x);
  const double least = BAR_WIDE + 260, width = paper->width;
  p->wide = width > 0 ? fmax((width - others) / cells, 4) : CELL_WIDE;
  p->tall = fmax(CELL_TALL, LEAST_TALL / (double)m->n_y);
  p->page.size[0] = width > 0 ? width : fmax(others + cells * p->wide, least);
  p->above = ABOVE + gg_plot_page_rows(NULL, 0, 0, p->page.size[0], "", m->title);
  p->caption = gg_plot_page_rows(NULL, 0, 0, p->page.size[0], "", caption);
  p->page.size[1] = p->above + BELOW + p->caption + (double)m->rows * ((double)m->n_y * p->tall + BETWEEN) - BETWEEN;
  p->left = LEFT + (p->page.size[0] - others - cells * p->wide) / 2;
}

gg_status gg_plot_heat_map_draw(const gg_heat_map *m, const char *picture, const char *width, gg_error *err)
{
  gg_plot_paper paper;
  heat_page p = {.map = m};
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, width, err));
  lay_out(&p, &paper);
  const bool open = gg_plot_page_open(&p.page, &paper, p.page.size[0], p.page.size[1]);
  for (size_t row = 0; row < m->rows && open; row++)
    for (size_t column = 0; column < m->columns; column++) draw_panel(&p, row, column);
  if (open) draw_bar(&p);
  return gg_plot_page_finish(&p.page, open, picture, err);
}
