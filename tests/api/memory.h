/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of the public interface, and all their results as one text. */
#ifndef GG_TESTS_DOOR_MEMORY_H
#define GG_TESTS_DOOR_MEMORY_H

#include <graingas.h>
#include <stdbool.h>
#include <stddef.h>

/* Results of a call; all are freed afterwards. `scene` is made before the call. */
typedef struct things {
  gg_scene *scene, *other;
  gg_result *result;
  gg_comparison *comparison;
  gg_trajectory *trajectory;
  gg_simulation *simulation;
  gg_sweep *sweep;
  char *text[3];
  double numbers[8];
  int lines;    /* number of lines passed to callbacks */
  bool written; /* a call that writes files returned GG_OK */
} things;

/* memory_calls.c: a sequence of calls, which ends at the first that fails. */
typedef struct memory_call {
  const char *name;
  gg_status (*work)(things *t, gg_error *err);
} memory_call;
extern const memory_call calls[]; /* ends with a NULL name */
extern const char scene_text[], sweep_text[];
void clear(things *t);
/* True if a call reported lack of memory for a point of a sweep, whose final message names no single reason. Resets. */
bool lack_was_reported(void);

/* memory_answers.c: collects the results as text, numbers to the last bit. */
void say(const char *format, ...) __attribute__((format(printf, 1, 2)));
const char *said(void);
void say_nothing(void);
/* Add all results in `things`; a file, as read back. Times and dates in JSON are left out. */
void say_things(const things *t);
void say_file(const char *path);

/* memory_folder.c: replace folder `to` by a copy of `from`. */
void make_copy(const char *from, const char *to);

enum { MOST_SAID = 1 << 21 };

#endif
