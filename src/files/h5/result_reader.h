/* Result files read back, for `info` and `plot`. */
#ifndef GG_RESULT_READER_H
#define GG_RESULT_READER_H

#include <jansson.h>

#include "run/run.h"

/* How one quantity went, from the start of the run. */
typedef struct gg_stored_series {
  char name[64];
  size_t n;
  double *time, *value;
} gg_stored_series;

enum { GG_MAX_STORED_SERIES = 16 };

typedef struct gg_stored_engine {
  const char *name; /* "md", "dsmc"; NULL: not in the file */
  json_t *document; /* as `run` prints it; owned by the result's document */
  double window[2]; /* averaging from .. to */
  int n_series;
  gg_stored_series series[GG_MAX_STORED_SERIES];
} gg_stored_engine;

typedef struct gg_stored_result {
  bool comparison;
  char *version, *command, *machine, *date, *scene; /* scene: YAML */
  json_t *document;
  gg_stored_engine engine[2]; /* by gg_engine_kind */
  size_t n_frames, n_grains;  /* stored under /particles/grains */
  gg_frame last;              /* the last of them, rows in the order of the grains' numbers */
  double edge[3];             /* of its box along x, y, z; 0 where there are no positions */
} gg_stored_result;

/* A scene as files hold it, of the time when the flow small_shear was a key beside flow: usf, in the words of today; in
 * place. One that is of today stays as it is. */
void gg_files_stored_scene_update_words(char *yaml);

gg_status gg_files_stored_result_read(gg_stored_result *stored, const char *path, gg_error *err);
void gg_files_stored_result_clear(gg_stored_result *stored);
/* The series of that name, or NULL. */
const gg_stored_series *gg_files_stored_series_find(const gg_stored_engine *engine, const char *name);

#endif
