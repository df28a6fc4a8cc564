/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas export: tables and trajectories of a result file for other programs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/progress.h"

static const char *const words[] = {"results", "curves", "trajectory", NULL};
static const unsigned part[] = {GG_EXPORT_RESULTS, GG_EXPORT_CURVES, GG_EXPORT_TRAJECTORY};

static int refuse(const char *word)
{
  const char *nearest = gg_nearest_word(word, words);
  return gg_cli_fail(GG_BAD_INPUT,
                     "option '--only': value '%s' is not allowed; allowed: results, curves, trajectory%s%s", word,
                     nearest ? "; did you mean " : "", nearest ? nearest : "");
}

/* "curves,trajectory"; NULL: all. */
static int take_parts(const char *only, unsigned *parts)
{
  *parts = only ? 0 : GG_EXPORT_ALL;
  for (const char *at = only; at;) {
    char word[24];
    size_t length = strcspn(at, ","), k = 0;
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    while (words[k] && strcmp(words[k], word) != 0) k++;
    if (!words[k]) return refuse(word);
    *parts |= part[k];
    at = at[length] ? at + length + 1 : NULL;
  }
  return GG_CLI_GO_ON;
}

/* Prefix of the files: --output without the ending .csv or .xyz; by default the input's base name, in the current
 * folder. */
static char *prefix_of(const gg_options *o)
{
  const char *slash = strrchr(o->input, '/'), *name = slash ? slash + 1 : o->input;
  if (!o->output) return gg_cli_path_with_suffix(name, "");
  const char *dot = strrchr(o->output, '.');
  bool ending = dot && (strcmp(dot, ".csv") == 0 || strcmp(dot, ".xyz") == 0);
  return ending ? gg_cli_path_with_suffix(o->output, "") : strdup(o->output);
}

/* Check --output as it is given, before its ending is removed: "x.csv" is a file name even if there is a folder x. */
static int check_output(const char *output)
{
  struct stat about;
  if (!output || stat(output, &about) != 0 || !S_ISDIR(about.st_mode)) return GG_CLI_GO_ON;
  const char *slash = output[strlen(output) - 1] == '/' ? "" : "/";
  return gg_cli_fail(GG_BAD_INPUT, "%s: is a folder; give %s%sNAME, how the names of the files begin", output, output,
                     slash);
}

typedef struct export_command {
  bool quiet, grains; /* grains: a trajectory was written */
  gg_cli_line line;
} export_command;

/* Print the file name on standard output, for scripts. */
static void print_file(void *context, const char *file)
{
  export_command *c = context;
  const char *ending = strrchr(file, '.');
  gg_cli_line_clear(&c->line);
  c->grains |= ending && strcmp(ending, ".xyz") == 0;
  if (!c->quiet) gg_cli_print_name(stdout, "", file, "\n");
}

/* Progress, since a trajectory may take minutes. */
static void show_progress(void *context, double share)
{
  char text[40];
  snprintf(text, sizeof text, "trajectory %.0f %%", floor(100 * share));
  gg_cli_line_show(&((export_command *)context)->line, text, false);
}

/* Warn about grains of dsmc between walls, which have only heights: drawn, they would be a line. */
static void print_if_heights(const char *file)
{
  gg_result *r = NULL;
  gg_result_info info;
  if (gg_result_read(file, &r, NULL) == GG_OK && gg_result_get_info(r, &info, NULL) == GG_OK &&
      strcmp(info.engine, "dsmc") == 0) {
    fflush(stdout);
    gg_cli_print_name(stderr, "warning: ", file, ": ");
    fprintf(stderr, "grains of dsmc between walls have heights alone: x and z are 0 in the trajectory\n");
  }
  gg_result_free(r);
}

/* Raise the limit of open files. All files are open at once, each with a lock, and a mixture of 16 species has more
 * curves than the usual limit. */
static void allow_many_files(void)
{
  struct rlimit files;
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
}

int gg_cli_export_main(const gg_options *o)
{
  gg_error err;
  unsigned parts;
  export_command c = {.quiet = o->quiet};
  int code = take_parts(o->only, &parts);
  if (code == GG_CLI_GO_ON) code = check_output(o->output);
  if (code != GG_CLI_GO_ON) return code;
  GG_CLI_FREED char *prefix = prefix_of(o);
  if (!prefix) return gg_cli_fail(GG_FAILED, "out of memory");
  allow_many_files();
  gg_cli_print_notice(o->input);
  gg_cli_line_start(&c.line, o->quiet);
  gg_status status = gg_export(o->input, prefix, parts, print_file, show_progress, NULL, &c, &err);
  gg_cli_line_clear(&c.line);
  if (status == GG_OK && c.grains) print_if_heights(o->input);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}
