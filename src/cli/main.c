/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas: dispatch to the subcommands. */
#include <errno.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/processes.h"
#include "cli/progress.h"
#include "files/process.h"

static void print_help(void)
{
  gg_cli_print_paragraph(stdout, 0,
                         "graingas %s: granular gases of hard spheres, by event-driven molecular dynamics, Enskog "
                         "Monte Carlo and theory\n\nUsage: graingas COMMAND ...\n",
                         gg_version());
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    char left[64], lead[80];
    snprintf(left, sizeof left, "%s %s", c->name, c->arguments);
    if (strlen(left) > 20) printf("  %s\n", left), *left = '\0'; /* too long for the column */
    snprintf(lead, sizeof lead, "  %-20s  ", left);
    gg_cli_print_wrapped(stdout, lead, c->summary);
  }
  printf("\n");
  gg_cli_print_wrapped(stdout, "", "See graingas COMMAND --help. Begin with: graingas compare examples/usf.yaml");
}

static bool has_value(const char *word, const char *option)
{
  size_t length = strlen(option);
  return strncmp(word, option, length) == 0 && word[length] == '=';
}

static int unknown(const char *word)
{
  const char *nearest = gg_cli_nearest_command(word);
  if (strcmp(word, "reproduce") == 0)
    return gg_cli_fail(GG_BAD_INPUT,
                       "the figures of papers are reproduced in Python: validation/reproduce of the sources");
  if (gg_cli_has_ending(word, ".yaml") || gg_cli_has_ending(word, ".yml"))
    return gg_cli_fail(GG_BAD_INPUT, "'%s' is not a command; for this scene, e.g. %s compare %s", word,
                       program_invocation_name, word);
  if (gg_cli_has_ending(word, ".h5"))
    return gg_cli_fail(GG_BAD_INPUT, "'%s' is not a command; for this result, e.g. %s info %s", word,
                       program_invocation_name, word);
  if (has_value(word, "--help") || has_value(word, "--version"))
    return gg_cli_fail(GG_BAD_INPUT, "option '%.*s' takes no value", (int)strcspn(word, "="), word);
  for (const gg_option *o = gg_cli_options_table; o->name; o++)
    if (strncmp(word, "--", 2) == 0 && strcmp(o->name, word + 2) == 0)
      return gg_cli_fail(GG_BAD_INPUT, "options come after the command: %s COMMAND %s ...", program_invocation_name,
                         word);
  if (nearest) return gg_cli_fail(GG_BAD_INPUT, "unknown command '%s'; did you mean '%s'?", word, nearest);
  return gg_cli_fail(GG_BAD_INPUT, "unknown command '%s'; see %s --help", word, program_invocation_name);
}

/* Whether standard output is a pipe that nobody reads any more ("graingas info FILE | head"). */
static bool is_reader_gone(void)
{
  struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR);
}

/* Check that standard output was written. A pipe that the reader has closed is not an error. */
static int check_output(int code)
{
  bool lost = fflush(stdout) != 0 || ferror(stdout);
  if (lost && gg_cli_output_lost()) return code == GG_OK ? GG_INTERRUPTED : code;
  if (lost && is_reader_gone()) return code;
  return lost && code == GG_OK ? gg_cli_fail(GG_BAD_FILE, "standard output cannot be written") : code;
}

static const gg_command *find(const char *name)
{
  for (const gg_command *c = gg_cli_commands; c->name; c++)
    if (strcmp(c->name, name) == 0) return c;
  return NULL;
}

static int help(const char *name)
{
  const gg_command *c = name ? find(name) : NULL;
  if (name && !c) return unknown(name);
  if (c)
    gg_cli_command_print_help(c);
  else
    print_help();
  return GG_OK;
}

static int execute(const gg_command *c, int argc, char **argv)
{
  gg_options o;
  int code = gg_cli_options_parse(c, argc, argv, &o);
  if (code == GG_CLI_GO_ON) code = c->run(&o);
  gg_cli_options_clear(&o);
  return code;
}

static int print_completion(const char *shell)
{
  const char *const known[][2] = {
      {"bash", gg_cli_completion_bash}, {"zsh", gg_cli_completion_zsh}, {"fish", gg_cli_completion_fish}};
  for (int i = 0; i < 3; i++)
    if (shell && strcmp(shell, known[i][0]) == 0) return fputs(known[i][1], stdout), GG_OK;
  return gg_cli_fail(GG_BAD_INPUT, "--completion takes the name of a shell: bash, zsh or fish");
}

static int dispatch(int argc, char **argv)
{
  const char *word = argc > 1 ? argv[1] : "";
  const gg_command *c = find(word);
  if (c) return execute(c, argc - 1, argv + 1);
  if (argc < 2) return print_help(), GG_BAD_INPUT;
  if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0)
    return help(argc > 2 ? argv[2] : NULL);
  if (strcmp(word, "--version") == 0) return printf("graingas %s\n", gg_version()), GG_OK;
  if (strcmp(word, "--completion") == 0) return print_completion(argc > 2 ? argv[2] : NULL);
  if (strcmp(word, "--tables") == 0) return gg_cli_print_tables(), GG_OK;
  return unknown(word);
}

static int do_all(int argc, char **argv)
{
  return check_output(dispatch(argc, argv));
}

int main(int argc, char **argv)
{
  gg_error err;
  if (gg_files_process_prepare(&err) != GG_OK) return gg_cli_report(&err);
  return gg_cli_as_one_of_several(argc, argv, do_all);
}
