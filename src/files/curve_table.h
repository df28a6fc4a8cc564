/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of a result, in documents and files. Pictures are drawn from the document. */
#ifndef GG_IO_CURVES_H
#define GG_IO_CURVES_H

#include <jansson.h>
#include <stdio.h>

#include "measure/curve.h"

/* {"name": {"group", "panel", "label", "x_name", "x_unit", "y_name", "unit", "log_x", "log_y", "samples", "x": [],
 * "value": [], "stderr": [], "numbers": {"alpha": {"mean", "stderr", "unit"}}, "reference": {"label", "value": []}}}:
 * the last only where there is a law to see the curve beside. */
json_t *gg_files_curves_json(const gg_curves *curves);
/* Append the curves of one engine or theory to a list. */
gg_status gg_files_curves_from_json(gg_curves *list, const json_t *curves, gg_error *err);
/* The key of documents that has those of theories, by their names. */
#define GG_THEORY_CURVES "theory_curves"

/* How many groups of curves an engine's document holds, and the k-th one's name. */
int gg_plot_curve_groups(const json_t *document, const char **names, int most);

#endif
