/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command under mpirun: rank 0 executes the command line, the other processes work for it and neither print nor
 * write. */
#ifndef GG_CLI_PROCESSES_H
#define GG_CLI_PROCESSES_H

#include <graingas.h>

/* Called by main: run `alone` in a single process and in rank 0, a worker in other ranks. */
typedef int gg_cli_main(int argc, char **argv);
int gg_cli_as_one_of_several(int argc, char **argv, gg_cli_main *alone);

/* The workers, for rank 0, each with this number of threads; NULL: none. Valid until the end of the program. */
gg_workers *gg_cli_workers(int threads);
/* Default number of threads: the processors of a single process, one under mpirun. */
int gg_cli_default_threads(void);

#endif
