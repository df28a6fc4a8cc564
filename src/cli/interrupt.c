#include <assert.h>
#include <signal.h>
#include <stdatomic.h>

#include "cli/progress.h"

/* A signal handler has nowhere else to leave its word; threads read it. */
static atomic_int caught;
static_assert(ATOMIC_INT_LOCK_FREE == 2, "a handler may not wait for a lock");

static void on_signal(int number)
{
  atomic_store(&caught, 1);
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
  return atomic_load(&caught) != 0;
}
