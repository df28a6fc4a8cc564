#include "plot/axis.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Below no_decade a logarithmic axis has the tics of a linear axis. */
enum { TICS = 6, MOST_DECADES = 7 };
static const double few_decades = 2.2, no_decade = 0.7;

void gg_plot_extent_add(gg_extent *e, double value, bool log)
{
  if (!isfinite(value) || (log && value <= 0)) return;
  e->least = fmin(e->least, value), e->most = fmax(e->most, value);
}

gg_axis gg_plot_axis_around(gg_extent e, bool log)
{
  if (!(e.least <= e.most)) return log ? (gg_axis){true, 0.1, 1} : (gg_axis){false, 0, 1};
  if (log) {
    double room = fmax(pow(e.most, 0.05) / pow(e.least, 0.05), 1.05);
    return (gg_axis){true, fmax(e.least / room, DBL_MIN), fmin(e.most * room, DBL_MAX)};
  }
  double size = fmax(fabs(e.least), fabs(e.most)), room = fmax(0.05 * (e.most - e.least), 1e-3 * size);
  if (room < 1e-290) room = 1; /* beside numbers that small there are none to make tics of */
  gg_axis a = {false, e.least - room, e.most + room};
  if (e.least > 0 && e.least < 0.3 * e.most) a.from = fmin(0, a.from);
  if (e.most < 0 && e.most > 0.3 * e.least) a.to = fmax(0, a.to);
  return a;
}

double gg_plot_axis_share(gg_axis a, double x)
{
  if (!a.log) return (x - a.from) / (a.to - a.from);
  return (log10(x) - log10(a.from)) / (log10(a.to) - log10(a.from));
}

/* Width of what gnuplot makes of enhanced text: braces and marks take no room. */
static int width_of(const char *text)
{
  int n = 0;
  for (const char *c = text; *c; c++) n += !strchr("{}^_", *c) && (*c & 0xc0) != 0x80;
  return n;
}

/* To the digits that a step asks for: "0.25", or "2.5·10^{6}" where that is long. */
static void write_number(double x, double step, char *text, size_t size)
{
  int last = (int)floor(log10(step) + 1e-9), first = x == 0 ? last : (int)floor(log10(fabs(x)) + 1e-9);
  if (fabs(x) < 1e-9 * step) {
    snprintf(text, size, "0");
  } else if (first < 5 && last >= -4) {
    snprintf(text, size, "%.*f", last < 0 ? -last : 0, x);
  } else if (fabs(x / pow(10, first) - 1) < 1e-9) {
    snprintf(text, size, "10^{%d}", first);
  } else {
    snprintf(text, size, "%.*f·10^{%d}", first > last ? first - last : 0, x / pow(10, first), first);
  }
}

/* Of one digit: "10^{-4}", "2·10^{-4}". */
static void write_power(double x, char *text, size_t size)
{
  int power = (int)floor(log10(x) + 1e-9), digit = (int)lround(x / pow(10, power));
  if (digit == 1)
    snprintf(text, size, "10^{%d}", power);
  else
    snprintf(text, size, "%d·10^{%d}", digit, power);
}

typedef struct tics {
  FILE *script; /* NULL: only measured */
  int n, widest;
} tics;

static void put(tics *t, double at, double step, bool powers)
{
  char text[48];
  if (powers)
    write_power(at, text, sizeof text);
  else
    write_number(at, step, text, sizeof text);
  if (t->script) fprintf(t->script, "%s'%s' %.12g", t->n++ ? ", " : "", text, at);
  int width = width_of(text);
  if (width > t->widest) t->widest = width;
}

/* Steps of 1, 2 or 5. */
static double round_step(double span)
{
  double raw = span / TICS, decade = pow(10, floor(log10(raw))), r = raw / decade;
  return decade * (r <= 1.4 ? 1 : r <= 3 ? 2 : r <= 7 ? 5 : 10);
}

static void linear(tics *t, gg_axis a)
{
  double step = round_step(a.to - a.from);
  double first = ceil(a.from / step - 1e-6), last = floor(a.to / step + 1e-6);
  if (!(step > 0 && last - first < 10 * TICS)) return;
  for (double k = first; k <= last; k++) put(t, k * step, step, false);
}

/* The quotient of its ends may be more than a number holds. */
static double decades_of(gg_axis a)
{
  return log10(a.to) - log10(a.from);
}

static bool is_within(gg_axis a, double x)
{
  return x >= a.from * (1 - 1e-9) && x <= a.to * (1 + 1e-9);
}

/* From one named decade to the next: every second or third, or in round steps where there are hundreds. */
static int decades_apart(double decades)
{
  int every = 1 + (int)(decades / MOST_DECADES);
  return every < 10 ? every : (int)round_step(decades);
}

/* Whole decades; where there are few of them also their double and fivefold; else small tics between them. */
static void logarithmic(tics *t, gg_axis a)
{
  double decades = decades_of(a);
  bool powers = a.from < 0.9e-3 || a.to > 1.1e4;
  int every = decades_apart(decades);
  for (int k = (int)floor(log10(a.from)); k <= (int)ceil(log10(a.to)); k++)
    for (int i = 1; i < 10; i++) {
      double unit = pow(10, k), x = i * unit;
      bool named = i == 1 ? k % every == 0 : (i == 2 || i == 5) && decades < few_decades;
      if (!is_within(a, x)) continue;
      if (named)
        put(t, x, unit, powers);
      else if (t->script && (every == 1 || (i == 1 && every < 10)))
        fprintf(t->script, "%s'' %.12g 1", t->n++ ? ", " : "", x);
    }
}

static void place(tics *t, gg_axis a)
{
  if (a.log && decades_of(a) > no_decade)
    logarithmic(t, a);
  else
    linear(t, a);
}

void gg_plot_axis_print(FILE *s, char which, gg_axis a)
{
  tics t = {.script = s};
  fprintf(s, "set %crange [%.12g:%.12g]\n%s logscale %c\nset %ctics (", which, a.from, a.to, a.log ? "set" : "unset",
          which, which);
  place(&t, a);
  fprintf(s, ")\n");
}

int gg_plot_axis_width(gg_axis a)
{
  tics t = {.script = NULL};
  place(&t, a);
  return t.widest;
}
