/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas sweep: a run, a comparison or the theories at every point of a grid of scenes. graingas validate: both
 * engines and the theories against Enskog's equation, over a grid. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/processes.h"
#include "cli/progress.h"

typedef struct sweep_command {
  const gg_options *options;
  gg_sweep *sweep; /* checked */
  char *folder;
  gg_cli_line line;
  bool over;   /* the final progress was shown */
  bool tables; /* tables of the points follow */
} sweep_command;

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

/* Widths of the columns of the varied keys. */
static widths measure(const gg_sweep *sweep)
{
  widths w = {0};
  for (const char *key; w.n < MOST_KEYS && (key = gg_sweep_key(sweep, w.n)); w.n++) {
    w.of[w.n] = longer(0, key);
    for (size_t i = 0; i < gg_sweep_points(sweep); i++) w.of[w.n] = longer(w.of[w.n], gg_sweep_value(sweep, i, w.n));
  }
  return w;
}

/* Whether a point is done. Damaged points and points of other builds run again. */
static bool is_done(const sweep_command *c, gg_point_state state)
{
  return state == GG_POINT_DONE || state == GG_POINT_SHORT ||
         (state == GG_POINT_OTHER_BUILD && c->options->accept_version);
}

/* Print a point; returns its expected time, 0 if it is done. */
static double print_point(const sweep_command *c, const widths *w, size_t i, gg_point_state state)
{
  static const char *const states[] = {"", "done", "short", "another build", "damaged"};
  char time[24];
  gg_sweep_point p;
  if (gg_sweep_at(c->sweep, i, &p, NULL) != GG_OK) return 0;
  gg_cli_format_duration(p.cpu_seconds, time, sizeof time);
  printf("%5zu  ", i + 1);
  for (size_t k = 0; k < w->n; k++) printf("%-*s  ", w->of[k], gg_sweep_value(c->sweep, i, k));
  printf("%-16s  %-13s  %8ld  %s\n", p.name, states[state], (long)p.replicas, time);
  return is_done(c, state) ? 0 : p.cpu_seconds;
}

/* --list: a line for each point, and the expected time of points that are not done. */
static int list(const sweep_command *c)
{
  size_t done = 0, again = 0, n = gg_sweep_points(c->sweep);
  double seconds = 0;
  const widths w = measure(c->sweep);
  printf("%5s  ", "point");
  for (size_t k = 0; k < w.n; k++) printf("%-*s  ", w.of[k], gg_sweep_key(c->sweep, k));
  printf("%-16s  %-13s  %8s  %s\n", "file", "state", "replicas", "time");
  for (size_t i = 0; i < n; i++) {
    gg_point_state state = GG_POINT_MISSING;
    gg_sweep_find(c->sweep, c->folder, i, &state, NULL, NULL);
    done += is_done(c, state), again += state != GG_POINT_MISSING && !is_done(c, state);
    seconds += print_point(c, &w, i, state);
  }
  char time[24];
  int threads = c->options->threads;
  gg_cli_format_duration(seconds / threads, time, sizeof time);
  printf("\n%s at %zu point%s, of which %zu %s done; about %s on %d thread%s for the others\n", gg_sweep_does(c->sweep),
         n, n == 1 ? "" : "s", done, done == 1 ? "is" : "are", time, threads, threads == 1 ? "" : "s");
  if (again)
    printf("%zu %s: damaged, or of another build of graingas (--accept-version keeps the latter)\n", again,
           again == 1 ? "point will run again" : "points will run again");
  return GG_OK;
}

/* Clusters allow about 1000 tasks in an array (MaxArraySize). */
enum { MOST_TASKS = 1000 };

/* Time limit of a task: the longest task at a quarter of the expected speed, in whole hours. */
static long hours(const sweep_command *c, size_t tasks)
{
  double longest = 0;
  size_t n = gg_sweep_points(c->sweep);
  gg_sweep_point p;
  for (size_t first = 0; first < tasks; first++) {
    double seconds = 0;
    for (size_t i = first; i < n; i += tasks)
      if (gg_sweep_at(c->sweep, i, &p, NULL) == GG_OK) seconds += p.cpu_seconds;
    longest = fmax(longest, seconds);
  }
  return (long)ceil(4 * longest / 3600 + 1e-9);
}

/* --slurm: print an array script that distributes the points over tasks. */
static int print_slurm(const sweep_command *c)
{
  size_t n = gg_sweep_points(c->sweep), tasks = n < MOST_TASKS ? n : MOST_TASKS;
  long h = hours(c, tasks);
  GG_CLI_FREED char *command =
      gg_cli_command_line_quote(program_invocation_name, &c->options->words,
                                " --point \"$point\" --threads \"${SLURM_CPUS_PER_TASK:-1}\" --quiet");
  if (!command) return gg_cli_fail(GG_FAILED, "out of memory");
  printf("#!/bin/bash\n"
         "# %zu points; finished ones are skipped.\n"
         "#SBATCH --job-name=graingas-sweep\n"
         "#SBATCH --array=1-%zu\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --time=%ld:00:00\n"
         "status=0\n"
         "for ((point = ${SLURM_ARRAY_TASK_ID:-1}; point <= %zu; point += %zu)); do\n"
         "  %s || status=$?\n"
         "done\n"
         "exit \"$status\"\n",
         n, tasks, h > 0 ? h : 1, n, tasks, command);
  return GG_OK;
}

static void describe(const gg_sweep_progress *p, char *text, size_t size)
{
  char left[24];
  snprintf(text, size, "%zu of %zu points done, %zu running", p->done, p->points, p->running);
  if (p->elsewhere) gg_cli_append(text, size, ", %zu in other processes", p->elsewhere);
  if (p->fell_short) gg_cli_append(text, size, ", %zu short", p->fell_short);
  if (p->failed) gg_cli_append(text, size, ", %zu failed", p->failed);
  if (p->relative_error > 0 && isfinite(p->relative_error))
    gg_cli_append(text, size, ", error up to %.2g %%", 100 * p->relative_error);
  if (!isfinite(p->time_left) || p->done + p->failed == p->points) return;
  gg_cli_format_duration(p->time_left, left, sizeof left);
  gg_cli_append(text, size, ", %s left", left);
}

/* Show progress: a live line on a terminal, otherwise plain lines at intervals. */
static void show_progress(void *context, const gg_sweep_progress *p)
{
  char line[240];
  sweep_command *c = context;
  describe(p, line, sizeof line);
  bool over = p->done + p->failed == p->points;
  gg_cli_line_show(&c->line, line, over && !c->over);
  c->over |= over;
}

/* Read the input, or without one the YAML `text` called `name`; apply --vary and overrides, and check it. */
static gg_status read_sweep(const gg_options *o, const char *text, const char *name, gg_sweep **sweep, gg_error *err)
{
  gg_status status = o->input ? gg_sweep_load(o->input, sweep, err) : gg_sweep_parse(text, name, sweep, err);
  if (status == GG_OK) status = gg_cli_options_apply(o, NULL, *sweep, err);
  if (status == GG_OK && o->does) status = gg_sweep_set(*sweep, "sweep.does", o->does, err);
  return status == GG_OK ? gg_sweep_check(*sweep, err) : status;
}

static void print_point_end(void *context, size_t i, gg_status status, const char *file, const char *message)
{
  sweep_command *c = context;
  if (status == GG_OK) return;
  gg_cli_line_clear(&c->line);
  fprintf(stderr, "point %zu", i + 1);
  for (size_t k = 0; gg_sweep_key(c->sweep, k); k++)
    fprintf(stderr, "%s%s %s", k ? ", " : " (", gg_sweep_key(c->sweep, k), gg_sweep_value(c->sweep, i, k));
  fprintf(stderr, ")%s: %s\n", file ? " ended short" : " failed", message);
}

static void warn(void *context, const char *message)
{
  gg_cli_line_clear(&((sweep_command *)context)->line);
  fprintf(stderr, "warning: %s\n", message);
}

static int take_point(const sweep_command *c, size_t *i)
{
  char *end;
  size_t n = gg_sweep_points(c->sweep);
  unsigned long k = strtoul(c->options->point, &end, 10);
  *i = k - 1;
  if (end != c->options->point && !*end && k >= 1 && k <= n) return GG_CLI_GO_ON;
  return gg_cli_fail(GG_BAD_INPUT, "option '--point': value '%s' is not allowed; allowed: a whole number from 1 to %zu",
                     c->options->point, n);
}

/* Run the missing points, or that of --point. */
static int work(sweep_command *c)
{
  gg_error err;
  size_t i = 0;
  const gg_options *o = c->options;
  const gg_sweep_options options = {.size = sizeof options,
                                    .threads = o->threads,
                                    .workers = gg_cli_workers(o->threads),
                                    .command = o->command_line,
                                    .input = o->input,
                                    .accept_version = o->accept_version,
                                    .context = c,
                                    .progress = show_progress,
                                    .stop = gg_cli_interrupted,
                                    .ended = print_point_end,
                                    .warn = warn};
  int code = o->point ? take_point(c, &i) : GG_CLI_GO_ON;
  if (code != GG_CLI_GO_ON) return code;
  gg_cli_catch_interrupts();
  gg_cli_line_start(&c->line, o->quiet);
  gg_status status = o->point ? gg_sweep_run_point(c->sweep, c->folder, i, &options, &err)
                              : gg_sweep_run(c->sweep, c->folder, &options, &err);
  gg_cli_line_clear(&c->line);
  if (status == GG_OK && !o->quiet)
    gg_cli_print_name(stderr, "results: ", c->folder,
                      c->tables ? "\n" : "; --collect makes one table and a picture of them\n");
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

/* Print the file name on standard output, for scripts. */
static void print_file(void *context, const char *file)
{
  const gg_options *o = ((const sweep_command *)context)->options;
  if (!o->quiet && !o->json) gg_cli_print_name(stdout, "", file, "\n");
}

/* Prefix of the tables: the folder's name. (A run of the same scene uses the scene's name.) */
static char *tables_of(const char *folder)
{
  const char *slash = strrchr(folder, '/'), *name = slash ? slash + 1 : folder;
  return strcmp(name, ".") == 0 || strcmp(name, "..") == 0 ? realpath(folder, NULL) : strdup(folder);
}

/* Write the tables PREFIX.csv and PREFIX.h5, and a picture unless `picture` is "none". */
static int collect(sweep_command *c, const char *picture)
{
  gg_error err;
  const gg_options *o = c->options;
  const gg_collect_options options = {.size = sizeof options,
                                      .command = o->command_line,
                                      .picture = picture,
                                      .width = o->width,
                                      .over = o->over,
                                      .show = o->show,
                                      .log = o->log,
                                      .relative_to = o->relative_to,
                                      .theories = o->mapped,
                                      .threads = o->threads,
                                      .progress = show_progress,
                                      .stop = gg_cli_interrupted,
                                      .warn = warn};
  GG_CLI_FREED char *prefix = tables_of(c->folder);
  if (!prefix) return gg_cli_fail(GG_FAILED, "%s: no name can be made for the tables: %s", c->folder, strerror(errno));
  gg_cli_catch_interrupts();
  gg_cli_line_start(&c->line, o->quiet);
  gg_status status = gg_sweep_collect(c->sweep, c->folder, prefix, &options, print_file, c, &err);
  gg_cli_line_clear(&c->line);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

static int print_json(const sweep_command *c)
{
  gg_error err;
  char *text = NULL;
  if (gg_sweep_to_json(c->sweep, c->folder, &text, &err) != GG_OK) return gg_cli_report(&err);
  gg_cli_print_text(text);
  return GG_OK;
}

/* Reject options that contradict each other or would have no effect. */
static int check_together(const gg_options *o)
{
  const char *does[] = {o->list ? "--list" : NULL, o->collect ? "--collect" : NULL, o->slurm ? "--slurm" : NULL,
                        o->point ? "--point" : NULL};
  const char *first = NULL, *drawing = o->over          ? "--over"
                                       : o->show        ? "--show"
                                       : o->log         ? "--log"
                                       : o->relative_to ? "--relative-to"
                                       : o->mapped      ? "--theories"
                                       : o->picture     ? "--picture"
                                       : o->width       ? "--width"
                                                        : NULL;
  for (size_t k = 0; k < sizeof does / sizeof *does; k++) {
    if (does[k] && first) return gg_cli_fail(GG_BAD_INPUT, "options '%s' and '%s' do not go together", first, does[k]);
    if (does[k]) first = does[k];
  }
  if (drawing && !o->collect) return gg_cli_fail(GG_BAD_INPUT, "option '%s' goes with --collect", drawing);
  if (o->slurm && o->json) return gg_cli_fail(GG_BAD_INPUT, "options '--slurm' and '--json' do not go together");
  if (o->slurm && strcmp(o->input, "-") == 0)
    return gg_cli_fail(GG_BAD_INPUT, "option '--slurm': the tasks need a file to read, not standard input");
  return GG_CLI_GO_ON;
}

/* Whether the input is the folder of a sweep, which holds the sweep. */
static bool is_folder(const gg_options *o)
{
  struct stat about;
  return o->input && !o->output && stat(o->input, &about) == 0 && S_ISDIR(about.st_mode);
}

/* Set the results folder: --output, by default the input's name, without an input `name`. */
static gg_status find_folder(sweep_command *c, const char *name, gg_error *err)
{
  const gg_options *o = c->options;
  const bool made = !is_folder(o) && (o->input || o->output);
  c->folder = made ? gg_cli_options_output(o, ".sweep", err) : strdup(o->input ? o->input : name);
  if (!c->folder) return made ? err->status : gg_cli_refuse(err, GG_FAILED, "out of memory");
  for (size_t n = strlen(c->folder); n > 1 && c->folder[n - 1] == '/'; n--)
    c->folder[n - 1] = '\0'; /* shells add '/' when they complete a folder */
  return GG_OK;
}

static int sweep_points(sweep_command *c)
{
  gg_error err;
  const gg_options *o = c->options;
  if (!gg_sweep_key(c->sweep, 0))
    return gg_cli_fail(GG_BAD_INPUT,
                       "%s: no key is varied; give e.g. vary: {phi: [0.1, 0.2]} there, or --vary phi=0.1,0.2",
                       gg_cli_options_name(o));
  if (find_folder(c, NULL, &err) != GG_OK) return gg_cli_report(&err);
  if (o->slurm) return print_slurm(c);
  if (o->list && !o->json) return list(c);
  const int code = o->list ? GG_OK : o->collect ? collect(c, o->picture) : work(c);
  return o->json && code != GG_BAD_INPUT && print_json(c) != GG_OK ? GG_FAILED : code;
}

int gg_cli_sweep_main(const gg_options *o)
{
  gg_error err;
  sweep_command c = {.options = o};
  int code = check_together(o);
  if (code == GG_CLI_GO_ON && read_sweep(o, NULL, NULL, &c.sweep, &err) != GG_OK) code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = sweep_points(&c);
  gg_sweep_free(c.sweep);
  free(c.folder);
  return code;
}

/* graingas validate. */

static void add_word(FILE *out, const char *option, const char *value)
{
  char *quoted = gg_cli_shell_quote(value);
  if (quoted) fprintf(out, " %s%s%s", option, *option ? " " : "", quoted);
  free(quoted);
}

/* The command that repeats a point with other random numbers in another folder, without its number; to be freed. */
static char *command_to_repeat(const gg_options *o)
{
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  fprintf(out, "graingas validate");
  if (o->input) add_word(out, "", o->input);
  if (o->quick && !o->input) fprintf(out, " --quick");
  for (int i = 0; i < o->n_vary; i++) add_word(out, "--vary", o->vary[i]);
  for (int i = 0; i < o->n_overrides; i++) add_word(out, "--set", o->override[i]);
  fprintf(out, " --seed 2 --output again.sweep --point");
  return fclose(out) == 0 ? text : (free(text), NULL);
}

static int judge(sweep_command *c)
{
  gg_error err;
  char *verdict = NULL;
  GG_CLI_FREED char *maps = gg_cli_path_with_suffix(c->folder, ".svg"), *repeat = command_to_repeat(c->options);
  const gg_options *o = c->options;
  const bool drawn = !o->point && !(o->picture && strcmp(o->picture, "none") == 0);
  const gg_validate_options options = {.size = sizeof options,
                                       .command = o->command_line,
                                       .repeat = repeat,
                                       .picture = !drawn       ? NULL
                                                  : o->picture ? o->picture
                                                               : maps,
                                       .width = o->width,
                                       .show = o->show,
                                       .theories = o->mapped,
                                       .page = o->page,
                                       .json = o->json,
                                       .warn = warn};
  gg_status status = gg_sweep_validate(c->sweep, c->folder, &options, print_file, c, &verdict, &err);
  if (verdict) {
    if (!o->quiet && !o->point && !o->json) printf("\n");
    gg_cli_print_text(verdict);
  }
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

/* Run and validate. Failed and incomplete points are already reported; the verdict uses the others. */
static int validate(sweep_command *c)
{
  c->tables = true;
  const int code = work(c);
  if (code != GG_OK && code != GG_FAILED) return code;
  int tables = c->options->point ? GG_OK : collect(c, "none");
  if (tables != GG_OK) return tables;
  const int verdict = judge(c);
  return verdict == GG_OK ? code : verdict;
}

static int check_validation(const gg_options *o)
{
  if (o->quick && o->input)
    return gg_cli_fail(GG_BAD_INPUT, "option '--quick' is for the standard grid, without a file");
  if (o->point && o->page) return gg_cli_fail(GG_BAD_INPUT, "options '--point' and '--page' do not go together");
  if (o->json && o->list) return gg_cli_fail(GG_BAD_INPUT, "options '--list' and '--json' do not go together");
  if (o->page && o->input && gg_cli_file_is_same(o->page, o->input))
    return gg_cli_fail(GG_BAD_INPUT, "%s: would be overwritten by its own page; choose another --page", o->input);
  if (o->point && o->list) return gg_cli_fail(GG_BAD_INPUT, "options '--list' and '--point' do not go together");
  return GG_CLI_GO_ON;
}

int gg_cli_validate_main(const gg_options *given)
{
  gg_error err;
  gg_options o = *given;
  sweep_command c = {.options = &o};
  int code = check_validation(&o);
  if (!o.does) o.does = "compare";
  if (code == GG_CLI_GO_ON &&
      (read_sweep(&o, gg_standard_grid(o.quick), "the standard grid", &c.sweep, &err) != GG_OK ||
       find_folder(&c, o.quick ? "grid_quick.sweep" : "grid.sweep", &err) != GG_OK))
    code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = o.list ? list(&c) : validate(&c);
  gg_sweep_free(c.sweep);
  free(c.folder);
  return code;
}
