/* What all pages have in common: terminal, title, colours, how a panel is placed, units. */
#include <string.h>

#include "files/text_format.h"
#include "plot/plot.h"
#include "scene/scene_reader.h"

const char *const gg_plot_colours[GG_PLOT_COLOURS] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                      "#E69F00", "#56B4E9", "#000000", "#8C6D31"};

void gg_plot_place(FILE *s, gg_panel p)
{
  fprintf(s,
          "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\nset tmargin at screen %g\n"
          "unset object\nunset label\nunset arrow\nunset logscale\nunset title\nunset offsets\nset xtics auto\nset "
          "xrange [*:*]\n"
          "set yrange [*:*]\nset format x '%%g'\nset format y '%%g'\nset key default\n",
          p.left, p.right, p.bottom, p.top);
}

/* A line's end would end the text, and what comes next be a command. */
static bool is_harmless(char c)
{
  return (unsigned char)c >= ' ';
}

void gg_plot_unit(const char *unit, char *text, size_t size)
{
  size_t used = 0;
  while (*unit && used + 4 < size) {
    if (strncmp(unit, "gamma", 5) == 0) {
      used += (size_t)snprintf(text + used, size - used, "γ");
      unit += 5;
    } else if (strncmp(unit, "rho", 3) == 0) {
      used += (size_t)snprintf(text + used, size - used, "ρ");
      unit += 3;
    } else {
      text[used++] = is_harmless(*unit) && *unit != '\'' ? *unit : ' ';
      unit++;
    }
  }
  text[used] = '\0';
}

static void start(FILE *s, bool png, int width, int height)
{
  if (png)
    fprintf(s,
            "set terminal pngcairo enhanced font 'DejaVu Sans,12' size %d,%d fontscale 1.25 linewidth 1.5 "
            "pointscale 1.4 background '#ffffff'\n",
            (int)(width * GG_PLOT_PNG_SCALE), (int)(height * GG_PLOT_PNG_SCALE));
  else
    fprintf(s, "set terminal svg enhanced font 'DejaVu Sans,12' size %d,%d background '#ffffff'\n", width, height);
  fprintf(s, "set encoding utf8\nset border 3 lc rgb '#444444'\nset errorbars small\nset tics nomirror out textcolor "
             "rgb '#222222'\n"
             "set grid ytics lc rgb '#e4e4e4' lt 1 lw 0.8\n");
}

void gg_plot_open_page(FILE *s, const char *title, bool png, int width, int height)
{
  start(s, png, width, height);
  fprintf(s, "set multiplot");
  if (title && *title) {
    fprintf(s, " title '");
    gg_plot_text(s, title);
    fprintf(s, "' noenhanced font ',14'");
  }
  fprintf(s, "\n");
}

void gg_plot_start_page(FILE *s, const gg_stored_result *stored, bool png, int width, int height)
{
  gg_scene scene = gg_scene_defaults();
  char title[240] = "";
  if (gg_scene_read(&scene, stored->scene, strlen(stored->scene), "scene", NULL) == GG_OK)
    gg_files_scene_title(&scene, title, sizeof title);
  gg_plot_open_page(s, title, png, width, height);
}

/* Within single quotes; gnuplot does not read a doubled one at a text's beginning. */
static void put(FILE *s, char c)
{
  if (c == '\'')
    fputs("’", s);
  else
    fputc(is_harmless(c) ? c : ' ', s);
}

void gg_plot_text(FILE *s, const char *text)
{
  for (const char *c = text; *c; c++) put(s, *c);
}

void gg_plot_plain_text(FILE *s, const char *text)
{
  for (const char *c = text; *c; c++) {
    if (strchr("_^{}@&~\\", *c)) fputc('\\', s);
    put(s, *c);
  }
}
