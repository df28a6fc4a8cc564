/* How a run relaxed: series from its start to its end, with the averaging window shaded. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "plot/axis.h"
#include "plot/plot.h"

typedef struct curve {
  const char *name;
  char label[24];
  double sign;
  gg_stored_series series;
} curve;

enum { MOST_POINTS = 1200 };

/* The series as gnuplot data; long ones averaged over blocks, so that a picture stays small. */
static void print_data(FILE *s, int k, const curve *c)
{
  const gg_stored_series *d = &c->series;
  size_t block = (d->n + MOST_POINTS - 1) / MOST_POINTS;
  fprintf(s, "$curve%d << EOD\n", k);
  for (size_t i = 0; i < d->n; i += block) {
    double time = 0, value = 0;
    size_t n = 0;
    for (; n < block && i + n < d->n; n++) time += d->time[i + n], value += d->value[i + n];
    if (isfinite(value) && isfinite(time)) fprintf(s, "%.9g %.9g\n", time / (double)n, c->sign * value / (double)n);
  }
  fprintf(s, "EOD\n");
}

/* What is drawn: the blocks' means; over decades of time or value those above 0. */
static gg_extent extent_of(const curve *curves, int n, bool log)
{
  gg_extent all = GG_NO_EXTENT;
  for (int k = 0; k < n; k++)
    for (size_t i = 0; i < curves[k].series.n; i++)
      gg_plot_extent_add(&all, curves[k].sign * curves[k].series.value[i], log);
  return all;
}

static bool spans_decades(gg_extent all)
{
  return all.least > 0 && all.most > 30 * all.least;
}

/* Two of them are seen from 0. */
static gg_axis axis_of(const curve *curves, int n, bool decades)
{
  gg_axis axis = gg_plot_axis_around(extent_of(curves, n, decades), decades);
  if (n > 1 && !decades) axis.from = 0;
  return axis;
}

static const char *unit_of(const gg_stored_engine *e, const char *name)
{
  const json_t *result = json_object_get(json_object_get(e->document, "results"), name);
  const char *unit = json_string_value(json_object_get(result, "unit"));
  return unit ? unit : "1";
}

/* The unit of time that goes with a unit of temperature. */
static const char *time_unit(const gg_stored_engine *e)
{
  const char *temperature = unit_of(e, "temperature");
  if (strstr(temperature, "gamma")) return "1/γ";
  return strstr(unit_of(e, "mean_free_path"), "n d^2") ? "1/(n d^2 v_0)" : "d/v_0";
}

/* A gas that cools for ever comes to times beyond all numbers and to a temperature of 0: drawn up to there. */
static gg_stored_series until_nothing_is_left(const gg_stored_series *d)
{
  gg_stored_series finite = *d, left;
  while (finite.n > 0 && !isfinite(finite.time[finite.n - 1])) finite.n--;
  left = finite;
  while (left.n > 0 && fabs(left.value[left.n - 1]) < DBL_MIN) left.n--;
  return left.n > 0 ? left : finite;
}

static double end_of(const gg_stored_series *d)
{
  return d->time[d->n - 1];
}

static bool draw_mean(FILE *s, const gg_stored_engine *e, const curve *c, double end)
{
  const json_t *result = json_object_get(json_object_get(e->document, "results"), c->name);
  const json_t *mean = json_object_get(result, "mean");
  if (!json_is_number(mean)) return false;
  double y = c->sign * json_number_value(mean);
  fprintf(s, "set arrow from %.9g,%.9g to %.9g,%.9g nohead front dt 2 lw 1.2 lc rgb '#222222'\n",
          fmin(e->window[0], end), y, fmin(e->window[1], end), y);
  return true;
}

/* Cooling goes on over decades of time, too. */
static void set_time_axis(FILE *s, const gg_stored_series *d, double end, bool decades)
{
  double start = d->time[0] > 0 ? d->time[0] : d->time[1];
  if (decades && start > 0 && end > 1000 * start)
    fprintf(s, "set logscale x\nset format x '10^{%%T}'\nset xrange [%.9g:%.9g]\n", start, end);
  else
    fprintf(s, "set xrange [0:%.9g]\n", end);
}

/* Where the name of a curve stands: the mean of its last tenth, or its last value on a logarithmic axis. */
static double level_at_end(const curve *c, bool decades)
{
  size_t n = c->series.n, from = decades ? n - 1 : n - 1 - n / 10;
  double sum = 0;
  for (size_t i = from; i < n; i++) sum += c->series.value[i];
  return c->sign * sum / (double)(n - from);
}

/* Names at the ends of two curves stand no nearer to each other than their letters are high; shares of the panel. */
static void print_names(FILE *s, const curve *curves, int n, gg_axis axis, double end, const char *const colours[])
{
  const double apart = 0.055;
  double at[2] = {0, 0};
  for (int k = 0; k < n; k++) at[k] = gg_plot_axis_share(axis, level_at_end(&curves[k], axis.log));
  double lacking = apart - fabs(at[0] - at[1]), up = at[0] >= at[1] ? 0.5 : -0.5;
  if (n == 2 && lacking > 0) at[0] += up * lacking, at[1] -= up * lacking;
  for (int k = 0; k < n; k++)
    fprintf(s, "set label '%s' at first %.9g, graph %.9g left offset 0.6,0 tc rgb '%s'\n", curves[k].label, end, at[k],
            colours[k]);
}

static void draw(FILE *s, const gg_stored_engine *e, curve *curves, int n, const char *what, gg_panel panel)
{
  static const char *const colours[2][3] = {{"#0072B2", "#56B4E9", "#009E73"}, {"#D55E00", "#E69F00", "#CC79A7"}};
  int found = 0;
  char unit[96];
  for (int k = 0; k < n; k++) {
    curves[found] = curves[k];
    const gg_stored_series *stored = gg_files_stored_series_find(e, curves[k].name);
    if (stored) curves[found].series = until_nothing_is_left(stored);
    if (stored && curves[found].series.n > 1) found++;
  }
  if (!found) return;
  gg_plot_place(s, panel);
  for (int k = 0; k < found; k++) print_data(s, k, &curves[k]);
  bool decades = spans_decades(extent_of(curves, found, false));
  gg_axis axis = axis_of(curves, found, decades);
  gg_plot_axis_print(s, 'y', axis);
  gg_plot_unit(unit_of(e, curves[0].name), unit, sizeof unit);
  bool means = false;
  double end = 0;
  for (int k = 0; k < found; k++) end = fmax(end, end_of(&curves[k].series));
  for (int k = 0; k < found; k++) means |= draw_mean(s, e, &curves[k], end);
  fprintf(s, "set label '%s: %s (shaded: averaged over%s)' at graph 0,1.08 left\n", e->name, what,
          means ? "; dashed: mean" : "");
  fprintf(s, "set xlabel 'time [%s]'\nset ylabel '%s%s%s [%s]' offset 0.5,0\n", time_unit(e), curves[0].label,
          found > 1 ? ", " : "", found > 1 ? curves[1].label : "", unit);
  fprintf(s, "unset key\n");
  if (e->window[1] > e->window[0])
    fprintf(s, "set object 1 rectangle from %.9g,graph 0 to %.9g,graph 1 behind fc rgb '#eef2f5' fs solid noborder\n",
            fmin(e->window[0], end), fmin(e->window[1], end));
  bool md = strcmp(e->name, "md") == 0;
  set_time_axis(s, &curves[0].series, end, decades);
  print_names(s, curves, found, axis, end, colours[md ? 0 : 1]);
  fprintf(s, "plot ");
  for (int k = 0; k < found; k++)
    fprintf(s, "%s$curve%d using 1:2 with lines lw 1.4 lc rgb '%s'", k ? ", " : "", k, colours[md ? 0 : 1][k]);
  fprintf(s, "\n");
}

/* The series of a quantity, to be drawn as `sign` times what it is. */
static curve curve_of(gg_quantity q, double sign)
{
  curve c = {.name = gg_common_quantity_name(q), .sign = sign};
  char symbol[sizeof c.label - 1];
  snprintf(c.label, sizeof c.label, "%s%s", sign < 0 ? "-" : "", gg_common_quantity_symbol(q, symbol, sizeof symbol));
  return c;
}

void gg_plot_relaxation(FILE *s, const gg_stored_engine *e, gg_panel panel)
{
  curve curves[] = {curve_of(GG_Q_TEMPERATURE, 1), curve_of(GG_Q_ROTATIONAL_TEMPERATURE, 1)};
  draw(s, e, curves, 2, "temperature", panel);
}

bool gg_plot_has_stresses(const gg_stored_engine *e)
{
  const gg_quantity stresses[] = {GG_Q_PRESSURE, GG_Q_P_XY};
  bool any = false;
  for (int k = 0; k < 2; k++) {
    const gg_stored_series *series = gg_files_stored_series_find(e, gg_common_quantity_name(stresses[k]));
    any |= series && series->n > 1;
  }
  return any;
}

void gg_plot_stresses(FILE *s, const gg_stored_engine *e, gg_panel panel)
{
  curve curves[] = {curve_of(GG_Q_PRESSURE, 1), curve_of(GG_Q_P_XY, -1)};
  bool sheared = strstr(unit_of(e, "temperature"), "gamma") != NULL;
  draw(s, e, curves, sheared ? 2 : 1, sheared ? "stress" : "pressure", panel);
}
