/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/process.h"

#include <fcntl.h>
#include <hdf5.h>
#include <signal.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/memory.h"

/* Occupy the numbers of closed standard streams. Otherwise the next file that is opened would get such a number, and
 * messages would go into it. The descriptors have the wrong direction, so that reads and writes there fail. */
static void keep_standard_streams(void)
{
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
    if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) != fd) return;
}

/* Large blocks go back to the system when they are freed. By default glibc raises the size from which it does so, and
 * a run of 250 000 grains took 115 or 128 MB, depending on the order of its threads. */
static void return_large_blocks(void)
{
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
#endif
}

gg_status gg_files_process_prepare(gg_error *err)
{
  return_large_blocks();
  keep_standard_streams();
  signal(SIGXFSZ, SIG_IGN); /* a file above the size limit is an error of the write, and does not end the program */
  signal(SIGPIPE, SIG_IGN);
  if (!gg_base_memory_is_room()) return gg_base_out_of_memory(err); /* HDF5's first call does not check its malloc */
  H5dont_atexit(); /* the library closes its files; at exit, HDF5 would try to flush to a full disk */
  return GG_OK;
}
