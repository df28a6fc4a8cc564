/* The trajectory of a result file, a frame at a time: only one is in memory, however many there are. */
#ifndef GG_H5_TRAJECTORY_H
#define GG_H5_TRAJECTORY_H

#include "files/h5/hdf5_reader.h"
#include "run/result.h"

/* Why a file that is read has none. */
#define GG_NO_POSITIONS "it holds no positions of grains"

typedef struct gg_stored_trajectory {
  gg_h5_in h;
  char *path;
  size_t n_frames, n;      /* n_frames: 0 where the grains have no positions; n: grains */
  bool periodic[3];        /* along x, y, z; else a wall, or an open end */
  double shear_rate;       /* of the flow that velocities are relative to */
  uint8_t *species;        /* of each grain, from 0 */
  double *diameter, *mass; /* of each grain */
  char *length_unit, *velocity_unit, *spin_unit, *time_unit; /* spin_unit: NULL of smooth grains */
} gg_stored_trajectory;

/* To be closed also after a failure. */
gg_status gg_files_stored_trajectory_open(gg_stored_trajectory *t, const char *path, gg_error *err);
/* The k-th frame from 0, grains in the order of their numbers (to be freed), and the rows of its cell's edges. */
gg_status gg_files_stored_trajectory_frame(gg_stored_trajectory *t, size_t k, gg_frame *frame, double edges[9],
                                           gg_error *err);
void gg_files_stored_trajectory_close(gg_stored_trajectory *t);

#endif
