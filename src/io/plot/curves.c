/* Pictures of curves: one page an observable, one panel for curves that belong together, shaded bands of one standard
 * error. */
#include <math.h>
#include <string.h>

#include "io/curves.h"
#include "io/plot/plot.h"

enum { MOST_PANELS = 24, MOST_IN_PANEL = 8, COLUMNS = 3 };

typedef struct panel {
  const char *title;
  int n, more; /* curves drawn, and those for which there is no room */
  const json_t *curve[MOST_IN_PANEL];
} panel;

static const char *text_of(const json_t *curve, const char *key)
{
  const char *text = json_string_value(json_object_get(curve, key));
  return text ? text : "";
}

int gg_curve_groups(const json_t *document, const char **names, int most)
{
  int n = 0, k;
  const char *name;
  json_t *curve;
  json_object_foreach(json_object_get(document, "curves"), name, curve)
  {
    const char *group = text_of(curve, "group");
    for (k = 0; k < n && strcmp(names[k], group) != 0; k++) continue;
    if (k == n && n < most) names[n++] = group;
  }
  return n;
}

static int panels_of(const json_t *document, const char *group, panel *panels)
{
  int n = 0, k;
  const char *name;
  json_t *curve;
  json_object_foreach(json_object_get(document, "curves"), name, curve)
  {
    const char *title = text_of(curve, "panel");
    if (strcmp(text_of(curve, "group"), group) != 0) continue;
    for (k = 0; k < n && strcmp(panels[k].title, title) != 0; k++) continue;
    if (k == n && n < MOST_PANELS) panels[n++] = (panel){.title = title};
    if (k == n) continue;
    if (panels[k].n < MOST_IN_PANEL)
      panels[k].curve[panels[k].n++] = curve;
    else
      panels[k].more++;
  }
  return n;
}

static int columns_for(int n)
{
  return n == 4 ? 2 : n < COLUMNS ? n : COLUMNS;
}

void gg_plot_curves_size(const json_t *document, const char *group, int size[2])
{
  panel panels[MOST_PANELS];
  int n = panels_of(document, group, panels), columns = n ? columns_for(n) : 1;
  size[0] = columns == 1 ? 640 : 440 * columns;
  size[1] = 50 + 378 * (n ? (n + columns - 1) / columns : 1);
}

static double at(const json_t *curve, const char *key, size_t i)
{
  const json_t *x = json_array_get(json_object_get(curve, key), i);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

/* The part of a curve between its first and last points other than zero: histograms have empty ends. */
static void find_ends(const json_t *curve, size_t *from, size_t *to)
{
  *from = 0, *to = json_array_size(json_object_get(curve, "x"));
  while (*from < *to && at(curve, "value", *from) == 0) ++*from;
  while (*to > *from && at(curve, "value", *to - 1) == 0) --*to;
}

/* On a logarithmic axis a point that is not known within two thirds of itself says little, and hides other curves. */
typedef struct extent {
  double range[2], least, x[2]; /* of values with their errors, of values, of x */
} extent;

static void print_data(FILE *s, int k, const json_t *curve, extent *all)
{
  bool log_x = json_is_true(json_object_get(curve, "log_x")), log_y = json_is_true(json_object_get(curve, "log_y"));
  size_t from, to;
  find_ends(curve, &from, &to);
  fprintf(s, "$curve%d << EOD\n", k);
  for (size_t i = from; i < to; i++) {
    double x = at(curve, "x", i), y = at(curve, "value", i), e = at(curve, "stderr", i);
    if (!isfinite(y) || (log_x && x <= 0) || (log_y && (y <= 0 || e > 0.67 * y))) continue;
    double band = isfinite(e) ? e : 0, low = y - band;
    all->least = fmin(all->least, y);
    all->range[0] = fmin(all->range[0], low), all->range[1] = fmax(all->range[1], y + band);
    all->x[0] = fmin(all->x[0], x), all->x[1] = fmax(all->x[1], x);
    fprintf(s, "%.7g %.7g %.7g %.7g\n", x, y, low, y + band);
  }
  fprintf(s, "EOD\n");
}

/* The law beside a curve, as far as curves are drawn. False if there is none, or it is that of the curve before. */
static bool print_reference(FILE *s, int k, const json_t *curve, const json_t *before, const extent *all)
{
  const json_t *law = json_object_get(curve, "reference");
  bool logarithmic = json_is_true(json_object_get(curve, "log_y"));
  if (!law || (before && json_equal(law, json_object_get(before, "reference")))) return false;
  fprintf(s, "$law%d << EOD\n", k);
  for (size_t i = 0; i < json_array_size(json_object_get(curve, "x")); i++) {
    double x = at(curve, "x", i), y = at(law, "value", i);
    bool shown = x >= all->x[0] && x <= all->x[1] && (!logarithmic || y >= 0.3 * all->range[0]);
    if (isfinite(y) && shown) fprintf(s, "%.7g %.7g\n", x, y);
  }
  fprintf(s, "EOD\n");
  return true;
}

/* Over the curves, dashed; in their own colours where there are several laws. */
static void draw_references(FILE *s, const panel *p, const bool *there)
{
  int n = 0, named = 0;
  for (int k = 0; k < p->n; k++) n += there[k];
  for (int k = 0; k < p->n; k++) {
    if (!there[k]) continue;
    fprintf(s, ", $law%d using 1:2 with lines lw 1.2 dt (6,4) lc rgb '%s' ", k,
            n > 1 ? gg_plot_colours[k % GG_PLOT_COLOURS] : "#444444");
    fprintf(s, named++ ? "notitle" : "title '%s'", text_of(json_object_get(p->curve[k], "reference"), "label"));
  }
}

static void axis_label(FILE *s, char axis, const char *name, const char *raw)
{
  char unit[96];
  gg_plot_unit(raw, unit, sizeof unit);
  if (strcmp(raw, "1") == 0 || !*raw)
    fprintf(s, "set %clabel '%s'\n", axis, name);
  else
    fprintf(s, "set %clabel '%s [%s]' offset %s,0\n", axis, name, unit, axis == 'y' ? "0.8" : "0");
}

/* Nothing but a frame: gnuplot makes no axes of no points. */
static void draw_nothing(FILE *s)
{
  fprintf(s, "set xrange [0:1]\nset yrange [0:1]\nunset key\nset label 'not enough samples' at graph 0.5,0.5 center "
             "textcolor rgb '#666666'\nplot NaN notitle\n");
}

/* A panel that leaves curves out says so: those of many species are too many to be told apart. */
static void print_title(FILE *s, const panel *p)
{
  fprintf(s, "set label '%s", p->title);
  if (p->more) fprintf(s, ": the first %d of %d curves", p->n, p->n + p->more);
  fprintf(s, "' at graph 0,1.21 left\n");
}

static void draw_panel(FILE *s, const panel *p, gg_panel place)
{
  const json_t *first = p->curve[0];
  gg_plot_place(s, place);
  print_title(s, p);
  axis_label(s, 'x', text_of(first, "x_name"), text_of(first, "x_unit"));
  axis_label(s, 'y', text_of(first, "y_name"), text_of(first, "unit"));
  extent all = {{INFINITY, -INFINITY}, INFINITY, {INFINITY, -INFINITY}};
  for (int k = 0; k < p->n; k++) print_data(s, k, p->curve[k], &all);
  if (!(all.x[0] < all.x[1])) {
    draw_nothing(s);
    return;
  }
  bool law[MOST_IN_PANEL], any = false;
  for (int k = 0; k < p->n; k++) any |= law[k] = print_reference(s, k, p->curve[k], k ? p->curve[k - 1] : NULL, &all);
  if (all.least >= 0 && all.range[0] < 0.3 * all.range[1]) fprintf(s, "set yrange [0:*]\n");
  if (json_is_true(json_object_get(first, "log_x"))) fprintf(s, "set logscale x\n");
  if (json_is_true(json_object_get(first, "log_y")))
    fprintf(s, "set yrange [*:*]\nset logscale y\nset format y '10^{%%T}'\n");
  fprintf(s, p->n > 1 || any ? "set key at graph 1.0,1.16 right top horizontal samplen 1\n" : "unset key\n");
  fprintf(s, "plot ");
  for (int k = 0; k < p->n; k++) {
    const char *colour = gg_plot_colours[k % GG_PLOT_COLOURS];
    fprintf(s, "%s$curve%d using 1:3:4 with filledcurves notitle fc rgb '%s' fs transparent solid 0.25 noborder, ",
            k ? ", " : "", k, colour);
    fprintf(s, "$curve%d using 1:2 with lines lw 1.3 lc rgb '%s' title '%s'", k, colour,
            *text_of(p->curve[k], "label") ? text_of(p->curve[k], "label") : "measured");
  }
  draw_references(s, p, law);
  fprintf(s, "\n");
}

void gg_plot_curves(FILE *s, const json_t *document, const char *group)
{
  panel panels[MOST_PANELS];
  int n = panels_of(document, group, panels);
  if (!n) return;
  int size[2], columns = columns_for(n), rows = (n + columns - 1) / columns;
  gg_plot_curves_size(document, group, size);
  double width = 1.0 / columns, head = 50.0 / size[1], height = (1 - head) / rows;
  double left = columns == 1 ? 90.0 / size[0] : 80.0 / size[0], below = 66.0 / size[1], above = 62.0 / size[1];
  for (int i = 0; i < n; i++) {
    double x = (i % columns) * width, y = 1 - head - (i / columns + 1) * height;
    draw_panel(s, &panels[i], (gg_panel){x + left, x + width - 20.0 / size[0], y + below, y + height - above});
  }
}
