/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "cli/mpi/mpi.h"

gg_status gg_mpi_begin(gg_messages *messages, gg_error *err)
{
  *messages = (gg_messages){0};
  err->status = GG_FAILED;
  snprintf(err->message, sizeof err->message,
           "started as one of several processes, but built without MPI; start one process, without mpirun, or build "
           "with MPI (Debian: libopenmpi-dev, openmpi-bin; then meson configure build -Dmpi=enabled)");
  return GG_FAILED;
}

void gg_mpi_end(gg_messages *messages, int code)
{
  (void)messages, (void)code;
}
