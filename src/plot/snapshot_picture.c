/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A snapshot: the last stored frame, its grains projected on the planes of shear (x, y) and across it (z, y), to scale.
 * Frames, tics and titles are gnuplot's, and in PNG and PDF the discs. In SVG it would draw each as two polygons of 4
 * kB: there they are put over its page, forty bytes each. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "plot/chart_styles.h"
#include "plot/plot.h"
#include "plot/snapshot_slice.h"
#include "scene/scene_reader.h"

/* Layout pixels: sizes of the panels at most, and of everything between. PNG is made smaller: its bytes are the rims of
 * the discs, some seven for a pixel of the file, where a disc of SVG takes some 44 in all, and one of PDF 700. */
enum { TALL = 520, WIDE = 700, TALL_PNG = 350, WIDE_PNG = 470, LEAST_WIDE = 150, MOST_LEGEND = 8 };
enum { LEFT = 70, BETWEEN = 80, RIGHT = 25, ABOVE = 70, NO_TITLE = 36, BELOW = 65, ROW = 18 };
#define RIM "#2f4f63"

static void read_species(const gg_stored_result *stored, gg_plot_grains *s)
{
  gg_scene scene = gg_scene_defaults();
  for (int k = 0; k < GG_MAX_SPECIES; k++) s->radius[k] = 0.5, s->mass[k] = 1;
  if (gg_scene_read(&scene, stored->scene, strlen(stored->scene), "scene", NULL) != GG_OK) return;
  for (int k = 1; k < scene.n_species; k++) {
    s->radius[k] = 0.5 * scene.species[k].diameter / scene.species[0].diameter;
    s->mass[k] = scene.species[k].mass / scene.species[0].mass;
  }
}

/* The height that holds all grains: of a gas under gravity not the whole box. */
static double top_of(const gg_plot_grains *s)
{
  double top = 0;
  for (size_t i = 0; i < s->n; i++) top = fmax(top, s->position[3 * i + 1]);
  return fmin(s->edge[1], top + 1);
}

/* False if the file holds no positions; Monte Carlo's between walls are heights alone. */
static bool find_grains(const gg_stored_result *stored, gg_plot_grains *s)
{
  const gg_frame *f = &stored->last;
  *s = (gg_plot_grains){.n = f->n, .position = f->position, .species = f->species};
  memcpy(s->edge, stored->edge, sizeof s->edge);
  const bool heights = stored->engine[GG_DSMC].name && !stored->engine[GG_MD].name;
  bool whole = !heights && f->n && f->position && f->species && s->edge[0] > 0 && s->edge[1] > 0;
  for (size_t i = 0; whole && i < f->n; i++) {
    whole = f->species[i] < GG_MAX_SPECIES;
    if (f->species[i] >= s->n_species) s->n_species = f->species[i] + 1;
  }
  if (!whole) return false;
  s->top = top_of(s);
  read_species(stored, s);
  return true;
}

/* Half the colour of its species, half white; where the colours come again, a quarter. */
static unsigned fill_of(int species)
{
  unsigned colour = (unsigned)strtoul(gg_plot_colours[species % GG_PLOT_COLOURS] + 1, NULL, 16);
  return species < GG_PLOT_COLOURS ? (colour >> 1 & 0x7f7f7f) + 0x808080 : (colour >> 2 & 0x3f3f3f) + 0xc0c0c0;
}

/* What the page is made of: gnuplot's script, and in SVG what goes over it. */
typedef struct snapshot_page {
  FILE *script, *over; /* NULL: not SVG */
  const gg_plot_paper *paper;
  double scale, size[2], above; /* layout pixels: a diameter, the page, above a panel */
  bool titled, stacked;         /* panels below each other */
} snapshot_page;

static void print_discs(const snapshot_page *p, const gg_plot_grains *s, const gg_plot_layer *layer, char axis)
{
  fprintf(p->script, "$grains%c << EOD\n", axis);
  for (size_t i = 0; i < layer->n; i++) {
    const gg_plot_disc *d = &layer->disc[i];
    fprintf(p->script, "%.5g %.5g %.4g %u\n", d->x, d->y, s->radius[d->species], fill_of(d->species));
  }
  fprintf(p->script, "EOD\n");
}

/* In diameters, upwards, cut off at the panel's frame. */
static void print_svg_discs(const snapshot_page *p, const gg_plot_grains *s, const gg_plot_layer *layer, int along,
                            const double at[2])
{
  double wide = s->edge[along], tall = s->top, pixels = gg_plot_page_scale(p->paper);
  fprintf(p->over,
          "<svg x='%g' y='%g' width='%g' height='%g' viewBox='0 0 %.9g %.9g'>\n"
          "<g transform='matrix(1 0 0 -1 0 %.9g)' stroke='" RIM "' stroke-width='%.3g'>\n",
          at[0] * pixels, at[1] * pixels, wide * p->scale * pixels, tall * p->scale * pixels, wide, tall, tall,
          0.4 / p->scale);
  for (size_t i = 0; i < layer->n; i++) {
    const gg_plot_disc *d = &layer->disc[i];
    fprintf(p->over, "<use xlink:href='#g%d' x='%.5g' y='%.5g'/>\n", d->species, d->x, d->y);
  }
  fprintf(p->over, "</g></svg>\n");
}

/* Species by their colours; of very many the first. */
static void print_legend(const snapshot_page *p, const gg_plot_grains *s)
{
  fprintf(p->script, "set key at screen 0.5,%g center top horizontal Left reverse samplen 1\nplot NaN notitle",
          1 - (p->titled ? 34 : 6) / p->size[1]);
  for (int k = 0; s->n_species > 1 && k < s->n_species && k < MOST_LEGEND; k++)
    fprintf(p->script, ", keyentry with points pt 7 ps 1.2 lc rgb '#%06x' title 'species %d: σ = %.3g, m = %.3g'",
            fill_of(k), k + 1, 2 * s->radius[k], s->mass[k]);
  if (s->n_species > MOST_LEGEND) fprintf(p->script, ", keyentry title '… %d species'", s->n_species);
}

static gg_disc_cost cost_of(const snapshot_page *p)
{
  const double pixels = gg_plot_page_scale(p->paper);
  if (p->paper->format == GG_PLOT_PNG) return (gg_disc_cost){8, 7 * M_PI * pixels * p->scale};
  return (gg_disc_cost){p->over ? 44 : 700, 0};
}

/* `at`: the left upper corner of its frame. */
static bool draw_panel(const snapshot_page *p, const gg_plot_grains *s, int along, const double at[2])
{
  int across = along == 0 ? 2 : 0;
  char axis = along == 0 ? 'x' : 'z';
  double wide = s->edge[along] * p->scale, tall = s->top * p->scale;
  gg_plot_layer layer;
  if (!gg_plot_layer_make(&layer, s, along, across, cost_of(p))) return false;
  gg_plot_page_place(p->script, (gg_panel){at[0] / p->size[0], (at[0] + wide) / p->size[0],
                                           1 - (at[1] + tall) / p->size[1], 1 - at[1] / p->size[1]});
  if (!layer.whole)
    fprintf(p->script, "set label 'grains at %c < %.2g d' at graph 0,1 left offset 0,0.7\n", along == 0 ? 'z' : 'x',
            layer.depth);
  fprintf(p->script, "set border 15\nunset grid\nset xrange [0:%.9g]\nset yrange [0:%.9g]\n", s->edge[along], s->top);
  fprintf(p->script, "set xlabel '%c [d]'\nset ylabel 'y [d]'\n", axis);
  if (p->over)
    print_svg_discs(p, s, &layer, along, at);
  else
    print_discs(p, s, &layer, axis);
  if (along == 0)
    print_legend(p, s);
  else
    fprintf(p->script, "plot NaN notitle");
  if (!p->over)
    fprintf(p->script,
            ", $grains%c using 1:2:3:4 with circles lc rgb variable lw 0.4 fs solid border lc rgb '" RIM "' notitle",
            axis);
  fprintf(p->script, "\n");
  gg_plot_layer_free(&layer);
  return true;
}

static void define_discs(FILE *over, const gg_plot_grains *s)
{
  fprintf(over, "<defs>");
  for (int k = 0; k < s->n_species; k++)
    fprintf(over, "<circle id='g%d' r='%.6g' fill='#%06x'/>", k, s->radius[k], fill_of(k));
  fprintf(over, "</defs>\n");
}

/* Side by side, or below each other where the page is narrow. */
static void lay_out(snapshot_page *p, const gg_plot_grains *s)
{
  bool png = p->paper->format == GG_PLOT_PNG && !(p->paper->width > 0);
  double wide = fmax(s->edge[0], s->edge[2]), both = s->edge[0] + s->edge[2], width = p->paper->width;
  double most = fmin((png ? TALL_PNG : TALL) / s->top, (png ? WIDE_PNG : WIDE) / wide);
  int rows = s->n_species < 2 ? 0 : s->n_species < MOST_LEGEND ? s->n_species : MOST_LEGEND;
  p->above = (p->titled ? ABOVE : NO_TITLE) + (rows ? ROW * (p->paper->width > 0 ? rows : rows / 2 + 1) : 0);
  p->scale = most;
  if (width > 0) p->scale = fmin(most, (width - LEFT - BETWEEN - RIGHT) / both);
  p->stacked = width > 0 && p->scale < most && p->scale * wide < LEAST_WIDE;
  if (p->stacked) p->scale = fmin(most, (width - LEFT - RIGHT) / wide);
  double tall = s->top * p->scale + BELOW;
  p->size[0] = width > 0 ? width : ceil(LEFT + BETWEEN + RIGHT + both * p->scale);
  p->size[1] = ceil(p->above + tall + (p->stacked ? BELOW / 2.0 + tall : 0));
}

static bool draw(snapshot_page *p, const gg_stored_result *stored, const gg_plot_grains *s)
{
  char title[240];
  bool drawn = true;
  gg_plot_page_title(stored, title, sizeof title);
  p->titled = !(p->paper->width > 0) || 1.25 * gg_plot_text_width(title) < p->paper->width;
  lay_out(p, s);
  gg_plot_page_open(p->script, p->titled ? title : NULL, p->paper, p->size[0], p->size[1]);
  if (p->over) define_discs(p->over, s);
  for (int k = 0; k < 2; k++) {
    double at[2] = {LEFT, p->above};
    if (k && p->stacked) at[1] += s->top * p->scale + BELOW * 1.5;
    if (k && !p->stacked) at[0] += s->edge[0] * p->scale + BETWEEN;
    drawn &= draw_panel(p, s, 2 * k, at);
  }
  fprintf(p->script, "unset multiplot\n");
  return drawn;
}

static gg_status draw_page(const gg_stored_result *stored, const gg_plot_grains *s, const gg_plot_paper *paper,
                           const char *picture, gg_error *err)
{
  char *script = NULL, *over = NULL;
  bool svg = paper->format == GG_PLOT_SVG;
  snapshot_page p = {.paper = paper,
                     .script = gg_base_memory_stream_open(&script),
                     .over = svg ? gg_base_memory_stream_open(&over) : NULL};
  bool drawn = p.script && (!svg || p.over);
  if (drawn) drawn = draw(&p, stored, s);
  drawn &= gg_base_memory_stream_close(p.script, &script);
  if (svg) drawn &= gg_base_memory_stream_close(p.over, &over);
  gg_status status = drawn ? gg_plot_gnuplot_run(script, over, picture, err) : gg_base_out_of_memory(err);
  free(script);
  free(over);
  return status;
}

bool gg_plot_snapshot_has(const gg_stored_result *stored)
{
  gg_plot_grains shown;
  return find_grains(stored, &shown);
}

gg_status gg_plot_snapshot_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                                bool *drawn, gg_error *err)
{
  gg_plot_grains shown;
  *drawn = find_grains(stored, &shown);
  return *drawn ? draw_page(stored, &shown, paper, picture, err) : GG_OK;
}
