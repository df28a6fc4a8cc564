#include <signal.h>

#include "cli/progress.h"

/* A signal handler has nowhere else to leave its word. */
static volatile sig_atomic_t caught;

static void on_signal(int number)
{
  caught = 1;
  signal(number, SIG_DFL);
}

void gg_cli_catch_interrupts(void)
{
  gg_cli_be_patient(gg_cli_interrupted);
  struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART}, before;
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
  if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) /* else: nohup */
    sigaction(SIGHUP, &action, NULL);
}

bool gg_cli_interrupted(void)
{
  return caught != 0;
}
