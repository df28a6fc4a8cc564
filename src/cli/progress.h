/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress on standard error: one live line on a terminal, otherwise a plain line at intervals. */
#ifndef GG_CLI_PROGRESS_H
#define GG_CLI_PROGRESS_H

#include <graingas.h>
#include <stdbool.h>

typedef struct gg_cli_line {
  bool quiet, terminal, live; /* live: a line is on the terminal */
  double shown;               /* wall time of the last line */
  char last[240];             /* its text */
} gg_cli_line;
void gg_cli_line_start(gg_cli_line *line, bool quiet);
/* Show a text; `now`: without a terminal, print it even if the last line was recent. */
void gg_cli_line_show(gg_cli_line *line, const char *text, bool now);
/* Remove the live line, before other output. Safe to call twice. */
void gg_cli_line_clear(gg_cli_line *line);

/* The line of a run or a comparison. */
typedef struct gg_cli_progress {
  gg_cli_line line;
  gg_progress last[2]; /* of md and dsmc, which may run side by side */
  char phase[2][24];   /* last phase in plain lines */
  bool unreported[2];  /* `last` has not been printed as a plain line */
} gg_cli_progress;
void gg_cli_progress_start(gg_cli_progress *p, bool quiet);
void gg_cli_progress_show(gg_cli_progress *p, const gg_progress *now);
/* Remove the live line, or print the final state as a plain line. Safe to call twice. */
void gg_cli_progress_end(gg_cli_progress *p);

/* interrupt.c: SIGINT, SIGTERM and SIGHUP end a run within half a second, with a checkpoint if checkpoints are on; a
 * second signal ends the process at once. Writes to a stalled reader (a pager, a halted terminal) block; after a signal
 * for one second only, then the rest of the output is dropped. */
void gg_cli_catch_interrupts(void);
int gg_cli_interrupted(void *context); /* as `stop` of a run; without a context */
bool gg_cli_output_lost(void);

#endif
