/* The grains of panels that show them: projected, from the farthest to the nearest, in frames that were stored. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "files/h5/hdf5_reader.h"
#include "plot/plot.h"
#include "reproduce/figures.h"

enum { MOST_SHOWN = 12, COLUMNS = 4, WIDTH = 230, HEIGHT = 260 };

typedef struct shown {
  const gg_figure_panel *of;
  const gg_figure_point *point;
} shown;

static int collect(const gg_figure *f, const gg_figure_points *all, shown *list)
{
  int n = 0;
  for (int i = 0; i < f->entry->n_panels; i++)
    for (size_t k = 0; k < all->n && n < MOST_SHOWN; k++) {
      const gg_figure_panel *of = &f->entry->panel[i];
      if (of->source.kind == GG_OF_SNAPSHOT && gg_reproduce_panel_takes(of, &all->point[k]) &&
          all->point[k].stored.n_frames)
        list[n++] = (shown){of, &all->point[k]};
    }
  return n;
}

/* Positions, box and collisions a grain of the frame that is so many before the last. */
static double *frame_of(const shown *s, double edge[3], double *collisions, gg_error *err)
{
  gg_h5_in h;
  const gg_stored_result *r = &s->point->stored;
  size_t back = (size_t)s->of->source.frame, k = r->n_frames > back ? r->n_frames - 1 - back : 0;
  gg_h5_open(&h, s->point->path);
  double *place = gg_h5_read_row(&h, "/particles/grains/position/value", k, GG_ITEM_F64, 3 * r->n_grains);
  uint64_t *step = gg_h5_read_row(&h, "/particles/grains/position/step", k, GG_ITEM_U64, 1);
  for (int a = 0; a < 3; a++) edge[a] = r->edge[a];
  *collisions = step ? 2 * (double)*step / (double)r->n_grains : NAN;
  free(step);
  gg_h5_in_close(&h);
  if (gg_h5_in_status(&h, s->point->path, err) != GG_OK) free(place), place = NULL;
  return place;
}

/* Images inside the box; y of a sheared box needs no care, x is folded. */
static double fold(double x, double edge)
{
  return x - edge * floor(x / edge);
}

static gg_status draw_one(FILE *s, const shown *one, int k, gg_panel place, gg_error *err)
{
  double edge[3], collisions;
  double *at = frame_of(one, edge, &collisions, err);
  int across = one->of->source.names.text[0][0] == 'z' ? 2 : 0;
  char group[128];
  if (!at) return GG_BAD_FILE;
  gg_reproduce_panel_group(one->of, one->point, "", group, sizeof group);
  fprintf(s, "$grains%d << EOD\n", k);
  for (size_t i = 0; i < one->point->stored.n_grains; i++)
    fprintf(s, "%.3g %.3g\n", fold(at[3 * i + (size_t)across], edge[across]), fold(at[3 * i + 1], edge[1]));
  fprintf(s, "EOD\n");
  free(at);
  gg_plot_page_place(s, place);
  fprintf(s, "set label '%s%s%s%.0f collisions per grain' at graph 0,1.05 left font ',10'\n",
          one->of->title ? one->of->title : "", one->of->title || *group ? ", " : "", *group ? group : "", collisions);
  fprintf(
      s,
      "set size ratio -1\nset xrange [0:%g]\nset yrange [0:%g]\nset xlabel '%s [d]'\nset ylabel 'y [d]' offset 0.4,0\n",
      edge[across], edge[1], across == 2 ? "z" : "x");
  fprintf(s, "unset key\nplot $grains%d using 1:2 with points pt 7 ps 0.2 lc rgb '#0072B2'\n", k);
  return GG_OK;
}

gg_status gg_reproduce_figure_draw_snapshots(const gg_figure *f, const gg_figure_points *all, const char *picture,
                                             gg_error *err)
{
  shown list[MOST_SHOWN];
  int n = collect(f, all, list), columns = n < COLUMNS ? n : COLUMNS, rows = n ? (n + columns - 1) / columns : 1;
  gg_plot_paper paper;
  char *script = NULL;
  if (!n) return gg_base_fail(err, GG_FAILED, "%s: no grains with positions were stored", f->entry->figure);
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, NULL, err));
  FILE *s = gg_base_memory_stream_open(&script);
  if (!s) return gg_base_out_of_memory(err);
  int width = columns * WIDTH, height = 50 + rows * HEIGHT;
  gg_plot_page_open(s, f->entry->figure, &paper, width, height);
  gg_status status = GG_OK;
  for (int k = 0; k < n && status == GG_OK; k++) {
    double left = (double)(k % columns) / columns, w = 1.0 / columns, h = (double)HEIGHT / height;
    double top = 1 - 50.0 / height - (k / columns) * h;
    const gg_panel place = {left + 0.2 * w, left + 0.97 * w, top - 0.77 * h, top - 0.08 * h};
    status = draw_one(s, &list[k], k, place, err);
  }
  fprintf(s, "unset multiplot\n");
  if (!gg_base_memory_stream_close(s, &script) && status == GG_OK) status = gg_base_out_of_memory(err);
  if (status == GG_OK) status = gg_plot_gnuplot_run(script, NULL, picture, err);
  free(script);
  return status;
}
