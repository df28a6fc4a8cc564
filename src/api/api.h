/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the public interface. Each file is one section of graingas.h: it checks arguments, completes
 * scenes, and calls the rooms that do the work. */
#ifndef GG_API_H
#define GG_API_H

#include <jansson.h>

#include "base/cancellation.h"
#include "base/error.h"
#include "graingas.h"
#include "measure/curve.h"
#include "run/result.h"

#define GG_NEED(...) GG_CHECK_ARGUMENTS(#__VA_ARGS__, __VA_ARGS__)
/* Declarations: the same, and the first argument is a handle, which the call has for itself, or reads (base/busy.h). */
#define GG_NEED_ALONE(...)                                                                                             \
  GG_NEED(__VA_ARGS__);                                                                                                \
  GG_USE_ALONE(GG_FIRST(__VA_ARGS__, ))
#define GG_NEED_READING(...)                                                                                           \
  GG_NEED(__VA_ARGS__);                                                                                                \
  GG_USE_READING(GG_FIRST(__VA_ARGS__, ))
#define GG_FIRST(first, ...) first
#define GG_NEED_CALLBACK(argument) GG_CHECK_ARGUMENTS(#argument, (argument) ? "" : NULL)
#define GG_CHECK_ARGUMENTS(names, ...)                                                                                 \
  GG_TRY(gg_api_arguments_check(__func__, names, (const void *const[]){__VA_ARGS__},                                   \
                                sizeof((const void *const[]){__VA_ARGS__}) / sizeof(void *), err))
/* text.c: GG_BAD_INPUT for the first of n arguments that is NULL; `names`: "scene, result". */
gg_status gg_api_arguments_check(const char *function, const char *names, const void *const *argument, size_t n,
                                 gg_error *err);

/* A copy of the caller's options (NULL: none), zero where they are not set. */
#define GG_COPY_OPTIONS(copy, options)                                                                                 \
  GG_TRY(gg_api_options_copy(__func__, &(copy), sizeof(copy), options, (options) ? (options)->size : 0, err))
/* text.c: GG_BAD_INPUT unless 0 < size <= own_size, the size in this library; `options` may be NULL. */
gg_status gg_api_options_copy(const char *function, void *copy, size_t own_size, const void *options, size_t size,
                              gg_error *err);

/* scene.c: a copy of the scene, with its defaults filled in and checked. Every use of a scene begins with this call. */
gg_status gg_api_scene_finish(const gg_scene *scene, gg_scene *copy, gg_error *err);

/* text.c: the row of a quantity; GG_BAD_INPUT for an unknown one, with a spelling suggestion. */
gg_status gg_api_row_find(const gg_quantity_rows *rows, const char *name, const gg_quantity_row **row, gg_error *err);

/* comparison.c: for GG_CLEARED. */
void gg_api_comparison_freed(gg_comparison **comparison);

gg_status gg_api_engine_find(const char *name, gg_engine_kind *kind, gg_error *err);
/* text.c: a document as text; releases the document (NULL: out of memory). */
gg_status gg_api_text_copy(json_t *document, char **text, gg_error *err);

/* text.c: the `stop` callback of a caller, as the `asked` of a gg_stop. Once the callback has returned non-zero, it is
 * not called again. */
typedef struct gg_api_request {
  int (*stop)(void *context); /* NULL: never stops */
  void *context;
  bool made;
} gg_api_request;
bool gg_api_is_requested(void *request);
/* The gg_stop of the callback, for the block. */
#define GG_STOP_OF(stop, context) ((gg_stop){gg_api_is_requested, &(gg_api_request){stop, context, false}})

/* result.c: a curve, and its k-th number, as the interface has them; the unit is that of correlation times. */
gg_curve_data gg_api_curve_view(const gg_curve *curve);
gg_status gg_api_curve_number(const gg_curve *c, size_t k, const char *unit, gg_measurement *number, gg_error *err);

/* result.c: the file of a run, or of a comparison (NULL: the run), on disk or in memory. The file's command is that of
 * the run, or the name of the function. */
gg_status gg_api_file_write(const gg_result *run, const gg_comparison *both, const char *function, const char *path,
                            const gg_stop *stop, gg_error *err);
gg_status gg_api_file_to_bytes(const gg_result *run, const gg_comparison *both, const char *function, void **bytes,
                               size_t *size, gg_error *err);

#endif
