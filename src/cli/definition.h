/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Definitions where they are looked for: graingas info WORD, and the headline quantities of a scene. */
#ifndef GG_CLI_DEFINITION_H
#define GG_CLI_DEFINITION_H

#include "cli/cli.h"

/* May the argument of `info` be a word to define? What cannot be one, or ends like a file's name, is a file. */
bool gg_cli_is_word(const char *input);
/* Print the definition in five lines, or in full; or an error with the nearest word. Returns the exit code. */
int gg_cli_define(const char *word, bool all);

/* A quantity that is left to --all: parts and components. */
bool gg_cli_quantity_is_minor(const char *name);
bool gg_cli_theory_answers(const gg_entry *theory, const char *quantity);
/* The theories that may answer a quantity, with commas; returns how many. */
size_t gg_cli_theories_of(const char *quantity, char *text, size_t size);

/* The quantities whose errors end a run of the scene, in one line. */
void gg_cli_print_headline(const gg_scene *scene);

#endif
