/* graingas sweep --list: a line a point, and the time that those which are missing will take. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/number_format.h"
#include "cli/sweep.h"

enum { MOST_KEYS = 256 };

typedef struct widths {
  size_t n;
  int of[MOST_KEYS];
} widths;

static int longer(int width, const char *text)
{
  int length = (int)strlen(text);
  return length > width ? length : width;
}

/* Of the columns of the varied keys. */
static widths measure(const gg_sweep *sweep)
{
  widths w = {0};
  for (const char *key; w.n < MOST_KEYS && (key = gg_sweep_key(sweep, w.n)); w.n++) {
    w.of[w.n] = longer(0, key);
    for (size_t i = 0; i < gg_sweep_points(sweep); i++) w.of[w.n] = longer(w.of[w.n], gg_sweep_value(sweep, i, w.n));
  }
  return w;
}

static void print_head(const gg_sweep *sweep, const widths *w)
{
  printf("%5s  ", "point");
  for (size_t k = 0; k < w->n; k++) printf("%-*s  ", w->of[k], gg_sweep_key(sweep, k));
  printf("%-16s  %-7s  %8s  %s\n", "file", "state", "replicas", "time");
}

/* Whoever takes part in its time: the missing ones. */
static double print_point(const gg_sweep_command *c, const widths *w, size_t i, gg_point_state state)
{
  static const char *const states[] = {"", "done", "short"};
  char time[24];
  gg_sweep_point p;
  if (gg_sweep_at(c->sweep, i, &p, NULL) != GG_OK) return 0;
  gg_cli_format_duration(p.cpu_seconds, time, sizeof time);
  printf("%5zu  ", i + 1);
  for (size_t k = 0; k < w->n; k++) printf("%-*s  ", w->of[k], gg_sweep_value(c->sweep, i, k));
  printf("%-16s  %-7s  %8ld  %s\n", p.name, states[state], (long)p.replicas, time);
  return state == GG_POINT_MISSING ? p.cpu_seconds : 0;
}

int gg_cli_sweep_list(const gg_sweep_command *c)
{
  size_t done = 0, n = gg_sweep_points(c->sweep);
  double seconds = 0;
  const widths w = measure(c->sweep);
  print_head(c->sweep, &w);
  for (size_t i = 0; i < n; i++) {
    gg_point_state state = GG_POINT_MISSING;
    gg_sweep_find(c->sweep, c->folder, i, &state, NULL, NULL);
    done += state != GG_POINT_MISSING;
    seconds += print_point(c, &w, i, state);
  }
  char time[24];
  int threads = c->options->threads;
  gg_cli_format_duration(seconds / threads, time, sizeof time);
  printf("\n%s at %zu point%s, of which %zu %s done; about %s on %d thread%s for the others\n", gg_sweep_does(c->sweep),
         n, n == 1 ? "" : "s", done, done == 1 ? "is" : "are", time, threads, threads == 1 ? "" : "s");
  return GG_OK;
}
