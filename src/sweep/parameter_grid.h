/* The map `vary` of a sweep's file. */
#ifndef GG_SWEEP_VARY_H
#define GG_SWEEP_VARY_H

#include "scene/yaml_node.h"
#include "sweep/sweep.h"

gg_status gg_sweep_read_vary(gg_scene_reader *reader, gg_sweep *sweep, const yaml_node_t *node);

#endif
