/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the public interface have in common. Each of them is one section of graingas.h: it checks
 * arguments, finishes scenes, and hands on to the rooms that do the work. */
#ifndef GG_API_H
#define GG_API_H

#include <jansson.h>

#include "base/cancellation.h"
#include "base/error.h"
#include "graingas.h"
#include "measure/curve.h"
#include "run/result.h"
#include "scene/scene.h"

/* A missing argument is an answer, not a crash. */
#define GG_NEED(...) GG_CHECK_ARGUMENTS(#__VA_ARGS__, __VA_ARGS__)
#define GG_NEED_CALLBACK(argument) GG_CHECK_ARGUMENTS(#argument, (argument) ? "" : NULL)
#define GG_CHECK_ARGUMENTS(names, ...)                                                                                 \
  GG_TRY(gg_api_arguments_check(__func__, names, (const void *const[]){__VA_ARGS__},                                   \
                                sizeof((const void *const[]){__VA_ARGS__}) / sizeof(void *), err))
/* text.c: the arguments of a function, by their names ("scene, result"): GG_BAD_INPUT for the first that is NULL. */
gg_status gg_api_arguments_check(const char *function, const char *names, const void *const *argument, size_t n,
                                 gg_error *err);

/* scene.c: a copy of the scene, complete and checked: what every use of a scene begins with. */
gg_status gg_api_scene_finish(const gg_scene *scene, gg_scene *copy, gg_error *err);

/* text.c: GG_BAD_INPUT, with the name among these that may be meant. */
gg_status gg_api_no_quantity(const gg_quantity_rows *rows, const char *name, gg_error *err);

/* text.c: an engine by its name; a document as text, whose reference it takes. */
gg_status gg_api_engine_find(const char *name, gg_engine_kind *kind, gg_error *err);
gg_status gg_api_text_copy(json_t *document, char **text, gg_error *err);

/* text.c: a caller's function that may ask to stop (NULL: it never does); its request, once made, holds. For the
 * `asked` of a gg_stop. */
typedef struct gg_api_request {
  int (*stop)(void *context);
  void *context;
  bool made;
} gg_api_request;
bool gg_api_is_requested(void *request);

/* result.c: what a user sees of a curve. */
gg_curve_data gg_api_curve_view(const gg_curve *curve);

#endif
