/* The map `sweep` of a sweep's file. */
#ifndef GG_SWEEP_SETTINGS_H
#define GG_SWEEP_SETTINGS_H

#include "scene/yaml_node.h"
#include "sweep/sweep.h"

extern const gg_field gg_sweep_fields[]; /* offsets in gg_sweep_settings; ends with a NULL key */

gg_sweep_settings gg_sweep_settings_defaults(void);
gg_status gg_sweep_settings_read(gg_scene_reader *reader, const yaml_node_t *map, gg_sweep_settings *settings);

#endif
