/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result files as tables and trajectories that other programs read. */
#ifndef GG_EXPORT_H
#define GG_EXPORT_H

#include "files/h5/result_reader.h"
#include "io/file_writer.h"

/* Export the result of this path to files, all of them or none: PREFIX.csv, one of each curve,
 * PREFIX_numbers.csv and PREFIX.xyz; `parts` (GG_EXPORT_...) says which. GG_FAILED if the result has nothing of what
 * was requested. `written` (may be NULL) is called with the name of each, `progress` (may be NULL) with the share of
 * the trajectory that is written. `stop` ends it: no file is replaced then. */
gg_status gg_files_export_result(const gg_stored_result *stored, const char *path, const char *prefix, unsigned parts,
                                 void (*written)(void *context, const char *file),
                                 void (*progress)(void *context, double share), void *context, const gg_stop *stop,
                                 gg_error *err);

/* One frame of extended XYZ, the text format of OVITO and ASE: how many grains, a line on cell, columns, time and
 * units, a line a grain. Each frame has the cell of its instant. Under shear its second edge leans, and the images of
 * the grains that lie inside of it are shown, so that all grains are in the cell. Velocities are peculiar, as in the
 * file.
 *
 * Species are called by the chemical elements of their numbers (H is species 1, He 2 ...), since ASE reads no other
 * names. ASE takes momenta and masses, OVITO velo and mass. The C locale is in force. */
void gg_files_xyz_frame(gg_file_writer *out, const gg_stored_trajectory *t, const gg_frame *frame,
                        const double edges[9]);

#endif
