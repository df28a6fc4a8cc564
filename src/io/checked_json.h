/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON that is complete or missing. If memory is short, jansson's constructors return NULL and its containers leave out
 * NULL members, so that an incomplete document would go unnoticed. In files that include this, every failed constructor
 * is counted (base/memory.h). Finish a document with gg_io_json_end. */
#ifndef GG_CHECKED_JSON_H
#define GG_CHECKED_JSON_H

#include <jansson.h>

#include "base/memory.h"

/* The document, or NULL if anything was lost since gg_base_memory_failures returned `before`. */
json_t *gg_io_json_end(unsigned before, json_t *document);

json_t *gg_io_json_made(json_t *value);
int gg_io_json_put(int failed);

/* A text read; NULL with the reason in *why (which may be NULL). */
json_t *gg_io_json_read(const char *text, const char **why);

/* Value of a member of an object: "" and NaN where there is no such value, or no object. */
const char *gg_io_json_string(const json_t *object, const char *key);
double gg_io_json_number(const json_t *object, const char *key);
/* A number; null for what is not finite. */
json_t *gg_io_json_finite(double x);

/* json_sprintf, with a decimal point in every locale. */
json_t *gg_io_json_format(const char *format, ...) GG_PRINTF(1, 2);

/* json_dumps, which cuts the text off where it has no room for it; to be freed, NULL: out of memory. */
char *gg_io_json_text(const json_t *value, size_t flags);

#define json_object() gg_io_json_made(json_object())
#define json_array() gg_io_json_made(json_array())
#define json_real(x) gg_io_json_made(json_real(x))
#define json_integer(x) gg_io_json_made(json_integer(x))
#define json_string(x) gg_io_json_made(json_string(x))
#define json_sprintf(...) gg_io_json_made(gg_io_json_format(__VA_ARGS__))
#define json_pack(...) gg_io_json_made(json_pack(__VA_ARGS__))
#define json_object_set(...) gg_io_json_put(json_object_set(__VA_ARGS__))
#define json_object_set_new(...) gg_io_json_put(json_object_set_new(__VA_ARGS__))
#define json_array_append_new(...) gg_io_json_put(json_array_append_new(__VA_ARGS__))
#define json_object_update_new(...) gg_io_json_put(json_object_update_new(__VA_ARGS__))
#define json_vpack_ex(...) gg_io_json_made(json_vpack_ex(__VA_ARGS__))
#define json_string_set(...) gg_io_json_put(json_string_set(__VA_ARGS__))

#endif
