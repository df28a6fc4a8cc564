/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of the public interface, and all that they answer as one text. */
#ifndef GG_TESTS_DOOR_MEMORY_H
#define GG_TESTS_DOOR_MEMORY_H

#include <graingas.h>
#include <stdbool.h>
#include <stddef.h>

/* Results of a call; all are freed afterwards. */
typedef struct things {
  gg_scene *scene, *other; /* scene is there before */
  gg_result *result;
  gg_comparison *comparison;
  gg_trajectory *trajectory;
  gg_simulation *simulation;
  gg_sweep *sweep;
  char *text[3];
  double numbers[8];
  int told;
  bool written; /* a call that writes files has ended well */
} things;

/* memory_calls.c: a call, of which every step that fails ends it. */
typedef struct memory_call {
  const char *name;
  gg_status (*work)(things *t, gg_error *err);
} memory_call;
extern const memory_call calls[]; /* ends with a NULL name */
extern const char scene_text[], sweep_text[];
void clear(things *t);
/* Was lack of memory told on the way, where the sum of a sweep names no single reason? Asking forgets it. */
bool was_told(void);

/* memory_answers.c: a whole answer: texts, numbers to the last bit. */
void say(const char *format, ...) __attribute__((format(printf, 1, 2)));
const char *said(void);
void say_nothing(void);
/* All that the things hold; a file read back; JSON less what the clock says. */
void say_things(const things *t);
void say_file(const char *path);

/* memory_folder.c: a folder as another one is; what was there is removed. */
void make_copy(const char *from, const char *to);

enum { MOST_SAID = 1 << 21 };

#endif
