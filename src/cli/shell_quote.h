/* The command line as it was typed, to be recorded, and to be typed again with something else in it. */
#ifndef GG_CLI_TYPED_H
#define GG_CLI_TYPED_H

typedef struct gg_typed {
  int n;
  char **word;     /* the subcommand first; borrowed from main; NULL: one that is not to be typed again */
  int options_end; /* the word "--"; n where there is none */
} gg_typed;

/* As a shell reads it back: all words, with `added`, which is quoted already ("": none), where options end. To be
 * freed; NULL: out of memory. */
char *gg_cli_command_line_quote(const gg_typed *typed, const char *added);
/* One argument as a shell reads it back; to be freed. */
char *gg_cli_shell_quote(const char *text);

#endif
