/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and scenes in words, for tables and titles. */
#ifndef GG_TEXT_H
#define GG_TEXT_H

#include "run/result.h"

/* "usf, phi 0.3, e 0.9, beta 0", without the keys in `varied` ("phi,collision.e,"; NULL: none). */
void gg_files_scene_title(const gg_scene *scene, const char *varied, char *text, size_t size);

#endif
