/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result files: HDF5, H5MD 1.1 for grains and time series; scene, results and how they were made under /graingas.
 *
 *   /h5md                            version, author, creator
 *   /particles/grains                box, position, velocity, spin (value, step, time), species, id,
 *                                    mass, diameter
 *   /observables/<quantity>          step, time, value from the start of the run; compare: /observables/md_<quantity>
 *   /graingas                        version, command, machine, date, seed, scene (YAML), document (JSON), warnings
 *   /graingas/results/<quantity>     mean, stderr, unit, samples, correlation_time; compare: /graingas/md/results/...
 *   /graingas/correlations           coefficients of means and their quantities, a line each; compare:
 *                                    /graingas/md/correlations
 *   /graingas/curves/<name>          x, value, stderr, numbers/<what>/mean, stderr; units are attributes; compare:
 *                                    /graingas/md/curves/...
 *   /graingas/theory/<name>/<quantity>   mean, error where the theory is solved numerically, unit
 *   /graingas/theory/<name>/curves/<name>   as those of engines; stderr is the numerical error */
#ifndef GG_RESULT_FILE_H
#define GG_RESULT_FILE_H

#include "io/atomic_file.h"
#include "run/run.h"

/* Nothing that includes this needs HDF5: the page of a browser is built without. */
typedef struct gg_result_file {
  gg_atomic_file file;
  const char *command;   /* the command line, for the record */
  const gg_scene *scene; /* whose `output` says what of frames is stored; NULL: all of it */
  const gg_stop *stop;   /* ends the writing; NULL: nothing does */
  bool in_memory;        /* left in `bytes` instead */
  void *bytes;           /* of the finished file, to be freed */
  size_t size;
  struct gg_result_writer *now; /* what was begun of the file (result_file.c); NULL: nothing */
} gg_result_file;

/* `path` is checked to be writable and left untouched until the end; nobody else can open it in between. NULL: the file
 * is not to be written, and its finish leaves it in `bytes`. */
gg_status gg_files_result_file_open(gg_result_file *f, const char *path, const char *command, gg_error *err);
/* Store a frame now. */
gg_status gg_files_result_file_frame(gg_result_file *f, const gg_model *model, const gg_frame *frame, gg_error *err);
/* Write all the rest, and put the file in place; on failure nothing is left. */
gg_status gg_files_result_file_finish_run(gg_result_file *f, const gg_result *result, gg_error *err);
gg_status gg_files_result_file_finish_comparison(gg_result_file *f, const gg_comparison *comparison, gg_error *err);
/* Give up: nothing is left. Harmless after a finish. */
void gg_files_result_file_abandon(gg_result_file *f);

#endif
