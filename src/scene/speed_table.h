/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A coefficient of contacts as a table of the normal speed: rows of a file in the form of common/laws/speed_laws.h. */
#ifndef GG_SPEED_TABLE_H
#define GG_SPEED_TABLE_H

#include "common/laws/speed_laws.h"

/* Append a row to `text`; false: no room. */
bool gg_scene_speed_table_add(double speed, double value, char text[GG_LAWS_TEXT]);
/* Two columns, separated by blanks or a comma; lines that begin with # are left out, and a first line of words. A
 * relative path is relative to the folder of the file `beside` (NULL: the current one). */
gg_status gg_scene_speed_table_read(const char *file, const char *beside, char text[GG_LAWS_TEXT], gg_error *err);

#endif
