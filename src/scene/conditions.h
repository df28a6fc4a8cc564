/* When keys of a scene have an effect: what the rows of the field table name under `when`. */
#ifndef GG_SCENE_CONDITIONS_H
#define GG_SCENE_CONDITIONS_H

#include "common/scene.h"

/* What a scene is used for: a sum of these. */
enum { GG_USE_MD = 1u << GG_MD, GG_USE_DSMC = 1u << GG_DSMC, GG_USE_THEORY = 1u << 2 };

/* When a key has an effect, and the words for when it has none: "KEY has no effect ...". One that asks for the flow
 * alone has `flow`, and the flows that are meant stand between `otherwise` and `after`. */
typedef struct gg_condition {
  bool (*holds)(const gg_scene *scene, unsigned uses);
  const char *otherwise;
  bool (*flow)(gg_flow flow);
  const char *after;
} gg_condition;

bool gg_scene_condition_holds(const gg_condition *condition, const gg_scene *scene, unsigned uses);
void gg_scene_condition_otherwise(const gg_condition *condition, char *text, size_t size);

extern const gg_condition gg_scene_if_sheared, gg_scene_if_moving_walls, gg_scene_if_openable, gg_scene_if_walled,
    gg_scene_if_md, gg_scene_if_dsmc, gg_scene_if_counted, gg_scene_if_error, gg_scene_if_boxed, gg_scene_if_one_engine,
    gg_scene_if_contact_value, gg_scene_if_lossy, gg_scene_if_law, gg_scene_if_rough, gg_scene_if_sticking,
    gg_scene_if_tangential, gg_scene_if_wall_sticking, gg_scene_if_wall_tangential;

/* Does some collision between grains lose energy, by the coefficients that the scene has? */
bool gg_scene_loses_energy(const gg_scene *scene);

#endif
