/* One map of varied keys, as it is read: the values of each. */
#ifndef GG_SWEEP_COLUMNS_H
#define GG_SWEEP_COLUMNS_H

#include "scene/yaml_node.h"
#include "sweep/sweep.h"
#include "sweep/values.h"

typedef struct gg_columns {
  size_t n;
  char key[GG_MOST_VARIED][96];
  gg_values values[GG_MOST_VARIED];
  const yaml_node_t *node[GG_MOST_VARIED];
  const yaml_node_t *random; /* the map that asks for random draws; NULL: none */
} gg_columns;

/* Into columns that are {0}; to be cleared, also on failure. */
gg_status gg_sweep_value_lists_read(gg_scene_reader *reader, const yaml_node_t *map, gg_columns *columns);
void gg_sweep_value_lists_clear(gg_columns *columns);
/* A message of gg_values_..., with the file and the line before it. */
gg_status gg_sweep_place(const gg_scene_reader *reader, const yaml_node_t *node, gg_status status);

#endif
