/* A snapshot: the last stored frame, its grains projected on the planes of shear (x, y) and across it (z, y), to scale.
 * Frames, tics and titles are gnuplot's, and in PNG the discs. In SVG it would draw each as two polygons of 4 kB: there
 * they are put over its page, forty bytes each. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/c_locale.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "plot/plot.h"
#include "plot/snapshot_slice.h"
#include "scene/scene_reader.h"

/* Pixels: sizes of the panels at most, and of everything between. PNG has GG_PLOT_PNG_SCALE of its own for each of
 * them, and is made smaller: its bytes are the rims of the discs, some seven for a pixel, where a disc of SVG takes
 * some 44 in all. */
enum { TALL = 520, WIDE = 700, TALL_PNG = 350, WIDE_PNG = 470 };
enum { LEFT = 70, BETWEEN = 80, RIGHT = 25, ABOVE = 70, BELOW = 65 };
#define RIM "#2f4f63"

static void read_radii(const gg_stored_result *stored, gg_plot_grains *s)
{
  gg_scene scene = gg_scene_defaults();
  for (int k = 0; k < GG_MAX_SPECIES; k++) s->radius[k] = 0.5;
  if (gg_scene_read(&scene, stored->scene, strlen(stored->scene), "scene", NULL) != GG_OK) return;
  for (int k = 1; k < scene.n_species; k++) s->radius[k] = 0.5 * scene.species[k].diameter / scene.species[0].diameter;
}

/* The height that holds all grains: of a gas under gravity not the whole box. */
static double top_of(const gg_plot_grains *s)
{
  double top = 0;
  for (size_t i = 0; i < s->n; i++) top = fmax(top, s->position[3 * i + 1]);
  return fmin(s->edge[1], top + 1);
}

/* False if the file holds no positions. */
static bool find_grains(const gg_stored_result *stored, gg_plot_grains *s)
{
  const gg_frame *f = &stored->last;
  *s = (gg_plot_grains){.n = f->n, .position = f->position, .species = f->species};
  memcpy(s->edge, stored->edge, sizeof s->edge);
  bool whole = f->n && f->position && f->species && s->edge[0] > 0 && s->edge[1] > 0;
  for (size_t i = 0; whole && i < f->n; i++) {
    whole = f->species[i] < GG_MAX_SPECIES;
    if (f->species[i] >= s->n_species) s->n_species = f->species[i] + 1;
  }
  if (!whole) return false;
  s->top = top_of(s);
  read_radii(stored, s);
  return true;
}

/* Half the colour of its species, half white; where the colours come again, a quarter. */
static unsigned fill_of(int species)
{
  unsigned colour = (unsigned)strtoul(gg_plot_colours[species % GG_PLOT_COLOURS] + 1, NULL, 16);
  return species < GG_PLOT_COLOURS ? (colour >> 1 & 0x7f7f7f) + 0x808080 : (colour >> 2 & 0x3f3f3f) + 0xc0c0c0;
}

/* What the page is made of: gnuplot's script, and in SVG what goes over it. */
typedef struct page {
  FILE *script, *over; /* NULL: PNG */
  double scale;        /* pixels a diameter */
} page;

static void print_discs(const page *p, const gg_plot_grains *s, const gg_plot_layer *layer, char axis)
{
  fprintf(p->script, "$grains%c << EOD\n", axis);
  for (size_t i = 0; i < layer->n; i++) {
    const gg_plot_disc *d = &layer->disc[i];
    fprintf(p->script, "%.5g %.5g %.4g %u\n", d->x, d->y, s->radius[d->species], fill_of(d->species));
  }
  fprintf(p->script, "EOD\n");
}

/* In diameters, upwards, cut off at the panel's frame. */
static void print_svg_discs(const page *p, const gg_plot_grains *s, const gg_plot_layer *layer, int along, double left)
{
  double wide = s->edge[along], tall = s->top;
  fprintf(p->over,
          "<svg x='%g' y='%d' width='%g' height='%g' viewBox='0 0 %.9g %.9g'>\n"
          "<g transform='matrix(1 0 0 -1 0 %.9g)' stroke='" RIM "' stroke-width='%.3g'>\n",
          left, ABOVE, wide * p->scale, tall * p->scale, wide, tall, tall, 0.4 / p->scale);
  for (size_t i = 0; i < layer->n; i++) {
    const gg_plot_disc *d = &layer->disc[i];
    fprintf(p->over, "<use xlink:href='#g%d' x='%.5g' y='%.5g'/>\n", d->species, d->x, d->y);
  }
  fprintf(p->over, "</g></svg>\n");
}

static bool draw_panel(const page *p, const gg_plot_grains *s, int along, double left, gg_panel place)
{
  int across = along == 0 ? 2 : 0;
  char axis = along == 0 ? 'x' : 'z';
  gg_plot_layer layer;
  gg_disc_cost cost = p->over ? (gg_disc_cost){44, 0} : (gg_disc_cost){8, 7 * M_PI * GG_PLOT_PNG_SCALE * p->scale};
  if (!gg_plot_layer_make(&layer, s, along, across, cost)) return false;
  gg_plot_place(p->script, place);
  if (!layer.whole)
    fprintf(p->script, "set label 'grains at %c < %.2g d' at graph 0,1.03 left\n", along == 0 ? 'z' : 'x', layer.depth);
  fprintf(p->script, "set border 15\nunset grid\nset xrange [0:%.9g]\nset yrange [0:%.9g]\n", s->edge[along], s->top);
  fprintf(p->script, "set xlabel '%c [d]'\nset ylabel 'y [d]'\nunset key\n", axis);
  if (p->over) {
    print_svg_discs(p, s, &layer, along, left);
    fprintf(p->script, "plot NaN\n");
  } else {
    print_discs(p, s, &layer, axis);
    fprintf(p->script,
            "plot $grains%c using 1:2:3:4 with circles lc rgb variable lw 0.4 fs solid border lc rgb '" RIM "'\n",
            axis);
  }
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

static bool draw(page *p, const gg_stored_result *stored, const gg_plot_grains *s)
{
  double most_tall = p->over ? TALL : TALL_PNG, most_wide = p->over ? WIDE : WIDE_PNG;
  p->scale = fmin(most_tall / s->top, most_wide / fmax(s->edge[0], s->edge[2]));
  double across[2] = {s->edge[0] * p->scale, s->edge[2] * p->scale}, tall = s->top * p->scale;
  double width = ceil(LEFT + across[0] + BETWEEN + across[1] + RIGHT), height = ceil(ABOVE + tall + BELOW);
  double left[2] = {LEFT, LEFT + across[0] + BETWEEN}, upper = 1 - ABOVE / height, lower = upper - tall / height;
  bool drawn = true;
  gg_plot_start_page(p->script, stored, !p->over, (int)width, (int)height);
  if (p->over) define_discs(p->over, s);
  for (int k = 0; k < 2; k++)
    drawn &= draw_panel(p, s, 2 * k, left[k], (gg_panel){left[k] / width, (left[k] + across[k]) / width, lower, upper});
  fprintf(p->script, "unset multiplot\n");
  return drawn;
}

static gg_status draw_page(const gg_stored_result *stored, const gg_plot_grains *s, const char *picture, bool png,
                           gg_error *err)
{
  char *script = NULL, *over = NULL;
  page p = {.script = gg_base_memory_stream_open(&script), .over = png ? NULL : gg_base_memory_stream_open(&over)};
  bool drawn = p.script && (png || p.over);
  if (drawn) {
    locale_t before = gg_base_c_locale_enter();
    drawn = draw(&p, stored, s);
    gg_base_c_locale_leave(before);
  }
  drawn &= gg_base_memory_stream_close(p.script, &script);
  if (!png) drawn &= gg_base_memory_stream_close(p.over, &over);
  gg_status status = drawn ? gg_plot_gnuplot_run(script, over, picture, err) : gg_base_out_of_memory(err);
  free(script);
  free(over);
  return status;
}

bool gg_plot_has_snapshot(const gg_stored_result *stored)
{
  gg_plot_grains shown;
  return find_grains(stored, &shown);
}

gg_status gg_plot_snapshot(const gg_stored_result *stored, const char *picture, bool png, bool *drawn, gg_error *err)
{
  gg_plot_grains shown;
  *drawn = find_grains(stored, &shown);
  return *drawn ? draw_page(stored, &shown, picture, png, err) : GG_OK;
}
