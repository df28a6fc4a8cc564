/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between the processes that mpirun (or srun) started, for gg_workers_new and gg_worker_run. Of the command
 * alone: the library knows no MPI. One file with it (over_mpi.c), one that stands in where the program was built
 * without (without_mpi.c). */
#ifndef GG_MPI_H
#define GG_MPI_H

#include <graingas.h>

/* MPI_Init. `messages` holds until gg_mpi_end. GG_FAILED where it cannot be had, with what to do. */
gg_status gg_mpi_begin(gg_messages *messages, gg_error *err);
/* Everything sent has arrived; MPI_Finalize, unless a process is lost, without which that never returns. The process is
 * about to exit with this code. */
void gg_mpi_end(gg_messages *messages, int code);

#endif
