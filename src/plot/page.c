/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all pages have in common: terminal, title, colours, how a panel is placed, texts. */
#include <math.h>
#include <string.h>

#include "files/text_format.h"
#include "plot/plot.h"
#include "scene/scene_reader.h"

const char *const gg_plot_colours[GG_PLOT_COLOURS] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                      "#E69F00", "#56B4E9", "#000000", "#8C6D31"};

void gg_plot_page_place(FILE *s, gg_panel p)
{
  fprintf(s,
          "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\nset tmargin at screen %g\n"
          "unset object\nunset label\nunset arrow\nunset logscale\nset xtics auto\nset ytics auto\n"
          "set xrange [*:*]\nset yrange [*:*]\nset format x '%%h'\nset format y '%%h'\nunset key\n",
          p.left, p.right, p.bottom, p.top);
}

/* 300 pixels an inch where the width is given, else 1.5 for one of the layout. */
static double png_scale(const gg_plot_paper *paper)
{
  return paper->width > 0 ? 300 / 108.0 : 1.5;
}

double gg_plot_page_scale(const gg_plot_paper *paper)
{
  const double on_paper = 8 / 9.0; /* 8 points of 12 pixels, which are 9 points on a screen */
  return paper->format == GG_PLOT_PNG ? png_scale(paper) : paper->width > 0 ? on_paper : 1;
}

/* Inches of pixels; gnuplot drops parts of points. */
static double whole_points(double pixels)
{
  return (round(pixels * 72 / 96) + 0.1) / 72;
}

static void print_terminal(FILE *s, const gg_plot_paper *paper, double width, double height)
{
  double scale = gg_plot_page_scale(paper);
  if (paper->format == GG_PLOT_PNG)
    fprintf(s,
            "set terminal pngcairo enhanced font 'DejaVu Sans,9' size %.0f,%.0f fontscale %g linewidth %g "
            "pointscale %g background '#ffffff'\n",
            width * scale, height * scale, scale, scale, scale);
  else if (paper->format == GG_PLOT_PDF)
    fprintf(s, "set terminal pdfcairo enhanced font 'DejaVu Sans,%g' size %.6g,%.6g linewidth %g pointscale %g\n",
            9 * scale, whole_points(width * scale), whole_points(height * scale), 1.5 * scale, 0.5 * scale);
  else
    fprintf(s, "set terminal svg enhanced font 'DejaVu Sans,%.3g' size %.0f,%.0f linewidth %.3g background '#ffffff'\n",
            12 * scale, width * scale, height * scale, scale);
}

void gg_plot_page_open(FILE *s, const char *title, const gg_plot_paper *paper, double width, double height)
{
  print_terminal(s, paper, width, height);
  fprintf(s, "set encoding utf8\nset border 3 lc rgb '#444444'\nset errorbars small\nset tics nomirror out textcolor "
             "rgb '#222222'\n"
             "set grid ytics lc rgb '#e4e4e4' lt 1 lw 0.8\nset multiplot");
  if (title && *title) {
    fprintf(s, " title '");
    gg_plot_text_print(s, title);
    fprintf(s, "' noenhanced");
  }
  fprintf(s, "\n");
}

void gg_plot_page_title(const gg_stored_result *stored, char *title, size_t size)
{
  gg_scene scene = gg_scene_defaults();
  *title = '\0';
  if (gg_scene_read(&scene, stored->scene, strlen(stored->scene), "scene", NULL) == GG_OK)
    gg_files_scene_title(&scene, NULL, title, size);
}

/* A line's end would end the text, and what comes next be a command. */
static bool is_harmless(char c)
{
  return (unsigned char)c >= ' ';
}

/* Within single quotes; gnuplot does not read a doubled one at a text's beginning. */
static void put(FILE *s, char c)
{
  if (c == '\'')
    fputs("’", s);
  else
    fputc(is_harmless(c) ? c : ' ', s);
}

void gg_plot_text_print(FILE *s, const char *text)
{
  for (const char *c = text; *c; c++) put(s, *c);
}

void gg_plot_text_print_plain(FILE *s, const char *text)
{
  for (const char *c = text; *c; c++) {
    if (strchr("_^{}@&~\\", *c)) fputc('\\', s);
    put(s, *c);
  }
}

/* A space at the end of a run of letters is lost in SVG, but not one that does not break. */
void gg_plot_text_unit(const char *unit, char *text, size_t size)
{
  static const char *const signs[][2] = {{"gamma", "γ"}, {"rho", "ρ"}, {" ", "\u00a0"}, {"'", " "}};
  size_t used = 0, k;
  while (*unit && used + 4 < size) {
    for (k = 0; k < sizeof signs / sizeof *signs && strncmp(unit, signs[k][0], strlen(signs[k][0])) != 0;) k++;
    if (k < sizeof signs / sizeof *signs) {
      used += (size_t)snprintf(text + used, size - used, "%s", signs[k][1]);
      unit += strlen(signs[k][0]);
    } else {
      text[used++] = is_harmless(*unit) ? *unit : ' ';
      unit++;
    }
  }
  text[used] = '\0';
}
