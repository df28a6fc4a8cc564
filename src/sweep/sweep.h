/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep: a scene, and keys of it that take other values from point to point. Read from a scene file with two more
 * maps, `vary` and `sweep`; what is done at a point is a run, a comparison or the theories. */
#ifndef GG_SWEEP_H
#define GG_SWEEP_H

#include <jansson.h>
#include <stdio.h>

#include "base/busy.h"
#include "base/error.h"
#include "common/rng.h"

typedef struct gg_sweep gg_sweep; /* the handle of the public header */
typedef struct gg_scene gg_scene;

typedef enum gg_does { GG_DOES_RUN, GG_DOES_COMPARE, GG_DOES_THEORY } gg_does;
typedef enum gg_seeds { GG_SEEDS_INDEPENDENT, GG_SEEDS_COMMON } gg_seeds;

/* The map `sweep`; its rows are in sweep_reader.c. */
typedef struct gg_sweep_settings {
  gg_does does;
  gg_seeds seeds;
  int64_t at_once; /* points in progress at a time; 0: by the number of threads */
  double longest;  /* seconds of processor time that a replica is to take at most, where run.replicas is not given */
} gg_sweep_settings;

/* Keys that change together: a value of each in every row, as YAML. */
typedef struct gg_varied {
  size_t n_keys, n; /* n rows */
  char **key;
  char **value; /* of row i and key k: value[i*n_keys + k] */
} gg_varied;

enum { GG_POINT_NAME = 17 }; /* the name of a point: 16 hexadecimal digits of its hash */

/* A point after its check. */
typedef struct gg_point {
  uint64_t id;    /* hash of its scene and of what is done there; the name of its file */
  double seconds; /* of processor time, expected */
} gg_point;

enum { GG_MOST_POINTS = 100000, GG_MOST_VARIED = 32 };

struct gg_sweep {
  gg_busy busy;
  char *name; /* of its file, for messages */
  gg_scene *base;
  gg_sweep_settings settings;
  size_t n_varied; /* points are all combinations of their rows; rows of the last one change fastest */
  gg_varied varied[GG_MOST_VARIED];
  size_t n;        /* points; 0: not checked yet */
  gg_point *point; /* n of them */
};

/* sweep_reader.c */
gg_sweep_settings gg_sweep_settings_defaults(void);
/* One key of the map `sweep`, "sweep.does", from YAML. */
gg_status gg_sweep_settings_set(gg_sweep_settings *settings, const char *key, const char *value, gg_error *err);
json_t *gg_sweep_settings_schema(void);
/* Print the map as text that can be read again. */
void gg_sweep_settings_print(FILE *out, const gg_sweep_settings *settings);
gg_status gg_sweep_read_text(gg_sweep *sweep, const char *yaml, size_t length, const char *name, gg_error *err);

/* parameter_grid.c: the values that a varied key takes, as they are written: a list, "first:last:step", or for random
 * draws "low..high". */
typedef struct gg_values {
  char key[96];
  size_t n, room, characters; /* characters of all of them */
  char **text;                /* YAML */
  bool range;                 /* any number from low to high instead of a list */
  double low, high;
} gg_values;

void gg_sweep_values_clear(gg_values *values);
/* Add a copy of one value; GG_BAD_INPUT beyond the limits on their number and length. */
gg_status gg_sweep_values_add(gg_values *values, const char *text, gg_error *err);
/* Add the values of a word of the command line: "0.5", "0.1:0.5:0.1", "0.3..1", or several with commas. */
gg_status gg_sweep_values_parse(gg_values *values, const char *text, gg_error *err);

void gg_sweep_varied_clear(gg_varied *varied);
/* Vary keys together: row i has the i-th value of each list, which the sweep takes over. GG_BAD_INPUT if one of them is
 * varied already. */
gg_status gg_sweep_add_rows(gg_sweep *sweep, gg_values *lists, size_t n_keys, gg_error *err);
/* The same with n random draws from each list: an element, or a number of the range (whole, where the key takes whole
 * numbers). Each key has its own stream: more points or more keys leave the other draws as they are. */
gg_status gg_sweep_add_draws(gg_sweep *sweep, const gg_values *lists, size_t n_keys, size_t n, uint64_t seed,
                             gg_error *err);
bool gg_sweep_varies(const gg_sweep *sweep, const char *key);
/* The same, also as a member of its section: vary: {run: [{seed: 1}, {seed: 2}]} sets run.seed. */
bool gg_sweep_sets(const gg_sweep *sweep, const char *key);

/* points.c: the number of points, 0: more than GG_MOST_POINTS; the row of a varied group at point i. */
size_t gg_sweep_count(const gg_sweep *sweep);
size_t gg_sweep_row(const gg_sweep *sweep, size_t i, size_t varied);
/* The scene of point i, resolved: complete and checked, with its own seed and replicas. It borrows the extension. */
gg_status gg_sweep_resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, gg_error *err);
/* Resolve every point and fill gg_sweep.point. */
gg_status gg_sweep_check_points(gg_sweep *sweep, gg_error *err);

/* Check that a file at `path` holds the scene of this point, as a JSON object. GG_BAD_FILE names the first key that
 * differs. Keys that no number depends on may differ. */
gg_status gg_sweep_point_check(const gg_scene *scene, gg_does does, const json_t *stored, const char *path,
                               gg_error *err);
extern const char *const gg_sweep_does_words[]; /* "run", "compare", "theory" */

/* The varied key of a column, and its value at a point; NULL beyond the last. */
const char *gg_sweep_column_key(const gg_sweep *sweep, size_t k);
const char *gg_sweep_column_value(const gg_sweep *sweep, size_t i, size_t k);

#endif
