/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command as one of several processes, under mpirun: rank 0 does what the command line says, the others work for it
 * and neither print nor write. */
#ifndef GG_CLI_PROCESSES_H
#define GG_CLI_PROCESSES_H

#include <graingas.h>

/* Called by main: what is done by a process of its own, and by rank 0. */
typedef int gg_cli_main(int argc, char **argv);
int gg_cli_as_one_of_several(int argc, char **argv, gg_cli_main *alone);

/* The others, at rank 0, each with so many threads; NULL: there are none. They last as long as the program. */
gg_workers *gg_cli_workers(int threads);
/* How many threads a process uses by default: all processors, or one where there are several processes. */
int gg_cli_default_threads(void);

#endif
