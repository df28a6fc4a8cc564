/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/processes.h"

#include <signal.h>
#include <stddef.h>
#include <stdlib.h>

#include "cli/cli.h"
#include "cli/mpi/mpi.h"

static bool is_above_one(const char *name)
{
  const char *value = getenv(name);
  return value && strtol(value, NULL, 10) > 1;
}

/* Whether mpirun or srun started several processes. The environment says so; MPI itself is not needed for this. */
static bool is_one_of_several(void)
{
  if (is_above_one("OMPI_COMM_WORLD_SIZE") || is_above_one("PMI_SIZE")) return true; /* mpirun of Open MPI, of MPICH */
  return getenv("PMIX_RANK") && is_above_one("SLURM_STEP_NUM_TASKS");                /* srun --mpi=pmix */
}

/* Global, since a process has one communicator. */
static gg_messages messages;
static gg_workers *workers;

gg_workers *gg_cli_workers(int threads)
{
  gg_error err;
  if (messages.size > 1 && !workers && gg_workers_new(&messages, threads, &workers, &err) != GG_OK) gg_cli_report(&err);
  return workers;
}

int gg_cli_default_threads(void)
{
  return messages.size > 1 ? 1 : gg_processors();
}

/* Work for rank 0. Signals are ignored here: rank 0 receives them, too, and ends the others. */
static int work(void)
{
  gg_error err;
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  return gg_worker_run(&messages, &err) == GG_OK ? GG_OK : GG_FAILED;
}

int gg_cli_as_one_of_several(int argc, char **argv, gg_cli_main *alone)
{
  gg_error err;
  if (!is_one_of_several()) return alone(argc, argv);
  if (gg_mpi_begin(&messages, &err) != GG_OK) return gg_cli_report(&err);
  int code = messages.rank > 0 ? work() : alone(argc, argv);
  if (messages.rank == 0) gg_cli_workers(1); /* for commands that use no workers: they must be shut down */
  gg_workers_free(workers);
  gg_mpi_end(&messages, code);
  return code;
}
