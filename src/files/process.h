/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef GG_FILES_PROCESS_H
#define GG_FILES_PROCESS_H

#include "base/error.h"

/* Prepare the process of the command for files: standard streams, signals of writes, HDF5. The library never calls it,
 * since all of this belongs to the program. GG_FAILED: not enough memory for HDF5. */
gg_status gg_files_process_prepare(gg_error *err);

#endif
