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

#define AT(member) offsetof(gg_options, member)
/* In place of a place: the value is converted. */
enum { ENGINE = sizeof(gg_options), SET, THEORY, COLLISIONS, SEED, THREADS, VARY, LIMIT };
const gg_option gg_cli_options_table[] = {
    {"run fingerprint", "engine", "md|dsmc", ENGINE, "engine to run instead of the scene's"},
    {"compare run theory sweep validate info fingerprint page", "set", "KEY=VALUE", SET,
     "override a key of the scene, e.g. collision.e=0.8; repeatable"},
    {"theory", "theory", "NAME", THEORY, "evaluate this theory only, or several: NAME,NAME; repeatable"},
    {"fingerprint", "collisions", "N", COLLISIONS, "number of collisions between grains to simulate (default: 100000)"},
    {"compare run sweep validate fingerprint page bench", "seed", "N", SEED, "seed of the random streams (run.seed)"},
    {"compare run sweep validate bench", "threads", "N", THREADS,
     "threads to use; results do not depend on it (default: all processors; under mpirun one a process)"},
    {"compare run plot init page", "output", "FILE", AT(output),
     "file to write (default: NAME of the input, in the current folder: NAME.h5, of a comparison NAME.compare.h5)"},
    {"export", "output", "PREFIX", AT(output),
     "prefix of the file names (default: the input's name, in the current folder)"},
    {"sweep validate", "vary", "KEY=VALUES", VARY,
     "vary one more key, FIRST:LAST:STEP or v1,v2,..., e.g. phi=0.1:0.5:0.1; repeatable, every combination is a point"},
    {"sweep", "does", "WHAT", AT(does), "command for each point: run, compare or theory (sweep.does)"},
    {"sweep validate", "list", NULL, AT(list), "list the points, their state and the expected time; run nothing"},
    {"sweep validate", "point", "K", AT(point), "run only the K-th point of the list"},
    {"sweep", "collect", NULL, AT(collect),
     "collect the results of all points: FOLDER.csv, FOLDER.h5 and the picture FOLDER.svg; run nothing"},
    {"sweep", "over", "KEY", AT(over),
     "with --collect: the key along the picture's axis (default: the one with most values)"},
    {"sweep", "show", "QUANTITIES", AT(show),
     "with --collect: quantities in the picture, separated by commas (default: the main ones)"},
    {"sweep", "log", "AXES", AT(log),
     "with --collect: logarithmic axes, x, y, xy or none (default: y where its values span more than a decade and a "
     "half)"},
    {"sweep", "relative-to", "METHOD", AT(relative_to),
     "with --collect: draw deviations from a method, md, dsmc or a theory, e.g. enskog_hermite"},
    {"sweep", "theories", "THEORIES", AT(mapped),
     "with --collect: theories in the picture, separated by commas (default: all)"},
    {"validate", "show", "QUANTITIES", AT(show),
     "quantities to map, separated by commas (default: temperature, temperature_ratio, pressure, shear_viscosity, N1, "
     "N2)"},
    {"validate", "theories", "THEORIES", AT(mapped),
     "theories in the maps, separated by commas (default: lun1991 and those of the file)"},
    {"validate", "page", "FILE", AT(page), "write maps, counts and tables as a page of Markdown"},
    {"page", "page", "FILE", AT(page), "the page of a release, or one that was built (default: the installed one)"},
    {"sweep", "slurm", NULL, AT(slurm), "print a Slurm script for an array of tasks; run nothing"},
    {"sweep validate", "output", "FOLDER", AT(output),
     "folder of the points' files (default: NAME.sweep, in the current folder)"},
    {"export", "only", "PARTS", AT(only), "parts to write: results, curves, trajectory; separated by commas"},
    {"compare sweep validate bench", "picture", "FILE", AT(picture),
     "picture to draw, .svg, .png, .pdf or .gp (script for gnuplot), or none (default: .svg beside the output; bench: "
     "none)"},
    {"compare sweep validate plot bench", "width", "WIDTH", AT(width),
     "width of the picture on paper, e.g. 86mm: mm, cm, in or pt (default: as for a screen)"},
    {"plot", "format", "svg|png|pdf|gp", AT(format),
     "format of the picture (default: from the output's name, else svg)"},
    {"compare run", "resume", "FILE", AT(resume), "resume from this checkpoint"},
    {"compare run", "extend", "RESULT", AT(extend),
     "continue this finished run, of output.state: kept, to other stopping criteria; in place of SCENE.yaml"},
    {"compare run sweep validate", "accept-version", NULL, AT(accept_version),
     "use checkpoints and points of sweeps of another build, whose numbers may differ"},
    {"compare run theory info", "all", NULL, AT(all),
     "show everything: every quantity, not only the main ones; whole definitions"},
    {"compare run theory sweep validate info fingerprint bench", "json", NULL, AT(json),
     "results as one JSON document on standard output, and nothing else there; bench: a line for each row"},
    {"info", "schema", NULL, AT(schema),
     "JSON Schema of scenes and sweeps, by which editors complete keys and mark errors"},
    {"bench", "limit", "PERCENT", LIMIT,
     "bench compare: exit code 1 if a row is slower by more than this beyond its spread (default: no limit)"},
    {"validate bench", "quick", NULL, AT(quick), "fewer sizes and fewer repeats"},
    {NULL, "quiet", NULL, AT(quiet), "no progress"},
    {0},
};

void gg_cli_command_print_help(const gg_command *c)
{
  printf("Usage: graingas %s %s [OPTION...]\n\n", c->name, c->arguments);
  gg_cli_print_paragraph(stdout, 0, "%s.%s%s\n", c->summary, c->help ? "\n\n" : "", c->help ? c->help : "");
  printf("Options:\n");
  for (const gg_option *o = gg_cli_options_table; o->name; o++) {
    if (!gg_cli_option_is_of(o, c)) continue;
    char name[40], left[60];
    snprintf(name, sizeof name, "--%s%s%s", o->name, o->argument ? " " : "", o->argument ? o->argument : "");
    snprintf(left, sizeof left, "  %-18s  ", name);
    gg_cli_print_wrapped(stdout, left, o->doc);
  }
  gg_cli_print_wrapped(stdout, "  --help              ", "this text");
}

bool gg_cli_option_is_of(const gg_option *o, const gg_command *c)
{
  return !o->commands || gg_cli_has_word(o->commands, c->name);
}

static bool takes(const gg_command *c, const char *option)
{
  for (const gg_option *o = gg_cli_options_table; o->name; o++)
    if (strcmp(o->name, option) == 0 && gg_cli_option_is_of(o, c)) return true;
  return false;
}

/* Reject an unknown option; "-json" is not a group of short options. */
static int refuse_option(const gg_command *c, const char *typed)
{
  char word[48];
  const char *known[sizeof gg_cli_options_table / sizeof *gg_cli_options_table + 1] = {NULL};
  char takers[80] = ""; /* commands that take an option of this name */
  int n = 0;
  snprintf(word, sizeof word, "%.*s", (int)strcspn(typed, "="), typed);
  const char *name = word + strspn(word, "-");
  for (const gg_option *o = gg_cli_options_table; o->name; o++) {
    if (!gg_cli_option_is_of(o, c)) continue;
    if (word[1] == '-' && strcmp(o->name, name) == 0)
      return gg_cli_fail(GG_BAD_INPUT, o->argument ? "option '%s' needs a value" : "option '%s' takes no value", word);
    known[n++] = o->name;
  }
  for (const gg_command *other = gg_cli_commands; other->name && word[1] == '-'; other++)
    if (takes(other, name)) gg_cli_append(takers, sizeof takers, "%s%s", *takers ? ", " : "", other->name);
  if (*takers) return gg_cli_fail(GG_BAD_INPUT, "%s has no option '%s', which is for %s", c->name, word, takers);
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

/* A number of an option: whole from `least` on, or of any kind. */
static int take_number(const char *name, const char *value, bool whole, double least, double most, double *n)
{
  char *end;
  *n = whole ? (double)strtoll(value, &end, 10) : strtod(value, &end);
  if (end != value && !*end && *n >= least && *n <= most) return GG_CLI_GO_ON;
  return gg_cli_fail(GG_BAD_INPUT, "option '--%s': value '%s' is not allowed; allowed: a %snumber from %.15g to %.15g",
                     name, value, whole ? "whole " : "", least, most);
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

static int take(gg_options *o, const gg_option *t, const char *value)
{
  double n = 0;
  int code = GG_CLI_GO_ON;
  switch (t->at) {
  case SET: return add_override(o, NULL, value);
  case SEED: return add_override(o, "run.seed", value);
  case ENGINE: return add_override(o, "engine", value);
  case THEORY: return take_theory(o, value);
  case LIMIT: return take_number(t->name, value, false, 0, 1e6, &o->limit);
  case THREADS:
    code = take_number(t->name, value, true, 1, 4096, &n);
    if (code == GG_CLI_GO_ON) o->threads = (int)n;
    return code;
  case COLLISIONS:
    code = take_number(t->name, value, true, 1, 1e12, &n);
    if (code == GG_CLI_GO_ON) o->collisions = (uint64_t)n;
    return code;
  case VARY:
    if (o->n_vary == GG_MAX_OVERRIDES) return gg_cli_fail(GG_BAD_INPUT, "more than %d keys to vary", GG_MAX_OVERRIDES);
    o->vary[o->n_vary++] = value;
    return code;
  default: break;
  }
  if (t->argument)
    *(const char **)((char *)o + t->at) = value;
  else
    *(bool *)((char *)o + t->at) = true;
  return code;
}

static void list_known(const gg_command *c, struct option *known)
{
  int n = 0;
  for (const gg_option *t = gg_cli_options_table; t->name; t++)
    if (gg_cli_option_is_of(t, c))
      known[n++] = (struct option){t->name, t->argument ? required_argument : no_argument, NULL,
                                   256 + (int)(t - gg_cli_options_table)};
  known[n] = (struct option){"help", no_argument, NULL, 'h'};
}

/* Set the first argument, the further ones that are allowed, and the first surplus one. */
static void take_input(const gg_command *c, gg_options *o, const char *word)
{
  int k = strchr(c->arguments, ' ') ? 0 : GG_MORE_INPUTS;
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
      code = take(o, t, optarg);
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
                       takes(c, "json") ? "; --json prints to standard output" : "");
  if (o->input && !*o->input)
    return gg_cli_fail(GG_BAD_INPUT, "%s: the file name is empty; see %s %s --help", c->name, program_invocation_name,
                       c->name);
  if (o->input || c->arguments[0] == '[') return GG_CLI_GO_ON;
  return gg_cli_fail(GG_BAD_INPUT, "%s needs %s; see %s %s --help", c->name, c->arguments, program_invocation_name,
                     c->name);
}

/* --extend RESULT: scene and state are those of the checkpoint beside the result, or of an interrupted
 * continuation (--resume). */
static int take_extended(gg_options *o)
{
  if (!o->extend) return GG_CLI_GO_ON;
  if (o->input)
    return gg_cli_fail(GG_BAD_INPUT, "--extend %s has the scene of that run: leave out %s", o->extend, o->input);
  o->state = o->resume ? strdup(o->resume) : gg_cli_path_of_checkpoint(o->extend);
  if (!o->state) return gg_cli_fail(GG_FAILED, "out of memory");
  if (!gg_cli_file_exists(o->state))
    return gg_cli_fail(
        GG_BAD_FILE,
        "%s: has no state to continue from: %s is not there (it stays after a run of a scene with output.state: kept)",
        o->extend, o->state);
  o->input = o->extend, o->resume = o->state;
  if (!o->output) o->output = o->extend;
  return GG_CLI_GO_ON;
}

int gg_cli_options_parse(const gg_command *c, int argc, char **argv, gg_options *o)
{
  struct option known[sizeof gg_cli_options_table / sizeof *gg_cli_options_table + 1] = {{0}};
  *o = (gg_options){.command = c, .threads = gg_cli_default_threads(), .limit = -1, .words = {argc, argv, argc}};
  o->command_line = gg_cli_command_line_quote("graingas", &o->words, "");
  list_known(c, known);
  int code = take_words(c, known, o);
  if (code == GG_CLI_GO_ON) code = take_extended(o);
  if (code == GG_CLI_GO_ON) code = check_words(c, o);
  if (code != GG_CLI_GO_ON || !o->input) return code;
  if (strcmp(o->input, "help") == 0 && !gg_cli_file_exists(o->input)) return gg_cli_command_print_help(c), GG_OK;
  return GG_CLI_GO_ON;
}

void gg_cli_options_clear(gg_options *o)
{
  free(o->command_line);
  free(o->theories);
  free(o->state);
  for (int i = 0; i < o->n_overrides; i++) free(o->owned[i]);
  *o = (gg_options){0};
}

/* Apply a KEY=VALUE given after --vary or --set. */
static gg_status apply(bool vary, const char *typed, gg_scene *scene, gg_sweep *sweep, gg_error *err)
{
  const char *option = vary ? "vary" : "set", *example = vary ? "phi=0.1:0.5:0.1" : "collision.e=0.8";
  const char *equals = strchr(typed, '=');
  char key[96];
  if (!equals || equals == typed)
    return gg_cli_refuse(err, GG_BAD_INPUT, "--%s %s: KEY=VALUE is expected, e.g. --%s %s", option, typed, option,
                         example);
  snprintf(key, sizeof key, "%.*s", (int)(equals - typed), typed);
  gg_error why;
  const gg_status status = vary    ? gg_sweep_vary(sweep, key, equals + 1, &why)
                           : sweep ? gg_sweep_set(sweep, key, equals + 1, &why)
                                   : gg_scene_set(scene, key, equals + 1, &why);
  return status == GG_OK ? GG_OK : gg_cli_refuse(err, status, "--%s %.200s: %.800s", option, typed, why.message);
}

gg_status gg_cli_options_apply(const gg_options *o, gg_scene *scene, gg_sweep *sweep, gg_error *err)
{
  gg_status status = GG_OK;
  for (int i = 0; status == GG_OK && i < o->n_vary; i++) status = apply(true, o->vary[i], NULL, sweep, err);
  for (int i = 0; status == GG_OK && i < o->n_overrides; i++) status = apply(false, o->override[i], scene, sweep, err);
  return status;
}

gg_status gg_cli_options_scene(const gg_options *o, gg_scene **scene, gg_error *err)
{
  *scene = NULL;
  gg_checkpoint_info about;
  gg_status status = o->extend ? gg_checkpoint_about(o->state, &(gg_checkpoint_info){0}, scene, err)
                               : gg_scene_load(o->input, scene, err);
  if (status == GG_OK && o->extend && gg_cli_file_exists(o->extend))
    status = gg_checkpoint_check_result(o->state, o->extend, err);
  /* A checkpoint has the tables of its scene, whose files may be gone. */
  if (status != GG_OK && o->resume && !o->extend && strstr(err->message, ": cannot be read: ") &&
      gg_checkpoint_about(o->resume, &about, scene, NULL) == GG_OK) {
    fprintf(stderr, "warning: %s; the scene is that of %s\n", err->message, o->resume);
    status = GG_OK;
  }
  if (status == GG_OK) status = gg_cli_options_apply(o, *scene, NULL, err);
  if (status != GG_OK) gg_scene_free(*scene), *scene = NULL;
  return status;
}

const char *gg_cli_options_name(const gg_options *o)
{
  return strcmp(o->input, "-") == 0 ? "standard input" : o->input;
}

int gg_cli_report_scene(const gg_options *o, gg_status status, const gg_error *err)
{
  return status == GG_OK          ? GG_OK
         : status == GG_BAD_INPUT ? gg_cli_report_of(gg_cli_options_name(o), err)
                                  : gg_cli_report(err);
}
