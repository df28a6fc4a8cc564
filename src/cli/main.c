/* graingas: dispatch to the subcommands. */
#include <hdf5.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

int gg_cli_report(const gg_error *err)
{
  fflush(stdout);
  fprintf(stderr, "graingas: %s\n", err->message);
  return err->status;
}

int gg_cli_report_of(const char *prefix, const gg_error *err)
{
  return gg_cli_fail(err->status, "%s: %s", prefix, err->message);
}

int gg_cli_fail(gg_status status, const char *format, ...)
{
  gg_error err = {.status = status};
  va_list args;
  va_start(args, format);
  vsnprintf(err.message, sizeof err.message, format, args);
  va_end(args);
  return gg_cli_report(&err);
}

void gg_cli_print_text(char *text)
{
  if (text) puts(text);
  free(text);
}

static void print_help(void)
{
  printf("graingas %s: granular gases of hard spheres, by event-driven molecular dynamics, Enskog Monte Carlo and "
         "theory\n\nUsage: graingas COMMAND ...\n\n",
         gg_version());
  for (const gg_command *c = gg_commands; c->name; c++) {
    char left[64];
    snprintf(left, sizeof left, "%s %s", c->name, c->arguments);
    printf("  %-20s  %s\n", left, c->summary);
  }
  printf("\ngraingas COMMAND --help tells more. Begin with: graingas compare examples/usf.yaml\n");
}

static int unknown(const char *word)
{
  const char *known[16] = {NULL};
  for (int i = 0; gg_commands[i].name && i < 15; i++) known[i] = gg_commands[i].name;
  const char *nearest = gg_nearest_word(word, known);
  if (nearest) return gg_cli_fail(GG_BAD_INPUT, "unknown command '%s'; did you mean '%s'?", word, nearest);
  return gg_cli_fail(GG_BAD_INPUT, "unknown command '%s'; see graingas --help", word);
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
  if (lost && reader_has_gone()) return code;
  return lost && code == GG_OK ? gg_cli_fail(GG_BAD_FILE, "standard output cannot be written") : code;
}

int main(int argc, char **argv)
{
  signal(SIGXFSZ, SIG_IGN); /* a file too large is an error of the write, not the end of the program */
  signal(SIGPIPE, SIG_IGN);
  H5dont_atexit(); /* we close what we open; HDF5 would insist on flushing to a full disk */
  if (argc < 2) {
    print_help();
    return GG_BAD_INPUT;
  }
  if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
    print_help();
    return GG_OK;
  }
  if (strcmp(argv[1], "--version") == 0) {
    printf("graingas %s\n", gg_version());
    return GG_OK;
  }
  if (strcmp(argv[1], "--manual") == 0) {
    gg_cli_print_manual();
    return GG_OK;
  }
  if (strcmp(argv[1], "--scene-page") == 0) {
    gg_cli_print_scene_page();
    return check_output(GG_OK);
  }
  for (const gg_command *c = gg_commands; c->name; c++)
    if (strcmp(c->name, argv[1]) == 0) return check_output(c->run(c, argc - 1, argv + 1));
  return unknown(argv[1]);
}
