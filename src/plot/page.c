/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/page.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "files/text_format.h"
#include "io/file_writer.h"
#include "scene/scene_reader.h"

const unsigned gg_plot_colours[GG_PLOT_COLOURS] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                                   0xe69f00, 0x56b4e9, 0x000000, 0x8c6d31};

/* 300 pixels an inch where the width is given, else 1.5 for one of the layout. On paper letters have 8 points where on
 * a screen 12 pixels are 9 points. */
double gg_plot_page_scale(const gg_plot_paper *paper)
{
  const bool given = paper->width > 0;
  return paper->format == GG_PLOT_PNG ? (given ? 300 / 108.0 : 1.5) : given ? 8 / 9.0 : 1;
}

/* Inches of pixels; gnuplot drops parts of points. */
static double whole_points(double pixels)
{
  return (round(pixels * 72 / 96) + 0.1) / 72;
}

/* pdfcairo takes the size of letters at 96 dots per inch, and the page at 72: hence its scale of fonts. */
static void print_terminal(const gg_page *p)
{
  const double scale = gg_plot_page_scale(p->paper), width = p->size[0] * scale, height = p->size[1] * scale;
  if (p->paper->format == GG_PLOT_PNG)
    fprintf(p->script,
            "set terminal pngcairo enhanced font 'DejaVu Sans,9' size %.0f,%.0f fontscale %g linewidth %g "
            "pointscale %g background '#ffffff'\n",
            width, height, scale, scale, scale);
  else if (p->paper->format == GG_PLOT_PDF)
    fprintf(p->script,
            "set terminal pdfcairo enhanced font 'DejaVu Sans,%g' fontscale 0.75 size %.6g,%.6g linewidth %g "
            "pointscale %g\n",
            9 * scale, whole_points(width), whole_points(height), 1.5 * scale, 0.75 * scale);
  else
    fprintf(p->script,
            "set terminal svg enhanced font 'DejaVu Sans,%.3g' size %.0f,%.0f linewidth %.3g background '#ffffff'\n",
            12 * scale, width, height, scale);
}

bool gg_plot_page_open(gg_page *p, const gg_plot_paper *paper, double width, double height)
{
  *p = (gg_page){.paper = paper, .size = {width, height}};
  p->script = gg_base_memory_stream_open(&p->text);
  if (p->script && paper->format == GG_PLOT_SVG) p->over = gg_base_memory_stream_open(&p->over_text);
  if (!p->script || (!p->over && paper->format == GG_PLOT_SVG)) return false;
  print_terminal(p);
  fprintf(p->script, "set encoding utf8\nset errorbars small\n"
                     "set pointintervalbox 0\nunset key\nset multiplot\n");
  return true;
}

/* Write the script to a file; it draws the SVG of the same name. A letter of the name that could mean something to
 * gnuplot is written by its code. */
static gg_status write_script(const char *script, const char *path, gg_error *err)
{
  gg_atomic_file file;
  gg_file_writer out;
  char code[8];
  const char *slash = strrchr(path, '/');
  GG_TRY(gg_io_atomic_open(&file, path, false, err));
  gg_io_file_writer_begin(&out, &file, err);
  gg_io_file_writer_put(&out, "# `gnuplot FILE.gp` draws FILE.svg. For PNG or PDF change `set terminal` and the name "
                              "after `set output`.\nset output \"");
  for (const char *c = slash ? slash + 1 : path; *c && strcmp(c, ".gp") != 0; c++) {
    snprintf(code, sizeof code, strchr("_-.", *c) || isalnum((unsigned char)*c) ? "%c" : "\\%03o", (unsigned char)*c);
    gg_io_file_writer_put(&out, code);
  }
  gg_io_file_writer_put(&out, ".svg\"\n");
  gg_io_file_writer_put(&out, script);
  const gg_status status = gg_io_file_writer_end(&out);
  return gg_io_atomic_commit(&file, status, err);
}

gg_status gg_plot_page_finish(gg_page *p, bool whole, const char *picture, gg_error *err)
{
  if (p->script) fprintf(p->script, "unset multiplot\n");
  whole &= gg_base_memory_stream_close(p->script, &p->text);
  if (p->over) whole &= gg_base_memory_stream_close(p->over, &p->over_text);
  const char *over = p->over_text && *p->over_text ? p->over_text : NULL;
  gg_status status = !whole                           ? gg_base_out_of_memory(err)
                     : p->paper->format == GG_PLOT_GP ? write_script(p->text, picture, err)
                                                      : gg_plot_gnuplot_run(p->text, over, picture, err);
  free(p->text);
  free(p->over_text);
  return status;
}

void gg_plot_page_panel(const gg_page *p, gg_box f, bool four_sides)
{
  fprintf(p->script,
          "set lmargin at screen %.6g\nset rmargin at screen %.6g\nset bmargin at screen %.6g\n"
          "set tmargin at screen %.6g\nunset object\nunset label\nunset arrow\nunset logscale\nset xtics auto\n"
          "set ytics auto\nset tics nomirror out scale 0.6 textcolor rgb '#222222'\nset format '%%h'\nset border %d lc "
          "rgb '#444444'\n%s\n",
          f.left / p->size[0], (f.left + f.wide) / p->size[0], 1 - (f.top + f.tall) / p->size[1],
          1 - f.top / p->size[1], four_sides ? 15 : 3,
          four_sides ? "unset grid" : "set grid ytics lc rgb '#e4e4e4' lt 1 lw 0.8");
}

/* The inside of a text in single quotes. A newline would end the text, and what comes next be a command. A single quote
 * cannot be escaped in all places. SVG loses a space behind an index, except for a no-break space. */
static void print_text(FILE *s, const char *text)
{
  bool index = false;
  for (const char *c = text; *c; c++) {
    index |= *c == '_' || *c == '^';
    if (*c == '\'')
      fputs("’", s);
    else if (*c == ' ' && index)
      fputs("\u00a0", s), index = false;
    else
      fputc((unsigned char)*c >= ' ' ? *c : ' ', s);
  }
}

void gg_plot_page_text(const gg_page *p, double x, double y, const char *style, const char *text)
{
  if (!text || !*text) return;
  fprintf(p->script, "set label '");
  print_text(p->script, text);
  fprintf(p->script, "' at screen %.6g,%.6g front %s\n", x / p->size[0], 1 - y / p->size[1], style);
}

void gg_plot_page_small_text(const gg_page *p, double x, double y, const char *style, const char *text)
{
  char small[96];
  const double scale = p->paper->format == GG_PLOT_PNG ? 0.75 : gg_plot_page_scale(p->paper);
  snprintf(small, sizeof small, "%s font ',%.3g'", style, (p->paper->format == GG_PLOT_PDF ? 7.5 : 10) * scale);
  gg_plot_page_text(p, x, y, small, text);
}

/* Bytes of the first row of a text: up to a blank, or without one up to a letter, outside of braces. */
static size_t row_of(const char *text, int letters)
{
  size_t end = 0, blank = 0, last = 0;
  for (int used = 0, depth = 0; text[end]; used++) {
    if (used == letters && last) return blank ? blank : last;
    if (!depth) last = end;
    if (text[end] == ' ' && !depth) blank = end;
    depth += (text[end] == '{') - (text[end] == '}');
    end += text[end] == '\\' && text[end + 1] ? 2 : 1;
    while ((text[end] & 0xc0) == 0x80) end++;
  }
  return end;
}

double gg_plot_page_rows(const gg_page *p, double x, double top, double wide, const char *style, const char *text)
{
  enum { MOST_ROWS = 6 };
  char row[1024];
  int n = 0;
  for (const char *at = text ? text : ""; *at && n < MOST_ROWS; n++) {
    const size_t length = row_of(at, (int)(wide / GG_LETTER) - 1);
    snprintf(row, sizeof row, "%.*s", (int)length, at);
    at += length + (at[length] == ' ');
    if (n + 1 == MOST_ROWS && *at) gg_base_text_append(row, sizeof row, "…");
    if (p) gg_plot_page_text(p, x, top + GG_ROW * (n + 0.5), style, row);
  }
  return GG_ROW * n;
}

void gg_plot_page_look(const gg_page *p, const gg_look *l, bool open)
{
  if (l->style == GG_CHART_POINTS)
    fprintf(p->script, "pt %d ps %g lw 1.2", open ? l->open : l->symbol, l->size);
  else
    fprintf(p->script, "lw 1.5 dt %s", l->dash);
  fprintf(p->script, " lc rgb '#%06x'", l->colour);
}

/* Sample lines are as wide as two periods of the longest dash. Samples in turn differ by a thousandth in width: in SVG
 * gnuplot draws lines of one colour and width that follow each other as one path, with the dash of the first. */
static void print_sample(const gg_page *p, double x, double y, const gg_look *l, int i)
{
  const double left = x / p->size[0], right = (x + 34) / p->size[0], at = 1 - y / p->size[1];
  char line[96];
  snprintf(line, sizeof line, "set arrow from screen %.6g,%.6g to screen %.6g,%.6g nohead", left, at, right, at);
  if (l->shaded) fprintf(p->script, "%s lw 9 lc rgb '#b0%06x'\n", line, l->colour);
  if (l->style != GG_CHART_POINTS) {
    fprintf(p->script, "%s lw %g dt %s lc rgb '#%06x'\n", line, i % 2 ? 1.501 : 1.5, l->dash, l->colour);
    return;
  }
  fprintf(p->script, "set label '' at screen %.6g,%.6g point ", (left + right) / 2, at);
  gg_plot_page_look(p, l, l->hollow);
  fprintf(p->script, "\n");
}

static int letters_of(const char *text)
{
  int n = 0;
  for (const char *c = text; *c; c++) n += (*c & 0xc0) != 0x80 && !strchr("{}\\", *c);
  return n;
}

double gg_plot_page_legend(const gg_page *p, double left, double top, double wide, const gg_legend_entry *entry, int n)
{
  enum { MOST_LETTERS = 40 };
  const double sample = 42, gap = 16;
  int longest = 1;
  for (int i = 0; i < n; i++) longest = (int)fmax(longest, letters_of(entry[i].name));
  if (n > 2) longest = (int)fmin(longest, MOST_LETTERS);
  const double wanted = GG_LETTER * (longest + 1) + sample + gap;
  const int columns = (int)fmax(1, fmin(n, floor(wide / wanted)));
  const double column = fmin(wide / columns, wanted);
  double y = top, tall = 0;
  for (int i = 0; i < n; i++) {
    const double x = left + i % columns * column;
    if (p) print_sample(p, x, y + GG_ROW / 2.0, &entry[i].look, i);
    tall = fmax(tall, gg_plot_page_rows(p, x + sample, y, column - sample, "left", entry[i].name));
    if ((i + 1) % columns == 0 || i + 1 == n) y += tall, tall = 0;
  }
  return y - top;
}

void gg_plot_scene_title(const gg_stored_result *stored, char *title, size_t size)
{
  gg_scene scene = gg_scene_defaults();
  *title = '\0';
  if (gg_scene_read(&scene, stored->scene, strlen(stored->scene), "scene", NULL) == GG_OK)
    gg_files_scene_title(&scene, NULL, title, size);
}

void gg_plot_text_escape(const char *plain, char *text, size_t size)
{
  size_t used = 0;
  for (; *plain && used + 3 < size; plain++) {
    if (strchr("_^{}@&~\\", *plain)) text[used++] = '\\';
    text[used++] = *plain;
  }
  text[used] = '\0';
}

/* SVG loses a space at the end of a run of letters, except for a no-break space. */
void gg_plot_text_unit(const char *unit, char *text, size_t size)
{
  static const char *const signs[][2] = {{"gamma", "γ"}, {"rho", "ρ"}, {" ", "\u00a0"}};
  size_t used = 0, k;
  while (*unit && used + 4 < size) {
    for (k = 0; k < sizeof signs / sizeof *signs && strncmp(unit, signs[k][0], strlen(signs[k][0])) != 0;) k++;
    if (k < sizeof signs / sizeof *signs) {
      used += (size_t)snprintf(text + used, size - used, "%s", signs[k][1]);
      unit += strlen(signs[k][0]);
    } else {
      text[used++] = *unit++;
    }
  }
  text[used] = '\0';
}
