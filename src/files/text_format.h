/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and scenes in words, for tables and titles. */
#ifndef GG_TEXT_H
#define GG_TEXT_H

#include "run/result.h"

/* Mean with its standard error in the last digits: "1.2340(41)", "123.4(1.2)", "5.1(3)e-05"; two digits of the error.
 * "1.23(?)" where the error is not known (NaN); without one where it is none or mere rounding. */
void gg_files_estimate_format(double mean, double error, char *text, size_t size);
/* "usf, phi 0.3, e 0.9, beta 0", without the keys in `varied` ("phi,collision.e,"; NULL: none). */
void gg_files_scene_title(const gg_scene *scene, const char *varied, char *text, size_t size);

#endif
