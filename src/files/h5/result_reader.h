/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result files read back, for `info` and `plot`. */
#ifndef GG_RESULT_READER_H
#define GG_RESULT_READER_H

#include <jansson.h>

#include "files/h5/hdf5_reader.h"
#include "run/result.h"
#include "run/run.h"

/* How one quantity went, from the start of the run. */
typedef struct gg_stored_series {
  char name[64];
  size_t n;
  double *time, *value;
} gg_stored_series;

enum { GG_MAX_STORED_SERIES = 16 };

typedef struct gg_stored_engine {
  const char *name;     /* "md", "dsmc"; NULL: not in the file */
  json_t *document;     /* as `run` prints it; owned by the result's document */
  double window[2];     /* averaging from .. to */
  char *correlated;     /* names of quantities, a line each; NULL: there are none */
  double *coefficients; /* correlation coefficients of their means, n_coefficients = number of names squared */
  size_t n_coefficients;
  int n_series;
  gg_stored_series series[GG_MAX_STORED_SERIES];
} gg_stored_engine;

typedef struct gg_stored_result {
  bool comparison, changed;                         /* changed: by another program, since it was written */
  char *version, *command, *machine, *date, *scene; /* scene: YAML */
  json_t *document;
  gg_stored_engine engine[GG_N_ENGINES]; /* by gg_engine_kind */
  size_t n_frames, n_grains;             /* stored under /particles/grains */
  gg_frame last;                         /* the last of them, rows in the order of the grains' numbers */
  double edge[3];                        /* of its box along x, y, z; 0 where there are no positions */
} gg_stored_result;

gg_status gg_files_stored_result_read(gg_stored_result *stored, const char *path, gg_error *err);
/* Likewise from the bytes of a result file in memory. */
gg_status gg_files_stored_result_from_bytes(gg_stored_result *stored, const void *bytes, size_t size, gg_error *err);
/* The first engine that the file has. */
gg_engine_kind gg_files_stored_first(const gg_stored_result *stored);
/* One line on what is unusual about it; "" if nothing is. */
gg_status gg_files_stored_result_notice(const char *path, char *text, size_t size, gg_error *err);
void gg_files_stored_result_clear(gg_stored_result *stored);
/* The series of that name, or NULL. */
const gg_stored_series *gg_files_stored_series_find(const gg_stored_engine *engine, const char *name);

/* The trajectory of a result file, a frame at a time: only one is in memory, however many there are. */

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
