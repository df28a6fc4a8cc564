/* The table of a sweep in files for other programs, and as a picture. */
#ifndef GG_SWEEP_COLLECT_H
#define GG_SWEEP_COLLECT_H

#include "sweep/sweep_table.h"

/* Whole or not at all; columns: the point's number, a column a varied key, then method, quantity, mean, error, unit,
 * seed, steady, short, seconds, file. In HDF5 each is an array under /graingas/table, texts without length. */
gg_status gg_sweep_point_table_write_csv(const gg_point_table *table, const gg_sweep *sweep, const char *path,
                                         gg_error *err);
gg_status gg_sweep_point_table_write_h5(const gg_point_table *table, const gg_sweep *sweep, const char *path,
                                        const char *command, gg_error *err);

typedef struct gg_picture_choice { /* NULL: chosen */
  const char *over;                /* key along x */
  const char *show;                /* quantities, with commas: a panel each */
} gg_picture_choice;
/* sweep_picture.c: a panel a quantity; over one key, a line for each combination of the others; engines as points,
 * theories as lines, unless keys go together with that one. GG_BAD_INPUT if no key has numbers, or one that is named is
 * not there. */
gg_status gg_sweep_point_table_draw(const gg_point_table *table, const gg_sweep *sweep, const gg_picture_choice *choice,
                                    const char *picture, gg_error *err);

#endif
