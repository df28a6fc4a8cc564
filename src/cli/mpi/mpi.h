/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between processes started by mpirun or srun, for gg_workers_new and gg_worker_run. Only the command uses
 * MPI, the library does not. Implementations: over_mpi.c, and without_mpi.c for builds without MPI. */
#ifndef GG_MPI_H
#define GG_MPI_H

#include <graingas.h>

/* Call MPI_Init and set the message functions, valid until gg_mpi_end. GG_FAILED, with advice, if MPI is not available.
 */
gg_status gg_mpi_begin(gg_messages *messages, gg_error *err);
/* Deliver all messages and call MPI_Finalize; not if a process is lost, since MPI_Finalize would then never return.
 * `code`: exit code of the process. */
void gg_mpi_end(gg_messages *messages, int code);

#endif
