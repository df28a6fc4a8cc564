/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the targets of files begin with: small runs of both engines, interrupted, with the archive that their
 * checkpoints hold. Made anew at every start: no files of one version are kept. */
#ifndef GG_FUZZ_BASE_H
#define GG_FUZZ_BASE_H

#include "run/run.h"
#include "scene/scene.h"

enum { FUZZ_BASES = 6 };

typedef struct fuzz_base {
  gg_scene scene;
  gg_archive archive; /* of a checkpoint after some samples */
} fuzz_base;

/* Ends the program if it cannot be made. */
const fuzz_base *fuzz_base_of(size_t which);

#endif
