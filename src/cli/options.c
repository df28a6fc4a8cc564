/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/options.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/processes.h"

const gg_option gg_cli_options_table[] = {
    {GG_OPT_ENGINE, "engine", "md|dsmc", "engine to run instead of the scene's"},
    {GG_OPT_SET, "set", "KEY=VALUE", "override a key of the scene, e.g. collision.e=0.8; repeatable"},
    {GG_OPT_THEORY, "theory", "NAME", "evaluate this theory only, or several: NAME,NAME; repeatable"},
    {GG_OPT_COLLISIONS, "collisions", "N", "number of collisions between grains to simulate (default: 100000)"},
    {GG_OPT_SEED, "seed", "N", "seed of the random streams (run.seed)"},
    {GG_OPT_THREADS, "threads", "N",
     "threads to use; results do not depend on it (default: all processors; under mpirun one a process)"},
    {GG_OPT_OUTPUT, "output", "FILE",
     "file to write (default: NAME of the input, in the current folder: NAME.h5, of a comparison NAME.compare.h5)"},
    {GG_OPT_PREFIX, "output", "PREFIX", "prefix of the file names (default: the input's name, in the current folder)"},
    {GG_OPT_SWEEP | GG_OPT_VALIDATE, "vary", "KEY=VALUES",
     "vary one more key, FIRST:LAST:STEP or v1,v2,..., e.g. phi=0.1:0.5:0.1; repeatable, every combination is a point"},
    {GG_OPT_SWEEP, "does", "WHAT", "command for each point: run, compare or theory (sweep.does)"},
    {GG_OPT_SWEEP | GG_OPT_VALIDATE, "list", NULL, "list the points, their state and the expected time; run nothing"},
    {GG_OPT_SWEEP | GG_OPT_VALIDATE, "point", "K", "run only the K-th point of the list"},
    {GG_OPT_SWEEP, "collect", NULL,
     "collect the results of all points: FOLDER.csv, FOLDER.h5 and the picture FOLDER.svg; run nothing"},
    {GG_OPT_SWEEP, "over", "KEY",
     "with --collect: the key along the picture's axis (default: the one with most values)"},
    {GG_OPT_SWEEP, "show", "QUANTITIES",
     "with --collect: quantities in the picture, separated by commas (default: the main ones)"},
    {GG_OPT_SWEEP, "log", "AXES",
     "with --collect: logarithmic axes, x, y, xy or none (default: y where its values span more than a decade and a "
     "half)"},
    {GG_OPT_SWEEP, "relative-to", "METHOD",
     "with --collect: draw deviations from a method, md, dsmc or a theory, e.g. enskog_hermite"},
    {GG_OPT_SWEEP, "theories", "THEORIES",
     "with --collect: theories in the picture, separated by commas (default: all)"},
    {GG_OPT_VALIDATE, "show", "QUANTITIES",
     "quantities to map, separated by commas (default: temperature, temperature_ratio, pressure, shear_viscosity, N1, "
     "N2)"},
    {GG_OPT_VALIDATE, "theories", "THEORIES",
     "theories in the maps, separated by commas (default: lun1991 and those of the file)"},
    {GG_OPT_VALIDATE, "page", "FILE", "write maps, counts and tables as a page of Markdown"},
    {GG_OPT_PAGE, "page", "FILE", "the page of a release, or one that was built (default: the installed one)"},
    {GG_OPT_SWEEP, "slurm", NULL, "print a Slurm script for an array of tasks; run nothing"},
    {GG_OPT_SWEEP | GG_OPT_VALIDATE, "output", "FOLDER",
     "folder of the points' files (default: NAME.sweep, in the current folder)"},
    {GG_OPT_ONLY, "only", "PARTS", "parts to write: results, curves, trajectory; separated by commas"},
    {GG_OPT_PICTURE, "picture", "FILE",
     "picture to draw, .svg, .png, .pdf or .gp (script for gnuplot), or none (default: .svg beside the output; bench: "
     "none)"},
    {GG_OPT_PICTURE | GG_OPT_FORMAT, "width", "WIDTH",
     "width of the picture on paper, e.g. 86mm: mm, cm, in or pt (default: as for a screen)"},
    {GG_OPT_FORMAT, "format", "svg|png|pdf|gp", "format of the picture (default: from the output's name, else svg)"},
    {GG_OPT_RESUME, "resume", "FILE", "resume from this checkpoint"},
    {GG_OPT_ACCEPT, "accept-version", NULL,
     "use checkpoints and points of sweeps of another build, whose numbers may differ"},
    {GG_OPT_ALL, "all", NULL, "show everything: every quantity, not only the main ones; whole definitions"},
    {GG_OPT_JSON, "json", NULL,
     "results as one JSON document on standard output, and nothing else there; bench: a line for each row"},
    {GG_OPT_SCHEMA, "schema", NULL, "JSON Schema of scenes and sweeps, by which editors complete keys and mark errors"},
    {GG_OPT_LIMIT, "limit", "PERCENT",
     "bench compare: exit code 1 if a row is slower by more than this beyond its spread (default: no limit)"},
    {GG_OPT_QUICK, "quick", NULL, "fewer sizes and fewer repeats"},
    {GG_OPT_QUIET, "quiet", NULL, "no progress"},
    {0},
};

void gg_cli_command_print_help(const gg_command *c)
{
  printf("Usage: graingas %s %s [OPTION...]\n\n", c->name, c->arguments);
  gg_cli_print_paragraph(stdout, 0, "%s.%s%s\n", c->summary, c->help ? "\n\n" : "", c->help ? c->help : "");
  printf("Options:\n");
  for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
    if (!(c->options & o->flag)) continue;
    char name[40], left[60];
    snprintf(name, sizeof name, "--%s%s%s", o->name, o->argument ? " " : "", o->argument ? o->argument : "");
    snprintf(left, sizeof left, "  %-18s  ", name);
    gg_cli_print_wrapped(stdout, left, o->doc);
  }
  gg_cli_print_wrapped(stdout, "  --help              ", "this text");
}

/* "compare, bench" */
static void list_takers(unsigned flags, char *text, size_t size)
{
  size_t used = 0;
  for (const gg_command *c = gg_cli_commands; c->name && used < size; c++)
    if (c->options & flags) used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", c->name);
}

/* Reject an unknown option; "-json" is not a group of short options. */
static int refuse_option(const gg_command *c, const char *typed)
{
  char word[48];
  const char *known[sizeof gg_cli_options_table / sizeof *gg_cli_options_table + 1] = {NULL};
  int n = 0;
  unsigned others = 0; /* options of this name that the command does not take */
  snprintf(word, sizeof word, "%.*s", (int)strcspn(typed, "="), typed);
  const char *name = word + strspn(word, "-");
  for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
    bool same = word[1] == '-' && strcmp(o->name, name) == 0;
    if (same) others |= o->flag;
    if (!(c->options & o->flag)) continue;
    if (same)
      return gg_cli_fail(GG_BAD_INPUT, o->argument ? "option '%s' needs a value" : "option '%s' takes no value", word);
    known[n++] = o->name;
  }
  if (others) {
    char takers[80] = "";
    list_takers(others, takers, sizeof takers);
    return gg_cli_fail(GG_BAD_INPUT, "%s has no option '%s', which is for %s", c->name, word, takers);
  }
  if (strcmp(word, "--help") == 0) return gg_cli_fail(GG_BAD_INPUT, "option '--help' takes no value");
  known[n] = "help";
  const char *nearest = gg_nearest_word(name, known);
  if (nearest) return gg_cli_fail(GG_BAD_INPUT, "unknown option '%s'; did you mean '--%s'?", word, nearest);
  return gg_cli_fail(GG_BAD_INPUT, "unknown option '%s'; see %s %s --help", word, program_invocation_name, c->name);
}

/* "--seed 7" is "--set run.seed=7", "--engine md" is "--set engine=md". */
static int add_override(gg_options *o, const char *key, const char *value)
{
  int n = o->n_overrides;
  if (n == GG_MAX_OVERRIDES) return gg_cli_fail(GG_BAD_INPUT, "more than %d overrides", GG_MAX_OVERRIDES);
  if (key && asprintf(&o->owned[n], "%s=%s", key, value) < 0) return gg_cli_fail(GG_FAILED, "out of memory");
  o->override[n] = key ? o->owned[n] : value;
  o->n_overrides++;
  return GG_CLI_GO_ON;
}

enum { MOST_THREADS = 4096 };

static int take_threads(gg_options *o, const char *value)
{
  char *end;
  long n = strtol(value, &end, 10);
  if (end == value || *end || n < 1 || n > MOST_THREADS)
    return gg_cli_fail(GG_BAD_INPUT,
                       "option '--threads': value '%s' is not allowed; allowed: a whole number from 1 to %d", value,
                       MOST_THREADS);
  o->threads = (int)n;
  return GG_CLI_GO_ON;
}

#define MOST_COLLISIONS 1000000000000LL

static int take_collisions(gg_options *o, const char *value)
{
  char *end;
  long long n = strtoll(value, &end, 10);
  if (end == value || *end || n < 1 || n > MOST_COLLISIONS)
    return gg_cli_fail(GG_BAD_INPUT,
                       "option '--collisions': value '%s' is not allowed; allowed: a whole number from 1 to %lld",
                       value, MOST_COLLISIONS);
  o->collisions = (uint64_t)n;
  return GG_CLI_GO_ON;
}

static int take_limit(gg_options *o, const char *value)
{
  char *end;
  o->limit = strtod(value, &end);
  if (end != value && !*end && o->limit >= 0 && o->limit <= 1e6) return GG_CLI_GO_ON;
  return gg_cli_fail(GG_BAD_INPUT, "option '--limit': value '%s' is not allowed; allowed: a number from 0 to 1000000",
                     value);
}

static int take_vary(gg_options *o, const char *value)
{
  if (o->n_vary == GG_MAX_OVERRIDES) return gg_cli_fail(GG_BAD_INPUT, "more than %d keys to vary", GG_MAX_OVERRIDES);
  o->vary[o->n_vary++] = value;
  return GG_CLI_GO_ON;
}

static int take_theory(gg_options *o, const char *value)
{
  char *all = NULL;
  if (asprintf(&all, "%s%s%s", o->theories ? o->theories : "", o->theories ? "," : "", value) < 0)
    return gg_cli_fail(GG_FAILED, "out of memory");
  free(o->theories);
  o->theories = all;
  return GG_CLI_GO_ON;
}

/* Set an option of sweep or validate, by its name. */
static int take_sweep(gg_options *o, const char *name, const char *value)
{
  if (strcmp(name, "vary") == 0) return take_vary(o, value);
  if (strcmp(name, "does") == 0) o->does = value;
  if (strcmp(name, "point") == 0) o->point = value;
  if (strcmp(name, "output") == 0) o->output = value;
  if (strcmp(name, "over") == 0) o->over = value;
  if (strcmp(name, "show") == 0) o->show = value;
  if (strcmp(name, "log") == 0) o->log = value;
  if (strcmp(name, "relative-to") == 0) o->relative_to = value;
  if (strcmp(name, "theories") == 0) o->mapped = value;
  if (strcmp(name, "page") == 0) o->page = value;
  o->list |= strcmp(name, "list") == 0;
  o->collect |= strcmp(name, "collect") == 0;
  o->slurm |= strcmp(name, "slurm") == 0;
  return GG_CLI_GO_ON;
}

static int take(gg_options *o, unsigned flag, const char *name, const char *value)
{
  switch (flag) {
  case GG_OPT_SET: return add_override(o, NULL, value);
  case GG_OPT_SEED: return add_override(o, "run.seed", value);
  case GG_OPT_ENGINE: return add_override(o, "engine", value);
  case GG_OPT_THREADS: return take_threads(o, value);
  case GG_OPT_COLLISIONS: return take_collisions(o, value);
  case GG_OPT_THEORY: return take_theory(o, value);
  case GG_OPT_OUTPUT:
  case GG_OPT_PREFIX: o->output = value; break;
  case GG_OPT_LIMIT: return take_limit(o, value);
  case GG_OPT_ONLY: o->only = value; break;
  case GG_OPT_PICTURE | GG_OPT_FORMAT: o->width = value; break;
  case GG_OPT_PICTURE: o->picture = value; break;
  case GG_OPT_FORMAT: o->format = value; break;
  case GG_OPT_RESUME: o->resume = value; break;
  case GG_OPT_PAGE: o->page = value; break;
  case GG_OPT_ACCEPT: o->accept_version = true; break;
  case GG_OPT_ALL: o->all = true; break;
  case GG_OPT_JSON: o->json = true; break;
  case GG_OPT_QUICK: o->quick = true; break;
  case GG_OPT_SCHEMA: o->schema = true; break;
  case GG_OPT_QUIET: o->quiet = true; break;
  case GG_OPT_SWEEP:
  case GG_OPT_VALIDATE:
  case GG_OPT_SWEEP | GG_OPT_VALIDATE: return take_sweep(o, name, value);
  default: break;
  }
  return GG_CLI_GO_ON;
}

static void list_known(const gg_command *c, struct option *known)
{
  int n = 0;
  for (const gg_option *t = gg_cli_options_table; t->flag; t++)
    if (c->options & t->flag)
      known[n++] = (struct option){t->name, t->argument ? required_argument : no_argument, NULL,
                                   256 + (int)(t - gg_cli_options_table)};
  known[n] = (struct option){"help", no_argument, NULL, 'h'};
}

/* Set the first argument, the further ones that are allowed, and the first surplus one. */
static void take_input(const gg_command *c, gg_options *o, const char *word)
{
  int k = c->options & GG_OPT_MORE ? 0 : GG_MORE_INPUTS;
  while (k < GG_MORE_INPUTS && o->more[k]) k++;
  const char **free_place = !o->input ? &o->input : k < GG_MORE_INPUTS ? &o->more[k] : &o->surplus;
  if (!*free_place) *free_place = word;
}

/* Parse the words in their order, also under POSIXLY_CORRECT ("-" in the option string). --slurm is removed from the
 * recorded words: the tasks of the script run the same command without it. */
static int take_words(const gg_command *c, const struct option *known, gg_options *o)
{
  const char *value = NULL, *last;
  int code = GG_CLI_GO_ON, argc = o->words.n;
  char **argv = o->words.word;
  opterr = 0, optind = 0;
  for (int got, at = 1; code == GG_CLI_GO_ON && (got = getopt_long(argc, argv, "-h", known, NULL)) != -1; at = optind) {
    if (got == 'h') return gg_cli_command_print_help(c), GG_OK;
    if (got != 1 && got < 256) return refuse_option(c, argv[at]);
    value = optarg;
    if (got == 1) {
      take_input(c, o, optarg);
    } else {
      const gg_option *t = &gg_cli_options_table[got - 256];
      code = take(o, t->flag, t->name, optarg);
      if (strcmp(t->name, "slurm") == 0) argv[at] = NULL;
    }
  }
  last = argv[optind - 1];
  if (last && last != value && strcmp(last, "--") == 0) o->words.options_end = optind - 1;
  for (; optind < argc; optind++) take_input(c, o, argv[optind]);
  return code;
}

static int check_words(const gg_command *c, const gg_options *o)
{
  if (o->surplus)
    return gg_cli_fail(GG_BAD_INPUT, "%s takes one %s; '%s' is one too many", c->name, c->arguments, o->surplus);
  if (o->output && strcmp(o->output, "-") == 0)
    return gg_cli_fail(GG_BAD_INPUT, "option '--output': '-' is not a file to write%s",
                       c->options & GG_OPT_JSON ? "; --json prints to standard output" : "");
  if (o->input && !*o->input)
    return gg_cli_fail(GG_BAD_INPUT, "%s: the file name is empty; see %s %s --help", c->name, program_invocation_name,
                       c->name);
  if (o->input || c->arguments[0] == '[') return GG_CLI_GO_ON;
  return gg_cli_fail(GG_BAD_INPUT, "%s needs %s; see %s %s --help", c->name, c->arguments, program_invocation_name,
                     c->name);
}

int gg_cli_options_parse(const gg_command *c, int argc, char **argv, gg_options *o)
{
  struct option known[sizeof gg_cli_options_table / sizeof *gg_cli_options_table + 1] = {{0}};
  *o = (gg_options){.threads = gg_cli_default_threads(), .limit = -1, .words = {argc, argv, argc}};
  o->command_line = gg_cli_command_line_quote("graingas", &o->words, "");
  list_known(c, known);
  int code = take_words(c, known, o);
  if (code == GG_CLI_GO_ON) code = check_words(c, o);
  if (code != GG_CLI_GO_ON || !o->input) return code;
  if (strcmp(o->input, "help") == 0 && !gg_cli_file_exists(o->input)) return gg_cli_command_print_help(c), GG_OK;
  return GG_CLI_GO_ON;
}

void gg_cli_options_clear(gg_options *o)
{
  free(o->command_line);
  free(o->theories);
  for (int i = 0; i < o->n_overrides; i++) free(o->owned[i]);
  *o = (gg_options){0};
}

gg_status gg_cli_options_set(const char *option, const char *typed, const char *example, gg_options_setter *set,
                             void *target, gg_error *err)
{
  const char *equals = strchr(typed, '=');
  char key[96];
  if (!equals || equals == typed)
    return gg_cli_refuse(err, GG_BAD_INPUT, "--%s %s: KEY=VALUE is expected, e.g. --%s %s", option, typed, option,
                         example);
  snprintf(key, sizeof key, "%.*s", (int)(equals - typed), typed);
  gg_error why;
  if (set(target, key, equals + 1, &why) == GG_OK) return GG_OK;
  return gg_cli_refuse(err, why.status, "--%s %.200s: %.800s", option, typed, why.message);
}

static gg_status set_scene(void *scene, const char *key, const char *value, gg_error *err)
{
  return gg_scene_set(scene, key, value, err);
}

gg_status gg_cli_options_scene(const gg_options *o, gg_scene **scene, gg_error *err)
{
  gg_status status = gg_scene_load(o->input, scene, err);
  for (int i = 0; i < o->n_overrides && status == GG_OK; i++)
    status = gg_cli_options_set("set", o->override[i], "collision.e=0.8", set_scene, *scene, err);
  return status;
}

const char *gg_cli_options_name(const gg_options *o)
{
  return strcmp(o->input, "-") == 0 ? "standard input" : o->input;
}
