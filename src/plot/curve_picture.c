/* Pictures of curves: one page an observable, one panel for curves that belong together, shaded bands of one standard
 * error; where a theory has them, too, points with error bars, and the theory as a line. */
#include <math.h>
#include <string.h>

#include "files/curve_table.h"
#include "plot/axis.h"
#include "plot/plot.h"

enum { MOST_PANELS = 24, MOST_IN_PANEL = 8, COLUMNS = 3 };

typedef struct panel {
  const char *title;
  int n, more; /* curves drawn, and those for which there is no room */
  const json_t *curve[MOST_IN_PANEL], *theory[MOST_IN_PANEL];
  const char *theory_name; /* that has some of them; NULL: none */
  bool log_x, log_y;
  gg_extent x, y, value; /* y: with errors */
} panel;

static const char *text_of(const json_t *curve, const char *key)
{
  const char *text = json_string_value(json_object_get(curve, key));
  return text ? text : "";
}

int gg_plot_curve_groups(const json_t *document, const char **names, int most)
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

static double at(const json_t *curve, const char *key, size_t i)
{
  const json_t *x = json_array_get(json_object_get(curve, key), i);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

static size_t size_of(const json_t *curve)
{
  return json_array_size(json_object_get(curve, "x"));
}

/* The part of a curve between its first and last points other than zero: histograms have empty ends. */
static void find_ends(const json_t *curve, size_t *from, size_t *to)
{
  *from = 0, *to = size_of(curve);
  while (*from < *to && at(curve, "value", *from) == 0) ++*from;
  while (*to > *from && at(curve, "value", *to - 1) == 0) --*to;
}

typedef struct point {
  double x, y, error;
} point;

/* On a logarithmic axis a point that is not known within two thirds of itself says little, and hides other curves. */
static bool read_point(const panel *p, const json_t *curve, size_t i, point *q)
{
  *q = (point){at(curve, "x", i), at(curve, "value", i), at(curve, "stderr", i)};
  bool shown = isfinite(q->y) && !(p->log_x && q->x <= 0) && !(p->log_y && (q->y <= 0 || q->error > 0.67 * q->y));
  if (!isfinite(q->error)) q->error = 0;
  return shown;
}

static void find_extents(panel *p)
{
  size_t from, to;
  point q;
  p->x = p->y = p->value = GG_NO_EXTENT;
  p->log_x = json_is_true(json_object_get(p->curve[0], "log_x"));
  p->log_y = json_is_true(json_object_get(p->curve[0], "log_y"));
  for (int k = 0; k < p->n; k++) {
    find_ends(p->curve[k], &from, &to);
    for (size_t i = from; i < to; i++) {
      if (!read_point(p, p->curve[k], i, &q)) continue;
      gg_plot_extent_add(&p->x, q.x, false), gg_plot_extent_add(&p->value, q.y, false);
      gg_plot_extent_add(&p->y, q.y - q.error, p->log_y), gg_plot_extent_add(&p->y, q.y + q.error, p->log_y);
    }
  }
}

/* The first theory that has a curve of this name: lines of several would be too many. */
static void add_curve(panel *p, const char *name, const json_t *curve, const json_t *theories)
{
  const char *theory;
  json_t *curves;
  p->curve[p->n] = curve, p->theory[p->n] = NULL;
  json_object_foreach((json_t *)(uintptr_t)theories, theory, curves)
  {
    const json_t *one = json_object_get(curves, name);
    if (!one || (p->theory_name && strcmp(p->theory_name, theory) != 0)) continue;
    p->theory[p->n] = one, p->theory_name = theory;
    break;
  }
  p->n++;
}

static int panels_of(const json_t *document, const json_t *theories, const char *group, panel *panels)
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
    if (panels[k].n == MOST_IN_PANEL)
      panels[k].more++;
    else
      add_curve(&panels[k], name, curve, theories);
  }
  for (k = 0; k < n; k++) find_extents(&panels[k]);
  return n;
}

static int columns_for(int n)
{
  return n == 4 ? 2 : n < COLUMNS ? n : COLUMNS;
}

/* Pixels. Under a panel's title stands its legend: at least two rows. */
enum { PANEL_WIDE = 440, ONE_WIDE = 640, HEAD = 50, PLOT = 250, BELOW = 66, LEGEND_ROW = 18, RIGHT = 20, Y_LABEL = 42 };
static const double letter = 7.6;

static int width_of(const char *text)
{
  int n = 0;
  for (const char *c = text; *c; c++) n += !strchr("{}^_", *c) && (*c & 0xc0) != 0x80;
  return n;
}

static int legend_rows(const panel *p)
{
  int longest = 0, entries = p->n;
  for (int k = 0; k < p->n; k++) {
    const json_t *law = json_object_get(p->curve[k], "reference");
    int width = width_of(text_of(p->curve[k], "label")), beside = law ? width_of(text_of(law, "label")) : 0;
    if (k == 0 && law) entries++;
    longest = (int)fmax(longest, fmax(width, beside));
  }
  int columns = (int)fmax(1, 330 / (letter * longest + 45));
  return (int)fmax(2, (entries + columns - 1) / columns);
}

/* Pixels above the frame of each panel. */
static int above_of(const panel *panels, int n)
{
  int rows = 2;
  for (int i = 0; i < n; i++) rows = (int)fmax(rows, legend_rows(&panels[i]));
  return 26 + LEGEND_ROW * rows;
}

static void find_size(const panel *panels, int n, int size[2])
{
  int columns = n ? columns_for(n) : 1, rows = n ? (n + columns - 1) / columns : 1;
  size[0] = columns == 1 ? ONE_WIDE : PANEL_WIDE * columns;
  size[1] = HEAD + (above_of(panels, n) + PLOT + BELOW) * rows;
}

void gg_plot_curves_size(const json_t *document, const char *group, int size[2])
{
  panel panels[MOST_PANELS];
  find_size(panels, panels_of(document, NULL, group, panels), size);
}

static void print_data(FILE *s, const panel *p, int k)
{
  size_t from, to;
  point q;
  find_ends(p->curve[k], &from, &to);
  fprintf(s, "$curve%d << EOD\n", k);
  for (size_t i = from; i < to; i++)
    if (read_point(p, p->curve[k], i, &q)) fprintf(s, "%.7g %.7g %.7g %.7g\n", q.x, q.y, q.y - q.error, q.y + q.error);
  fprintf(s, "EOD\n");
}

/* A law or a theory beside a curve, as far as curves are drawn. */
static void print_line(FILE *s, const char *name, int k, const panel *p, const json_t *abscissae, const json_t *values)
{
  fprintf(s, "$%s%d << EOD\n", name, k);
  for (size_t i = 0; i < size_of(abscissae); i++) {
    double x = at(abscissae, "x", i), y = at(values, "value", i);
    bool shown = x >= p->x.least && x <= p->x.most && (!p->log_y || y >= 0.3 * p->y.least);
    if (isfinite(y) && shown)
      fprintf(s, "%.7g %.7g\n", x, y);
    else
      fprintf(s, "\n");
  }
  fprintf(s, "EOD\n");
}

/* False if there is none, or it is that of the curve before. */
static bool print_reference(FILE *s, const panel *p, int k)
{
  const json_t *law = json_object_get(p->curve[k], "reference");
  if (!law || (k && json_equal(law, json_object_get(p->curve[k - 1], "reference")))) return false;
  print_line(s, "law", k, p, p->curve[k], law);
  return true;
}

static void print_curve_title(FILE *s, const char *title)
{
  fprintf(s, " title '");
  gg_plot_text(s, title);
  fputc('\'', s);
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
    if (named++)
      fprintf(s, "notitle");
    else
      print_curve_title(s, text_of(json_object_get(p->curve[k], "reference"), "label"));
  }
}

/* In the colours of the curves; the title says whose they are. */
static void draw_theory(FILE *s, const panel *p)
{
  for (int k = 0; k < p->n; k++)
    if (p->theory[k])
      fprintf(s, ", $theory%d using 1:2 with lines lw 1.1 lc rgb '%s' notitle", k,
              gg_plot_colours[k % GG_PLOT_COLOURS]);
}

static void axis_label(FILE *s, char axis, const char *name, const char *raw)
{
  char unit[96];
  gg_plot_unit(raw, unit, sizeof unit);
  fprintf(s, "set %clabel '", axis);
  gg_plot_text(s, name);
  if (strcmp(raw, "1") == 0 || !*raw)
    fprintf(s, "'\n");
  else
    fprintf(s, " [%s]'\n", unit);
}

/* Nothing but a frame: gnuplot makes no axes of no points. */
static void draw_nothing(FILE *s)
{
  fprintf(s, "set xrange [0:1]\nset yrange [0:1]\nunset key\nset label 'not enough samples' at graph 0.5,0.5 center "
             "textcolor rgb '#666666'\nplot NaN notitle\n");
}

/* A panel that leaves curves out says so: those of many species are too many to be told apart. */
static void print_title(FILE *s, const panel *p, int above)
{
  fprintf(s, "set label '");
  gg_plot_text(s, p->title);
  if (p->more) fprintf(s, ": the first %d of %d curves", p->n, p->n + p->more);
  if (p->theory_name) {
    fprintf(s, "; lines: ");
    gg_plot_plain_text(s, p->theory_name);
  }
  fprintf(s, "' at graph 0,%g left\n", 1 + (above - 10.0) / PLOT);
}

static void draw_curve(FILE *s, const panel *p, int k)
{
  static const int symbols[] = {7, 5, 9, 13, 11, 15, 6, 4};
  const char *colour = gg_plot_colours[k % GG_PLOT_COLOURS], *label = text_of(p->curve[k], "label");
  fprintf(s, "%s", k ? ", " : "");
  if (p->theory[k])
    fprintf(s, "$curve%d using 1:2:3:4 with yerrorbars pt %d ps 0.45 lw 0.8 lc rgb '%s'", k,
            symbols[k % (int)(sizeof symbols / sizeof *symbols)], colour);
  else
    fprintf(s,
            "$curve%d using 1:3:4 with filledcurves notitle fc rgb '%s' fs transparent solid 0.25 noborder, "
            "$curve%d using 1:2 with lines lw 1.3 lc rgb '%s'",
            k, colour, k, colour);
  print_curve_title(s, *label ? label : "measured");
}

static bool is_empty(const panel *p)
{
  return !(p->x.least < p->x.most);
}

static gg_axis y_axis_of(const panel *p)
{
  gg_axis a = gg_plot_axis_around(p->y, p->log_y);
  if (!p->log_y && p->value.least >= 0 && p->y.least < 0.3 * p->y.most) a.from = 0;
  return a;
}

static void draw_panel(FILE *s, const panel *p, gg_panel place, int above)
{
  const json_t *first = p->curve[0];
  bool law[MOST_IN_PANEL], any = false;
  gg_plot_place(s, place);
  print_title(s, p, above);
  axis_label(s, 'x', text_of(first, "x_name"), text_of(first, "x_unit"));
  axis_label(s, 'y', text_of(first, "y_name"), text_of(first, "unit"));
  if (is_empty(p)) {
    draw_nothing(s);
    return;
  }
  for (int k = 0; k < p->n; k++) {
    print_data(s, p, k);
    any |= law[k] = print_reference(s, p, k);
    if (p->theory[k]) print_line(s, "theory", k, p, p->theory[k], p->theory[k]);
  }
  gg_plot_axis_print(s, 'x', gg_plot_axis_around(p->x, p->log_x));
  gg_plot_axis_print(s, 'y', y_axis_of(p));
  if (p->n > 1 || any)
    fprintf(s, "set key at graph 1.0,%g right top horizontal samplen 1\n", 1 + (above - 22.0) / PLOT);
  else
    fprintf(s, "unset key\n");
  fprintf(s, "set pointintervalbox 0\nplot ");
  for (int k = 0; k < p->n; k++) draw_curve(s, p, k);
  draw_references(s, p, law);
  draw_theory(s, p);
  fprintf(s, "\n");
}

/* The left margin of all panels is that of the longest label. */
void gg_plot_curves(FILE *s, const json_t *document, const json_t *theories, const char *group)
{
  panel panels[MOST_PANELS];
  int n = panels_of(document, theories, group, panels), widest = 0;
  if (!n) return;
  int size[2], columns = columns_for(n), rows = (n + columns - 1) / columns;
  for (int i = 0; i < n; i++) {
    int characters = is_empty(&panels[i]) ? 0 : gg_plot_axis_width(y_axis_of(&panels[i]));
    if (characters > widest) widest = characters;
  }
  find_size(panels, n, size);
  double width = 1.0 / columns, head = (double)HEAD / size[1], height = (1 - head) / rows;
  double left = (Y_LABEL + letter * (widest + 1)) / size[0], below = (double)BELOW / size[1],
         above = (double)above_of(panels, n) / size[1];
  for (int i = 0; i < n; i++) {
    double x = (i % columns) * width, y = 1 - head - (i / columns + 1) * height;
    draw_panel(s, &panels[i], (gg_panel){x + left, x + width - (double)RIGHT / size[0], y + below, y + height - above},
               above_of(panels, n));
  }
}
