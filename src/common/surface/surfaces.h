/* The surfaces of a model. */
#ifndef GG_SURFACES_H
#define GG_SURFACES_H

#include "common/model.h"

/* Those of this scene; box, composition and gravity of the model are known. Grains without spins are acted on at their
 * centres. `time_unit` of the model in the user's. GG_BAD_INPUT where they leave no room for the gas. */
gg_status gg_common_surfaces_make(const gg_scene *scene, bool spins, double time_unit, gg_model *model, gg_error *err);

/* The plain or other surface at the upper (1) or lower (-1) end of an axis; NULL: none. */
const gg_surface *gg_surface_at(const gg_model *model, int axis, double side);

/* Is the box closed along this axis: no period, and nobody beyond its ends? One without a lid is, too. */
bool gg_common_surface_is_closed(const gg_model *model, int axis);
/* Closed across y, and nothing at the upper end. */
bool gg_common_surface_is_open_above(const gg_model *model);

/* The surface that takes this one's place where y changes its sign; -1: none. */
int gg_surface_image(const gg_model *model, int surface);

#endif
