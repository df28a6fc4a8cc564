/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas validate: both engines and the theories against Enskog's equation, over a grid. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/sweep_command.h"

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

static int judge(gg_cli_sweep_options *c)
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
                                       .warn = gg_cli_sweep_warn};
  gg_status status = gg_sweep_validate(c->sweep, c->folder, &options, gg_cli_sweep_print_file, c, &verdict, &err);
  if (verdict) {
    if (!o->quiet && !o->point && !o->json) printf("\n");
    gg_cli_print_text(verdict);
  }
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

/* Run and validate. Failed and incomplete points are already reported; the verdict uses the others. */
static int validate(gg_cli_sweep_options *c)
{
  c->tables = true;
  const int code = gg_cli_sweep_work(c);
  if (code != GG_OK && code != GG_FAILED) return code;
  int tables = c->options->point ? GG_OK : gg_cli_sweep_collect(c, "none");
  if (tables != GG_OK) return tables;
  const int verdict = judge(c);
  return verdict == GG_OK ? code : verdict;
}

static int check_together(const gg_options *o)
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
  gg_cli_sweep_options c = {.options = &o};
  int code = check_together(&o);
  if (!o.does) o.does = "compare";
  if (code == GG_CLI_GO_ON &&
      (gg_cli_sweep_read(&o, gg_standard_grid(o.quick), "the standard grid", &c.sweep, &err) != GG_OK ||
       gg_cli_sweep_find_folder(&c, o.quick ? "grid_quick.sweep" : "grid.sweep", &err) != GG_OK))
    code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = o.list ? gg_cli_sweep_list(&c) : validate(&c);
  gg_sweep_free(c.sweep);
  free(c.folder);
  return code;
}
