/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/progress.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "cli/cli.h"
#include "cli/print.h"

static const double live_every = 0.1, plain_every = 20;

static double now_seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void gg_cli_line_start(gg_cli_line *l, bool quiet)
{
  *l = (gg_cli_line){.quiet = quiet, .terminal = isatty(STDERR_FILENO) != 0, .shown = now_seconds()};
}

static bool is_due(const gg_cli_line *l)
{
  return now_seconds() - l->shown >= (l->terminal ? live_every : plain_every);
}

/* Print the live line, cut to the width of the terminal. */
static void put(gg_cli_line *l, const char *text)
{
  struct winsize window = {0};
  int width = ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col ? window.ws_col - 1 : 79;
  l->shown = now_seconds();
  l->live = l->terminal;
  if (l->terminal)
    fprintf(stderr, "\r%.*s\x1b[K", width, text);
  else if (strcmp(text, l->last) != 0)
    fprintf(stderr, "%s\n", text);
  if (l->terminal) fflush(stderr);
  snprintf(l->last, sizeof l->last, "%s", text);
}

void gg_cli_line_show(gg_cli_line *l, const char *text, bool now)
{
  if (!l->quiet && (now || is_due(l))) put(l, text);
}

void gg_cli_line_clear(gg_cli_line *l)
{
  if (l->live) fputs("\r\x1b[K", stderr);
  l->live = false;
}

void gg_cli_progress_start(gg_cli_progress *p, bool quiet)
{
  memset(p, 0, sizeof *p);
  gg_cli_line_start(&p->line, quiet);
}

/* ", 20 s left"; if the time limit will end the run, ", limit in 36 s (the run needs about 9 min)". */
static int describe_end(const gg_progress *g, char *text, size_t size)
{
  char left[24], limit[24];
  gg_cli_format_duration(g->limit_in, limit, sizeof limit);
  gg_cli_format_duration(g->time_left, left, sizeof left);
  if (isnan(g->time_left)) return isfinite(g->limit_in) ? snprintf(text, size, ", limit in %s", limit) : 0;
  if (g->time_left <= g->limit_in) return snprintf(text, size, ", %s left", left);
  return snprintf(text, size, ", limit in %s (the run needs about %s)", limit, left);
}

/* "md averaging 43 %, 1.2 M collisions, 0.9 M/s, error 1.2 %, 20 s left" */
static void describe(const gg_progress *g, bool brief, char *text, size_t size)
{
  char collisions[24], rate[24];
  gg_cli_format_count((double)g->collisions, collisions, sizeof collisions);
  gg_cli_format_count(g->rate, rate, sizeof rate);
  if (strcmp(g->phase, "start") == 0) {
    const int start = snprintf(text, size, "%s places grains", g->engine);
    describe_end(g, text + start, size - (size_t)start);
    return;
  }
  int used = snprintf(text, size, "%s %s %.0f %%", g->engine, g->phase, floor(100 * g->fraction));
  if (g->replicas > 1 && !brief)
    used += snprintf(text + used, size - (size_t)used, ", %ld replicas", (long)g->replicas);
  used += snprintf(text + used, size - (size_t)used, ", %s%s, %s/s", collisions, brief ? "" : " collisions", rate);
  if (g->relative_error > 0 && isfinite(g->relative_error))
    used += snprintf(text + used, size - (size_t)used, ", error %.2g %%", 100 * g->relative_error);
  used += describe_end(g, text + used, size - (size_t)used);
  if (g->next) snprintf(text + used, size - (size_t)used, ", then %s", g->next);
}

/* Update the live line: the engines that are running, side by side. */
static void show_live(gg_cli_progress *p)
{
  char line[400] = "", part[200];
  bool both = p->last[0].engine && p->last[1].engine;
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    if (!p->last[k].engine) continue;
    describe(&p->last[k], both, part, sizeof part);
    gg_cli_append(line, sizeof line, "%s%s", *line ? "  |  " : "", part);
  }
  put(&p->line, line);
}

static void show_plain(gg_cli_progress *p, int k)
{
  char line[200];
  describe(&p->last[k], false, line, sizeof line);
  *p->line.last = '\0'; /* print it even if unchanged */
  put(&p->line, line);
  p->unreported[k] = false;
}

void gg_cli_progress_show(gg_cli_progress *p, const gg_progress *g)
{
  if (p->line.quiet) return;
  int k = strcmp(g->engine, "dsmc") == 0;
  bool new_phase = strcmp(p->phase[k], g->phase) != 0, due = is_due(&p->line);
  p->last[k] = *g;
  if (p->line.terminal) {
    if (due) show_live(p);
    return;
  }
  p->unreported[k] = true;
  if (!new_phase && !due) return;
  show_plain(p, k);
  snprintf(p->phase[k], sizeof p->phase[k], "%s", g->phase);
}

void gg_cli_progress_end(gg_cli_progress *p)
{
  gg_cli_line_clear(&p->line);
  for (int k = 0; k < GG_CLI_ENGINES; k++) {
    if (!p->unreported[k]) continue;
    p->last[k].time_left = NAN, p->last[k].limit_in = INFINITY; /* the run has ended */
    show_plain(p, k);
  }
}
