/* A snapshot: the last stored frame, its grains projected on the planes of shear (x, y) and across it (z, y), to scale.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/scene.h"
#include "io/c_locale.h"
#include "io/h5/h5.h"
#include "io/plot/plot.h"

#define GRAINS "/particles/grains/"
enum { MOST_GRAINS = 20000, MOST_NUMBERS = 100 * 1000 * 1000 };
/* Pixels: height of the panels at most, and of everything between. */
enum { TALL = 520, WIDE = 700, LEFT = 70, BETWEEN = 80, RIGHT = 25, ABOVE = 70, BELOW = 65 };

typedef struct snapshot {
  size_t n;         /* grains */
  double *position; /* of the last frame: inside the array of all */
  uint8_t *species;
  double edge[3], radius[GG_MAX_SPECIES];
  double *all;
} snapshot;

static void read_radii(const gg_stored_result *stored, snapshot *s)
{
  gg_scene *scene;
  for (int k = 0; k < GG_MAX_SPECIES; k++) s->radius[k] = 0.5;
  if (gg_scene_parse(stored->scene, "scene", &scene, NULL) != GG_OK) return;
  for (int k = 1; k < scene->n_species; k++)
    s->radius[k] = 0.5 * scene->species[k].diameter / scene->species[0].diameter;
  gg_scene_free(scene);
}

static void clear(snapshot *s)
{
  free(s->all);
  free(s->species);
}

/* False if the file holds no positions. */
static bool read_snapshot(const gg_stored_result *stored, const char *path, snapshot *s)
{
  gg_h5 h;
  size_t numbers = 0, kinds = 0, edges = 0;
  *s = (snapshot){.n = stored->n_grains};
  if (!s->n || (double)s->n * (double)stored->n_frames > MOST_NUMBERS) return false;
  gg_h5_open(&h, path);
  if (!h.failed && gg_h5_exists(&h, GRAINS "position/value")) {
    s->all = gg_h5_read_array(&h, GRAINS "position/value", H5T_NATIVE_DOUBLE, sizeof(double), &numbers);
    s->species = gg_h5_read_array(&h, GRAINS "species", H5T_NATIVE_UINT8, 1, &kinds);
    double *edge = gg_h5_read_array(&h, GRAINS "box/edges/value", H5T_NATIVE_DOUBLE, sizeof(double), &edges);
    for (size_t a = 0; edge && edges >= 9 && a < 3; a++) s->edge[a] = edge[edges - 9 + 4 * a];
    free(edge);
  }
  gg_h5_close(&h);
  bool whole = s->all && s->species && numbers >= 3 * s->n && kinds == s->n && s->edge[0] > 0 && s->edge[1] > 0;
  if (whole) s->position = s->all + numbers - 3 * s->n;
  if (whole) read_radii(stored, s);
  if (!whole) clear(s);
  return whole;
}

/* The height that holds all grains: of a gas under gravity not the whole box. */
static double top_of(const snapshot *s)
{
  double top = 0;
  for (size_t i = 0; i < s->n; i++) top = fmax(top, s->position[3 * i + 1]);
  return fmin(s->edge[1], top + 1);
}

/* Of large or crowded systems a layer is drawn, so deep that discs cover the panel once: the grains nearest to the
 * viewer, in `across` below the limit. */
static double layer_of(const snapshot *s, int along, int across, double top)
{
  double area = 0;
  for (size_t i = 0; i < s->n; i++) area += M_PI * s->radius[s->species[i]] * s->radius[s->species[i]];
  return s->edge[across] * fmin(fmin(1, (double)MOST_GRAINS / (double)s->n), s->edge[along] * top / area);
}

static void print_grains(FILE *out, const snapshot *s, int species, int along, int across, double layer)
{
  fprintf(out, "$grains%d%d << EOD\n", species, along);
  for (size_t i = 0; i < s->n; i++) {
    const double *r = s->position + 3 * i;
    if (s->species[i] == species && r[across] <= layer) fprintf(out, "%.5g %.5g\n", r[along], r[1]);
  }
  fprintf(out, "EOD\n");
}

static void draw_panel(FILE *out, const snapshot *s, int along, gg_panel place, double top)
{
  int across = along == 0 ? 2 : 0;
  double layer = layer_of(s, along, across, top);
  gg_plot_place(out, place);
  if (layer < s->edge[across])
    fprintf(out, "set label 'grains at %c < %.2g d' at graph 0,1.03 left\n", across ? 'z' : 'x', layer);
  bool two = false;
  for (size_t i = 0; i < s->n; i++) two |= s->species[i] != 0;
  for (int k = 0; k < 1 + two; k++) print_grains(out, s, k, along, across, layer);
  fprintf(out, "set border 15\nunset grid\nset xrange [0:%.9g]\nset yrange [0:%.9g]\n", s->edge[along], top);
  fprintf(out, "set xlabel '%c [d]'\nset ylabel 'y [d]'\nunset key\nplot ", along == 0 ? 'x' : 'z');
  for (int k = 0; k < 1 + two; k++)
    fprintf(out, "%s$grains%d%d using 1:2:(%.6g) with circles lc rgb '%s' lw 0.4 fs transparent solid 0.3 border",
            k ? ", " : "", k, along, s->radius[k], gg_plot_colours[k]);
  fprintf(out, "\n");
}

static void draw(FILE *out, const gg_stored_result *stored, const snapshot *s, bool png)
{
  double top = top_of(s), scale = fmin(TALL / top, WIDE / fmax(s->edge[0], s->edge[2]));
  double across[2] = {s->edge[0] * scale, s->edge[2] * scale}, tall = top * scale;
  double width = LEFT + across[0] + BETWEEN + across[1] + RIGHT, height = ABOVE + tall + BELOW;
  gg_plot_start_page(out, stored, png, (int)width, (int)height);
  double bottom = BELOW / height, upper = (BELOW + tall) / height, x = LEFT / width;
  draw_panel(out, s, 0, (gg_panel){x, x + across[0] / width, bottom, upper}, top);
  x += (across[0] + BETWEEN) / width;
  draw_panel(out, s, 2, (gg_panel){x, x + across[1] / width, bottom, upper}, top);
  fprintf(out, "unset multiplot\n");
}

static gg_status draw_page(const gg_stored_result *stored, const snapshot *s, const char *picture, bool png,
                           gg_error *err)
{
  char *script = NULL;
  size_t length;
  FILE *out = open_memstream(&script, &length);
  if (!out) return gg_fail(err, GG_FAILED, "out of memory");
  locale_t before = gg_c_locale_enter();
  draw(out, stored, s, png);
  gg_c_locale_leave(before);
  gg_status status = fclose(out) == 0 ? GG_OK : gg_fail(err, GG_FAILED, "out of memory");
  if (status == GG_OK) status = gg_gnuplot_run(script, picture, err);
  free(script);
  return status;
}

gg_status gg_plot_snapshot(const gg_stored_result *stored, const char *result_path, const char *picture, bool png,
                           bool *drawn, gg_error *err)
{
  snapshot s;
  *drawn = read_snapshot(stored, result_path, &s);
  if (!*drawn) return GG_OK;
  gg_status status = draw_page(stored, &s, picture, png, err);
  clear(&s);
  return status;
}
