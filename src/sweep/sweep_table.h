/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results of the points of a sweep: one tidy table with a row for each point, method and quantity, as files for other
 * programs and as a picture; and the points as a JSON document. */
#ifndef GG_SWEEP_TABLE_H
#define GG_SWEEP_TABLE_H

#include "base/cancellation.h"
#include "base/text.h"
#include "sweep/sweep.h"

typedef struct gg_point_row {
  size_t point;             /* from 0 */
  char file[GG_POINT_NAME]; /* of the point */
  const char *method;       /* "md", "dsmc", or a theory's name */
  const char *quantity, *unit;
  const char *version, *build; /* of graingas at the run; build: its identity */
  double mean, error;          /* NaN: unknown; most theories have no error */
  bool theory;
  bool steady, fell_short;
  double seconds; /* processor time of the method's whole run; NaN: a theory */
  uint64_t seed;
  /* Deviations from the reference; NULL and NaN: there is none. */
  const char *reference; /* "enskog_hermite", "dsmc" */
  double reference_mean;
  double difference, difference_error; /* mean - reference, in the unit of the quantity */
  double deviation, deviation_error;   /* both over the reference; NaN of numbers about zero: N1, N2, a2 */
  double z;                            /* difference over its error; NaN of theories */
  bool beyond;                         /* the deviation is above four errors and larger than expected */
  const char *cause;                   /* of the deviation */
  const char *structure;               /* of md: "clustered", "swirling", "collapsed"; NULL: homogeneous, or unknown */
  double contact_time;                 /* of md, chosen by `auto`, if it is not the default; else NaN */
} gg_point_row;

typedef struct gg_point_table {
  size_t n, room;
  gg_point_row *row;     /* in the order of points, methods, quantities */
  size_t n_other_builds; /* points that a build of another identity ran */
  size_t n_documents;    /* one for each point that has a file */
  json_t **document;     /* own the texts of the rows */
  gg_string_list texts;  /* own the causes */
} gg_point_table;

/* Read the files of all points; GG_FAILED if there is none. `stop` is polled between files. To be cleared, also on
 * failure. */
gg_status gg_sweep_point_table_read(gg_point_table *table, const gg_sweep *sweep, const char *folder,
                                    const gg_stop *stop, gg_error *err);
void gg_sweep_point_table_clear(gg_point_table *table);
/* Warn of points by other builds, if there are any; `more` ends the sentence. */
void gg_sweep_point_table_warn(const gg_point_table *table, const char *more,
                               void (*warn)(void *context, const char *message), void *context);
/* True if the table has a row of the method and the quantity (NULL: any). */
bool gg_sweep_point_table_has(const gg_point_table *table, const char *method, const char *quantity);
/* Take the next word of a list with commas (NULL: empty); false at its end. */
bool gg_sweep_next_word(const char **list, char word[64]);

/* Write the table, whole or not at all. Columns: the point's number, a column a varied key, then method, quantity,
 * mean, error, unit, reference, its mean, differences from it, z, beyond_expected, cause, structure, contact_time,
 * seed, steady, short, seconds, file, version, build. In HDF5 each is an array under /graingas/table: numbers, whole
 * numbers, truths as bytes, texts. */
gg_status gg_sweep_point_table_write_csv(const gg_point_table *table, const gg_sweep *sweep, const char *path,
                                         gg_error *err);
gg_status gg_sweep_point_table_write_h5(const gg_point_table *table, const gg_sweep *sweep, const char *path,
                                        const char *command, gg_error *err);

/* The key along x, by its place among the varied keys. */
typedef struct gg_picture_axis {
  size_t varied, k, n; /* n values */
  bool alone;          /* no other key changes with it: theories are lines */
  bool log;
} gg_picture_axis;

/* Theories at values of the axis between those of the points: a sweep of its own, and its table. */
typedef struct gg_picture_lines {
  gg_sweep *sweep;
  gg_point_table table;
} gg_picture_lines;

typedef struct gg_picture_choice { /* NULL: chosen */
  gg_picture_axis axis;
  const char *show;              /* quantities, with commas: a panel each */
  const char *log;               /* "x", "y", "xy", "none"; by default y where its values span decades */
  const char *relative_to;       /* a method: deviations from it; NULL: the numbers themselves */
  const char *theories;          /* with commas; NULL: all */
  const gg_picture_lines *lines; /* NULL: theories at the points alone */
} gg_picture_choice;

/* Choose the key along x: by its name, or (NULL) the key with most values that are numbers. GG_BAD_INPUT if the name is
 * not varied or its values are no numbers. */
gg_status gg_sweep_axis_choose(const gg_sweep *sweep, const char *over, const char *log, gg_picture_axis *axis,
                               gg_error *err);
/* Check that the table has the quantities, theories and methods that are chosen. */
gg_status gg_sweep_picture_check(const gg_point_table *table, const gg_sweep *sweep, const gg_picture_choice *choice,
                                 gg_error *err);

/* Draw a panel for each quantity and a line for each combination of the other keys: engines as points, open for runs
 * that are not steady, theories as lines unless other keys change with that of the axis. */
gg_status gg_sweep_point_table_draw(const gg_point_table *table, const gg_sweep *sweep, const gg_picture_choice *choice,
                                    const char *picture, const char *width, gg_error *err);
/* The value of the axis at a point; NaN: the value is not a number. */
double gg_sweep_axis_value(const gg_sweep *sweep, size_t point, const gg_picture_axis *axis);
/* A sweep of the theories at twenty-five values of the axis, for each combination of the other keys; to be run, read
 * and freed. *lines is NULL if keys change with that of the axis, or that takes whole numbers. */
gg_status gg_sweep_lines_make(const gg_sweep *sweep, const gg_picture_axis *axis, gg_sweep **lines, gg_error *err);
void gg_sweep_lines_free(gg_sweep *lines, const gg_picture_axis *axis);

/* Points that differ in the rows of one varied group alone, that of a picture's axis, are one line of the picture. */
enum { GG_COMBINATION_NAME = 1024 };

/* "β = 0.5, φ = 0.1", enhanced text: the values of the other keys at a point, long values by what they differ in. */
void gg_sweep_line_group_name(const gg_sweep *sweep, size_t point, size_t varied, char text[GG_COMBINATION_NAME]);

/* The points of a checked sweep as JSON. A new reference; NULL: out of memory. */
json_t *gg_sweep_document(const gg_sweep *sweep, const char *folder);

#endif
