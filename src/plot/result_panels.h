/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Panels of the charts that are made of result files. */
#ifndef GG_PLOT_RESULT_PANELS_H
#define GG_PLOT_RESULT_PANELS_H

#include "plot/chart.h"

/* True if a stored engine has no steady mean. Its symbols are open then, and a note says so. */
static inline bool gg_plot_is_unsteady(const gg_stored_engine *engine)
{
  return engine->name && json_is_false(json_object_get(engine->document, "steady"));
}

/* The relaxation of an engine: its temperatures, and with `stresses` its stresses. */
void gg_plot_add_relaxation(gg_chart *chart, const gg_stored_engine *engine, bool stresses, double share);
/* True if the engine has stored series of stresses; gases that cool have none. */
bool gg_plot_has_stresses(const gg_stored_engine *engine);
/* md, dsmc and the theories: ratios to md, and the numbers without a scale (N1, N2 ...). */
void gg_plot_add_comparison(gg_chart *chart, const gg_stored_result *stored);
/* The curves of a group (one observable), those of the other engine (NULL: none) over them, and theories as lines. */
void gg_plot_add_curves(gg_chart *chart, const gg_stored_engine *engine, const gg_stored_engine *other,
                        const json_t *theories, const char *group);

#endif
