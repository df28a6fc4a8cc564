/* What the points of a sweep came to, in one tidy table: a row a point, method and quantity. */
#ifndef GG_SWEEP_TABLE_H
#define GG_SWEEP_TABLE_H

#include <jansson.h>

#include "sweep/sweep.h"

typedef struct gg_cli_table_row {
  size_t point;       /* from 0 */
  const char *method; /* "md", "dsmc", or a theory's name */
  const char *quantity, *unit;
  double mean, error; /* NaN: cannot be had; of theories mostly none */
  bool theory;
  bool steady, fell_short;
  double seconds; /* of processor time, of the method's whole run; NaN: a theory */
  uint64_t seed;
} gg_cli_table_row;

typedef struct gg_point_table {
  size_t n, room;
  gg_cli_table_row *row; /* in the order of points, methods, quantities */
  size_t n_points;       /* of which there is a file */
  size_t n_documents;
  json_t **document; /* texts of the rows belong to them */
} gg_point_table;

/* From all files that there are; GG_FAILED if there is none. To be cleared, also on failure. */
gg_status gg_sweep_point_table_read(gg_point_table *table, const gg_sweep *sweep, const char *folder, gg_error *err);
void gg_sweep_point_table_clear(gg_point_table *table);

#endif
