/* Pictures of result files, drawn by gnuplot. */
#ifndef GG_PLOT_H
#define GG_PLOT_H

#include <stdio.h>

#include "files/h5/result_reader.h"

#define GG_PICTURES_ARE "pictures are files, with others beside them"

/* By the ending of its name, or as asked for (NULL: not). GG_BAD_INPUT if that is neither .svg nor .png, or both are
 * not the same. */
gg_status gg_plot_format(const char *picture, const char *format, bool *png, gg_error *err);

/* And could it be drawn there? Asked before long runs: GG_BAD_FILE if it could not be written, GG_FAILED without
 * gnuplot. */
gg_status gg_plot_could(const char *picture, const char *format, bool *png, gg_error *err);

/* Draw a result to a picture, whole or not at all. format: "svg", "png", or NULL: by the picture's name. */
gg_status gg_plot_result(const gg_stored_result *stored, const char *picture, const char *format, gg_error *err);

/* A picture of the last frame, projected, if the file holds positions: *drawn says whether. */
gg_status gg_plot_snapshot(const gg_stored_result *stored, const char *picture, bool png, bool *drawn, gg_error *err);

/* Does it? */
bool gg_plot_has_snapshot(const gg_stored_result *stored);

/* Pages are further pictures beside the given name: PICTURE_snapshot.svg if the file holds grains with positions, and
 * one for each observable that left curves: PICTURE_<observable>.svg, for comparisons
 * PICTURE_<engine>_<observable>.svg. `drawn` (may be NULL) is called with the name of each. */
gg_status gg_plot_pages(const gg_stored_result *stored, const char *picture, const char *format,
                        void (*drawn)(void *context, const char *picture), void *context, gg_error *err);
/* Before anything is drawn: could all of them be written, and is none the result's own file? */
gg_status gg_plot_check_pages(const gg_stored_result *stored, const char *file, const char *picture, const char *format,
                              gg_error *err);
/* "usf.svg", "md", "profiles" -> "usf_md_profiles.svg"; engine: "" outside of comparisons. To be freed; NULL: out of
 * memory. */
char *gg_plot_page_name(const char *picture, const char *engine, const char *group, bool png);
#define GG_SNAPSHOT_PAGE "snapshot"
#define GG_PAGE_BESIDE "a picture beside %s"

#define GG_PLOT_PNG_SCALE 1.5 /* pixels of PNG for one of a page's size */

/* Open a page of this size under a title (plain text, may be NULL), or under the scene's; to be ended by `unset
 * multiplot`. */
void gg_plot_open_page(FILE *script, const char *title, bool png, int width, int height);
void gg_plot_start_page(FILE *script, const gg_stored_result *stored, bool png, int width, int height);

/* The inside of a text in single quotes: as it is, or where gnuplot takes text for enhanced, so that it shows as is. */
void gg_plot_text(FILE *script, const char *text);
void gg_plot_plain_text(FILE *script, const char *text);

/* Is there a gnuplot? */
gg_status gg_plot_gnuplot_is_there(gg_error *err);
/* Run a gnuplot script, and put what it drew in place; `over` (may be NULL) is SVG that is put over an SVG page. */
gg_status gg_plot_gnuplot_run(const char *script, const char *over, const char *picture, gg_error *err);

/* Where a panel stands on the page, in fractions of it. */
typedef struct gg_panel {
  double left, right, bottom, top;
} gg_panel;
void gg_plot_place(FILE *script, gg_panel panel);

/* One engine's temperatures (or stresses) from start to end, with the averaging window. */
void gg_plot_relaxation(FILE *script, const gg_stored_engine *engine, gg_panel panel);
void gg_plot_stresses(FILE *script, const gg_stored_engine *engine, gg_panel panel);
/* Not of gases that cool. */
bool gg_plot_has_stresses(const gg_stored_engine *engine);
/* md, dsmc and the theories: ratios to md, and the numbers that have no scale to be divided by (N1, N2 ...). */
bool gg_plot_has(const gg_stored_result *stored, bool ratios);
void gg_plot_ratios(FILE *script, const gg_stored_result *stored, gg_panel panel);
void gg_plot_differences(FILE *script, const gg_stored_result *stored, gg_panel panel);

/* Curves of theories for what the result measured, as under GG_THEORY_CURVES of documents; a new reference. It may take
 * a second or two where they are not stored. */
json_t *gg_plot_theory_curves(const gg_stored_result *stored);

/* A unit as gnuplot's enhanced text: "d^2 gamma^2" becomes "d^2 γ^2". */
void gg_plot_unit(const char *unit, char *text, size_t size);

/* Okabe and Ito's colours, told apart by the colour-blind: md, dsmc, then the theories. */
extern const char *const gg_plot_colours[];
enum { GG_PLOT_COLOURS = 8 };

#endif
