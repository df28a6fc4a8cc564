/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Definitions for graingas info WORD, and the headline quantities of a scene. */
#ifndef GG_CLI_DEFINITION_H
#define GG_CLI_DEFINITION_H

#include "cli/cli.h"

/* Whether the argument of `info` can be a word to define, and does not end like a file name. */
bool gg_cli_is_word(const char *input);
/* Print the definition in five lines or in full, or an error with a spelling suggestion. Returns the exit code. */
int gg_cli_define(const char *word, bool all);

/* Whether only --all prints a quantity: parts and components. */
bool gg_cli_quantity_is_minor(const char *name);

/* Print the headline quantities, whose errors end a run of the scene, in one line. */
void gg_cli_print_headline(const gg_scene *scene);

#endif
