/* Progress on standard error: one live line on a terminal, now and then a plain line otherwise. */
#ifndef GG_CLI_PROGRESS_H
#define GG_CLI_PROGRESS_H

#include <graingas.h>
#include <stdbool.h>

typedef struct gg_cli_progress {
  bool quiet, terminal;
  double shown;        /* clock reading of the last line */
  bool live;           /* a live line stands on the terminal */
  gg_progress last[2]; /* of md and dsmc, which may run side by side */
  char phase[2][24];   /* last phase told in plain lines */
  bool untold[2];      /* `last` is news that no plain line has told */
} gg_cli_progress;

void gg_cli_progress_start(gg_cli_progress *p, bool quiet);
void gg_cli_progress_show(gg_cli_progress *p, const gg_progress *now);
/* The same of what says it in its own words. */
void gg_cli_progress_line(gg_cli_progress *p, const char *line);
/* Take the live line away, or tell how it ended in a plain line; harmless again. */
void gg_cli_progress_end(gg_cli_progress *p);

/* A line of any kind of work, kept up to date likewise. */
typedef struct gg_cli_line {
  bool quiet, terminal, live;
  double shown;
  char last[240]; /* plain, that was told */
} gg_cli_line;
void gg_cli_line_start(gg_cli_line *line, bool quiet);
/* `now`: worth a plain line whenever the last one was. */
void gg_cli_line_show(gg_cli_line *line, const char *text, bool now);
/* Take it away, as before something else is told; harmless again. */
void gg_cli_line_clear(gg_cli_line *line);

/* SIGINT, SIGTERM and SIGHUP end a run within half a second, with a checkpoint if one was asked for; a second one ends
 * it at once. */
void gg_cli_catch_interrupts(void);
bool gg_cli_interrupted(void);
/* Standard output and error wait for a reader who takes nothing (a pager, a terminal that was halted), but once
 * `stopped()` only a second: what is told then is lost, and the run comes to its end. */
void gg_cli_be_patient(bool (*stopped)(void));
/* Was something lost so? */
bool gg_cli_lost_patience(void);

#endif
