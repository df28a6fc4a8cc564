/* Trajectories as extended XYZ, the text format of OVITO and ASE. */
#ifndef GG_EXPORT_XYZ_H
#define GG_EXPORT_XYZ_H

#include "base/file_writer.h"
#include "files/h5/result_reader.h"

/* One frame: how many grains, a line on cell, columns, time and units, a line a grain. Each frame has the cell of its
 * instant. Under shear its second edge leans, and the images of the grains that lie inside of it are shown, so that all
 * grains are in the cell. Velocities are peculiar, as in the file.
 *
 * Species are called by the chemical elements of their numbers (H is species 1, He 2 ...), since ASE reads no other
 * names. The C locale is in force. */
void gg_files_xyz_frame(gg_text_out *out, const gg_stored_trajectory *t, const gg_frame *frame, const double edges[9]);

#endif
