/* md, dsmc and the theories side by side. Quantities with a scale are shown as ratios to md (to dsmc where md did not
 * run), so that all fit on one axis; those around zero as they are. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "plot/plot.h"

/* A quantity of the picture. */
typedef struct entry {
  const char *name, *word;
  char symbol[24]; /* as gnuplot writes it; empty: the name as it is */
} entry;
enum { MOST_OWN = 6, MOST_SELECTED = GG_N_QUANTITIES + MOST_OWN };
enum { MOST_METHODS = 16, MOST_WORDY = 9 };

typedef struct method {
  const char *name;
  const json_t *results;
} method;

/* A quantity that the program that made the file brought with it. */
static bool is_own(const char *quantity)
{
  return gg_common_quantity_find(quantity) == GG_N_QUANTITIES;
}

/* Does it say anything about what is drawn? */
static bool has_entries(const json_t *results)
{
  const char *name;
  json_t *own;
  json_object_foreach((json_t *)(uintptr_t)results, name, own)
  {
    if (is_own(name)) return true;
  }
  const unsigned drawn = GG_DRAWN | GG_DRAWN_AS_RATIO;
  gg_quantity q = gg_common_quantity_next(-1, drawn);
  while (q < GG_N_QUANTITIES && !json_object_get(results, gg_common_quantity_name(q)))
    q = gg_common_quantity_next(q, drawn);
  return q < GG_N_QUANTITIES;
}

static int methods_of(const gg_stored_result *stored, method *methods)
{
  int n = 0;
  const char *name;
  json_t *theory;
  for (int k = 0; k < 2; k++)
    if (stored->engine[k].name)
      methods[n++] = (method){stored->engine[k].name, json_object_get(stored->engine[k].document, "results")};
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
  {
    if (n < MOST_METHODS && has_entries(theory)) methods[n++] = (method){name, theory};
  }
  return n;
}

static double number(const method *m, const char *quantity, const char *member)
{
  const json_t *x = json_object_get(json_object_get(m->results, quantity), member);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

/* Is it measured, and told from zero? */
static bool is_told(const method *engine, const char *name, bool *from_zero)
{
  double mean = number(engine, name, "mean"), error = number(engine, name, "stderr");
  *from_zero = fabs(mean) > 3 * (isfinite(error) ? error : 0);
  return isfinite(mean);
}

/* The entries of one kind that an engine has measured, and told from zero if they are to be divided by; and some of the
 * program's own, as ratios where they can be. */
static int select_entries(const method *engine, bool ratio, entry *selected)
{
  int n = 0, n_own = 0;
  bool from_zero;
  const char *name;
  json_t *own;
  const unsigned drawn = ratio ? GG_DRAWN_AS_RATIO : GG_DRAWN;
  for (gg_quantity q = gg_common_quantity_next(-1, drawn); q < GG_N_QUANTITIES; q = gg_common_quantity_next(q, drawn)) {
    if (!is_told(engine, gg_common_quantity_name(q), &from_zero) || (ratio && !from_zero)) continue;
    selected[n] = (entry){.name = gg_common_quantity_name(q), .word = gg_common_quantity_word(q)};
    gg_common_quantity_symbol(q, selected[n].symbol, sizeof selected[n].symbol);
    n++;
  }
  json_object_foreach((json_t *)(uintptr_t)engine->results, name, own)
  {
    if (n_own == MOST_OWN || !is_own(name) || !is_told(engine, name, &from_zero) || from_zero != ratio) continue;
    selected[n++] = (entry){.name = name, .word = ""};
    n_own++;
  }
  return n;
}

static int colour_of(const method *m, int index)
{
  if (strcmp(m->name, "md") == 0) return 0;
  if (strcmp(m->name, "dsmc") == 0) return 1;
  return 2 + index % (GG_PLOT_COLOURS - 2);
}

static void print_points(FILE *s, int k, const method *m, const method *reference, bool ratio, const entry *selected,
                         int n, double offset)
{
  fprintf(s, "$method%d << EOD\n", k);
  for (int i = 0; i < n; i++) {
    const char *name = selected[i].name;
    double scale = ratio ? number(reference, name, "mean") : 1;
    double mean = number(m, name, "mean") / scale, error = fabs(number(m, name, "stderr") / scale);
    if (isfinite(mean)) fprintf(s, "%.4f %.9g %.9g\n", i + 1 + offset, mean, isfinite(error) ? error : 0);
  }
  fprintf(s, "EOD\n");
}

/* How far the axis reaches below and above 1: all that is there, but not to the ends of the world. */
static void find_reach(const method *methods, int n_methods, const entry *selected, int n, double reach[2])
{
  const double most[2] = {0.75, 0.75};
  reach[0] = reach[1] = 0.003;
  for (int k = 0; k < n_methods; k++)
    for (int i = 0; i < n; i++) {
      const char *name = selected[i].name;
      double reference = number(&methods[0], name, "mean"), off = number(&methods[k], name, "mean") / reference - 1;
      double error = number(&methods[k], name, "stderr") / fabs(reference);
      if (!isfinite(off)) continue;
      if (!isfinite(error)) error = 0;
      reach[0] = fmax(reach[0], error - off), reach[1] = fmax(reach[1], error + off);
    }
  for (int side = 0; side < 2; side++) reach[side] = fmin(reach[side], most[side]);
  double margin = 0.08 * (reach[0] + reach[1]);
  for (int side = 0; side < 2; side++) reach[side] = fmin(reach[side] + margin, most[side]);
}

/* What lies outside the axis is named at its edge. */
static void label_outliers(FILE *s, const method *m, const method *reference, const entry *selected, int n,
                           double offset, const double *reach, const char *colour)
{
  for (int i = 0; i < n; i++) {
    double ratio = number(m, selected[i].name, "mean") / number(reference, selected[i].name, "mean");
    bool above = ratio > 1;
    if (!isfinite(ratio) || fabs(ratio - 1) <= reach[above]) continue;
    fprintf(s, "set label '%s %.3g' at first %.4f, graph %g rotate by 90 %s tc rgb '%s' font ',9'\n", above ? "→" : "←",
            ratio, i + 1 + offset, above ? 0.99 : 0.01, above ? "right" : "left", colour);
  }
}

/* "word\nsymbol", in double quotes; a name of one's own stands as it is: no subscripts in it, and nothing that gnuplot
 * would do. Of many entries (species have one each) the symbols alone: words would run into each other. */
static void print_label(FILE *s, const entry *e, bool wordy)
{
  if (*e->word && (wordy || !*e->symbol)) fprintf(s, "%s\\n", e->word);
  fputs(e->symbol, s);
  for (const char *c = e->name; !*e->symbol && *c; c++)
    if (*c == '_')
      fputs("\\\\_", s);
    else
      fputc(isalnum((unsigned char)*c) || strchr(" .-+/()", *c) || (*c & 0x80) ? *c : '?', s);
}

static void print_categories(FILE *s, const entry *selected, int n)
{
  fprintf(s, "set xtics (");
  for (int i = 0; i < n; i++) {
    fprintf(s, "%s\"", i ? ", " : "");
    print_label(s, &selected[i], n <= MOST_WORDY);
    fprintf(s, "\" %d", i + 1);
  }
  fprintf(s, ") scale 0\nset xrange [0.45:%g]\n", n + 0.55);
  for (int i = 1; i < n; i++)
    fprintf(s, "set arrow from %g,graph 0 to %g,graph 1 nohead back lc rgb '#eeeeee' lw 0.8\n", i + 0.5, i + 0.5);
}

/* The legend names every method, also one that has nothing in this panel. */
static void plot_methods(FILE *s, const method *methods, int n, bool legend)
{
  static const int shapes[] = {7, 5, 8, 10, 12, 4, 6, 14, 2, 1}; /* md and dsmc filled, theories open */
  enum { N_SHAPES = sizeof shapes / sizeof *shapes };
  int theories = 2;
  fprintf(s, "plot ");
  for (int k = 0; k < n; k++) {
    int colour = colour_of(&methods[k], k);
    bool engine = colour < 2;
    char style[80];
    snprintf(style, sizeof style, "pt %d ps %g lw 1.3 lc rgb '%s'",
             engine ? shapes[colour] : shapes[theories++ % N_SHAPES], engine ? 0.6 : 0.9, gg_plot_colours[colour]);
    fprintf(s, "%s$method%d using 1:2%s %s notitle", k ? ", " : "", k, engine ? ":3 with yerrorbars" : " with points",
            style);
    if (!legend) continue;
    fprintf(s, ", keyentry with points %s title '", style);
    gg_plot_text(s, methods[k].name);
    fputc('\'', s);
  }
  fprintf(s, "\n");
}

static void draw(FILE *s, const gg_stored_result *stored, bool ratio, gg_panel panel)
{
  method methods[MOST_METHODS];
  entry selected[MOST_SELECTED];
  int n_methods = methods_of(stored, methods);
  int n = n_methods ? select_entries(&methods[0], ratio, selected) : 0;
  if (n == 0) return;
  gg_plot_place(s, panel);
  double step = fmin(0.8 / n_methods, 0.13), first = -step * (n_methods - 1) / 2, reach[2];
  if (ratio) find_reach(methods, n_methods, selected, n, reach);
  for (int k = 0; k < n_methods; k++) {
    print_points(s, k, &methods[k], &methods[0], ratio, selected, n, first + k * step);
    if (ratio)
      label_outliers(s, &methods[k], &methods[0], selected, n, first + k * step, reach,
                     gg_plot_colours[colour_of(&methods[k], k)]);
  }
  print_categories(s, selected, n);
  fprintf(s, "set xlabel ''\n");
  fprintf(s, "set key at screen 0.5,0.935 center top vertical maxrows 2 noenhanced samplen 0.6 width 1.5\n");
  if (ratio) {
    fprintf(s, "set ylabel 'value / ");
    gg_plot_text(s, methods[0].name);
    fprintf(s, "' offset 0.5,0\nset yrange [%g:%g]\n", 1 - reach[0], 1 + reach[1]);
    fprintf(s, "set arrow from graph 0,first 1 to graph 1,first 1 nohead back lc rgb '#888888' lw 1\n");
  } else {
    fprintf(s, "set ylabel 'value' offset 0.5,0\nset offsets graph 0, graph 0, graph 0.06, graph 0.06\n");
    fprintf(s, "set arrow from graph 0,first 0 to graph 1,first 0 nohead back lc rgb '#888888' lw 1\n");
  }
  plot_methods(s, methods, n_methods, ratio || !gg_plot_has(stored, true));
}

void gg_plot_ratios(FILE *s, const gg_stored_result *stored, gg_panel panel)
{
  draw(s, stored, true, panel);
}

void gg_plot_differences(FILE *s, const gg_stored_result *stored, gg_panel panel)
{
  draw(s, stored, false, panel);
}

bool gg_plot_has(const gg_stored_result *stored, bool ratios)
{
  method methods[MOST_METHODS];
  entry selected[MOST_SELECTED];
  return methods_of(stored, methods) > 0 && select_entries(&methods[0], ratios, selected) > 0;
}
