/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas: dispatch to the subcommands. */
#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/processes.h"
#include "cli/progress.h"

static void print_help(void)
{
  gg_cli_print_paragraph(
      stdout, 0,
      "graingas %s: granular gases of hard spheres, by event-driven molecular dynamics, Enskog Monte "
      "Carlo and theory\n\nUsage: graingas COMMAND ...\n",
      gg_version());
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    char left[64], lead[80];
    snprintf(left, sizeof left, "%s %s", c->name, c->arguments);
    if (strlen(left) > 20) printf("  %s\n", left), *left = '\0'; /* more than there is room for beside it */
    snprintf(lead, sizeof lead, "  %-20s  ", left);
    gg_cli_print_wrapped(stdout, lead, c->summary);
  }
  printf("\n");
  gg_cli_print_wrapped(stdout, "", "See graingas COMMAND --help. Begin with: graingas compare examples/usf.yaml");
}

static bool ends_with(const char *text, const char *end)
{
  size_t length = strlen(text), tail = strlen(end);
  return length > tail && strcmp(text + length - tail, end) == 0;
}

static bool has_value(const char *word, const char *option)
{
  size_t length = strlen(option);
  return strncmp(word, option, length) == 0 && word[length] == '=';
}

static int unknown(const char *word)
{
  const char *known[20] = {"--help", "--version", NULL};
  for (int i = 0; gg_cli_commands[i].name && i < 17; i++) known[i + 2] = gg_cli_commands[i].name;
  const char *nearest = gg_nearest_word(word, known);
  if (strcmp(word, "reproduce") == 0)
    return gg_cli_fail(GG_BAD_INPUT,
                       "the figures of papers are reproduced in Python: validation/reproduce of the sources");
  if (ends_with(word, ".yaml") || ends_with(word, ".yml"))
    return gg_cli_fail(GG_BAD_INPUT, "'%s' is not a command; for this scene, e.g. %s compare %s", word,
                       program_invocation_name, word);
  if (ends_with(word, ".h5"))
    return gg_cli_fail(GG_BAD_INPUT, "'%s' is not a command; for this result, e.g. %s info %s", word,
                       program_invocation_name, word);
  for (int i = 0; i < 2; i++)
    if (has_value(word, known[i])) return gg_cli_fail(GG_BAD_INPUT, "option '%s' takes no value", known[i]);
  for (const gg_option *o = gg_cli_options_table; o->flag; o++)
    if (strncmp(word, "--", 2) == 0 && strcmp(o->name, word + 2) == 0)
      return gg_cli_fail(GG_BAD_INPUT, "options come after the command: %s COMMAND %s ...", program_invocation_name,
                         word);
  if (nearest) return gg_cli_fail(GG_BAD_INPUT, "unknown command '%s'; did you mean '%s'?", word, nearest);
  return gg_cli_fail(GG_BAD_INPUT, "unknown command '%s'; see %s --help", word, program_invocation_name);
}

/* A pipe whose reader has gone ("graingas info FILE | head"). */
static bool reader_has_gone(void)
{
  struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR);
}

/* What was printed has to have arrived, unless the reader had enough of it. */
static int check_output(int code)
{
  bool lost = fflush(stdout) != 0 || ferror(stdout);
  if (lost && gg_cli_output_lost()) return code == GG_OK ? GG_INTERRUPTED : code;
  if (lost && reader_has_gone()) return code;
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

static int dispatch(int argc, char **argv)
{
  const char *word = argc > 1 ? argv[1] : "";
  const gg_command *c = find(word);
  if (c) return c->run(c, argc - 1, argv + 1);
  if (argc < 2) return print_help(), GG_BAD_INPUT;
  if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0)
    return help(argc > 2 ? argv[2] : NULL);
  if (strcmp(word, "--version") == 0) return printf("graingas %s\n", gg_version()), GG_OK;
  if (strcmp(word, "--completion") == 0) return gg_cli_print_completion(argc > 2 ? argv[2] : NULL);
  if (strcmp(word, "--manual") == 0) return gg_cli_print_manual(), GG_OK;
  if (strcmp(word, "--quantities-page") == 0) return gg_cli_print_quantities_page(), GG_OK;
  if (strcmp(word, "--commands-page") == 0) return gg_cli_print_commands_page(), GG_OK;
  if (strcmp(word, "--scene-page") == 0) return gg_cli_print_scene_page(), GG_OK;
  return unknown(word);
}

static int do_all(int argc, char **argv)
{
  return check_output(dispatch(argc, argv));
}

/* HDF5's first call uses some bytes without a look at whether it got them. */
static bool has_memory(void)
{
  void *volatile room = malloc(1 << 20);
  const bool got = room;
  free(room);
  return got;
}

/* A file that is opened while a standard stream is closed takes its number, and what is said there would go into it.
 * The wrong way round: whoever reads or writes there is told that it cannot be. */
static void keep_standard_streams(void)
{
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
    if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) != fd) return;
}

int main(int argc, char **argv)
{
  keep_standard_streams();
  signal(SIGXFSZ, SIG_IGN); /* a file too large is an error of the write, not the end of the program */
  signal(SIGPIPE, SIG_IGN);
  if (!has_memory()) return gg_cli_fail(GG_FAILED, "out of memory");
  H5dont_atexit(); /* we close what we open; HDF5 would insist on flushing to a full disk */
  return gg_cli_as_one_of_several(argc, argv, do_all);
}
