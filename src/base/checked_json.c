#include "base/checked_json.h"

#include <errno.h>
#include <stdlib.h>

#include "base/memory.h"

json_t *gg_base_json_end(bool before, json_t *document)
{
  bool lacked = gg_base_memory_end(before);
  if (document && !lacked) return document;
  gg_base_memory_lacked();
  json_decref(document);
  return NULL;
}

json_t *gg_base_json_made(json_t *value)
{
  if (!value) gg_base_memory_lacked();
  return value;
}

int gg_base_json_put(int failed)
{
  if (failed) gg_base_memory_lacked();
  return failed;
}

/* Some lacks jansson passes over: reading, it leaves out letters that it has no room for; writing, the rest of a text.
 * So its memory comes through here, unless the program has given it another source before. */
static void *noted_malloc(size_t size)
{
  void *block = malloc(size);
  if (!block) gg_base_memory_lacked();
  return block;
}

static bool is_source(json_malloc_t from, json_free_t to)
{
  json_malloc_t now;
  json_free_t back;
  json_get_alloc_funcs(&now, &back);
  return now == from && back == to;
}

__attribute__((constructor)) static void note_what_jansson_lacks(void)
{
  if (is_source(malloc, free)) json_set_alloc_funcs(noted_malloc, free);
}

/* The library may be unloaded, and jansson go on. */
__attribute__((destructor)) static void note_no_more(void)
{
  if (is_source(noted_malloc, free)) json_set_alloc_funcs(malloc, free);
}

json_t *gg_base_json_read(const char *text, const char **why)
{
  const bool before = gg_base_memory_begin();
  errno = 0;
  json_t *document = json_loads(text, 0, NULL);
  if (!document && errno == ENOMEM) gg_base_memory_lacked(); /* of another source */
  const bool lacked = gg_base_memory_end(before);
  if (lacked) {
    json_decref(document);
    document = NULL;
  }
  if (!document && why) *why = lacked ? "out of memory" : "its document is damaged";
  return document;
}

char *gg_base_json_text(const json_t *value, size_t flags)
{
  const bool before = gg_base_memory_begin();
  errno = 0;
  char *text = value ? json_dumps(value, flags) : NULL;
  if (!text || errno == ENOMEM) gg_base_memory_lacked();
  if (!gg_base_memory_end(before)) return text;
  free(text);
  return NULL;
}
