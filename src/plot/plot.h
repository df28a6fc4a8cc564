/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of result files, drawn by gnuplot. */
#ifndef GG_PLOT_H
#define GG_PLOT_H

#include <stdio.h>

#include "files/h5/result_reader.h"

#define GG_PICTURES_ARE "pictures are files, with others beside them"

/* GP: the script for gnuplot with its data, to be edited. */
typedef enum gg_plot_format { GG_PLOT_SVG, GG_PLOT_PNG, GG_PLOT_PDF, GG_PLOT_GP } gg_plot_format;

/* Format and size of a picture. Layouts count in pixels of a screen with letters of 12. On paper of a given width
 * letters have 8 points, so a row has room for fewer of them. */
typedef struct gg_plot_paper {
  gg_plot_format format;
  double width; /* in such pixels; 0: chosen by the layout */
} gg_plot_paper;

/* Choose the format by the ending of the name or as given (NULL: not), and the width, "86mm" (NULL: free). GG_BAD_INPUT
 * if a format is unknown, name and format do not agree, or the width is none of a page. */
gg_status gg_plot_paper_choose(gg_plot_paper *paper, const char *picture, const char *format, const char *width,
                               gg_error *err);
/* Check before a long run that the picture can be drawn: GG_BAD_FILE if it cannot be written, GG_FAILED without
 * gnuplot.
 */
gg_status gg_plot_paper_check(const char *picture, const char *width, gg_error *err);

/* Draw a result to a picture, whole or not at all. */
gg_status gg_plot_result_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                              gg_error *err);

/* Draw the last frame, projected, if the file holds positions: *drawn says whether it does. */
gg_status gg_plot_snapshot_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                                bool *drawn, gg_error *err);
bool gg_plot_snapshot_has(const gg_stored_result *stored);

/* Draw the pages, further pictures beside the given name: PICTURE_snapshot.svg if the file holds grains with positions,
 * and PICTURE_<observable>.svg for each observable with curves. Pages of a comparison are named
 * PICTURE_<engine>_<observable>.svg, except for profiles and fluxes, whose page has both engines. `drawn` (may be NULL)
 * is called with the name of each page; `stop` is polled between pages and while theories are evaluated. */
gg_status gg_plot_pages_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                             void (*drawn)(void *context, const char *picture), void *context, const gg_stop *stop,
                             gg_error *err);
/* Check before anything is drawn that all pages can be written and none is the result's own file. */
gg_status gg_plot_pages_check(const gg_stored_result *stored, const gg_plot_paper *paper, const char *file,
                              const char *picture, gg_error *err);
/* "usf.svg", "md", "profiles" -> "usf_md_profiles.svg"; engine: "" outside of comparisons. To be freed; NULL: out of
 * memory. */
char *gg_plot_page_name(const char *picture, const char *engine, const char *group, const gg_plot_paper *paper);
#define GG_SNAPSHOT_PAGE "snapshot"
#define GG_PAGE_BESIDE "a picture beside %s"

/* The title of the scene; empty if the scene cannot be read. */
void gg_plot_scene_title(const gg_stored_result *stored, char *title, size_t size);

/* Copy a plain text with its marks escaped, so that gnuplot, which reads enhanced text, shows it as it is. */
void gg_plot_text_escape(const char *plain, char *text, size_t size);
/* A unit as enhanced text: "d^2 gamma^2" becomes "d^2 γ^2", with a space that SVG keeps. */
void gg_plot_text_unit(const char *unit, char *text, size_t size);

gg_status gg_plot_gnuplot_is_there(gg_error *err);
/* Run a gnuplot script and commit the picture; `over` (may be NULL) is SVG that is put over an SVG page. */
gg_status gg_plot_gnuplot_run(const char *script, const char *over, const char *picture, gg_error *err);

/* Curves of theories for the quantities that the result measured, as under GG_THEORY_CURVES of documents; a new
 * reference. Takes a second or two if the curves are not stored. */
json_t *gg_plot_theory_curves(const gg_stored_result *stored, const gg_stop *stop);

/* Okabe and Ito's colours, distinguished by the colour-blind: md, dsmc, then the theories. */
extern const unsigned gg_plot_colours[];
enum { GG_PLOT_COLOURS = 8 };

#endif
