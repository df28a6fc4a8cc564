#include "io/whole_json.h"

#include <errno.h>
#include <stdlib.h>

#include "common/memory.h"

json_t *gg_json_end(bool before, json_t *document)
{
  bool lacked = gg_memory_end(before);
  if (document && !lacked) return document;
  gg_memory_lacked();
  json_decref(document);
  return NULL;
}

json_t *gg_json_made(json_t *value)
{
  if (!value) gg_memory_lacked();
  return value;
}

int gg_json_put(int failed)
{
  if (failed) gg_memory_lacked();
  return failed;
}

json_t *gg_json_read(const char *text, const char **why)
{
  errno = 0; /* jansson's own code does not always know */
  json_t *document = (json_loads)(text, 0, NULL);
  bool memory = !document && errno == ENOMEM;
  if (!document) *why = memory ? "out of memory" : "its document is damaged";
  return document;
}

char *gg_json_text(const json_t *value, size_t flags)
{
  errno = 0;
  char *text = value ? json_dumps(value, flags) : NULL;
  if (text && errno != ENOMEM) return text;
  free(text);
  gg_memory_lacked();
  return NULL;
}
