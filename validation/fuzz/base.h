/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Starting points of the fuzz targets for files: small interrupted runs of both engines, with the archives of their
 * checkpoints. They are made at every start, so that they always have the present format. */
#ifndef GG_FUZZ_BASE_H
#define GG_FUZZ_BASE_H

#include "run/run.h"
#include "scene/scene.h"

enum { FUZZ_BASES = 6 };

typedef struct fuzz_base {
  gg_scene scene;
  gg_archive archive; /* of a checkpoint after some samples */
} fuzz_base;

/* Aborts the program if the run fails. */
const fuzz_base *fuzz_base_of(size_t which);

#endif
