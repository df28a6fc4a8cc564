/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A snapshot: the last stored frame, its grains projected on the planes of shear (x, y) and across it (z, y), to scale.
 * gnuplot draws frames, tics and texts, and the discs of PNG and PDF. In SVG gnuplot would draw each disc as two
 * polygons of 4 kB. There the discs are put over its page, forty bytes each. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/page.h"
#include "scene/scene_reader.h"

/* Layout pixels: the largest panels, and the room around them. PNG is made smaller: its bytes are the rims of the
 * discs, some seven for a pixel of the file, where a disc of SVG takes some 44 in all, and one of PDF 700. */
enum { TALL = 520, WIDE = 700, TALL_PNG = 350, WIDE_PNG = 470, LEAST_WIDE = 150, LEAST_PAGE = 420, MOST_LEGEND = 8 };
enum { LEFT = 70, BETWEEN = 80, RIGHT = 25, MARGIN = 8, ABOVE = 24, BELOW = 58 };
#define RIM "#2f4f63"

/* The grains of a frame: n positions, three coordinates each, in diameters. */
typedef struct grains {
  size_t n;
  const double *position;
  const uint8_t *species;
  int n_species;
  double edge[3], top, radius[GG_MAX_SPECIES], mass[GG_MAX_SPECIES];
} grains;

typedef struct grain_disc {
  double depth, x, y;
  uint8_t species;
} grain_disc;

/* The discs of a panel, from the nearest to the farthest. A layer of them is drawn if the system is large or dense. */
typedef struct grain_layer {
  size_t n;
  grain_disc *disc; /* owned */
  double depth;     /* the end of the layer */
  bool whole;       /* it has every grain */
} grain_layer;

/* Bytes of the picture that a disc takes: in PNG its rim counts, in SVG every disc alike. */
typedef struct disc_cost {
  double each, per_diameter;
} disc_cost;

/* Both panels and the frames around them stay below half a megabyte. */
static const double most_bytes = 215e3;

static int nearest_first(const void *a, const void *b)
{
  double x = ((const grain_disc *)a)->depth, y = ((const grain_disc *)b)->depth;
  return (x > y) - (x < y);
}

/* Number of discs that cover the panel once, if these are not too many to draw. */
static size_t count_shown(const grain_layer *layer, const grains *s, double area, disc_cost cost)
{
  double bytes = 0;
  for (size_t i = 0; i < s->n; i++) {
    double r = s->radius[layer->disc[i].species];
    area -= M_PI * r * r;
    bytes += cost.each + cost.per_diameter * 2 * r;
    if (area < 0 || bytes > most_bytes) return i;
  }
  return s->n;
}

/* Make the view of axes `along` and y. False: out of memory. */
static bool make_layer(grain_layer *layer, const grains *s, int along, disc_cost cost)
{
  *layer = (grain_layer){.disc = malloc((s->n + !s->n) * sizeof *layer->disc)};
  if (!layer->disc) return false;
  for (size_t i = 0; i < s->n; i++) {
    const double *r = s->position + 3 * i;
    layer->disc[i] = (grain_disc){r[2 - along], r[along], r[1], s->species[i]};
  }
  qsort(layer->disc, s->n, sizeof *layer->disc, nearest_first);
  layer->n = count_shown(layer, s, s->edge[along] * s->top, cost);
  layer->whole = layer->n == s->n;
  layer->depth = layer->whole ? s->edge[2 - along] : layer->disc[layer->n].depth;
  return true;
}

static void read_species(const gg_stored_result *stored, grains *s)
{
  gg_scene scene = gg_scene_defaults();
  for (int k = 0; k < GG_MAX_SPECIES; k++) s->radius[k] = 0.5, s->mass[k] = 1;
  if (gg_scene_read(&scene, stored->scene, strlen(stored->scene), "scene", NULL) != GG_OK) return;
  for (int k = 1; k < scene.n_species; k++) {
    s->radius[k] = 0.5 * scene.species[k].diameter / scene.species[0].diameter;
    s->mass[k] = scene.species[k].mass / scene.species[0].mass;
  }
}

/* False if the file holds no positions; those of Monte Carlo between walls are heights alone. */
static bool find_grains(const gg_stored_result *stored, grains *s)
{
  const gg_frame *f = &stored->last;
  *s = (grains){.n = f->n, .position = f->position, .species = f->species};
  memcpy(s->edge, stored->edge, sizeof s->edge);
  const bool heights = stored->engine[GG_DSMC].name && !stored->engine[GG_MD].name;
  bool whole = !heights && f->n && f->position && f->species && s->edge[0] > 0 && s->edge[1] > 0;
  for (size_t i = 0; whole && i < f->n; i++) {
    whole = f->species[i] < GG_MAX_SPECIES;
    if (f->species[i] >= s->n_species) s->n_species = f->species[i] + 1;
  }
  if (!whole) return false;
  s->top = 0; /* the height that holds all grains: less than the box for a gas under gravity */
  for (size_t i = 0; i < s->n; i++) s->top = fmax(s->top, s->position[3 * i + 1]);
  s->top = fmin(s->edge[1], s->top + 1);
  read_species(stored, s);
  return true;
}

/* Half the colour of the species, half white; from the ninth species on, a quarter. */
static unsigned fill_of(int species)
{
  const unsigned colour = gg_plot_colours[species % GG_PLOT_COLOURS];
  return species < GG_PLOT_COLOURS ? (colour >> 1 & 0x7f7f7f) + 0x808080 : (colour >> 2 & 0x3f3f3f) + 0xc0c0c0;
}

typedef struct snapshot {
  gg_page page;
  const grains *gas;
  char title[240];
  gg_legend_entry entry[MOST_LEGEND + 1];
  int n_entries;
  double scale; /* layout pixels of a diameter */
} snapshot;

/* The first species by their colours. */
static void list_species(snapshot *p)
{
  const grains *s = p->gas;
  for (int k = 0; s->n_species > 1 && k < s->n_species && k < MOST_LEGEND; k++) {
    gg_legend_entry *e = &p->entry[p->n_entries++];
    e->look = (gg_look){.style = GG_CHART_POINTS, .symbol = 7, .size = 1.2, .colour = fill_of(k)};
    snprintf(e->name, sizeof e->name, "species %d: σ = %.3g, m = %.3g", k + 1, 2 * s->radius[k], s->mass[k]);
  }
  if (s->n_species > MOST_LEGEND) {
    gg_legend_entry *e = &p->entry[p->n_entries++];
    e->look = (gg_look){.style = GG_CHART_LINE, .dash = "1", .colour = 0xffffff};
    snprintf(e->name, sizeof e->name, "… %d species", s->n_species);
  }
}

/* In diameters, upwards, cut off at the panel's frame. */
static void print_svg_discs(const snapshot *p, const grain_layer *layer, gg_box f)
{
  const double pixels = gg_plot_page_scale(p->page.paper), wide = f.wide / p->scale, tall = f.tall / p->scale;
  fprintf(p->page.over,
          "<svg x='%g' y='%g' width='%g' height='%g' viewBox='0 0 %.9g %.9g'>\n"
          "<g transform='matrix(1 0 0 -1 0 %.9g)' stroke='" RIM "' stroke-width='%.3g'>\n",
          f.left * pixels, f.top * pixels, f.wide * pixels, f.tall * pixels, wide, tall, tall, 0.4 / p->scale);
  for (const grain_disc *d = layer->disc + layer->n; d-- > layer->disc;)
    fprintf(p->page.over, "<use xlink:href='#g%d' x='%.5g' y='%.5g'/>\n", d->species, d->x, d->y);
  fprintf(p->page.over, "</g></svg>\n");
}

/* False: out of memory. */
static bool draw_panel(const snapshot *p, int along, double left, double top)
{
  const grains *s = p->gas;
  const gg_box f = {left, top, s->edge[along] * p->scale, s->top * p->scale};
  char depth[64];
  grain_layer layer;
  const gg_plot_paper *paper = p->page.paper;
  const disc_cost png = {8, 7 * M_PI * gg_plot_page_scale(paper) * p->scale}, other = {p->page.over ? 44 : 700, 0};
  if (!make_layer(&layer, s, along, paper->format == GG_PLOT_PNG ? png : other)) return false;
  gg_plot_page_panel(&p->page, f, true);
  if (along == 0) {
    const double rows =
        gg_plot_page_rows(&p->page, p->page.size[0] / 2, MARGIN, p->page.size[0], "center noenhanced", p->title);
    gg_plot_page_legend(&p->page, LEFT, MARGIN + rows, p->page.size[0] - LEFT - RIGHT, p->entry, p->n_entries);
  }
  snprintf(depth, sizeof depth, "at %c < %.2g d", along == 0 ? 'z' : 'x', layer.depth);
  if (!layer.whole) gg_plot_page_text(&p->page, f.left + f.wide, f.top - 10, "right", depth);
  gg_plot_page_text(&p->page, f.left - LEFT + MARGIN, f.top - 10, "left", "y [d]");
  gg_plot_page_text(&p->page, f.left + f.wide / 2, f.top + f.tall + 40, "center", along == 0 ? "x [d]" : "z [d]");
  fprintf(p->page.script, "set xrange [0:%.9g]\nset yrange [0:%.9g]\n", s->edge[along], s->top);
  if (p->page.over) {
    print_svg_discs(p, &layer, f);
    fprintf(p->page.script, "plot NaN\n");
  } else {
    fprintf(p->page.script, "$grains << EOD\n");
    for (const grain_disc *d = layer.disc + layer.n; d-- > layer.disc;)
      fprintf(p->page.script, "%.5g %.5g %.4g %u\n", d->x, d->y, s->radius[d->species], fill_of(d->species));
    fprintf(p->page.script,
            "EOD\nplot $grains using 1:2:3:4 with circles lc rgb variable lw 0.4 fs solid border lc rgb '" RIM "'\n");
  }
  free(layer.disc);
  return true;
}

/* Panels side by side, or below each other on a narrow page. */
static gg_status draw(snapshot *p, const gg_plot_paper *paper, const char *picture, gg_error *err)
{
  const grains *s = p->gas;
  const bool png = paper->format == GG_PLOT_PNG && !(paper->width > 0);
  const double wide = fmax(s->edge[0], s->edge[2]), both = s->edge[0] + s->edge[2], width = paper->width;
  const double most = fmin((png ? TALL_PNG : TALL) / s->top, (png ? WIDE_PNG : WIDE) / wide);
  p->scale = width > 0 ? fmin(most, (width - LEFT - BETWEEN - RIGHT) / both) : most;
  const bool stacked = width > 0 && p->scale < most && p->scale * wide < LEAST_WIDE;
  if (stacked) p->scale = fmin(most, (width - LEFT - RIGHT) / wide);
  const double tall = s->top * p->scale,
               page = width > 0 ? width : ceil(fmax(LEFT + BETWEEN + RIGHT + both * p->scale, LEAST_PAGE));
  list_species(p);
  const double top = MARGIN + ABOVE + gg_plot_page_rows(NULL, 0, 0, page, "", p->title) +
                     gg_plot_page_legend(NULL, 0, 0, page - LEFT - RIGHT, p->entry, p->n_entries);
  const double step = tall + BELOW + ABOVE;
  bool drawn = gg_plot_page_open(&p->page, paper, page, ceil(top + tall + BELOW + (stacked ? step : 0)));
  if (drawn && p->page.over) {
    fprintf(p->page.over, "<defs>");
    for (int k = 0; k < s->n_species; k++)
      fprintf(p->page.over, "<circle id='g%d' r='%.6g' fill='#%06x'/>", k, s->radius[k], fill_of(k));
    fprintf(p->page.over, "</defs>\n");
  }
  drawn = drawn && draw_panel(p, 0, LEFT, top) &&
          draw_panel(p, 2, stacked ? LEFT : LEFT + s->edge[0] * p->scale + BETWEEN, stacked ? top + step : top);
  return gg_plot_page_finish(&p->page, drawn, picture, err);
}

bool gg_plot_snapshot_has(const gg_stored_result *stored)
{
  grains shown;
  return find_grains(stored, &shown);
}

gg_status gg_plot_snapshot_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                                bool *drawn, gg_error *err)
{
  grains shown;
  snapshot p = {.gas = &shown};
  *drawn = find_grains(stored, &shown);
  gg_plot_scene_title(stored, p.title, sizeof p.title);
  return *drawn ? draw(&p, paper, picture, err) : GG_OK;
}
