/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choices that the model and the scene share. */
#ifndef GG_KINDS_H
#define GG_KINDS_H

typedef enum gg_engine_kind { GG_MD, GG_DSMC } gg_engine_kind;
typedef enum gg_precision { GG_DOUBLE, GG_SINGLE } gg_precision;
/* The flow that peculiar velocities are relative to, in flows without walls: the imposed flow, or means of cells (after
 * or before the imposed flow is subtracted). */
typedef enum gg_frame_kind { GG_FRAME_IMPOSED, GG_FRAME_CELLS, GG_FRAME_CELLS_LABORATORY } gg_frame_kind;
typedef enum gg_contact_value { GG_CARNAHAN_STARLING, GG_LUN_SAVAGE, GG_KOLAFA } gg_contact_value;

#define GG_AUTO (-1.0) /* a number that the program is to choose */

#endif
