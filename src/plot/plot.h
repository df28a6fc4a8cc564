/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of result files, drawn by gnuplot. */
#ifndef GG_PLOT_H
#define GG_PLOT_H

#include <stdio.h>

#include "files/h5/result_reader.h"

#define GG_PICTURES_ARE "pictures are files, with others beside them"

typedef enum gg_plot_format { GG_PLOT_SVG, GG_PLOT_PNG, GG_PLOT_PDF } gg_plot_format;

/* What a picture is drawn on. Layouts count in pixels of a screen with letters of 12; on paper of a given width
 * letters are 8 points, so that there is room for fewer of them. */
typedef struct gg_plot_paper {
  gg_plot_format format;
  double width; /* in such pixels; 0: as wide as the layout likes */
} gg_plot_paper;

/* The format by the ending of its name, or as given (NULL: not); the width as "86mm", NULL: free. GG_BAD_INPUT if a
 * format is unknown, the two do not agree, or the width is none of a page. */
gg_status gg_plot_paper_choose(gg_plot_paper *paper, const char *picture, const char *format, const char *width,
                               gg_error *err);
/* And can it be drawn there? For before long runs: GG_BAD_FILE if it could not be written, GG_FAILED without gnuplot.
 */
gg_status gg_plot_paper_check(const char *picture, const char *width, gg_error *err);

/* Draw a result to a picture, whole or not at all. */
gg_status gg_plot_result_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                              gg_error *err);

/* A picture of the last frame, projected, if the file holds positions: *drawn says whether. */
gg_status gg_plot_snapshot_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                                bool *drawn, gg_error *err);
bool gg_plot_snapshot_has(const gg_stored_result *stored);

/* Pages are further pictures beside the given name: PICTURE_snapshot.svg if the file holds grains with positions, and
 * one for each observable that left curves: PICTURE_<observable>.svg, for comparisons
 * PICTURE_<engine>_<observable>.svg but for profiles, which have both engines. `drawn` (may be NULL) is called with the
 * name of each; `stop` ends it between two, and while theories are evaluated. */
gg_status gg_plot_pages_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                             void (*drawn)(void *context, const char *picture), void *context, const gg_stop *stop,
                             gg_error *err);
/* Before anything is drawn: could all of them be written, and is none the result's own file? */
gg_status gg_plot_pages_check(const gg_stored_result *stored, const gg_plot_paper *paper, const char *file,
                              const char *picture, gg_error *err);
/* "usf.svg", "md", "profiles" -> "usf_md_profiles.svg"; engine: "" outside of comparisons. To be freed; NULL: out of
 * memory. */
char *gg_plot_page_name(const char *picture, const char *engine, const char *group, const gg_plot_paper *paper);
/* Of comparisons: do both engines share the page of this observable? */
bool gg_plot_page_is_shared(const char *group);
#define GG_SNAPSHOT_PAGE "snapshot"
#define GG_PAGE_BESIDE "a picture beside %s"

/* Open a page of this size in layout pixels, under a title (plain text, may be NULL); `unset multiplot` ends it. */
void gg_plot_page_open(FILE *script, const char *title, const gg_plot_paper *paper, double width, double height);
/* What the terminal makes of a layout pixel. */
double gg_plot_page_scale(const gg_plot_paper *paper);
/* The title of the scene; empty if it cannot be read. */
void gg_plot_page_title(const gg_stored_result *stored, char *title, size_t size);

/* The inside of a text in single quotes: as it is, or where gnuplot takes text for enhanced, so that it shows as is. */
void gg_plot_text_print(FILE *script, const char *text);
void gg_plot_text_print_plain(FILE *script, const char *text);
/* A unit as enhanced text: "d^2 gamma^2" becomes "d^2 γ^2", with a space that SVG keeps. */
void gg_plot_text_unit(const char *unit, char *text, size_t size);

gg_status gg_plot_gnuplot_is_there(gg_error *err);
/* Run a gnuplot script, and put what it drew in place; `over` (may be NULL) is SVG that is put over an SVG page. */
gg_status gg_plot_gnuplot_run(const char *script, const char *over, const char *picture, gg_error *err);

/* Where a panel stands on the page, in fractions of it; its frame, and what was set for the panel before is unset. */
typedef struct gg_panel {
  double left, right, bottom, top;
} gg_panel;
void gg_plot_page_place(FILE *script, gg_panel panel);

/* Curves of theories for what the result measured, as under GG_THEORY_CURVES of documents; a new reference. It may take
 * a second or two where they are not stored. */
json_t *gg_plot_theory_curves(const gg_stored_result *stored, const gg_stop *stop);

/* Okabe and Ito's colours, distinguished by the colour-blind: md, dsmc, then the theories. */
extern const char *const gg_plot_colours[];
enum { GG_PLOT_COLOURS = 8 };

#endif
