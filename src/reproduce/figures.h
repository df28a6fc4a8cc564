/* The figures: found by name, run, read back, drawn and written. */
#ifndef GG_FIGURES_H
#define GG_FIGURES_H

#include "reproduce/panel.h"
#include "reproduce/stated.h"

/* The k-th entry there is; GG_BAD_INPUT after the last. */
gg_status gg_reproduce_figure_read(size_t k, gg_figure_entry *entry, gg_error *err);
/* "thesis 3.5", "thesis-3.5", "thesis 3.05", "review 3"; without the paper where only one has it ("3.5", "I.2"). Its
 * place among the entries; GG_BAD_INPUT names the nearest. */
gg_status gg_reproduce_figure_find(const char *name, size_t *k, gg_error *err);
/* "thesis-3.05" of the entry's file: what its files are called. */
void gg_reproduce_figure_base(const gg_figure_entry *entry, char *text, size_t size);

/* runs.c: the sweeps of an entry, ready to be run; `n` of them, to be freed by gg_sweep_free each. */
gg_status gg_reproduce_figure_sweeps(const gg_figure_entry *entry, bool quick, gg_sweep *sweeps[GG_MOST_SWEEPS],
                                     gg_error *err);
/* Run what is missing, and read all points: also with GG_FAILED, where some fell short. */
gg_status gg_reproduce_figure_run(const gg_figure_entry *entry, const gg_reproduce_options *options,
                                  gg_figure_points *points, gg_error *err);

/* A figure with all its numbers. */
typedef struct gg_figure {
  const gg_figure_entry *entry;
  bool quick;
  gg_drawn_panel panel[GG_MOST_PANELS];
  gg_stated_row row[GG_MOST_NUMBERS];
} gg_figure;

/* tables.c, file.c, pictures.c: each file whole or not at all. */
gg_status gg_reproduce_figure_write_csv(const gg_figure *figure, const char *path, gg_error *err);
gg_status gg_reproduce_figure_write_numbers(const gg_figure *figure, const char *path, gg_error *err);
gg_status gg_reproduce_figure_write_h5(const gg_figure *figure, const char *path, const char *command, gg_error *err);
gg_status gg_reproduce_figure_draw(const gg_figure *figure, const gg_figure_points *points, const char *picture,
                                   gg_error *err);
/* snapshots.c: the grains of the panels that show them. */
bool gg_reproduce_figure_has(const gg_figure *figure, bool snapshots);
gg_status gg_reproduce_figure_draw_snapshots(const gg_figure *figure, const gg_figure_points *points,
                                             const char *picture, gg_error *err);

/* reproduce.c: one figure, from the runs to its files. With GG_FAILED files are there if some points were. */
gg_status gg_reproduce_figure_reproduce(const gg_figure_entry *entry, const gg_reproduce_options *options,
                                        gg_error *err);

/* page.c: docs/appendix/reproduction.md, to be freed. */
gg_status gg_reproduce_figure_page(char **text, gg_error *err);

#endif
