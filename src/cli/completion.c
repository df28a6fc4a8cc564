/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Completion for shells, from the tables of commands and options: `graingas --completion bash`. */
#include <stdio.h>
#include <string.h>

#include "cli/options.h"

/* Names of a table, separated by blanks. */
static void put_names(gg_catalogue list)
{
  gg_entry e;
  for (size_t i = 0; gg_catalogue_entry(list, i, NULL, &e, NULL) == GG_OK; i++) printf("%s%s", i ? " " : "", e.name);
}

/* The words that an option's argument is one of, between two texts; nothing of a number or a file. */
static void put_arguments(const gg_option *o, const char *before, const char *after)
{
  static const struct {
    const char *option, *words; /* words: NULL: those of a list */
    gg_catalogue list;
  } known[] = {{"theory", NULL, GG_CATALOGUE_THEORIES}, {"theories", NULL, GG_CATALOGUE_THEORIES},
               {"show", NULL, GG_CATALOGUE_QUANTITIES}, {"over", NULL, GG_CATALOGUE_KEYS},
               {"set", NULL, GG_CATALOGUE_KEYS},        {"vary", NULL, GG_CATALOGUE_KEYS},
               {"does", "run compare theory", 0},       {"only", "results curves trajectory", 0}};
  const size_t n = sizeof known / sizeof *known;
  size_t i = 0;
  while (i < n && strcmp(o->name, known[i].option) != 0) i++;
  if (!o->argument || (i == n && !strchr(o->argument, '|'))) return;
  fputs(before, stdout);
  for (const char *a = o->argument; i == n && *a; a++) putchar(*a == '|' ? ' ' : *a); /* "md|dsmc" */
  if (i < n && known[i].words) fputs(known[i].words, stdout);
  if (i < n && !known[i].words) put_names(known[i].list);
  fputs(after, stdout);
}

static bool takes_file(const gg_option *o)
{
  return o->argument && (strcmp(o->argument, "FILE") == 0 || strcmp(o->argument, "FOLDER") == 0);
}

/* Words that a command takes as its argument, besides files. */
static void put_words(const gg_command *c)
{
  if (strcmp(c->name, "init") == 0) put_names(GG_CATALOGUE_FLOWS);
  if (strcmp(c->name, "bench") == 0) fputs("md dsmc observables error compare", stdout);
  if (strcmp(c->name, "info") != 0) return;
  static const gg_catalogue all[] = {GG_CATALOGUE_KEYS, GG_CATALOGUE_QUANTITIES, GG_CATALOGUE_THEORIES,
                                     GG_CATALOGUE_OBSERVABLES, GG_CATALOGUE_FLOWS};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) fputs(i ? " " : "", stdout), put_names(all[i]);
}

static const char *endings_of(const gg_command *c)
{
  if (strstr(c->arguments, "RESULT.h5")) return "h5";
  if (strstr(c->arguments, "FILE")) return "yaml|yml|h5";
  return strstr(c->arguments, ".yaml") ? "yaml|yml" : "";
}

static void print_bash(void)
{
  printf("# graingas --completion bash\n_graingas() {\n  local cur=${COMP_WORDS[COMP_CWORD]} "
         "prev=${COMP_WORDS[COMP_CWORD-1]} words= options= endings=\n  COMPREPLY=()\n"
         "  case ${COMP_WORDS[1]} in\n");
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    printf("  %s)\n    endings='%s' words='", c->name, endings_of(c));
    put_words(c);
    printf("' options='--help");
    for (const gg_option *o = gg_cli_options_table; o->flag; o++)
      if (c->options & o->flag) printf(" --%s", o->name);
    printf("'\n    case $prev in\n");
    for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
      if (!(c->options & o->flag) || !o->argument) continue;
      printf("    --%s) ", o->name);
      put_arguments(o, "COMPREPLY=($(compgen -W '", "' -- \"$cur\"));");
      if (takes_file(o)) printf("COMPREPLY=($(compgen -f -- \"$cur\"));");
      printf(" return ;;\n");
    }
    printf("    esac ;;\n");
  }
  printf("  esac\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    COMPREPLY=($(compgen -W '--help --version");
  for (const gg_command *c = gg_cli_commands; c->name; c++) printf(" %s", c->name);
  printf("' -- \"$cur\"))\n  elif [ \"${cur#-}\" != \"$cur\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$cur\"))\n  else\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$cur\") $(compgen -d -- \"$cur\")\n"
         "      $([ -z \"$endings\" ] || compgen -f -- \"$cur\" | grep -E \"\\\\.($endings)\\$\"))\n  fi\n}\n"
         "complete -o filenames -F _graingas graingas\n");
}

/* Print text within single quotes of zsh and fish, without the special characters of zsh. */
static void put_quoted(const char *text)
{
  for (; *text; text++)
    if (*text == '\'')
      fputs("'\"'\"'", stdout);
    else if (strchr("[]", *text) == NULL)
      putchar(*text == ':' ? ',' : *text);
}

static void print_zsh(void)
{
  printf("#compdef graingas\n# graingas --completion zsh\nlocal -a commands\ncommands=(\n");
  for (const gg_command *c = gg_cli_commands; c->name; c++)
    printf("  '%s:", c->name), put_quoted(c->summary), printf("'\n");
  printf(")\nif (( CURRENT == 2 )); then\n  _describe command commands\n  return\nfi\nshift words\n(( CURRENT-- ))\n"
         "case $words[1] in\n");
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    printf("%s)\n  _arguments '--help[this text]'", c->name);
    for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
      if (!(c->options & o->flag)) continue;
      printf(" \\\n    '--%s[", o->name);
      put_quoted(o->doc);
      printf("]");
      if (o->argument) printf(":"), put_quoted(o->argument), printf(":");
      put_arguments(o, "(", ")");
      if (takes_file(o)) printf("_files");
      printf("'");
    }
    const char *endings = endings_of(c);
    printf(" \\\n    '1:argument:_alternative \"words:word:(");
    put_words(c);
    printf(")\"%s%s%s' '*:file:_files' ;;\n", *endings ? " \"files:file:_files -g \\\"*.(" : "", endings,
           *endings ? ")\\\"\"" : "");
  }
  printf("esac\n");
}

static void print_fish(void)
{
  printf("# graingas --completion fish\ncomplete -c graingas -n __fish_use_subcommand -f\n");
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    printf("complete -c graingas -n __fish_use_subcommand -a %s -d '", c->name);
    put_quoted(c->summary);
    printf("'\ncomplete -c graingas -n '__fish_seen_subcommand_from %s' -a '", c->name);
    put_words(c);
    printf("'\n");
    for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
      if (!(c->options & o->flag)) continue;
      printf("complete -c graingas -n '__fish_seen_subcommand_from %s' -l %s%s", c->name, o->name,
             !o->argument    ? ""
             : takes_file(o) ? " -r"
                             : " -x");
      put_arguments(o, " -a '", "'");
      printf(" -d '");
      put_quoted(o->doc);
      printf("'\n");
    }
  }
}

int gg_cli_print_completion(const char *shell)
{
  if (shell && strcmp(shell, "bash") == 0) return print_bash(), GG_OK;
  if (shell && strcmp(shell, "zsh") == 0) return print_zsh(), GG_OK;
  if (shell && strcmp(shell, "fish") == 0) return print_fish(), GG_OK;
  return gg_cli_fail(GG_BAD_INPUT, "--completion takes the name of a shell: bash, zsh or fish");
}
