/* What gg_run and gg_compare have in common: options turned into the hooks of a run. */
#ifndef GG_DOOR_RUN_H
#define GG_DOOR_RUN_H

#include <stdatomic.h>

#include "door/door.h"
#include "io/h5/result_file.h"
#include "run/run.h"

typedef struct gg_door_run {
  gg_run_options options;
  gg_scene scene;      /* finished */
  gg_archive resume;   /* empty: from the start */
  gg_result_file file; /* of options.output */
  gg_model model;      /* of the frames */
  atomic_bool stopped;
} gg_door_run;

/* Finish the scene, read what is resumed from, see that the output can be written; hooks for the run, which last as
 * long as `run`. To be followed by gg_door_run_end, also on failure. */
gg_status gg_door_run_begin(gg_door_run *run, const gg_scene *scene, const gg_run_options *options, gg_hooks *hooks,
                            gg_error *err);
void gg_door_run_end(gg_door_run *run);
/* What to resume from, or NULL. */
const gg_archive *gg_door_run_resume(const gg_door_run *run);
/* The status of a run whose output was or was not written: the worse of the two, with both messages. */
gg_status gg_door_run_status(gg_status run, gg_status written, const gg_error *why, gg_error *err);

#endif
